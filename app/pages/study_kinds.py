"""The kinds of study as all pages know them: the links to their pages, and the names of their controls in a query.

The pages themselves, in `app.pages.studies`, consist of parts of other pages.
"""

from collections.abc import Iterable
from functools import cache
from itertools import product
from typing import NamedTuple

from app.studies.requests import DRIVE_TRAIN

UNCERTAIN = ("wall response", "pinion clearance", "wheel clearance", "friction", "offset", "thrust fraction")
"""The inputs of a gear unit that can be uncertain."""
BY_CLASS = ("helix slope", "profile slope")
"""What is uncertain by the quality class of the gears, and not while a correction is searched."""
# Some controls have values that are not single numbers.
CORNER = "corner."  # start of the name of a control that lists the values of an uncertain input
CASES = "cases"  # name of the control with the table of cases


class StudyLink(NamedTuple):
    """A link to the page of a kind of study."""

    name: str  # last part of the address
    label: str  # text of the link
    hint: str  # what the study does
    controls: frozenset[str] = frozenset()  # names of the controls of the page, except the menu of outputs
    endpoint: str | None = None  # the only endpoint whose cases have this study; None: all endpoints


def control_of(quantity: str) -> str:
    """Return the name of the form control for an uncertain input."""
    return f"{CORNER}{quantity.replace(' ', '_')}"


def _named(beginnings: Iterable[str], ends: Iterable[str]) -> frozenset[str]:
    return frozenset(map("".join, product(beginnings, ends)))


AXES = ("x", "y")
"""Names of the axes of a sweep in the form."""
ALSO = ("show.2", "show.3", "show.4")
"""Names of the menus of further outputs of a sweep."""
OIL_TESTS = "oil_tests"
"""Name of the control that says what happens to the tests of the oil if the oil varies."""
TOLERANCES = tuple(f"t{place}" for place in range(12))
"""Names of the tolerances of a load spectrum in the form; no more are possible."""
VARY = StudyLink(
    "vary",
    "Vary",
    "one input or two over a range: a curve or a map",
    _named(AXES, ("", ".from", ".to", ".count", ".scale")) | {*ALSO, "best", OIL_TESTS},
)
FIND = StudyLink(
    "find",
    "Find",
    "the input at which a result has a wanted value, or is least or greatest",
    _named("x", ("", ".from", ".to", ".count", ".scale")) | {"goal", "wanted", OIL_TESTS},
)
INFLUENCE = StudyLink(
    "influence", "What matters", "every input moved by its tolerance, down and up: which moves the result most"
)
SPECTRUM = StudyLink(
    "spectrum",
    "Load spectrum",
    "cases and tolerances: the probability of exceeding a limit, and the mean losses",
    _named(TOLERANCES, ("", ".law", ".about", ".by"))
    | {CASES, "machines", "models", "hours", "limit", "limit.side", "limit.by"},
)
CORNERS = StudyLink(
    "corners",
    "Worst corner",
    "every combination of the uncertain inputs: where the result is worst",
    frozenset(map(control_of, (*UNCERTAIN, *BY_CLASS))),
    DRIVE_TRAIN,
)
DESIGN = StudyLink(
    "design",
    "What to grind",
    "the flank correction whose worst corner is best, and how exactly it must be ground",
    frozenset(map(control_of, UNCERTAIN)) | _named(("low.", "high."), "01234") | {"trials", "judged", "drawn"},
    DRIVE_TRAIN,
)
LINKS = (VARY, FIND, INFLUENCE, SPECTRUM, CORNERS, DESIGN)
"""The links in the order in which pages show them."""


@cache
def control_names() -> frozenset[str]:
    """Return the names of all controls of studies. In a query, these names do not belong to fields of a case."""
    return frozenset({"show"}).union(*(link.controls for link in LINKS))
