"""An answer as CSV for spreadsheets: either one line for each input and result, or one column for each curve.

Results have six significant digits; the JSON answer has all digits.
"""

from collections.abc import Iterable
from dataclasses import replace
from itertools import product, zip_longest
from typing import Any

from app.errors import Unprocessable
from app.pages.cases import SolvedCase
from app.pages.results import entries, flattened
from app.pages.typed import text_of
from app.schema.answers import Response
from app.schema.fields import ITEM, Leaf, is_below, leaf_at, leaves, pattern_of, value_at
from app.spreadsheet import csv_of

DIGITS = 6  # significant digits; because of the tolerances of the solvers, fewer digits are accurate


def values(case: SolvedCase, title: str) -> bytes:
    """Return the CSV table of a case: identifying lines, all inputs with their defaults, and all scalar results."""
    response = case.response
    identity = {
        "title": title,
        "endpoint": case.calculation.path,
        "model_version": response.model_version,
        "sources": response.sources,
        "case": response.case,
    }
    inputs = [
        (leaf, f"inputs.{path}", text_of(value))
        for path, value in flattened(response.inputs).items()
        if (leaf := leaf_at(type(case.request), path)) and value is not None
    ]
    results = [(entry.leaf, entry.path, entry.value) for entry in entries(response) if entry.leaf.is_scalar]
    named = [(name, name.replace("_", " "), text, "", "") for name, text in identity.items()]
    lines = [
        (path, leaf.title, value, leaf.unit or "", leaf.declared.symbol or "")
        for leaf, path, value in [*inputs, *results]
    ]
    return csv_of([("path", "title", "value", "unit", "symbol"), *named, *lines], DIGITS)


def curves(response: Response) -> dict[str, str]:
    """Return the titles of groups that hold curves, and the titles of curves outside groups."""
    listed = (
        entry
        for entry in entries(response)
        if entry.leaf.dimensions == 1 and entry.value is not None and entry.leaf.kind in {"number", "integer"}
    )
    return {entry.path.rpartition(".")[0] or entry.path: entry.group or entry.leaf.title for entry in listed}


def curve(response: Response, path: str) -> bytes:
    """Return the CSV table of a curve, of a map, or of all curves of a group. The table includes the axes.

    `path` leads to the curve, the map or the group. Every curve is a column. The table of a map has one line per point.
    Raises Unprocessable if there is no curve and no map at this path.
    """
    model = type(response)
    indices = [part for part in path.split(".") if part.isdecimal()]
    wanted = [
        replace(leaf, path=_placed(leaf.path, indices), axes=tuple(_placed(axis, indices) for axis in leaf.axes))
        for leaf in leaves(model)
        if leaf.dimensions and is_below(leaf.path, pattern_of(path))
    ]
    contents = {leaf.path: content for leaf in wanted if (content := value_at(response, leaf.path))}
    shape = max((leaf.dimensions for leaf in wanted if leaf.path in contents), default=0)
    if shape == 0:
        raise Unprocessable(
            "unknown_curve", f"This curve does not exist. The curves are {', '.join(curves(response))}", "curve"
        )
    chosen = [leaf for leaf in wanted if leaf.path in contents and leaf.dimensions == shape]
    names = dict.fromkeys(name for leaf in chosen for name in leaf.axes)
    axes = [replace(axis, path=name) for name in names if (axis := leaf_at(model, name))]
    columns: list[Leaf]
    if shape == 1:
        columns = [*axes, *(leaf for leaf in chosen if leaf.path not in names)]
        lines: Any = zip_longest(*(value_at(response, leaf.path) for leaf in columns))
    else:
        columns = [*axes[:2], *chosen]
        points = product(*(value_at(response, axis.path) for axis in axes[:2]))
        maps = ([value for row in contents[leaf.path] for value in row] for leaf in chosen)
        lines = ((*point, *at_point) for point, *at_point in zip(points, *maps, strict=True))
    header = [f"{' '.join(filter(None, (leaf.title, leaf.declared.symbol)))} [{leaf.unit or '-'}]" for leaf in columns]
    return csv_of([header, *lines], DIGITS)


def _placed(path: str, indices: Iterable[str]) -> str:
    """Return the path of an item: the first items of lists in `path` are those with the `indices`."""
    left = iter(indices)
    return ".".join(next(left, part) if part == ITEM else part for part in path.split("."))
