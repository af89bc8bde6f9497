"""Friction power and the moments that bend the hub, one mesh, means over one tooth pitch or one revolution."""

from dataclasses import dataclass
from functools import cache, lru_cache
from math import asin, cos, hypot, pi, tan
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.results import Geometry, Losses
from solvers.coupling.teeth.kinematics import MeshMotion, ToothPositions, positions_per_pitch, tooth_positions
from solvers.coupling.teeth.loads import mesh_loads

ROUNDING = 1e-12
"""Share of what its parts may add up to below which a sum is their rounding."""
_PITCH_PARTS = 3  # chosen: parts of a pitch, with a Gauss rule of _PITCH_NODES each
_PITCH_NODES = 8  # chosen: 24 angles a pitch, and exact for polynomials up to degree 15 in each part
_gauss_rule = cache(np.polynomial.legendre.leggauss)


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


@dataclass(frozen=True, slots=True)
class RotorSamples:
    """Quadrature over rotor angles: `weight` (rows) adds up to one, `teeth` are all tooth positions (rows, teeth)."""

    weight: FloatArray
    teeth: ToothPositions


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """One mesh over a pitch: its motion, and what loads and friction of its teeth add up to."""

    motion: MeshMotion
    sums: ToothSums


def friction_reversals(mesh: MeshMotion, axial_velocity: float) -> list[float]:
    """Tooth angles [rad] at which the sliding velocity equals 0 or + or - the axial velocity."""
    angles = [0.0, pi]
    if abs(axial_velocity) < abs(mesh.sliding):
        reversal = asin(axial_velocity / mesh.sliding)
        angles += [reversal, pi - reversal, -reversal, pi + reversal]
    return angles


def rotor_samples(coupling: Coupling, mesh: MeshMotion, axial_velocity: float) -> RotorSamples:
    """Gauss points between the rotor angles at which friction reverses at some tooth.

    Friction jumps where a tooth's relative velocity changes sign; breaking the pitch there leaves an integrand that
    is continuous, with kinks only where a tooth comes under load. Several hundred midpoints do no better.
    """
    uneven = coupling.pitch_errors is not None
    return _samples(coupling.teeth, uneven, tuple(friction_reversals(mesh, axial_velocity)))


@lru_cache(maxsize=4)
def _samples(teeth: int, uneven: bool, reversals: tuple[float, ...]) -> RotorSamples:
    """The same points at any misalignment while nothing moves along the axis."""
    pitch = 2.0 * pi / teeth
    breaks = [angle % pitch for angle in reversals]
    if uneven:
        nodes, weights = _gauss_rule(positions_per_pitch(teeth))
        turns = teeth
    else:
        breaks += [pitch * part / _PITCH_PARTS for part in range(_PITCH_PARTS)]
        nodes, weights = _gauss_rule(_PITCH_NODES)
        turns = 1
    edges = np.array(sorted({0.0, pitch, *breaks}))
    middle, half = (edges[1:] + edges[:-1]) / 2.0, (edges[1:] - edges[:-1]) / 2.0
    keep = half > 1e-12 * pitch
    one_pitch = (middle[keep, None] + half[keep, None] * nodes).ravel()
    weight = (half[keep, None] * weights).ravel() / (pitch * turns)
    angles = (one_pitch + pitch * np.arange(turns)[:, None]).ravel()
    found = tooth_positions(angles, teeth)
    return RotorSamples(frozen(np.tile(weight, turns)), ToothPositions(frozen(found.sine), frozen(found.cosine)))


def loaded_mesh(inputs: CouplingInputs, mesh: MeshMotion) -> LoadedMesh:
    """Tooth loads of the single mesh over one tooth pitch, or one revolution with pitch errors."""
    samples = rotor_samples(inputs.coupling, mesh, inputs.operation.axial_velocity)
    floating = inputs.model.sleeve == "floating"
    loads = mesh_loads(inputs.coupling, mesh, samples.teeth, inputs.operation.torque, floating=floating)
    sums = tooth_sums(
        loads.tangential_force,
        samples.teeth.sine,
        samples.teeth.cosine,
        samples.weight,
        mesh.sliding,
        inputs.operation.axial_velocity,
    )
    return LoadedMesh(mesh, sums)


def losses(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> Losses:
    """Power P = sum mu F_n |v_r| [W] and moments [N m] of the mesh of the driving hub, v_r = v_ax + v_G.

    Friction's moment about the pivot direction, against the tilting motion, is M_f = r_o sum mu F_n sgn(v_r)
    sgn(v_G1) sin phi with v_G1 the sliding velocity at 90 degrees: P = M_f omega delta + F_ax v_ax. It is zero where
    nothing tilts, and where nothing slides at all it is open. The power balance leaves M_f - T delta/2 of it to bend
    the driving hub, whatever the load distribution. Eqs. C25, C28.
    """
    operation, sums = inputs.operation, loaded.sums
    scale = friction / cos(inputs.coupling.pressure_angle)
    lever = scale * geometry.pitch_radius * float(np.sign(loaded.motion.sliding))
    friction_moment = lever * without_rounding(sums.tilting, sums.load)
    shift_moment = contact_shift_moment(inputs, geometry, loaded)
    tilting_moment = shift_moment
    if inputs.model.kinematics == "spatial":
        # Only the pivoting motion feels friction's moment about the tilt axis, -r_o sum mu F_n cos(phi) sgn.
        tilting_moment -= lever * without_rounding(sums.pivoting, sums.load)
    return Losses(
        friction_power=scale * sums.power,
        friction_moment=friction_moment,
        contact_shift_moment=shift_moment,
        hub_bending_moment=hypot(
            friction_moment - operation.torque * abs(operation.misalignment) / 2.0, tilting_moment
        ),
    )


def equal_loads_friction_moment(coaxial_limit: float, pitch_radius: float) -> float:
    """(2/pi) mu T/cos(alpha) [N m], friction's moment against a tilt with equal tooth loads (Eq. C26).

    `coaxial_limit` is that of the thrust, mu T/(r_o cos alpha) [N].
    """
    return 2.0 / pi * pitch_radius * coaxial_limit


def contact_shift_moment(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh) -> float:
    """M_s = |sum z_c F_n n_x| [N m], moment about the tilt axis of tooth forces off the middle of the face (Eq. C27).

    Both factors are harmonics of phi: their product is one of sin^2, sin cos and cos^2. `tangential`: z_c = s_1 and
    the tangential part of n; R_t delta T/(2 r_o) for equal loads. `spatial`: z_c = s_1 - delta r_o cos phi, the
    contact's place in the sleeve's frame, and all of n. Both equal sum F_t df_t/d delta. The y components of n add
    T delta/2 about the pivot direction in space, which the power balance of the hub already holds.
    """
    motion, sums = loaded.motion, loaded.sums
    arm_sin, arm_cos, normal_sin, normal_cos = motion.travel_sin, 0.0, -motion.side, 0.0
    if inputs.model.kinematics == "spatial":
        arm_cos = motion.travel_cos - inputs.operation.misalignment * geometry.pitch_radius
        normal_cos = tan(motion.pressure_angle)
    return abs(
        arm_sin * normal_sin * sums.tilted
        + (arm_sin * normal_cos + arm_cos * normal_sin) * sums.mixed
        + arm_cos * normal_cos * sums.pivoted
    )
