"""Which studies a case has a page for: what the links to them say."""

from typing import NamedTuple

from app.calculations import Calculation
from app.studies.requests import DRIVE_TRAIN


class Offer(NamedTuple):
    """A study with a page below that of the case: the last part of its address, its link, and what that means."""

    name: str
    label: str
    hint: str


INFLUENCE = Offer("influence", "What matters", "every input moved a little: which moves the result most")
CORNERS = Offer("corners", "Worst corner", "every combination of what nobody knows better: where it is worst")
DESIGN = Offer("design", "What to grind", "the correction of the flank that is best where it is worst")


def offers_of(calculation: Calculation) -> tuple[Offer, ...]:
    """The studies that cases of a calculation have."""
    return (INFLUENCE, CORNERS, DESIGN) if calculation.path == DRIVE_TRAIN else (INFLUENCE,)
