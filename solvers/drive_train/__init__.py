"""A gear unit whole: coupling, shafts in bearings, pumped heat and mesh agree on one gap over the face.

Data flows inputs, checks -> shafts (with bearings and couplings one system, known by its ports) -> gap (its balance
with the mesh, and what it comes from) -> elements, losses, safety; all called, with notices, by `model.solve`, for
the hot unit and the cold one by `states.solve`. On top stand studies of many units.
Own derivation; sources stand with the equations.
"""

from solvers.drive_train import states
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
    ShaftBearing,
    ShaftSection,
    UnitCoupling,
)
from solvers.drive_train.notices import slips
from solvers.drive_train.results import DriveTrainResult
from solvers.plausibility import guarded

solve = guarded(states.solve, slips)

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
    "solve",
]
