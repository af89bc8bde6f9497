"""How the teeth of one mesh balance the torque: the kernels.

Lengths count in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. Tooth i interferes by
u_i = psi + w_i and carries max(0, u_i), for teeth never pull: psi is the common rotation, w_i how far the tooth is
ahead.
"""

from solvers.arrays import FloatArray
from solvers.compiled import kernel


@kernel
def rotation_of_leads(lead: FloatArray) -> float:
    """The psi at which sum max(0, psi + lead_i) = 1, exactly, for leads whose largest is zero.

    Equal to sorting them in falling order and taking the largest k whose psi_k = (1 - sum_1..k lead)/k loads tooth k.
    Newton from the right on the convex, piecewise linear sum drops at least one tooth a step and ends on it.
    """
    loaded = lead.size + 1
    psi = 1.0
    while True:
        count = 0
        total = 0.0
        for behind in lead:
            if psi + behind > 0.0:
                count += 1
                total += behind
        if count == loaded:
            return psi
        loaded = count
        psi = (1.0 - total) / count


@kernel
def turn_to_torque(ahead: FloatArray) -> float:
    """Turn w_i in `ahead` into the u_i that carry unit torque; returns the common rotation psi."""
    highest: float = ahead.max()
    for i in range(ahead.size):
        ahead[i] -= highest
    psi = rotation_of_leads(ahead)
    for i in range(ahead.size):
        ahead[i] += psi
    return psi - highest


@kernel
def centred_rows(interference: FloatArray, share: FloatArray, rotation: FloatArray) -> None:
    """Shares and rotation of a centred sleeve, row by row."""
    for row in range(interference.shape[0]):
        share[row] = interference[row]
        rotation[row] = turn_to_torque(share[row])
        for i in range(interference.shape[1]):
            share[row, i] = max(0.0, share[row, i])
