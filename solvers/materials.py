"""Elastic and thermal properties of solids."""

from solvers.quantity import quantity, record
from solvers.sources import XUE


@record
class Solid:
    """An isotropic solid; the default is steel."""

    youngs_modulus: float = quantity(
        "Young's modulus", "E", f"{XUE}, Table 2", unit="gpa", default=206.0, ge=1, le=2000
    )
    poisson_ratio: float = quantity(
        "Poisson's ratio", "ν", f"{XUE}, Table 2", default=0.3, ge=0, lt=0.5, tolerance=0.01
    )
    density: float = quantity("density", "ρ", f"{XUE}, Table 2", unit="kg_per_m3", default=7850.0, ge=100, le=30000)
    specific_heat: float = quantity(
        "specific heat", "c", f"{XUE}, Table 2", unit="j_per_kg_k", default=470.0, ge=10, le=10000
    )
    thermal_conductivity: float = quantity(
        "thermal conductivity", "λ", f"{XUE}, Table 2", unit="w_per_m_k", default=46.0, ge=0.1, le=2000
    )
    roughness: float = quantity(
        "roughness",
        "Ra",
        f"{XUE}, Eq. 28",
        unit="um",
        default=0.4,
        ge=1e-3,
        le=100,
        tolerance=0.1,
        text="arithmetic mean roughness",
        assumed="ground flanks; the paper gives none",
    )
