"""The examples that between them touch every compiled kernel, so that no request pays for loading one."""

from functools import cache

from app.calculations import CALCULATIONS
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


@cache
def warm_up() -> None:
    """Answer them, once in a process; runs in each worker as it starts."""
    calculations = {calculation.path: calculation for calculation in CALCULATIONS}
    for name in WARMING:
        example = examples()[name]
        calculation = calculations[example.endpoint]
        answer(calculation, calculation.request.model_validate(example.request))


if __name__ == "__main__":
    warm_up()
