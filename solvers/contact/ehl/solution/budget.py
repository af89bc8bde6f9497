"""How finely a contact is resolved, and how many Newton steps that may take."""

from dataclasses import dataclass
from math import inf

STEPS_A_SOLVE = 60
STEPS_IN_ALL = 500.0  # in Newton steps at 121 x 21 nodes, about a quarter of a second
STEPS_ON_FINEST = 25  # that even a very fine mesh is given
STEPS_TO_REFINE = 100.0  # in the same units, for each contact on finer meshes


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
    """Newton steps left, in units of a step at 121 x 21 nodes; it bounds every solve.

    What is spent of a part is spent of the whole it is a part `of`.
    """

    remaining: float
    spent: int = 0
    of: "Budget | None" = None

    def part(self, most: float = inf) -> "Budget":
        """A budget within this one, of at most so many units."""
        return Budget(min(most, self.remaining), of=self)

    def steps(self, resolution: Resolution, nodes: int) -> int:
        """Steps affordable at `nodes` nodes, at most those of one solve."""
        return min(STEPS_A_SOLVE, int(self.remaining / price(resolution, nodes)))

    def charge(self, resolution: Resolution, nodes: int, steps: int) -> None:
        """Pay for Newton steps taken."""
        self.pay(steps * price(resolution, nodes), steps)

    def pay(self, units: float, steps: int = 0) -> None:
        """Pay for work, and count the Newton steps in it."""
        self.remaining -= units
        self.spent += steps
        if self.of is not None:
            self.of.pay(units, steps)


def budget_for(resolution: Resolution) -> Budget:
    """What one contact may take."""
    return Budget(max(STEPS_IN_ALL, STEPS_ON_FINEST * price(resolution, resolution.nodes)))


def price(resolution: Resolution, nodes: int) -> float:
    """Time of a step over that of one at 121 x 21 nodes: columns, dense products, dense factors (fitted)."""
    relative = nodes / 121
    if resolution.thermal:
        return relative**2 * (0.4 + 0.4 * resolution.film_nodes / 21 + 0.2 * relative)
    return relative**2 * (0.1 + 0.1 * relative)
