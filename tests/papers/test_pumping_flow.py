"""The flow is compared with Milian's statements and with independent calculations of the same equations.

A test of the second-order scheme names the limit to which the computed number converges. The limits come from grids of
up to 1600 slices. The reference numbers of the pocket chain come from an adaptive stiff integrator.
"""

from dataclasses import replace
from math import log, log2, pi, sqrt

import numpy as np
import pytest

from benchmarks.published.milian import (
    CASE_1,
    CASE_2,
    CHAIN,
    GROOVE,
    INCOMPRESSIBLE,
    ISENTROPIC,
    PRINTED,
    SPEED_1,
    SPEED_2,
    TABLE_1,
    TIP,
    pinion,
    run,
)
from solvers.gears.inputs import GearPairInputs
from solvers.materials import Solid
from solvers.pumping import Ambient, ChokingInputs, ChokingSpeeds, PumpingInputs, PumpingModel, PumpingSetup
from solvers.pumping.choking import choking_speeds
from solvers.pumping.flow.nozzle import choked_mass_flux, gas, mass_flux
from solvers.pumping.model import solve_on_slices
from solvers.pumping.results import SpacesResult
from tests.support.outcomes import codes

CASES = [(CASE_1, SPEED_1), (CASE_2, SPEED_2)]


def chokes(gears: GearPairInputs, backlash: float, model: PumpingModel, limit: float = 60000) -> ChokingSpeeds:
    return choking_speeds(ChokingInputs(PumpingSetup(gears, backlash, model=model), limit * pi / 30))


@pytest.mark.parametrize("exponent", [1.2, 1.3, 1.4, 5 / 3])
def test_eq_7_is_the_choked_limit_of_the_nozzle_law(exponent: float) -> None:
    """If the downstream pressure is low, the nozzle law gives the choked mass flux of Milian Eq. 7."""
    air = gas(Ambient(isentropic_exponent=exponent))
    for downstream in (0.0, 0.3 * 3e5):
        flux = mass_flux(air, 3e5, 3e5 / (air.constant * 400.0), downstream)[0]
        assert flux / choked_mass_flux(air, 3e5, 400.0) == pytest.approx(1, abs=1e-12)


def test_eq_6_2_corrected_keeps_the_gas_law() -> None:
    """If the misprint in Milian Eq. 6 is corrected, a closed pocket heats up isentropically."""
    # printed rho = rho_old (p_old/p_new)^(1/g) contradicts Eqs. 1 and 6-1: a closed pocket would not follow Eq. 6-1
    model = replace(ISENTROPIC, gap=TIP.gap, discharge_coefficient=0.0)
    field = pinion(run(TABLE_1, 1000, model, 1, 0.0)).field
    assert field.temperature_rise is not None
    heating = 1 + field.temperature_rise[:, 0] / Ambient().temperature
    assert heating == pytest.approx(field.pressure_ratio[:, 0] ** (0.4 / 1.4), rel=1e-6)
    assert heating.max() > 2


@pytest.mark.parametrize("closure", [CHAIN, ISENTROPIC])
def test_isentropic_compression_of_a_closed_pocket(closure: PumpingModel) -> None:
    """The pressure in a closed pocket follows the isentropic law of Milian Eq. 1."""
    # p_max/p_e = (S_start/S_min)^1.4 = 37.622 for Table 1 with tip gaps
    model = replace(closure, gap=TIP.gap, discharge_coefficient=0.0)
    result = pinion(run(TABLE_1, 1000, model, 1, 0.0))
    stroke = result.stroke
    assert result.peak_pressure_ratio == pytest.approx((stroke.max_area / stroke.min_area) ** 1.4, rel=1e-4)
    assert result.peak_pressure_ratio == pytest.approx(37.622, rel=1e-4)
    area = np.interp(result.field.angle, stroke.curves.angle, stroke.curves.area)
    closed = result.field.pressure_ratio[1:-1, 0] * (area[1:-1] / area[0]) ** 1.4
    assert closed == pytest.approx(1, abs=1e-5)


def test_rosen_incompressible_theory() -> None:
    # Table 1, b 200 mm, one pocket, tip gaps, 1000 rpm
    flow = pinion(run(TABLE_1, 1000, INCOMPRESSIBLE, backlash=0.0))
    assert flow.peak_axial_velocity == pytest.approx(8.975, rel=1e-2)


