"""Bearing films agree with the integrated pressure, and shafts and gaps agree with closed forms and strain energy."""

import itertools
from dataclasses import replace
from math import atan2, degrees, hypot, pi, sin, sqrt

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.drive_train.film.law import film_at, film_law
from solvers.drive_train.gap.face_curves import face_crown, face_mean, face_slope
from solvers.drive_train.inputs import (
    BearingFilm,
    DriveTrainInputs,
    Effects,
    JournalBearing,
    LinearBearing,
    RigidBearing,
    Shaft,
    ShaftSection,
)
from solvers.drive_train.shafts.bearings import bearing_state, film_force
from solvers.drive_train.shafts.influence import Unit, unit
from solvers.drive_train.shafts.shaft import GRAVITY, area, second_moment, shaft_model, shear_coefficient
from solvers.scuffing.model import mesh_of
from tests.support.changes import changed
from tests.support.drive_trains import turbo_gear
from tests.support.outcomes import unsolved

# Bearings


JOURNAL = JournalBearing(0.0, 0.16, 0.11, 0.014, 130e-6)
SPEED = 1000.0
SHORT = film_law(0.0)
FILMS: tuple[BearingFilm, ...] = ("finite", "short")


def force_of(displacement: np.ndarray, rotation: float) -> np.ndarray:
    """Return the force of the film on the shaft at a displacement."""
    # The closed form gives the components along and across the displacement.
    eccentricity = hypot(*displacement) / JOURNAL.clearance
    radial, rest = displacement / hypot(*displacement), 1 - eccentricity**2
    tangential = rotation * np.array([-radial[1], radial[0]])
    scale = film_force(JOURNAL, SPEED, SHORT)
    inward, along = 4 * eccentricity**2 / rest**2, pi * eccentricity / rest**1.5
    return np.asarray(scale * (-inward * radial + along * tangential))


@pytest.mark.parametrize("rotation", [1.0, -1.0])
@pytest.mark.parametrize("load", [(0.0, -50e3), (30e3, 4e3), (-1.0, 0.1), (2e6, 1e6)])
def test_the_film_answers_its_load(load: tuple[float, float], rotation: float) -> None:
    state = bearing_state(JOURNAL, np.array(load), SPEED, rotation, "short")
    assert force_of(state.displacement, rotation) == pytest.approx(-np.array(load), abs=1e-10 * hypot(*load))
    assert state.minimum_film == pytest.approx(JOURNAL.clearance - hypot(*state.displacement))


@pytest.mark.parametrize("eccentricity", [0.05, 0.3, 0.6, 0.9])
def test_closed_form_is_the_integrated_pressure(eccentricity: float) -> None:
    """The closed form is the integral of p = 3 eta omega h' (z^2 - L^2/4)/h^3 over the film where p is positive."""
    theta, weight = np.polynomial.legendre.leggauss(400)
    theta, weight = pi / 2 * (theta + 1), weight * pi / 2
    clearance, radius, width = JOURNAL.clearance, JOURNAL.diameter / 2, JOURNAL.width
    film, slope = clearance * (1 + eccentricity * np.cos(theta)), -clearance * eccentricity * np.sin(theta)
    per_angle = 3 * JOURNAL.viscosity * SPEED * slope / film**3 * (-(width**3) / 6) * radius
    inward, along = np.sum(weight * per_angle * np.cos(theta)), np.sum(weight * per_angle * np.sin(theta))
    point = film_at(SHORT, eccentricity)
    assert hypot(inward, along) == pytest.approx(film_force(JOURNAL, SPEED, SHORT) * point.load, rel=1e-6)
    assert atan2(along, -inward) == pytest.approx(point.attitude, rel=1e-6)


@pytest.mark.parametrize("film", FILMS)
def test_without_load_the_shaft_moves_across(film: BearingFilm) -> None:
    state = bearing_state(JOURNAL, np.zeros(2), SPEED, 1.0, film)
    assert degrees(state.attitude) == pytest.approx(90.0, abs=1e-4)
    assert state.displacement == pytest.approx([0.0, 0.0], abs=0.0)
    assert state.friction_power == pytest.approx(2 * pi * 0.014 * SPEED**2 * 0.08**3 * 0.11 / 130e-6)


@pytest.mark.parametrize("film", FILMS)
def test_a_counterclockwise_shaft_under_its_weight_moves_to_plus_x(film: BearingFilm) -> None:
    assert bearing_state(JOURNAL, np.array([0.0, -1e4]), SPEED, 1.0, film).displacement[0] > 0.0
    assert bearing_state(JOURNAL, np.array([0.0, -1e4]), SPEED, -1.0, film).displacement[0] < 0.0


