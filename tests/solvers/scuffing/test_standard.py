"""The checks by the standard: branches meet, what is given wins, and nothing of them loads the local check."""

from dataclasses import replace
from math import isfinite, radians

import numpy as np
import pytest
from hypothesis import strategies as st

from benchmarks.published.standard import PRINTED_FACTORS, STAGE, fzg_c
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import half_width, reduced_modulus
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.lubricants import Lubricant
from solvers.oils import iso_vg
from solvers.quantity import quantities
from solvers.scuffing import solve_scuffing
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    MicropittingCheck,
    Modifications,
    ScuffingInputs,
    ScuffingTest,
    StandardFactors,
    Temperatures,
)
from solvers.scuffing.load_factors.method_b import dynamic_factor, load_factors, transverse_load_factor
from solvers.scuffing.standard.flash import approach_factor, flash_temperature, solve_flash
from solvers.scuffing.standard.integral import (
    addendum_contact,
    contact_ratio_factor,
    relief_factor,
    scuffing_integral,
    solve_integral,
)
from solvers.scuffing.standard.integral import (
    approach_factor as factor_of_approach,
)
from solvers.scuffing.standard.mesh import standard_oil
from solvers.scuffing.standard.results import ScuffingStandard
from tests.solvers.scuffing.test_symmetries import solved
from tests.support.properties import examples
from tests.support.random_pairs import COARSE, designs

FEW, MANY = 3, 100
GEARS = GearPairInputs(
    GearTeeth(20, 0.3), GearTeeth(45, 0.1), module=4e-3, face_width=30e-3, rack_tip_radius=GROUND_FILLET
)
PAIR = LoadDistributionInputs(GEARS, Load(300.0, 150.0), resolution=COARSE)


def checked(design: LoadDistributionInputs, **known: object) -> ScuffingInputs:
    temperatures = Temperatures(oil=333.15, scuffing_test=ScuffingTest(12))
    inputs = ScuffingInputs(design, oil=iso_vg(220), temperatures=temperatures, lubrication="closed_form")
    return replace(inputs, **known)


def by_standard(inputs: ScuffingInputs) -> ScuffingStandard:
    safety = solve_scuffing(inputs).safety
    assert safety is not None
    assert safety.standard is not None
    return safety.standard


@pytest.mark.parametrize("share", [0.1, 0.35, 0.5, 0.8])
def test_branches_of_the_contact_ratio_factor_meet(share: float) -> None:
    """At eps_alpha = 1 and 2 and where an addendum contact ratio reaches 1 (to the two printed digits at 2)."""
    step = 1e-9
    low, high = (contact_ratio_factor(share * total, (1 - share) * total) for total in (1 - step, 1 + step))
    assert high == pytest.approx(low, rel=1e-7)
    for pair in ((1.0, share), (share, 1.0)):
        low, high = (contact_ratio_factor(*(each - sign * step for each in pair)) for sign in (1, -1))
        assert high == pytest.approx(low, rel=1e-7)
    low, high = (contact_ratio_factor(share * total, (1 - share) * total) for total in (2 - step, 2 + step))
    assert high == pytest.approx(low, rel=0.03)


def test_what_is_given_wins_over_method_b() -> None:
    path = meshing_path(GEARS)
    given = StandardFactors(1.4, 1.1, 1.2)
    factors = load_factors(PAIR, path, given, 1.3)
    assert (factors.dynamic_factor, factors.transverse_load_factor, factors.face_load_factor) == (1.2, 1.1, 1.4)
    assert factors.product == pytest.approx(1.2 * 1.1 * 1.4)
    computed = load_factors(PAIR, path, StandardFactors(), 1.3)
    assert computed.face_load_factor == 1.3
    assert computed.dynamic_factor > 1.0
    stated = replace(PAIR, load=replace(PAIR.load, dynamic_factor=1.15))
    assert load_factors(stated, path, StandardFactors(), 1.3).dynamic_factor == 1.15
    assert computed.line_load == pytest.approx(300.0 / 40e-3 / 30e-3 * computed.product)


@pytest.mark.parametrize("grade", [5, 9])
def test_the_dynamic_factor_is_continuous_above_the_resonance(grade: int) -> None:
    path = meshing_path(GEARS)
    for ratio in (1.15, 1.5):
        below, above = (dynamic_factor(PAIR, path, grade, ratio + step) for step in (-1e-9, 1e-9))
        assert above == pytest.approx(below, rel=1e-7)
    assert dynamic_factor(PAIR, path, grade, 1e-9) == pytest.approx(1.0)
    assert dynamic_factor(PAIR, path, 9, 0.5) > dynamic_factor(PAIR, path, 7, 0.5)
    assert dynamic_factor(replace(PAIR, load=Load(0.0, 150.0)), path, grade, 0.5) == 1.0


