"""Ranges, ticks and their labels: chosen here, so that labels can be placed before anything is drawn."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, floor, log10

import numpy as np
from matplotlib.ticker import MaxNLocator

from app.figures.data import Axis, Values
from app.figures.wording import number

FARTHEST_LEVEL = 4.0  # a limit beyond so many times the values is named at the edge instead of flattening them
HEADROOM = 0.06


@dataclass(frozen=True, slots=True)
class Range:
    """Ends of an axis and its ticks; `places` turns values into fractions of its length."""

    low: float
    high: float
    ticks: tuple[float, ...]
    log: bool = False

    def places(self, values: Values | float) -> Values:
        """Fractions of the axis' length; NaN where the value is."""
        array = np.asarray(values, dtype=np.float64)
        if self.log:
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.asarray(np.log(array / self.low) / np.log(self.high / self.low))
        return np.asarray((array - self.low) / (self.high - self.low))

    def holds(self, value: float) -> bool:
        """Whether a value lies on the axis."""
        return self.low <= value <= self.high

    @property
    def labels(self) -> list[str]:
        """A text for every tick."""
        return [number(tick, digits=6) for tick in self.ticks]


def chosen_range(axis: Axis, parts: Iterable[Values], levels: Iterable[float] = (), *, snug: bool, most: int) -> Range:
    """The range that holds the values, and the levels that do not flatten them.

    `snug` ends with the values, as an abscissa does; otherwise there is headroom. `most` bounds the number of ticks.
    """
    finite = np.concatenate([part[np.isfinite(part)].ravel() for part in parts] or [np.zeros(0)])
    if axis.log:
        return _log_range(axis, finite[finite > 0.0], levels)
    low, high = axis.limits or _linear_ends(axis, finite, levels, snug=snug)
    if axis.ticks is not None:
        return Range(low, high, tuple(tick for tick in axis.ticks if low <= tick <= high))
    return Range(low, high, nice_ticks(low, high, most))


def nice_ticks(low: float, high: float, most: int) -> tuple[float, ...]:
    """At most so many round numbers between two values."""
    ticks = MaxNLocator(nbins=most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    slack = 1e-9 * (high - low)
    step = float(ticks[1] - ticks[0])
    return tuple(float(round(tick / step) * step) for tick in ticks if low - slack <= tick <= high + slack)


def _linear_ends(axis: Axis, finite: Values, levels: Iterable[float], *, snug: bool) -> tuple[float, float]:
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    grounded = axis.magnitude and not snug
    base = min(low, 0.0) if grounded else low
    reach = (max(high, 0.0) if grounded else high) - base
    top, farthest = base + reach, FARTHEST_LEVEL * max(reach, 1e-300)
    for level in levels:
        if level > top and level - base <= farthest:
            high = max(high, level)
        if level < base and top - level <= farthest:
            low = min(low, level)
    if grounded:
        low, high = min(low, 0.0), max(high, 0.0)
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        margin = 0.5 * max(abs(low), abs(high)) or 1.0
        low, high = (0.0, high + margin) if grounded and low >= 0.0 else (low - margin, high + margin)
        return low, high
    if snug:
        return low, high
    room = HEADROOM * (high - low)
    return (low if grounded and low == 0.0 else low - room), (high if grounded and high == 0.0 else high + 1.5 * room)


def _log_range(axis: Axis, positive: Values, levels: Iterable[float]) -> Range:
    """Whole or half decades around the values."""
    if axis.limits is not None:
        low, high = axis.limits
    else:
        seen = [*positive.tolist(), *(level for level in levels if level > 0.0)] or [1.0]
        low, high = 10.0 ** (floor(2.0 * log10(min(seen))) / 2.0), 10.0 ** (ceil(2.0 * log10(max(seen))) / 2.0)
        if high / low < 9.0:
            low, high = low / 10.0**0.5, high * 10.0**0.5
    ticks = _decades(low, high) if axis.ticks is None else tuple(tick for tick in axis.ticks if low <= tick <= high)
    return Range(low, high, ticks, log=True)


def _decades(low: float, high: float) -> tuple[float, ...]:
    """Powers of ten, thinned out where there are many; 1, 2 and 5 of each where there are few."""
    first, last = ceil(log10(low) - 1e-9), floor(log10(high) + 1e-9)
    factors = (1.0,) if last - first >= 2 else (1.0, 2.0, 5.0)
    every = max(1, ceil((last - first + 1) / 7))
    exponents = range(first - 1, last + 1) if len(factors) > 1 else range(first, last + 1, every)
    ticks = (factor * 10.0**exponent for exponent in exponents for factor in factors)
    return tuple(tick for tick in ticks if low * (1 - 1e-9) <= tick <= high * (1 + 1e-9))
