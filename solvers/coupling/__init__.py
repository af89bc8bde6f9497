"""Gear couplings after Pahl: kinematics, tooth loads, lubrication, friction, axial thrust, losses."""

from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.recommendation import recommend

__all__ = ["recommend", "solve", "solve_orbit"]
