"""Gear couplings after Pahl.

Data flow: inputs -> geometry -> kinematics -> tooth loads -> lubrication -> friction -> axial thrust -> losses; the
sleeve's orbit needs the tooth loads alone, the recommended crowning the lubrication.
"""

from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.recommendation import recommend

__all__ = ["recommend", "solve", "solve_orbit"]
