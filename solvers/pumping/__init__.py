"""Air and mist pumped by meshing teeth.

Data pass through the modules in this order: inputs, checks -> space -> flow -> one of the flow models (gas, chain,
incompressible) -> resolution, lead_correction, pulsation. `space` describes shape, section and stroke of a tooth space,
and divides the face into the stretches between the grooves. `flow` holds what all flow models use: the properties of
the gas, the duct, and the records of a calculation. `spaces` prepares everything that does not depend on the speed, and
calls the flow model. `model`, `choking` and `speed_scan` use `spaces`.
"""

from solvers.guards import guarded
from solvers.pumping import choking, model
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
from solvers.pumping.notices import unusual_values
from solvers.pumping.results import ChokingSpeeds, PumpingResult

solve = guarded(model.solve, unusual_values)
choking_speeds = guarded(choking.choking_speeds, unusual_values)


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
