"""The chapter "Inputs and outputs", a table of all fields, which the models of the service make.

`python -m tests.manual.test_generated` renews it; pages read it here.
"""

from functools import cache
from typing import NamedTuple

from app.manual import FIELDS, chapters

COLUMNS = (
    *("field", "endpoints", "type", "unit", "range", "default", "symbol", "source", "meaning", "solver", "schema"),
)
SECTIONS = {
    "Requests": "What a calculation takes.",
    "Answers": "What a calculation answers.",
    "Studies": "What a study takes; its `request` is that of the endpoint it studies.",
    "Service": "What the other addresses answer.",
}
BAR = "\N{BROKEN BAR}"  # stands for an escaped bar while a row is parted


class Entry(NamedTuple):
    """A row of the table: its anchor on the page, its section, and its cells under `COLUMNS`."""

    anchor: str
    section: str
    cells: tuple[str, ...]

    @property
    def path(self) -> str:
        """The field."""
        return self.cells[0].strip("`")

    @property
    def endpoints(self) -> list[str]:
        """The endpoints that have it."""
        return self.cells[1].split()


@cache
def entries() -> tuple[Entry, ...]:
    """Every row of the table."""
    chapter, found, known = chapters()[FIELDS], list[Entry](), set[str]()
    for section in SECTIONS:
        for line in chapter.section(section).splitlines():
            if line.startswith("| `"):
                cells = [cell.strip().replace(BAR, "|") for cell in line.replace(r"\|", BAR).strip("|").split("|")]
                anchor = name = f"{section.lower()}.{cells[0].strip('`')}"
                places = 1
                while anchor in known:
                    places += 1
                    anchor = f"{name}-{places}"
                known.add(anchor)
                found.append(Entry(anchor, section, tuple(cells)))
    return tuple(found)


@cache
def _anchors() -> dict[tuple[str, str, str], str]:
    return {(each.section, endpoint, each.path): each.anchor for each in entries() for endpoint in each.endpoints}


def address(section: str, endpoint: str, path: str) -> str:
    """The address of the row of a field; empty where it has none."""
    anchor = _anchors().get((section, endpoint, path))
    return f"/manual/{FIELDS}#{anchor}" if anchor else ""
