"""Load over the face as a function of the gap over the face, and the derivative of this function.

The load and its derivative couple the mesh and the shafts. Load and gap are given at equidistant stations over the
face; between stations the gap is linear. Hat functions distribute a force on the face over the stations. The hat
function of a station is 1 at the station, 0 at the neighbouring stations, and linear in between.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray, copy
from solvers.compiled import inner_kernel, kernel
from solvers.errors import NoSolution
from solvers.scuffing.contact_lines import RollPositions
from solvers.scuffing.contact_slices import Mesh, Slices, gather, slice_table
from solvers.scuffing.load_balance import TOLERANCE, solve_near


@dataclass(frozen=True, slots=True)
class FaceResponse:
    """Mean transverse forces [N] at the stations, and their derivatives by the gaps [N/m] (rows: forces).

    Rows and columns add up to 0: the sum of forces is given, and an equal gap changes none. `error` [m] and `log_load`
    start the next response.
    """

    force: FloatArray
    derivative: FloatArray
    error: FloatArray
    log_load: FloatArray


def face_response(
    mesh: Mesh, rolls: RollPositions, force: float, slices: int, stations: int, start: FaceResponse | None = None
) -> FaceResponse:
    """Compute the forces over the face and their derivatives with respect to the gaps over the face (Eq. L20).

    Raises NoSolution: `load_balance` if the load balance does not converge.
    """
    share = np.zeros(rolls.phase.size)
    share[:-1] += np.diff(rolls.phase) / 2
    share[1:] += np.diff(rolls.phase) / 2
    share *= mesh.plane.cos_base_helix / rolls.phase[-1]
    if start is None:
        error = np.full(share.size, np.nan)
        log_load = np.zeros((share.size, slice_table(mesh, slices).load.size))
    else:
        error, log_load = start.error.copy(), start.log_load.copy()
    spread, derivative = np.zeros(stations), np.zeros((stations, stations))
    if force > 0.0:
        worst = _respond(mesh, rolls.phase, rolls.side, share, force, slices, error, log_load, spread, derivative)
        if not worst <= TOLERANCE:
            raise NoSolution("load_balance", "the load balance did not converge", {"relative_force": worst})
    return FaceResponse(spread, derivative, error, log_load)


@kernel
def _respond(
    mesh: Mesh,
    phase: FloatArray,
    side: FloatArray,
    share: FloatArray,
    force: float,
    slices: int,
    error: FloatArray,
    log_load: FloatArray,
    spread: FloatArray,
    derivative: FloatArray,
) -> float:
    """Add forces and their derivatives of all roll positions; return the largest residual of the load balance.

    The force at station a is sum w dl hat_a; its derivative k k^T/(1^T k) - P, P_ab = sum (dw/ddelta) dl hat_a hat_b, k
    = P 1. `share` weighs a position, times cos beta_b.
    """
    table, worst = slice_table(mesh, slices), 0.0
    springs = np.zeros(spread.size)
    for i in range(phase.size):
        count = gather(mesh, phase[i], side[i], slices, np.inf, table).slices
        near = i if error[i] == error[i] else max(i - 1, 0)
        copy(log_load[near], table.log_load, count)
        error[i], residual, _ = solve_near(table, count, mesh.compliance.logarithmic, force, error[near])
        copy(table.log_load, log_load[i], count)
        worst = max(worst, residual)
        springs[:] = 0.0
        _spread(mesh, table, count, share[i], spread, derivative, springs)
        total = springs.sum()
        for a in range(springs.size):
            if springs[a] > 0.0:
                for b in range(springs.size):
                    derivative[a, b] += springs[a] * springs[b] / total
    return worst


@inner_kernel
def _spread(
    mesh: Mesh,
    table: Slices,
    count: int,
    share: float,
    spread: FloatArray,
    derivative: FloatArray,
    springs: FloatArray,
) -> None:
    """Add the loads of all slices at a roll position to the stations, and likewise the stiffnesses."""
    steps_per_metre = (spread.size - 1) / mesh.plane.face_width
    for n in range(count):
        if table.load[n] <= 0.0:
            continue
        position = table.y[n] * steps_per_metre
        low = min(int(position), spread.size - 2)
        high = position - low
        load, spring = table.load[n] * table.length[n] * share, table.stiffness[n] * table.length[n] * share
        spread[low] += load * (1.0 - high)
        spread[low + 1] += load * high
        springs[low] += spring * (1.0 - high)
        springs[low + 1] += spring * high
        derivative[low, low] -= spring * (1.0 - high) ** 2
        derivative[low + 1, low + 1] -= spring * high**2
        derivative[low, low + 1] -= spring * high * (1.0 - high)
        derivative[low + 1, low] -= spring * high * (1.0 - high)
