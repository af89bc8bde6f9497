"""The outputs of a calculation that a study can show, and the menu of them."""

from app.calculations import Calculation
from app.errors import Unprocessable
from app.pages.results import NOT_RESULTS
from app.pages.studies.declaration import Choice
from app.schema.fields import ITEM, Leaf, headlines, leaves, tree
from app.studies.fields import NUMBERS, scalar_at


def output_choices(calculation: Calculation) -> list[Choice]:
    """Every number of the answer that a study can show, the headlines first."""
    response = calculation.response
    first = headlines(response)
    titles = {branch.path: branch.title for branch in tree(response).branches}
    found = [(leaf, "numbers that decide") for leaf in first]
    found += [
        (leaf, titles.get(leaf.path.partition(".")[0], "result")) for leaf in leaves(response) if leaf not in first
    ]
    return [
        Choice(leaf.path, f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title, group)
        for leaf, group in found
        if _can_be_shown(leaf)
    ]


def _can_be_shown(leaf: Leaf) -> bool:
    whole = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in leaf.path.split(".")
    return whole and leaf.path.partition(".")[0] not in NOT_RESULTS


def output_at(calculation: Calculation, path: str | None) -> Leaf:
    """The output at a path, or the first headline where none is given; raises Unprocessable."""
    output = scalar_at(
        calculation.response, path or headlines(calculation.response)[0].path, "outputs.0", "unknown_output"
    )
    if output.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{output.path} is no number", "outputs.0")
    return output
