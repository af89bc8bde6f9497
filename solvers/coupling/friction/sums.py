"""What friction adds up to over the teeth of one mesh, in one pass over rotor angles and teeth."""

from typing import NamedTuple

from solvers.arrays import FloatArray
from solvers.compiled import kernel

ROUNDING = 1e-12
"""Share of what its parts may add up to below which a sum is their rounding."""


class FrictionSums(NamedTuple):
    """Sums over the teeth of tangential force times direction and place, averaged over rotor angles.

    With the direction of friction sgn(v_r): `load` sum F_t, `axial` sum F_t sgn(v_r), `still` sum F_t of teeth without
    relative velocity, `tilting` sum F_t sgn(v_r) sin(phi), `pivoting` sum F_t sgn(v_r) cos(phi) [N]; `power` sum
    F_t |v_r| [W].
    """

    load: float
    axial: float
    still: float
    tilting: float
    pivoting: float
    power: float


@kernel
def friction_sums(
    force: FloatArray, sine: FloatArray, cosine: FloatArray, weight: FloatArray, sliding: float, axial_velocity: float
) -> FrictionSums:
    """Sums of `force`, `sine`, `cosine` (rows, teeth) under the relative velocity v_r = v_ax + v_G sin(phi)."""
    load = axial = still = tilting = pivoting = power = 0.0
    for row in range(force.shape[0]):
        for i in range(force.shape[1]):
            share = weight[row] * force[row, i]
            velocity = axial_velocity + sliding * sine[row, i]
            load += share
            power += share * abs(velocity)
            if velocity == 0.0:
                still += share
            else:
                directed = share if velocity > 0.0 else -share
                axial += directed
                tilting += directed * sine[row, i]
                pivoting += directed * cosine[row, i]
    return FrictionSums(load, axial, still, tilting, pivoting, power)


def without_rounding(value: float, scale: float) -> float:
    """The value, or zero where it is below 1e-12 of what its parts may add up to: the rounding of their sum."""
    return 0.0 if abs(value) < ROUNDING * abs(scale) else value
