"""Both methods of micropitting give the same film under the same load; film and wear change with their causes."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume

from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.oils import OilSheet, iso_vg
from solvers.scuffing import solve_scuffing
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    MicropittingCheck,
    Modifications,
    ScuffingInputs,
    Temperatures,
)
from solvers.scuffing.micropitting.film import Conditions, films
from solvers.scuffing.micropitting.local import FlankFilm, contacts_of, flank_film
from solvers.scuffing.micropitting.mean_values import helical_load_factor
from solvers.scuffing.micropitting.oil import density, pressure_viscosity, viscosity
from solvers.scuffing.micropitting.oil_test import film_of_test
from solvers.scuffing.micropitting.results import PointName
from solvers.scuffing.micropitting.standard import characteristic_points, load_sharing, solve_standard
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.flank import contacts_under_load
from tests.solvers.scuffing.test_symmetries import mirrored, misaligned_spur_pairs, solved
from tests.support.gear_pairs import UNDERCUT_PAIR
from tests.support.properties import examples
from tests.support.random_pairs import COARSE, designs

FEW, MANY = 8, 200
EXACT = 1e-9
OF_THE_SEARCH = 1e-3  # of the ratio: what the place of the thinnest film on coarse grids may miss
OIL = OilSheet(220e-6, 19e-6)
STAGE = MicropittingCheck(failure_load_stage=8)
GEARS = GearPairInputs(
    GearTeeth(20, 0.3), GearTeeth(45, 0.1), module=4e-3, face_width=30e-3, rack_tip_radius=GROUND_FILLET
)
PAIR = LoadDistributionInputs(GEARS, Load(300.0, 150.0), resolution=COARSE)


def checked(design: LoadDistributionInputs, **known: object) -> ScuffingInputs:
    """Return the inputs of a closed-form check of a pair: an oil, a given bulk temperature and failure load stage 8.

    `known` replaces any of these inputs.
    """
    temperatures = Temperatures(bulk=353.15, bulk_method="given", oil=333.15)
    inputs = ScuffingInputs(design, None, OIL, temperatures, friction="iso_tr_13989", lubrication="closed_form")
    return replace(inputs, **{"micropitting": STAGE, **known})


def least(found: Scuffing) -> float:
    """Return the least film ratio by the local method. Fail if the result has no such ratio."""
    assert found.micropitting is not None
    ratio = found.micropitting.local.least_ratio
    assert ratio is not None
    return ratio


def valid(inputs: ScuffingInputs) -> Scuffing:
    """Return the check of a random pair.

    Skip the pair if it is invalid, or if it has no least film ratio because a loaded contact reaches a base circle.
    """
    found = solved(inputs)
    assert found.micropitting is not None
    assume(found.micropitting.local.least_ratio is not None)
    return found


def test_the_local_method_with_the_standards_load_gives_the_standards_film() -> None:
    path = meshing_path(GEARS)
    standard = solve_standard(PAIR, path, OIL, 333.15, "spray", 9, PAIR.load.contact_torque)
    conditions = Conditions(OIL, standard.bulk, standard.friction, PAIR.pinion_material, PAIR.wheel_material)
    distribution = solve_load_distribution(PAIR)
    flank = FlankFilm(checked(PAIR), distribution, conditions, None)
    x = np.array([*characteristic_points(path).values()])
    load = load_sharing(path, x, 9) * distribution.load.tangential_force / GEARS.face_width
    points = contacts_under_load(PAIR, distribution, x, load)
    assert flank.ratio(points, np.zeros(x.size)) == pytest.approx(standard.films.ratio, rel=EXACT)
    contacts = contacts_of(points, conditions.modulus)
    assert films(conditions, contacts).flash == pytest.approx(standard.films.flash, rel=EXACT, abs=1e-9)


@examples(FEW, MANY, designs())
def test_no_place_of_the_flank_has_less_than_the_least_ratio(design: LoadDistributionInputs) -> None:
    found = valid(checked(design))
    ratio = least(found)
    assert found.flank_film_ratio is not None
    assert found.path.micropitting_ratio is not None
    assert np.nanmin(found.flank_film_ratio) >= ratio * (1 - EXACT)
    assert np.nanmin(found.path.micropitting_ratio) >= ratio * (1 - OF_THE_SEARCH)
    assert found.micropitting is not None
    local = found.micropitting.local
    assert local.at_psi is not None
    assert local.at_face is not None
    assert 0.0 <= local.at_psi <= 1.0
    assert 0.0 <= local.at_face <= design.gears.face_width * (1 + EXACT)
    assert local.safety == pytest.approx(ratio / (found.micropitting.permissible_ratio or np.nan), rel=EXACT)


@examples(FEW, MANY, designs())
def test_the_film_ratio_follows_its_causes(design: LoadDistributionInputs) -> None:
    ratio = least(valid(checked(design)))
    rough = replace(design.pinion_material, roughness=2 * design.pinion_material.roughness)
    temperatures = checked(design).temperatures
    hotter = replace(temperatures, bulk=(temperatures.bulk or 0.0) + 20.0, oil=temperatures.oil + 20.0)
    heavier = replace(design.load, application_factor=1.3)
    assert least(valid(checked(replace(design, pinion_material=rough)))) < ratio
    assert least(valid(checked(design, temperatures=hotter))) < ratio
    assert least(valid(checked(design, oil=OilSheet(320e-6, 24.1e-6)))) > ratio
    assert least(valid(checked(replace(design, load=heavier)))) < ratio


@examples(FEW, MANY, misaligned_spur_pairs())
def test_a_mirrored_pair_has_the_same_film(design: LoadDistributionInputs) -> None:
    one, other = (valid(checked(each)) for each in (design, mirrored(design)))
    assert least(other) == pytest.approx(least(one), rel=1e-7)


def test_a_load_factor_follows_its_three_stretches() -> None:
    assert [helical_load_factor(ratio) for ratio in (1.2, 2.0, 3.5, 6.0)] == pytest.approx([1.0, 1.0, 1.3, 1.3])
    assert helical_load_factor(3.0) == pytest.approx(1.0 + 0.2 * 2**0.5)


def test_grades_up_to_seven_share_the_load_alike_and_coarser_ones_more_of_it() -> None:
    path = meshing_path(GEARS)
    ends = np.array([0.0, path.length])
    assert load_sharing(path, ends, 5) == pytest.approx(load_sharing(path, ends, 7))
    assert load_sharing(path, ends, 12) == pytest.approx([10 / 15, 10 / 15])


@pytest.mark.parametrize(
    ("design", "text"),
    [
        (replace(PAIR, modifications=Modifications(tip_relief=20e-6)), "relief"),
        (
            replace(PAIR, gears=replace(GEARS, pinion=GearTeeth(60, 0, 1.35, 1.6), wheel=GearTeeth(90, 0, 1.35, 1.6))),
            "contact ratio",
        ),
    ],
)
def test_the_standard_has_no_film_where_its_load_sharing_is_not_known(
    design: LoadDistributionInputs, text: str
) -> None:
    found = solve_scuffing(checked(design))
    assert found.micropitting is not None
    assert found.micropitting.standard is None
    (notice,) = (each for each in found.warnings if each.code == "no_standard_film")
    assert text in notice.message
    assert notice.rank == "note"
    assert found.micropitting.local.safety is not None


def test_an_even_spur_pair_has_a_film_by_both_methods() -> None:
    found = solve_scuffing(checked(PAIR)).micropitting
    assert found is not None
    assert found.standard is not None
    assert [point.point for point in found.standard.points] == ["A", "AB", "B", "C", "D", "DE", "E"]
    assert [point.point for point in found.local.points] == ["A", "AB", "B", "C", "D", "DE", "E"]
    assert found.standard.safety == pytest.approx(found.standard.least_ratio / (found.permissible_ratio or np.nan))


def test_without_stage_and_ratio_there_is_a_film_but_no_safety() -> None:
    found = solve_scuffing(checked(PAIR, micropitting=MicropittingCheck())).micropitting
    assert found is not None
    assert found.local.least_ratio is not None
    assert (found.permissible_ratio, found.test, found.local.safety, found.local.verdict) == (None, None, None, None)


def test_without_an_oil_or_a_question_there_is_no_answer() -> None:
    assert solve_scuffing(checked(PAIR, oil=None)).micropitting is None
    assert solve_scuffing(checked(PAIR, micropitting=None)).micropitting is None


def test_without_load_nothing_is_in_contact() -> None:
    found = solve_scuffing(checked(replace(PAIR, load=Load(0.0, 150.0)))).micropitting
    assert found is not None
    assert found.permissible_ratio is not None
    assert found.local.least_ratio is None
    assert found.standard is None
    assert {point.ratio for point in found.local.points} == {None}


def test_ranges_of_the_method_are_warned_of() -> None:
    slow = replace(PAIR, gears=replace(GEARS, module=2e-3, face_width=20e-3), load=Load(30.0, 20.0))
    notices = [each for each in solve_scuffing(checked(slow)).warnings if each.code == "micropitting_range"]
    assert {each.field for each in notices} == {"module", "pinion_speed"}
    inside = solve_scuffing(checked(replace(PAIR, load=Load(300.0, 300.0)))).warnings
    assert "micropitting_range" not in {each.code for each in inside}


def test_a_glowing_contact_is_warned_of_and_keeps_finite_numbers() -> None:
    hot = replace(PAIR, friction_coefficient=1.0, load=Load(3000.0, 600.0))
    found = solve_scuffing(checked(hot, friction="given"))
    assert "micropitting_temperature" in {each.code for each in found.warnings}
    assert 0.0 <= least(found) < 0.1


def test_a_given_friction_and_a_given_pressure_viscosity_count() -> None:
    given = solve_scuffing(checked(replace(PAIR, friction_coefficient=0.02), friction="given")).micropitting
    assert given is not None
    assert given.local.friction_coefficient == 0.02
    thick = replace(OIL, pressure_viscosity=30e-9)
    assert pressure_viscosity(thick, np.array([300.0, 500.0])) == pytest.approx(30e-9)


@pytest.mark.parametrize("law", ["roelands", "barus"])
def test_an_oil_by_its_viscosity_follows_its_own_law(law: PressureViscosityLaw) -> None:
    oil = Lubricant(0.05, 360.0, 20e-9, 0.04, 870.0, pressure_viscosity_law=law)
    at = np.array([310.0, 360.0, 480.0])
    assert viscosity(oil, at) == pytest.approx([oil.viscosity_at(0.0, t) for t in at], rel=EXACT)


def test_an_oil_that_would_be_solid_in_the_test_is_refused() -> None:
    oil = Lubricant(viscosity=100.0, reference_temperature=570.0, temperature_viscosity=0.2)
    with pytest.raises(InvalidInput, match="the largest permissible viscosity is 10000") as refusal:
        film_of_test(oil, 8)
    assert refusal.value.code == "viscosity_range"


def test_an_oil_by_its_sheet_follows_walther_with_the_density_of_the_report() -> None:
    oil, at = iso_vg(100), 350.0
    assert viscosity(oil, at) == pytest.approx(oil.kinematic_viscosity(at) * density(oil, at), rel=EXACT)


def wear_of(design: LoadDistributionInputs, coefficient: float) -> Scuffing:
    return solve_scuffing(checked(design, micropitting=MicropittingCheck(wear_coefficient=coefficient)))


def test_wear_is_archards() -> None:
    found = wear_of(PAIR, 2e-18)
    wear, flank = found.wear, found.distribution.flank
    assert wear is not None
    place: int = int(np.argmax(wear.pinion))
    x = np.array([wear.psi[place] * found.distribution.path_of_contact.length])
    pinion, wheel = found.distribution.path_of_contact.surface_speeds(x, PAIR.load.pinion_speed)
    heaviest = flank.line_load[place].max()
    assert wear.pinion_max == pytest.approx(2e-18 * heaviest * abs(pinion[0] - wheel[0]) / pinion[0], rel=EXACT)
    assert wear.pinion_at_psi == wear.psi[place]
    doubled = wear_of(PAIR, 4e-18).wear
    assert doubled is not None
    assert doubled.wheel == pytest.approx(2 * wear.wheel)


def test_the_pitch_point_does_not_wear() -> None:
    found = wear_of(PAIR, 1e-18)
    assert found.wear is not None
    path = found.distribution.path_of_contact
    pitch = (path.pitch_point - path.start) / path.length
    assert float(np.interp(pitch, found.wear.psi, found.wear.pinion)) < 0.1 * (found.wear.pinion_max or 0.0)


def test_wear_needs_no_oil() -> None:
    dry = checked(PAIR, oil=None, micropitting=MicropittingCheck(wear_coefficient=1e-18))
    assert solve_scuffing(dry).wear is not None
    assert solve_scuffing(checked(PAIR)).wear is None


def test_misalignment_moves_the_thinnest_film_to_the_loaded_end() -> None:
    tilted = replace(PAIR, modifications=Modifications(helix_slope=25e-6))
    even, loaded = solve_scuffing(checked(PAIR)), solve_scuffing(checked(tilted))
    assert loaded.micropitting is not None
    assert loaded.micropitting.local.at_face == pytest.approx(0.0, abs=1e-9)
    assert least(loaded) < least(even)


def test_relief_moves_the_thinnest_film_off_the_ends_of_the_path() -> None:
    relieved = replace(PAIR, modifications=Modifications(tip_relief=40e-6, root_relief=40e-6))
    even, found = solve_scuffing(checked(PAIR)), solve_scuffing(checked(relieved))
    assert even.micropitting is not None
    assert even.micropitting.local.at_psi == pytest.approx(0.0, abs=1e-6)
    assert least(found) > least(even)
    assert found.micropitting is not None
    assert 0.0 < (found.micropitting.local.at_psi or 0.0) < 1.0


@pytest.mark.parametrize("slope", [-20e-6, 0.0, 20e-6])
def test_b_and_d_belong_to_single_contact(slope: float) -> None:
    """Rounding once decided whether D was a point of single or of double contact, which is a step of 13 %."""
    design = replace(PAIR, modifications=Modifications(helix_slope=slope))
    found = solve_scuffing(checked(design))
    assert found.micropitting is not None
    path, plane = found.distribution.path_of_contact, found.distribution.path_of_contact.plane
    film = flank_film(checked(design), found.distribution)
    assert film is not None
    points = {each.point: each.ratio for each in found.micropitting.local.points}
    inner: tuple[tuple[PointName, float], ...] = (("B", 1e-9), ("D", -1e-9))
    for name, inwards in inner:
        x = characteristic_points(path)[name]
        beside = np.array([x + inwards * path.length, x - inwards * path.length])
        single, double = film.at(beside, np.full(2, x / path.length * plane.face_width))
        assert points[name] == pytest.approx(single, rel=1e-6)
        assert single < 0.99 * double


def test_an_unloaded_end_does_not_wear() -> None:
    """At a base circle one surface stands still; without load there is no wear, and the curve has no gap."""
    design = LoadDistributionInputs(
        UNDERCUT_PAIR, Load(20.0, 100.0), Modifications(tip_relief=80e-6, root_relief=80e-6), resolution=COARSE
    )
    found = solve_scuffing(checked(design, micropitting=MicropittingCheck(wear_coefficient=1e-18)))
    assert found.wear is not None
    unloaded = found.distribution.flank.line_load.max(axis=1) == 0.0
    near = np.isnan(found.distribution.flank.pressure).any(axis=1)
    assert (unloaded & near).any()
    assert (found.wear.pinion[unloaded] == 0.0).all()
    assert (found.wear.wheel[unloaded] == 0.0).all()
