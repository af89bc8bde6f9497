"""What the loaded contact lines of one roll position amount to: friction, contact, forces, the worst points."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.gears.path_of_contact import reduced_radius
from solvers.scuffing.balance.contact_slices import GAP, LENGTH, LIMIT, LINE, LOAD, Mesh, X, Y, load_under
from solvers.scuffing.flank.contact_lines import COINCIDENT, line_count, line_ends
from solvers.scuffing.flank.modification import MOST_EDGES, gap_at, smooth_parts

VALUE, AT_X, AT_Y = range(3)  # columns of peaks
EQUAL = 1e-9  # peaks nearer than this, relatively, are the same; a spur gear's single pair has the same load all along


class Survey(NamedTuple):
    """Over the roll positions: friction_moment int w |s - s_C| dl [N m], loaded_length and length [m].

    held: slices pressed beyond the half-space; undefined: loaded points too near a base circle for a pressure.
    peak_load rows (w [N/m], x, y [m]); peak_pressure rows (w / R_n [N/m^2], x, y); line_forces, by line [N].
    """

    friction_moment: FloatArray
    loaded_length: FloatArray
    length: FloatArray
    held: FloatArray
    undefined: FloatArray
    peak_load: FloatArray
    peak_pressure: FloatArray
    line_forces: FloatArray


@dataclass(frozen=True, slots=True)
class Peak:
    """A largest value and its place, x from A and y from the end that meshes first [m]."""

    value: float
    x: float
    y: float


@kernel
def empty_survey(mesh: Mesh, positions: int) -> Survey:
    """A survey of nothing."""
    return Survey(
        friction_moment=np.zeros(positions),
        loaded_length=np.zeros(positions),
        length=np.zeros(positions),
        held=np.zeros(positions),
        undefined=np.zeros(positions),
        peak_load=np.zeros((positions, 3)),
        peak_pressure=np.zeros((positions, 3)),
        line_forces=np.zeros((positions, line_count(mesh.plane))),
    )


@kernel
def _put(peaks: FloatArray, i: int, value: float, x: float, y: float) -> None:
    peaks[i, VALUE], peaks[i, AT_X], peaks[i, AT_Y] = value, x, y


@kernel
def _note_peaks(mesh: Mesh, survey: Survey, i: int, load: float, at: tuple[float, float]) -> None:
    x, y = at
    if load > survey.peak_load[i, VALUE] * (1.0 + EQUAL):
        _put(survey.peak_load, i, load, x, y)
    radius = reduced_radius(mesh.plane, x)
    if radius < mesh.plane.least_radius:
        survey.undefined[i] += load > 0.0
    elif load > survey.peak_pressure[i, VALUE] * radius * (1.0 + EQUAL):
        _put(survey.peak_pressure, i, load / radius, x, y)


@kernel
def survey_slices(mesh: Mesh, table: FloatArray, count: int, error: float, survey: Survey, i: int) -> None:
    """Sum up the slices of roll position i."""
    arm = mesh.plane.pitch_point - mesh.plane.start
    for n in range(count):
        load, length = table[LOAD, n], table[LENGTH, n]
        if load > 0.0:
            survey.friction_moment[i] += load * abs(table[X, n] - arm) * length
            survey.held[i] += error - table[GAP, n] > table[LIMIT, n]
            survey.line_forces[i, int(table[LINE, n])] += load * length
            _note_peaks(mesh, survey, i, load, (table[X, n], table[Y, n]))


@kernel
def survey_ends(mesh: Mesh, phase: float, side: float, error: float, survey: Survey, i: int) -> None:
    """Look for peaks at the ends of the lines, where edges are, and at their kinks; a corner is a line of no length."""
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
    """Whether a load presses where reduced radius, and with it every local maximum, has no limit."""
    return bool(np.any(survey.undefined > 0.0))


def largest(peaks: FloatArray) -> Peak | None:
    """The largest of the peaks of all roll positions, the first of equals; None where nothing is loaded."""
    values = peaks[:, VALUE]
    first = int(np.argmax(values >= values.max() * (1.0 - EQUAL)))
    if values[first] <= 0.0:
        return None
    return Peak(float(values[first]), float(peaks[first, AT_X]), float(peaks[first, AT_Y]))