@pytest.mark.parametrize("film", FILMS)
@pytest.mark.parametrize("load", [(0.0, 0.0), (0.0, -50e3), (30e3, 4e3), (3e5, -1e6)])
@pytest.mark.parametrize(
    "bearing",
    [JOURNAL, LinearBearing(0.0, ((3e8, 1e8), (-2e8, 5e8))), RigidBearing(0.0)],
    ids=["film", "spring", "rigid"],
)
def test_flexibility_is_the_derivative(
    bearing: JournalBearing | LinearBearing, load: tuple[float, float], film: BearingFilm
) -> None:
    step = 0.1

    def moved(change: FloatArray) -> FloatArray:
        return bearing_state(bearing, np.array(load) + change, SPEED, -1.0, film).displacement

    columns = [(moved(change) - moved(-change)) / (2 * step) for change in step * np.eye(2)]
    exact = bearing_state(bearing, np.array(load), SPEED, -1.0, film).flexibility
    assert pytest.approx(exact, rel=2e-5, abs=1e-5 * np.abs(exact).max()) == np.array(columns).T


def test_springs_rigid_bearings_and_clearances_left_open() -> None:
    matrix = ((3e8, 1e8), (-2e8, 5e8))
    state = bearing_state(LinearBearing(0.0, matrix), np.array([1e4, 2e4]), SPEED, 1.0, "finite")
    assert np.array(matrix) @ state.displacement == pytest.approx([1e4, 2e4])
    assert not np.any(bearing_state(RigidBearing(0.0), np.array([1e4, 2e4]), SPEED, 1.0, "finite").displacement)
    assert replace(JOURNAL, radial_clearance=None).clearance == pytest.approx(1.5e-3 * 0.08)  # a share of the radius


def test_a_film_that_cannot_carry_is_no_solution() -> None:
    assert unsolved(bearing_state, JOURNAL, np.array([0.0, 1e12]), SPEED, 1.0, "finite").code == "journal"


def test_friction_grows_with_eccentricity() -> None:
    """The short bearing neglects the moment W c e sin(phi)/2 of the load, which the film of finite width has."""
    load = np.array([0.0, -50e3])
    plain = bearing_state(JOURNAL, np.zeros(2), SPEED, 1.0, "finite").friction_power
    for film in FILMS:
        state = bearing_state(JOURNAL, load, SPEED, 1.0, film)
        moment = 50e3 * JOURNAL.clearance * state.eccentricity_ratio / 2 * sin(state.attitude) * (film == "finite")
        shear = plain / sqrt(1 - state.eccentricity_ratio**2)
        assert state.friction_power == pytest.approx(shear + SPEED * moment)
        assert state.specific_pressure == pytest.approx(50e3 / (0.16 * 0.11))


def test_a_bearing_wider_than_the_table_carries_in_proportion_to_its_width() -> None:
    """Beyond L/D = 2 the load per width stays, so the same eccentricity belongs to it; the short bearing goes on."""
    ends = [
        bearing_state(replace(JOURNAL, width=width), np.array([0.0, -4e6 * width]), SPEED, 1.0, "finite")
        for width in (0.32, 0.8)
    ]
    assert ends[1].displacement == pytest.approx(ends[0].displacement, rel=1e-12)
    assert ends[1].friction_power == pytest.approx(2.5 * ends[0].friction_power, rel=1e-12)


# Shafts in two bearings


E = 206e9
SLENDER = 1e-6  # times a diameter: shear is nothing beside bending


def beam(*sections: tuple[float, float], bearings: tuple[float, float]) -> Shaft:
    return Shaft(
        tuple(ShaftSection(length, diameter) for length, diameter in sections),
        (RigidBearing(bearings[0]), RigidBearing(bearings[1])),
        torque_position=0.0,
    )


def bend(shaft: Shaft, *loads: tuple[float, float, float], at: float) -> tuple[float, float]:
    """Return the deflection [m] and the slope [rad] of a shaft at the place `at` [m].

    Every load consists of place [m], force [N] and moment [N m].
    """
    model = shaft_model(shaft, 0.0, np.array([at, *(load[0] for load in loads)]))
    nodal = np.zeros(2 * model.z.size)
    for place, force, moment in loads:
        nodal[model.node(place)] += force
        nodal[model.z.size + model.node(place)] += moment
    motion = model.flexibility @ nodal
    return float(motion[model.node(at)]), float(motion[model.z.size + model.node(at)])


