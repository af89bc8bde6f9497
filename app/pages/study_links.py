"""The studies of a case that have a page of their own: the links to them."""

from typing import NamedTuple

from app.calculations import Calculation
from app.studies.requests import DRIVE_TRAIN


class StudyLink(NamedTuple):
    """A study with a page below that of the case: the last part of its address, its link, and what that means."""

    name: str
    label: str
    hint: str


SENSITIVITY = StudyLink("influence", "What matters", "every input moved a little: which moves the result most")
CORNERS = StudyLink("corners", "Worst corner", "every combination of what nobody knows better: where it is worst")
DESIGN = StudyLink("design", "What to grind", "the correction of the flank that is best where it is worst")


def study_links(calculation: Calculation) -> tuple[StudyLink, ...]:
    """The studies that cases of a calculation have."""
    return (SENSITIVITY, CORNERS, DESIGN) if calculation.path == DRIVE_TRAIN else (SENSITIVITY,)
