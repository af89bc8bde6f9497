"""Declaration of a figure without a case: its name, and the function that makes its data."""

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

    `build` makes the data from the solver's inputs, in SI, and from its result with all quantities in the units in
    which they are shown. If the figure needs more than the result, `compute` calculates it from both, and `build` takes
    it as a third argument.

    A page leaves out a figure that is `shown_at` the page of another calculation, given by its path. It also leaves out
    a figure whose section or value `asked_by` is absent from the request, or differs from `asked_value` if that is
    given.
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
        """Return the figure of a case. Raises NoFigure if there is nothing to show."""
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
    """Return a part of a result. Raises NoFigure if it is None, that is, if the case has no solution."""
    if part is None:
        raise NoFigure("no_solution", "The answer lacks what this figure shows, so there is nothing to draw")
    return part
