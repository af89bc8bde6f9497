"""Heat balance of a gear pair or gear unit: losses, cooling by the oil, and temperatures of flanks and bodies.

The calculation uses the modules in this order: inputs and oil; losses, bearings, fling_off, convection and conduction;
network (nodes and heat flows); solution (equilibrium), calibration (with measured temperatures) and band; results and
notices. `model.solve` calls these modules. `face` has the temperatures along a face, over `rings`. `warm_up`
uses the heat capacities of the nodes, and computes how the temperatures of the nodes change over time. The model is our
own derivation; the docstrings name the sources of single equations.
"""

from solvers.guards import guarded
from solvers.heat_balance import model
from solvers.heat_balance.bearings import Journal, Operation
from solvers.heat_balance.capacities import Capacities, cylinders_capacity, loaded_teeth_capacity
from solvers.heat_balance.conduction import rod_conductance
from solvers.heat_balance.fling_off import TOOTH_HEIGHT
from solvers.heat_balance.flow_curve import FlowCurve, over_the_flow
from solvers.heat_balance.inputs import Casing, Cooling, Measured
from solvers.heat_balance.losses import MeshHeat, share_to_pinion
from solvers.heat_balance.model import (
    GearGeometry,
    HeatBalanceInputs,
    backlash_loss,
    calibrated,
    cooling_in_force,
    network_of,
    unusual_values,
)
from solvers.heat_balance.oil import CoolingOil, cooling_oil
from solvers.heat_balance.results import Heat
from solvers.heat_balance.warm_up import WarmUp, warm_up

solve = guarded(model.solve, unusual_values)

__all__ = [
    "TOOTH_HEIGHT",
    "Capacities",
    "Casing",
    "Cooling",
    "CoolingOil",
    "FlowCurve",
    "GearGeometry",
    "Heat",
    "HeatBalanceInputs",
    "Journal",
    "Measured",
    "MeshHeat",
    "Operation",
    "WarmUp",
    "backlash_loss",
    "calibrated",
    "cooling_in_force",
    "cooling_oil",
    "cylinders_capacity",
    "loaded_teeth_capacity",
    "network_of",
    "over_the_flow",
    "rod_conductance",
    "share_to_pinion",
    "solve",
    "warm_up",
]
