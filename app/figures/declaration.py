"""Declarations of figures. A declaration names a figure and holds the function that makes the figure's data."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, TypeVar

from app.figures.data import Figure, NoFigure
from app.figures.units import shown
from app.schema.answers import Response
from app.schema.model import Request

T = TypeVar("T")
Build = Callable[..., Figure]


@dataclass(frozen=True, slots=True)
class Declaration:
    """One figure of an endpoint.

    `build` returns the figure. The first argument of `build` holds the solver's inputs in SI. The second argument holds
    the solver's result, with all quantities in the units in which pages show them. If the figure needs more data than
    the result holds, `compute` calculates these data from the inputs and the result. `build` takes the data from
    `compute` as a third argument.

    If `shown_at` is the path of another calculation, the figure appears on the page of that calculation and not on the
    page of its own calculation. `asked_by` is the path of a section or value of the request. A page leaves out the
    figure if this section or value is absent. If `asked_if` is given, the request's property of this name decides
    instead.
    """

    name: str
    title: str
    source: str
    build: Build
    compute: Callable[[Any, Any], Any] | None = None
    shown_at: str = ""
    asked_by: str = ""
    asked_if: str = ""

    def is_asked(self, request: Request) -> bool:
        """Return True if the request asks for what the figure shows, or if the figure needs no asking."""
        if self.asked_if:
            return bool(getattr(request, self.asked_if))
        return not self.asked_by or attrgetter(self.asked_by)(request) is not None

    def figure(self, request: Request, response: Response) -> Figure:
        """Return the figure of a case; raise NoFigure if there is nothing to show."""
        if response.status == "no_solution":
            raise NoFigure("no_solution", "The calculation has no solution, so there is nothing to draw")
        if not self.is_asked(request):
            wanted = f"Set {self.asked_by} to heat_balance" if self.asked_if else f"Give {self.asked_by}"
            raise NoFigure("not_asked", f"{wanted} to have this figure", self.asked_by)
        inputs, result = request.inputs(), shown(response.result)
        computed = () if self.compute is None else (self.compute(inputs, result),)
        figure = self.build(inputs, result, *computed)
        return replace(figure, title=figure.title or self.title, source=self.source)


def present(part: T | None) -> T:
    """Return a part of a result. Raise NoFigure if the part is None, that is, if the case has no solution."""
    if part is None:
        raise NoFigure(
            "no_solution", "The answer does not contain the values that this figure shows, so there is nothing to draw"
        )
    return part
