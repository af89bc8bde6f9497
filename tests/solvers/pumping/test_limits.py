"""Pumping refuses inputs that cannot be solved, and warns of inputs outside the range of its models."""

import re
from dataclasses import replace
from functools import partial
from math import pi

import numpy as np
import pytest

from benchmarks.published.milian import CASE_1, TABLE_1
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.pumping import (
    Ambient,
    ChokingInputs,
    Closure,
    Flow,
    Gap,
    Groove,
    PumpingInputs,
    PumpingModel,
    PumpingResult,
    PumpingSetup,
    Spaces,
)
from solvers.pumping import verdict as pumping_verdict
from solvers.pumping.choking import choking_speeds
from solvers.pumping.model import solve
from solvers.pumping.spaces import flow_at
from solvers.pumping.speed_scan import speed_scan
from tests.support.changes import changed
from tests.support.outcomes import assert_finite, codes, refused, unsolved
from tests.support.stored import stored

PLAIN = PumpingSetup(CASE_1, model=PumpingModel(slices=20, spaces=Spaces.PINION))


def gears(**changes: object) -> PumpingSetup:
    return replace(PLAIN, gears=replace(CASE_1, **changes))


def pinion(**changes: object) -> PumpingSetup:
    return gears(pinion=replace(CASE_1.pinion, **changes))


def model(**changes: object) -> PumpingSetup:
    return replace(PLAIN, model=replace(PLAIN.model, **changes))


def spur(flow: Flow = Flow.INCOMPRESSIBLE, **changes: object) -> PumpingSetup:
    return replace(PLAIN, gears=TABLE_1, model=replace(PLAIN.model, flow=flow, slices=None), **changes)


REFUSED: list[tuple[str, PumpingSetup, str | None]] = [
    ("flank_interference", gears(centre_distance=0.5899), "centre_distance"),
    ("no_tip_clearance", pinion(dedendum=0.7), "pinion.dedendum"),
    ("no_mesh", gears(centre_distance=0.61), "centre_distance"),
    ("no_involute", pinion(addendum=-2.0), None),
    ("pointed_rack", pinion(dedendum=2.4), "pinion.dedendum"),
    ("pointed_tooth", replace(PLAIN, normal_backlash=6e-3), "normal_backlash"),
    ("too_few_teeth", pinion(teeth=4), "pinion.teeth"),
    ("groove_outside", replace(PLAIN, grooves=(Groove(0.1, 0.25),)), "grooves.0.position"),
    ("groove_outside", replace(PLAIN, grooves=(Groove(0.05, 0.1), Groove(0.15, 0.1))), "grooves"),
    ("groove_outside", replace(PLAIN, grooves=(Groove(0.05, 0.01), Groove(0.196, 0.01))), "grooves.1.position"),
    ("groove_overlap", replace(PLAIN, grooves=(Groove(0.1, 0.02), Groove(0.085, 0.02))), "grooves.0.position"),
    ("too_few_slices", model(slices=3), "slices"),
    ("discharge_coefficient", model(discharge_coefficient=1.2), "discharge_coefficient"),
    ("isentropic_exponent", replace(PLAIN, ambient=Ambient(isentropic_exponent=1.0)), "isentropic_exponent"),
    ("negative_backlash", replace(PLAIN, normal_backlash=-1e-5), "normal_backlash"),
    ("face_width", gears(face_width=0.0), "face_width"),
    ("helix_incompressible", model(flow=Flow.INCOMPRESSIBLE), "helix_angle"),
    ("grooves_incompressible", spur(grooves=(Groove(0.1, 0.01),)), "grooves"),
    ("too_many_steps", model(slices=2000), "pinion_speed"),
]


def solved(setup: PumpingSetup, speed: float = 9267.0) -> PumpingResult:
    return solve(PumpingInputs(setup, speed * pi / 30))


@pytest.mark.parametrize(("code", "setup", "field"), REFUSED, ids=lambda value: value if isinstance(value, str) else "")
def test_refused(code: str, setup: PumpingSetup, field: str | None) -> None:
    found, named = refused(solved, setup)
    assert found == code
    assert field is None or named == field


def test_centre_distance_may_be_backlash_free_to_rounding() -> None:
    assert solved(gears(centre_distance=0.589968476818106 * (1 - 5e-10))).geometry.normal_backlash > 0