def test_stepped_beam_under_a_central_load() -> None:
    """A central load P deflects a symmetric beam with a thicker middle by P/(6 E) [a^3/I1 + (L^3/8 - a^3)/I2]."""
    a, length, force = 0.15, 0.8, 1e4
    shaft = beam((a, 0.1 * SLENDER), (length - 2 * a, 0.14 * SLENDER), (a, 0.1 * SLENDER), bearings=(0.0, length))
    thin, thick = (second_moment(section) for section in shaft.sections[:2])
    expected = force / (6 * E) * (a**3 / thin + (length**3 / 8 - a**3) / thick)
    assert bend(shaft, (length / 2, force, 0.0), at=length / 2)[0] == pytest.approx(expected, rel=1e-8)


def test_stepped_beam_under_a_load_off_its_middle() -> None:
    """The deflection equals Mohr's integral of M m/(E I), computed by quadrature over every stretch of the beam."""
    # M is the bending moment of the load, and m is the bending moment of a unit load at the place of the deflection.
    lengths, diameters, load, at = (0.2, 0.35, 0.25), (0.09 * SLENDER, 0.13 * SLENDER, 0.1 * SLENDER), 0.3, 0.62
    shaft = beam(*zip(lengths, diameters, strict=True), bearings=(0.0, 0.8))

    def moment(z: FloatArray, place: float) -> FloatArray:
        return np.where(z < place, z * (0.8 - place), place * (0.8 - z)) / 0.8

    edges = np.unique([0.0, 0.2, 0.55, 0.8, load, at])
    nodes, weights = np.polynomial.legendre.leggauss(4)
    total = 0.0
    for low, high in itertools.pairwise(edges):
        z = (low + high) / 2 + (high - low) / 2 * nodes
        section = shaft.sections[int(np.searchsorted([0.2, 0.55], (low + high) / 2))]
        total += (high - low) / 2 * np.sum(weights * moment(z, load) * moment(z, at)) / (E * second_moment(section))
    assert bend(shaft, (load, 7e3, 0.0), at=at)[0] == pytest.approx(7e3 * total, rel=1e-8)


def test_moment_on_an_overhang() -> None:
    """A moment M acts at the end of an overhang c beside a span l."""
    # The end deflects by M c l/(3 E I) + M c^2/(2 E I) and turns by M l/(3 E I) + M c/(E I).
    span, overhang, moment = 0.5, 0.2, 800.0
    shaft = beam((span + overhang, 0.1 * SLENDER), bearings=(0.0, span))
    stiffness = E * second_moment(shaft.sections[0])
    deflection, slope = bend(shaft, (span + overhang, 0.0, moment), at=span + overhang)
    expected = moment * overhang * span / (3 * stiffness) + moment * overhang**2 / (2 * stiffness)
    assert deflection == pytest.approx(expected, rel=1e-8)
    assert slope == pytest.approx(moment * span / (3 * stiffness) + moment * overhang / stiffness, rel=1e-8)


def test_shear_of_timoshenko() -> None:
    """A central load P deflects the middle of a span L by P L^3/(48 E I) + P L/(4 kappa G A)."""
    # A force F at the end of an overhang c beside a span l deflects this end by F c^2 (l + c)/(3 E I) + F c (1 +
    # c/l)/(kappa G A).
    span, overhang, force = 0.5, 0.2, 5e4
    section = ShaftSection(span + overhang, 0.16, 0.06)
    shaft = Shaft((section,), (RigidBearing(0.0), RigidBearing(span)), torque_position=0.0)
    bending = E * second_moment(section)
    shearing = E / 2.6 * area(section) * shear_coefficient(0.3, 0.375)
    middle = force * span**3 / (48 * bending) + force * span / (4 * shearing)
    assert bend(shaft, (span / 2, force, 0.0), at=span / 2)[0] == pytest.approx(middle, rel=1e-9)
    end = force * overhang**2 * (span + overhang) / (3 * bending) + force * overhang * (1 + overhang / span) / shearing
    assert bend(shaft, (span + overhang, force, 0.0), at=span + overhang)[0] == pytest.approx(end, rel=1e-9)


def test_section_properties() -> None:
    """By Cowper, kappa is 6(1 + nu)/(7 + 6 nu) for a solid circle and 2(1 + nu)/(4 + 3 nu) for a thin tube."""
    # The test also checks the second moment of area I of a tube.
    assert shear_coefficient(0.3, 0.0) == pytest.approx(7.8 / 8.8)
    assert shear_coefficient(0.3, 1.0) == pytest.approx(2.6 / 4.9)
    assert second_moment(ShaftSection(1.0, 0.2, 0.1)) == pytest.approx(pi / 64 * (0.2**4 - 0.1**4))


