"""What every kind of study is once it has passed its checks."""

from typing import Protocol

from app.studies.engine import Pool
from app.studies.points import Question
from app.studies.stream import Clock, Lines


class Study(Protocol):
    """A study that has passed its checks."""

    @property
    def question(self) -> Question:
        """What is the same at every point."""

    @property
    def total(self) -> int:
        """How many points it has at most."""

    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress."""
