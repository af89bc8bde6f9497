"""An answer as CSV for spreadsheets: the case, its inputs and results in lines, or its curves in columns.

Results have six significant digits; JSON has all of them.
"""

from typing import Any

from app.pages.cases import Case
from app.pages.query import text_of
from app.pages.results import entries, flattened
from app.schema.fields import Leaf, leaf_at, leaves
from app.schema.model import Response
from app.spreadsheet import csv_of

DIGITS = 6  # more than any solver's tolerance leaves
COLUMNS = ("path", "title", "value", "unit", "symbol")


def values(case: Case, title: str) -> bytes:
    """What the case is, every input with its default, and every single result."""
    response = case.response
    identity = {
        "title": title,
        "endpoint": case.calculation.path,
        "model_version": response.model_version,
        "sources": response.sources,
        "case": response.case,
    }
    inputs = [
        _line(leaf, f"inputs.{path}", text_of(value))
        for path, value in flattened(response.inputs).items()
        if (leaf := leaf_at(type(case.request), path)) and value is not None
    ]
    results = [_line(e.leaf, e.path, e.value) for _, e in entries(response) if e.leaf.is_scalar]
    named = [(name, name.replace("_", " "), text, "", "") for name, text in identity.items()]
    return csv_of([COLUMNS, *named, *inputs, *results], DIGITS)


def _line(leaf: Leaf, path: str, value: Any) -> tuple[Any, ...]:
    return path, leaf.title, value, leaf.unit or "", leaf.declared.symbol or ""


def curve(response: Response, path: str) -> bytes | None:
    """One curve or map, or all curves of a group, with what they run over; None where there is nothing of this name."""
    model = type(response)
    wanted = [leaf for leaf in leaves(model) if leaf.dimensions and _within(leaf, path) and _at(response, leaf.path)]
    shape = max((leaf.dimensions for leaf in wanted), default=0)
    if shape == 0:
        return None
    chosen = [leaf for leaf in wanted if leaf.dimensions == shape]
    axes = [
        axis for name in dict.fromkeys(name for leaf in chosen for name in leaf.axes) if (axis := leaf_at(model, name))
    ]
    return (
        _map(response, chosen, axes)
        if shape > 1
        else _columns(response, [*axes, *(leaf for leaf in chosen if leaf not in axes)])
    )


def _within(leaf: Leaf, path: str) -> bool:
    return leaf.path == path or leaf.path.startswith(f"{path}.")


def _columns(response: Response, chosen: list[Leaf]) -> bytes:
    found = [_at(response, leaf.path) for leaf in chosen]
    length = max(map(len, found))
    lines = [[column[line] if line < len(column) else None for column in found] for line in range(length)]
    return csv_of([[_header(leaf) for leaf in chosen], *lines], DIGITS)


def _map(response: Response, chosen: list[Leaf], axes: list[Leaf]) -> bytes:
    """A line a point of the map."""
    first, second = (_at(response, axis.path) for axis in axes[:2])
    maps = [_at(response, leaf.path) for leaf in chosen]
    lines = [[a, b, *(each[i][j] for each in maps)] for i, a in enumerate(first) for j, b in enumerate(second)]
    return csv_of([[_header(leaf) for leaf in (*axes[:2], *chosen)], *lines], DIGITS)


def _header(leaf: Leaf) -> str:
    return f"{' '.join(filter(None, (leaf.title, leaf.declared.symbol)))} [{leaf.unit or '-'}]"


def _at(response: Any, path: str) -> Any:
    for name in path.split("."):
        response = getattr(response, name, None)
    return response