def test_the_transverse_factor_has_its_limits() -> None:
    path = meshing_path(GEARS)
    light = replace(PAIR, load=Load(1.0, 150.0))
    ratio = path.transverse_contact_ratio
    assert transverse_load_factor(light, path, 11, 1.0) == pytest.approx(3.0 / (4.0 - ratio))
    assert transverse_load_factor(replace(PAIR, load=Load(5000.0, 150.0)), path, 1, 1.0) == 1.0


def test_the_transverse_factor_does_not_jump_where_a_second_pair_always_carries() -> None:
    """Both formulas of K_Halpha meet at a total contact ratio of 2: only 2 (eps - 1)/eps is under the root."""
    helical = replace(GEARS, helix_angle=radians(15.0))
    width = (2.0 - meshing_path(helical).transverse_contact_ratio) * np.pi * 4e-3 / np.sin(radians(15.0))
    factors = []
    for face in (width * (1 - 1e-9), width * (1 + 1e-9)):
        gears = replace(helical, face_width=face)
        load = Load(300.0 * face / 30e-3, 150.0)
        factors.append(transverse_load_factor(replace(PAIR, gears=gears, load=load), meshing_path(gears), 8, 1.0))
    assert factors[1] == pytest.approx(factors[0], rel=1e-7)
    assert factors[0] > 1.01


def test_load_factors_do_not_depend_on_which_gear_drives() -> None:
    turned = replace(GEARS, pinion=GEARS.wheel, wheel=GEARS.pinion)
    load = Load(300.0 * 45 / 20, 150.0 * 20 / 45)
    one = load_factors(PAIR, meshing_path(GEARS), StandardFactors(), 1.0)
    other = load_factors(replace(PAIR, gears=turned, load=load), meshing_path(turned), StandardFactors(), 1.0)
    for name in quantities(type(one)):
        assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-9)


def test_a_factor_for_the_standard_never_loads_the_local_check() -> None:
    check = MicropittingCheck(failure_load_stage=8)
    plain = solve_scuffing(checked(PAIR, micropitting=check))
    heavy_factors = StandardFactors(2.0, 1.5, 1.4, 10, 1.0)
    heavy = solve_scuffing(checked(PAIR, micropitting=check, standard=heavy_factors))
    assert plain.safety is not None
    assert heavy.safety is not None
    assert replace(heavy.safety, standard=None) == replace(plain.safety, standard=None)
    assert (heavy.flash, heavy.contact_temperature, heavy.film) == (plain.flash, plain.contact_temperature, plain.film)
    assert heavy.micropitting is not None
    assert plain.micropitting is not None
    assert heavy.micropitting.local == plain.micropitting.local
    assert heavy.micropitting.standard is not None
    assert plain.micropitting.standard is not None
    assert heavy.micropitting.standard.least_ratio < plain.micropitting.standard.least_ratio
    loaded, light = (by_standard(checked(PAIR, standard=each)).flash for each in (heavy_factors, StandardFactors()))
    assert loaded is not None
    assert light is not None
    assert loaded.max_flash > light.max_flash


def test_flash_temperature_is_bloks_under_the_same_load() -> None:
    """The standard's 2.52 agrees with Blok's formula within 3 % under X w_Bt/cos alpha_t."""
    mesh = fzg_c()
    x = np.linspace(0.0, mesh.path.length, 9)
    found = flash_temperature(mesh, x, 0.05, np.ones(9), np.ones(9))
    load = mesh.line_load * 1e3 / np.cos(mesh.path.pair.transverse_pressure_angle)
    steel = mesh.given.pinion_material
    width = half_width(load, mesh.reduced_radius(x) * 1e-3, reduced_modulus(steel, steel))
    speeds = mesh.path.surface_speeds(x, mesh.given.load.pinion_speed)
    blok = blok_flash_temperature(
        friction=0.05,
        line_load=load,
        speed_1=speeds[0],
        speed_2=speeds[1],
        half_width=width,
        solid_1=steel,
        solid_2=steel,
    )
    assert found == pytest.approx(blok, rel=0.03)


def test_the_editions_differ_in_the_exponent_of_the_roughness() -> None:
    one, other = (solve_flash(fzg_c(), edition, STAGE) for edition in ("2017", "2000"))
    assert one is not None
    assert other is not None
    assert other.friction_coefficient / one.friction_coefficient == pytest.approx(0.3**0.25)


