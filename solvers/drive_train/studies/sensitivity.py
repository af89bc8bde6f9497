"""Which input moves K_H_beta and the safety most, per unit of its tolerance.

Both are maxima over the face or the flank. Where the maximum lies inside, it stays put to first order (envelope
theorem), so the difference is taken at the place of the unchanged unit, free of the jumps between points. The gap's own
effect comes from the derivative that the balance already has, at no run at all.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.gap.balance import Equilibrium, uniform_force
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.model import Prepared, prepare, settle
from solvers.drive_train.studies.outcome import Outcome, outcome, outcome_of
from solvers.drive_train.studies.variation import value_at, varied
from solvers.errors import InvalidInput
from solvers.scuffing.safety import safety_factor

STEP = 1e-3  # of the tolerance
KINK = 0.1  # relative disagreement of one-sided differences
NOISE = 1e-8  # of K_H_beta, from the balance's residual


@dataclass(frozen=True, slots=True)
class Tolerance:
    """A change of the input at a dotted name that is common or stated."""

    name: str
    change: float


@dataclass(frozen=True, slots=True)
class Influence:
    """Change of K_H_beta and of Blok's safety over the flank when an input grows by its tolerance.

    `kink` where one-sided differences of the free maxima disagree by more than a tenth: a maximum changes its place.
    """

    name: str
    change: float
    face_load_factor: float
    safety: float | None
    kink: bool


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """Influences, and the derivative [1/m] of K_H_beta by a gap at the stations (hats) that are `position` [m].

    The latter counts K_H_beta by the force of the station nearest to the largest.
    """

    influences: tuple[Influence, ...]
    position: FloatArray
    by_gap: FloatArray


def sensitivity(inputs: DriveTrainInputs, tolerances: Sequence[Tolerance]) -> Sensitivity:
    """Central differences with a thousandth of every tolerance.

    Raises InvalidInput not_a_number for an input that is none, no_load without torque, and what `outcome` raises.
    """
    prepared = prepare(inputs)
    found = settle(inputs, prepared)
    base = outcome_of(inputs, prepared, found)
    if base.face_load_factor is None:
        raise InvalidInput("no_load", "without torque nothing is loaded", "mesh.distribution.load.pinion_torque")
    return Sensitivity(
        influences=tuple(_influence(inputs, base, tolerance) for tolerance in tolerances),
        position=frozen(prepared.unit.stations),
        by_gap=frozen(_by_gap(prepared, base, found)),
    )


def _influence(inputs: DriveTrainInputs, base: Outcome, tolerance: Tolerance) -> Influence:
    """Differences at the frozen places, and of the free maxima on either side."""
    value = _number(value_at(inputs, tolerance.name), tolerance.name)
    units = [varied(inputs, {tolerance.name: value + sign * STEP * tolerance.change}) for sign in (1.0, -1.0)]
    sides = [outcome(unit, base.gap) for unit in units]
    factors = [_factor_at(side, base) for side in sides]
    safeties = [_safety_at(unit, side, base) for unit, side in zip(units, sides, strict=True)]
    safety = None
    if safeties[0] is not None and safeties[1] is not None:
        safety = (safeties[0] - safeties[1]) / (2 * STEP)
    highest = float(base.shares.max())
    up, down = float(sides[0].shares.max()) - highest, highest - float(sides[1].shares.max())
    return Influence(
        name=tolerance.name,
        change=tolerance.change,
        face_load_factor=(factors[0] - factors[1]) / (2 * STEP),
        safety=safety,
        kink=abs(up - down) > KINK * max(abs(up), abs(down)) + NOISE,
    )


def _number(value: Any, name: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InvalidInput("not_a_number", f"{name} is not a number in this unit; give it one", name)
    return float(value)


def _factor_at(side: Outcome, base: Outcome) -> float:
    """Load over its mean where the unchanged unit has its largest."""
    return float(side.shares[int(np.argmax(base.shares))])


def _safety_at(inputs: DriveTrainInputs, side: Outcome, base: Outcome) -> float | None:
    """Safety by the contact temperature where the unchanged unit is hottest; None without a scuffing temperature."""
    if side.limit is None:
        return None
    place = np.unravel_index(int(np.argmax(base.temperature)), base.temperature.shape)
    return safety_factor(side.limit, inputs.mesh.temperatures.oil, float(side.temperature[place]))


def _by_gap(prepared: Prepared, base: Outcome, found: Equilibrium) -> FloatArray:
    """Derivative of a station's force over that of an even load."""
    count = prepared.unit.stations.size
    even = uniform_force(prepared.mesh.transmitted, count)
    station = round(int(np.argmax(base.shares)) / (base.shares.size - 1) * (count - 1))
    return np.asarray(found.by_gap[station] / even[station])