def test_tilt_of_a_load_off_the_middle() -> None:
    """A force F at the distances a and c from the bearings of a span l causes the slope F a c (a - c)/(3 E I l)."""
    span, a, force = 0.6, 0.37, 1e4
    shaft = beam((span, 0.12 * SLENDER), bearings=(0.0, span))
    c = span - a
    stiffness = E * second_moment(shaft.sections[0])
    slope = bend(shaft, (a, force, 0.0), at=a)[1]
    assert abs(slope) == pytest.approx(force * a * c * abs(a - c) / (3 * stiffness * span), rel=1e-8)


def test_a_sections_cut_changes_nothing() -> None:
    """The deflections under the weight do not depend on where a section is cut."""
    # The reason is that the weight is applied as consistent nodal loads.
    whole = beam((0.5, 0.1), (0.4, 0.14), bearings=(0.1, 0.8))
    cut = beam((0.2, 0.1), (0.3, 0.1), (0.4 - 0.123, 0.14), (0.123, 0.14), bearings=(0.1, 0.8))
    places = np.array([0.0, 0.3, 0.6, 0.9])
    lines = []
    for shaft in (whole, cut):
        model = shaft_model(shaft, 0.0, places)
        line = model.flexibility @ model.weight
        lines.append([line[offset + model.node(place)] for place in places for offset in (0, model.z.size)])
        weight = GRAVITY * 7850 * sum(area(section) * section.length for section in shaft.sections)
        assert model.weight[: model.z.size].sum() == pytest.approx(weight)
        assert (model.bearing_share @ model.weight).sum() == pytest.approx(weight)
    assert lines[0] == pytest.approx(lines[1], rel=1e-9)


def test_uniform_load_by_consistent_forces() -> None:
    """A uniform load q deflects the middle of a span L by 5 q L^4/(384 E I) + q L^2/(8 kappa G A)."""
    shaft = beam((1.0, 0.1), bearings=(0.0, 1.0))
    model = shaft_model(shaft, 0.0, np.array([0.5]))
    load = GRAVITY * 7850 * area(shaft.sections[0])
    bending = E * second_moment(shaft.sections[0])
    shearing = E / 2.6 * area(shaft.sections[0]) * shear_coefficient(0.3, 0.0)
    expected = 5 * load / (384 * bending) + load / (8 * shearing)
    assert (model.flexibility @ model.weight)[model.node(0.5)] == pytest.approx(expected, rel=1e-9)


# The face's gap by its own load


def unit_of(inputs: DriveTrainInputs) -> Unit:
    return unit(inputs, mesh_of(inputs.mesh.distribution).path)


def test_twist_under_a_uniform_load() -> None:
    """At the distance y from the end where the torque T enters, the twist angle is T/(G J)(y - y^2/(2 b))."""
    # Along the line of action, both ends of the face differ by F_bt b r_b^2/(2 G J).
    bearings = RigidBearing(0.32), RigidBearing(0.52)
    shaft = Shaft((ShaftSection(0.2, 0.234),), bearings, start=0.32, torque_position=0.32)
    inputs = replace(turbo_gear(), pinion_shaft=shaft, couplings=())
    system, path = unit_of(inputs), mesh_of(inputs.mesh.distribution).path
    count, force = system.stations.size, 1e5
    weights = np.full(count, force / (count - 1))
    weights[[0, -1]] /= 2
    side, radius = system.shafts[0], path.pair.pinion.base_radius
    twist = side.model.torsion @ (side.torques @ weights)
    z = side.model.z - 0.32
    twisted = force * radius / (E / 2.6 * 2 * second_moment(shaft.sections[0])) * (z - z**2 / 0.4)
    assert np.abs(twist) == pytest.approx(twisted, abs=1e-12 * twisted.max())
    gap = side.torques.T @ twist
    expected = force * 0.2 * radius**2 / (2 * E / 2.6 * 2 * second_moment(shaft.sections[0]))
    assert np.ptp(gap) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("hand", ["right", "left"])
def test_influence_is_symmetric_and_twice_the_strain_energy(hand: str) -> None:
    system = unit_of(changed(turbo_gear(), {"arrangement.hand": hand}))
    own = system.elastic[:41, :41]
    assert own == pytest.approx(own.T, abs=1e-10 * np.abs(own).max())
    assert np.linalg.eigvalsh((own + own.T) / 2).min() >= -1e-10 * np.abs(own).max()
    force = np.random.default_rng(1).normal(size=41)
    assert force @ own @ force == pytest.approx(2 * _strain_energy(system, force), rel=1e-10)


