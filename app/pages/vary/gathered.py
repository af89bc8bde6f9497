"""The points of a sweep that have come so far, as lines tell them, and as a figure's data."""

from collections import Counter
from dataclasses import dataclass, field
from math import nan
from typing import Any

import numpy as np

from app.figures.data import Axis, values
from app.figures.studies import Coordinate, Grid
from app.pages.typesetting import words
from app.pages.vary.wish import Varied, Wish
from app.schema.fields import Leaf
from app.studies.requests import Scalar
from app.studies.stream import Line
from app.studies.sweep import Sweep

SOLVED = ("ok", "ok_with_warnings")


@dataclass(slots=True)
class Gathered:
    """What came of each point: value, outcome, what was said of it; `broke` says why there will be no more."""

    total: int
    out: list[float | None] = field(default_factory=list)
    status: list[str] = field(default_factory=list)
    said: list[tuple[str, ...]] = field(default_factory=list)
    elapsed_s: float | None = None
    broke: str | None = None

    def add(self, line: Line) -> None:
        """Take in the next line."""
        match line["type"]:
            case "point":
                error = line.get("error")
                self.out.append(line["out"][0])
                self.status.append(line["status"])
                self.said.append((error["message"],) if error else tuple(map(words, line["warnings"])))
            case "end":
                self.elapsed_s = line["elapsed_s"]
            case "error":
                self.broke = line["message"]

    @property
    def done(self) -> int:
        """How many points have come."""
        return len(self.out)

    @property
    def unsolved(self) -> int:
        """How many of them have no solution."""
        return sum(each not in SOLVED for each in self.status)

    @property
    def reasons(self) -> list[tuple[str, int]]:
        """What was said, how often, the most frequent first."""
        return Counter(text for said in self.said for text in said).most_common()


def grid_of(wish: Wish, sweep: Sweep, gathered: Gathered, limit: float | None) -> Grid:
    """The data of the figures; a point that has not come yet is a gap."""
    axes = [each.values or [] for each in sweep.points.axes]
    sizes = [len(each) for each in axes]
    found = np.full(sweep.points.total, nan)
    found[: gathered.done] = [nan if each is None else float(each) for each in gathered.out]
    known = found.reshape(sizes)
    coordinates, orders = [], []
    for varied, listed in zip(wish.fields, axes, strict=True):
        coordinate, order = _coordinate(varied, listed)
        coordinates.append(coordinate)
        orders.append(order)
    warned: tuple[str | None, ...] = ()
    if len(sizes) == 1 and gathered.done == gathered.total:
        outside = [
            ", ".join(said) if status == "ok_with_warnings" else None
            for said, status in zip(gathered.said, gathered.status, strict=True)
        ]
        warned = tuple(outside[place] for place in orders[0])
    return Grid(
        x=coordinates[0],
        y=coordinates[1] if len(coordinates) > 1 else None,
        output=Axis(wish.output.title, wish.output.unit),
        values=values(known[np.ix_(*orders)]),
        greatest=wish.greatest,
        limit=limit,
        warned=warned if len(set(warned)) > 1 else (),
        unsolved=gathered.unsolved,
    )


def _coordinate(varied: Varied, listed: list[Scalar | list[Scalar]]) -> tuple[Coordinate, list[int]]:
    """The values of a field in rising order, and the places where they stand in the sweep."""
    leaf: Leaf = varied.leaf
    if not all(isinstance(each, int | float) and not isinstance(each, bool) for each in listed):
        texts = tuple(_word(each) for each in listed)
        return Coordinate(Axis(leaf.title), values(list(range(len(listed)))), texts), list(range(len(listed)))
    numbers = np.array(listed, dtype=np.float64)
    order = np.argsort(numbers, kind="stable")
    rising = values(numbers[order])
    log = varied.axis.get("scale") == "log"
    limits = (float(rising[0]), float(rising[-1])) if log else None
    axis = Axis(leaf.title, leaf.unit, log=log, magnitude=False, limits=limits)
    scatters = leaf.tolerance is not None
    return Coordinate(axis, rising, own=varied.own, scatters=scatters), order.tolist()


def _word(value: Any) -> str:
    return ("yes" if value else "no") if isinstance(value, bool) else words(str(value))
