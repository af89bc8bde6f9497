"""From the inputs of a user, the heat balance computes flow, windage, calibration, band and warnings."""

from dataclasses import replace
from itertools import product
from math import cos, pi, radians
from typing import Any

import numpy as np
import pytest

from solvers.heat_balance import Cooling, GearGeometry, HeatBalanceInputs, backlash_loss, cooling_oil, solve
from solvers.heat_balance.inputs import Casing, Measured
from solvers.heat_balance.losses import MeshHeat, share_to_pinion, ts_6336_22_bulk_rise
from solvers.lubricants import Lubricant
from solvers.oils import iso_vg
from tests.support.changes import changed
from tests.support.heat_networks import (
    CELSIUS,
    FLOW,
    JOURNALS,
    MESH,
    MODULE,
    OIL,
    PUMPING,
    RADII,
    SPEED,
    TEETH,
    WHEEL_SPEED,
    WIDTH,
)
from tests.support.outcomes import assert_finite, codes, refused


def geometry(gear: int, shaft: float = 0.0) -> GearGeometry:
    speed = (SPEED, WHEEL_SPEED)[gear]
    tip = RADII[gear] + MODULE
    return GearGeometry(TEETH[gear], WIDTH, MODULE, RADII[gear], tip, speed, shaft_radii=(shaft, shaft))


PAIR = HeatBalanceInputs(Cooling(gear_flow=FLOW), OIL, (geometry(0), geometry(1)), MESH, centre_distance=0.517387)
UNIT = replace(PAIR, gears=(geometry(0, 0.095), geometry(1, 0.13)), pumping=PUMPING, journals=JOURNALS)


def with_cooling(inputs: HeatBalanceInputs, **values: Any) -> HeatBalanceInputs:
    return replace(inputs, cooling=replace(inputs.cooling, **values))


def measured(inputs: HeatBalanceInputs, **celsius: float) -> HeatBalanceInputs:
    return with_cooling(inputs, measured=Measured(**{name: value + CELSIUS for name, value in celsius.items()}))


def at_velocity(velocity: float) -> HeatBalanceInputs:
    """Return the pair at a pitch-line velocity [m/s]."""
    slower = velocity / (SPEED * RADII[0])
    return replace(PAIR, gears=tuple(replace(one, speed=one.speed * slower) for one in PAIR.gears))


# Worked example, from geometry on


def test_the_unit_as_a_user_gives_it() -> None:
    heat = solve(UNIT)
    assert heat.gear_flow * 6e4 == pytest.approx(140.08, abs=0.01)
    assert heat.losses.windage == pytest.approx(14622, abs=1)
    gears = [heat.pinion.flank, heat.pinion.body, heat.wheel.flank, heat.wheel.body, heat.mist]
    assert np.array(gears) - CELSIUS == pytest.approx((78.81, 73.26, 75.37, 73.09, 69.92), abs=0.1)
    assert heat.drain - CELSIUS == pytest.approx(75.36, abs=0.05)
    assert heat.total_flow * 6e4 == pytest.approx(249, abs=0.5)
    assert heat.balance.supplied == pytest.approx(178667, abs=20)
    assert abs(heat.balance.error) < 1e-9
    assert heat.losses.total == pytest.approx(heat.balance.supplied)
    assert heat.losses.mesh == pytest.approx(36.0e3, abs=50)
    assert heat.losses.oil_acceleration == pytest.approx(13.0e3, abs=50)
    assert heat.losses.jets == pytest.approx(850.0 * FLOW * 20.0**2 / 2)
    assert_finite(heat)


def test_the_flow_is_sized_by_formulas_alone() -> None:
    """Heat that the user adds does not order more oil; the flow takes the mesh by its formula and Mauz's windage."""
    sized = with_cooling(PAIR, gear_flow=None)
    own = solve(sized)
    assert own.gear_flow == pytest.approx((MESH.power + own.losses.windage) / (OIL.heat_capacity * 20.0))
    for more in (
        with_cooling(sized, pumping=20e3),
        with_cooling(sized, windage=60e3),
        with_cooling(sized, other=50e3),
        replace(sized, mesh=replace(MESH, power=2 * MESH.power, by_formula=MESH.power)),
    ):
        hotter = solve(more)
        assert hotter.gear_flow == own.gear_flow
        assert hotter.pinion.flank > own.pinion.flank
        assert hotter.wheel.flank > own.wheel.flank


