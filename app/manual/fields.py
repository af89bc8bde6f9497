"""The chapter "Inputs and outputs": a table of all fields, generated from the models of the service.

`python -m tests.manual.test_generated` renews the table; this module reads the table for the pages.
"""

from functools import cache
from typing import NamedTuple

from app.manual import FIELDS, chapters

COLUMNS = (
    *("field", "endpoints", "type", "unit", "range", "default", "symbol", "source", "meaning", "solver", "schema"),
)
SECTIONS = {
    "Requests": "The inputs of the calculations.",
    "Answers": "The results of the calculations.",
    "Studies": "The inputs of the studies. The field `request` contains a request of the endpoint that is studied.",
    "Service": "The answers of the other addresses.",
}
BAR = "\N{BROKEN BAR}"  # replaces an escaped bar while a row is split


class Entry(NamedTuple):
    """A row of the table: its anchor on the page, its section, and its cells under `COLUMNS`."""

    anchor: str
    section: str
    cells: tuple[str, ...]

    @property
    def path(self) -> str:
        """The dotted path of the field: the first cell of the row, without the backticks."""
        return self.cells[0].strip("`")

    @property
    def endpoints(self) -> list[str]:
        """The endpoints whose request or answer has the field."""
        return self.cells[1].split()


@cache
def entries() -> tuple[Entry, ...]:
    """Return the rows of the table."""
    chapter, rows, anchors = chapters()[FIELDS], list[Entry](), set[str]()
    for section in SECTIONS:
        for line in chapter.section(section).splitlines():
            if line.startswith("| `"):
                cells = [cell.strip().replace(BAR, "|") for cell in line.replace(r"\|", BAR).strip("|").split("|")]
                anchor = name = f"{section.lower()}.{cells[0].strip('`')}"
                number = 1
                while anchor in anchors:
                    number += 1
                    anchor = f"{name}-{number}"
                anchors.add(anchor)
                rows.append(Entry(anchor, section, tuple(cells)))
    return tuple(rows)


@cache
def _anchors() -> dict[tuple[str, str, str], str]:
    return {(row.section, endpoint, row.path): row.anchor for row in entries() for endpoint in row.endpoints}


def address(section: str, endpoint: str, path: str) -> str:
    """Return the address of the row of a field, or an empty text if the field has no row."""
    anchor = _anchors().get((section, endpoint, path))
    return f"/manual/{FIELDS}#{anchor}" if anchor else ""
