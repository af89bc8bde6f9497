"""Slices of all contact lines at one roll position, and results of the slices: friction, forces, largest pressure."""

from dataclasses import dataclass
from math import ceil
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel, inner_kernel, kernel
from solvers.gears.pair import ContactPlane, reduced_radius
from solvers.scuffing.contact_lines import (
    COINCIDENT,
    LEAST_SAMPLES,
    MOST_ZONES,
    gap_on_line,
    line_count,
    line_ends,
    loaded_zones,
    valley,
)
from solvers.scuffing.modification import MOST_EDGES, Gap, gap_at, smooth_parts
from solvers.scuffing.tooth_stiffness import PairCompliance, compliance_at, line_load

NUDGE = 1e-3  # share of a slice; distance from the end of a stretch at which the slope of the gap is tested
EQUAL = 1e-9  # relative difference of peaks; smaller differences are rounding, for example on a line of a spur gear


class Mesh(NamedTuple):
    """The unloaded mesh: plane of action, compliance of a pair of teeth, and gap between the flanks."""

    plane: ContactPlane
    compliance: PairCompliance
    gap: Gap


class Cover(NamedTuple):
    """Number and total length [m] of the slices that cover the lines, and least and largest gap [m] on these slices."""

    slices: int
    length: float
    least: float
    most: float


class Slices(NamedTuple):
    """Table of the slices of all contact lines; the fields are arrays over the slices.

    `x` and `y` are the coordinates of the middle of a slice [m], `length` is the length of the slice along the line
    [m], and `gap` is the gap at the middle [m]. `constant` and `limit` describe the compliance of the pair of teeth
    (`tooth_stiffness.compliance_at`). `load` is the line load w [N/m]. `log_load` is ln w; the next solution starts
    from this value. `stiffness` is the derivative of w with respect to the approach [N/m^2]. `line` is the index of the
    contact line to which the slice belongs. The arrays may be longer than the number of slices.
    """

    x: FloatArray
    y: FloatArray
    length: FloatArray
    gap: FloatArray
    constant: FloatArray
    limit: FloatArray
    log_load: FloatArray
    load: FloatArray
    stiffness: FloatArray
    line: FloatArray


class Peaks(NamedTuple):
    """Largest value at every roll position, and the place x, y [m] of this value; arrays (positions,)."""

    value: FloatArray
    x: FloatArray
    y: FloatArray


@kernel
def slice_table(mesh: Mesh, slices: int) -> Slices:
    """Return a table with room for the slices of every line."""
    room = line_count(mesh.plane) * (slices + MOST_EDGES * MOST_ZONES)
    return Slices(
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
        np.zeros(room),
    )


@inlined_kernel
def _cut(mesh: Mesh, line: float, j: int, zone: FloatArray, slices: int, table: Slices, count: int) -> int:
    """Cut a stretch [first, last y] of line j into equal slices of the table; return the new number of slices."""
    low, high = zone
    step = (high - low) / slices
    for i in range(slices):
        y = low + (i + 0.5) * step
        x = line - y * mesh.plane.tan_base_helix
        table.x[count], table.y[count], table.line[count] = x, y, j
        table.length[count] = step / mesh.plane.cos_base_helix
        table.gap[count] = gap_at(mesh.gap, x, y)
        table.constant[count], table.limit[count] = compliance_at(mesh.compliance, x)
        count += 1
    return count


@inlined_kernel
def _parts(
    mesh: Mesh, line: float, ends: tuple[float, float], slices: int, reach: float, zones: FloatArray
) -> tuple[int, float]:
    """Write the kink-free loaded stretches (gap below `reach`) of a line; return their number and y length [m]."""
    edges, (first_y, last_y) = np.empty(MOST_EDGES), ends
    last = smooth_parts(mesh.gap, line, mesh.plane.tan_base_helix, ends, edges) - 1
    count, length, stations = 0, 0.0, (mesh.gap.lead.size - 1) / mesh.gap.face_width
    for k in range(last):
        low, high = edges[k], edges[k + 1]
        if high <= low:
            continue
        if reach == np.inf:
            zones[count, 0], zones[count, 1] = low, high
            added = 1
        else:
            pieces = ceil(slices * (high - low) / (last_y - first_y) - 1e-9)
            least = max(LEAST_SAMPLES, ceil(stations * (high - low)))
            # If the whole line is loaded, the middles of its slices are among the samples.
            samples = 2 * pieces * ceil(least / (2 * pieces))
            added = loaded_zones(mesh.gap, mesh.plane, line, (low, high), samples, reach, zones[count:])
        for start, end in zones[count : count + added]:
            length += end - start
        count += added
    return count, length


