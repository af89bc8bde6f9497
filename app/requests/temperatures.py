"""Temperatures of an oil and its contact, as every request words them; each request adds its own defaults."""

from app.schema.quantities import Input
from solvers.sources import XUE

OIL_TEMPERATURE = Input("oil temperature", "θ_oil", f"{XUE}, Eq. 26", ge=-70, le=500, tolerance=5)
SCUFFING_TEMPERATURE = Input(
    "scuffing temperature",
    "θ_S",
    f"{XUE}, Eq. 26",
    text="scuffing temperature of oil and material",
    ge=-70,
    le=1500,
    tolerance=20,
)
