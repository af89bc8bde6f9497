"""Figure of a sensitivity study: which inputs move an output most."""

from dataclasses import dataclass

from app.figures.data import Axis, Figure, Hue, Panel, Row
from app.figures.wording import listed, number

MOST_ROWS = 12
NAMED = 3  # in the finding


@dataclass(frozen=True, slots=True)
class Influence:
    """What one step of an input changes, and whether the two sides disagree."""

    name: str
    step: str
    change: float
    kink: bool


def influence(output: Axis, value: float, found: list[Influence]) -> Figure:
    """Lying bars, the most influential input first; in a second hue where the slope depends on the side."""
    moving = [each for each in found if each.change][:MOST_ROWS]
    rows = tuple(
        Row(f"{each.name}, {each.step}", each.change, Hue.VERMILLION if each.kink else Hue.BLUE) for each in moving
    )
    title = f"What moves the {output.title} most"
    if not rows:
        return Figure("nothing does", (), title=title)
    kinks = "; where the bar is red, up and down differ" if any(each.kink for each in moving) else ""
    finding = f"{number(value, output.unit or '')} now; {listed([each.name for each in moving[:NAMED]])} first{kinks}"
    axis = Axis(f"change of the {output.title} by one step up, from the steeper side", output.unit)
    return Figure(finding, (Panel(x=axis, y=axis, rows=rows),), title=title)
