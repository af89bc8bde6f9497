"""Mirror images of a pair are equally safe, and no line of a flank is hotter than the hottest point of the flank."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from solvers.drive_train import solve as solve_unit
from solvers.drive_train.inputs import Effects
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.scuffing import solve_scuffing
from solvers.scuffing.inputs import (
    LeadCurve,
    Load,
    LoadDistributionInputs,
    Modifications,
    ScuffingInputs,
    Temperatures,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.flank import contact_at_points, map_flash
from tests.support.changes import changed
from tests.support.drive_trains import GROUND, turbo_gear
from tests.support.properties import examples
from tests.support.random_pairs import designs

FEW, MANY = 25, 1000
EXACT = 1e-9
SLOPES = ("helix_slope", "in_plane_deviation", "out_of_plane_deviation")
OF_THE_SEARCH = 1e-3  # of the flash temperature: how far a coarse map may leave the largest below a steep edge's
OIL = Lubricant(0.05, 360.0, 20e-9, 0.04, 870.0)


def pair_in_oil(design: LoadDistributionInputs, **known: object) -> ScuffingInputs:
    """Return the inputs of a closed-form check of a pair in oil. The bulk temperature is estimated."""
    temperatures = Temperatures(bulk=None, bulk_method="estimated", oil=333.15, scuffing=573.15)
    return replace(
        ScuffingInputs(design, OIL, temperatures=temperatures, lubrication="closed_form", friction="given"), **known
    )


def solved(inputs: ScuffingInputs) -> Scuffing:
    """Return the check of a pair. Skip the pair if the solver refuses it."""
    try:
        return solve_scuffing(inputs)
    except InvalidInput:
        assume(False)
        raise


def mirrored(design: LoadDistributionInputs) -> LoadDistributionInputs:
    """Return the mirror image of a spur pair. The mirror is at the middle of the face."""
    shape, width = design.modifications, design.gears.face_width
    lead = LeadCurve(tuple(width - y for y in shape.lead_curve.position[::-1]), shape.lead_curve.gap[::-1])
    slopes = {name: -getattr(shape, name) for name in SLOPES}
    return replace(design, modifications=replace(shape, **slopes, lead_curve=lead))


def assert_as_safe(one: Scuffing, other: Scuffing, rel: float = EXACT) -> None:
    """Check that flash temperature, bulk temperature, film and safety are equal, or None, in both results."""
    for part, name in (
        ("flash", "blok_max"),
        ("contact_temperature", "bulk"),
        ("film", "dowson_higginson_min"),
        ("safety", "blok_factor"),
    ):
        values = [getattr(getattr(found, part), name, None) for found in (one, other)]
        assert values[1] == (None if values[0] is None else pytest.approx(values[0], rel=rel)), f"{part}.{name}"


@st.composite
def misaligned_spur_pairs(draw: st.DrawFn) -> LoadDistributionInputs:
    """Draw a spur pair with a helix slope, shaft deviations and a lead curve."""
    design = draw(designs())
    amplitude = 0.01 * design.gears.normal_module
    slopes = {name: amplitude * draw(st.floats(-1.0, 1.0)) for name in SLOPES}
    width = design.gears.face_width
    lead = LeadCurve((0.0, 0.3 * width, width), tuple(amplitude * draw(st.floats(-0.5, 0.5)) for _ in range(3)))
    return replace(
        design,
        gears=replace(design.gears, helix_angle=0.0),
        modifications=replace(design.modifications, **slopes, lead_curve=lead),
    )


@examples(FEW, MANY, misaligned_spur_pairs())
def test_a_spur_pair_is_as_safe_as_its_mirror_image(design: LoadDistributionInputs) -> None:
    one, other = (solved(pair_in_oil(each)) for each in (design, mirrored(design)))
    assert_as_safe(one, other)
    factors = [found.distribution.load.face_load_factor for found in (one, other)]
    assert factors[1] == (None if factors[0] is None else pytest.approx(factors[0], rel=1e-7))
    place = other.flash.blok_at_profile, other.flash.blok_at_face
    if place[0] is not None and place[1] is not None:
        image = flash_at(design, one, place[0], design.gears.face_width - place[1])
        assert image == pytest.approx(one.flash.blok_max, rel=EXACT), "its hottest place, or one as hot"


def flash_at(design: LoadDistributionInputs, found: Scuffing, profile: float, face: float) -> float:
    """Return Blok's flash temperature [K] at a fraction of the path and at a distance along the face [m]."""
    x = np.array([profile * found.distribution.path_of_contact.length])
    return float(blok_flash(design, contact_at_points(design, found.distribution, x, np.array([face])))[0])


@examples(FEW, MANY, designs())
def test_a_pair_is_as_safe_the_other_way_round(design: LoadDistributionInputs) -> None:
    """The safety of a pair stays the same if the wheel drives instead of the pinion."""
    # The path then leads from E to A, and the other end of the face meshes first. The map has its default size of 201 x
    # 101 points. On a map of 21 x 11 points, the search along a slanting ridge misses 0.3 % of the largest temperature.
    design = replace(design, resolution=replace(design.resolution, profile_points=201, face_points=101))
    gears, shape = design.gears, design.modifications
    ratio = gears.wheel.teeth / gears.pinion.teeth
    reversed_drive = replace(
        design,
        gears=replace(gears, pinion=gears.wheel, wheel=gears.pinion),
        load=Load(design.load.pinion_torque * ratio, design.load.pinion_speed / ratio),
        modifications=replace(
            shape,
            tip_relief=shape.root_relief,
            root_relief=shape.tip_relief,
            profile_slope=-shape.profile_slope,
            helix_slope=-shape.helix_slope,
        ),
    )
    one, other = (solved(pair_in_oil(each)) for each in (design, reversed_drive))
    rolls = [len(found.distribution.balance.rolls.phase) for found in (one, other)]
    assume(rolls[0] == rolls[1])
    assert_as_safe(one, other, rel=1e-6)


