"""Lubrication of the most heavily loaded tooth (Figs 7 and 8), and the resulting friction (Figs 9, 10 and 11)."""

from dataclasses import dataclass
from functools import lru_cache
from math import atan, cos, exp, inf, log, pi, sin, sqrt, tan

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.contact.hertz import half_width, maximum_pressure, reduced_modulus
from solvers.coupling.inputs import (
    Coupling,
    CouplingInputs,
    Friction,
    MixedFrictionCurve,
    MixedFrictionTable,
    ModelOptions,
)
from solvers.coupling.kinematics import (
    MeshMotion,
    ToothPositions,
    displacement_peak,
    hydrodynamic_velocity,
    max_contact_travel,
    max_hydrodynamic_velocity,
    revolution,
    tooth_positions,
)
from solvers.coupling.results import Geometry, Regime
from solvers.coupling.tooth_loads import largest_value, mesh_loads
from solvers.errors import InvalidInput
from solvers.materials import Solid

MAX_CONTACT_PRESSURE = 2e9  # Pa, chosen: the model is elastic, but hardened steel yields near this pressure
MAX_CONTACT_WIDTH = 0.1
"""Largest ratio of half contact width to flank radius at which a cylinder still deforms like a half-space."""
UNBOUNDED_LOAD = 0.20395702057972376
"""Dimensionless load W of a gap with an infinitely long inlet; 12 W is Pahl's constant 2.447.

In the notation of `starved_load`, the exit of this gap is at tan g = 0.47513.
"""
OVERLAP_BOUNDARIES = (1.0, 2.0)  # Pahl, regimes of Figs 9 to 11
CAPACITY_BOUNDARIES = (0.2, 0.8)  # Pahl, regimes of Figs 9 to 11
UNSTABLE_AREA = "3.3"

# Name of each area of Fig. 9, and both ends of the paper's band of friction; an end is None if the paper does not state
# this end.
_AREAS: dict[str, tuple[str, float | None, float | None]] = {
    "1.1": ("mixed lubrication", 0.05, 0.1),
    "1.2": ("transition from mixed to boundary lubrication", 0.1, 0.1),
    "1.3": ("boundary lubrication", 0.1, None),
    "2.1": ("mixed lubrication", 0.01, 0.05),
    "2.2": ("mixed lubrication", 0.01, 0.1),
    "2.3": ("boundary or mixed lubrication", 0.1, 0.1),
    "3.1": ("predominantly full film", None, 0.01),
    "3.2": ("mixed lubrication", 0.01, 0.1),
    "3.3": ("mixed lubrication, unstable", None, None),
}


@dataclass(frozen=True, slots=True)
class FilmState:
    """Coordinates of the friction map and intermediate results.

    `overlap` is inf without travel, `load_capacity_coefficient` if there is a film but no tooth force.
    """

    max_normal_force: float
    contact_half_width: float
    contact_pressure: float
    overlap: float
    inlet_ratio: float
    inlet_factor: float
    capacity: float
    load_capacity_coefficient: float


def max_normal_force(inputs: CouplingInputs, mesh: MeshMotion) -> float:
    """Largest normal tooth force with a tooth at 90 degrees (tilt position); with pitch deviations anywhere [N]."""
    if len(set(inputs.coupling.pitch_errors or ())) <= 1:
        return float(_largest_forces(inputs, mesh, _positions_at(pi / 2, inputs.coupling.teeth)).max())

    def largest_forces(angles: FloatArray) -> FloatArray:
        return _largest_forces(inputs, mesh, tooth_positions(angles, inputs.coupling.teeth))

    return largest_value(displacement_peak(mesh) + revolution(inputs.coupling.teeth), largest_forces)


@lru_cache(maxsize=4)
def _positions_at(angle: float, teeth: int) -> ToothPositions:
    positions = tooth_positions(np.array([angle]), teeth)
    return ToothPositions(frozen(positions.sine), frozen(positions.cosine))


