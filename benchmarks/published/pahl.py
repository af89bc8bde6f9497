"""The coupling in the figures of Pahl 1978, and functions that compute the numbers in these figures.

The coupling has 52 teeth of module 3 mm.
"""

from dataclasses import replace
from functools import cache
from math import log, pi, radians
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from solvers.coupling.crowning import recommend
from solvers.coupling.inputs import (
    Arrangement,
    Coupling,
    CouplingInputs,
    Friction,
    ModelOptions,
    Operation,
    RecommendationInputs,
)
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.results import CouplingResult, OrbitResult

TEETH, PITCH_RADIUS = 52, 0.078  # -, m
HEAVY, SLIGHT = 1.0, 11.0  # crowning ratios
CREEP = 2e-3  # axial velocity [m/s]


def pahl_coupling(
    misalignment_deg: float,
    *,
    torque: float = 3000.0,
    speed: float = 200.0,
    axial_velocity: float = 0.0,
    arrangement: Arrangement = "single",
    friction: float | None = 0.2,
    model: ModelOptions | None = None,
    **coupling: Any,
) -> CouplingInputs:
    """Return the inputs for the coupling of the paper. Further keywords replace fields of `Coupling`."""
    steel = Coupling(teeth=TEETH, module=3e-3, face_width=24e-3, tooth_height=6e-3)
    return CouplingInputs(
        coupling=replace(steel, **coupling),
        operation=Operation(torque, speed, axial_velocity, arrangement, misalignment=radians(misalignment_deg)),
        friction=Friction(coefficient=friction),
        model=model or ModelOptions(),
    )


@cache
def pahl(misalignment_deg: float, **changes: Any) -> CouplingResult:
    """Solve the coupling of the paper. `changes` holds further arguments of `pahl_coupling`. The result is cached."""
    return solve(pahl_coupling(misalignment_deg, **changes))


def harmonic_pitch_errors(*orders: tuple[int, float, float]) -> tuple[float, ...]:
    """Return the pitch deviations [m] of all teeth.

    An item of `orders` is (order, amplitude [m], phase [rad]). The pitch deviation of the tooth at the angle phi is the
    sum of amplitude cos(order phi + phase) over all items.
    """
    phi = 2.0 * pi / TEETH * np.arange(TEETH)
    return tuple(sum(amplitude * np.cos(order * phi + phase) for order, amplitude, phase in orders))


def concentration(misalignment_deg: float) -> float:
    """Return the ratio of the largest tooth force to the mean tooth force (Fig. 3)."""
    return pahl(misalignment_deg).load_distribution.load_concentration or 0.0


def loaded(misalignment_deg: float) -> float:
    """Return the number of teeth that carry load (Fig. 3 of Pahl 1978)."""
    return float(pahl(misalignment_deg).load_distribution.loaded_teeth)


@cache
def _orbit(misalignment_deg: float) -> OrbitResult:
    """Solve the orbit of the sleeve at a speed of 1000 rad/s (Fig. 5).

    The pitch deviations have a first and a third harmonic, both with an amplitude of 2 um.
    """
    errors = harmonic_pitch_errors((1, 2e-6, 0.0), (3, 2e-6, 0.7))
    return solve_orbit(pahl_coupling(misalignment_deg, speed=1000.0, pitch_errors=errors))


def third_over_first(misalignment_deg: float) -> float:
    """Return the ratio of the inertia force's third harmonic to its first harmonic (Fig. 5)."""
    harmonics = _orbit(misalignment_deg).inertia_force.harmonics_y
    return float(harmonics[3] / harmonics[1])


def overlap_one(crowning: float) -> float:
    """Return the misalignment [deg] at which the contact overlap of a tooth is 1."""

    def excess(misalignment_deg: float) -> float:
        return (pahl(misalignment_deg, friction=None, crowning_ratio=crowning).lubrication.contact_overlap or 0.0) - 1.0

    return float(brentq(excess, 0.01, 1.0))


def film(misalignment_deg: float, crowning: float) -> CouplingResult:
    """Solve the coupling with the coefficient of friction that follows from the film (Fig. 8)."""
    return pahl(misalignment_deg, friction=None, crowning_ratio=crowning)


def least_friction(crowning: float, low: float, high: float) -> tuple[float, float]:
    """Return the misalignment [deg] with the lowest coefficient of friction, and this coefficient.

    The search is limited to misalignments from `low` to `high` [deg].
    """
    minimum = minimize_scalar(
        lambda misalignment: film(misalignment, crowning).lubrication.friction_coefficient,
        bounds=(low, high),
        method="bounded",
    )
    return float(minimum.x), float(minimum.fun)


def fraction(speed: float) -> float:
    """Return the axial thrust at a misalignment of 0.05 deg, divided by the thrust of coaxial shafts (Figs. 15, 16).

    `speed` is the angular speed [1/s].
    """
    return pahl(0.05, speed=speed, axial_velocity=CREEP).axial_thrust.fraction_of_limit or 0.0


def offset_thrust(friction: float = 0.2, hub_distance: float = 0.2) -> float:
    """Return the self-induced thrust [N] in the parallel offset arrangement at 0.1 deg of misalignment (Fig. 13)."""
    return pahl(0.1, arrangement="parallel_offset", friction=friction, hub_distance=hub_distance).axial_thrust.force


def friction_exponent() -> float:
    """Return the exponent n with which the self-induced thrust depends on the coefficient of friction (Fig. 17).

    The self-induced thrust grows as the coefficient of friction to the power n.
    """
    return log(offset_thrust(0.3) / offset_thrust(0.05)) / log(6.0)


@cache
def crowning(low_deg: float, high_deg: float) -> float:
    """Return the crowning ratio that the model recommends for misalignments between two limits [deg]."""
    recommendation = recommend(
        RecommendationInputs(pahl_coupling(0.1, friction=None), radians(low_deg), radians(high_deg))
    )
    return recommendation.crowning_ratio or 0.0
