"""Solids and lubricants, shared by everything that touches."""

from typing import Annotated, Literal

from app.conversion import to_si
from app.quantities import Input
from app.requests.common import Section
from solvers.lubricants import Lubricant
from solvers.materials import Solid

XUE = "Xue, Zhang, Wang 2020, Table 2"
STEEL = "steel"


class SolidMaterial(Section):
    """A solid; steel unless told otherwise."""

    youngs_modulus_gpa: Annotated[float, Input("Young's modulus", "E", XUE, ge=1, le=2000)] = 206.0
    poisson_ratio: Annotated[float, Input("Poisson's ratio", "ν", XUE, ge=0, lt=0.5)] = 0.3
    density_kg_per_m3: Annotated[float, Input("density", "ρ", XUE, ge=100, le=30000)] = 7850.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", XUE, ge=10, le=10000)] = 470.0
    thermal_conductivity_w_per_m_k: Annotated[float, Input("thermal conductivity", "λ", XUE, ge=0.1, le=2000)] = 46.0

    def solid(self) -> Solid:
        """The solver's solid."""
        return Solid(**to_si(self))


class ContactLubricant(Section):
    """The oil in a highly loaded contact."""

    viscosity_pa_s: Annotated[
        float, Input("viscosity at the reference temperature and no pressure", "η_0", XUE, gt=0, le=100)
    ] = 0.08
    reference_temperature_c: Annotated[
        float,
        Input(
            "temperature of viscosity and density",
            "t_0",
            "Xue, Zhang, Wang 2020, Eq. 20",
            ge=-50,
            le=300,
            assumed="360 K: the only temperature at which the paper's viscosity gives its film thickness",
        ),
    ] = 86.85
    pressure_viscosity_per_gpa: Annotated[
        float, Input("pressure-viscosity coefficient", "α", XUE, ge=1, le=60)
    ] = 21.9
    temperature_viscosity_per_k: Annotated[
        float, Input("temperature-viscosity coefficient", "β", XUE, ge=0, le=0.2)
    ] = 0.042
    density_kg_per_m3: Annotated[float, Input("density", "ρ_0", XUE, ge=100, le=5000)] = 870.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", XUE, ge=100, le=10000)] = 2000.0
    thermal_conductivity_w_per_m_k: Annotated[float, Input("thermal conductivity", "λ", XUE, ge=0.01, le=10)] = 0.14
    pressure_viscosity_law: Annotated[
        Literal["roelands", "barus"], Input("how viscosity depends on pressure and temperature", None, XUE)
    ] = "roelands"
    compressible: Annotated[
        bool, Input("whether density follows pressure and temperature (Dowson and Higginson)", None, XUE)
    ] = True

    def lubricant(self) -> Lubricant:
        """The solver's lubricant."""
        return Lubricant(**to_si(self))
