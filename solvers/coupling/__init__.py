"""Gear couplings after Pahl.

The data flow through the modules in this order: inputs -> kinematics -> tooth_loads -> lubrication -> sleeve (only with
two meshes) -> friction (thrust, losses) -> notices. `model.solve` calls all these modules. The orbit of the sleeve
(`orbit`) needs only kinematics and tooth_loads. `crowning` calls the model to recommend a crowning ratio.
All inputs are in SI units. If an input lies outside its declared range, the functions exported here raise InvalidInput
with the name of the input.
"""

from solvers.coupling import crowning, model, orbit
from solvers.coupling.crowning import Recommendation
from solvers.coupling.inputs import (
    Coupling,
    CouplingInputs,
    Friction,
    Lubricant,
    MixedFrictionCurve,
    MixedFrictionTable,
    ModelOptions,
    Operation,
    RecommendationInputs,
    tilt_of_offset,
)
from solvers.coupling.notices import unusual_values
from solvers.coupling.results import CouplingResult, OrbitResult
from solvers.guards import guarded

solve = guarded(model.solve, unusual_values)
solve_orbit = guarded(orbit.solve_orbit, unusual_values)
recommend = guarded(crowning.recommend, unusual_values)

__all__ = [
    "Coupling",
    "CouplingInputs",
    "CouplingResult",
    "Friction",
    "Lubricant",
    "MixedFrictionCurve",
    "MixedFrictionTable",
    "ModelOptions",
    "Operation",
    "OrbitResult",
    "Recommendation",
    "RecommendationInputs",
    "recommend",
    "solve",
    "solve_orbit",
    "tilt_of_offset",
]
