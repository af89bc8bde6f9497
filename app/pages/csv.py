"""An answer as CSV for spreadsheets: the case, its inputs and results in lines, or its curves in columns.

Results have six significant digits; JSON has all of them.
"""

from itertools import product, zip_longest
from typing import Any

from app.errors import Unprocessable
from app.pages.cases import Case
from app.pages.results import entries, flattened
from app.pages.typed import text_of
from app.schema.fields import Leaf, leaf_at, leaves
from app.schema.model import Response
from app.spreadsheet import csv_of
from app.studies.fields import value_at

DIGITS = 6  # more than any solver's tolerance leaves


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
        (leaf, f"inputs.{path}", text_of(value))
        for path, value in flattened(response.inputs).items()
        if (leaf := leaf_at(type(case.request), path)) and value is not None
    ]
    results = [(each.leaf, each.path, each.value) for each in entries(response) if each.leaf.is_scalar]
    named = [(name, name.replace("_", " "), text, "", "") for name, text in identity.items()]
    lines = [
        (path, leaf.title, value, leaf.unit or "", leaf.declared.symbol or "")
        for leaf, path, value in [*inputs, *results]
    ]
    return csv_of([("path", "title", "value", "unit", "symbol"), *named, *lines], DIGITS)


def curves(response: Response) -> dict[str, str]:
    """Return titles by path: of groups that hold curves, and of curves outside groups."""
    listed = (
        each
        for each in entries(response)
        if each.leaf.dimensions == 1 and each.value is not None and each.leaf.kind in {"number", "integer"}
    )
    return {each.path.rpartition(".")[0] or each.path: each.group or each.leaf.title for each in listed}


def curve(response: Response, path: str) -> bytes:
    """One curve or map, or all curves of a group, with their axes; raises Unprocessable where nothing has this name.

    Curves stand in columns; a map has a line for each of its points.
    """
    model = type(response)
    wanted = [leaf for leaf in leaves(model) if leaf.dimensions and f"{leaf.path}.".startswith(f"{path}.")]
    known = {leaf.path: found for leaf in wanted if (found := value_at(response, leaf.path))}
    shape = max((leaf.dimensions for leaf in wanted if leaf.path in known), default=0)
    if shape == 0:
        raise Unprocessable("unknown_curve", f"Available curves: {', '.join(curves(response))}", "curve")
    chosen = [leaf for leaf in wanted if leaf.path in known and leaf.dimensions == shape]
    names = dict.fromkeys(name for leaf in chosen for name in leaf.axes)
    axes = [axis for name in names if (axis := leaf_at(model, name))]
    columns: list[Leaf]
    if shape == 1:
        columns = [*axes, *(leaf for leaf in chosen if leaf not in axes)]
        lines: Any = zip_longest(*(value_at(response, leaf.path) for leaf in columns))
    else:
        columns = [*axes[:2], *chosen]
        points = product(*(value_at(response, axis.path) for axis in axes[:2]))
        maps = ([value for row in known[leaf.path] for value in row] for leaf in chosen)
        lines = ((*point, *at_point) for point, *at_point in zip(points, *maps, strict=True))
    header = [f"{' '.join(filter(None, (leaf.title, leaf.declared.symbol)))} [{leaf.unit or '-'}]" for leaf in columns]
    return csv_of([header, *lines], DIGITS)
