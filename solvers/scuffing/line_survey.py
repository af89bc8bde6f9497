"""What the loaded contact lines of one roll position amount to: friction, contact, forces, the worst points."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.gears.path_of_contact import reduced_radius
from solvers.scuffing.contact_lines import COINCIDENT, line_count, line_ends
from solvers.scuffing.contact_slices import GAP, LENGTH, LIMIT, LINE, LOAD, Mesh, X, Y, load_at


class Survey(NamedTuple):
    """Over the roll positions: friction_moment int w |s - s_C| dl [N m], loaded_length and length [m].

    held: slices pressed beyond the half-space. peak_load rows (w [N/m], x, y [m]); peak_pressure rows
    (w / R_n [N/m^2], x, y); line_forces, by line [N].
    """

    friction_moment: FloatArray
    loaded_length: FloatArray
    length: FloatArray
    held: FloatArray
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
        np.zeros(positions),
        np.zeros(positions),
        np.zeros(positions),
        np.zeros(positions),
        np.zeros((positions, 3)),
        np.zeros((positions, 3)),
        np.zeros((positions, line_count(mesh.plane))),
    )


@kernel
def _note_peaks(mesh: Mesh, survey: Survey, i: int, load: float, at: tuple[float, float]) -> None:
    x, y = at
    if load > survey.peak_load[i, 0]:
        survey.peak_load[i, 0], survey.peak_load[i, 1], survey.peak_load[i, 2] = load, x, y
    radius = reduced_radius(mesh.plane, x)
    if radius >= mesh.plane.least_radius and load > survey.peak_pressure[i, 0] * radius:
        survey.peak_pressure[i, 0] = load / radius
        survey.peak_pressure[i, 1], survey.peak_pressure[i, 2] = x, y


@kernel
def survey_slices(mesh: Mesh, table: FloatArray, count: int, error: float, survey: Survey, i: int) -> None:
    """Sum up the slices of roll position i."""
    arm = mesh.plane.pitch_point - mesh.plane.start
    for n in range(count):
        load, length = table[LOAD, n], table[LENGTH, n]
        survey.length[i] += length
        if load > 0.0:
            survey.loaded_length[i] += length
            survey.friction_moment[i] += load * abs(table[X, n] - arm) * length
            survey.held[i] += error - table[GAP, n] > table[LIMIT, n]
            survey.line_forces[i, int(table[LINE, n])] += load * length
            _note_peaks(mesh, survey, i, load, (table[X, n], table[Y, n]))


@kernel
def survey_ends(mesh: Mesh, phase: float, side: float, error: float, survey: Survey, i: int) -> None:
    """Look for peaks at the ends of the lines, where edges are; a corner is a line of no length."""
    plane = mesh.plane
    overlap = plane.face_width * plane.tan_base_helix
    for j in range(line_count(plane)):
        line = phase + j * plane.base_pitch
        low, high = line_ends(plane, line, side)
        at_corner = overlap > 0.0 and line <= (plane.path_length + overlap) * (1.0 + COINCIDENT)
        if high > low or at_corner:
            for end in (low, high):
                y = min(end, plane.face_width)
                x = min(max(line - y * plane.tan_base_helix, 0.0), plane.path_length)
                load, _ = load_at(mesh, error, x, y, 0.0)
                _note_peaks(mesh, survey, i, load, (x, y))


def largest(peaks: FloatArray) -> Peak | None:
    """The largest of the peaks of all roll positions; None where nothing is loaded."""
    row = peaks[np.argmax(peaks[:, 0])]
    return Peak(float(row[0]), float(row[1]), float(row[2])) if row[0] > 0.0 else None
