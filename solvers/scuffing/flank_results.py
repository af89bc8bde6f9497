"""Results for the flanks from the balanced load: load over the face, feature line, maps of line load and pressure."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.contact import hertz
from solvers.gears.pair import ContactPlane, PathOfContact, reduced_radius
from solvers.scuffing.contact_lines import line_count
from solvers.scuffing.contact_slices import Mesh, load_under
from solvers.scuffing.load_balance import LoadBalance, error_at, line_loads, loads_at
from solvers.scuffing.mesh_results import iso_load_sharing
from solvers.scuffing.modification import kinks_along_face, lead_gaps, profile_gap
from solvers.scuffing.results import ContactPoints, FeatureLine, Flank
from solvers.scuffing.tooth_stiffness import compliance_at, line_load

SUBSTEPS = 4  # of a step between roll positions, where lines are loaded in part
FACE_POINTS = 101  # every percent of the face
NEARLY = 0.98  # of the largest: tops below it cannot be the largest once they are refined
TOPS = 3  # highest tops that are refined
ZOOMS = 3  # each narrows the place of the maximum by a factor of 3
ZOOM_POINTS = 7  # points between the neighbours of a top, at each zoom
SAME = 1e-6  # of the range looked at, or of a length


def face_load_factor(balance: LoadBalance, y: float) -> float:
    """K_H_beta = largest over mean of q(y) = int w dx / p_bt (the idea of ISO 6336-1, annex E) of a loaded mesh.

    Looked for at equidistant points, at kinks of the gap and at y [m], where a peak is, and closer around the largest.
    The mean is the force in balance over the face. Where to look closer is seen without steps between roll positions,
    which errs for lines loaded in part: there at every place that is nearly the largest. Eq. L17.
    """
    plane = balance.mesh.plane
    evenly = np.linspace(0.0, plane.face_width, FACE_POINTS)
    places = _apart(np.append(evenly, [*kinks_along_face(balance.mesh.gap), y]))
    highest = tops(face_loads(balance, places, 1))[-TOPS if _in_part(balance) else -1 :]
    largest = max(_largest_around(balance, places, top) for top in highest)
    factor = largest * plane.face_width / (balance.force * plane.cos_base_helix)
    return max(factor, 1.0)  # a largest value below the mean is the error of the trapezia


def _in_part(balance: LoadBalance) -> bool:
    """Whether any line is loaded in part."""
    return bool(np.any(balance.survey.loaded_length < (1 - SAME) * balance.survey.length))


def tops(values: FloatArray) -> list[int]:
    """Return the local maxima that are nearly as large as the largest, in ascending order of their values."""
    edged = np.concatenate([[-np.inf], values, [-np.inf]])
    local = np.flatnonzero((values > edged[:-2]) & (values >= edged[2:]) & (values >= NEARLY * values.max()))
    return sorted(local.tolist(), key=lambda k: float(values[k]))


def _largest_around(balance: LoadBalance, places: FloatArray, top: int) -> float:
    """Largest force per face width [N/m] between the neighbours of a place."""
    for _ in range(ZOOMS):
        low, high = places[max(top - 1, 0)], places[min(top + 1, places.size - 1)]
        places = _apart(np.append(np.linspace(low, high, ZOOM_POINTS), places[top]))
        shares = face_loads(balance, places)
        top = int(np.argmax(shares))
    return float(shares.max())


def _apart(places: FloatArray) -> FloatArray:
    """Return the places in ascending order, without those that only rounding separates from the next place."""
    ascending = np.sort(places)
    return np.asarray(ascending[np.append(np.diff(ascending) > SAME * (ascending[-1] - ascending[0]), True)])


def face_loads(balance: LoadBalance, y: FloatArray, substeps: int = SUBSTEPS) -> FloatArray:
    """Force per face width q = int w dx / p_bt [N/m] at distances y [m] from the end that meshes first (Eq. L17).

    Where lines are loaded in part, load ends between roll positions, whose steps are then cut into `substeps`.
    """
    phase, error = balance.rolls.phase, balance.transmission_error
    return _face_loads(balance.mesh, phase, error, substeps if _in_part(balance) else 1, y)


@kernel
def _face_loads(mesh: Mesh, phase: FloatArray, error: FloatArray, substeps: int, y: FloatArray) -> FloatArray:
    """Trapezia along the path from A to E, for all places at once, over the roll positions whose lines pass between.

    Each step between roll positions ends where the next begins, but for those at which TE jumps.
    """
    plane, compliance, form = mesh.plane, mesh.compliance, mesh.gap
    across = lead_gaps(form, y)
    x, load = np.zeros(y.size), loads_at(mesh, phase, error, np.zeros(y.size), y)
    doubled, log_load = np.zeros(y.size), np.zeros(y.size)
    for j in range(line_count(plane)):
        for i in range(phase.size - 1):
            step = (phase[i + 1] - phase[i]) / substeps
            jumped = i == 0 or phase[i] == phase[i - 1]
            for n in range(0 if jumped else 1, substeps + 1 if step > 0.0 else 0):
                line = phase[i] + n * step + j * plane.base_pitch
                reached = error[i] + (error[i + 1] - error[i]) * n / substeps
                for k in range(y.size):
                    following = line - y[k] * plane.tan_base_helix
                    if 0.0 < following < plane.path_length:
                        approach = reached - (profile_gap(form, following) + across[k])
                        before = load[k]
                        load[k], log_load[k] = load_under(compliance, approach, following, log_load[k])
                        doubled[k] += (before + load[k]) * (following - x[k])
                        x[k] = following
    ends = loads_at(mesh, phase, error, np.full(y.size, plane.path_length), y)
    doubled += (load + ends) * (plane.path_length - x)
    return 0.5 * doubled / plane.base_pitch


def contact_points(
    path: PathOfContact, x: FloatArray, load: FloatArray, pinion_speed: float, modulus: float
) -> ContactPoints:
    """Return the contacts at points x [m] of the path under line loads [N/m], arrays of one shape; modulus E' [Pa]."""
    radius = reduced_radius(path.plane, x)
    half_width = hertz.half_width(load, np.where(radius < path.plane.least_radius, 0.0, radius), modulus)
    return ContactPoints(load, half_width, radius, *path.surface_speeds(x, pinion_speed))


