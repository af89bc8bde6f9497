"""What all studies share: the checks of a body, the first line, the solution of points in order."""

from abc import ABC, abstractmethod
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import aclosing
from dataclasses import dataclass
from typing import Any

from app.calculations import BY_PATH, Calculation
from app.errors import InvalidBody, Unprocessable
from app.schema.base import MODEL_VERSION, Request
from app.schema.fields import Leaf, headlines
from app.schema.reading import validated
from app.sources import SOURCES, case_of
from app.studies.engine import Pool, Work, in_order
from app.studies.fields import scalar_at
from app.studies.points import Point, Question, with_overrides
from app.studies.requests import DriveTrainStudy, Overrides, StudyRequest
from app.studies.stream import Clock, Line, Lines


@dataclass(frozen=True, slots=True, kw_only=True)
class Study(ABC):
    """A study that has passed its checks; `outputs` are in the order of the columns of `Point.out`."""

    question: Question
    outputs: tuple[Leaf, ...]
    case: str

    @property
    @abstractmethod
    def total(self) -> int:
        """How many points it has at most."""

    @abstractmethod
    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress."""

    def header(self, kind: str, **content: Any) -> Line:
        """A line that identifies the study."""
        return {
            "type": kind,
            "endpoint": self.question.endpoint,
            **content,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
        }

    async def solve(
        self, pool: Pool, clock: Clock, overrides: Callable[[int], Overrides], total: int
    ) -> AsyncGenerator[tuple[range, list[Point]], None]:
        """Runs of points with their indices, in order."""
        before = clock.done
        async with aclosing(in_order(pool, Work(self.question, overrides, total))) as runs:
            async for indices, points in runs:
                clock.done = before + indices.stop
                yield indices, points


def output_header(leaf: Leaf) -> Line:
    """An output in the first line of a study."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    """The dotted paths of fields."""
    return [leaf.path for leaf in leaves]


def calculation_of(body: StudyRequest | DriveTrainStudy) -> Calculation:
    """The calculation that a study is about."""
    if body.endpoint not in BY_PATH:
        raise Unprocessable("unknown_endpoint", f"there are {', '.join(BY_PATH)}", "endpoint")
    return BY_PATH[body.endpoint]


def outputs_at(calculation: Calculation, wanted: list[str] | None) -> tuple[Leaf, ...]:
    """The outputs at these paths, by default the headline numbers; raises Unprocessable."""
    if wanted is None:
        return headlines(calculation.response)
    for place, path in enumerate(wanted):
        if path in wanted[:place]:
            raise Unprocessable("duplicate_path", f"{path} is asked for twice", f"outputs.{place}")
    return tuple(output_at(calculation, path, f"outputs.{place}") for place, path in enumerate(wanted))


def output_at(calculation: Calculation, path: str, place: str) -> Leaf:
    """The single value of an answer at a path; raises Unprocessable at `place` of the study."""
    leaf = scalar_at(calculation.response, path, place, "unknown_output")
    if leaf.detail != "summary":
        raise Unprocessable("not_scalar", f"{path} belongs to a curve or field, which a study does not tell", place)
    return leaf


def checked_base(calculation: Calculation, base: dict[str, Any], first: Overrides) -> Request:
    """The base request with the first point inserted; raises InvalidBody with pointers into the study.

    A request that the schema allows and the solver refuses is a refused point.
    """
    try:
        return validated(calculation.request, with_overrides(calculation, base, first))
    except InvalidBody as error:
        found = [fault._replace(pointer=f"/request{fault.pointer}") for fault in error.faults]
        raise InvalidBody(found) from None


def case_of_study(path: str, body: StudyRequest | DriveTrainStudy) -> str:
    """The hash of endpoint, body and sources of a study."""
    try:
        return case_of(path, body.model_dump(exclude={"from_index"}), SOURCES)
    except ValueError:  # in a field that every point replaces
        message = "holds a number that is not finite, or text that is not Unicode"
        raise Unprocessable("not_json", message, "request") from None
