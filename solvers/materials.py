"""Solids and lubricants, and the laws they follow."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Solid:
    """An isotropic solid; steel unless told otherwise.

    Units: youngs_modulus [Pa], poisson_ratio [-], density [kg/m^3], specific_heat [J/(kg K)],
    thermal_conductivity [W/(m K)], roughness (arithmetic mean Ra) [m].
    """

    youngs_modulus: float = 206e9
    poisson_ratio: float = 0.3
    density: float = 7850.0
    specific_heat: float = 470.0
    thermal_conductivity: float = 46.0
    roughness: float = 0.4e-6

    @property
    def plane_strain_compliance(self) -> float:
        """(1 - nu^2) / E [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.youngs_modulus
