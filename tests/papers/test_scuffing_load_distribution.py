"""The tests check sections II and IV of Xue, Zhang and Wang (GJRE-A 20(1), 2020) on load and pressure distribution.

The reference numbers come from an independent calculation of the corrected model, with linear contact and teeth cut in
the transverse section. The independent calculation did not divide the contact term by cos beta_b. This changes the
stiffnesses by at most 0.6 % (0.13 % for pairs 1 and 2); the tolerance STIFF is therefore 0.6 %. If the paper's number
is not reproduced, the test states the number that is computed instead.
"""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from benchmarks.published import xue
from benchmarks.published.xue import CALIBRATED_MODEL, PAPER_MODEL, PAPER_MODIFICATIONS, paper_gears, paper_pair
from solvers.contact import hertz
from solvers.gears.pair import gear_pair, path_of_contact, reduced_radius
from solvers.materials import Solid
from solvers.scuffing.contact_lines import contact_lengths
from solvers.scuffing.inputs import Model
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from tests.support.outcomes import codes

PAIRS = (1, 2, 3, 4)
STIFF = 0.006


def at_helix(degrees: float, model: Model) -> LoadDistribution:
    """Solve the load distribution of pair 1 with another helix angle."""
    inputs = paper_pair(1, model=model)
    return solve_load_distribution(replace(inputs, gears=replace(inputs.gears, helix_angle=radians(degrees))))


def line_load_at(result: LoadDistribution, profile: int, face: int) -> float:
    return float(result.flank.line_load[profile, face]) * 1e-3


# Table 1

# Transverse contact ratio, overlap ratio and total contact ratio of the reference
TABLE_1 = {
    1: (1.5914, 0.3612, 1.9526),
    2: (1.5914, 0.7224, 2.3138),
    3: (1.4915, 0.7327, 2.2243),
    4: (1.4915, 1.4655, 2.9570),
}


@pytest.mark.parametrize("pair", PAIRS)
def test_table_1_contact_ratios(pair: int) -> None:
    """The contact ratios, among them the overlap ratio (Xue Eq. 3), agree with the reference."""
    geometry = xue.pair(pair).geometry
    ratios = (geometry.transverse_contact_ratio, geometry.overlap_ratio, geometry.total_contact_ratio)
    assert ratios == pytest.approx(TABLE_1[pair], abs=6e-5)


def test_equation_2_needs_the_base_pitch_not_the_circular_pitch() -> None:
    """With the circular pitch printed in Xue Eq. 2, the transverse contact ratio would be 1.493 instead of 1.59."""
    path = xue.pair(1).path_of_contact
    assert path.length / (np.pi * path.pair.transverse_module) == pytest.approx(1.493, abs=5e-4)


def test_fig_6_lengths_for_a_total_contact_ratio_below_2() -> None:
    lines = xue.pair(1).contact_lines
    assert lines.min_length * 1e3 == pytest.approx(20.2608, abs=1e-4)
    assert lines.max_length * 1e3 == pytest.approx(40.5217, abs=1e-4)


@pytest.mark.parametrize(("pair", "reference"), [(2, 0.7887), (3, 0.7817), (4, 0.8078)])
def test_fig_6_length_ratio_is_near_1_above_2(pair: int, reference: float) -> None:
    assert xue.pair(pair).contact_lines.length_ratio == pytest.approx(reference, abs=6e-5)


def test_the_ratio_below_2_is_one_half_only_while_the_overlap_is_below_the_fraction_of_the_contact_ratio() -> None:
    # In general it is eps_beta / (eps_beta + min(f_alpha, eps_beta)); here eps_alpha 1.2, eps_beta 0.7.
    path = path_of_contact(gear_pair(paper_gears(1)))
    pitch, overlap = path.plane.base_pitch, 0.7 * path.plane.base_pitch / path.plane.tan_base_helix
    gears = replace(path.pair.inputs, face_width=overlap)
    shorter = replace(path_of_contact(gear_pair(gears)), end=path.start + 1.2 * pitch)
    assert contact_lengths(shorter).ratio == pytest.approx(0.778, abs=5e-4)


@pytest.mark.parametrize(("narrow", "wide", "lengths"), [(1, 2, (32.24, 64.49)), (3, 4, (31.54, 63.07))])
def test_fig_5_twice_the_width_is_twice_the_mean_length(narrow: int, wide: int, lengths: tuple[float, float]) -> None:
    """If the face width doubles, the mean total length of the contact lines (Xue Eq. 4) doubles."""
    means = [xue.pair(pair).contact_lines.mean_length * 1e3 for pair in (narrow, wide)]
    assert means == pytest.approx(lengths, abs=6e-3)


