"""Contact lines in the plane of action: their total length, and their loaded parts."""

from dataclasses import dataclass
from math import ceil, floor
from typing import NamedTuple

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import inner_kernel, kernel
from solvers.errors import InvalidInput
from solvers.gears.pair import ContactPlane, PathOfContact
from solvers.scuffing.modification import Gap, gap_at

COINCIDENT = 1e-9  # in base pitches; corners that are closer to each other are treated as one corner
LEAST_STEPS = 8  # least number of steps between two corners, even if the corners are close to each other
MOST_LINES = 100  # largest number of lines in contact at the same time; real gears have fewer than ten
MOST_ZONES = 12  # largest number of loaded stretches per part of a line; further stretches are joined to the last one
LEAST_SAMPLES = 8  # least number of samples per smooth part
BISECTIONS = 45  # halvings of the step between samples: 2^-45 of the step is below the rounding of a gap
GOLDEN_STEPS = 30  # number of steps; they narrow the range of a minimum to 5e-7 of its width (two sample steps)
GOLDEN = 0.6180339887498949  # (sqrt(5) - 1) / 2, the golden section


@dataclass(frozen=True, slots=True)
class ContactLengths:
    """Smallest, largest and mean total length of the contact lines [m]."""

    minimum: float
    maximum: float
    mean: float

    @property
    def ratio(self) -> float:
        """Contact length ratio L_min / L_max [-]."""
        return self.minimum / self.maximum


def contact_lengths(path: PathOfContact) -> ContactLengths:
    """Total contact length in closed form, in place of the missing Eq. 4 of the paper [m].

    The mean is eps_alpha b/cos beta_b; over the roll it is the convolution of two rectangles, eps_alpha = n_a + f_a and
    eps_beta = n_b + f_b. With u = b/(eps_beta cos beta_b): L_min = u [n_a eps_beta + n_b f_a + max(0, f_a + f_b - 1)],
    L_max = u [n_a eps_beta + n_b f_a + min(f_a, f_b)]. Raises InvalidInput: `no_contact` if L_min = 0, `overlap_range`.
    Eq. 4.
    """
    length = path.plane.face_width / path.plane.cos_base_helix
    transverse, overlap = path.transverse_contact_ratio, path.overlap_ratio
    whole, part = floor(transverse), transverse - floor(transverse)
    if overlap == 0.0:
        least, most = float(whole), float(ceil(transverse))
    else:
        wide, narrow = floor(overlap), overlap - floor(overlap)
        common = whole + wide * part / overlap
        least = common + max(0.0, part + narrow - 1.0) / overlap
        most = common + min(part, narrow) / overlap
    if least <= 0.0:
        raise InvalidInput(
            "no_contact",
            f"at some roll positions no pair of teeth is in contact (transverse contact ratio {transverse:.3f}, "
            f"overlap ratio {overlap:.3f}); increase the addendum",
            "addendum",
        )
    if path.total_contact_ratio > MOST_LINES:
        raise InvalidInput(
            "overlap_range",
            f"the face is too wide for the helix angle, because more than {MOST_LINES} contact lines would exist "
            "at once; reduce the face width",
            "face_width",
        )
    return ContactLengths(least * length, most * length, transverse * length)


class RollPositions(NamedTuple):
    """Roll positions [m] in one base pitch, ascending; loads may change abruptly at a `corner`.

    A corner of a spur gear occurs twice, with `side` -1 and +1 for the limits from below and above, else 0.
    """

    phase: FloatArray
    side: FloatArray
    corner: BoolArray


def roll_positions(
    plane: ContactPlane, count: int, along_path: tuple[float, ...] = (), along_face: tuple[float, ...] = ()
) -> RollPositions:
    """At least `count` roll positions, equidistant between corners.

    A corner is where a line passes a crossing of the plane's edges and the gap's kinks `along_path` x and `along_face`
    y [m]: (x + y tan beta_b) mod p_bt.
    """
    pitch = plane.base_pitch
    x = np.array([0.0, plane.path_length, *along_path])
    y = np.array([0.0, plane.face_width, *along_face])
    corners = np.unique(np.append(np.add.outer(x, y * plane.tan_base_helix).ravel() % pitch, pitch))
    corners = corners[np.append(np.diff(corners) > COINCIDENT * pitch, True)]
    corners[0] = 0.0
    steps = np.maximum(LEAST_STEPS, np.ceil(count * np.diff(corners) / pitch)).astype(int)
    part = np.repeat(np.arange(steps.size), steps + 1)  # index of the part between two corners, both included
    number = np.arange(part.size) - (np.cumsum(steps + 1) - steps - 1)[part]  # index of the position within its part
    phase = number * (np.diff(corners) / steps)[part] + corners[part]
    first, last = number == 0, number == steps[part]
    phase[last] = corners[1:]
    if plane.tan_base_helix == 0.0:
        return RollPositions(phase, 1.0 * first - last, first | last)
    once = np.append(~last[:-1], True)
    return RollPositions(phase[once], np.zeros(np.count_nonzero(once)), (first | last)[once])


