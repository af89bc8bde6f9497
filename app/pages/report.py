"""The parts of a report that do not show results: names, date, inputs with their origins, and code for the case.

The code sends the request of the case to the service again.
"""

import json
import re
import shlex
from collections.abc import Collection
from datetime import UTC, datetime
from pprint import pformat
from textwrap import indent
from typing import Any, NamedTuple
from unicodedata import category
from urllib.parse import urlsplit

from app.calculations import card_of
from app.errors import Unprocessable
from app.manual import Chapter, chapters
from app.pages.cases import Asked, SolvedCase
from app.pages.manual import chapter_of, method_of, symbols_of
from app.pages.pair_path import WITH_PAIR, assumed_of
from app.pages.query import REPORT_NAMES, Pairs
from app.pages.results import flattened, resolved, texts_of
from app.pages.typesetting import cited
from app.schema.fields import Leaf, leaf_at

LOCAL = "http://localhost:8000"
LABELS = {name: name for name in REPORT_NAMES} | {
    "checker": "checked by",
    "approver": "approved by",
    "rexs_file": "name of the REXS file",
    "rexs_sha256": "SHA-256 of the REXS file",
}
"""Labels of the fields in the form of the report."""
MOST_SHORT = 4  # largest number of figures in a short report, where two figures stand side by side
THIS_COMPUTER = frozenset({"localhost", "127.0.0.1", "::1"})
"""Hosts that mean another computer to the reader of a printed report."""
_element = re.compile(r"(\.\d+){1,2}$")  # indices of an element of a list or a matrix of numbers


class Cell(NamedTuple):
    """The value of an input, and its origin: given, assumed, derived, default or not given."""

    value: str
    origin: str


class InputRow(NamedTuple):
    """A line in the table of a section's inputs: one input, with a cell for each item of the section.

    `cells` maps the index of an item to the cell of this item. A section that is not a list has one item, with index 0.
    """

    leaf: Leaf
    cells: dict[int, Cell]


class ReportSection(NamedTuple):
    """A section of the request: its title, the indices of its items, and the lines of its inputs.

    A section that is not a list has a single item with index 0.
    """

    title: str
    items: list[int]
    rows: list[InputRow]


GIVEN = frozenset({"given"})
STATED = GIVEN | {"assumed", "derived"}
"""Origins of the inputs that the tables show. Below the tables, a text lists the inputs of other origins."""


def context(asked: Asked, case: SolvedCase, host: str) -> dict[str, Any]:
    """Return the variables that the template needs in addition to the variables of the result.

    The link to the case is relative if `host` is empty. Raises Unprocessable if a name or note is too long.
    """
    typical = assumed_of(asked)
    inputs = _inputs(case, asked.pairs, typical.fields if typical else {})
    views, link = asked.views, "" if asked.too_long else host + asked.root + asked.page
    is_local = not host or urlsplit(host).hostname in THIS_COMPUTER
    return {
        "host": host,
        "longest": REPORT_NAMES,
        "names": {name: _said(name, views.get(name, ""), longest) for name, longest in REPORT_NAMES.items()},
        "paper": "letter" if views.get("paper") == "letter" else "A4",
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "inputs": _with_origin(inputs, GIVEN if views.get("extent") == "short" else STATED),
        "defaults": _left(inputs),
        "labels": LABELS,
        "short": views.get("extent") == "short",
        "extent": views.get("extent", ""),
        "with_pair": WITH_PAIR,
        "offers_pair": card_of(case.calculation).subject == "pair",
        "typical": typical,
        "kept": {name: text for name, text in asked.carried.items() if text and name not in REPORT_NAMES},
        "most": MOST_SHORT,
        "symbols": [symbol for chapter in _chapters_behind(case) for symbol in symbols_of(chapter)],
        "command": for_shell((LOCAL if is_local else host) + asked.root, case),
        "link": link,
        "is_local": is_local,
        "methods": [method_of(chapter) for chapter in _chapters_behind(case)],
    }


def _with_origin(sections: list[ReportSection], origins: frozenset[str]) -> list[ReportSection]:
    """Return the sections with only the inputs whose origin is in `origins`; leave out sections without such inputs."""
    chosen = (
        section._replace(rows=[row for row in section.rows if not origins.isdisjoint(_origins(row.cells))])
        for section in sections
    )
    return [section for section in chosen if section.rows]


