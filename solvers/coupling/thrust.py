"""Axial thrust of one mesh (Figs 14 to 16) and the closed forms of two meshes (Figs 13 and 17)."""

from math import asin, copysign, cos, pi, tan

from solvers.coupling.inputs import Coupling, CouplingInputs, Operation
from solvers.coupling.losses import LoadedMesh, without_rounding
from solvers.coupling.lubrication import static_friction
from solvers.coupling.results import AxialThrust, Geometry, SelfInducedThrust
from solvers.coupling.sleeve import sleeve_equilibrium
from solvers.coupling.teeth.loads import coaxial_limit


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

    An upper bound for a centred sleeve without pitch errors, if the whole load is where sliding is fastest.
    """
    if axial_velocity == 0.0:
        return 0.0
    if abs(axial_velocity) >= max_sliding_velocity:
        return copysign(limit, axial_velocity)
    return limit * 2.0 / pi * asin(axial_velocity / max_sliding_velocity)


def customary_thrust(operation: Operation) -> float | None:
    """0.25 T/D [N] with the shaft diameter D, None without one (API 617 and 671 practice, quoted from memory)."""
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
