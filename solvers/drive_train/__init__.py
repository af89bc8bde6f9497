"""A complete gear unit: couplings, shafts in bearings, pumping heat and mesh, solved for one gap over the face.

Data flows inputs, checks -> shafts (shafts, bearings and couplings as one flexibility matrix) -> gap (its equilibrium
with the mesh, and its parts by cause) -> elements, losses, safety. `model.solve` calls all of these and notices;
`states.solve` calls `model.solve` for the hot and for the cold unit. Own derivation; sources are given with the
equations.
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
from solvers.drive_train.notices import unusual_values
from solvers.drive_train.results import DriveTrainResult
from solvers.plausibility import guarded

solve = guarded(states.solve, unusual_values)

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