SHORTENED = {
    "past the base circle": GearPairInputs(
        GearTeeth(14, 0.0, 1.0, 1.4), GearTeeth(90, 0.0, 1.25, 1.4), 5e-3, 0.1, rack_tip_radius=GROUND_FILLET
    ),
    "into the fillet": GearPairInputs(
        GearTeeth(30, 0.0, 1.0, 1.15), GearTeeth(90, 0.0, 1.1, 1.25), 5e-3, 0.1, rack_tip_radius=0.38
    ),
}


@pytest.mark.parametrize("pair", SHORTENED.values(), ids=SHORTENED)
def test_tips_that_reach_below_an_involute_shorten_the_path(pair: GearPairInputs) -> None:
    result = solved(PumpingSetup(pair, 0.1e-3, model=PumpingModel(slices=20)))
    path = meshing_path(pair)
    assert "path_shortened" in codes(result)
    assert result.geometry.transverse_contact_ratio == path.transverse_contact_ratio
    stroke, base = result.pinion_spaces.stroke, path.pair.pinion.base_radius
    assert (stroke.contact_end - stroke.contact_start) * base == pytest.approx(path.length, rel=1e-12)


def test_jumping_feet_of_tip_gaps_are_named() -> None:
    teeth = GearTeeth(19, 0.0, 0.7, 0.85), GearTeeth(25, 0.0, 0.7, 0.85)
    gears = GearPairInputs(*teeth, 1e-3, 0.01, pressure_angle=0.2967, rack_tip_radius=0.1)
    with pytest.raises(InvalidInput, match="deg") as refusal:
        solved(PumpingSetup(gears, normal_backlash=0.0, model=PumpingModel(gap=Gap.TIP, slices=10)))
    assert refusal.value.code == "tooth_space_minima"


@pytest.mark.parametrize("speed", [0.0, -100.0, 5e-312])
def test_no_speed(speed: float) -> None:
    assert refused(solved, PLAIN, speed) == ("speed_not_positive", "pinion_speed")


def test_slow_speed_is_refused_with_what_would_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pumping_verdict, "flow_at", partial(flow_at, cell_step_limit=30_000))
    setup = replace(PLAIN, model=PumpingModel(spaces=Spaces.PINION))
    with pytest.raises(InvalidInput) as refusal:
        solved(setup, 2000.0)
    assert refusal.value.code == "too_many_steps"
    found = re.search(r"at least ([\d.e+]+) rpm, use at most (\d+) slices", refusal.value.message)
    speed, slices = float(found.group(1)), int(found.group(2))
    assert solved(changed(setup, {"model.slices": slices}), 2000.0).slices == slices
    assert solved(setup, 1.01 * speed).slices == 100
    with pytest.raises(InvalidInput):
        solved(setup, 0.97 * speed)


def test_incompressible_vacuum_is_refused_with_the_speed_that_fits() -> None:
    with pytest.raises(InvalidInput) as refusal:
        solved(spur(), 60000.0)
    assert refusal.value.code == "incompressible_vacuum"
    assert refusal.value.field == "pinion_speed"
    found = re.search(r"below ([\d.]+) rpm", refusal.value.message)
    result = solved(spur(), 0.999 * float(found.group(1))).pinion_spaces
    assert 0 < result.min_pressure_ratio < 0.01


@pytest.mark.parametrize(
    ("setup", "speed", "code"),
    [(spur(), 10000.0, "incompressible_mach"), (model(flow=Flow.POCKET_CHAIN), 5.0, "pressure_not_resolved")],
)
def test_flow_outside_its_model_is_warned_of(setup: PumpingSetup, speed: float, code: str) -> None:
    assert code in codes(solved(setup, speed))
    assert code not in codes(solved(setup, 1000.0))


def test_a_chain_that_does_not_converge_says_by_how_much() -> None:
    chain = model(flow=Flow.POCKET_CHAIN, closure=Closure.ISENTROPIC, discharge_coefficient=0.7)
    failure = unsolved(solved, chain, 1e-9)
    assert failure.code == "newton_not_converged"
    assert 1e-10 < failure.residuals["content_error"] < 1e9


def test_a_chain_whose_flow_turns_round_takes_finer_steps() -> None:
    (inputs,) = stored(PumpingInputs, "pumping", "chain whose flow turns round")
    result = solve(inputs).pinion_spaces
    assert result.steps > 2000
    assert result.peak_pressure_ratio == pytest.approx(1.037, abs=0.002)


