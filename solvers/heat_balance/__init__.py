"""Heat balance of a gear pair or gear unit: losses, the oil that cools, and the temperatures of flanks and bodies.

Data flows inputs, oil -> losses, bearings, fling_off -> network (nodes and flows of heat) -> solution (equilibrium),
calibration (by measured temperatures), band -> results, notices; `model.solve` calls these. Own derivation; sources are
given with the equations.
"""

from solvers.heat_balance.bearings import Journal, Operation, journal_leakage, rod_conductance
from solvers.heat_balance.inputs import Casing, Cooling, Measured
from solvers.heat_balance.losses import MeshHeat, share_to_pinion
from solvers.heat_balance.model import GearGeometry, HeatBalanceInputs, backlash_loss, solve
from solvers.heat_balance.oil import CoolingOil, cooling_oil
from solvers.heat_balance.results import Heat

__all__ = [
    "Casing",
    "Cooling",
    "CoolingOil",
    "GearGeometry",
    "Heat",
    "HeatBalanceInputs",
    "Journal",
    "Measured",
    "MeshHeat",
    "Operation",
    "backlash_loss",
    "cooling_oil",
    "journal_leakage",
    "rod_conductance",
    "share_to_pinion",
    "solve",
]
