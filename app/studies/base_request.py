"""The request that a study varies, and the checks of what the study names in it and in its answer."""

import copy
from collections.abc import Sequence
from typing import Any, NamedTuple, Self

from app.calculations import BY_PATH, Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import calculation_at
from app.schema.fields import Leaf, headlines
from app.schema.model import Request
from app.schema.reading import validated
from app.studies.fields import fault, is_reachable, scalar_at, set_value
from app.studies.points import Question, with_overrides
from app.studies.requests import DRIVE_TRAIN, DriveTrainStudy, Overrides, Scalar, StudyRequest

COLD = "states.cold."
BY_FILM = {
    DRIVE_TRAIN: {"safety.minimum"},
    "/v1/scuffing": {"film.min_at_psi", "film.thickness_ratio", "unsolved_points"},
}
"""The outputs of an endpoint that need the thermal film, beside those named after it."""


class BaseRequest(NamedTuple):
    """An endpoint and the request to it; the methods raise Unprocessable at `place` of the study."""

    calculation: Calculation
    body: dict[str, Any]

    @classmethod
    def of(cls, study: StudyRequest | DriveTrainStudy) -> Self:
        """The request of a study."""
        return cls(calculation_at(study.endpoint), study.request)

    def leaf(self, path: str, place: str) -> Leaf:
        """The single value at a path of the request, where it can be set."""
        leaf = scalar_at(self.calculation.request, path, place, "unknown_path")
        if not is_reachable(self.calculation.request, self.body, path):
            raise Unprocessable("unknown_path", f"the request has no {path}: its list is shorter", place)
        return leaf

    def output(self, path: str, place: str) -> Leaf:
        """The single value at a path of the answer."""
        leaf = scalar_at(self.calculation.response, path, place, "unknown_output")
        if leaf.detail != "summary":
            raise Unprocessable("not_scalar", f"{path} belongs to a curve or field; a study has single values", place)
        return leaf

    def outputs(self, wanted: list[str] | None) -> tuple[Leaf, ...]:
        """The outputs at these paths, by default the headline numbers."""
        if wanted is None:
            return headlines(self.calculation.response)
        check_distinct(wanted, "outputs", numbered=True)
        return tuple(self.output(path, f"outputs.{number}") for number, path in enumerate(wanted))

    def checked(self, first: Overrides) -> Request:
        """The request with the first point inserted; raises InvalidBody with pointers into the study.

        A request that the schema allows and the solver refuses is a refused point.
        """
        try:
            return validated(self.calculation.request, with_overrides(self.calculation, self.body, first))
        except InvalidBody as error:
            found = [each._replace(pointer=f"/request{each.pointer}") for each in error.faults]
            raise InvalidBody(found) from None

    def question(self, outputs: Sequence[str], deadline_s: float, *, reduced: bool = False) -> Question:
        """What is the same at every point; `reduced` leaves out what the outputs do not need."""
        path = self.calculation.path
        return Question(path, reduced_request(path, self.body, outputs) if reduced else self.body, outputs, deadline_s)


def needs_film(endpoint: str, output: str) -> bool:
    """Whether an output needs the thermal film, which costs more than everything else."""
    return "thermal_ehl" in output or output.removeprefix(COLD) in BY_FILM[endpoint]


def reduced_request(endpoint: str, request: dict[str, Any], outputs: Sequence[str]) -> dict[str, Any]:
    """The request without thermal film and other states where no output needs them; the outputs are the same."""
    if endpoint not in BY_FILM:
        return request
    reduced = copy.deepcopy(request)
    if not any(needs_film(endpoint, path) for path in outputs):
        set_value(BY_PATH[endpoint].request, reduced, "model.lubrication", "closed_form")
    if not any(path.startswith(COLD) for path in outputs):
        reduced.pop("states", None)
    return reduced


def check_count(count: int, most: int, place: str) -> None:
    """Refuse a study of too many points."""
    if count > most:
        raise Unprocessable("too_many_points", f"the study has {count} points; the limit is {most}", place)


def check_distinct(paths: Sequence[str], place: str, *, numbered: bool = False) -> None:
    """Refuse a path that is given twice, where `numbered` at its own place in the list."""
    for number, path in enumerate(paths):
        if path in paths[:number]:
            raise Unprocessable("duplicate_path", f"{path} is given twice", f"{place}.{number}" if numbered else place)


def check_value(leaf: Leaf, value: Scalar, place: str) -> None:
    """Refuse a value that the field's schema does not take."""
    found = fault(leaf, value)
    if found is not None:
        code, message = found
        raise Unprocessable(code, f"{leaf.path}: {message}", place)