@examples(FEW, MANY, st.one_of(designs(), misaligned_spur_pairs()), st.integers(0, 2**32 - 1))
def test_no_line_of_the_flank_is_hotter_or_safer(design: LoadDistributionInputs, seed: int) -> None:
    found = solved(pair_in_oil(design))
    flash, safety = found.flash, found.safety
    assume(flash.blok_max is not None)
    assert flash.blok_max is not None
    assert flash.feature_line_max is not None
    assert flash.feature_line_max <= flash.blok_max
    assert safety is not None
    if safety.blok_factor is not None and safety.feature_line_factor is not None:
        assert safety.blok_factor <= safety.feature_line_factor
    plane, rng = found.distribution.path_of_contact.plane, np.random.default_rng(seed)
    x, y = rng.uniform(0.0, 1.0, (2, 2000))
    points = contact_at_points(design, found.distribution, x * plane.path_length, y * plane.face_width)
    assert blok_flash(design, points).max() <= flash.blok_max * (1 + OF_THE_SEARCH)
    assert found.flank_flash.max() <= flash.blok_max * (1 + 1e-14)
    assert found.film is not None
    assert found.film.dowson_higginson_min is not None
    if np.isfinite(found.path.dowson_higginson).any():
        assert found.film.dowson_higginson_min <= np.nanmin(found.path.dowson_higginson)
    if found.distribution.load.face_load_factor is not None:
        assert found.distribution.load.face_load_factor >= 1.0


def test_the_map_is_the_formula_at_its_points() -> None:
    """The map evaluates Blok's formula once per row, and scales this value by the load to the power 3/4."""
    # The result is the same as the formula at every point.
    design = turbo_gear(GROUND).mesh.distribution
    distribution = solve_load_distribution(design)
    found = map_flash(design, distribution)
    x, y = np.meshgrid(found.x, found.y, indexing="ij")
    assert found.flash == pytest.approx(blok_flash(design, contact_at_points(design, distribution, x, y)), rel=1e-11)


@pytest.mark.parametrize("slope", [-40e-6, 0.0, 40e-6])
def test_the_flank_is_as_hot_as_that_of_a_unit_with_rigid_shafts(slope: float) -> None:
    unit = changed(turbo_gear(GROUND), {"mesh.distribution.modifications.helix_slope": slope})
    unit = replace(unit, effects=Effects(shafts=False, coupling=False, thermal=False))
    found, pair = solve_unit(unit), solve_scuffing(unit.mesh)
    assert found.flash.flank == pytest.approx(pair.flash.blok_max, rel=1e-12)
    assert found.flash.feature == pytest.approx(pair.flash.feature_line_max, rel=1e-12)
    assert found.safety is not None
    assert pair.safety is not None
    assert found.safety.blok_flank == pytest.approx(pair.safety.blok_factor, rel=1e-12)


def small_spur_pair(slope: float) -> ScuffingInputs:
    """Return a spur pair of module 1.5 mm. A helix slope presses one end of the face against the mating flank."""
    gears = GearPairInputs(GearTeeth(18), GearTeeth(45), 1.5e-3, 15e-3, rack_tip_radius=GROUND_FILLET)
    design = LoadDistributionInputs(gears, Load(20.0, 314.0), Modifications(helix_slope=slope))
    return pair_in_oil(design, temperatures=Temperatures(bulk=353.15, oil=333.15, scuffing=433.15, bulk_method="given"))


def test_a_corner_off_the_feature_line_decides_and_a_note_says_so() -> None:
    """The feature line meets the loaded end of the face at A or at E, depending on the sign of the helix slope."""
    # For one of the two signs, the safety factor of the line alone is too large.
    one, other = (solve_scuffing(small_spur_pair(slope)) for slope in (20e-6, -20e-6))
    assert_as_safe(one, other)
    lines = [found.safety.feature_line_factor for found in (one, other) if found.safety is not None]
    assert max(lines) > 1.3 * min(lines), "the line alone judges one of the two mirror images too well"
    worse = other if lines[1] == max(lines) else one
    assert worse.safety is not None
    assert worse.hottest_path is not None
    assert np.nanmax(worse.hottest_path.blok_flash) == pytest.approx(worse.flash.blok_max, rel=EXACT)
    on_line = solve_scuffing(replace(small_spur_pair(-20e-6 if worse is other else 20e-6), line="feature_line"))
    assert on_line.safety is not None
    assert on_line.safety.blok_factor == worse.safety.feature_line_factor == max(lines)
    assert on_line.hottest_path is None


def test_face_load_factor_of_an_even_load_is_one() -> None:
    """The face load factor is at least 1 by definition."""
    # An earlier version gave 0.99999 at a helix angle of 45 degrees.
    gears = GearPairInputs(
        GearTeeth(20), GearTeeth(60), 2e-3, 20e-3, helix_angle=np.radians(45.0), rack_tip_radius=GROUND_FILLET
    )
    found = solve_load_distribution(LoadDistributionInputs(gears, Load(100.0, 100.0)))
    assert found.load.face_load_factor is not None
    assert found.load.face_load_factor >= 1.0
