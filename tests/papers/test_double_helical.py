"""The worked example of a double-helical unit: independent calculations, not a publication (two programs agreed)."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from solvers.drive_train.inputs import Effects
from solvers.drive_train.results import DriveTrainResult
from solvers.drive_train.states import solve
from tests.support.changes import changed
from tests.support.double_helicals import double_helical, ground
from tests.support.drive_trains import cold, rigid_bearings
from tests.support.properties import first

TAU = "couplings.0.thrust_fraction"
MU = "couplings.0.friction.coefficient"
HAND = "arrangement.hand"
RELATIVE = 1e-3
SLOPE = 0.05e-6  # m
CORRECTED, CORRECTED_TRAILING = ground(23.0, 11.0), ground(1.0, 13.0)


def solved(values: Mapping[str, Any] | None = None) -> DriveTrainResult:
    return solve(changed(double_helical(), values or {}))


def test_numbers_1_to_7_and_12() -> None:
    result = solved()
    assert result.axial is not None
    assert result.helices is not None
    one, two = result.helices
    assert result.axial.unloading_force == pytest.approx(50161, rel=RELATIVE)
    assert [h.misalignment.shaft_slope for h in (one, two)] == pytest.approx([-9.787e-6, 1.313e-6], abs=SLOPE)
    recommended = [h.misalignment.recommended_helix_slope for h in (one, two)]
    assert recommended == pytest.approx([23.307e-6, 11.411e-6], abs=SLOPE)
    crowns = [h.misalignment.recommended_lead_crowning for h in (one, two)]
    assert crowns == pytest.approx([-0.80e-6, -0.80e-6], abs=SLOPE)
    for helix in (one, two):
        assert helix.misalignment.thermal_slope == pytest.approx(-12.649e-6, abs=SLOPE)
        assert helix.misalignment.thermal_profile_slope == pytest.approx(-5.416e-6, abs=SLOPE)
    assert [h.load.face_load_factor for h in (one, two)] == pytest.approx([1.4164, 1.1922], rel=RELATIVE)
    assert [safety_of(h) for h in (one, two)] == pytest.approx([1.8384, 1.9651], rel=RELATIVE)
    assert result.axial.float == pytest.approx(6.69e-6, abs=SLOPE)
    assert result.losses.pumping == pytest.approx(6518, rel=RELATIVE)
    assert result.axial.apex == "leading"
    assert result.decisive_helix == 1
    parts = [h.misalignment.parts for h in (one, two)]
    assert [p.torsion for p in parts] == pytest.approx([-3.91e-6, 1.05e-6], abs=SLOPE)
    assert [p.films_pinion for p in parts] == pytest.approx([-3.70e-6, 3.70e-6], abs=SLOPE)
    assert [p.bending for p in parts] == pytest.approx([-2.75e-6, -2.86e-6], abs=SLOPE)


def safety_of(helix: Any) -> float:
    assert helix.safety is not None
    return float(helix.safety.blok_flank)


def test_numbers_8_and_9() -> None:
    """The coupling locked at -F_max: 70 % of the load on helix 1."""
    result = solved({TAU: -1.0})
    assert result.axial is not None
    assert result.helices is not None
    one, two = result.helices
    assert [one.share, two.share] == pytest.approx([0.70259, 0.29741], rel=RELATIVE)
    assert [h.load.max_pressure for h in (one, two)] == pytest.approx([814.2e6, 541.2e6], rel=RELATIVE)
    assert safety_of(one) == pytest.approx(1.6391, rel=RELATIVE)
    assert result.axial.float == pytest.approx(-38.87e-6, abs=SLOPE)


def test_number_10() -> None:
    result = solved({TAU: 1.0})
    assert result.axial is not None
    assert result.helices is not None
    two = result.helices[1]
    assert two.load.face_load_factor == pytest.approx(1.2396, rel=RELATIVE)
    assert safety_of(two) == pytest.approx(1.6786, rel=RELATIVE)
    assert result.axial.float == pytest.approx(46.11e-6, abs=SLOPE)
    assert result.decisive_helix == 2
    assert result.helices[0].load.face_load_factor > two.load.face_load_factor  # the larger factor is on the other one


def test_number_11() -> None:
    """A left-hand first helix: the apex trails."""
    result = solved({HAND: "left"})
    assert result.axial is not None
    assert result.helices is not None
    one, two = result.helices
    assert result.axial.apex == "trailing"
    assert [h.misalignment.shaft_slope for h in (one, two)] == pytest.approx([11.553e-6, 0.105e-6], abs=SLOPE)
    assert [h.load.face_load_factor for h in (one, two)] == pytest.approx([1.058, 1.214], rel=RELATIVE)
    assert [safety_of(h) for h in (one, two)] == pytest.approx([2.051, 1.952], rel=RELATIVE)


# row; changes; (share, slope by the shafts um, K_Hbeta, w_max N/mm, p_H MPa, flash K, S_B) of both helices; float um
ROWS: list[tuple[str, dict[str, Any], tuple[float, ...], tuple[float, ...], float | None]] = [
    (
        "2",
        {"effects": Effects(coupling=False, thermal=False)},
        (0.5, -6.7, 1.165, 463, 660, 42.7, 1.939),
        (0.5, -2.3, 1.077, 430, 635, 40.3, 1.994),
        4,
    ),
    (
        "10 -1",
        {"mesh.distribution.modifications": CORRECTED, TAU: -1.0},
        (0.703, -10.6, 1.039, 574, 729, 48.6, 1.815),
        (0.297, 1.3, 1.102, 275, 502, 26.7, 2.372),
        -38,
    ),
    (
        "1",
        {"effects": Effects(shafts=False, coupling=False, thermal=False)},
        (0.5, 0.0, 1.000, 402, 614, 38.2, 2.043),
        (0.5, 0.0, 1.000, 402, 614, 38.2, 2.043),
        0,
    ),
    (
        "3",
        {"effects": Effects(thermal=False)},
        (0.5, -10.1, 1.236, 490, 679, 44.6, 1.897),
        (0.5, 1.0, 1.052, 421, 628, 39.6, 2.010),
        7,
    ),
    (
        "7 -1",
        {HAND: "left", TAU: -1.0},
        (0.297, 20.5, 1.241, 306, 528, 29.1, 2.294),
        (0.703, -9.8, 1.305, 713, 814, 58.7, 1.639),
        -59,
    ),
    (
        "8 +1",
        {"effects": Effects(thermal=False), TAU: 1.0},
        (0.297, -3.4, 1.149, 284, 516, 29.5, 2.283),
        (0.703, -5.6, 1.110, 610, 757, 53.6, 1.725),
        46,
    ),
    (
        "9",
        {"mesh.distribution.modifications": CORRECTED},
        (0.5, -10.7, 1.057, 425, 626, 37.9, 2.050),
        (0.5, 1.3, 1.058, 425, 626, 37.9, 2.050),
        8,
    ),
    (
        "11",
        {"mesh.distribution.modifications": ground(17.0, 17.0)},
        (0.5, -10.2, 1.109, 444, 639, 39.2, 2.018),
        (0.5, 0.8, 1.070, 430, 628, 38.3, 2.041),
        7,
    ),
    (
        "12 mu 0.25 +1",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.25, TAU: 1.0},
        (0.162, -1.9, 1.264, 183, 406, 19.0, 2.655),
        (0.838, -7.4, 1.091, 712, 812, 58.7, 1.639),
        79,
    ),
    (
        "15",
        {"mesh.distribution.modifications": CORRECTED, "couplings.0.offset": (0.0, -400e-6)},
        (0.5, -3.9, 1.079, 432, 630, 38.6, 2.034),
        (0.5, -5.3, 1.122, 449, 643, 39.6, 2.010),
        2,
    ),
    (
        "18 +1",
        {"mesh.distribution.modifications": CORRECTED_TRAILING, HAND: "left", TAU: 1.0},
        (0.703, -5.2, 1.179, 649, 773, 54.0, 1.716),
        (0.297, 15.5, 1.325, 325, 545, 30.6, 2.250),
        50,
    ),
    (
        "20",
        {"mesh.distribution.modifications": CORRECTED, "mesh.distribution.load.pinion_torque": 11459.156 / 2},
        (0.5, -6.2, 1.133, 244, 470, 24.0, 2.465),
        (0.5, 1.4, 1.124, 241, 468, 23.8, 2.470),
        5,
    ),
    (
        "23",
        {"mesh.distribution.modifications": CORRECTED, "mesh.distribution.load.axial_force": 10e3},
        (0.400, -9.1, 1.072, 351, 568, 32.5, 2.194),
        (0.600, -0.3, 1.051, 501, 679, 43.3, 1.925),
        28,
    ),
    ("6", {HAND: "left"}, (0.500, 11.6, 1.058, 425, 626, 37.9, 2.051), (0.500, 0.1, 1.214, 482, 668, 42.1, 1.952), -12),
    (
        "7 +1",
        {HAND: "left", TAU: 1.0},
        (0.703, -5.4, 1.240, 679, 794, 56.3, 1.678),
        (0.297, 16.1, 1.094, 273, 499, 26.6, 2.376),
        50,
    ),
    (
        "8 -1",
        {"effects": Effects(thermal=False), TAU: -1.0},
        (0.703, -10.1, 1.174, 644, 778, 56.1, 1.682),
        (0.297, 1.0, 1.071, 266, 500, 28.1, 2.326),
        -39,
    ),
    (
        "10 +1",
        {"mesh.distribution.modifications": CORRECTED, TAU: 1.0},
        (0.297, -3.9, 1.133, 282, 506, 27.3, 2.351),
        (0.703, -5.4, 1.089, 601, 745, 50.5, 1.779),
        47,
    ),
    (
        "12 mu 0.05 -1",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.05, TAU: -1.0},
        (0.568, -8.3, 1.049, 475, 662, 41.4, 1.968),
        (0.432, -1.0, 1.078, 379, 589, 34.6, 2.137),
        -9,
    ),
    (
        "12 mu 0.05 +1",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.05, TAU: 1.0},
        (0.432, -6.1, 1.075, 378, 589, 34.5, 2.139),
        (0.568, -3.1, 1.084, 490, 672, 42.4, 1.944),
        18,
    ),
    (
        "12 mu 0.25 -1",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.25, TAU: -1.0},
        (0.838, -12.6, 1.039, 680, 793, 56.2, 1.679),
        (0.162, 3.3, 1.173, 173, 395, 17.8, 2.707),
        -70,
    ),
    (
        "13",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.05},
        (0.500, -8.4, 1.057, 425, 626, 37.8, 2.052),
        (0.500, -0.9, 1.067, 429, 628, 38.2, 2.044),
        5,
    ),
    (
        "14",
        {"mesh.distribution.modifications": CORRECTED, MU: 0.25},
        (0.500, -12.8, 1.066, 428, 628, 38.1, 2.045),
        (0.500, 3.1, 1.055, 425, 625, 37.8, 2.053),
        10,
    ),
    (
        "16",
        {
            "mesh.distribution.modifications": CORRECTED,
            "pinion_shaft.bearings.0.radial_clearance": 143e-6,
            "pinion_shaft.bearings.1.radial_clearance": 117e-6,
        },
        (0.500, -7.3, 1.059, 426, 626, 37.9, 2.051),
        (0.500, -2.1, 1.082, 434, 632, 38.5, 2.036),
        0,
    ),
    (
        "17",
        {"mesh.distribution.modifications": CORRECTED_TRAILING, HAND: "left"},
        (0.500, 11.7, 1.058, 425, 626, 37.9, 2.050),
        (0.500, -0.5, 1.059, 425, 626, 38.0, 2.049),
        -12,
    ),
    (
        "18 -1",
        {"mesh.distribution.modifications": CORRECTED_TRAILING, HAND: "left", TAU: -1.0},
        (0.297, 20.7, 1.170, 288, 514, 28.0, 2.327),
        (0.703, -10.4, 1.117, 616, 754, 51.6, 1.760),
        -59,
    ),
    (
        "21",
        {"mesh.distribution.modifications": CORRECTED, "mesh.distribution.load.pinion_torque": 11459.156 / 2, TAU: 1.0},
        (0.297, -0.7, 1.316, 176, 397, 18.3, 2.685),
        (0.703, -4.0, 1.148, 332, 551, 31.0, 2.237),
        29,
    ),
]


@pytest.mark.parametrize(("values", "first_helix", "second_helix", "shift"), first(2, [row[1:] for row in ROWS]))
def test_rows(
    values: dict[str, Any],
    first_helix: tuple[float, ...],
    second_helix: tuple[float, ...],
    shift: float | None,
) -> None:
    check(solved(values), first_helix, second_helix, shift)


def check(
    result: DriveTrainResult, first_helix: tuple[float, ...], second_helix: tuple[float, ...], shift: float | None
) -> None:
    assert result.axial is not None
    assert result.helices is not None
    for helix, (share, slope, factor, load, pressure, flash, safety) in zip(
        result.helices, (first_helix, second_helix), strict=True
    ):
        assert helix.share == pytest.approx(share, abs=6e-4)
        assert helix.misalignment.shaft_slope == pytest.approx(slope * 1e-6, abs=0.06e-6)
        assert helix.load.face_load_factor == pytest.approx(factor, abs=1.1e-3)
        assert helix.load.max_line_load == pytest.approx(load * 1e3, abs=0.9e3)
        assert helix.load.max_pressure == pytest.approx(pressure * 1e6, abs=0.9e6)
        assert helix.flash.flank == pytest.approx(flash, abs=2 * RELATIVE * flash + 0.05)  # one decimal
        assert safety_of(helix) == pytest.approx(safety, abs=RELATIVE * safety + 5e-4)  # printed with three decimals
    if shift is not None:
        assert result.axial.float == pytest.approx(shift * 1e-6, abs=0.6e-6)


@pytest.mark.ci
def test_row_19_rigid_bearings() -> None:
    inputs = double_helical(CORRECTED)
    shafts = [replace(shaft, bearings=rigid_bearings(shaft.bearings)) for shaft in inputs.shafts]
    check(
        solve(replace(inputs, pinion_shaft=shafts[0], wheel_shaft=shafts[1])),
        (0.5, -7.1, 1.059, 427, 626, 37.9, 2.050),
        (0.5, -2.2, 1.084, 435, 632, 38.5, 2.035),
        4,
    )


@pytest.mark.ci
def test_row_22_cold() -> None:
    check(
        solve(cold(double_helical(CORRECTED))),
        (0.5, -11.0, 1.167, 464, 658, 42.8, 1.937),
        (0.5, 0.9, 1.165, 464, 658, 42.7, 1.938),
        8,
    )


def test_a_tilted_hub_holds_nothing_and_the_runout_little() -> None:
    """Tilts near 1 mrad against 0.0134 mrad; 10 um of runout make 0.036 of the friction limit."""
    result = solved({"arrangement.apex_runout": 10e-6})
    assert result.axial is not None
    assert result.couplings[0].held_thrust_fraction == 0.0
    assert result.axial.runout_thrust_fraction == pytest.approx(0.036, abs=1e-3)
