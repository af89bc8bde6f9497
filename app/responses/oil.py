"""The oil as it enters a contact."""

from typing import Annotated

from app.schema.base import Derived
from app.schema.quantities import Output


class OilDerived(Derived):
    """Properties of the oil at its reference temperature, given or by grade and data sheet; null without an oil."""

    viscosity_pa_s: Annotated[float | None, Output("oil viscosity used", "η_0", text="at the reference temperature")]
    reference_temperature_c: Annotated[float | None, Output("oil reference temperature used", "θ_0")]
    pressure_viscosity_per_gpa: Annotated[float | None, Output("pressure-viscosity coefficient used", "α")]
    temperature_viscosity_per_k: Annotated[float | None, Output("temperature-viscosity coefficient used", "β")]
    density_kg_per_m3: Annotated[float | None, Output("oil density used", "ρ_0")]
    specific_heat_j_per_kg_k: Annotated[float | None, Output("oil specific heat used", "c_oil")]
    thermal_conductivity_w_per_m_k: Annotated[float | None, Output("oil thermal conductivity used", "λ_oil")]