def test_flows_add_up_to_losses_and_drains() -> None:
    heat = solve(UNIT)
    supplied = sum(flow.power for flow in heat.flows if flow.from_ == "source")
    removed = sum(flow.power for flow in heat.flows if flow.to in {"oil", "ambient"})
    assert supplied == pytest.approx(heat.balance.supplied, rel=1e-12)
    assert removed == pytest.approx(supplied, rel=1e-9)
    assert heat.pinion.friction + heat.wheel.friction == pytest.approx(heat.losses.mesh)
    assert heat.pinion.friction == pytest.approx(0.49 * heat.losses.mesh)


def test_estimate_of_ts_6336_22() -> None:
    assert ts_6336_22_bulk_rise(36978.0, 0.517387, 0.2, 1.2) == pytest.approx(24.4, abs=0.05)
    assert solve(PAIR).estimates.iso_ts_6336_22_bulk - CELSIUS == pytest.approx(74.4, abs=0.05)


# Band


def test_band_of_the_worked_example() -> None:
    band = solve(UNIT).band
    assert np.array(band.pinion_flank) - CELSIUS == pytest.approx((68.6, 114.9), abs=0.1)
    assert np.array(band.wheel_flank) - CELSIUS == pytest.approx((67.9, 95.5), abs=0.1)


def test_what_is_given_is_not_varied() -> None:
    plain, given = solve(PAIR).band, solve(with_cooling(PAIR, wetting_share=0.5)).band
    assert given.pinion_flank[0] > plain.pinion_flank[0]
    assert given.pinion_flank[1] < plain.pinion_flank[1]
    known = with_cooling(PAIR, wetting_share=0.5, fling_off_factor=1.0, rewetting_share=0.0)
    assert solve(known).band is not None  # the windage is left
    heat = solve(with_cooling(known, windage=14622.0))
    assert heat.band is None
    assert "no_band" in codes(heat)


def test_the_band_is_that_of_all_corners() -> None:
    """Least and greatest over wetting share, fling-off factor, rewetting share and windage, each solved by itself."""
    nominal = solve(PAIR)
    corners = product((0.2, 1.0), (0.7, 1.5), (0.0, 0.5), (0.7, 3.0))
    cases = [nominal] + [
        solve(
            with_cooling(
                PAIR,
                wetting_share=share,
                fling_off_factor=factor,
                rewetting_share=again,
                windage=times * nominal.losses.windage,
            )
        )
        for share, factor, again, times in corners
    ]
    pinions = [case.pinion.flank for case in cases]
    assert nominal.band.pinion_flank == pytest.approx((min(pinions), max(pinions)), abs=1e-4)


def test_jets_out_of_the_mesh_have_the_band_of_both_directions() -> None:
    out, into = (solve(with_cooling(PAIR, jets=jets)).band for jets in ("out_of_mesh", "into_mesh"))
    assert out.wheel_flank[0] <= into.wheel_flank[0]
    assert out.wheel_flank[1] >= into.wheel_flank[1]


def test_band_encloses_the_nominal() -> None:
    random = np.random.default_rng(3)
    for _ in range(30):
        cooling = Cooling(
            gear_flow=random.uniform(40, 400) / 6e4,
            jets=random.choice(["into_mesh", "out_of_mesh"]),
            wetting_share=random.choice([None, random.uniform(0.05, 1.0)]),
            fling_off_factor=random.choice([None, random.uniform(0.5, 3.0)]),
            rewetting_share=random.choice([None, random.uniform(0.0, 1.0)]),
            mist_convection_factor=random.uniform(0.5, 10.0),
        )
        heat = solve(replace(PAIR, cooling=cooling))
        assert heat.band.pinion_flank[0] <= heat.pinion.flank <= heat.band.pinion_flank[1]
        assert heat.band.wheel_flank[0] <= heat.wheel.flank <= heat.band.wheel_flank[1]
        assert min(case[0] for case in heat.flank_cases) == heat.band.pinion_flank[0]


def test_without_band() -> None:
    heat = solve(with_cooling(PAIR, band=False))
    assert heat.band is None
    assert heat.flank_cases == ((heat.pinion.flank, heat.wheel.flank),)


def test_an_end_of_the_band_without_equilibrium_leaves_the_nominal() -> None:
    hot = replace(PAIR, mesh=replace(MESH, power=90e3))
    heat = solve(with_cooling(hot, gear_flow=25 / 6e4))
    assert heat.band is None
    assert "band_unsolved" in codes(heat)


# Calibration