@inner_kernel
def line_ends(plane: ContactPlane, phase: float, side: float) -> tuple[float, float]:
    """First and last y [m] of the contact line x = phase - y tan beta_b; equal if out of contact (Eq. L3).

    `side` decides at the ends of a spur gear's path; a helical line that touches a corner is out of contact, which
    rounding would decide otherwise.
    """
    if plane.tan_base_helix == 0.0:
        nudged = phase + side * COINCIDENT * plane.base_pitch
        if 0.0 <= nudged <= plane.path_length:
            return 0.0, plane.face_width
        return 0.0, 0.0
    low = max(0.0, (phase - plane.path_length) / plane.tan_base_helix)
    high = min(plane.face_width, phase / plane.tan_base_helix)
    return (low, high) if high - low > COINCIDENT * plane.face_width else (low, low)


@kernel
def line_count(plane: ContactPlane) -> int:
    """Return the largest number of lines that can touch the plane of action at the same time."""
    return int((plane.path_length + plane.face_width * plane.tan_base_helix) / plane.base_pitch) + 2


@kernel
def _total_lengths(plane: ContactPlane, phase: FloatArray, side: FloatArray) -> FloatArray:
    lengths = np.zeros(phase.size)
    for i in range(phase.size):
        for j in range(line_count(plane)):
            low, high = line_ends(plane, phase[i] + j * plane.base_pitch, side[i])
            lengths[i] += (high - low) / plane.cos_base_helix
    return lengths


def total_lengths(plane: ContactPlane, rolls: RollPositions) -> FloatArray:
    """Return the total contact length [m] at every roll position."""
    return _total_lengths(plane, rolls.phase, rolls.side)


@inner_kernel
def gap_on_line(form: Gap, plane: ContactPlane, line: float, y: float) -> float:
    """Return the gap Delta [m] on the contact line x = line - y tan beta_b."""
    return gap_at(form, line - y * plane.tan_base_helix, y)


@inner_kernel
def valley(form: Gap, plane: ContactPlane, line: float, low: float, high: float) -> float:
    """Place y [m] of the only minimum of the gap on a line from `low` to `high`, by golden section."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = gap_on_line(form, plane, line, inner), gap_on_line(form, plane, line, outer)
    for _ in range(GOLDEN_STEPS):
        if at_inner <= at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = gap_on_line(form, plane, line, inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = gap_on_line(form, plane, line, outer)
    return 0.5 * (low + high)


@inner_kernel
def _edge(form: Gap, plane: ContactPlane, line: float, inside: float, outside: float, reach: float) -> float:
    """Place y [m] between a loaded and an unloaded point where the gap equals the approach `reach` [m]."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (inside + outside)
        if gap_on_line(form, plane, line, middle) < reach:
            inside = middle
        else:
            outside = middle
    return inside


@inner_kernel
def _note(zones: FloatArray, count: int, low: float, high: float) -> int:
    if high <= low:
        return count
    if count == MOST_ZONES:
        low, _ = zones[count - 1]
        zones[count - 1, 0], zones[count - 1, 1] = low, high
        return count
    zones[count, 0], zones[count, 1] = low, high
    return count + 1


@inner_kernel
def loaded_zones(
    form: Gap,
    plane: ContactPlane,
    line: float,
    part: tuple[float, float],
    samples: int,
    reach: float,
    zones: FloatArray,
) -> int:
    """Write the stretches with a gap below `reach` [m] of a kink-free part of a line; return their number."""
    low, high = part
    step, count = (high - low) / samples, 0
    before, least_gap, least_at = low, gap_on_line(form, plane, line, low), low
    loaded, start = least_gap < reach, low
    for i in range(1, samples + 1):
        y = high if i == samples else low + i * step
        gap = gap_on_line(form, plane, line, y)
        if gap < least_gap:
            least_gap, least_at = gap, y
        if gap < reach and not loaded:
            start = _edge(form, plane, line, y, before, reach)
        elif loaded and gap >= reach:
            count = _note(zones, count, start, _edge(form, plane, line, before, y, reach))
        loaded, before = gap < reach, y
    if loaded:
        return _note(zones, count, start, high)
    if count == 0:
        left, right = max(least_at - step, low), min(least_at + step, high)
        bottom = valley(form, plane, line, left, right)
        if gap_on_line(form, plane, line, bottom) < reach:
            start = _edge(form, plane, line, bottom, left, reach)
            count = _note(zones, count, start, _edge(form, plane, line, bottom, right, reach))
    return count