@inner_kernel
def gather(mesh: Mesh, phase: float, side: float, slices: int, reach: float, table: Slices) -> Cover:
    """Cut the parts of all lines with a gap below `reach` [m] into at least `slices` kink-free slices a line."""
    plane, zones = mesh.plane, np.empty((MOST_EDGES * MOST_ZONES, 2))
    count, length, least, most = 0, 0.0, np.inf, -np.inf
    for j in range(line_count(plane)):
        line = phase + j * plane.base_pitch
        low, high = line_ends(plane, line, side)
        if high <= low:
            continue
        stretches, loaded = _parts(mesh, line, (low, high), slices, reach, zones)
        length += loaded / plane.cos_base_helix
        for zone in zones[:stretches]:
            start, end = zone
            pieces = ceil(slices * (end - start) / loaded - 1e-9)
            first, count = count, _cut(mesh, line, j, zone, max(pieces, 1), table, count)
            lowest, highest = _range(mesh, line, zone, table, first, count)
            least, most = min(least, lowest), max(most, highest)
    return Cover(count, length, least, most)


@inlined_kernel
def _range(mesh: Mesh, line: float, zone: FloatArray, table: Slices, first: int, last: int) -> tuple[float, float]:
    """Least and largest gap [m] on a stretch, which consists of the slices `first` to `last` - 1."""
    low, high = zone
    at_low, at_high = gap_on_line(mesh.gap, mesh.plane, line, low), gap_on_line(mesh.gap, mesh.plane, line, high)
    least, most = min(at_low, at_high), max(at_low, at_high)
    lowest, step = first, (high - low) / (last - first)
    for n in range(first, last):
        most = max(most, table.gap[n])
        if table.gap[n] < table.gap[lowest]:
            lowest = n
    if table.gap[lowest] < least:
        y = valley(mesh.gap, mesh.plane, line, table.y[lowest] - step, table.y[lowest] + step)
        least = min(table.gap[lowest], gap_on_line(mesh.gap, mesh.plane, line, min(max(y, low), high)))
        return least, most
    least = min(least, _beside(mesh, line, table, (low, step), at_low, first, min(first + 1, last - 1)))
    least = min(least, _beside(mesh, line, table, (high, -step), at_high, last - 1, max(last - 2, first)))
    return least, most


@inner_kernel
def _beside(
    mesh: Mesh, line: float, table: Slices, end: tuple[float, float], at_end: float, middle: int, following: int
) -> float:
    """Least gap [m] between the end of a stretch and the middle of the slice there.

    `end`: its y and the way to the slice's other end [m]; `at_end`: the gap there; `middle`, `following`: slices.
    """
    y, step = end
    if table.gap[middle] > table.gap[following]:
        return at_end
    if gap_on_line(mesh.gap, mesh.plane, line, y + NUDGE * step) >= at_end:
        return at_end
    bottom = valley(mesh.gap, mesh.plane, line, min(y, y + step), max(y, y + step))
    return min(at_end, gap_on_line(mesh.gap, mesh.plane, line, bottom))


@inlined_kernel
def load_under(compliance: PairCompliance, approach: float, x: float, log_load: float) -> tuple[float, float]:
    """Line load [N/m] under an `approach` [m] of the flanks at x [m] from A, and ln of it from the guess `log_load`."""
    constant, limit = compliance_at(compliance, x)
    load, _, log_load = line_load(approach, constant, compliance.logarithmic, limit, log_load)
    return load, log_load


class Survey(NamedTuple):
    """Sums and largest values over the contact lines at every roll position; arrays over the roll positions.

    `friction_moment` is int w |s - s_C| dl [N m], where s - s_C is the distance from the pitch point along the path.
    `length` [m] is the total length of the contact lines, and `loaded_length` [m] is the part of this length on which
    the flanks touch. `held` is the number of slices at which the approach of the flanks exceeds `Slices.limit`; beyond
    this limit the compliance is constant. `undefined` is the number of loaded points that are too near a base circle to
    have a pressure. `peak_load` is the largest w [N/m], and `peak_pressure` is the largest w / R_n [N/m^2].
    `line_forces` (positions, lines) are the forces on the lines [N].
    """

    friction_moment: FloatArray
    loaded_length: FloatArray
    length: FloatArray
    held: FloatArray
    undefined: FloatArray
    peak_load: Peaks
    peak_pressure: Peaks
    line_forces: FloatArray


