"""Model of the gear coupling after Pahl, "The operating characteristics of gear-type couplings"."""

from math import isfinite

from solvers.coupling.friction import axial_thrust, loaded_mesh, losses
from solvers.coupling.inputs import CouplingInputs, check_inputs
from solvers.coupling.kinematics import kinematics, mesh_motion, tooth_geometry
from solvers.coupling.lubrication import FilmState, check_contact, film_state, friction_coefficient, friction_regime
from solvers.coupling.notices import contact_notices, load_notices, motion_notices
from solvers.coupling.results import CouplingResult, Derived, Lubrication
from solvers.coupling.tooth_loads import limits, load_distribution


def solve(inputs: CouplingInputs) -> CouplingResult:
    """Compute kinematics, tooth loads, lubrication, friction, axial thrust and losses at one operating point.

    Parameters
    ----------
    inputs : CouplingInputs
        Coupling, operating point, oil, friction and model, in SI units.

    Returns
    -------
    CouplingResult
        Results in SI units, with warnings.

    Raises
    ------
    InvalidInput
        `out_of_range`, `pitch_errors_length`, `mixed_law`, `mixed_curve`, `hertz_pressure` or `contact_width`.
    NoSolution
        `sleeve_balance` or `sleeve_equilibrium`, with residuals.

    Examples
    --------
    >>> from math import radians
    >>> from solvers import coupling
    >>> design = coupling.Coupling(teeth=52, module=3e-3)
    >>> tilted = coupling.Operation(3000.0, 200.0, misalignment=radians(0.05))
    >>> result = coupling.solve(coupling.CouplingInputs(design, tilted, friction=coupling.Friction(0.2)))
    >>> round(result.axial_thrust.coaxial_limit)
    8186
    """
    check_inputs(inputs)
    geometry = tooth_geometry(inputs.coupling)
    mesh = mesh_motion(inputs.coupling, geometry, inputs.operation, inputs.model.kinematics)
    motion = kinematics(mesh)
    load = load_distribution(inputs, geometry, mesh)

    film = film_state(inputs, geometry, mesh)
    check_contact(film, geometry)
    friction = friction_coefficient(
        inputs.friction, film.overlap, film.load_capacity_coefficient, motion.max_sliding_velocity
    )
    lubrication = _lubrication(film, friction)

    loaded = loaded_mesh(inputs, mesh)
    thrust = axial_thrust(inputs, geometry, loaded, friction)
    bounds = limits(inputs, geometry)
    return CouplingResult(
        geometry=geometry,
        kinematics=motion,
        load_distribution=load,
        lubrication=lubrication,
        axial_thrust=thrust,
        losses=losses(inputs, geometry, loaded, friction),
        limits=bounds,
        derived=Derived.of(inputs),
        warnings=(
            *motion_notices(inputs, geometry, motion, thrust, bounds),
            *load_notices(inputs, load, thrust, bounds),
            *contact_notices(inputs, motion, lubrication),
        ),
    )


def _lubrication(film: FilmState, friction: float) -> Lubrication:
    """Results of lubrication; None for infinite overlap and inlet ratio, and for the load capacity without load."""
    tr = film.load_capacity_coefficient
    return Lubrication(
        max_normal_force=film.max_normal_force,
        hertz_half_width=film.contact_half_width,
        hertz_pressure=film.contact_pressure,
        contact_overlap=film.overlap if isfinite(film.overlap) else None,
        inlet_ratio=film.inlet_ratio if isfinite(film.inlet_ratio) else None,
        inlet_factor=film.inlet_factor,
        hydrodynamic_capacity=film.capacity,
        load_capacity_coefficient=tr if film.max_normal_force > 0.0 else None,
        regime=friction_regime(film.overlap, tr),
        friction_coefficient=friction,
    )
