"""Gear couplings: Pahl 1978, Bloch's hand method, Calistrat's measurements."""

from dataclasses import replace
from functools import cache
from math import asin, log, pi, radians, tan

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from app.published.statement import Statement, above, below, between, equals
from solvers.coupling import recommend, solve, solve_orbit
from solvers.coupling.inputs import (
    Arrangement,
    Coupling,
    CouplingInputs,
    Friction,
    Operation,
    RecommendationInputs,
)
from solvers.coupling.results import CouplingResult, OrbitResult

PAHL = "Pahl 1978"
INDEPENDENT = "the paper shows a curve; the number is an independent calculation's"
BLOCH = "Bloch, Improving Machinery Reliability, pp. 208-210"
HEAVY, SLIGHT = 1.0, 11.0  # crowning ratios
CREEP = 2e-3  # axial velocity [m/s]


@cache
def pahl(
    misalignment_deg: float,
    *,
    torque: float = 3000.0,
    speed: float = 200.0,
    axial_velocity: float = 0.0,
    arrangement: Arrangement = "single",
    friction: float | None = 0.2,
    crowning: float = HEAVY,
    hub_distance: float = 0.2,
) -> CouplingResult:
    """The coupling of the figures: 52 teeth of module 3 mm."""
    return solve(
        _design(misalignment_deg, torque, speed, axial_velocity, arrangement, friction, crowning, hub_distance)
    )


def _design(
    misalignment_deg: float,
    torque: float = 3000.0,
    speed: float = 200.0,
    axial_velocity: float = 0.0,
    arrangement: Arrangement = "single",
    friction: float | None = 0.2,
    crowning: float = HEAVY,
    hub_distance: float = 0.2,
) -> CouplingInputs:
    steel = Coupling(
        teeth=52, module=3e-3, face_width=24e-3, tooth_height=6e-3, crowning_ratio=crowning, hub_distance=hub_distance
    )
    return CouplingInputs(
        steel,
        Operation(torque, speed, radians(misalignment_deg), axial_velocity, arrangement),
        friction=Friction(friction),
    )


def _concentration(misalignment_deg: float) -> float:
    return pahl(misalignment_deg).load_distribution.load_concentration or 0.0


def _loaded(misalignment_deg: float) -> float:
    return float(pahl(misalignment_deg).load_distribution.loaded_teeth)


@cache
def _orbit(misalignment_deg: float) -> OrbitResult:
    """Fig. 5: 2 um of first and third harmonic in the pitch errors, 1000 1/s."""
    phi = 2.0 * pi / 52 * np.arange(52)
    errors = tuple(2e-6 * np.cos(phi) + 2e-6 * np.cos(3 * phi + 0.7))
    design = _design(misalignment_deg, speed=1000.0)
    return solve_orbit(replace(design, coupling=replace(design.coupling, pitch_errors=errors)))


def _third_over_first(misalignment_deg: float) -> float:
    harmonics = _orbit(misalignment_deg).inertia_force.harmonics_y
    return float(harmonics[3] / harmonics[1])


def _overlap_one(crowning: float) -> float:
    """Misalignment [deg] at which the contact areas of a tooth just overlap."""

    def excess(misalignment_deg: float) -> float:
        return (pahl(misalignment_deg, friction=None, crowning=crowning).lubrication.contact_overlap or 0.0) - 1.0

    return float(brentq(excess, 0.01, 1.0))


def _film(misalignment_deg: float, crowning: float) -> CouplingResult:
    return pahl(misalignment_deg, friction=None, crowning=crowning)


def _least_friction(crowning: float, low: float, high: float) -> tuple[float, float]:
    """Misalignment [deg] and value of the lowest friction."""
    found = minimize_scalar(
        lambda misalignment: _film(misalignment, crowning).lubrication.friction_coefficient,
        bounds=(low, high),
        method="bounded",
    )
    return float(found.x), float(found.fun)


def _fraction(speed: float) -> float:
    return pahl(0.05, speed=speed, axial_velocity=CREEP).axial_thrust.fraction_of_limit or 0.0


def _offset_thrust(friction: float = 0.2, hub_distance: float = 0.2) -> float:
    return pahl(0.1, arrangement="parallel_offset", friction=friction, hub_distance=hub_distance).axial_thrust.force


def _friction_exponent() -> float:
    return log(_offset_thrust(0.3) / _offset_thrust(0.05)) / log(6.0)


@cache
def _crowning(low_deg: float, high_deg: float) -> float:
    design = _design(0.1, friction=None)
    found = recommend(RecommendationInputs(design, radians(low_deg), radians(high_deg)))
    return found.crowning_ratio or 0.0


TORQUE, DIAMETER, FACE = 21806.0, 0.2286, 0.033
END_CONTACT = FACE / 2 * tan(radians(20.0)) / (DIAMETER / 2 * radians(0.057))


@cache
def bloch(crowning: float = HEAVY, stiffness: float = 2.8e8) -> CouplingResult:
    """Bloch's coupling; the book does not give the teeth, 72 of diametral pitch 8 fit the diameter."""
    design = Coupling(
        teeth=72,
        module=DIAMETER / 72,
        face_width=FACE,
        tooth_height=2 * DIAMETER / 72,
        crowning_ratio=crowning,
        tooth_stiffness=stiffness,
    )
    return solve(CouplingInputs(design, Operation(TORQUE, 500.0, radians(0.057)), friction=Friction(0.3)))


