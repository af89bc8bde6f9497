"""Air and mist pumped by meshing teeth.

Data flows inputs, checks -> space (tooth space, its section, the stroke table; the face between grooves) -> flow (gas,
duct, record) -> one of gas, chain and incompressible -> resolution, lead_correction, pulsation (all called by
`model.solve`). `spaces` prepares everything that does not depend on the speed, and calls the flow model. `model`,
`choking` and `speed_scan` build on it.
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
