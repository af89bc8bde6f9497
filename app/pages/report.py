"""What a report says beside the result: names, date, every input with where it comes from, how to repeat it."""

import re
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any
from unicodedata import category

from markupsafe import Markup

from app.pages.cases import Case
from app.pages.code import for_shell, given
from app.pages.manual import method_of
from app.pages.results import flattened, resolved
from app.pages.typesetting import cited, shown, symbol
from app.schema.fields import leaf_at

NAMES = {"title": 200, "project": 200, "part": 200, "author": 200, "checker": 200, "notes": 2000}
"""What a report says of its occasion, and how many characters of it at most."""
LONGEST_LINK = 240  # as text; what it leads to is the whole
SIDE_BY_SIDE = 4  # items of a list
_element = re.compile(r"(\.\d+){1,2}$")  # of a list or a matrix of numbers
PAPERS = {"a4": "A4", "letter": "letter"}


@dataclass(frozen=True, slots=True)
class Cell:
    """The value of an input; `origin` is given, assumed, derived, default or not given."""

    value: str
    origin: str


@dataclass(frozen=True, slots=True)
class Row:
    """An input; of items of a list that stand side by side, the same input of each by its index."""

    label: str
    symbol: Markup
    unit: str
    cells: dict[int, Cell]

    @property
    def origin(self) -> str:
        """Where its values come from."""
        return ", ".join(dict.fromkeys(cell.origin for cell in self.cells.values()))


@dataclass(frozen=True, slots=True)
class Table:
    """The inputs of a section; `items` are the indices of its columns, `listed` where it is one of a list."""

    title: str
    items: tuple[int, ...]
    listed: bool
    rows: tuple[Row, ...]


def context(case: Case, views: dict[str, str], address: str, link: str) -> dict[str, Any]:
    """What the template needs beside the result; raises ValueError for a name or note that is too long."""
    return {
        "longest": NAMES,
        "names": {name: _said(name, views.get(name, ""), longest) for name, longest in NAMES.items()},
        "paper": PAPERS.get(views.get("paper", ""), "A4"),
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "inputs": _inputs(case),
        "command": for_shell(address, case.calculation, given(case.request)),
        "link": link,
        "link_text": link if len(link) <= LONGEST_LINK else f"{link[:LONGEST_LINK]}…",
        "method": method_of(case.calculation),
    }


def _said(name: str, text: str, longest: int) -> str:
    """A name or note without characters that cannot be seen, some of which turn text around."""
    if len(text) > longest:
        raise ValueError(f"{name}: {len(text)} characters; at most {longest} have room on the report")
    lines = text.splitlines() if name == "notes" else [" ".join(text.split())]
    return "\n".join("".join(each for each in line if category(each) not in {"Cc", "Cf"}) for line in lines)


def _inputs(case: Case) -> list[Table]:
    """Every input with the value used and where it comes from, by section in the order of the schema."""
    typed = {_element.sub("", name) for name, _ in case.pairs}
    assumed = {each.field: each.value for each in case.response.assumptions}
    used = resolved(case.response) | assumed
    sections: dict[str, dict[str, Row]] = {}
    for path, stated in flattened(case.response.inputs).items():
        leaf, value = leaf_at(type(case.request), path), used[path]
        if leaf is None or (value is None and (leaf.exclusive or not leaf.declared.default_text)):
            continue
        section, index, name = _place(path)
        row = Row(leaf.title.partition(",")[0], symbol(leaf.declared.symbol), leaf.unit or "", {})
        cells = sections.setdefault(section, {}).setdefault(name, row).cells
        if value is None:
            cells[index] = Cell(cited(leaf.declared.default_text or ""), "not given")
            continue
        origin = "assumed" if path in assumed else "derived" if stated is None else "default"
        cells[index] = Cell(f"{_text(value)} {row.unit}".rstrip(), "given" if path in typed else origin)
    return [table for title, rows in sections.items() for table in _tables(title, tuple(rows.values()))]


def _text(value: Any) -> str:
    """A number, a word, or a list of them; a matrix by its rows."""
    if not isinstance(value, list):
        return shown(value, 6)
    return ", ".join(f"({_text(item)})" if isinstance(item, list) else _text(item) for item in value)


def _place(path: str) -> tuple[str, int, str]:
    """The section of an input, its index among the items of a list, its name."""
    *section, name = path.split(".")
    index = int(section.pop()) if section and section[-1].isdecimal() else 0
    return " · ".join(part.replace("_", " ") for part in section) or "general", index, name


def _tables(title: str, rows: tuple[Row, ...]) -> list[Table]:
    """A section as a table, or as several where its items are too many to stand side by side."""
    items = sorted({index for row in rows for index in row.cells})
    return [
        Table(title, tuple(some), len(items) > 1, rows)
        for some in (items[start : start + SIDE_BY_SIDE] for start in range(0, len(items), SIDE_BY_SIDE))
    ]