def feature_line(
    path: PathOfContact,
    balance: LoadBalance,
    pinion_speed: float,
    tangential_force: float,
    modulus: float,
    psi: FloatArray,
) -> FeatureLine:
    """The points at psi in 0..1 (n,), x = psi g_alpha, y = psi b; F_bt [N], E' [Pa] (Eq. S1)."""
    x = psi * path.length
    load = line_loads(balance, x, psi * path.plane.face_width)
    line = contact_points(path, x, load, pinion_speed, modulus)
    sharing = iso_load_sharing(path, x)
    return FeatureLine(
        gamma=frozen(path.profile_parameter(x)),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(path.plane, line.radius, load, modulus)),
        half_width=frozen(line.half_width),
        radius=frozen(line.radius),
        pinion_speed=frozen(line.pinion_speed),
        wheel_speed=frozen(line.wheel_speed),
        psi=frozen(psi),
        load_sharing=None if tangential_force == 0.0 else frozen(_load_sharing(path, load, tangential_force)),
        iso_load_sharing=None if sharing is None else frozen(sharing),
    )


def _load_sharing(path: PathOfContact, load: FloatArray, tangential_force: float) -> FloatArray:
    """X = w b / F_bt: what the standard's load-sharing factor is for."""
    return load * path.plane.face_width / tangential_force


def flank(balance: LoadBalance, modulus: float, profile_points: int, face_points: int) -> Flank:
    """Maps [profile, face] from A to E and from the end that meshes first; modulus E' [Pa]."""
    plane = balance.mesh.plane
    profile, face = np.linspace(0.0, 1.0, profile_points), np.linspace(0.0, 1.0, face_points)
    x, y = profile * plane.path_length, face * plane.face_width
    gap, load = _maps(balance.mesh, balance.rolls.phase, balance.transmission_error, balance.force > 0.0, x, y)
    return Flank(
        profile_fraction=frozen(profile),
        face_fraction=frozen(face),
        modification=frozen(gap),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(plane, reduced_radius(plane, x[:, None]), load, modulus)),
    )


@kernel
def _maps(
    mesh: Mesh, phase: FloatArray, error: FloatArray, loaded: bool, x: FloatArray, y: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gap Delta [m] and line load w [N/m] over a grid.

    A point's load starts from that in the row before, which waits for no neighbour.
    """
    plane, compliance, form = mesh.plane, mesh.compliance, mesh.gap
    gaps, loads = np.empty((x.size, y.size)), np.zeros((x.size, y.size))
    across = lead_gaps(form, y)
    log_load, index = np.zeros(y.size), 0
    for i in range(x.size):
        along = profile_gap(form, x[i])
        constant, limit = compliance_at(compliance, x[i])
        for k in range(y.size):
            gaps[i, k] = along + across[k]
            if loaded:
                reached, index = error_at(plane, phase, error, x[i], y[k], index)
                loads[i, k], _, log_load[k] = line_load(
                    reached - gaps[i, k], constant, compliance.logarithmic, limit, log_load[k]
                )
    return gaps, loads


def contact_pressure(plane: ContactPlane, radius: FloatArray, load: FloatArray, modulus: float) -> FloatArray:
    """Compute the Hertzian pressure p_H [Pa] at reduced radii [m] under line loads w [N/m].

    0 without load; NaN near a base circle, towards which the reduced radius vanishes and pressure has no limit.
    Eq. 14 prints pi/4 of it, the mean pressure, and calls it the maximum.
    """
    defined = radius >= plane.least_radius
    pressure = hertz.maximum_pressure(load, np.where(defined, radius, 1.0), modulus)
    return np.where(defined, pressure, np.nan)
