"""Figure of a design search: what each correction reached at its worst corner, and the best so far."""

from typing import NamedTuple

import numpy as np

from app.figures.data import Axis, Figure, Hue, Line, Mark, Panel, Role, values
from app.figures.wording import number


class Tried(NamedTuple):
    """What a correction reached at its worst corner, and whether it has a solution there."""

    reached: float
    solved: bool


def search(output: Axis, tried: list[Tried], *, greatest: bool) -> Figure:
    """The corrections in the order in which they were tried."""
    reached = np.array([each.reached if each.solved else np.nan for each in tried])
    so_far = np.fmax.accumulate(reached) if greatest else np.fmin.accumulate(reached)
    order = values(np.arange(1, reached.size + 1, dtype=np.float64))
    best = int(np.nanargmax(reached) if greatest else np.nanargmin(reached))
    unit = output.unit or ""
    panel = Panel(
        x=Axis("correction tried", magnitude=False),
        y=Axis(f"{output.title} at the worst corner", output.unit, magnitude=False),
        lines=(
            Line("tried", order, values(reached), Hue.GREY, Role.REFERENCE),
            Line("best so far", order, values(so_far), Hue.BLUE),
        ),
        marks=(Mark(best + 1.0, float(reached[best]), number(float(reached[best]), unit)),),
    )
    finding = f"from {number(float(reached[0]), unit)} to {number(float(reached[best]), unit, digits=4)}"
    unsolved = sum(not each.solved for each in tried)
    return Figure(finding, (panel,), title="What the search reached at the worst corner", unsolved=unsolved)