def test_incompressible_against_slow_gas() -> None:
    # T1, 1000 rpm, b 50: tip gaps 0.288 W against 0.40 W of gas dynamics; sealed contact gaps agree to about 1 %
    narrow = replace(TABLE_1, face_width=0.05)
    assert run(narrow, 1000, INCOMPRESSIBLE, backlash=0.0).total.pumping_power == pytest.approx(0.288, rel=5e-3)
    assert run(narrow, 1000, TIP, backlash=0.0).total.pumping_power == pytest.approx(0.40, rel=0.02)
    sealed = run(narrow, 1000, replace(INCOMPRESSIBLE, gap=PRINTED.gap), backlash=0.0).total.pumping_power
    assert run(narrow, 1000, backlash=0.0).total.pumping_power == pytest.approx(sealed, rel=0.02)


@pytest.mark.parametrize(("gears", "speed"), CASES)
@pytest.mark.parametrize("model", [PRINTED, PumpingModel(), TIP, CHAIN, ISENTROPIC])
def test_mass_and_energy_are_conserved(gears: GearPairInputs, speed: float, model: PumpingModel) -> None:
    """The flow conserves mass (Milian Eqs. 2-4). It also conserves energy unless the closure is isentropic."""
    result = pinion(run(gears, speed, model))
    flow = result.mass_flow
    assert result.balance.mass_error < 1e-12
    assert abs(flow.front + flow.rear + flow.radial + flow.grooves + flow.reset) < 1e-10 * flow.radial
    if model is ISENTROPIC:
        assert result.balance.energy_error is None
    else:
        assert result.balance.energy_error < 1e-12


def test_nearly_no_effect_at_low_speed_with_the_cube_of_which_power_grows() -> None:
    # limit on fine grids 14.11 W, an independent calculation gave 14.15 W; 115.4 W at 2000 rpm, exponent 3.03
    slow, fast = pinion(run(CASE_1, 1000)), pinion(run(CASE_1, 2000))
    assert slow.peak_pressure_ratio - 1 == pytest.approx(0.0105, rel=0.03)
    assert (slow.pumping_power, fast.pumping_power) == pytest.approx((14.15, 115.4), rel=0.01)
    assert log2(fast.pumping_power / slow.pumping_power) == pytest.approx(3.03, abs=0.02)


# Peak pressure [-] and power [W] on fine grids; Mach number at the exit; place [of b] and rise [K] of the hottest;
# speed [m/s] and Mach number of the meshing point along the face
AT_TEST_SPEEDS = [
    (CASE_1, SPEED_1, (2.7051, 12245.0), 1.045, (0.783, 23.40), (723, 2.0)),
    (CASE_2, SPEED_2, (3.3363, 13432.0), 1.056, (0.794, 29.89), (956, 2.65)),
]


@pytest.mark.parametrize(("gears", "speed", "converged", "mach", "hottest", "axial"), AT_TEST_SPEEDS)
def test_the_flow_at_the_test_speeds(
    gears: GearPairInputs,
    speed: float,
    converged: tuple[float, float],
    mach: float,
    hottest: tuple[float, float],
    axial: tuple[float, float],
) -> None:
    coarse, usual, fine = (pinion(run(gears, speed, slices=slices)) for slices in (50, None, 200))
    # within 1 % at 100 slices as asked for, 0.1 % as found
    for result, tolerance in ((coarse, 3e-3), (usual, 1e-3), (fine, 3e-4)):
        assert result.peak_pressure_ratio == pytest.approx(converged[0], rel=tolerance)
    for result, tolerance in ((usual, 2e-3), (fine, 1e-3)):
        assert result.pumping_power == pytest.approx(converged[1], rel=tolerance)
    # the exit face tends to 1.046 and 1.057; 200 slices give 1.040 and 1.052
    assert fine.peak_axial_mach == pytest.approx(mach, rel=0.01)
    assert fine.axial_choked
    assert fine.radial_choked
    assert fine.hottest_position / 0.2 == pytest.approx(hottest[0], abs=0.01)
    assert fine.max_temperature_rise == pytest.approx(hottest[1], rel=2e-3)
    assert usual.max_temperature_rise == pytest.approx(hottest[1], rel=0.01)
    total = run(gears, speed).total
    assert total.axial_meshing_speed == pytest.approx(axial[0], abs=0.6)
    assert total.axial_meshing_mach == pytest.approx(axial[1], abs=0.02)


def test_case_1_temperatures_along_the_face() -> None:
    profile = pinion(run(CASE_1, SPEED_1)).profile.temperature_rise
    assert profile is not None
    assert profile[[0, -1]] == pytest.approx([6.8, 19.9], abs=0.15)
    assert [profile[:50].mean(), profile[50:].mean()] == pytest.approx([14.9, 21.9], abs=0.1)


