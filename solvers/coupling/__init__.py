"""Gear couplings after Pahl.

Data flows inputs, checks -> teeth (geometry, motion, shares of the load) -> lubrication, losses -> sleeve, thrust ->
load_distribution, notices; `model.solve` calls them all. The sleeve's orbit needs the teeth alone; crowning calls the
model to recommend a crowning ratio.
"""

from solvers.coupling.crowning.recommendation import recommend
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit

__all__ = ["recommend", "solve", "solve_orbit"]
