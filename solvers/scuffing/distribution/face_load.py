"""How the face shares the load: the force over it, mean over a base pitch, and its largest over its mean value."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.scuffing.balance.contact_slices import Mesh, load_at
from solvers.scuffing.balance.load_balance import LoadBalance, line_loads
from solvers.scuffing.flank.contact_lines import line_count
from solvers.scuffing.flank.modification import kinks_along_face

SUBSTEPS = 4  # of a step between roll positions, where lines are loaded in part
FACE_POINTS = 101
ZOOMS = 4
ZOOM_POINTS = 7
SAME = 1e-6  # of the range looked at, or of a length


def face_load_factor(balance: LoadBalance, y: float) -> float:
    """K_H_beta = largest over mean of q(y) = int w dx / p_bt (the idea of ISO 6336-1, annex E) of a loaded mesh.

    Looked for at equidistant points, at kinks of the gap and at y [m], where a peak is, and closer around the largest.
    The mean is the force in balance over the face. Where to look closer is seen without steps between roll positions.
    """
    plane = balance.mesh.plane
    places = _apart([*np.linspace(0.0, plane.face_width, FACE_POINTS), *kinks_along_face(balance.mesh.gap), y])
    for zoom in range(ZOOMS):
        shares = face_loads(balance, places, 1 if zoom == 0 else SUBSTEPS)
        top = int(np.argmax(shares))
        low, high = places[max(top - 1, 0)], places[min(top + 1, places.size - 1)]
        places = _apart([*np.linspace(low, high, ZOOM_POINTS), places[top]])
    return float(shares.max() * plane.face_width / (balance.force * plane.cos_base_helix))


def _apart(places: list[float]) -> FloatArray:
    """Places in order, without those that only rounding tells from their neighbour and that would hide it."""
    found = np.unique(places)
    return np.asarray(found[np.append(np.diff(found) > SAME * (found[-1] - found[0]), True)])


def face_loads(balance: LoadBalance, y: FloatArray, substeps: int = SUBSTEPS) -> FloatArray:
    """Force per face width q = int w dx / p_bt [N/m] at distances y [m] from the end that meshes first.

    Where lines are loaded in part, load ends between roll positions, whose steps are then cut into `substeps`.
    """
    plane = balance.mesh.plane
    starts = line_loads(balance, np.zeros(y.size), y)
    ends = line_loads(balance, np.full(y.size, plane.path_length), y)
    in_part = np.any(balance.survey.loaded_length < (1 - SAME) * balance.survey.length)
    steps = substeps if in_part else 1
    return _face_loads(balance.mesh, balance.rolls.phase, balance.transmission_error, steps, y, starts, ends)


@kernel
def _face_loads(
    mesh: Mesh,
    phase: FloatArray,
    error: FloatArray,
    substeps: int,
    y: FloatArray,
    starts: FloatArray,
    ends: FloatArray,
) -> FloatArray:
    """Trapezia along the path from A to E, whose loads are known, over the roll positions whose lines pass between."""
    plane, loads, omega = mesh.plane, np.zeros(y.size), 0.0
    for k in range(y.size):
        x, load = 0.0, starts[k]
        for j in range(line_count(plane)):
            for i in range(phase.size - 1):
                first = phase[i] + j * plane.base_pitch - y[k] * plane.tan_base_helix
                step = (phase[i + 1] - phase[i]) / substeps
                for n in range(substeps + 1 if step > 0.0 else 0):
                    following = first + n * step
                    if not 0.0 < following < plane.path_length:
                        continue
                    local = error[i] + (error[i + 1] - error[i]) * n / substeps
                    before = load
                    load, omega = load_at(mesh, local, following, y[k], omega)
                    loads[k] += 0.5 * (before + load) * (following - x)
                    x = following
        loads[k] += 0.5 * (load + ends[k]) * (plane.path_length - x)
    return loads / plane.base_pitch