def _left(sections: list[ReportSection]) -> list[tuple[str, list[tuple[Leaf, str, bool]]]]:
    """Return, for every section, its title and the inputs that have their default value or no value."""
    left = []
    for title, _, rows in sections:
        inputs = [
            (leaf, ", ".join(dict.fromkeys(cell.value for cell in cells.values())), "default" in _origins(cells))
            for leaf, cells in rows
            if STATED.isdisjoint(_origins(cells))
        ]
        left += [(title, inputs)] if inputs else []
    return left


def _origins(cells: dict[int, Cell]) -> set[str]:
    return {cell.origin for cell in cells.values()}


def _chapters_behind(case: SolvedCase) -> list[Chapter]:
    """Return the chapter about the calculation, and the chapters about the optional sections of the answer."""
    own = case.calculation.words.chapters
    behind = [chapter for section, chapter in own.items() if getattr(case.response, section) is not None]
    return [chapter_of(case.calculation), *(chapters()[name] for name in behind)]


def _said(name: str, text: str, longest: int) -> str:
    """Return a name or note without invisible characters; raise Unprocessable if the text is too long.

    Some invisible characters would reverse the direction of the text.
    """
    if len(text) > longest:
        message = f"{name} has {len(text)} characters, but the report has room for {longest} characters only"
        raise Unprocessable("too_long", message, None)
    lines = text.splitlines() if name == "notes" else [" ".join(text.split())]
    return "\n".join("".join(letter for letter in line if category(letter) not in {"Cc", "Cf"}) for line in lines)


def for_shell(address: str, case: SolvedCase) -> str:
    """Return a curl command that asks for a case again; `address` is the address of the service."""
    sent = shlex.quote(json.dumps(_given(case)))
    return f"curl -s {address}{case.calculation.path} -H 'Content-Type: application/json' -d {sent}"


def for_python(address: str, case: SolvedCase) -> str:
    """Return a program that asks the service at `address` for a case and prints the status of the answer."""
    method = case.calculation.path.rpartition("/")[2].replace("-", "_")
    return (
        "from app.client import Tribodrive\n\n"
        f'service = Tribodrive("{address}")\n'
        f"result = service.{method}(\n{indent(pformat(_given(case), width=100, sort_dicts=False), '    ')}\n)\n"
        'print(result["status"])\n'
    )


def body_of(case: SolvedCase) -> str:
    """Return the fields that the user has given, as a JSON text."""
    return json.dumps(_given(case))


def _given(case: SolvedCase) -> dict[str, Any]:
    """Return the fields that the user has given. All other fields have their defaults."""
    return case.request.model_dump(exclude_unset=True, exclude={"detail"})


def _inputs(case: SolvedCase, pairs: Pairs, typical: Collection[str] = ()) -> list[ReportSection]:
    """Return the inputs by section. Each input has the value that was used, and the origin of this value.

    `typical` are the given fields whose values are assumed.
    """
    typed = {_element.sub("", name) for name, _ in pairs}
    assumed = {assumption.field: assumption.value for assumption in case.response.assumptions}
    used = resolved(case.response) | assumed
    sections: dict[str, dict[str, InputRow]] = {}
    for path, stated in flattened(case.response.inputs).items():
        leaf, value = leaf_at(type(case.request), path), used[path]
        if leaf is None or (value is None and (leaf.exclusive or not leaf.declared.default_text)):
            continue
        if value is None:
            cell = Cell(cited(leaf.declared.default_text or ""), "not given")
        else:
            origin = "assumed" if path in assumed else "derived" if stated is None else "default"
            text = f"{', '.join(texts_of(value, 6, 6))} {leaf.unit or ''}".rstrip()
            cell = Cell(text, "assumed" if path in typical else "given" if path in typed else origin)
        *section, name = path.split(".")
        index = int(section.pop()) if section and section[-1].isdecimal() else 0
        title = (
            " · ".join(str(int(part) + 1) if part.isdecimal() else part.replace("_", " ") for part in section)
            or "general"
        )
        sections.setdefault(title, {}).setdefault(name, InputRow(leaf, {})).cells[index] = cell
    return [
        ReportSection(title, sorted({index for row in rows.values() for index in row.cells}), [*rows.values()])
        for title, rows in sections.items()
    ]
