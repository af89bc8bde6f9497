"""Air and mist pumped by meshing teeth: gear pair, tooth space, stroke table, flow, heating and power."""

from solvers.pumping.choking import choking_speeds
from solvers.pumping.inputs import (
    Ambient,
    ChokingInputs,
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
from solvers.pumping.results import ChokingSpeeds, PumpingResult

__all__ = [
    "Ambient",
    "ChokingInputs",
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
