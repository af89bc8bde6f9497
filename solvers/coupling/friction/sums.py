"""What loads and friction add up to over the teeth of one mesh, in one pass over rotor angles and teeth."""

from typing import NamedTuple

from solvers.arrays import FloatArray
from solvers.compiled import kernel

ROUNDING = 1e-12
"""Share of what its parts may add up to below which a sum is their rounding."""


class ToothSums(NamedTuple):
    """Sums over the teeth of tangential force times direction and place, averaged over rotor angles.

    With the direction of friction sgn(v_r): `load` sum F_t, `axial` sum F_t sgn(v_r), `still` sum F_t of teeth without
    relative velocity, `tilting` sum F_t sgn(v_r) sin(phi), `pivoting` sum F_t sgn(v_r) cos(phi) [N]; `power` sum
    F_t |v_r| [W]. Without friction: `tilted` sum F_t sin^2(phi), `mixed` sum F_t sin(phi) cos(phi), `pivoted` sum
    F_t cos^2(phi) [N].
    """

    load: float
    axial: float
    still: float
    tilting: float
    pivoting: float
    power: float
    tilted: float
    mixed: float
    pivoted: float


@kernel
def tooth_sums(
    force: FloatArray, sine: FloatArray, cosine: FloatArray, weight: FloatArray, sliding: float, axial_velocity: float
) -> ToothSums:
    """Sums of `force`, `sine`, `cosine` (rows, teeth) under the relative velocity v_r = v_ax + v_G sin(phi)."""
    load = axial = still = tilting = pivoting = power = tilted = mixed = pivoted = 0.0
    for row in range(force.shape[0]):
        for i in range(force.shape[1]):
            s, c, share = sine[row, i], cosine[row, i], weight[row] * force[row, i]
            velocity = axial_velocity + sliding * s
            load += share
            tilted += share * s * s
            mixed += share * s * c
            pivoted += share * c * c
            power += share * abs(velocity)
            if velocity == 0.0:
                still += share
            else:
                directed = share if velocity > 0.0 else -share
                axial += directed
                tilting += directed * s
                pivoting += directed * c
    return ToothSums(load, axial, still, tilting, pivoting, power, tilted, mixed, pivoted)


def without_rounding(value: float, scale: float) -> float:
    """The value, or zero where it is below 1e-12 of what its parts may add up to: the rounding of their sum."""
    return 0.0 if abs(value) < ROUNDING * abs(scale) else value
