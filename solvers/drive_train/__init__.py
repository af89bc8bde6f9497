"""Calculation of a complete gear unit: couplings, shafts, bearings, pumping heat and gear mesh.

`model.solve` solves for the gap between the flanks over the face. `inputs` holds the inputs, and `checks` checks them.
The package `shafts` joins shafts, bearings and couplings into one flexibility matrix. The package `gap` finds the gap
in equilibrium, and the contribution of each cause to the gap. `elements`, `losses` and `safety` compute the results at
this gap, and `notices` computes the warnings. `states.solve` calls `model.solve` for the hot and for the cold unit.
`unit_heat` iterates between the heat balance and the gap, and `warm_up` computes both over time. The derivations are
our own, except where a source is named.
"""

from solvers.drive_train import states, warm_up
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
from solvers.drive_train.unit_heat import sized_flow
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
    "ShaftSection",
    "UnitCoupling",
    "UnitWarmUp",
    "WarmUpInputs",
    "sized_flow",
    "solve",
    "solve_warm_up",
]
