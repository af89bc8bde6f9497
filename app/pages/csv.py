"""An answer as CSV: its values with path, title and unit, or its curves as columns."""

import csv
from collections.abc import Iterable
from io import StringIO
from typing import Any

from app.schema.fields import Leaf, leaf_at, leaves
from app.schema.model import Response


def values(rows: Iterable[tuple[str, str, Any, str]]) -> bytes:
    """Path, title, value and unit of every result."""
    return _written([("path", "title", "value", "unit"), *rows])


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
    return _written([[_header(leaf) for leaf in chosen], *lines])


def _map(response: Response, chosen: list[Leaf], axes: list[Leaf]) -> bytes:
    """A line a point of the map."""
    first, second = (_at(response, axis.path) for axis in axes[:2])
    maps = [_at(response, leaf.path) for leaf in chosen]
    lines = [[a, b, *(each[i][j] for each in maps)] for i, a in enumerate(first) for j, b in enumerate(second)]
    return _written([[_header(leaf) for leaf in (*axes[:2], *chosen)], *lines])


def _header(leaf: Leaf) -> str:
    return f"{leaf.title} [{leaf.unit or '-'}]"


def _at(response: Any, path: str) -> Any:
    for name in path.split("."):
        response = getattr(response, name, None)
    return response


def _written(rows: Iterable[Iterable[Any]]) -> bytes:
    text = StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue().encode()
