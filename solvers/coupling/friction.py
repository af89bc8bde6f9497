"""Effects of friction on the teeth of one mesh: axial thrust, losses and the moments that bend the hub.

Means over one tooth pitch, or over one revolution with pitch deviations. Thrust: Figs 14 to 16, and the closed forms of
two meshes, Figs 13 and 17.
"""

from dataclasses import dataclass
from math import asin, copysign, cos, hypot, pi, tan
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, without_rounding
from solvers.compiled import kernel
from solvers.coupling.inputs import Coupling, CouplingInputs, Operation
from solvers.coupling.kinematics import MeshMotion, rotor_samples
from solvers.coupling.lubrication import static_friction
from solvers.coupling.results import AxialThrust, Geometry, Losses, SelfInducedThrust
from solvers.coupling.sleeve import sleeve_equilibrium
from solvers.coupling.tooth_loads import coaxial_limit, mesh_loads


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


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """One mesh over a pitch: its motion, and what loads and friction of its teeth add up to."""

    motion: MeshMotion
    sums: ToothSums


def loaded_mesh(inputs: CouplingInputs, mesh: MeshMotion) -> LoadedMesh:
    """Tooth loads of the single mesh over one tooth pitch, or one revolution with pitch deviations."""
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


def mesh_thrust(loaded: LoadedMesh, friction: float, axial_velocity: float) -> tuple[float, float]:
    """F_ax = sum mu F_n sgn(v_r), the paper's general expression, and its slack [N], both averaged over rotor angles.

    A tooth without relative velocity may carry any friction between -mu F_n and mu F_n: it counts as zero, and as
    mu F_n towards the slack. Without axial velocity the force is zero: half a turn later every tooth meets the same
    load under the opposite sliding. Eq. C19.
    """
    scale, sums = friction / cos(loaded.motion.pressure_angle), loaded.sums
    force = without_rounding(sums.axial, sums.load) if axial_velocity != 0.0 else 0.0
    return scale * force, scale * sums.still


def uniform_load_thrust(limit: float, axial_velocity: float, max_sliding_velocity: float) -> float:
    """F_max (2/pi) asin(v_ax/v_Gmax) [N], F_max once v_ax exceeds v_Gmax: equal tooth loads, many teeth (Eq. C21).

    An upper bound for a centred sleeve without pitch deviations, if the whole load is where sliding is fastest.
    """
    if axial_velocity == 0.0:
        return 0.0
    if abs(axial_velocity) >= max_sliding_velocity:
        return copysign(limit, axial_velocity)
    return limit * 2.0 / pi * asin(axial_velocity / max_sliding_velocity)


def customary_thrust(operation: Operation) -> float | None:
    """0.25 T/D [N] with the shaft diameter D, None without one (API 617 and 671 practice, secondary source)."""
    return None if operation.shaft_diameter is None else 0.25 * operation.torque / operation.shaft_diameter


def simple_self_induced_thrust(coupling: Coupling, torque: float, friction: float, factor: float) -> float:
    """Thrust of the parallel offset with one tooth pair a mesh, 2 kappa mu^2 T/(l_H cos alpha) [N] (Fig. 13; Eq. C23).

    Each tooth carries T/(d_o cos alpha); friction overturns the sleeve by M_2 = 2 F_R d_o, held by F_1 = M_2/l_H. The
    paper does not say which share kappa of F_1 becomes a difference of normal forces.
    """
    return 2.0 * factor * friction**2 * torque / (coupling.hub_distance * cos(coupling.pressure_angle))


def uniform_self_induced_thrust(coupling: Coupling, torque: float, friction: float) -> float:
    """Thrust of the parallel offset with every tooth loaded, (16/pi^2) mu^2 T tan(alpha)/l_H [N] (Eq. C24).

    M_2 = (4/pi) mu T/cos alpha, and a sleeve on isotropic tooth springs turns it into kappa = (4/pi) sin alpha.
    """
    return 16.0 / pi**2 * friction**2 * torque * tan(coupling.pressure_angle) / coupling.hub_distance


def axial_thrust(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> AxialThrust:
    """Thrust of one mesh, or of two on one sleeve, with its limits and closed forms."""
    coupling, operation = inputs.coupling, inputs.operation
    limit = coaxial_limit(coupling, operation.torque, friction)
    force, slack = mesh_thrust(loaded, friction, operation.axial_velocity)
    induced = None
    if operation.arrangement != "single":
        induced = self_induced_thrust(inputs, geometry, friction)
        force = induced.force
        if operation.axial_velocity != 0.0:
            force = sleeve_equilibrium(inputs, geometry, friction, operation.axial_velocity).thrust
    breakaway = coaxial_limit(coupling, operation.torque, static_friction(inputs.friction))
    return AxialThrust(
        force=force,
        coaxial_limit=limit,
        breakaway_force=breakaway,
        design_force=max(abs(force), breakaway),
        customary_force=customary_thrust(operation),
        fraction_of_limit=force / limit if limit > 0.0 else None,
        uniform_load_force=uniform_load_thrust(limit, operation.axial_velocity, abs(loaded.motion.sliding)),
        lower_bound=force - slack,
        upper_bound=force + slack,
        indeterminate=slack > 0.0,
        self_induced=induced,
    )


def self_induced_thrust(inputs: CouplingInputs, geometry: Geometry, friction: float) -> SelfInducedThrust:
    """Thrust of two meshes without axial velocity, beside the closed forms.

    Those are zero in the angular arrangement: one tooth pair a mesh or equal loads make opposite moments of friction in
    both meshes, and the sleeve asks the teeth for nothing (the paper's "for reasons of symmetry").
    """
    coupling, torque = inputs.coupling, inputs.operation.torque
    equilibrium = sleeve_equilibrium(inputs, geometry, friction, 0.0)
    offset = inputs.operation.arrangement == "parallel_offset"
    simple = simple_self_induced_thrust(coupling, torque, friction, inputs.model.simple_thrust_factor)
    uniform = uniform_self_induced_thrust(coupling, torque, friction)
    return SelfInducedThrust(
        force=equilibrium.thrust,
        overturning_moment=equilibrium.overturning_moment,
        simple_model_force=simple if offset else 0.0,
        uniform_load_force=uniform if offset else 0.0,
    )


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
