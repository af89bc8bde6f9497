"""Gear couplings after Pahl.

Data flows inputs, checks -> teeth (geometry, motion, shares of the load) -> lubrication, losses -> sleeve, thrust ->
load_distribution, notices; `model.solve` calls them all. The sleeve's orbit needs the teeth alone; crowning calls the
model to recommend a crowning ratio.
"""

from solvers.coupling import model, orbit
from solvers.coupling.crowning import recommendation
from solvers.coupling.notices import slips
from solvers.plausibility import warned

solve = warned(model.solve, slips)
solve_orbit = warned(orbit.solve_orbit, slips)
recommend = warned(recommendation.recommend, slips)

__all__ = ["recommend", "solve", "solve_orbit"]
