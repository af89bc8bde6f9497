"""What all kinds of study check before their first line."""

from typing import Any

from app.calculations import BY_PATH, Calculation
from app.problems import Unprocessable
from app.reading import InvalidBody, validated
from app.schema.base import Request
from app.schema.cases import case_of
from app.sources import SOURCES
from app.studies.points import with_overrides
from app.studies.requests import Overrides, StudyRequest
from app.studies.unit_requests import UnitStudy


def calculation_of(study: StudyRequest | UnitStudy) -> Calculation:
    """The calculation that a study asks."""
    if study.endpoint not in BY_PATH:
        raise Unprocessable("unknown_endpoint", f"there are {', '.join(BY_PATH)}", "endpoint")
    return BY_PATH[study.endpoint]


def checked_base(calculation: Calculation, base: dict[str, Any], first: Overrides) -> Request:
    """The base request with the first point inserted; InvalidBody with pointers into the study.

    What the schema allows and physics does not is a refused point.
    """
    try:
        return validated(calculation.request, with_overrides(calculation, base, first))
    except InvalidBody as error:
        found = [fault._replace(pointer=f"/request{fault.pointer}") for fault in error.faults]
        raise InvalidBody(found) from None


def case_of_study(path: str, study: StudyRequest | UnitStudy) -> str:
    """The hash of a study; equal for equal numbers."""
    try:
        return case_of(path, study.model_dump(), SOURCES)
    except ValueError:  # in a field that every point replaces
        message = "holds a number that is not finite, or text that is not Unicode"
        raise Unprocessable("not_json", message, "request") from None
