"""Load distribution of helical gears with modifications and misalignment, and their scuffing safety.

Data flows inputs -> flank (contact lines, the gap over the plane of action), teeth (how a pair of them yields) ->
balance (approach of the flanks at every roll position, and the load it leaves) -> distribution (what that load says;
gathered, with notices, by `model.solve`) -> thermal (friction, temperatures and film along a line of the flank;
gathered by `safety.solve_scuffing`).

Source: Xue, Zhang, Wang, "The Load Distribution with Modification and Misalignment and Thermal Elastohydrodynamic
Lubrication Simulation of Helical Gears", Global J. of Researches in Engineering A 20(1), 2020 ("the paper").
"""

from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety import solve_scuffing

__all__ = ["solve_load_distribution", "solve_scuffing"]