@pytest.mark.parametrize(("flank", "share", "wheel"), [(85, 0.355, 79.3), (95, 0.238, 84.0), (105, 0.172, 87.8)])
def test_a_measured_flank_fixes_the_wetting_share(flank: float, share: float, wheel: float) -> None:
    heat = solve(measured(with_cooling(UNIT, band=False), pinion_flank=flank))
    assert heat.wetting_share == pytest.approx(share, abs=6e-4)
    assert heat.pinion.flank - CELSIUS == pytest.approx(flank, abs=1e-4)
    assert heat.wheel.flank - CELSIUS == pytest.approx(wheel, abs=0.06)


@pytest.mark.parametrize("node", ["pinion_flank", "pinion_body", "wheel_flank", "wheel_body"])
def test_calibration_meets_every_node(node: str) -> None:
    heat = solve(measured(PAIR, **{node: 77.0}))
    gear, part = node.split("_")
    assert getattr(getattr(heat, gear), part) - CELSIUS == pytest.approx(77.0, abs=1e-4)


def test_band_with_a_measured_flank() -> None:
    heat = solve(measured(PAIR, pinion_flank=85))
    assert np.array(heat.band.pinion_flank) - CELSIUS == pytest.approx((82.0, 88.0), abs=0.1)
    assert heat.band.wheel_flank[0] <= heat.wheel.flank <= heat.band.wheel_flank[1]
    width = heat.band.wheel_flank[1] - heat.band.wheel_flank[0]
    plain = solve(PAIR).band.wheel_flank
    assert width < plain[1] - plain[0]
    assert "not_validated" not in codes(heat)


def test_a_measured_drain_fixes_the_other_losses() -> None:
    unit = with_cooling(UNIT, band=False)
    heat = solve(measured(unit, drain=78.0))
    assert heat.drain - CELSIUS == pytest.approx(78.0, abs=1e-4)
    assert heat.losses.other > 0.0
    cold, unmeasured = solve(measured(unit, drain=72.0)), solve(unit)
    assert cold.losses.other == 0.0
    assert (cold.pinion, cold.drain) == (unmeasured.pinion, unmeasured.drain)
    assert cold.drain_deviation == pytest.approx(cold.drain - CELSIUS - 72.0)
    assert "losses_overestimated" in codes(cold)


def test_a_measurement_that_needs_hardly_any_oil_is_doubted() -> None:
    heat = solve(measured(with_cooling(PAIR, band=False), pinion_flank=125.0))
    assert heat.wetting_share < 0.1
    assert "measured_contradiction" in codes(heat)


def test_a_measured_temperature_in_fahrenheit_is_asked_about() -> None:
    told = [each.message for each in solve(measured(PAIR, drain=158.0)).warnings if each.code == "unusual_value"]
    assert any("Fahrenheit" in message for message in told)


def test_flank_and_drain_together() -> None:
    heat = solve(measured(with_cooling(UNIT, band=False), pinion_flank=85.0, drain=77.0))
    assert heat.pinion.flank - CELSIUS == pytest.approx(85.0, abs=1e-3)
    assert heat.drain - CELSIUS == pytest.approx(77.0, abs=1e-4)


def test_both_gears_measured_tell_the_deviation_of_the_wheel() -> None:
    heat = solve(measured(PAIR, pinion_flank=85.0, wheel_body=70.0))
    assert heat.pinion.flank - CELSIUS == pytest.approx(85.0, abs=1e-4)
    assert heat.wheel_deviation == pytest.approx(heat.wheel.body - CELSIUS - 70.0)
    assert "measured_contradiction" not in codes(heat)
    contradicted = solve(measured(PAIR, pinion_flank=85.0, wheel_body=110.0))
    (told,) = [each for each in contradicted.warnings if each.code == "measured_contradiction"]
    assert f"{abs(contradicted.wheel_deviation):.3g} K" in told.message
    assert solve(PAIR).wheel_deviation is None


