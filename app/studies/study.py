"""What all studies share: the first line, the solution of points in order."""

from abc import ABC, abstractmethod
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import aclosing
from dataclasses import dataclass
from typing import Any

from app.errors import Unprocessable
from app.evaluate import case_of
from app.schema.fields import Leaf
from app.schema.model import MODEL_VERSION
from app.sources import SOURCES
from app.studies.engine import Pool, Work, in_order
from app.studies.points import Point, Question
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
        self, pool: Pool, clock: Clock, overrides: Callable[[int], Overrides], indices: range
    ) -> AsyncGenerator[tuple[range, list[Point]], None]:
        """Runs of points with their indices, in order."""
        async with aclosing(in_order(pool, Work(self.question, overrides, indices))) as runs:
            async for solved, points in runs:
                clock.done += len(points)
                yield solved, points


def output_header(leaf: Leaf) -> Line:
    """An output in the first line of a study."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    """The dotted paths of fields."""
    return [leaf.path for leaf in leaves]


def case_of_study(path: str, body: StudyRequest | DriveTrainStudy) -> str:
    """The hash of endpoint, body and sources of a study."""
    try:
        return case_of(path, body.model_dump(exclude={"from_index"}), SOURCES)
    except ValueError:  # in a field that every point replaces
        message = "holds a number that is not finite, or text that is not Unicode"
        raise Unprocessable("not_json", message, "request") from None