@pytest.mark.parametrize(
    ("gears", "speed", "rise", "power"), [(CASE_1, SPEED_1, 11.1, 7240.0), (CASE_2, SPEED_2, 15.8, None)]
)
def test_groove_halves_the_heating(gears: GearPairInputs, speed: float, rise: float, power: float | None) -> None:
    plain, grooved = pinion(run(gears, speed)), pinion(run(gears, speed, grooves=GROOVE))
    assert grooved.max_temperature_rise == pytest.approx(rise, rel=0.015)  # the reference is rounded
    if power is not None:
        assert grooved.pumping_power == pytest.approx(power, rel=0.005)
        assert 0.4 < 1 - grooved.pumping_power / plain.pumping_power < 0.6


def test_temperature_does_not_depend_on_the_angle_at_high_speed() -> None:
    # heat reaches sqrt(a t) deep in one revolution: a small part of a tooth, so that only means count
    steel = Solid()
    diffusivity = steel.thermal_conductivity / (steel.density * steel.specific_heat)
    assert sqrt(diffusivity * 60 / SPEED_1) < 0.05 * CASE_1.normal_module


def test_wide_faces_suffer() -> None:
    # first order 12.3, 23.0, 29.1, 32.8 K and 4.3, 12.2, 20.4, 28.9 kW; second order 2 % above
    results = [pinion(run(replace(CASE_1, face_width=width), SPEED_1)) for width in (0.1, 0.2, 0.3, 0.4)]
    assert [result.max_temperature_rise for result in results] == pytest.approx([12.3, 23.0, 29.1, 32.8], rel=0.025)
    powers = [result.pumping_power / 1e3 for result in results]
    assert powers == pytest.approx([4.3, 12.2, 20.4, 28.9], rel=0.02)


def test_rig_at_26000_rpm() -> None:
    result = pinion(run(CASE_1, 26000, slices=200))
    assert result.peak_axial_mach >= 1
    assert result.peak_pressure_ratio == pytest.approx(9.56, rel=0.01)
    assert result.pumping_power == pytest.approx(86.9e3, rel=0.01)


def test_tip_gaps_as_printed_are_not_sonic() -> None:
    # Case 1: j_n 0 gives 1.083, Mach 0.207 (200 slices, first order), 1.84 K; j_n 0.3 gives 1.062, 0.182, 1.34 K
    tight, slack = pinion(run(CASE_1, SPEED_1, TIP, backlash=0.0)), pinion(run(CASE_1, SPEED_1, TIP))
    assert [tight.peak_pressure_ratio, slack.peak_pressure_ratio] == pytest.approx([1.083, 1.062], abs=2e-3)
    assert [tight.max_temperature_rise, slack.max_temperature_rise] == pytest.approx([1.84, 1.34], abs=0.02)
    assert 0.18 < slack.peak_axial_mach < tight.peak_axial_mach < 0.23
    assert not tight.radial_choked
    assert not tight.axial_choked


def test_wall_transport_lowers_the_pinion_pressure() -> None:
    # 200 slices: case 1 2.462, 19.8 K, 11.83 kW, exit Mach 1.005; case 2 2.973, 25.2 K
    first = pinion(run(CASE_1, SPEED_1, replace(PRINTED, wall_transport=True), 200))
    second = pinion(run(CASE_2, SPEED_2, replace(PRINTED, wall_transport=True), 200))
    assert [first.peak_pressure_ratio, second.peak_pressure_ratio] == pytest.approx([2.462, 2.973], rel=2e-3)
    assert [first.max_temperature_rise, second.max_temperature_rise] == pytest.approx([19.8, 25.2], rel=5e-3)
    assert first.pumping_power == pytest.approx(11830, rel=2e-3)
    assert first.peak_axial_mach == pytest.approx(1.005, rel=0.01)


@pytest.mark.parametrize(
    ("pockets", "pressure", "power"), [(5, 1.50, 6.5), (10, 1.68, 7.4), (20, 1.89, 8.3), (40, 2.14, 9.2)]
)
def test_pocket_chain_does_not_converge_in_its_pockets(pockets: int, pressure: float, power: float) -> None:
    result = pinion(run(CASE_1, SPEED_1, CHAIN, pockets))
    assert result.peak_pressure_ratio == pytest.approx(pressure, abs=0.01)
    assert result.pumping_power / 1e3 == pytest.approx(power, abs=0.06)
    assert run(CASE_1, SPEED_1, CHAIN, pockets).slices == pockets


