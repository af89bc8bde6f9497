"""Solids, shared by everything that touches."""

from typing import Annotated

from app.requests.common import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.materials import Solid

XUE = "Xue 2020"
TABLE = f"{XUE}, Table 2"


class Surface(Section):
    """The solid under one surface; steel unless told otherwise."""

    youngs_modulus_gpa: Annotated[float, Input("Young's modulus", "E", TABLE, ge=1, le=2000)] = 206.0
    poisson_ratio: Annotated[float, Input("Poisson's ratio", "ν", TABLE, ge=0, lt=0.5, tolerance=0.01)] = 0.3
    density_kg_per_m3: Annotated[float, Input("density", "ρ", TABLE, ge=100, le=30000)] = 7850.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", TABLE, ge=10, le=10000)] = 470.0
    thermal_conductivity_w_per_m_k: Annotated[float, Input("thermal conductivity", "λ", TABLE, ge=0.1, le=2000)] = 46.0

    def solid(self) -> Solid:
        """The solver's solid."""
        return Solid(**to_si(self))