def _largest_forces(inputs: CouplingInputs, mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Compute the largest normal tooth force [N] at each rotor angle."""
    coupling = inputs.coupling
    loads = mesh_loads(coupling, mesh, teeth, inputs.operation.torque, floating=inputs.model.sleeve == "floating")
    largest: FloatArray = loads.tangential_force.max(axis=1) / cos(coupling.pressure_angle)
    return largest


def hertz_contact(coupling: Coupling, geometry: Geometry, normal_force: float) -> tuple[float, float]:
    """Half width a_HZ [m] and pressure [Pa] of a plane and a cylinder of radius R_e (Eq. C12).

    The cylinder is as long as the tooth height.
    """
    steel = Solid(youngs_modulus=coupling.youngs_modulus, poisson_ratio=coupling.poisson_ratio)
    modulus = reduced_modulus(steel, steel)
    line_load, radius = normal_force / coupling.tooth_height, geometry.normal_flank_radius
    return float(half_width(line_load, radius, modulus)), float(maximum_pressure(line_load, radius, modulus))


def inlet_length(model: ModelOptions, face_width: float, max_travel: float) -> float:
    """Length b_I [m] of the converging gap ahead of the contact, which the paper does not define.

    `face` takes the distance from the contact, farthest from the middle, to the end of the face: there the film is
    thickest by the paper. Zero if the contact leaves the tooth.
    """
    if max_travel >= face_width / 2.0:
        return 0.0
    if model.inlet_length is not None:
        return model.inlet_length
    if model.inlet == "face":
        return face_width / 2.0 - max_travel
    return max_travel if model.inlet == "travel" else inf


@kernel
def starved_load(inlet_ratio: float) -> float:
    """Load W = (1 - H_m/H_B)^2/(4 H_m) of a parabolic gap, pressure from x = -B sqrt(2 R h_0) on [-] (Eqs. C15, C16).

    Reynolds' equation for rigid surfaces and constant viscosity, with zero pressure and gradient at the exit x = tan(g)
    sqrt(2 R h_0): [A2(g) + A2(g_B)] cos^2 g = A4(g) + A4(g_B), tan g_B = B; A2 and A4 are integrals of cos^2 and cos^4,
    H_m and H_B the gaps at exit and inlet over h_0. Bisection finds g in (0, g_B).
    """
    inlet = atan(inlet_ratio)
    a2 = inlet / 2.0 + sin(2.0 * inlet) / 4.0
    a4 = 3.0 * inlet / 8.0 + sin(2.0 * inlet) / 4.0 + sin(4.0 * inlet) / 32.0
    low, high = 0.0, inlet
    while high - low > 4e-16 * inlet:
        g = 0.5 * (low + high)
        if g in (low, high):
            break
        left = (g / 2.0 + sin(2.0 * g) / 4.0 + a2) * cos(g) ** 2
        right = 3.0 * g / 8.0 + sin(2.0 * g) / 4.0 + sin(4.0 * g) / 32.0 + a4
        if left > right:
            low = g
        else:
            high = g
    film_at_exit = 1.0 + tan(low) ** 2
    return (1.0 - film_at_exit / (1.0 + inlet_ratio**2)) ** 2 / (4.0 * film_at_exit)


def inlet_factor(inlet_ratio: float) -> float:
    """Load capacity with a starved inlet over that with an infinitely long one (Fig. 8; Eq. C16)."""
    if inlet_ratio < 0.02:
        # Series, because the closed form loses its digits by cancellation at such a small ratio.
        return 0.68948 * inlet_ratio**4
    return 1.0 if inlet_ratio == inf else min(1.0, starved_load(inlet_ratio) / UNBOUNDED_LOAD)


def hydrodynamic_capacity(
    tooth_height: float, viscosity: float, velocity: float, radius: float, film: float, factor: float
) -> float:
    """Compute the hydrodynamic load capacity of a tooth [N] (Eq. C14).

    Fig. 8 prints the "h" of h_trag above the fraction bar and the index "trag" below the bar, which is a misprint.
    """
    return 12.0 * UNBOUNDED_LOAD * tooth_height * viscosity * velocity * radius / film * factor


def film_velocity(mesh: MeshMotion, angle: float | None) -> float:
    """Hydrodynamic velocity that builds the film, at the given tooth angle or the largest of a revolution [m/s]."""
    if angle is None:
        return max_hydrodynamic_velocity(mesh)
    position = ToothPositions(sine=np.array(sin(angle)), cosine=np.array(cos(angle)))
    return float(hydrodynamic_velocity(mesh, position))


def film_state(inputs: CouplingInputs, geometry: Geometry, mesh: MeshMotion) -> FilmState:
    """Compute the contact overlap and the load capacity coefficient of one mesh (Eq. C13)."""
    coupling, lubricant = inputs.coupling, inputs.lubricant
    travel, radius = max_contact_travel(mesh), geometry.normal_flank_radius
    force = max_normal_force(inputs, mesh)
    contact_half_width, contact_pressure = hertz_contact(coupling, geometry, force)
    inlet_ratio = inlet_length(inputs.model, coupling.face_width, travel) / sqrt(
        2.0 * radius * lubricant.reference_film
    )
    factor = inlet_factor(inlet_ratio)
    velocity = film_velocity(mesh, inputs.model.film_angle)
    capacity = hydrodynamic_capacity(
        coupling.tooth_height, lubricant.viscosity, velocity, radius, lubricant.reference_film, factor
    )
    return FilmState(
        max_normal_force=force,
        contact_half_width=contact_half_width,
        contact_pressure=contact_pressure,
        overlap=contact_half_width / travel if travel > 0.0 else inf,
        inlet_ratio=inlet_ratio,
        inlet_factor=factor,
        capacity=capacity,
        load_capacity_coefficient=_capacity_ratio(capacity, force),
    )


def _capacity_ratio(capacity: float, force: float) -> float:
    """Return the load capacity coefficient, which is zero without a film, and inf if there is a film but no force."""
    if capacity == 0.0:
        return 0.0
    return capacity / force if force > 0.0 else inf


def friction_regime(overlap: float, load_capacity_coefficient: float) -> Regime:
    """Area of the friction map (Fig. 9); on a boundary the row with the higher number and the middle column."""
    row = 1 + sum(load_capacity_coefficient >= boundary for boundary in CAPACITY_BOUNDARIES)
    column = 1 + (overlap >= OVERLAP_BOUNDARIES[0]) + (overlap > OVERLAP_BOUNDARIES[1])
    area = f"{row}.{column}"
    name, friction_min, friction_max = _AREAS[area]
    return Regime(
        area=area,
        name=name,
        friction_min=friction_min,
        friction_max=friction_max,
        distance_to_boundary=_distance_to_boundary(overlap, load_capacity_coefficient),
    )


def _distance_to_boundary(overlap: float, load_capacity_coefficient: float) -> float | None:
    """Smallest |ln(coordinate/boundary)| on both axes of the friction map; None if each coordinate is zero or inf."""
    ratios = [overlap / boundary for boundary in OVERLAP_BOUNDARIES]
    ratios += [load_capacity_coefficient / boundary for boundary in CAPACITY_BOUNDARIES]
    return min((abs(log(ratio)) for ratio in ratios if 0.0 < ratio < inf), default=None)


def mixed_friction(law: MixedFrictionCurve | MixedFrictionTable, sliding_velocity: float) -> float:
    """Coefficient of friction in area 1.1 (Fig. 10, without printed points) [-] (Eq. C17)."""
    if isinstance(law, MixedFrictionTable):
        return float(np.interp(sliding_velocity, law.sliding_velocity, law.coefficient))
    ratio = sliding_velocity / law.velocity
    if ratio <= 1.0:
        return law.lowest + (law.highest - law.lowest) * (1.0 - ratio) ** 2
    return min(law.highest, law.lowest + 0.02 * log(ratio) ** 2)


def lowest_mixed_friction(law: MixedFrictionCurve | MixedFrictionTable) -> float:
    """Return the smallest coefficient of mixed friction at any sliding velocity."""
    return min(law.coefficient) if isinstance(law, MixedFrictionTable) else law.lowest


def _interpolate_logarithm(x: float, points: tuple[tuple[float, float], ...]) -> float:
    """Interpolate ln(y) linearly in x between the `points` (x, y), and return y; outside the points y is constant."""
    return exp(float(np.interp(x, [p[0] for p in points], [log(p[1]) for p in points])))


def _well_supplied(load_capacity_coefficient: float, mixed: float, lowest: float) -> float:
    """Coefficient of friction at an overlap below 1.

    `mixed` at the load capacity coefficient 0, `lowest` at 0.2, that of a full film from 0.8 on.
    """
    full_film = min(0.01, lowest)
    if load_capacity_coefficient > 0.8:
        return min(full_film, max(0.003, 0.008 / load_capacity_coefficient))
    return _interpolate_logarithm(load_capacity_coefficient, ((0.0, mixed), (0.2, lowest), (0.8, full_film)))


def _poorly_supplied(overlap: float, load_capacity_coefficient: float) -> float:
    """Coefficient of friction at an overlap of 2 or more; without a film up to 0.16, Calistrat's largest (1981)."""
    dry = 0.1 + 0.06 * min(1.0, (overlap - 2.0) / 2.0)
    points = ((0.0, dry), (0.2, 0.1), (0.8, 0.1), (1.6, 0.05))
    return _interpolate_logarithm(load_capacity_coefficient, points)


def regime_friction(overlap: float, load_capacity_coefficient: float, mixed: float, lowest: float) -> float:
    """Coefficient of friction, continuous over the whole friction map [-] (Eq. C18).

    Interpolates between the ends of the paper's bands, inside those of areas 1.1, 1.3, 2.1, 2.2, 2.3 and 3.1. Area 1.2
    is a transition; near overlap 1 it may leave the band of 3.2, whose boundary the paper calls "fluid". Never rises
    with the load capacity coefficient.
    """
    if overlap > 2.0:
        return _poorly_supplied(overlap, load_capacity_coefficient)
    well = _well_supplied(load_capacity_coefficient, mixed, lowest)
    if overlap < 1.0:
        return well
    poor = _poorly_supplied(2.0, load_capacity_coefficient)
    return exp((2.0 - overlap) * log(well) + (overlap - 1.0) * log(poor))


def friction_coefficient(
    friction: Friction, overlap: float, load_capacity_coefficient: float, sliding_velocity: float
) -> float:
    """User's coefficient of friction, or that of the friction map; `sliding_velocity` [m/s] is the largest."""
    if friction.coefficient is not None:
        return friction.coefficient
    law = friction.law
    mixed = mixed_friction(law, sliding_velocity)
    return regime_friction(overlap, load_capacity_coefficient, mixed, lowest_mixed_friction(law))


def static_friction(friction: Friction) -> float:
    """User's coefficient at rest, else the user's coefficient, else that of the friction map at rest without a film."""
    if friction.static_coefficient is not None:
        return friction.static_coefficient
    return friction_coefficient(friction, overlap=inf, load_capacity_coefficient=0.0, sliding_velocity=0.0)


def check_contact(film: FilmState, geometry: Geometry) -> None:
    """Raise InvalidInput if the pressure exceeds 2 GPa (`hertz_pressure`) or a_HZ exceeds 0.1 R_e (`contact_width`)."""
    if film.contact_pressure > MAX_CONTACT_PRESSURE:
        raise InvalidInput(
            "hertz_pressure",
            f"the Hertzian pressure of {film.contact_pressure / 1e9:.3g} GPa exceeds 2 GPa; lower the torque",
            "torque",
        )
    if film.contact_half_width > MAX_CONTACT_WIDTH * geometry.normal_flank_radius:
        raise InvalidInput(
            "contact_width",
            "half the width of the contact exceeds a tenth of the normal flank radius; raise the crowning ratio",
            "crowning_ratio",
        )
