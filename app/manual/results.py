"""The places in the manual that say how the results are computed.

A place is a numbered equation, or a section if no equation defines the result. Results without an equation are, for
example, counts, the settings that were used, and measures of convergence.
"""

from functools import cache
from typing import NamedTuple

from app.manual.equations import equations
from solvers.quantity import Quantity


class Place(NamedTuple):
    """A place in the manual: the text of a link to the place, its address, and its chapter."""

    text: str
    address: str
    chapter: str


@cache
def place_of(declared: Quantity) -> Place | None:
    """Return the place in the manual that says how a result is computed, or None if no solver declares the result."""
    if declared.equation is None:
        return None
    chapter, _, section = declared.equation.partition("#")
    if section:
        return Place(f"section {section.replace('-', ' ')}", f"/manual/{declared.equation}", chapter)
    equation = equations()[declared.equation]
    return Place(f"Eq. {equation.number}", equation.address, equation.chapter)