def test_incompressible_cannot_choke() -> None:
    assert refused(choking_speeds, ChokingInputs(spur(), 1000.0))[0] == "choking_not_modelled"


def test_spaces_that_nothing_lets_out_choke_at_every_speed() -> None:
    # the search once went down without end
    sealed = replace(PLAIN, model=PumpingModel(flow=Flow.POCKET_CHAIN, slices=10, discharge_coefficient=0.0))
    assert refused(choking_speeds, ChokingInputs(sealed, 6000.0))[0] == "always_choked"


def other(pinion: GearTeeth, wheel: GearTeeth) -> PumpingSetup:
    return replace(
        PLAIN, gears=GearPairInputs(pinion, wheel, 5e-3, 0.05, helix_angle=0.2, rack_tip_radius=GROUND_FILLET)
    )


WARNED: list[tuple[PumpingSetup, set[str]]] = [
    (PLAIN, set()),
    (spur(Flow.GAS_DYNAMICS), {"spur_gear"}),
    (spur(), {"spur_gear", "no_temperature", "no_lead_correction", "incompressible_mach"}),
    (model(slices=12), {"few_slices"}),
    (model(flow=Flow.POCKET_CHAIN, slices=1), {"single_slice"}),
    (model(flow=Flow.POCKET_CHAIN, closure=Closure.ISENTROPIC), {"no_energy_balance"}),
    (model(spaces=Spaces.WHEEL), {"no_lead_correction"}),
    (other(GearTeeth(11, 0.5, 0.9), GearTeeth(60)), {"few_teeth"}),
    (other(GearTeeth(30, 0, 0.5, 1), GearTeeth(60, 0, 0.5, 1)), {"contact_ratio_below_one"}),
    (other(GearTeeth(15, -0.1), GearTeeth(60, 0.1, 0.8)), {"undercut"}),
]


OF_20_SLICES = {"not_resolved", "net_flow_uncertain"}


@pytest.mark.parametrize(("setup", "expected"), WARNED)
def test_warned(setup: PumpingSetup, expected: set[str]) -> None:
    assert codes(solved(setup, 3000.0)) - OF_20_SLICES == expected


def test_few_slices_and_speed_beyond_every_check_are_warned_of() -> None:
    assert codes(solved(PLAIN, 3000.0)) == OF_20_SLICES
    assert codes(solved(PLAIN, 15000.0)) - OF_20_SLICES == {"high_speed"}


def test_speed_beyond_every_check_is_finite() -> None:
    spaces = solved(PLAIN, 60000.0).pinion_spaces
    assert 10 < spaces.peak_pressure_ratio < 20
    assert spaces.min_pressure_ratio > 0.2


def test_values_without_meaning_are_none() -> None:
    result = solved(spur(), 1000.0)
    spaces = result.pinion_spaces
    assert (spaces.max_temperature_rise, spaces.field.temperature_rise, spaces.balance.energy_error) == (None,) * 3
    assert (result.lead_correction, result.total.axial_meshing_speed, result.wheel_spaces) == (None,) * 3


def test_a_result_is_finite_and_its_arrays_are_read_only() -> None:
    assert_finite(solved(PLAIN))


def test_a_helix_too_small_for_numbers_is_a_spur_gear() -> None:
    """In a generated request, the speed of the meshing point along the face was once infinite."""
    result = solve(PumpingInputs(gears(helix_angle=2e-310, centre_distance=None), 1000.0))
    assert (result.total.axial_meshing_speed, result.total.axial_meshing_mach) == (None, None)
    assert "spur_gear" in codes(result)


def test_a_speed_scan_takes_fewer_slices_where_it_would_not_end() -> None:
    """A speed that would need too many steps gets fewer slices, or no value."""
    # In a generated request, the choking figure of a disk-shaped gear once took more than half a minute.
    disk = GearPairInputs(GearTeeth(94), GearTeeth(408), 14e-3, 0.3e-3, rack_tip_radius=0.25)
    curves = speed_scan(PumpingSetup(disk), np.linspace(5_000, 60_000, 6) * pi / 30)
    solved = np.isfinite(curves.exit_mach)
    assert 2 <= solved.sum() < 6
    assert solved[-1]
    assert not solved[0]
