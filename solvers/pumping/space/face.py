"""Stretches of a tooth space.

A stretch lies between two grooves, or between a groove and an end of the face. Both ends of a stretch are open. A
stretch is cut into slices.
"""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.pumping.inputs import Groove

_SLIVER = 1e-9  # share of the face width; a shorter stretch between two grooves is left out


@dataclass(frozen=True, slots=True)
class Stretch:
    """Stretch of the face between grooves from `start` [m], in `cells` slices of `width` [m]; open at face ends."""

    start: float
    width: float
    cells: int
    opens_front: bool
    opens_rear: bool

    @property
    def centres(self) -> FloatArray:
        """Positions of the centres of the slices [m], (cells,)."""
        return np.linspace(self.start + 0.5 * self.width, self.start + (self.cells - 0.5) * self.width, self.cells)

    def coarser(self, times: int) -> "Stretch":
        """Return this stretch with `1/times` of the slices, but at least one slice."""
        cells = max(self.cells // times, 1)
        return replace(self, cells=cells, width=self.width * self.cells / cells)


def stretches(face_width: float, grooves: tuple[Groove, ...], slices: int, least: int) -> list[Stretch]:
    """Cut the face between its grooves into about `slices` slices, at least `least` in every stretch.

    Raises InvalidInput (`groove_outside`, `groove_overlap`).
    """
    edges = [0.0]
    for k, groove in sorted(enumerate(grooves), key=lambda pair: pair[1].position):
        low, high = groove.position - groove.width / 2, groove.position + groove.width / 2
        tolerance = _SLIVER * face_width
        if low < -tolerance or high > face_width + tolerance or groove.width >= face_width:
            message = f"the groove from {1e3 * low:.3f} to {1e3 * high:.3f} mm does not lie within the face"
            raise InvalidInput("groove_outside", message, f"grooves.{k}.position")
        if low < edges[-1] - tolerance and len(edges) > 1:
            message = f"the groove at {1e3 * groove.position:.3f} mm overlaps the groove beside it"
            raise InvalidInput("groove_overlap", message, f"grooves.{k}.position")
        edges += [low, high]
    edges.append(face_width)
    parts = []
    for low, high in zip(edges[::2], edges[1::2], strict=True):
        if high - low > _SLIVER * face_width:
            cells = max(round(slices * (high - low) / face_width), least)
            parts.append(Stretch(low, (high - low) / cells, cells, low == 0.0, high == face_width))
    if not parts:
        raise InvalidInput(
            "groove_outside", "the grooves cover the whole face; leave a part of the face free", "grooves"
        )
    return parts