def _strain_energy(system: Unit, force: FloatArray) -> float:
    """Return the integral of M^2/(2 E I) + V^2/(2 kappa G A) + T^2/(2 G J) over both shafts [N m].

    Moments and forces at a cut follow from the equilibrium of the piece of shaft beside the cut.
    """
    energy = 0.0
    for side in system.shafts:
        z, nodal = side.model.z, side.loads[:, :, :41] @ force
        torque = side.torques[:, :41] @ force
        entry = np.argmin(np.abs(z - (0.02 if side.rotation > 0 else 0.88)))
        for e, (low, high) in enumerate(itertools.pairwise(z)):
            ends = side.shaft.start + np.cumsum([section.length for section in side.shaft.sections])
            section = side.shaft.sections[int(np.searchsorted(ends, (low + high) / 2))]
            bending, modulus = E * second_moment(section), E / 2.6
            twisting = -torque[: e + 1].sum() if e < entry else torque[e + 1 :].sum()
            energy += twisting**2 * (high - low) / (2 * modulus * 2 * second_moment(section))
            for plane in nodal:
                reactions = -side.model.bearing_share @ plane
                places = [*z[: e + 1], *(bearing.position for bearing in side.shaft.bearings)]
                forces = np.array([*plane[: e + 1], *reactions])
                acting = np.array([*np.ones(e + 1), *(place <= low + 1e-9 for place in places[-2:])])
                shear = float(np.sum(forces * acting))
                at_low = float(np.sum(forces * acting * (low - np.array(places)))) - plane[z.size :][: e + 1].sum()
                middle, rise = at_low + shear * (high - low) / 2, shear * (high - low)
                energy += (high - low) * (middle**2 + rise**2 / 12) / (2 * bending)
                energy += shear**2 * (high - low) / (2 * modulus * area(section) * shear_coefficient(0.3, 0.0))
    return energy


def test_reversing_the_hand_reverses_the_tilting_moment_alone() -> None:
    inputs = replace(turbo_gear(), effects=Effects(coupling=False, thermal=False))
    right, left = (unit_of(changed(inputs, {"arrangement.hand": hand})) for hand in ("right", "left"))
    assert left.frame.faces[0].force[2] == -right.frame.faces[0].force[2]
    assert left.frame.faces[0].direction == -right.frame.faces[0].direction
    for one, other in zip(right.shafts, left.shafts, strict=True):
        nodes = one.model.z.size
        assert other.loads[:, :nodes] == pytest.approx(one.loads[:, :nodes, ::-1], abs=1e-15)
        assert other.loads[:, nodes:] == pytest.approx(-one.loads[:, nodes:, ::-1], abs=1e-15)
        assert other.torques == pytest.approx(one.torques[:, ::-1], abs=1e-15)


def test_a_symmetric_spur_pinion_gets_its_slope_from_twist_alone() -> None:
    shaft = Shaft((ShaftSection(0.6, 0.2),), (RigidBearing(0.22), RigidBearing(0.62)), start=0.12, torque_position=0.12)
    values = {"couplings": (), "pinion_shaft": shaft, "mesh.distribution.gears.helix_angle": 0.0}
    side, force = unit_of(changed(turbo_gear(), values)).shafts[0], np.full(41, 1e3)
    motion = side.motion(side.loads @ force)
    bending = side.loads[0].T @ motion[0] + side.loads[1].T @ motion[1]
    twist = side.torques.T @ (side.model.torsion @ (side.torques @ force))
    assert face_slope(bending) == pytest.approx(0.0, abs=1e-12 * np.ptp(bending))
    assert abs(face_slope(twist)) > 0.5 * np.ptp(twist)


def test_slope_crown_and_mean_are_exact_of_lines_and_close_of_parabolas() -> None:
    eta = np.linspace(0.0, 1.0, 41)
    assert face_slope(3.0 + 2.0 * eta) == pytest.approx(2.0, rel=1e-13)
    assert face_crown(3.0 + 2.0 * eta) == pytest.approx(0.0, abs=1e-13)
    assert face_mean(3.0 + 2.0 * eta) == pytest.approx(4.0, rel=1e-14)
    fine = np.linspace(0.0, 1.0, 2001)
    assert face_crown(5.0 * (2 * fine - 1) ** 2) == pytest.approx(5.0, rel=1e-6)
    assert face_slope(5.0 * (2 * fine - 1) ** 2) == pytest.approx(0.0, abs=1e-12)
    kinked = np.where(eta < 0.5, 0.0, eta - 0.5)
    assert face_slope(kinked) == pytest.approx(12 * (0.5**3 / 3), rel=1e-12)
