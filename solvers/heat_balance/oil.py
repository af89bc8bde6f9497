"""The cooling oil of the heat balance."""

from collections.abc import Callable
from functools import partial

from solvers.lubricants import Lubricant
from solvers.oils import OilSheet, lubricant_at
from solvers.quantity import described, record


@record
class CoolingOil:
    """The cooling oil; density, specific heat and conductivity are values at the supply temperature of the oil."""

    inlet: float = described("Supply temperature [K].")
    viscosity: Callable[[float], float] = described("Function that returns the viscosity [Pa s] at a temperature [K].")
    density: float = described("Density [kg/m^3].")
    specific_heat: float = described("Specific heat [J/(kg K)].")
    thermal_conductivity: float = described("Thermal conductivity [W/(m K)].")

    @property
    def heat_capacity(self) -> float:
        """Heat capacity per volume [J/(m^3 K)]."""
        return self.density * self.specific_heat

    @property
    def diffusivity(self) -> float:
        """Thermal diffusivity [m^2/s]."""
        return self.thermal_conductivity / self.heat_capacity


def cooling_oil(oil: OilSheet | Lubricant, inlet: float) -> CoolingOil:
    """Convert an oil, as other models describe it, into the cooling oil of the heat balance.

    Parameters
    ----------
    oil : OilSheet or Lubricant
        The oil, by its data sheet or by its viscosity at one temperature.
    inlet : float
        Temperature at which the oil is supplied [K].

    Returns
    -------
    CoolingOil
        The cooling oil. Its density is the density at the supply temperature. Its viscosity is a function of the
        temperature, at ambient pressure.

    Examples
    --------
    >>> from solvers.oils import iso_vg
    >>> oil = cooling_oil(iso_vg(46), 328.15)
    >>> round(oil.density)
    857
    """
    supplied = lubricant_at(oil, inlet)
    return CoolingOil(
        inlet=inlet,
        viscosity=oil.viscosity if isinstance(oil, OilSheet) else partial(oil.viscosity_at, 0.0),
        density=supplied.density_at(0.0, inlet),
        specific_heat=supplied.specific_heat,
        thermal_conductivity=supplied.thermal_conductivity,
    )
