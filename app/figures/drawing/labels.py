"""Where texts stand, so that none is cut, none lies over another and none over a curve it could avoid.

Lengths are inches from the lower left corner of a panel. The same input gives the same places.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from app.figures.data import Values
from app.figures.drawing.style import text_height, text_width

CURVE_STEP = 0.04  # spacing of the points that stand for a curve
GAP = 0.02  # kept around a text
_OVER_TEXT, _OUTSIDE = 1_000.0, 100.0  # for the whole text, for an inch


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle."""

    left: float
    bottom: float
    right: float
    top: float

    def overlap(self, other: "Box") -> float:
        """Shared area."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.top, other.top) - max(self.bottom, other.bottom)
        return width * height if width > 0.0 and height > 0.0 else 0.0


@dataclass(frozen=True, slots=True)
class Place:
    """Lower left corner of a text, and whether it lies over a curve."""

    x: float
    y: float
    over_curve: bool


@dataclass(slots=True)
class Placer:
    """What is taken in a panel of a size: curves as points, texts and markers as boxes."""

    width: float
    height: float
    points: list[Values] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)

    def add_curve(self, x: Values, y: Values) -> None:
        """Keep texts off a curve."""
        points = np.column_stack([x, y])
        points[~np.isfinite(points)] = np.nan
        steps = np.diff(points, axis=0)
        lengths = np.hypot(steps[:, 0], steps[:, 1])
        drawn = np.isfinite(lengths)
        counts = np.clip(lengths[drawn] / CURVE_STEP, 1, 500).astype(int)
        segment = np.repeat(np.arange(counts.size), counts)
        along = (np.arange(segment.size) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[segment]
        self.points.append(points[:-1][drawn][segment] + along[:, None] * steps[drawn][segment])

    def add_box(self, left: float, bottom: float, right: float, top: float) -> None:
        """Keep texts off a rectangle."""
        self.boxes.append(Box(left, bottom, right, top))

    def place(self, text: str, size: float, corners: Sequence[tuple[float, float]], *, bold: bool = False) -> Place:
        """The first of the best of the candidates, lower left corners of the text; it is taken from then on."""
        width, height = text_width(text, size, bold=bold), text_height(text, size)
        cloud = np.concatenate(self.points) if self.points else np.zeros((0, 2))
        boxes = [self._inside(x, y, width, height) for x, y in corners]
        costs = [self._cost(box, corner, cloud) for box, corner in zip(boxes, corners, strict=True)]
        chosen = boxes[min(range(len(corners)), key=lambda index: (round(costs[index], 6), index))]
        self.boxes.append(chosen)
        return Place(chosen.left, chosen.bottom, over_curve=_hits(chosen, cloud) > 0)

    def _inside(self, x: float, y: float, width: float, height: float) -> Box:
        """The box from this corner, moved into the panel."""
        left = min(max(x, GAP), max(self.width - width - GAP, GAP))
        bottom = min(max(y, GAP), max(self.height - height - GAP, GAP))
        return Box(left, bottom, left + width, bottom + height)

    def _cost(self, box: Box, corner: tuple[float, float], cloud: Values) -> float:
        outside = abs(box.left - corner[0]) + abs(box.bottom - corner[1])
        area = (box.right - box.left) * (box.top - box.bottom)
        padded = Box(box.left - GAP, box.bottom - GAP, box.right + GAP, box.top + GAP)
        texts = sum(padded.overlap(other) for other in self.boxes) / area
        return _hits(padded, cloud) + _OVER_TEXT * texts + _OUTSIDE * outside


def _hits(box: Box, cloud: Values) -> int:
    inside = (cloud[:, 0] > box.left) & (cloud[:, 0] < box.right) & (cloud[:, 1] > box.bottom) & (cloud[:, 1] < box.top)
    return int(inside.sum())


def around(
    x: float, y: float, text: str, size: float, *, bold: bool = False, gap: float = 0.08
) -> list[tuple[float, float]]:
    """Corners of a text above, right of, left of and below a point, near first."""
    width, height = text_width(text, size, bold=bold), text_height(text, size)
    corners = []
    for reach in (gap, 2.2 * gap, 4.0 * gap):
        corners += [
            (x - width / 2, y + reach),
            (x + reach, y - height / 2),
            (x - width - reach, y - height / 2),
            (x + reach * 0.7, y + reach * 0.7),
            (x - width - reach * 0.7, y + reach * 0.7),
            (x - width / 2, y - height - reach),
            (x + reach * 0.7, y - height - reach * 0.7),
            (x - width - reach * 0.7, y - height - reach * 0.7),
        ]
    return corners


def spread(wanted: Sequence[float], spacing: float, low: float, high: float) -> list[float]:
    """Heights near the wanted ones, at least `spacing` apart and between `low` and `high` where they fit."""
    order = sorted(range(len(wanted)), key=lambda index: (wanted[index], index))
    groups: list[tuple[list[int], float]] = []  # members from below, height of the middle
    for index in order:
        members, middle = [index], min(max(wanted[index], low), high)
        while groups and groups[-1][1] + spacing * (len(groups[-1][0]) + len(members)) / 2 > middle:
            below, below_middle = groups.pop()
            middle = (middle * len(members) + below_middle * len(below)) / (len(members) + len(below))
            members = below + members
            half = spacing * (len(members) - 1) / 2
            middle = min(max(middle, low + half), max(high - half, low + half))
        groups.append((members, middle))
    heights = [0.0] * len(wanted)
    for members, middle in groups:
        for rank, index in enumerate(members):
            heights[index] = middle + spacing * (rank - (len(members) - 1) / 2)
    return heights
