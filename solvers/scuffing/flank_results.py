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

SUBSTEPS = 4  # number of substeps per step between roll positions, if a line is loaded over a part of its length only
FACE_POINTS = 101  # one point per percent of the face
NEARLY = 0.98  # share of the largest value; a lower top (local maximum) cannot become the largest on finer grids
TOPS = 3  # number of tops (local maxima) that are refined, beginning with the highest
ZOOMS = 3  # number of zooms; every zoom narrows the range that contains the maximum by a factor of 3
ZOOM_POINTS = 7  # number of points per zoom; they lie between the neighbours of a top
SAME = 1e-6  # share of the range of places, or of a length; smaller differences are rounding


def face_load_factor(balance: LoadBalance, y: float) -> float:
    """K_Hbeta: largest over mean of q(y) = int w dx/p_bt, the idea of ISO 6336-1, annex E [-] (Eq. L17).

    The largest is searched on a grid with `y`, then around it and, where lines are partly loaded, around two more
    maxima.
    """
    plane = balance.mesh.plane
    evenly = np.linspace(0.0, plane.face_width, FACE_POINTS)
    places = _apart(np.append(evenly, [*kinks_along_face(balance.mesh.gap), y]))
    highest = tops(face_loads(balance, places, 1))[-TOPS if _in_part(balance) else -1 :]
    largest = max(_largest_around(balance, places, top) for top in highest)
    factor = largest * plane.face_width / (balance.force * plane.cos_base_helix)
    return max(factor, 1.0)  # only an error of the trapezoidal rule makes the largest value less than the mean


def _in_part(balance: LoadBalance) -> bool:
    """Return True if any line is loaded over a part of its length only."""
    return bool(np.any(balance.survey.loaded_length < (1 - SAME) * balance.survey.length))


def tops(values: FloatArray) -> list[int]:
    """Indices of the largest value (last) and of local maxima that are nearly as large."""
    edged = np.concatenate([[-np.inf], values, [-np.inf]])
    local = np.flatnonzero((values > edged[:-2]) & (values >= edged[2:]) & (values >= NEARLY * values.max()))
    return sorted(local.tolist(), key=lambda k: float(values[k]))


def _largest_around(balance: LoadBalance, places: FloatArray, top: int) -> float:
    """Largest force per face width [N/m] between the neighbours of `places[top]`."""
    for _ in range(ZOOMS):
        low, high = places[max(top - 1, 0)], places[min(top + 1, places.size - 1)]
        places = _apart(np.append(np.linspace(low, high, ZOOM_POINTS), places[top]))
        shares = face_loads(balance, places)
        top = int(np.argmax(shares))
    return float(shares.max())


def _apart(places: FloatArray) -> FloatArray:
    """Sort the positions on the face, and drop a position that differs from the next position only by rounding."""
    ascending = np.sort(places)
    return np.asarray(ascending[np.append(np.diff(ascending) > SAME * (ascending[-1] - ascending[0]), True)])


def face_loads(balance: LoadBalance, y: FloatArray, substeps: int = SUBSTEPS) -> FloatArray:
    """Force per face width over the face [N/m]; `substeps` serve partly loaded lines (Eq. L17)."""
    phase, error = balance.rolls.phase, balance.transmission_error
    return _face_loads(balance.mesh, phase, error, substeps if _in_part(balance) else 1, y)


@kernel
def _face_loads(mesh: Mesh, phase: FloatArray, error: FloatArray, substeps: int, y: FloatArray) -> FloatArray:
    """Line load along the path from A to E by the trapezoidal rule, for every y; both sides of jumps of TE count."""
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
    """Return the contacts at the distances x [m] from A, under the line loads `load` [N/m].

    Distances and loads are arrays of one shape. `modulus` is the reduced modulus E' [Pa].
    """
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
    """Compute load, pressure and speeds along the feature line (Eq. S1)."""
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
    """Return X = w b / F_bt; this ratio can be compared with the load-sharing factor of ISO/TS 6336-20."""
    return load * path.plane.face_width / tangential_force


def flank(balance: LoadBalance, modulus: float, profile_points: int, face_points: int) -> Flank:
    """Maps [profile, face] over the flank, from A to E and from the end that meshes first; `modulus` is E' [Pa]."""
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
    """Gap [m] and line load [N/m] over a grid; each row starts from the one before, so that points run in parallel."""
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
    """Hertzian pressure at points of the flank; the paper's "maximum" is the mean, pi/4 of it (Eq. 14)."""
    defined = radius >= plane.least_radius
    pressure = hertz.maximum_pressure(load, np.where(defined, radius, 1.0), modulus)
    return np.where(defined, pressure, np.nan)
