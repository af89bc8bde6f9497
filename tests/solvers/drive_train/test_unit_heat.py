"""The heat balance of a unit with bearings and alignment is checked on the worked unit and on random units."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import strategies as st

from solvers.drive_train import outcome as outcomes
from solvers.drive_train import solve
from solvers.drive_train.inputs import DriveTrainInputs, RigidBearing
from solvers.drive_train.results import DriveTrainResult
from solvers.drive_train.unit_heat import warm_unit
from solvers.drive_train.warm_up import _least_safety
from solvers.errors import NoSolution
from solvers.gears.inputs import GearTeeth
from solvers.heat_balance import Cooling
from solvers.heat_balance.inputs import Casing, Measured
from tests.support.drive_trains import CELSIUS, GROUND, turbo_gear
from tests.support.heated_units import balanced, cooled_units
from tests.support.outcomes import codes
from tests.support.properties import examples
from tests.support.random_units import mirrored, reversed_ends, rotated

FLOW = 140.08 / 6e4


TURBO = replace(balanced(turbo_gear(GROUND), Cooling(gear_flow=FLOW, band=False)), face_heat="uniform")


@cache
def turbo() -> DriveTrainResult:
    return solve(TURBO)


def temperatures(result: DriveTrainResult) -> np.ndarray:
    heat = result.heat
    assert heat is not None
    gears = [heat.pinion.flank, heat.pinion.body, heat.wheel.flank, heat.wheel.body, heat.mist]
    return np.array([*gears, *(bearing.outlet for bearing in heat.bearings)]) - CELSIUS


def test_the_worked_unit_with_its_own_losses_and_loads() -> None:
    """The temperatures differ by at most 1.3 K from those of the same network with prescribed losses and loads."""
    # The unit computes its losses and loads itself.
    found = turbo()
    heat = found.heat
    assert heat is not None
    wanted = (78.80, 73.24, 75.34, 73.05, 69.82, 89.89, 88.25, 70.37, 71.30)
    assert temperatures(found) == pytest.approx(wanted, abs=1.3)
    assert heat.losses.pumping == pytest.approx(6904 + 7844, rel=1e-3)
    assert heat.losses.windage == pytest.approx(14622, abs=1)
    assert heat.balance.error == pytest.approx(0.0, abs=1e-9)
    assert found.load.face_load_factor == pytest.approx(1.079, abs=0.006)
    assert found.safety is not None
    assert found.safety.minimum == pytest.approx(2.14, abs=0.02)
    assert found.losses.bearings == pytest.approx(99.9e3, rel=0.025)
    assert found.losses.mesh == heat.losses.mesh
    assert found.losses.oil_acceleration == max(heat.losses.oil_acceleration, 0.0)
    parts = (found.losses.coupling, found.losses.pumping, heat.losses.mesh, found.losses.bearings)
    assert found.losses.total == pytest.approx(sum(parts) + heat.losses.windage + heat.losses.oil_acceleration)


def test_the_answer_is_the_unit_at_the_temperatures_of_the_balance() -> None:
    found, warm = turbo(), warm_unit(TURBO)
    heat = found.heat
    assert heat is not None
    bodies = warm.inputs.heat
    assert (bodies.pinion_bulk, bodies.wheel_bulk) == pytest.approx((heat.pinion.body, heat.wheel.body), abs=0.05)
    assert bodies.bulk_includes_pumping
    given = solve(
        replace(
            warm.inputs,
            mesh=replace(
                warm.inputs.mesh,
                temperatures=replace(warm.inputs.mesh.temperatures, bulk_method="given"),
                cooling=Cooling(),
            ),
        )
    )
    assert given.heat is None
    assert given.losses.windage is None
    assert given.safety is not None
    assert found.safety is not None
    assert given.safety.minimum == pytest.approx(found.safety.minimum, rel=1e-3)
    for bearing, film in zip(found.shafts[0].bearings, heat.bearings, strict=False):
        assert bearing.friction_power == pytest.approx(film.friction_power, rel=2e-3)


def test_one_measured_temperature_and_the_drain() -> None:
    measured = Measured(pinion_body=80 + CELSIUS, drain=80 + CELSIUS)
    heat = solve(balanced(turbo_gear(GROUND), Cooling(gear_flow=FLOW, measured=measured, band=False))).heat
    assert heat is not None
    assert heat.pinion.body - CELSIUS == pytest.approx(80.0, abs=1e-3)
    assert heat.drain - CELSIUS == pytest.approx(80.0, abs=1e-3)
    assert heat.wetting_share < 0.5


def test_the_casing_takes_heat_lifts_the_supports_and_leaves_less_backlash() -> None:
    heat = solve(balanced(turbo_gear(GROUND), Cooling(gear_flow=FLOW, casing=Casing(area=6.0), band=False))).heat
    assert heat is not None
    assert heat.casing is not None
    assert heat.backlash_loss is not None
    assert heat.backlash_loss > 0.0
    assert any(flow.to == "ambient" for flow in heat.flows)


def test_bearings_that_are_no_plain_ones_have_no_node() -> None:
    rigid = tuple(RigidBearing(bearing.position) for bearing in TURBO.wheel_shaft.bearings)
    heat = solve(replace(TURBO, wheel_shaft=replace(TURBO.wheel_shaft, bearings=rigid))).heat
    assert heat is not None
    assert len(heat.bearings) == 2
    assert heat.balance.error == pytest.approx(0.0, abs=1e-9)


def test_an_increaser_is_balanced_too() -> None:
    """The larger gear drives and turns slowly, and the smaller gear turns fast."""
    # Flank temperatures are those of the reducing unit with exchanged gears, within 1.5 K.
    mesh = TURBO.mesh.distribution
    gears = replace(mesh.gears, pinion=GearTeeth(130), wheel=GearTeeth(39))
    load = replace(mesh.load, pinion_torque=mesh.load.torque * 130 / 39, pinion_speed=mesh.load.pinion_speed * 39 / 130)
    found = solve(
        replace(
            TURBO,
            mesh=replace(TURBO.mesh, distribution=replace(mesh, gears=gears, load=load)),
            pumping=replace(TURBO.pumping, gears=replace(TURBO.pumping.gears, pinion=gears.pinion, wheel=gears.wheel)),
            pinion_shaft=TURBO.wheel_shaft,
            wheel_shaft=TURBO.pinion_shaft,
            couplings=(replace(TURBO.couplings[0], shaft="wheel"),),
        )
    )
    heat = found.heat
    assert heat is not None
    assert (heat.wheel.flank, heat.pinion.flank) == pytest.approx(
        (temperatures(turbo())[0] + CELSIUS, temperatures(turbo())[2] + CELSIUS), abs=1.5
    )
    assert heat.balance.error == pytest.approx(0.0, abs=1e-9)


def outcome(inputs: DriveTrainInputs) -> DriveTrainResult | NoSolution:
    try:
        return solve(inputs)
    except NoSolution as failure:
        return failure


def check(inputs: DriveTrainInputs) -> None:
    """Check the balance and the band of a unit; if there is no solution, check that the error has a known code."""
    found = outcome(inputs)
    if isinstance(found, NoSolution):
        assert found.code in {"heat_balance", "thermal_runaway", "journal", "drive_train"}
        assert found.residuals
        return
    heat = found.heat
    assert heat is not None
    assert abs(heat.balance.error) <= 1e-9
    if heat.band is None:
        assert "band_unsolved" in codes(found)
        return
    for flank, (low, high) in (
        (heat.pinion.flank, heat.band.pinion_flank),
        (heat.wheel.flank, heat.band.wheel_flank),
    ):
        assert low <= flank <= high
    if heat.band.safety is not None:
        assert found.safety is not None
        low, high = heat.band.safety
        assert low * (1 - 1e-12) <= found.safety.minimum <= high * (1 + 1e-12)


@examples(3, 200, cooled_units())
def test_random_units(inputs: DriveTrainInputs) -> None:
    check(inputs)


@examples(2, 40, cooled_units(), st.floats(-3.0, 3.0))
def test_units_that_are_turned_and_mirrored(inputs: DriveTrainInputs, angle: float) -> None:
    one = temperatures(solve(inputs))
    for image in (rotated(inputs, angle), mirrored(inputs)):
        assert temperatures(solve(image)) == pytest.approx(one, rel=1e-9)
    gears = temperatures(solve(reversed_ends(inputs)))[:5]  # bearings change their order
    assert gears == pytest.approx(one[:5], rel=1e-9)


def test_a_time_as_cool_as_the_oil_is_not_the_least_safe() -> None:
    """Without a hot place the safety has no bound; only an undefined temperature leaves the least unknown."""
    warm = outcomes.outcome(TURBO)
    assert warm.safety is not None
    cool = replace(warm, safety=None)
    undefined = replace(cool, temperature=np.full_like(cool.temperature, np.nan))
    assert _least_safety([cool, warm, replace(warm, safety=2 * warm.safety)]) == warm.safety
    assert _least_safety([cool, cool]) is None
    assert _least_safety([warm, undefined]) is None