STATEMENTS: tuple[Statement, ...] = (
    equals(
        "load concentrates in the tilt zones: largest over mean, 0.2°",
        f"{PAHL}, Fig. 3",
        1.247,
        "-",
        lambda: _concentration(0.2),
        5e-3,
        INDEPENDENT,
    ),
    equals("the same at 1°", f"{PAHL}, Fig. 3", 4.018, "-", lambda: _concentration(1.0), 5e-3, INDEPENDENT),
    equals(
        "fewer teeth carry as the misalignment grows: teeth at 1°",
        f"{PAHL}, Fig. 3",
        22,
        "-",
        lambda: _loaded(1.0),
        0.0,
        INDEPENDENT,
    ),
    equals(
        "inertia force, third over first harmonic at 0.3°",
        f"{PAHL}, Fig. 5",
        0.546,
        "-",
        lambda: _third_over_first(0.3),
        2e-2,
        INDEPENDENT,
    ),
    below("the same at 0.1°: a sinusoid", f"{PAHL}, Fig. 5", 1e-3, "-", lambda: _third_over_first(0.1)),
    equals(
        "contact overlap 1, heavily crowned, at",
        f"{PAHL}, Fig. 7",
        0.168,
        "°",
        lambda: _overlap_one(HEAVY),
        1e-2,
        INDEPENDENT,
    ),
    equals(
        "contact overlap 1, slightly crowned, at",
        f"{PAHL}, Fig. 7",
        0.0507,
        "°",
        lambda: _overlap_one(SLIGHT),
        1e-2,
        INDEPENDENT,
    ),
    equals(
        "a short inlet halves the film of large flank radii: inlet factor, 0.2°",
        f"{PAHL}, Fig. 8",
        0.494,
        "-",
        lambda: _film(0.2, SLIGHT).lubrication.inlet_factor,
        2e-3,
        INDEPENDENT,
    ),
    below(
        "load capacity coefficient of the heavily crowned coupling at 0.4°: area 1.1",
        f"{PAHL}, Fig. 9",
        0.2,
        "-",
        lambda: _film(0.4, HEAVY).lubrication.load_capacity_coefficient or 0.0,
    ),
    equals(
        "least friction of the heavily crowned coupling",
        f"{PAHL}, Fig. 11",
        0.05,
        "-",
        lambda: _least_friction(HEAVY, 0.2, 0.8)[1],
        1e-2,
        "its sliding velocity is a calibration of ours",
    ),
    equals("at a misalignment of", f"{PAHL}, Fig. 11", 0.4, "°", lambda: _least_friction(HEAVY, 0.2, 0.8)[0], 2e-2),
    below(
        "least friction of the slightly crowned coupling",
        f"{PAHL}, Fig. 11",
        0.01,
        "-",
        lambda: _least_friction(SLIGHT, 0.05, 0.2)[1],
    ),
    equals("at a misalignment of", f"{PAHL}, Fig. 11", 0.1, "°", lambda: _least_friction(SLIGHT, 0.05, 0.2)[0], 0.1),
    equals(
        "coaxial thrust at 3000 N m",
        f"{PAHL}, Fig. 14",
        8186.0,
        "N",
        lambda: pahl(0.0, axial_velocity=CREEP).axial_thrust.force,
        1e-5,
        INDEPENDENT,
    ),
    below(
        "share of the coaxial thrust that is left at 0.05°, 200 1/s",
        f"{PAHL}, Fig. 16",
        0.1,
        "-",
        lambda: _fraction(200.0),
    ),
    above("share that is left at a quarter of the speed", f"{PAHL}, Fig. 15", 0.1, "-", lambda: _fraction(50.0)),
    equals(
        "thrust of equally loaded teeth, closed form",
        f"{PAHL}, Fig. 14",
        8186.0 * 2 / pi * asin(CREEP / (radians(0.05) * 200 * 0.078)),
        "N",
        lambda: pahl(0.05, axial_velocity=CREEP).axial_thrust.uniform_load_force,
        1e-5,
    ),
    equals(
        "self-induced thrust grows as the square of friction: exponent",
        f"{PAHL}, Fig. 17",
        2.0,
        "-",
        _friction_exponent,
        5e-3,
    ),
    equals(
        "and as diameter over hub distance: thrust at half the distance over thrust",
        f"{PAHL}, Fig. 13",
        2.0,
        "-",
        lambda: _offset_thrust(hub_distance=0.1) / _offset_thrust(),
        1e-2,
    ),
    below(
        "angular arrangement: thrust over T/r_o",
        f"{PAHL}, Fig. 13",
        1e-6,
        "-",
        lambda: abs(pahl(0.3, arrangement="angular").axial_thrust.force) * 0.078 / 3000.0,
    ),
    equals(
        "crowning ratio for 0.05° to 0.1°",
        f"{PAHL}, conclusion",
        17.2,
        "-",
        lambda: _crowning(0.05, 0.1),
        2e-2,
        INDEPENDENT,
    ),
    equals(
        "crowning ratio for 0.1° to 0.3°",
        f"{PAHL}, conclusion",
        6.97,
        "-",
        lambda: _crowning(0.1, 0.3),
        2e-2,
        INDEPENDENT,
    ),
    equals("axial force, coaxial limit", BLOCH, 60.9e3, "N", lambda: bloch().axial_thrust.coaxial_limit, 1e-3),
    between(
        "friction moment between equal loads and load on the worst teeth",
        BLOCH,
        4165.0,
        6542.0,
        "N m",
        lambda: bloch().losses.friction_moment,
    ),
    equals(
        "contact-shift moment, all load at the tooth's end",
        BLOCH,
        3150.0,
        "N m",
        lambda: bloch(END_CONTACT, 1e14).losses.contact_shift_moment,
        2e-3,
    ),
    below(
        "friction measured on high-speed couplings, at 0.1°",
        "Calistrat, J. Mech. Des. 103 (1981)",
        0.16,
        "-",
        lambda: _film(0.1, HEAVY).lubrication.friction_coefficient,
    ),
)
