"""The numerical methods of the load distribution agree with quadrature, with exact roots and with finer resolutions."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from benchmarks.published.xue import PAPER_LOAD, PAPER_MODEL, PAPER_MODIFICATIONS, paper_gears, paper_pair
from solvers.contact.hertz import half_width, reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair, path_of_contact, reduced_radius
from solvers.materials import Solid
from solvers.scuffing.contact_slices import gather, slice_table
from solvers.scuffing.inputs import LeadCurve, LoadDistributionInputs, Model, Modifications, Resolution
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.modification import gap, gaps_at, lead_table, misalignment_slope
from solvers.scuffing.tooth_stiffness import (
    bending_compliance,
    line_load,
    load_points,
    pair_compliance,
    root_rotation,
    section_gear,
    single_stiffness,
    tooth_shape,
)
from tests.support.gear_pairs import with_torque

STEEL = Solid()
PATH_1 = path_of_contact(gear_pair(paper_gears(1)))


# Tooth compliance


@pytest.mark.parametrize("place", [0.0, 0.3, 0.7, 1.0])
@pytest.mark.parametrize("section", ["normal", "transverse"])
def test_bending_and_shear_are_the_beams_integrals(place: float, section: str) -> None:
    """Without the rotation of the root, the compliance of a tooth is the integral of bending and shear (Xue Eq. 5)."""
    pair = gear_pair(paper_gears(3))
    gear = section_gear(pair, pair.pinion, pair.inputs.pinion, section)
    shape = tooth_shape(gear)
    radius = gear.form_radius + place * (gear.tip_radius - gear.form_radius)
    points = load_points(gear, np.array([radius]))
    h_x, cosine = float(points.height[0]), float(np.cos(points.angle[0]))
    taper = (shape.root_width - shape.tip_width) / (shape.height - shape.rectangle_height)

    def width(z: float) -> float:
        return shape.root_width - taper * max(z - shape.rectangle_height, 0.0)

    def strain(z: float) -> float:
        return 12 * (h_x - z) ** 2 / width(z) ** 3 + 2 * (1 + 0.3) / width(z)

    beam = cosine**2 * quad(strain, 0, h_x, points=[shape.rectangle_height], epsrel=1e-12)[0] / 206e9
    found = bending_compliance(shape, points, STEEL) - root_rotation(shape, points, STEEL)
    assert found[0] == pytest.approx(beam, rel=1e-9)


def test_loads_within_the_rectangle_bend_the_rectangle_only() -> None:
    pair = gear_pair(paper_gears(1))
    shape = tooth_shape(pair.pinion)
    points = load_points(pair.pinion, np.array([pair.pinion.form_radius]))
    low = replace(points, height=np.array([0.5 * shape.rectangle_height]))
    h_x, cosine = float(low.height[0]), float(np.cos(low.angle[0]))
    bending = 12 * h_x**3 / 3 / shape.root_width**3
    shear = 2 * 1.3 * h_x / shape.root_width
    found = bending_compliance(shape, low, STEEL) - root_rotation(shape, low, STEEL)
    assert found[0] == pytest.approx(cosine**2 * (bending + shear) / 206e9, rel=1e-12)


def test_the_virtual_gear_of_a_spur_gear_is_the_gear() -> None:
    pair = gear_pair(replace(paper_gears(1), helix_angle=0.0))
    virtual = section_gear(pair, pair.pinion, pair.inputs.pinion, "normal")
    for radius in ("reference_radius", "base_radius", "tip_radius", "root_radius"):
        assert getattr(virtual, radius) == pytest.approx(getattr(pair.pinion, radius), rel=1e-13)
    assert virtual.reference_half_angle == pytest.approx(pair.pinion.reference_half_angle, rel=1e-13)
    assert virtual.form_roll_length == pytest.approx(pair.pinion.form_roll_length, rel=1e-13)


# Contact


def half_space_approach(load: float, x: float, section: str) -> float:
    """Return the approach of the flanks [m] along the transverse line of action."""
    # The approach is the sum of the bending of both teeth and of their flattening by the half-space formula.
    pair = gear_pair(paper_gears(3))
    path = path_of_contact(pair)
    inclination = path.plane.cos_base_helix
    modulus = reduced_modulus(STEEL, STEEL)
    contact_width = half_width(load, float(reduced_radius(path.plane, x)), modulus)
    total = 0.0
    for gear, teeth, roll in (
        (pair.pinion, pair.inputs.pinion, path.start + x),
        (pair.wheel, pair.inputs.wheel, pair.line_of_action - path.start - x),
    ):
        radius = np.array([np.hypot(gear.base_radius, roll)])
        cut = section_gear(pair, gear, teeth, section)
        points = load_points(cut, cut.reference_radius + radius - gear.reference_radius)
        bending = float(bending_compliance(tooth_shape(cut), points, STEEL)[0]) * load
        depth = float(load_points(gear, radius).depth[0])
        flattening = load * (1 - 0.3**2) / (np.pi * 206e9) * (2 * np.log(2 * depth / contact_width) - 0.3 / 0.7)
        total += (bending / inclination if section == "normal" else bending) + flattening / inclination
    return total


@pytest.mark.parametrize("load", [1e2, 1e4, 3e5, 2e6])
@pytest.mark.parametrize("section", ["normal", "transverse"])
def test_line_load_inverts_the_half_space(load: float, section: str) -> None:
    path = path_of_contact(gear_pair(paper_gears(3)))
    model = Model(section=section)
    table = pair_compliance(path, STEEL, STEEL, model)
    node = 300
    approach = half_space_approach(load, node / table.points_per_metre, section)
    found, slope, log_load = line_load(approach, table.constant[node], table.logarithmic, table.limit[node], 0.0)
    assert found == pytest.approx(load, rel=1e-11)
    step = 1e-6 * approach
    ahead, _, _ = line_load(approach + step, table.constant[node], table.logarithmic, table.limit[node], 1.1 * log_load)
    assert (ahead - found) / step == pytest.approx(slope, rel=1e-5)
    assert single_stiffness(table, load)[node] == pytest.approx(load / approach, rel=1e-11)


def test_line_load_is_continuous_and_rising_across_the_half_space_limit() -> None:
    table = pair_compliance(PATH_1, STEEL, STEEL, Model())
    limit = table.limit[400]
    approaches = limit * np.linspace(0.5, 2.0, 301)
    loads = np.array([line_load(a, table.constant[400], table.logarithmic, limit, 0.0)[0] for a in approaches])
    assert np.all(np.diff(loads) > 0)
    assert np.max(np.diff(loads)) < 1.5 * np.min(np.diff(loads))


def test_half_space_contact_is_several_times_softer_than_the_printed_term() -> None:
    soft = 1 / single_stiffness(pair_compliance(PATH_1, STEEL, STEEL, Model(section="transverse")), 300e3)
    stiff = pair_compliance(PATH_1, STEEL, STEEL, PAPER_MODEL).constant
    printed = 4 * (1 - 0.3**2) / (np.pi * 206e9) / PATH_1.plane.cos_base_helix
    assert np.median((soft - stiff + printed) / printed) == pytest.approx(3.5, abs=0.25)


# Load balance


@pytest.mark.parametrize("pair", [1, 4])
def test_the_linear_balance_is_the_exact_root_by_sorting(pair: int) -> None:
    """With linear contact, the transmission error is the exact root of Xue Eqs. 8 and 9."""
    # The test sorts the slices by their gaps, and sums stiffness and stiffness times gap. The root is the first
    # transmission error that is below the gap of the next slice.
    shape = replace(PAPER_MODIFICATIONS, helix_slope=40e-6)
    result = solve_load_distribution(paper_pair(pair, shape))
    plane, mesh = result.path_of_contact.plane, result.balance.mesh
    table = np.linspace(0, plane.path_length, mesh.compliance.constant.size)
    for i in range(3, result.balance.rolls.phase.size, 17):
        x, y, length = [], [], []
        for j in range(6):
            line = result.balance.rolls.phase[i] + j * plane.base_pitch
            low = max(0.0, (line - plane.path_length) / plane.tan_base_helix)
            high = min(plane.face_width, line / plane.tan_base_helix)
            if high > low:
                middles = low + (np.arange(5000) + 0.5) * (high - low) / 5000
                x.append(line - middles * plane.tan_base_helix)
                y.append(middles)
                length.append(np.full(5000, (high - low) / 5000 / plane.cos_base_helix))
        xs, ys, ls = (np.concatenate(part) for part in (x, y, length))
        gaps = gaps_at(mesh.gap, xs, ys)
        order = np.argsort(gaps)
        weight = (ls / np.interp(xs, table, mesh.compliance.constant))[order]
        roots = (result.load.normal_force + np.cumsum(weight * gaps[order])) / np.cumsum(weight)
        first = np.argmax(roots <= np.append(gaps[order][1:], np.inf))
        assert result.transmission_error.curves.error[i] == pytest.approx(roots[first], rel=5e-5)  # 100 slices


@pytest.mark.parametrize("times", [1.0, 60.0])
@pytest.mark.parametrize("shape", [Modifications(), Modifications(profile_crowning=5e-6, lead_crowning=5e-6)])
@pytest.mark.parametrize("model", [Model(contact="linear"), Model()])
def test_every_position_carries_the_force_by_the_settled_law_of_its_slices(
    model: Model, shape: Modifications, times: float
) -> None:
    # 60 times the load presses half-spaces beyond their depth, where their compliance is held
    inputs = paper_pair(1, shape, model)
    balance = solve_load_distribution(with_torque(inputs, times * inputs.load.pinion_torque)).balance
    mesh, law = balance.mesh, balance.mesh.compliance
    assert (balance.survey.held.sum() > 0.0) == (times > 1.0 and model.contact == "hertzian")
    for i in range(0, balance.rolls.phase.size, 13):
        table, error = slice_table(mesh, 100), balance.transmission_error[i]
        cover = gather(mesh, balance.rolls.phase[i], balance.rolls.side[i], 100, np.inf, table)
        assert error > cover.most
        columns = [column[: cover.slices] for column in (table.gap, table.constant, table.limit, table.length)]
        carried = sum(
            line_load(error - gap, constant, law.logarithmic, limit, 0.0)[0] * length
            for gap, constant, limit, length in zip(*columns, strict=True)
        )
        assert carried == pytest.approx(balance.force, rel=2e-13)
        assert balance.survey.line_forces[i].sum() == pytest.approx(balance.force, rel=2e-13)


@pytest.mark.parametrize(("model", "steps"), [(Model(contact="linear"), 1.1), (Model(), 2.1)])
def test_newton_needs_few_steps(model: Model, steps: float) -> None:
    whole = solve_load_distribution(paper_pair(4, model=model)).balance.steps
    assert whole.max() <= 4
    assert whole.mean() < steps
    # A line loaded in part is cut into slices twice or three times.
    in_part = solve_load_distribution(paper_pair(4, replace(PAPER_MODIFICATIONS, helix_slope=40e-6), model))
    assert in_part.balance.steps.max() <= 15


def peak_to_peak(inputs: LoadDistributionInputs, **counts: int) -> float:
    resolution = Resolution(profile_points=5, face_points=5, **counts)
    return solve_load_distribution(replace(inputs, resolution=resolution)).transmission_error.peak_to_peak


def test_slices_converge_with_order_2() -> None:
    crowned = Modifications(profile_crowning=10e-6, lead_crowning=10e-6)
    inputs = paper_pair(1, crowned, Model(contact="linear"))
    *values, exact = (peak_to_peak(inputs, roll_positions=200, slices=slices) for slices in (25, 50, 100, 1600))
    errors = np.abs(np.array(values) - exact)
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(2.0, abs=0.3)
    assert errors[-1] < 0.0005e-6


def test_roll_positions_resolve_the_error() -> None:
    coarse, fine = (peak_to_peak(paper_pair(4, PAPER_MODIFICATIONS), roll_positions=count) for count in (200, 1600))
    assert coarse == pytest.approx(fine, abs=0.0005e-6)


def test_the_map_meets_the_lines_it_was_made_from() -> None:
    inputs = replace(paper_pair(2), resolution=Resolution(profile_points=401, face_points=201))
    result = solve_load_distribution(inputs)
    assert result.flank.line_load.max() == pytest.approx(result.load.max_line_load, rel=1e-4)
    assert np.nanmax(result.flank.pressure) == pytest.approx(result.pressure.max, rel=1e-4)


def test_harmonics_rebuild_the_error() -> None:
    result = solve_load_distribution(paper_pair(3, PAPER_MODIFICATIONS)).transmission_error
    phase, error = result.curves.roll_position, result.curves.error
    even = np.interp(np.arange(4096) / 4096, phase, error)
    amplitudes = 2 * np.abs(np.fft.rfft(even))[1:6] / 4096
    # Trapezia of 200 steps know the fifth order to (2 pi 5 / 200)^2 / 12 = 0.2 %.
    assert result.harmonics == pytest.approx(amplitudes, rel=2.5e-3)


# Modification


@pytest.mark.parametrize(
    ("name", "amplitude", "expected"),
    [
        ("tip_relief", 5e-6, [0, 5, 0, 0, 0]),
        ("root_relief", 5e-6, [5, 0, 0, 0, 0]),
        ("end_relief", 5e-6, [0, 0, 0, 5, 5]),
        ("profile_crowning", 4e-6, [4, 4, 0, 0, 0]),
        ("lead_crowning", 4e-6, [0, 0, 0, 4, 4]),
        ("profile_slope", 6e-6, [-3, 3, 0, 0, 0]),
        ("helix_slope", 6e-6, [0, 0, 0, -3, 3]),
    ],
)
def test_modifications_act_where_they_are_named(name: str, amplitude: float, expected: list[float]) -> None:
    """The gaps are compared at A, at E and at the middle of the path, each at half the face width."""
    # The gaps at both ends of the face are compared at the middle of the path.
    g, b = PATH_1.length, 20e-3
    x, y = np.array([0, g, g / 2, g / 2, g / 2]), np.array([b / 2, b / 2, b / 2, 0, b])
    found = gaps_at(gap(Modifications(**{name: amplitude}), PATH_1), x, y)
    assert found * 1e6 == pytest.approx(expected)


@pytest.mark.parametrize(("exponent", "half"), [(1.0, 2.5), (2.0, 1.25), (1.5, 5 * 0.5**1.5)])
def test_relief_exponents(exponent: float, half: float) -> None:
    form = gap(Modifications(tip_relief=5e-6, tip_relief_length=4e-3, relief_exponent=exponent), PATH_1)
    found = gaps_at(form, np.array([PATH_1.length - 2e-3]), np.array([0.0]))
    assert found[0] * 1e6 == pytest.approx(half, rel=1e-12)


def test_shaft_misalignment_as_a_helix_slope() -> None:
    angle = radians(20)
    assert misalignment_slope(10e-6, 0.0, angle) == pytest.approx(10e-6 * np.sin(angle), rel=1e-12)
    assert misalignment_slope(0.0, 10e-6, angle) == pytest.approx(10e-6 * np.cos(angle), rel=1e-12)
    tilted = gap(Modifications(helix_slope=1e-6, in_plane_deviation=20e-6, out_of_plane_deviation=-5e-6), PATH_1)
    expected = 1e-6 + misalignment_slope(20e-6, -5e-6, PATH_1.pair.working_pressure_angle)
    assert tilted.helix_slope == pytest.approx(expected, rel=1e-12)


def test_profile_shift_counts_normal_modules() -> None:
    pinion = gear_pair(replace(paper_gears(3), pinion=GearTeeth(23, 0.3))).pinion
    assert pinion.tip_radius - pinion.reference_radius == pytest.approx(1.3 * 3e-3, rel=1e-12)


def test_working_pressure_angle_solves_the_involute_equation() -> None:
    gears = replace(paper_gears(3), pinion=GearTeeth(23, 0.4), wheel=GearTeeth(30, 0.3))
    pair = gear_pair(gears)
    angle = pair.transverse_pressure_angle
    target = np.tan(angle) - angle + 2 * 0.7 * np.tan(radians(20)) / 53
    assert pair.working_pressure_angle == pytest.approx(brentq(lambda a: np.tan(a) - a - target, 0.1, 1.0), rel=1e-10)


def test_a_lead_curve_is_a_gap_over_the_face() -> None:
    """The linear part of a lead curve acts as a helix slope, and its parabolic part acts as lead crowning."""
    # At the stations, the table of the lead curve has exactly the given gaps.
    stations = np.linspace(0.0, 20e-3, 41)
    eta = stations / 20e-3 - 0.5
    curve = LeadCurve(tuple(stations), tuple(15e-6 * eta + 40e-6 * eta**2))
    by_curve = solve_load_distribution(paper_pair(1, Modifications(lead_curve=curve)))
    by_name = solve_load_distribution(paper_pair(1, Modifications(helix_slope=15e-6, lead_crowning=10e-6)))
    # The parabola is a polygon of 40 sides: 40 um / 40^2 / 4 = 0.006 um of 10.
    assert by_curve.transmission_error.mean == pytest.approx(by_name.transmission_error.mean, abs=0.007e-6)
    assert by_curve.load.max_line_load == pytest.approx(by_name.load.max_line_load, rel=1e-3)
    table = lead_table(curve, 20e-3)
    assert np.interp(stations, np.linspace(0, 20e-3, table.size), table) == pytest.approx(curve.gap, abs=1e-20)


def test_a_lead_curve_holds_its_ends_and_adds_to_the_other_modifications() -> None:
    curve = LeadCurve((5e-3, 15e-3), (2e-6, 8e-6))
    y = np.array([0.0, 5e-3, 10e-3, 15e-3, 20e-3])
    both = gaps_at(gap(Modifications(lead_curve=curve, lead_crowning=4e-6), PATH_1), np.zeros(5), y)
    crowned = gaps_at(gap(Modifications(lead_crowning=4e-6), PATH_1), np.zeros(5), y)
    assert (both - crowned) * 1e6 == pytest.approx([2, 2, 5, 8, 8], rel=1e-9)


def test_an_even_lead_curve_changes_nothing_but_the_transmission_error() -> None:
    plain = solve_load_distribution(paper_pair(3, PAPER_MODIFICATIONS))
    even = replace(PAPER_MODIFICATIONS, lead_curve=LeadCurve((0.0, 20e-3), (3e-6, 3e-6)))
    lifted = solve_load_distribution(paper_pair(3, even))
    assert lifted.transmission_error.mean == pytest.approx(plain.transmission_error.mean + 3e-6, rel=1e-12)
    assert lifted.flank.line_load == pytest.approx(plain.flank.line_load, rel=1e-9)


@pytest.mark.parametrize(
    ("position", "amount"),
    [((0.0,), (0.0,)), ((0.0, 0.0), (0.0, 1e-6)), ((0.0, 21e-3), (0.0, 0.0)), ((0.0, 1e-3), (0.0, 0.0, 0.0))],
)
def test_lead_curves_without_sense_are_refused(position: tuple[float, ...], amount: tuple[float, ...]) -> None:
    with pytest.raises(InvalidInput, match="in rising order from 0") as caught:
        solve_load_distribution(paper_pair(1, Modifications(lead_curve=LeadCurve(position, amount))))
    assert caught.value.code == "lead_curve"


def test_equal_gears_are_stiffest_at_the_pitch_point_without_rounding() -> None:
    """The profile parameter at the stiffest point is exactly 0."""
    # An earlier version gave 2e-16, and a figure stated this number as the place.
    gears = GearPairInputs(
        GearTeeth(31), GearTeeth(31), 4e-3, 60e-3, helix_angle=radians(30), rack_tip_radius=GROUND_FILLET
    )
    assert solve_load_distribution(LoadDistributionInputs(gears, PAPER_LOAD)).stiffness.max_at_gamma == 0.0