@pytest.mark.parametrize("pair", PAIRS)
def test_fig_5_the_spread_of_the_length_has_an_upper_limit_whatever_the_width(pair: int) -> None:
    result = xue.pair(pair)
    fraction = result.geometry.transverse_contact_ratio % 1
    unit = result.geometry.transverse_base_pitch / np.sin(result.geometry.base_helix_angle)
    spread = result.contact_lines.max_length - result.contact_lines.min_length
    assert 0 < spread <= unit * min(fraction, 1 - fraction) * (1 + 1e-12)


@pytest.mark.parametrize(("pair", "gamma", "stiffness"), [(1, -0.020, 15.49), (3, -0.018, 17.42)])
def test_fig_8_stiffness_is_largest_close_to_the_pitch_point(pair: int, gamma: float, stiffness: float) -> None:
    """The stiffness of a pair of teeth (Xue Eq. 7) has its maximum close to the pitch point."""
    result = xue.pair(pair).stiffness
    assert result.max_at_gamma == pytest.approx(gamma, abs=2e-3)
    assert result.max * 1e-9 == pytest.approx(stiffness, rel=STIFF)


@pytest.mark.parametrize(("pair", "reference"), [(1, 20.5), (4, 21.8)])
def test_mean_mesh_stiffness_of_the_printed_contact_term_is_far_above_the_standard(pair: int, reference: float) -> None:
    """With the contact term of Xue Eq. 6, the mean mesh stiffness is 14 to 32 % above the standard's."""
    result = xue.pair(pair).stiffness
    assert result.mean_mesh * 1e-9 == pytest.approx(reference, rel=STIFF)
    assert 1.14 < result.mean_mesh / result.standard_mesh < 1.32


# Fig. 11, text of section II-f


def test_fig_11_line_load_is_small_at_the_ends_of_the_path_and_large_near_the_pitch_point() -> None:
    result = xue.pair(1)
    assert line_load_at(result, 0, 0) == pytest.approx(214.6, rel=1e-3)
    assert result.load.max_line_load * 1e-3 == pytest.approx(368.0, rel=1e-3)
    assert line_load_at(result, -1, -1) == pytest.approx(207.1, rel=1e-3)
    assert abs(result.load.max_at.gamma) < 0.05


def test_fig_18_the_largest_line_load_falls_with_the_helix_angle_but_less_than_printed() -> None:
    # Printed 380 -> 270 N/mm; computed 368 (-3 %) -> 304 (+13 %).
    loads = [xue.pair(pair).load.max_line_load * 1e-3 for pair in (1, 3)]
    assert loads == pytest.approx([368.0, 304.0], rel=1e-3)
    assert loads[1] == pytest.approx(1.126 * 270, rel=1e-2)


@pytest.mark.parametrize(("pair", "linear", "hertzian"), [(1, 215.0, 227.0), (2, 85.8, 90.3)])
def test_fig_20_the_line_load_at_the_start_of_mesh(pair: int, linear: float, hertzian: float) -> None:
    load = line_load_at(xue.pair(pair), 0, 0)
    assert load == pytest.approx(linear, rel=2e-3)
    half_spaces = xue.pair(pair, Model(contact="hertzian", section="transverse"))
    assert line_load_at(half_spaces, 0, 0) == pytest.approx(hertzian, rel=5e-3)


def test_the_calibrated_parabola_repeats_the_printed_line_loads() -> None:
    first, second, third = (xue.pair(pair, CALIBRATED_MODEL) for pair in (1, 2, 3))
    loads = [line_load_at(first, 0, 0), line_load_at(second, 0, 0), third.load.max_line_load * 1e-3]
    assert loads == pytest.approx([272.8, 101.4, 269.4], rel=1e-3)
    assert loads[2] == pytest.approx(270, rel=0.01)
    # The maximum of pair 1, printed 380 N/mm, is missed.
    assert first.load.max_line_load * 1e-3 == pytest.approx(360, rel=2e-3)


@pytest.mark.parametrize("pair", PAIRS)
def test_fig_12_transmission_error_is_largest_where_the_contact_length_is_smallest(pair: int) -> None:
    # The paper says "similar to" the length; it is the inverse.
    result = xue.pair(pair)
    longest_error = int(np.argmax(result.transmission_error.curves.error))
    assert result.contact_lines.curves.length[longest_error] == pytest.approx(result.contact_lines.min_length, rel=1e-9)


def test_fig_12_pair_1_fluctuates_most() -> None:
    spreads = [xue.pair(pair).transmission_error.peak_to_peak * 1e6 for pair in PAIRS]
    assert spreads == pytest.approx([8.80, 1.47, 2.67, 1.13], rel=0.01)
    assert spreads[0] > 3 * max(spreads[1:])


