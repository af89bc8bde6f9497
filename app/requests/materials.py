"""Solids and lubricants, shared by everything that touches."""

from typing import Annotated

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Section
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.materials import Solid

XUE = "Xue 2020"
TABLE = f"{XUE}, Table 2"

_OIL = Lubricant()


class Surface(Section):
    """The solid under one surface; steel unless told otherwise."""

    youngs_modulus_gpa: Annotated[float, Input("Young's modulus", "E", TABLE, ge=1, le=2000)] = 206.0
    poisson_ratio: Annotated[float, Input("Poisson's ratio", "ν", TABLE, ge=0, lt=0.5)] = 0.3
    density_kg_per_m3: Annotated[float, Input("density", "ρ", TABLE, ge=100, le=30000)] = 7850.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", TABLE, ge=10, le=10000)] = 470.0
    thermal_conductivity_w_per_m_k: Annotated[float, Input("thermal conductivity", "λ", TABLE, ge=0.1, le=2000)] = 46.0

    def solid(self) -> Solid:
        """The solver's solid."""
        return Solid(**to_si(self))


class Oil(Section):
    """The oil; the defaults are the paper's, at 360 K."""

    viscosity_pa_s: Annotated[
        float,
        Input(
            "oil viscosity",
            "η_0",
            TABLE,
            text="viscosity at the reference temperature and no pressure",
            ge=1e-5,
            le=100,
        ),
    ] = _OIL.viscosity
    reference_temperature_c: Annotated[
        float,
        Input(
            "oil reference temperature",
            "θ_0",
            f"{XUE}, Eq. 20",
            text="temperature of viscosity and density",
            ge=-50,
            le=300,
            assumed="360 K: the only temperature at which the paper's viscosity gives its film thickness",
        ),
    ] = 86.85
    pressure_viscosity_per_gpa: Annotated[float, Input("pressure-viscosity coefficient", "α", TABLE, ge=1, le=60)] = (
        21.9
    )
    temperature_viscosity_per_k: Annotated[
        float, Input("temperature-viscosity coefficient", "β", TABLE, ge=0, le=0.2)
    ] = _OIL.temperature_viscosity
    density_kg_per_m3: Annotated[float, Input("oil density", "ρ_0", TABLE, ge=100, le=5000)] = _OIL.density
    specific_heat_j_per_kg_k: Annotated[float, Input("oil specific heat", "c_oil", TABLE, ge=100, le=10000)] = (
        _OIL.specific_heat
    )
    thermal_conductivity_w_per_m_k: Annotated[
        float, Input("oil thermal conductivity", "λ_oil", TABLE, ge=0.01, le=10)
    ] = _OIL.thermal_conductivity
    pressure_viscosity_law: Annotated[
        PressureViscosityLaw,
        Input(
            "pressure-viscosity law",
            None,
            TABLE,
            text="how viscosity depends on pressure and temperature",
            advanced=True,
        ),
    ] = _OIL.pressure_viscosity_law
    compressible: Annotated[
        bool,
        Input(
            "compressible oil",
            None,
            TABLE,
            text="whether density follows pressure and temperature (Dowson and Higginson)",
            advanced=True,
        ),
    ] = _OIL.compressible

    def lubricant(self) -> Lubricant:
        """The solver's lubricant."""
        return Lubricant(**to_si(self))
