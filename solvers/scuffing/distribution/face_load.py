"""How the face shares the load: the force over it, mean over a base pitch, and its largest over its mean value."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.scuffing.balance.contact_slices import Mesh, load_under
from solvers.scuffing.balance.load_balance import LoadBalance, loads_at
from solvers.scuffing.flank.contact_lines import line_count
from solvers.scuffing.flank.modification import kinks_along_face, lead_gaps, profile_gap

SUBSTEPS = 4  # of a step between roll positions, where lines are loaded in part
FACE_POINTS = 101
NEARLY = 0.98
TOPS = 3
ZOOMS = 3
ZOOM_POINTS = 7
SAME = 1e-6  # of the range looked at, or of a length


def face_load_factor(balance: LoadBalance, y: float) -> float:
    """K_H_beta = largest over mean of q(y) = int w dx / p_bt (the idea of ISO 6336-1, annex E) of a loaded mesh.

    Looked for at equidistant points, at kinks of the gap and at y [m], where a peak is, and closer around the largest.
    The mean is the force in balance over the face. Where to look closer is seen without steps between roll positions,
    which errs for lines loaded in part: there at every place that is nearly the largest.
    """
    plane = balance.mesh.plane
    places = _apart([*np.linspace(0.0, plane.face_width, FACE_POINTS), *kinks_along_face(balance.mesh.gap), y])
    tops = _tops(face_loads(balance, places, 1))[-TOPS if _in_part(balance) else -1 :]
    largest = max(_largest_around(balance, places, top) for top in tops)
    return largest * plane.face_width / (balance.force * plane.cos_base_helix)


def _in_part(balance: LoadBalance) -> bool:
    """Whether any line is loaded in part."""
    return bool(np.any(balance.survey.loaded_length < (1 - SAME) * balance.survey.length))


def _tops(shares: FloatArray) -> list[int]:
    """Local maxima that are nearly as large as the largest, in ascending order."""
    edged = np.pad(shares, 1, constant_values=-np.inf)
    local = np.flatnonzero((shares > edged[:-2]) & (shares >= edged[2:]) & (shares >= NEARLY * shares.max()))
    return sorted(local.tolist(), key=lambda k: float(shares[k]))


def _largest_around(balance: LoadBalance, places: FloatArray, top: int) -> float:
    """Largest force per face width [N/m] between the neighbours of a place."""
    for _ in range(ZOOMS):
        low, high = places[max(top - 1, 0)], places[min(top + 1, places.size - 1)]
        places = _apart([*np.linspace(low, high, ZOOM_POINTS), places[top]])
        shares = face_loads(balance, places)
        top = int(np.argmax(shares))
    return float(shares.max())


def _apart(places: list[float]) -> FloatArray:
    """Places in order, without those that only rounding tells from their neighbour and that would hide it."""
    found = np.unique(places)
    return np.asarray(found[np.append(np.diff(found) > SAME * (found[-1] - found[0]), True)])


def face_loads(balance: LoadBalance, y: FloatArray, substeps: int = SUBSTEPS) -> FloatArray:
    """Force per face width q = int w dx / p_bt [N/m] at distances y [m] from the end that meshes first.

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
