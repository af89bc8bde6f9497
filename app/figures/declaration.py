"""What a figure is before there is a case: its name, and the function that makes its data."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from app.figures.data import Figure, NoFigure
from solvers.quantity import Detail

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Declaration:
    """One figure of an endpoint.

    `build` is pure: (request, answer) to data, with the answer at the level of `detail`; where the answer does not hold
    what the figure shows, `compute` finds it from the request, and `build` takes it as a third argument.
    """

    name: str
    title: str
    source: str
    build: Callable[..., Figure]
    detail: Detail = "curves"
    compute: Callable[[Any, Any], Any] | None = None

    def figure(self, request: Any, answer: Any) -> Figure:
        """The figure of a case. `Raises NoFigure where there is nothing to show."""
        if answer.status == "no_solution":
            raise NoFigure("no_solution", "The calculation has no solution, so there is nothing to draw")
        computed = () if self.compute is None else (self.compute(request, answer),)
        figure = self.build(request, answer, *computed)
        return replace(figure, title=figure.title or self.title, source=self.source)


def present(part: T | None) -> T:
    """A part of an answer that a solved case has at this level of detail."""
    if part is None:
        raise NoFigure("no_solution", "The answer lacks what this figure shows, so there is nothing to draw")
    return part
