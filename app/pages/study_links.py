"""The studies of a case that have a page of their own: the links to them."""

from typing import NamedTuple

from app.calculations import Calculation
from app.studies.requests import DRIVE_TRAIN


class StudyLink(NamedTuple):
    """The last part of the address of a study's page, the label of the link to it, and a description."""

    name: str
    label: str
    hint: str


VARY = StudyLink("vary", "Vary", "one input or two over a range: a curve or a map")
SENSITIVITY = StudyLink("influence", "What matters", "every input moved by its tolerance: which moves the result most")
SPECTRUM = StudyLink(
    "spectrum", "Load spectrum", "cases and tolerances: the probability of exceeding a limit, and the mean losses"
)
CORNERS = StudyLink("corners", "Worst corner", "every combination of the uncertain inputs: where the result is worst")
DESIGN = StudyLink("design", "What to grind", "the flank correction whose worst corner is best")


def study_links(calculation: Calculation) -> tuple[StudyLink, ...]:
    """The studies that cases of a calculation have."""
    return (VARY, SENSITIVITY, SPECTRUM, *((CORNERS, DESIGN) if calculation.path == DRIVE_TRAIN else ()))
