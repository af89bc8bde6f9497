"""How the load over the face answers to a gap over the face: what shafts and mesh have to agree on.

Both are counted at equidistant stations over the face, between which gaps are linear: a station's share of a force
is weighed by its hat, the linear function that is 1 there and 0 at its neighbours.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.scuffing.contact_lines import line_count
from solvers.scuffing.contact_slices import CONSTANT, GAP, LENGTH, LIMIT, ROWS, Mesh, Y, gather
from solvers.scuffing.load_balance import LoadBalance
from solvers.scuffing.tooth_stiffness import line_load


@dataclass(frozen=True, slots=True)
class FaceResponse:
    """Transverse `force` [N] at the stations, mean over a base pitch, and its derivative [N/m] by the gap there.

    At every roll position the force over the whole face stays what it is, so rows and columns of the derivative add up
    to 0.
    """

    force: FloatArray
    derivative: FloatArray


def face_response(balance: LoadBalance, slices: int, stations: int) -> FaceResponse:
    """Force at `stations` equidistant points from y = 0 to b, both included, and its derivative by the gap there."""
    phase = balance.rolls.phase
    share = np.zeros(phase.size)
    share[:-1] += np.diff(phase) / 2
    share[1:] += np.diff(phase) / 2
    force, derivative = _response(
        balance.mesh,
        phase,
        balance.rolls.side,
        share / phase[-1] * balance.mesh.plane.cos_base_helix,
        balance.transmission_error,
        balance.force > 0.0,
        slices,
        stations,
    )
    return FaceResponse(force, derivative)


@kernel
def _response(
    mesh: Mesh,
    phase: FloatArray,
    side: FloatArray,
    share: FloatArray,
    error: FloatArray,
    loaded: bool,
    slices: int,
    stations: int,
) -> tuple[FloatArray, FloatArray]:
    """Sums of w dl hat and, with P_ab = sum (dw/ddelta) dl hat_a hat_b and k = P 1, of k k^T / (1^T k) - P."""
    force, derivative = np.zeros(stations), np.zeros((stations, stations))
    table = np.zeros((ROWS, line_count(mesh.plane) * slices))
    steps_per_metre = (stations - 1) / mesh.plane.face_width
    for i in range(phase.size if loaded else 0):
        count, _ = gather(mesh, phase[i], side[i], slices, table)
        whole, omega = np.zeros(stations), 0.0
        for n in range(count):
            load, stiffness, omega = line_load(
                error[i] - table[GAP, n], table[CONSTANT, n], mesh.compliance.logarithmic, table[LIMIT, n], omega
            )
            position = table[Y, n] * steps_per_metre
            low = min(int(position), stations - 2)
            high = position - low
            length = table[LENGTH, n] * share[i]
            force[low] += load * length * (1.0 - high)
            force[low + 1] += load * length * high
            spring = stiffness * length
            whole[low] += spring * (1.0 - high)
            whole[low + 1] += spring * high
            derivative[low, low] -= spring * (1.0 - high) ** 2
            derivative[low + 1, low + 1] -= spring * high**2
            derivative[low, low + 1] -= spring * high * (1.0 - high)
            derivative[low + 1, low] -= spring * high * (1.0 - high)
        total = whole.sum()
        for a in range(stations):
            if whole[a] > 0.0:
                for b in range(stations):
                    derivative[a, b] += whole[a] * whole[b] / total
    return force, derivative
