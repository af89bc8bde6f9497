"""How an input is moved, and what the answers on both sides say: differences, slopes, kinks, curvature."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from app.schema.fields import Leaf
from app.studies.fields import fault

RELATIVE_STEP = 0.01
KELVIN_STEP = 1.0
DISAGREEMENT = 0.1  # relative difference of two slopes
NOISE = 1e-7  # relative change of an output that an iteration may leave


@dataclass(frozen=True, slots=True)
class Probe:
    """One input, its value and the values it is moved to; None where its range ends.

    `half` moves it by half the step, where the step is a tolerance: that need not be small.
    """

    leaf: Leaf
    value: float
    step: float
    below: float | None
    above: float | None
    half: "Probe | None" = None

    def overrides(self) -> Iterator[dict[str, Any]]:
        """The points to solve: below, above, then those of half the step."""
        yield from ({self.leaf.path: place} for place in (self.below, self.above) if place is not None)
        if self.half is not None:
            yield from self.half.overrides()


def probe(leaf: Leaf, value: float) -> Probe | None:
    """How an input is moved: by its tolerance, else by 1 %, 1 K for a temperature, 1 for a count."""
    if leaf.kind == "integer":
        return _moved(leaf, value, 1.0)
    if leaf.tolerance is not None:
        step = max(leaf.tolerance, (leaf.relative_tolerance or 0.0) * abs(value))
        found = _moved(leaf, value, step)
        return None if found is None else replace(found, half=_moved(leaf, value, step / 2.0))
    return _moved(leaf, value, KELVIN_STEP if leaf.unit == "°C" else RELATIVE_STEP * abs(value))


def _moved(leaf: Leaf, value: float, step: float) -> Probe | None:
    """The input moved by a step; None where it has no other value."""
    below, above = (_inside(leaf, value + sign * step) for sign in (-1.0, 1.0))
    return None if step == 0.0 or below is above is None else Probe(leaf, value, step, below, above)


def _inside(leaf: Leaf, value: float) -> float | None:
    moved = int(value) if leaf.kind == "integer" else value
    return moved if fault(leaf, moved) is None else None


@dataclass(frozen=True, slots=True)
class Differences:
    """What an output does when an input is moved; None where a side has no answer."""

    probe: Probe
    base: float | None
    below: float | None
    above: float | None
    half: "Differences | None" = None

    @property
    def derivative(self) -> float | None:
        """Central where both sides have answers, else one-sided [output per input]."""
        left, right = self._slopes()
        if left is None or right is None:
            return right if left is None else left
        assert self.probe.below is not None
        assert self.probe.above is not None
        assert self.below is not None
        assert self.above is not None
        return (self.above - self.below) / (self.probe.above - self.probe.below)

    @property
    def elasticity(self) -> float | None:
        """Per cent of the output for a per cent of the input; none at zero and for a temperature in degrees."""
        derivative, probe = self.derivative, self.probe
        if derivative is None or not self.base or not probe.value or probe.leaf.unit == "°C":
            return None
        return derivative * probe.value / self.base

    @property
    def change(self) -> float | None:
        """What one step upwards changes: the larger of the two differences, so that a ridge counts too."""
        steps = [slope * self.probe.step for slope in self._slopes() if slope is not None]
        return max(steps, key=abs, default=None)

    @property
    def kink(self) -> bool | None:
        """Whether the slopes to either side disagree by more than a tenth; None where one is missing."""
        return self._disagree(*self._slopes())

    @property
    def curved(self) -> bool | None:
        """Whether the derivative differs by more than a tenth from that of half the step; None without half a step."""
        return None if self.half is None else self._disagree(self.derivative, self.half.derivative)

    def _disagree(self, one: float | None, other: float | None) -> bool | None:
        if one is None or other is None or self.base is None:
            return None
        largest = max(abs(one), abs(other))
        if largest * self.probe.step <= NOISE * abs(self.base):
            return False
        return abs(one - other) > DISAGREEMENT * largest

    def _slopes(self) -> tuple[float | None, float | None]:
        at = self.probe.value
        return _slope(self.base, self.below, at, self.probe.below), _slope(self.base, self.above, at, self.probe.above)


def _slope(base: float | None, moved: float | None, at: float, place: float | None) -> float | None:
    return None if base is None or moved is None or place is None else (moved - base) / (place - at)
