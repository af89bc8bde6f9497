"""Effects of friction on the teeth of one mesh: axial thrust, losses and the moments that bend the hub.

All values are means over one tooth pitch or, if there are pitch deviations, over one revolution. The thrust of one mesh
follows Figs 14 to 16; the closed forms for two meshes follow Figs 13 and 17.
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
    """Sums over the teeth, averaged over the rotor angles.

    F_t is the tangential force, v_r is the relative velocity, and phi is the tooth angle. `load` is sum F_t, and
    `still` is sum F_t over the teeth without relative velocity [N]. `axial` is sum F_t sgn(v_r), `tilting` is
    sum F_t sgn(v_r) sin(phi), and `pivoting` is sum F_t sgn(v_r) cos(phi) [N]. `tilted` is sum F_t sin^2(phi), `mixed`
    is sum F_t sin(phi) cos(phi), and `pivoted` is sum F_t cos^2(phi) [N]. `power` is sum F_t |v_r| [W].
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
    """Compute the sums over the teeth from the tooth forces, averaged over the rotor angles.

    Each row of `force`, `sine` and `cosine` (rows, teeth) belongs to one rotor angle. `weight` (rows,) holds the
    weights of the rotor angles. `sine` and `cosine` are sin(phi) and cos(phi) of the tooth angle phi. The relative
    velocity is v_r = v_ax + v_G sin(phi), where v_ax is `axial_velocity` and v_G is `sliding` [m/s].
    """
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
    """Motion of one mesh, and the sums over the loaded teeth of this mesh."""

    motion: MeshMotion
    sums: ToothSums


def loaded_mesh(inputs: CouplingInputs, mesh: MeshMotion) -> LoadedMesh:
    """Tooth sums of a mesh, means over a tooth pitch or, with pitch deviations, over a revolution."""
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
    """Axial thrust F_ax = sum mu F_n sgn(v_r) of one mesh and its slack [N], means over the rotor angles (Eq. C19).

    A tooth without relative velocity may carry any friction from -mu F_n to mu F_n: zero in the thrust, mu F_n in the
    slack. Without axial velocity the thrust is zero, because half a turn later every tooth has the same load and slides
    the other way.
    """
    scale, sums = friction / cos(loaded.motion.pressure_angle), loaded.sums
    force = without_rounding(sums.axial, sums.load) if axial_velocity != 0.0 else 0.0
    return scale * force, scale * sums.still


def uniform_load_thrust(limit: float, axial_velocity: float, max_sliding_velocity: float) -> float:
    """Axial thrust F_max (2/pi) asin(v_ax/v_Gmax) of many equally loaded teeth [N], at most F_max (Eq. C21).

    An upper bound for a centred sleeve without pitch deviations: load concentrates on the teeth that slide fastest.
    """
    if axial_velocity == 0.0:
        return 0.0
    if abs(axial_velocity) >= max_sliding_velocity:
        return copysign(limit, axial_velocity)
    return limit * 2.0 / pi * asin(axial_velocity / max_sliding_velocity)


def customary_thrust(operation: Operation) -> float | None:
    """Customary thrust 0.25 T/D [N] of API 617 and 671 (second-hand); None without a shaft diameter D."""
    return None if operation.shaft_diameter is None else 0.25 * operation.torque / operation.shaft_diameter


def simple_self_induced_thrust(coupling: Coupling, torque: float, friction: float, factor: float) -> float:
    """Self-induced thrust with a parallel offset and one pair of opposite teeth per mesh [N] (Fig. 13; Eq. C23).

    The friction moment M_2 = 2 F_R d_o of two teeth with T/(d_o cos alpha) each needs a lateral force M_2/l_H at each
    mesh, which makes the normal forces of the two teeth differ by kappa times it. The paper does not state kappa.
    """
    return 2.0 * factor * friction**2 * torque / (coupling.hub_distance * cos(coupling.pressure_angle))


def uniform_self_induced_thrust(coupling: Coupling, torque: float, friction: float) -> float:
    """Compute the self-induced thrust with a parallel offset and equal loads on all teeth [N] (Eq. C24).

    The overturning moment is M_2 = (4/pi) mu T/cos alpha. If the tooth springs are equally stiff in all lateral
    directions, the ratio kappa of `simple_self_induced_thrust` is (4/pi) sin alpha.
    """
    return 16.0 / pi**2 * friction**2 * torque * tan(coupling.pressure_angle) / coupling.hub_distance


def axial_thrust(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> AxialThrust:
    """Axial thrust of one mesh, or of two on one sleeve, with its bounds and the thrusts for comparison."""
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
    """Thrust of two meshes without axial velocity, with its closed forms for one pair of teeth and for equal loads.

    With an angle (M) both closed forms are zero: the moments of friction of the meshes are opposite, so that the sleeve
    needs no lateral force. The paper says "for reasons of symmetry".
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
    """Friction power of a mesh and moments on the driving hub (Eqs. C25, C28).

    M_f = r_o sum mu F_n sgn(v_r) sgn(v_G1) sin phi acts about the pivot direction against the tilting; P = M_f omega
    delta + F_ax v_ax. M_f is zero without a tilt, and undetermined if nothing slides. By the power balance M_f - T
    delta/2 bends the driving hub, whatever the load distribution.
    """
    operation, sums = inputs.operation, loaded.sums
    scale = friction / cos(inputs.coupling.pressure_angle)
    lever = scale * geometry.pitch_radius * float(np.sign(loaded.motion.sliding))
    friction_moment = lever * without_rounding(sums.tilting, sums.load)
    shift_moment = contact_shift_moment(inputs, geometry, loaded)
    tilting_moment = shift_moment
    if inputs.model.kinematics == "spatial":
        # The moment of friction about the tilt axis, -r_o sum mu F_n cos(phi) sgn, acts only on the pivoting motion.
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
    """Moment (2/pi) mu T/cos(alpha) with which friction resists a tilt if all tooth loads are equal [N m] (Eq. C26)."""
    return 2.0 / pi * pitch_radius * coaxial_limit


def contact_shift_moment(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh) -> float:
    """Moment M_s of the tooth forces about the tilt axis, which do not act at the middle of the face [N m] (Eq. C27).

    It equals sum F_t df_t/d delta. `tangential`: z_c is the contact position s_1 on the hub flank, n_x the tangential
    part of n. `spatial`: z_c = s_1 - delta r_o cos phi, and n_x has the radial part too. The power balance of the hub
    already contains the moment T delta/2 of the y components.
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
