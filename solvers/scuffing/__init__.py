"""Load distribution and scuffing safety of helical gears with modifications and misalignment.

`model.solve` computes the load distribution. The calculation uses these modules, in this order: inputs; contact_lines,
modification (the gap over the plane of action) and tooth_stiffness; contact_slices; load_balance (the approach of the
flanks at every roll position); mesh_results and flank_results. `safety.solve_scuffing` also uses the packages thermal
(friction, temperatures and film over the flank) and micropitting. `helices` checks the more loaded helix of a
double-helical pair with both.

Source: Xue, Zhang, Wang, "The Load Distribution with Modification and Misalignment and Thermal Elastohydrodynamic
Lubrication Simulation of Helical Gears", Global J. of Researches in Engineering A 20(1), 2020 ("the paper").
"""

from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.guards import guarded
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet, iso_vg
from solvers.scuffing import helices
from solvers.scuffing.helices import sized_flow
from solvers.scuffing.inputs import (
    LeadCurve,
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    Resolution,
    ScuffingInputs,
    ScuffingTest,
    Temperatures,
)
from solvers.scuffing.notices import unusual_load_values, unusual_scuffing_values
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import Scuffing

solve_load_distribution = guarded(helices.solve_load_distribution, unusual_load_values)
solve_scuffing = guarded(helices.solve_scuffing, unusual_scuffing_values)

__all__ = [
    "GearPairInputs",
    "GearTeeth",
    "LeadCurve",
    "Load",
    "LoadDistribution",
    "LoadDistributionInputs",
    "Lubricant",
    "Model",
    "Modifications",
    "OilSheet",
    "Resolution",
    "Scuffing",
    "ScuffingInputs",
    "ScuffingTest",
    "Temperatures",
    "iso_vg",
    "sized_flow",
    "solve_load_distribution",
    "solve_scuffing",
]