def test_fig_13_unmodified_pressure_at_the_pinion_root_ties_with_the_middle_of_the_path() -> None:
    # The paper: the largest pressure is at the engagement of the pinion root. True for a flat stiffness only.
    result = xue.pair(1)
    root, tip = result.flank.pressure[0, 0] * 1e-6, result.flank.pressure[-1, -1] * 1e-6
    assert (root, tip) == pytest.approx((1379, 1105), rel=1e-3)
    assert root / tip == pytest.approx(1.25, abs=5e-3)
    assert result.pressure.max * 1e-6 == pytest.approx(1395, rel=1e-3)
    assert result.pressure.max_at.profile_fraction == pytest.approx(0.40, abs=0.01)


@pytest.mark.parametrize("pair", [1, 2])
def test_fig_13_with_half_space_contact_the_largest_pressure_is_at_the_pinion_root(pair: int) -> None:
    result = xue.pair(pair, Model())
    assert result.pressure.max_at.profile_fraction == 0.0


@pytest.mark.parametrize(
    ("pair", "profile", "face"), [(1, 0.476, 0.517), (2, 0.458, 0.497), (3, 0.461, 0.507), (4, 0.472, 0.516)]
)
def test_fig_16_modification_moves_the_largest_pressure_to_the_middle(pair: int, profile: float, face: float) -> None:
    place = xue.pair(pair, modifications=PAPER_MODIFICATIONS).pressure.max_at
    assert abs(place.profile_fraction - 0.5) < 0.1
    assert abs(place.face_fraction - 0.5) < 0.1
    # The maximum is flat: where it lies is known to about a slice of line or a roll step only.
    assert place.profile_fraction == pytest.approx(profile, abs=0.01)
    assert place.face_fraction == pytest.approx(face, abs=0.01)


@pytest.mark.parametrize(
    ("pair", "before", "after"), [(1, 1395, 1483), (2, 884, 1147), (3, 1183, 1379), (4, 830, 1100)]
)
def test_fig_16_modification_unloads_the_edges_but_raises_the_largest_pressure(
    pair: int, before: float, after: float
) -> None:
    plain, relieved = xue.pair(pair), xue.pair(pair, modifications=PAPER_MODIFICATIONS)
    assert plain.pressure.max * 1e-6 == pytest.approx(before, rel=2e-3)
    assert relieved.pressure.max * 1e-6 == pytest.approx(after, rel=2e-3)
    for corner in ((0, 0), (-1, -1)):
        assert relieved.flank.pressure[corner] < 0.6 * plain.flank.pressure[corner]


@pytest.mark.parametrize(
    ("slope", "pressure", "face"), [(0, 1100, 0.52), (10, 1110, 0.41), (20, 1149, 0.29), (40, 1300, 0.08)]
)
def test_fig_17_helix_slope_shifts_the_pressure_to_one_end_and_raises_it(
    slope: float, pressure: float, face: float
) -> None:
    result = xue.pair(4, modifications=replace(PAPER_MODIFICATIONS, helix_slope=slope * 1e-6))
    assert result.pressure.max * 1e-6 == pytest.approx(pressure, rel=2.5e-3)
    assert result.pressure.max_at.face_fraction == pytest.approx(face, abs=0.012)


# Section II-h


@pytest.mark.parametrize(
    ("pair", "line", "flank"), [(1, 367.6, 368.0), (2, 147.6, 147.6), (3, 304.2, 304.2), (4, 141.1, 149.5)]
)
def test_fig_18_the_feature_line_holds_the_maxima_within_6_percent(pair: int, line: float, flank: float) -> None:
    result = xue.pair(pair)
    largest = float(result.feature_line.line_load.max()) * 1e-3
    assert largest == pytest.approx(line, rel=1e-3)
    assert result.load.max_line_load * 1e-3 == pytest.approx(flank, rel=1e-3)
    assert 0.94 * flank < largest <= result.load.max_line_load * 1e-3


