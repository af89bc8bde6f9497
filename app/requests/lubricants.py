"""Gear materials and lubricants of lubricated contacts."""

from typing import Annotated, Literal

from app.quantities import Input
from app.requests.common import Section

XUE = "Xue 2020"


class Surface(Section):
    """The solid under one surface; steel."""

    youngs_modulus_gpa: Annotated[float, Input("Young's modulus", "E", f"{XUE}, Table 1", ge=0.1, le=2000)] = 206.0
    poisson_ratio: Annotated[float, Input("Poisson's ratio", "ν", f"{XUE}, Table 1", ge=0, le=0.499)] = 0.3
    density_kg_per_m3: Annotated[float, Input("density", "ρ", f"{XUE}, Table 2", ge=100, le=30000)] = 7850.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", f"{XUE}, Table 2", ge=10, le=10000)] = 470.0
    thermal_conductivity_w_per_m_k: Annotated[
        float, Input("thermal conductivity", "λ", f"{XUE}, Table 2", ge=0.01, le=3000)
    ] = 46.0


class Oil(Section):
    """The lubricant; the defaults are the paper's oil at 360 K."""

    viscosity_pa_s: Annotated[
        float, Input("viscosity at the reference temperature", "η_0", f"{XUE}, Table 2", ge=7e-5, le=1e4)
    ] = 0.08
    reference_temperature_c: Annotated[
        float, Input("temperature of viscosity and density", "t_0", f"{XUE}, Table 2", ge=-70, le=500)
    ] = 86.85
    pressure_viscosity_per_gpa: Annotated[
        float, Input("pressure-viscosity coefficient (Barus)", "α", f"{XUE}, Table 2", gt=0, le=100)
    ] = 21.9
    temperature_viscosity_per_k: Annotated[
        float, Input("temperature-viscosity coefficient (Reynolds)", "β", f"{XUE}, Table 2", ge=0, le=0.2)
    ] = 0.042
    density_kg_per_m3: Annotated[
        float, Input("density at the reference temperature", "ρ", f"{XUE}, Table 2", ge=100, le=5000)
    ] = 870.0
    specific_heat_j_per_kg_k: Annotated[float, Input("specific heat", "c", f"{XUE}, Table 2", ge=100, le=10000)] = (
        2000.0
    )
    thermal_conductivity_w_per_m_k: Annotated[
        float, Input("thermal conductivity", "λ", f"{XUE}, Table 2", ge=0.001, le=10)
    ] = 0.14
    pressure_viscosity_law: Annotated[
        Literal["roelands", "barus"], Input("law of viscosity over pressure and temperature", None, f"{XUE}, Eq. 20")
    ] = "roelands"
    compressible: Annotated[
        bool, Input("whether pressure and temperature change the density", None, f"{XUE}, Eq. 19")
    ] = True