def test_closures_agree_on_pressure_but_not_on_temperature() -> None:
    # N 20: 1.878 against 1.892, 8.62 against 8.28 kW, 9.8 K at 0.475 against 20.2 K at 0.575
    results = [pinion(run(CASE_1, SPEED_1, model, 20)) for model in (ISENTROPIC, CHAIN)]
    assert [result.peak_pressure_ratio for result in results] == pytest.approx([1.878, 1.892], rel=2e-3)
    assert [result.pumping_power for result in results] == pytest.approx([8620, 8280], rel=3e-3)
    assert [result.max_temperature_rise for result in results] == pytest.approx([9.8, 20.2], rel=0.02)
    assert [result.hottest_position / 0.2 for result in results] == pytest.approx([0.475, 0.575], abs=0.026)


def test_pocket_chain_with_tip_gaps() -> None:
    result = pinion(run(CASE_1, SPEED_1, replace(CHAIN, gap=TIP.gap), 10, 0.0))
    assert result.peak_pressure_ratio == pytest.approx(1.065, abs=1e-3)


def test_end_of_stroke_pressure_makes_the_reset_an_approximation() -> None:
    # 0.90 to 0.98 of the ambient pressure at 9000 rpm
    result = pinion(run(CASE_1, 9000))
    last = [column[np.flatnonzero(column != 1)[-1]] for column in result.field.pressure_ratio.T]
    assert 0.85 < np.median(last) < 0.99


def test_thermal_lead_curve_of_case_1() -> None:
    # radius 0.722 um/K; with the longer body the range for wall response 1 is 19.1 um instead of 11.9 um
    lead = run(CASE_1, SPEED_1).lead_correction
    rise = pinion(run(CASE_1, SPEED_1)).profile.temperature_rise
    assert np.ptp(lead.curves.radial_only) / np.ptp(rise) * 1e6 == pytest.approx(0.722, abs=0.001)
    assert np.ptp(lead.curves.radial_only) * 1e6 == pytest.approx(11.9, abs=0.15)
    assert lead.range * 1e6 == pytest.approx(19.1, abs=0.2)
    assert -lead.curves.correction[[0, -1]] * 1e6 == pytest.approx([0, 18.7], abs=0.2)
    assert lead.slope < 0


def test_pulsation_of_case_1() -> None:
    # one calculation: 5.22 front, 4.46 rear (g/s); net flow 4.96 and 4.25, small differences of 18 and 30 g/s gross
    result = run(CASE_1, SPEED_1, slices=200)
    waves, flow = result.pulsation, pinion(result).mass_flow
    assert waves.frequency[0] == pytest.approx(7259, abs=0.5)
    assert waves.frequency == pytest.approx(waves.frequency[0] * np.arange(1, 9))
    assert waves.front_mass_flow[0] * 1e3 == pytest.approx(5.22, rel=0.025)
    assert waves.rear_mass_flow[0] * 1e3 == pytest.approx(4.46, rel=0.025)
    assert flow.front * 1e3 == pytest.approx(4.96, abs=0.015 * 18.3)
    assert flow.rear * 1e3 == pytest.approx(4.25, abs=0.015 * 29.6)


def test_heavy_mist_raises_the_pressure() -> None:
    # molar mass 58 g/mol, exponent 1.3: case 1 from 2.70 to 4.42 on fine grids (a first-order reference says 4.06)
    mist = Ambient(isentropic_exponent=1.3, molar_mass=0.058)
    assert in_gas(SPEED_1, mist).peak_pressure_ratio == pytest.approx(4.42, rel=3e-3)


def test_only_the_ratio_of_speed_to_sound_speed_counts() -> None:
    # four times the molar mass at half the speed: the same Mach numbers, the same pressures
    heavy = Ambient(molar_mass=4 * Ambient().molar_mass)
    expected = pinion(run(CASE_1, SPEED_1)).peak_pressure_ratio
    assert in_gas(SPEED_1 / 2, heavy).peak_pressure_ratio == pytest.approx(expected, rel=1e-9)


def in_gas(speed: float, ambient: Ambient) -> SpacesResult:
    return pinion(solve_on_slices(PumpingInputs(PumpingSetup(CASE_1, ambient=ambient, model=PRINTED), speed * pi / 30)))


# Speeds at which the flow becomes sonic: reference numbers of an independent calculation


@pytest.mark.parametrize(
    ("gears", "backlash", "radial", "axial"),
    [(CASE_1, 0.3e-3, 7016, 7386), (CASE_1, 0.1e-3, 5676, 5755), (CASE_2, 0.3e-3, 5787, 6243)],
)
def test_contact_gaps(gears: GearPairInputs, backlash: float, radial: float, axial: float) -> None:
    # converged numbers to 0.1 %: the largest pressure at 100 slices is as near its limit
    found = chokes(gears, backlash, PRINTED)
    assert found.radial_choking_speed * 30 / pi == pytest.approx(radial, rel=1e-3)
    assert found.axial_choking_speed * 30 / pi == pytest.approx(axial, rel=1.5e-3)
    assert {notice.message for notice in found.warnings if "inlet" not in notice.message} == set()


