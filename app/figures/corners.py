"""Figure of a study of corners: what each choice of each uncertain input can lead to."""

from dataclasses import dataclass

from app.figures.data import Axis, Figure, Hue, Panel, Row
from app.figures.wording import number


@dataclass(frozen=True, slots=True)
class Uncertain:
    """An uncertain input at one of its values: the worst output with it, and whether the worst corner of all has it."""

    name: str
    choice: str
    worst: float
    decides: bool


def corners(output: Axis, found: list[Uncertain]) -> Figure:
    """Lying bars, input by input; those that meet in the worst corner in a second hue."""
    rows = tuple(
        Row(f"{each.name} {each.choice}", each.worst, Hue.VERMILLION if each.decides else Hue.BLUE) for each in found
    )
    worst = next(each.worst for each in found if each.decides)
    finding = f"worst {number(worst, output.unit or '')}, where the red values meet"
    panel = Panel(x=output, y=Axis("uncertain input"), rows=rows)
    return Figure(finding, (panel,), title="The worst that each value of an uncertain input can lead to")
