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
    """The coordinates `overlap` and `load_capacity_coefficient` of the friction map, and intermediate results.

    `overlap` is inf if the contact does not travel. `load_capacity_coefficient` is inf if there is a film but no tooth
    force.
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
    """Compute the largest normal tooth force [N] at the rotor angle at which one tooth is in the tilt position.

    The tilt position is the tooth angle of 90 degrees.

    If the pitch deviations of the teeth differ, the result is the largest force at any rotor angle.
    """
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
    """Compute the Hertzian contact between a plane and a cylinder of radius R_e (Eq. C12).

    The length of the cylinder is the tooth height. Returns `half_width`: half contact width a_HZ [m]; `pressure`:
    largest Hertzian pressure [Pa].
    """
    steel = Solid(youngs_modulus=coupling.youngs_modulus, poisson_ratio=coupling.poisson_ratio)
    modulus = reduced_modulus(steel, steel)
    line_load, radius = normal_force / coupling.tooth_height, geometry.normal_flank_radius
    return float(half_width(line_load, radius, modulus)), float(maximum_pressure(line_load, radius, modulus))


def inlet_length(model: ModelOptions, face_width: float, max_travel: float) -> float:
    """Return the length b_I [m] of the converging gap ahead of the contact.

    The paper does not define b_I. If `model.inlet_length` is not None, b_I has this value; otherwise `model.inlet`
    chooses one of several definitions. With the inlet model `face`, b_I is the distance from the contact to the end of
    the face, when the contact is farthest from the middle of the face. According to the paper, the film is thickest
    when the contact is near this position. If the contact leaves the tooth, b_I is zero with every inlet model.
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
    """Compute the dimensionless load of a parabolic gap with a starved inlet [-] (Eqs. C15, C16).

    The gap is h_0 + x^2/(2 R). Here h_0 is the smallest gap, x is the distance from the smallest gap in the direction
    of flow, and R is the flank radius R_e. The other symbols in the unit of the load are those of
    `hydrodynamic_capacity`. The Reynolds equation for rigid surfaces and constant viscosity is solved in closed form.
    At the exit x = tan(g) sqrt(2 R h_0), the pressure and its gradient are zero. This condition is [A2(g) + A2(g_B)]
    cos^2 g = A4(g) + A4(g_B), where tan g_B = B. A2(g) and A4(g) are the integrals of cos^2 and cos^4 from zero to g.
    Bisection finds g in (0, g_B). The load is W = (1 - H_m/H_B)^2/(4 H_m), where H_m and H_B are the gaps at exit and
    inlet, divided by the smallest gap h_0. `inlet_ratio`: inlet ratio B; the pressure starts at x = -B sqrt(2 R h_0)
    [-].
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
    """Compute the load capacity with a starved inlet, divided by the load capacity with an infinitely long inlet.

    Fig. 8; Eq. C16.
    """
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
    """Return the hydrodynamic velocity [m/s] that builds the film.

    This is the velocity at the given tooth angle [rad], or the largest velocity of a revolution if the angle is None.
    """
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
    """Find the area of the friction map (Fig. 9).

    If the load capacity coefficient is on a boundary, the area is in the row with the higher number. If the overlap is
    on a boundary, the area is in the middle column.
    """
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
    """Return the smallest |ln(coordinate/boundary)| over all boundaries on both axes of the friction map.

    Return None if each coordinate is zero or inf.
    """
    ratios = [overlap / boundary for boundary in OVERLAP_BOUNDARIES]
    ratios += [load_capacity_coefficient / boundary for boundary in CAPACITY_BOUNDARIES]
    return min((abs(log(ratio)) for ratio in ratios if 0.0 < ratio < inf), default=None)


def mixed_friction(law: MixedFrictionCurve | MixedFrictionTable, sliding_velocity: float) -> float:
    """Compute the coefficient of friction in area 1.1 (mixed lubrication) of the friction map [-] (Eq. C17).

    The paper shows the curve in Fig. 10, but does not print points of the curve.
    """
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
    """Compute the coefficient of friction at an overlap below 1.

    `mixed` is the coefficient of mixed friction at the present velocity, and `lowest` is the smallest coefficient at
    any velocity. The result is `mixed` at the load capacity coefficient 0, and `lowest` at 0.2. From 0.8 on, the result
    is the friction of a full film.
    """
    full_film = min(0.01, lowest)
    if load_capacity_coefficient > 0.8:
        return min(full_film, max(0.003, 0.008 / load_capacity_coefficient))
    return _interpolate_logarithm(load_capacity_coefficient, ((0.0, mixed), (0.2, lowest), (0.8, full_film)))


def _poorly_supplied(overlap: float, load_capacity_coefficient: float) -> float:
    """Compute the coefficient of friction at an overlap of 2 or more.

    Without a film the coefficient rises with the overlap to 0.16, the largest value that Calistrat measured (1981).
    """
    dry = 0.1 + 0.06 * min(1.0, (overlap - 2.0) / 2.0)
    points = ((0.0, dry), (0.2, 0.1), (0.8, 0.1), (1.6, 0.05))
    return _interpolate_logarithm(load_capacity_coefficient, points)


def regime_friction(overlap: float, load_capacity_coefficient: float, mixed: float, lowest: float) -> float:
    """Compute the coefficient of friction, which is continuous over the whole friction map [-] (Eq. C18).

    The paper states only a band of friction for each area. The law used here interpolates between the end values of
    these bands. The law lies inside the bands of areas 1.1, 1.3, 2.1, 2.2, 2.3 and 3.1. In area 1.2 the law is a smooth
    transition from area 1.1 to area 1.3. Near overlap 1 the law may leave the band of area 3.2; according to the paper
    itself, the boundaries of the areas are not sharp ("fluid"). The coefficient of friction never rises when the load
    capacity coefficient rises.
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
    """Return the user's coefficient of friction, or else the coefficient of the friction map.

    `sliding_velocity` [m/s] is the largest sliding velocity.
    """
    if friction.coefficient is not None:
        return friction.coefficient
    law = friction.law
    mixed = mixed_friction(law, sliding_velocity)
    return regime_friction(overlap, load_capacity_coefficient, mixed, lowest_mixed_friction(law))


def static_friction(friction: Friction) -> float:
    """Return the coefficient of friction at rest.

    The function returns the first available value of this list:

    - the user's static coefficient
    - the user's coefficient of friction
    - the coefficient of the friction map for teeth without a film at zero sliding velocity
    """
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
