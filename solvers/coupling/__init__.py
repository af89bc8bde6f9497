"""Gear couplings after Pahl.

Data flows inputs, checks -> teeth (geometry, motion, shares of the load) -> friction (film, regimes, losses) -> sleeve
(balance of two meshes, axial thrust), all gathered with load_distribution and notices by `model.solve`. The sleeve's
orbit needs the teeth alone; on top of the model stands crowning, which recommends.
"""

from solvers.coupling.crowning.recommendation import recommend
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit

__all__ = ["recommend", "solve", "solve_orbit"]