def test_relief_lowers_what_it_should() -> None:
    mesh = fzg_c(replace(PRINTED_FACTORS, quality_grade=6))
    x = np.array([0.0])
    assert approach_factor(mesh, x, 20.0)[0] > approach_factor(mesh, x, 10.0)[0] > 1.0
    assert approach_factor(mesh, np.array([mesh.path.length]), 20.0)[0] == 1.0
    changed = replace(mesh, given=replace(mesh.given, modifications=Modifications(tip_relief=20e-6, root_relief=20e-6)))
    assert solve_flash(changed, "2017", STAGE) is None, "the load sharing of relieved profiles is not known"
    ends, relieved = addendum_contact(mesh), addendum_contact(changed)
    assert relief_factor(changed, relieved, 20.0) > relief_factor(mesh, ends, 20.0) > 1.0
    coarse = replace(changed, asked=replace(changed.asked, quality_grade=7))
    assert relief_factor(coarse, relieved, 20.0) == 1.0
    assert factor_of_approach(ends) == pytest.approx(1.0)
    assert factor_of_approach(ends._replace(wheel=4 * ends.pinion)) == pytest.approx(0.6)


def test_run_in_flanks_are_cooler_and_a_nitrided_gear_holds_more() -> None:
    new, used = (solve_integral(fzg_c(replace(PRINTED_FACTORS, running_in=state)), STAGE) for state in (0.0, 1.0))
    assert new is not None
    assert used is not None
    assert new.tip_flash == pytest.approx(used.tip_flash * new.running_in_factor)
    one, more = (scuffing_integral(fzg_c(), ScuffingTest(6, structure_factor=each), 1.0) for each in (1.0, 1.5))
    assert more.scuffing - one.scuffing == pytest.approx(0.75 * one.flash)


def test_stages_beyond_the_table_go_on_smoothly() -> None:
    twelve, thirteen = (scuffing_integral(fzg_c(), ScuffingTest(stage), 1.0).scuffing for stage in (12, 13))
    assert (thirteen - 353.15) / (twelve - 353.15) == pytest.approx((13 / 12) ** 2, rel=0.01)


def test_an_oil_given_by_its_viscosity_needs_no_viscosity_at_40_degrees() -> None:
    thin = Lubricant(0.05, 360.0, 20e-9, 0.04, 870.0)
    known = standard_oil(thin, 353.15)
    assert known is not None
    assert known.kinematic_viscosity_40 is None
    mesh = replace(fzg_c(), oil=known)
    assert scuffing_integral(mesh, STAGE, 1.0).flash == pytest.approx(0.2 * 135.3)
    assert standard_oil(replace(thin, temperature_viscosity=0.2), 220.0) is None


def test_without_load_motion_or_scuffing_temperature_the_standard_says_nothing() -> None:
    still = solve_scuffing(checked(replace(PAIR, load=Load(0.0, 150.0)))).safety
    assert still is not None
    assert still.standard is None
    given = by_standard(checked(PAIR, temperatures=Temperatures(oil=333.15, scuffing=573.15)))
    assert given.flash is not None
    assert given.integral is not None
    assert given.flash.scuffing == 573.15
    assert (given.integral.scuffing, given.integral.safety, given.integral.load_safety) == (None, None, None)


@pytest.mark.parametrize("helix", [0.0, 12.0])
@pytest.mark.parametrize("shifts", [(1.2, -1.2), (1.1, -1.5)])
def test_a_pitch_point_beyond_the_path_is_no_point_of_the_standard(shifts: tuple[float, float], helix: float) -> None:
    """Its load sharing would be negative."""
    pinion, wheel = GearTeeth(20, shifts[0], 0.8), GearTeeth(60, shifts[1], 1.0)
    gears = GearPairInputs(pinion, wheel, 4e-3, 40e-3, helix_angle=radians(helix), rack_tip_radius=GROUND_FILLET)
    design = LoadDistributionInputs(gears, Load(200.0, 157.0), resolution=COARSE)
    found = solve_scuffing(checked(design, micropitting=MicropittingCheck(failure_load_stage=8)))
    assert found.safety is not None
    assert found.safety.standard is not None
    assert found.safety.standard.integral is None
    assert found.safety.standard.flash is not None
    assert found.micropitting is not None
    assert found.micropitting.standard is not None
    for points in (found.safety.standard.flash.points, found.micropitting.standard.points):
        assert [each.point for each in points] == ["A", "AB", "B", "D", "DE", "E"]
        assert all(each.force_ratio > 0.0 for each in points)


@examples(FEW, MANY, designs(), st.integers(1, 11), st.sampled_from(["2017", "2000"]))
def test_every_number_is_finite(design: LoadDistributionInputs, grade: int, edition: str) -> None:
    asked = replace(checked(design), standard=StandardFactors(quality_grade=grade), standard_edition=edition)
    safety = solved(asked).safety
    if safety is None or safety.standard is None:
        return
    for part in (safety.standard.factors, safety.standard.flash, safety.standard.integral):
        numbers = [] if part is None else [getattr(part, name) for name in quantities(type(part))]
        assert all(isfinite(number) for number in numbers if isinstance(number, float))
    assert safety.standard.factors.product >= 1.0
