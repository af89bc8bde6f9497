"""The gap between the flanks over the plane of action, caused by modification and misalignment together."""

from math import cos, sin
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inner_kernel, kernel
from solvers.errors import InvalidInput
from solvers.gears.pair import PathOfContact
from solvers.scuffing.inputs import LeadCurve, Modifications

LEAD_POINTS = 401  # one point per 0.25 % of the face; between these points lead curves are linear
MOST_EDGES = 6  # largest number of edges: two ends of the line, two end reliefs, two reliefs along the path


@inner_kernel
def place_of(x: float, points_per_metre: float, points: int) -> tuple[int, float]:
    """Return the number of the table point before x, and the distance from this point to x in steps.

    The points of the table are equidistant and start at x = 0. A step is the distance between neighbouring points.
    """
    position = x * points_per_metre
    index = min(max(int(position), 0), points - 2)
    return index, position - index


@inner_kernel
def interpolated(table: FloatArray, place: tuple[int, float]) -> float:
    """Interpolate linearly in a table of values at equidistant points; `place` is a result of `place_of`."""
    index, share = place
    low, high = float(table[index]), float(table[index + 1])
    return low + share * (high - low)


class Gap(NamedTuple):
    """Parameters of the gap Delta(x, y) between the flanks; amplitudes and lengths in [m].

    `lead` is the gap [m] of the lead curve at equidistant points of the face, from end to end.
    """

    path_length: float
    face_width: float
    profile_crowning: float
    lead_crowning: float
    profile_slope: float
    helix_slope: float
    tip_relief: float
    tip_relief_length: float
    root_relief: float
    root_relief_length: float
    end_relief: float
    end_relief_length: float
    exponent: float
    lead: FloatArray


def gap(modifications: Modifications, path: PathOfContact) -> Gap:
    """Return the gap that the modifications cause; a relief without a given length gets a default length.

    The paper states no lengths. The default length of tip and root relief is g_alpha - p_bt (long relief): the tip
    relief ends at D, and the root relief ends at B. This length is limited to values between a tenth and half of the
    path. The default length of the end relief is a tenth of the face width.
    """
    width = path.pair.inputs.face_width
    long_relief = min(max(path.length - path.pair.transverse_base_pitch, 0.1 * path.length), 0.5 * path.length)
    m = modifications
    shafts = misalignment_slope(m.in_plane_deviation, m.out_of_plane_deviation, path.pair.working_pressure_angle)
    return Gap(
        path.length,
        width,
        m.profile_crowning,
        m.lead_crowning,
        m.profile_slope,
        m.helix_slope + shafts,
        m.tip_relief,
        long_relief if m.tip_relief_length is None else m.tip_relief_length,
        m.root_relief,
        long_relief if m.root_relief_length is None else m.root_relief_length,
        m.end_relief,
        0.1 * width if m.end_relief_length is None else m.end_relief_length,
        float(m.relief_exponent),
        np.zeros(2) if m.lead_curve == LeadCurve() else lead_table(m.lead_curve, width),
    )


def lead_table(curve: LeadCurve, face_width: float, field: str = "lead_curve") -> FloatArray:
    """Return the gap of a lead curve at equidistant points of the face [m].

    Raises InvalidInput (`lead_curve`) if the curve has fewer than two points, if the number of gaps differs from the
    number of positions, or if the positions are not in ascending order from 0 to the face width.
    """
    position, value = np.asarray(curve.position), np.asarray(curve.gap)
    rising = position.size >= 2 and bool(np.all(np.diff(position) > 0.0))
    if not rising or position.size != value.size or position[0] < 0.0 or position[-1] > face_width * (1 + 1e-9):
        raise InvalidInput(
            "lead_curve",
            "give at least two positions, in rising order from 0 to the face width, and one gap for each position",
            field,
        )
    return np.asarray(np.interp(np.linspace(0.0, face_width, LEAD_POINTS), position, value))


def kinks_along_path(form: Gap) -> tuple[float, ...]:
    """Return the distances from A [m] at which reliefs begin."""
    starts = (
        (form.root_relief, form.root_relief_length),
        (form.tip_relief, form.path_length - form.tip_relief_length),
    )
    return tuple(x for amplitude, x in starts if amplitude != 0.0 and 0.0 < x < form.path_length)


def kinks_along_face(form: Gap) -> tuple[float, ...]:
    """Return the places on the face at which the end reliefs begin.

    The places are distances [m] from the end that meshes first. If both end reliefs meet at the middle of the face, the
    middle of the face is returned twice.
    """
    if form.end_relief == 0.0:
        return ()
    length = min(form.end_relief_length, form.face_width / 2)
    return (length, form.face_width - length)


