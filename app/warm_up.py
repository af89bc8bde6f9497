"""The examples that between them touch every compiled kernel, so that no request pays for loading one."""

from functools import cache

from app.calculations import CALCULATIONS
from app.figures.rendering import render
from app.formats.json import answer
from app.library import examples

WARMING = (
    "pahl-axial-displacement",
    "pahl-sleeve-orbit",
    "pahl-z-arrangement",
    "milian-case-1",
    "milian-case-1-choking",
    "milian-case-1-groove",
    "milian-case-1-pocket-chain",
    "milian-table-1-incompressible",
    "fzg-type-a",
    "xue-line-contact",
    "xue-line-contact-isothermal",
    "xue-pair-1-modified",
)
DRAWN = "pahl-z-arrangement"  # loads what draws figures


@cache
def warm_up() -> None:
    """Answer them, once in a process; runs in each worker as it starts."""
    calculations = {calculation.path: calculation for calculation in CALCULATIONS}
    for name in WARMING:
        example = examples()[name]
        calculation = calculations[example.endpoint]
        request = calculation.request.model_validate(example.request)
        answer(calculation, request)
        if name == DRAWN:
            render(calculation, calculation.figures[0], request, "svg", "light")


if __name__ == "__main__":
    warm_up()