REFUSED = {
    "unreachable flank": (measured(PAIR, pinion_flank=55.0), "measured_unreachable", "pinion_flank"),
    "cold drain": (measured(PAIR, drain=50.0), "measured_unreachable", "drain"),
    "flank and body": (measured(PAIR, wheel_flank=80.0, wheel_body=75.0), "exclusive", "wheel_body"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused_measurements(name: str) -> None:
    inputs, code, field = REFUSED[name]
    assert refused(solve, inputs) == (code, f"cooling.measured.{field}")


def test_what_a_measurement_fixes_is_not_given_too() -> None:
    flank = with_cooling(measured(PAIR, pinion_flank=85.0), wetting_share=0.4)
    assert refused(solve, flank) == ("exclusive", "cooling.wetting_share")
    drain = with_cooling(measured(PAIR, drain=75.0), other=100.0)
    assert refused(solve, drain) == ("exclusive", "cooling.other")


# Casing and backlash


def test_backlash_lost_against_the_casing() -> None:
    cased = with_cooling(UNIT, casing=Casing(area=6.0))
    heat = backlash_loss(solve(cased), (0.119, 0.398), radians(20.0), 12e-6)
    growth = 0.119 * (heat.pinion.body - heat.casing) + 0.398 * (heat.wheel.body - heat.casing)
    assert heat.backlash_loss == pytest.approx(2 * np.tan(radians(20.0)) * 12e-6 * growth)
    assert backlash_loss(solve(UNIT), (0.119, 0.398), radians(20.0), 12e-6).backlash_loss is None


# Warnings


def test_warnings() -> None:
    assert codes(solve(with_cooling(PAIR, gear_flow=300 / 6e4))) == {"not_validated"}
    slow = tuple(replace(one, speed=one.speed / 4) for one in PAIR.gears)
    assert "low_speed" in codes(solve(replace(PAIR, gears=slow)))
    assert {"low_speed", "not_validated"} & codes(solve(at_velocity(45.0))) == set()
    assert "not_validated" not in codes(solve(replace(PAIR, gears=slow)))
    assert "not_validated" in codes(solve(at_velocity(51.0)))
    assert "oil_limited" in codes(solve(with_cooling(PAIR, wetting_share=0.2)))
    thin = changed(OIL, {"viscosity": lambda _: 1e-3})
    assert "turbulent_film" in codes(solve(with_cooling(replace(UNIT, oil=thin), band=False)))


def test_unusual_flows() -> None:
    assert "unusual_value" in codes(solve(with_cooling(PAIR, gear_flow=3000 / 6e4)))
    assert "unusual_value" in codes(solve(with_cooling(PAIR, gear_flow=20 / 6e4)))
    assert "unusual_value" not in codes(solve(with_cooling(PAIR, gear_flow=140 / 6e4)))
    assert refused(solve, with_cooling(PAIR, gear_flow=1.0)) == ("out_of_range", "cooling.gear_flow")


# Oils


def test_oil_of_the_other_models() -> None:
    sheet = cooling_oil(iso_vg(46), 50.0 + CELSIUS)
    assert sheet.viscosity(40.0 + CELSIUS) == pytest.approx(46e-6 * iso_vg(46).density(40.0 + CELSIUS))
    assert sheet.density == pytest.approx(iso_vg(46).density(50.0 + CELSIUS))
    plain = cooling_oil(Lubricant(compressible=False), 50.0 + CELSIUS)
    assert plain.density == pytest.approx(870.0)
    assert plain.viscosity(360.0) == pytest.approx(0.08)
    assert np.isfinite(solve(replace(PAIR, oil=sheet)).pinion.flank)


# Losses


def test_share_of_the_friction() -> None:
    position = np.linspace(0.0, 1.0, 101)
    heat, one, two = np.ones(101), 1.0 + position, 2.0 - position
    assert share_to_pinion(heat, one, two, position) == pytest.approx(0.5)
    assert share_to_pinion(heat, 4.0 * np.ones(101), np.ones(101), position) == pytest.approx(2 / 3)
    assert share_to_pinion(heat, np.ones(101), np.ones(101), position, 3.0) == pytest.approx(0.25)
    assert share_to_pinion(0.0 * heat, one, two, position) == 0.5


def test_friction_follows_the_oil() -> None:
    assert MESH.at(OIL, MESH.temperature) == pytest.approx(MESH.power)
    ratio = OIL.viscosity(350.0) / OIL.viscosity(MESH.temperature)
    assert MESH.at(OIL, 350.0) == pytest.approx(MESH.power * ratio**-0.05)
    assert MeshHeat(100.0, 300.0, 0.5, 0.0).at(OIL, 400.0) == 100.0


def test_geometry_of_the_example() -> None:
    assert pytest.approx(MODULE / cos(radians(11.5)) * 39 / 2) == RADII[0]
    assert geometry(0, 0.095).face_area == pytest.approx(2 * pi * ((RADII[0] + MODULE) ** 2 - 0.095**2))
