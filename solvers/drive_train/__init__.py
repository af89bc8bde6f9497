"""A complete gear unit: couplings, shafts in bearings, pumping heat and mesh, solved for one gap over the face.

Data flows inputs, checks -> shafts (shafts, bearings and couplings as one flexibility matrix) -> gap (its equilibrium
with the mesh, and its parts by cause) -> elements, losses, safety. `model.solve` calls all of these and notices;
`states.solve` calls `model.solve` for the hot and for the cold unit. `unit_heat` iterates between the heat balance and
the gap, and `warm_up` follows both over time. Own derivation; sources are given with the equations.
"""

from solvers.drive_train import states, warm_up
from solvers.drive_train.former import ShaftBearing
from solvers.drive_train.inputs import (
    Alignment,
    Arrangement,
    DriveTrainInputs,
    Effects,
    Heat,
    JournalBearing,
    LinearBearing,
    RigidBearing,
    Shaft,
    ShaftSection,
    UnitCoupling,
)
from solvers.drive_train.notices import unusual_values
from solvers.drive_train.results import DriveTrainResult
from solvers.drive_train.warm_up import UnitWarmUp, WarmUpInputs
from solvers.guards import guarded

solve = guarded(states.solve, unusual_values)
solve_warm_up = guarded(warm_up.solve, warm_up.unusual_values)

__all__ = [
    "Alignment",
    "Arrangement",
    "DriveTrainInputs",
    "DriveTrainResult",
    "Effects",
    "Heat",
    "JournalBearing",
    "LinearBearing",
    "RigidBearing",
    "Shaft",
    "ShaftBearing",
    "ShaftSection",
    "UnitCoupling",
    "UnitWarmUp",
    "WarmUpInputs",
    "solve",
    "solve_warm_up",
]