@pytest.mark.parametrize(
    ("pair", "own", "standard"),
    [(1, (0.59, 1.01, 0.57), (0.37, 1.0, 0.37)), (2, (0.47, 0.81, 0.46), (0.76, 0.63, 0.76))],
)
def test_fig_19_the_standards_load_sharing_resembles_pair_1_but_not_pair_2(
    pair: int, own: tuple[float, ...], standard: tuple[float, ...]
) -> None:
    """With Xue Eq. 15, the standard's load sharing rises towards the middle of the path for pair 1, but not for pair 2.

    The computed load sharing rises for both pairs.
    """
    line = xue.pair(pair).feature_line
    assert line.load_sharing is not None
    assert line.iso_load_sharing is not None
    places = [0, line.psi.size // 2, -1]
    assert line.load_sharing[places] == pytest.approx(own, abs=6e-3)
    assert line.iso_load_sharing[places] == pytest.approx(standard, abs=6e-3)
    rising = line.load_sharing[places[1]] > line.load_sharing[0]
    assert rising
    assert (line.iso_load_sharing[places[1]] > line.iso_load_sharing[0]) == (pair == 1)


def test_fig_20_the_peak_pressure_of_1_51_gpa_is_the_hertz_pressure_less_3_percent() -> None:
    """The Hertzian pressure, which is Xue Eq. 14 without pi/4, is 3 % above the paper's peak pressure of 1.51 GPa."""
    # Xue Eq. 14 prints pi/4 of it, the mean pressure.
    path = xue.pair(1).path_of_contact
    steel = Solid()
    radius = float(reduced_radius(path.plane, 0.0))
    pressure = hertz.maximum_pressure(273e3, radius, hertz.reduced_modulus(steel, steel))
    assert pressure * 1e-9 == pytest.approx(1.555, abs=5e-4)
    assert pressure / 1.51e9 == pytest.approx(1.03, abs=2e-3)
    assert np.pi / 4 * pressure * 1e-9 == pytest.approx(1.221, abs=5e-4)


# Corrections of the paper


def test_equation_1_with_the_tangential_force_lowers_every_load_by_the_base_helix() -> None:
    """With the tangential force of Xue Eq. 1, the largest line load is 1.3 % (pair 1) or 5.4 % (pair 3) lower."""
    for pair, drop in ((1, 0.013), (3, 0.054)):
        printed = xue.pair(pair, replace(PAPER_MODEL, load_convention="paper"))
        lower = 1 - printed.load.max_line_load / xue.pair(pair).load.max_line_load
        assert lower == pytest.approx(drop, abs=6e-4)
        assert lower == pytest.approx(1 - np.cos(printed.geometry.base_helix_angle), rel=1e-9)


@pytest.mark.parametrize("pair", PAIRS)
def test_face_load_factor_of_unmodified_gears_is_not_1_because_phases_weigh_by_stiffness(pair: int) -> None:
    factor = xue.pair(pair).load.face_load_factor
    assert 1.0095 < factor < 1.0135


def test_loss_factor_and_power_of_pair_1() -> None:
    loss = xue.pair(1).friction_loss
    assert loss.loss_factor == pytest.approx(0.167, abs=5e-4)
    assert loss.power == pytest.approx(500, rel=2e-3)


# Defaults of this service: half-space contact, normal section


def test_default_model_of_pair_1() -> None:
    result = xue.pair(1, Model())
    error = result.transmission_error
    assert [error.min * 1e6, error.max * 1e6, error.peak_to_peak * 1e6] == pytest.approx(
        [18.162, 29.152, 10.990], abs=6e-4
    )
    assert result.load.max_line_load * 1e-3 == pytest.approx(367.4, abs=0.06)
    assert result.pressure.max * 1e-6 == pytest.approx(1412.8, abs=0.06)
    assert result.stiffness.mean_mesh * 1e-9 == pytest.approx(16.85, abs=6e-3)


@pytest.mark.parametrize(
    ("helix", "deviations", "own", "standard", "excess"),
    [
        (9.8, {"transverse": -0.028, "normal": -0.059}, 12.40, 12.40, 0.03),
        (20.2, {"transverse": 0.079, "normal": -0.060}, 12.35, 12.17, 0.16),
        (30.0, {"transverse": 0.267, "normal": -0.061}, 12.21, 11.73, 0.40),
    ],
)
def test_half_space_stiffness_against_iso_6336_1(
    helix: float, deviations: dict[str, float], own: float, standard: float, excess: float
) -> None:
    """The mesh stiffness and the single stiffness at the pitch point are compared with ISO 6336-1."""
    # Teeth cut in the transverse section are too stiff. Above a helix angle of 15 degrees, the result contains a
    # warning.
    # Reference, transverse with the contact term undivided: -2.5, +9.3, +31 %; divided, the contact yields more by
    # 1/cos(beta_b). Reference, normal: -6, -6, -5 %. All gears 20 mm wide.
    results = {section: at_helix(helix, Model(section=section)) for section in deviations}
    for section, deviation in deviations.items():
        found = results[section].stiffness
        assert found.mean_mesh / found.standard_mesh - 1 == pytest.approx(deviation, abs=1e-3)
    # The reference does not say at which load it takes the secant; here it is the mean line load. A third more load
    # raises the secant by 1 %.
    normal, transverse = results["normal"].stiffness, results["transverse"].stiffness
    assert normal.standard_single * 1e-9 == pytest.approx(standard, abs=6e-3)
    assert normal.pitch * 1e-9 == pytest.approx(own, rel=0.0125)
    assert transverse.pitch / transverse.standard_single - 1 == pytest.approx(excess, abs=0.06)
    assert ("transverse_section" in codes(results["transverse"])) == (helix > 15)