@dataclass(frozen=True, slots=True)
class Peak:
    """A largest value and its place: distance x [m] from A, and distance y [m] from the face end that meshes first."""

    value: float
    x: float
    y: float


@inner_kernel
def empty_survey(mesh: Mesh, positions: int) -> Survey:
    """Return a survey of zeros."""
    return Survey(
        friction_moment=np.zeros(positions),
        loaded_length=np.zeros(positions),
        length=np.zeros(positions),
        held=np.zeros(positions),
        undefined=np.zeros(positions),
        peak_load=Peaks(np.zeros(positions), np.zeros(positions), np.zeros(positions)),
        peak_pressure=Peaks(np.zeros(positions), np.zeros(positions), np.zeros(positions)),
        line_forces=np.zeros((positions, line_count(mesh.plane))),
    )


@inner_kernel
def _put(peaks: Peaks, i: int, value: float, x: float, y: float) -> None:
    peaks.value[i], peaks.x[i], peaks.y[i] = value, x, y


@inner_kernel
def _note_peaks(mesh: Mesh, survey: Survey, i: int, load: float, at: tuple[float, float]) -> None:
    x, y = at
    if load > survey.peak_load.value[i] * (1.0 + EQUAL):
        _put(survey.peak_load, i, load, x, y)
    radius = reduced_radius(mesh.plane, x)
    if radius < mesh.plane.least_radius:
        survey.undefined[i] += load > 0.0
    elif load > survey.peak_pressure.value[i] * radius * (1.0 + EQUAL):
        _put(survey.peak_pressure, i, load / radius, x, y)


@inner_kernel
def survey_slices(mesh: Mesh, table: Slices, count: int, error: float, survey: Survey, i: int) -> None:
    """Add the slices of roll position i to the survey; `error` is the transmission error TE [m] at this position."""
    arm = mesh.plane.pitch_point - mesh.plane.start
    for n in range(count):
        load, length = table.load[n], table.length[n]
        if load > 0.0:
            survey.friction_moment[i] += load * abs(table.x[n] - arm) * length
            survey.held[i] += error - table.gap[n] > table.limit[n]
            survey.line_forces[i, int(table.line[n])] += load * length
            _note_peaks(mesh, survey, i, load, (table.x[n], table.y[n]))


@inner_kernel
def survey_ends(mesh: Mesh, phase: float, side: float, error: float, survey: Survey, i: int) -> None:
    """Include the loads at line ends and kinks in the largest ones of roll position i; `error` is TE [m]."""
    plane, edges, log_load = mesh.plane, np.empty(MOST_EDGES), 0.0
    overlap = plane.face_width * plane.tan_base_helix
    for j in range(line_count(plane)):
        line = phase + j * plane.base_pitch
        low, high = line_ends(plane, line, side)
        at_corner = overlap > 0.0 and line <= (plane.path_length + overlap) * (1.0 + COINCIDENT)
        if high > low or at_corner:
            for edge in edges[: smooth_parts(mesh.gap, line, plane.tan_base_helix, (low, high), edges)]:
                y = min(edge, plane.face_width)
                x = min(max(line - y * plane.tan_base_helix, 0.0), plane.path_length)
                load, log_load = load_under(mesh.compliance, error - gap_at(mesh.gap, x, y), x, log_load)
                _note_peaks(mesh, survey, i, load, (x, y))


def reaches_base_circle(survey: Survey) -> bool:
    """Return True if a loaded point is so near a base circle that it has no finite pressure."""
    return bool(np.any(survey.undefined > 0.0))


def largest(peaks: Peaks) -> Peak | None:
    """First of the largest peaks over the roll positions; None without load."""
    values = peaks.value
    first = int(np.argmax(values >= values.max() * (1.0 - EQUAL)))
    if values[first] <= 0.0:
        return None
    return Peak(float(values[first]), float(peaks.x[first]), float(peaks.y[first]))
