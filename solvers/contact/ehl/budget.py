"""How finely a contact is resolved, and how many Newton steps that may take."""

from dataclasses import dataclass

STEPS_A_SOLVE = 60
STEPS_IN_ALL = 500.0  # in Newton steps at 121 x 21 nodes, about a second
STEPS_ON_FINEST = 25  # that even a very fine mesh is given


@dataclass(frozen=True, slots=True)
class Resolution:
    """What meshes to use: graded for a film of `gap` (in b^2/R), `nodes` along, `film_nodes` across it.

    The isothermal film that a thermal one starts from is at `entry_temperature` [K].
    """

    gap: float
    entry_temperature: float
    nodes: int
    film_nodes: int
    thermal: bool


@dataclass(slots=True)
class Budget:
    """Newton steps left, in units of a step at 121 x 21 nodes; it bounds every solve, and every path of them."""

    remaining: float
    spent: int = 0

    def steps(self, resolution: Resolution, nodes: int) -> int:
        """Steps affordable at `nodes` nodes, at most those of one solve."""
        return min(STEPS_A_SOLVE, int(self.remaining / price(resolution, nodes)))

    def charge(self, resolution: Resolution, nodes: int, steps: int) -> None:
        """Pay for steps taken."""
        self.remaining -= steps * price(resolution, nodes)
        self.spent += steps


def budget_for(resolution: Resolution) -> Budget:
    """What one contact may take."""
    return Budget(max(STEPS_IN_ALL, STEPS_ON_FINEST * price(resolution, resolution.nodes)))


def price(resolution: Resolution, nodes: int) -> float:
    """Time of a step over that of one at 121 x 21 nodes: columns, dense products, dense factors (fitted)."""
    relative = nodes / 121
    if resolution.thermal:
        return relative**2 * (0.4 + 0.4 * resolution.film_nodes / 21 + 0.2 * relative)
    return relative**2 * (0.1 + 0.1 * relative)
