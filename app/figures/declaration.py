"""What a figure is before there is a case: its name, and the function that makes its data."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, TypeVar

from app.figures.data import Figure, NoFigure
from app.figures.units import shown
from app.schema.model import Request, Response

T = TypeVar("T")
Build = Callable[..., Figure]


@dataclass(frozen=True, slots=True)
class Declaration:
    """One figure of an endpoint.

    `build` makes the data of the solver's inputs, in SI, and of its result with every quantity in the unit in which it
    is shown. Where the result does not hold what the figure shows, `compute` finds it from both, and `build` takes it
    as a third argument. A page leaves out what is `shown_at` the page of another calculation, given by its path, and
    what a request without the section or value `asked_by`, or with another value there than `asked_value`, does not ask
    for.
    """

    name: str
    title: str
    source: str
    build: Build
    compute: Callable[[Any, Any], Any] | None = None
    shown_at: str = ""
    asked_by: str = ""
    asked_value: str = ""

    def is_asked(self, request: Request) -> bool:
        """Return True if the request has the section or value that the figure needs."""
        if not self.asked_by:
            return True
        value = attrgetter(self.asked_by)(request)
        return value == self.asked_value if self.asked_value else value is not None

    def figure(self, request: Request, response: Response) -> Figure:
        """The figure of a case. Raises NoFigure where there is nothing to show."""
        if response.status == "no_solution":
            raise NoFigure("no_solution", "The calculation has no solution, so there is nothing to draw")
        if not self.is_asked(request):
            wanted = (
                f"Set {self.asked_by} to {self.asked_value}"
                if self.asked_value
                else f"Give the section {self.asked_by}"
            )
            raise NoFigure("not_asked", f"{wanted} to have this figure", self.asked_by)
        inputs, result = request.inputs(), shown(response.result)
        computed = () if self.compute is None else (self.compute(inputs, result),)
        figure = self.build(inputs, result, *computed)
        return replace(figure, title=figure.title or self.title, source=self.source)


def present(part: T | None) -> T:
    """A part of a result that a solved case has."""
    if part is None:
        raise NoFigure("no_solution", "The answer lacks what this figure shows, so there is nothing to draw")
    return part
