"""Slices of all contact lines at one roll position, as the compiled kernels share them."""

from math import ceil
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel, kernel
from solvers.gears.path_of_contact import ContactPlane
from solvers.scuffing.flank.contact_lines import line_count, line_ends
from solvers.scuffing.flank.loaded_zones import HIGH, LEAST_SAMPLES, LOW, MOST_ZONES, gap_on_line, loaded_zones, valley
from solvers.scuffing.flank.modification import MOST_EDGES, Gap, gap_at, smooth_parts
from solvers.scuffing.teeth.stiffness import PairCompliance, compliance_at, line_load

# Rows of the slice table
X, Y, LENGTH, GAP, CONSTANT, LIMIT, LOG_LOAD, LOAD, STIFFNESS, LINE = range(10)
ROWS = 10
NUDGE = 1e-3  # of a slice


class Mesh(NamedTuple):
    """Unloaded mesh: the plane of action, a pair's compliance, the gap."""

    plane: ContactPlane
    compliance: PairCompliance
    gap: Gap


class Cover(NamedTuple):
    """The slices that cover the lines: their number and length [m], least and largest gap on them [m]."""

    slices: int
    length: float
    least: float
    most: float


@kernel
def slice_table(mesh: Mesh, slices: int) -> FloatArray:
    """A table with room for the slices of every line."""
    return np.zeros((ROWS, line_count(mesh.plane) * (slices + MOST_EDGES * MOST_ZONES)))


@inlined_kernel
def _cut(mesh: Mesh, line: float, j: int, zone: FloatArray, slices: int, table: FloatArray, count: int) -> int:
    """Add equal slices of a stretch of line j, given by its first and last y [m], to the table's columns."""
    low, high = zone
    step = (high - low) / slices
    for i in range(slices):
        y = low + (i + 0.5) * step
        x = line - y * mesh.plane.tan_base_helix
        table[X, count], table[Y, count], table[LINE, count] = x, y, j
        table[LENGTH, count] = step / mesh.plane.cos_base_helix
        table[GAP, count] = gap_at(mesh.gap, x, y)
        table[CONSTANT, count], table[LIMIT, count] = compliance_at(mesh.compliance, x)
        count += 1
    return count


@inlined_kernel
def _parts(
    mesh: Mesh, line: float, ends: tuple[float, float], slices: int, reach: float, zones: FloatArray
) -> tuple[int, float]:
    """Write the loaded stretches of a line, of which none holds a kink; their number and length in y [m]."""
    edges, (first_y, last_y) = np.empty(MOST_EDGES), ends
    last = smooth_parts(mesh.gap, line, mesh.plane.tan_base_helix, ends, edges) - 1
    count, length = 0, 0.0
    for k in range(last):
        low, high = edges[k], edges[k + 1]
        if high <= low:
            continue
        if reach == np.inf:
            zones[count, LOW], zones[count, HIGH] = low, high
            found = 1
        else:
            samples = max(LEAST_SAMPLES, ceil(slices * (high - low) / (last_y - first_y)))
            found = loaded_zones(mesh.gap, mesh.plane, line, (low, high), samples, reach, zones[count:])
        for zone in zones[count : count + found]:
            length += zone[HIGH] - zone[LOW]
        count += found
    return count, length


@kernel
def gather(mesh: Mesh, phase: float, side: float, slices: int, reach: float, table: FloatArray) -> Cover:
    """Fill the columns of the slice table, one a slice (their middles), where the gap lies below `reach` [m].

    Every line has `slices` of them, and more only for stretches shorter than one; no slice holds a kink of the gap.
    """
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
            pieces = ceil(slices * (zone[HIGH] - zone[LOW]) / loaded - 1e-9)
            first, count = count, _cut(mesh, line, j, zone, max(pieces, 1), table, count)
            lowest, highest = _range(mesh, line, zone, table, first, count)
            least, most = min(least, lowest), max(most, highest)
    return Cover(count, length, least, most)


@inlined_kernel
def _range(mesh: Mesh, line: float, zone: FloatArray, table: FloatArray, first: int, last: int) -> tuple[float, float]:
    """Least and largest gap [m] on a stretch that the columns from `first` to `last` cover."""
    low, high = zone
    at_low, at_high = gap_on_line(mesh.gap, mesh.plane, line, low), gap_on_line(mesh.gap, mesh.plane, line, high)
    least, most = min(at_low, at_high), max(at_low, at_high)
    lowest, step = first, (high - low) / (last - first)
    for n in range(first, last):
        most = max(most, table[GAP, n])
        if table[GAP, n] < table[GAP, lowest]:
            lowest = n
    if table[GAP, lowest] < least:
        y = valley(mesh.gap, mesh.plane, line, table[Y, lowest] - step, table[Y, lowest] + step)
        least = min(table[GAP, lowest], gap_on_line(mesh.gap, mesh.plane, line, min(max(y, low), high)))
        return least, most
    least = min(least, _beside(mesh, line, table, (low, step), at_low, first, min(first + 1, last - 1)))
    least = min(least, _beside(mesh, line, table, (high, -step), at_high, last - 1, max(last - 2, first)))
    return least, most


@kernel
def _beside(
    mesh: Mesh, line: float, table: FloatArray, end: tuple[float, float], at_end: float, middle: int, following: int
) -> float:
    """Least gap [m] between the end of a stretch (y, step inwards) and the middle of its slice."""
    y, step = end
    if table[GAP, middle] > table[GAP, following]:
        return at_end
    if gap_on_line(mesh.gap, mesh.plane, line, y + NUDGE * step) >= at_end:
        return at_end
    bottom = valley(mesh.gap, mesh.plane, line, min(y, y + step), max(y, y + step))
    return min(at_end, gap_on_line(mesh.gap, mesh.plane, line, bottom))


@inlined_kernel
def load_under(compliance: PairCompliance, approach: float, x: float, log_load: float) -> tuple[float, float]:
    """Line load w [N/m] of a pair pressed together by `approach` [m] at x [m], and ln w, guessed by `log_load`."""
    constant, limit = compliance_at(compliance, x)
    load, _, log_load = line_load(approach, constant, compliance.logarithmic, limit, log_load)
    return load, log_load
