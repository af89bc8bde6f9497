"""How the teeth of one mesh balance the torque: the kernels.

Lengths count in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. Tooth i interferes by
u_i = psi + w_i and carries max(0, u_i), for teeth never pull: psi is the common rotation, w_i how far the tooth is
ahead.
"""

from solvers.arrays import FloatArray
from solvers.compiled import kernel


@kernel
def _crossing(ahead: FloatArray, highest: float, psi: float) -> float:
    """Where the teeth that psi > 0 loads would carry unit torque: Newton's step on sum max(0, psi + lead_i) = 1."""
    count, total = 0, 0.0
    for lead in ahead:
        behind = lead - highest
        if psi + behind > 0.0:
            count += 1
            total += behind
    return (1.0 - total) / count


@kernel
def rotation_of_leads(ahead: FloatArray, highest: float, start: float) -> float:
    """The psi at which sum max(0, psi + lead_i) = 1, exactly, for leads w_i less the highest of them.

    Equal to sorting them in falling order and taking the largest k whose psi_k = (1 - sum_1..k lead)/k loads tooth k.
    The sum is convex and linear in pieces: Newton's first step leads to the right of psi from any `start` > 0, the
    others fall, each by at least one tooth less, until they have found the piece.
    """
    psi = _crossing(ahead, highest, start)
    following = _crossing(ahead, highest, psi)
    while following < psi:
        psi, following = following, _crossing(ahead, highest, following)
    return psi


@kernel
def turn_to_torque(ahead: FloatArray, start: float) -> tuple[float, float]:
    """Turn w_i in `ahead` into the u_i that carry unit torque.

    Returns the common rotation psi against the highest w_i, which is sought from `start`, and against all.
    """
    highest: float = ahead[0]
    for lead in ahead:
        highest = max(highest, lead)
    psi = rotation_of_leads(ahead, highest, start)
    for i in range(ahead.size):
        ahead[i] = ahead[i] - highest + psi
    return psi, psi - highest


@kernel
def centred_rows(ahead: FloatArray, unit: float, unit_force: float, rotation: FloatArray) -> None:
    """Turn how far teeth are ahead into the forces of a centred sleeve, row by row, and note its rotation.

    `unit` and `unit_force` are what lengths and forces count in, T/(r_o c_t) and T/r_o.
    """
    psi = 1.0
    for row in range(ahead.shape[0]):
        for i in range(ahead.shape[1]):
            ahead[row, i] /= unit
        psi, turned = turn_to_torque(ahead[row], psi)
        rotation[row] = unit * turned
        for i in range(ahead.shape[1]):
            ahead[row, i] = unit_force * max(0.0, ahead[row, i])