@pytest.mark.parametrize(("gears", "test_speed", "radial"), [(CASE_1, SPEED_1, 21800), (CASE_2, SPEED_2, 23600)])
def test_tip_gaps_choke_far_above_the_test_speeds(gears: GearPairInputs, test_speed: float, radial: float) -> None:
    # the reference is of first order, whose peaks are lower: it chokes a few per cent later
    found = chokes(gears, 0.0, TIP)
    assert found.radial_choking_speed * 30 / pi == pytest.approx(radial, rel=0.035)
    assert found.radial_choking_speed * 30 / pi > 2 * test_speed


def test_beyond_the_search_limit() -> None:
    found = chokes(CASE_1, 0.3e-3, PRINTED, 7200)
    assert found.radial_choking_speed is not None
    assert found.axial_choking_speed is None
    assert codes(found) == {"beyond_search_limit"}


# Directions that measurements fix (Houjoh and others 2004; Diab, Ville, Velex 2006)


@pytest.mark.parametrize(("gears", "speed"), [*CASES, (TABLE_1, 9000.0)])
def test_pressure_on_the_approach_side_suction_on_the_recess_side(gears: GearPairInputs, speed: float) -> None:
    result = pinion(run(gears, speed))
    lag = np.tan(gears.helix_angle) / (gears.pinion.teeth * gears.normal_module / np.cos(gears.helix_angle) / 2)
    field = result.field
    for column, position in zip(field.pressure_ratio.T[10:-10:10], field.position[10:-10:10], strict=True):
        phase = field.angle - lag * position
        approach, recess = column[(phase > result.stroke.start) & (phase < 0)], column[(phase > 0.02) & (column != 1)]
        assert approach.max() > 1.2
        assert recess.min() < 0.9
        assert approach.mean() > 1 > recess.mean()
        assert phase[np.argmax(column)] < phase[np.argmin(column)]


@pytest.mark.parametrize(("gears", "speed"), CASES)
def test_the_medium_is_driven_from_the_end_that_meshes_first_to_the_other(gears: GearPairInputs, speed: float) -> None:
    result = pinion(run(gears, speed))
    peaks = result.field.angle[np.argmax(result.field.pressure_ratio, axis=0)]
    assert np.all(np.diff(peaks[5:-5]) >= 0)
    assert np.argmax(result.profile.peak_pressure_ratio) > 50
    assert result.hottest_position > 0.1


def test_closing_the_openings_raises_pumping() -> None:
    powers = [
        pinion(run(TABLE_1, 3000, replace(CHAIN, discharge_coefficient=share))).pumping_power
        for share in (1.0, 0.8, 0.6)
    ]
    assert powers[0] < powers[1] < powers[2]


def test_loss_grows_more_slowly_than_the_cube_once_choked() -> None:
    speeds = [1000.0, 2000.0, 8000.0, 16000.0, 32000.0]
    powers = [pinion(run(CASE_1, speed)).pumping_power for speed in speeds]
    exponents = np.diff(np.log(powers)) / np.diff(np.log(speeds))
    assert exponents[0] == pytest.approx(3, abs=0.05)
    assert exponents[-2] < 2.5
    assert exponents[-1] < exponents[-2]


def test_loss_is_proportional_to_the_density_while_unchoked() -> None:
    usual, dense, heavy = (
        in_gas(1000, Ambient(**changes)).pumping_power
        for changes in ({}, {"pressure": 3 * 101325.0}, {"molar_mass": 1.5 * 0.0289647})
    )
    assert dense / usual == pytest.approx(3, rel=1e-9)  # at one sound speed: exactly
    assert log(heavy / usual) / log(1.5) == pytest.approx(1, abs=0.03)


def test_default_model_keeps_all_directions() -> None:
    plain, slow = run(CASE_1, SPEED_1, PumpingModel()), run(CASE_1, 1000, PumpingModel())
    assert plain.total.pumping_power > 500 * slow.total.pumping_power
    for spaces in (plain.pinion_spaces, plain.wheel_spaces):
        assert 0.7 < spaces.hottest_position / 0.2 < 0.9
        assert spaces.profile.temperature_rise is not None
        assert spaces.profile.temperature_rise[-1] > 2 * spaces.profile.temperature_rise[0]
        assert spaces.radial_choked
