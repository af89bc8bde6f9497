"""Air and mist pumped by meshing teeth: gear pair, tooth space, stroke table, flow, heating and power."""

from solvers.pumping.choking import ChokingSpeeds, choking_speeds
from solvers.pumping.inputs import (
    Ambient,
    Closure,
    Flow,
    Gap,
    Groove,
    PumpingInputs,
    PumpingModel,
    PumpingSetup,
    Spaces,
)
from solvers.pumping.model import solve
from solvers.pumping.results import PumpingResult

__all__ = [
    "Ambient",
    "ChokingSpeeds",
    "Closure",
    "Flow",
    "Gap",
    "Groove",
    "PumpingInputs",
    "PumpingModel",
    "PumpingResult",
    "PumpingSetup",
    "Spaces",
    "choking_speeds",
    "solve",
]