def misalignment_slope(in_plane: float, out_of_plane: float, working_pressure_angle: float) -> float:
    """Compute the helix slope that has the same effect as shaft deviations [m].

    Eq. L12, with the deviations of ISO/TR 10064-3: f_Sigma_delta sin alpha_wt + f_Sigma_beta cos alpha_wt.
    """
    return in_plane * sin(working_pressure_angle) + out_of_plane * cos(working_pressure_angle)


@inner_kernel
def _relief(amplitude: float, length: float, distance: float, exponent: float) -> float:
    """Return amplitude (1 - distance / length)^exponent; 0 if the distance exceeds the length."""
    if amplitude == 0.0 or distance >= length:
        return 0.0
    rest = 1.0 - distance / length
    return amplitude * rest if exponent == 1.0 else amplitude * rest**exponent


@inner_kernel
def profile_gap(form: Gap, x: float) -> float:
    """Compute the part of the gap that depends on the distance x along the path [m] (Eq. L11)."""
    xi = x / form.path_length - 0.5
    value = 4.0 * form.profile_crowning * xi * xi + form.profile_slope * xi
    value += _relief(form.tip_relief, form.tip_relief_length, form.path_length - x, form.exponent)
    return value + _relief(form.root_relief, form.root_relief_length, x, form.exponent)


@inner_kernel
def lead_gap(form: Gap, y: float) -> float:
    """Compute the part of the gap that depends on the distance y along the face [m] (Eq. L11)."""
    eta = y / form.face_width - 0.5
    value = 4.0 * form.lead_crowning * eta * eta + form.helix_slope * eta
    value += interpolated(form.lead, place_of(y, (form.lead.size - 1) / form.face_width, form.lead.size))
    return value + _relief(form.end_relief, form.end_relief_length, min(y, form.face_width - y), form.exponent)


@inner_kernel
def lead_gaps(form: Gap, y: FloatArray) -> FloatArray:
    """Return the part of the gap Delta [m] that depends on y, for several values of y.

    y [m] is the distance along the face from the end that meshes first.
    """
    gaps = np.empty(y.size)
    for i in range(y.size):
        gaps[i] = lead_gap(form, y[i])
    return gaps


@inner_kernel
def gap_at(form: Gap, x: float, y: float) -> float:
    """Return the gap Delta [m] at the distances x [m] from A and y [m] from the end that meshes first.

    The gap is positive where material is missing.
    """
    return profile_gap(form, x) + lead_gap(form, y)


@inner_kernel
def _insert(edges: FloatArray, count: int, y: float) -> int:
    """Insert y into the first `count` values of `edges`, which are in ascending order. Return the new number of edges.

    If y does not lie between the first and the last edge, `edges` does not change.
    """
    if not edges[0] < y < edges[count - 1]:
        return count
    place = count
    while edges[place - 1] > y:
        edges[place] = edges[place - 1]
        place -= 1
    edges[place] = y
    return count + 1


@inner_kernel
def smooth_parts(form: Gap, line: float, tan_base_helix: float, ends: tuple[float, float], edges: FloatArray) -> int:
    """Divide a contact line into parts on which the gap is smooth.

    The contact line is x = `line` - y `tan_base_helix`. The gap has a kink where a relief begins, and where both end
    reliefs meet. `edges` receives the y [m] of both ends of the contact line and of all kinks between the ends, in
    ascending order. The kinks at the points of a lead curve are left out. Return the number of edges, which is at most
    `MOST_EDGES`.
    """
    length = min(form.end_relief_length, 0.5 * form.face_width)
    edges[0], edges[1] = ends
    count = 2
    if form.end_relief != 0.0:
        count = _insert(edges, count, length)
        count = _insert(edges, count, form.face_width - length)
    if tan_base_helix > 0.0:
        if form.root_relief != 0.0:
            count = _insert(edges, count, (line - form.root_relief_length) / tan_base_helix)
        if form.tip_relief != 0.0:
            count = _insert(edges, count, (line - form.path_length + form.tip_relief_length) / tan_base_helix)
    return count


@kernel
def _gaps(form: Gap, x: FloatArray, y: FloatArray) -> FloatArray:
    gaps = np.empty(x.size)
    for i in range(x.size):
        gaps[i] = gap_at(form, x[i], y[i])
    return gaps


def gaps_at(form: Gap, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the gap Delta [m] at the points x, y [m]; the arrays x and y have the same shape."""
    return _gaps(form, np.ravel(x), np.ravel(y)).reshape(np.shape(x))
