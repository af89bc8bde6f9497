"""The geometry of tooth spaces agrees with sampled polygons, mirror images and the envelope of the rack."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from shapely import Polygon

from benchmarks.published.milian import CASE_1, CASE_2, TABLE_1
from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.gears.gear import fillet_point, fillet_sector_area, root_profile
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import PathOfContact, gear_pair, meshing_path
from solvers.pumping.inputs import Gap, PumpingSetup
from solvers.pumping.space.section import section
from solvers.pumping.space.stroke import StrokeTable, stroke_table
from solvers.pumping.space.tooth_space import ToothSpace, stroke_limits, tooth_space
from tests.support.meshing_pairs import setups
from tests.support.properties import examples, first
from tests.support.pumping_cases import rough_gears

FEW, MANY = 30, 120


def polar(radius: FloatArray, angle: FloatArray) -> FloatArray:
    return np.column_stack([radius * np.sin(angle), radius * np.cos(angle)])


def involute_points(base: float, start: float, end: float, points: int) -> tuple[FloatArray, FloatArray]:
    """Return radii and polar angles of points on an involute; the angles are measured from its base point."""
    roll = np.sqrt(np.linspace(start**2, end**2, points))
    return np.hypot(base, roll), roll / base - np.arctan(roll / base)


def half_profile(space: ToothSpace, points: int) -> tuple[FloatArray, FloatArray]:
    """Return radii and half angles of the profile of a space, from the middle of its bottom land to its tip corner."""
    root = space.root
    bottom = np.linspace(0, root.root_half_angle, 200)
    fillet = np.array([fillet_point(root.fillet, t) for t in np.linspace(0, root.fillet.end, 3 * points)])
    radius, angle = involute_points(space.base_radius, root.involute_roll, space.tip_roll, points)
    radii = np.concatenate([np.full(bottom.size, root.root_radius), fillet[:, 0], radius])
    return radii, np.concatenate([bottom, fillet[:, 1], space.base_half_angle + angle])


def mate_flank(space: ToothSpace, points: int) -> tuple[FloatArray, FloatArray]:
    radius, angle = involute_points(space.mate_base_radius, 0.0, space.mate_tip_roll, points)
    return radius, space.mate_base_half_angle - angle


def closest(own: FloatArray, mate: FloatArray) -> tuple[float, int, int]:
    """Return the distance between the two points that are closest to each other, and the indices of these points."""
    distance, nearest = map(np.asarray, cKDTree(own).query(mate))
    k = int(np.argmin(distance))
    return float(distance[k]), int(nearest[k]), k


def sampled_section(space: ToothSpace, angle: float, points: int = 1500) -> tuple[float, float, float]:
    """Return area, left clearance and right clearance of a section, computed from polygons with many points."""
    # The clearance of a side is the distance of the closest pair of points. The polygon is closed between the two
    # closest points of the involutes if neither point is an end of its involute. Otherwise the polygon is closed
    # between the two closest of all points.
    mate_angle = angle * space.ratio + space.offset
    own_r, own_psi = half_profile(space, points)
    mate_r, mate_mu = mate_flank(space, points)
    sides = []
    for side in (-1.0, 1.0):
        own = polar(own_r, angle + side * own_psi)
        mate = polar(mate_r, mate_angle + side * mate_mu)
        mate[:, 1] = space.centre_distance - mate[:, 1]
        if not space.contact_gap:
            mate = mate[-1:]
        distance, own_foot, mate_foot = closest(own, mate)
        _, flank_foot, facing_foot = closest(own[-points:], mate)
        if 0 < flank_foot < points - 1 and 0 < facing_foot < points - 1:
            own_foot, mate_foot = own.shape[0] - points + flank_foot, facing_foot
        sides.append((own[: own_foot + 1], mate[mate_foot:], distance))
    (own_l, mate_l, gap_l), (own_r2, mate_r2, gap_r) = sides
    tip = np.linspace(-space.mate_tip_half_angle, space.mate_tip_half_angle, points)
    arc = polar(np.full(points, space.mate_tip_radius), mate_angle + tip)
    arc[:, 1] = space.centre_distance - arc[:, 1]
    outline = np.concatenate([own_l[::-1], own_r2, mate_r2, arc[::-1], mate_l[::-1]])
    return float(Polygon(outline).area), gap_l, gap_r


@examples(FEW, MANY, setups(), st.floats(0.02, 0.98), st.sampled_from(list(Gap)), st.booleans())
def test_area_and_clearances_against_sampled_polygons(
    setup: PumpingSetup, share: float, gap: Gap, of_pinion: bool
) -> None:
    space = tooth_space(gear_pair(setup.gears), setup.normal_backlash, gap, of_pinion=of_pinion)
    limits = stroke_limits(space)
    angle = limits.start + share * (limits.end - limits.start)
    area, left, right, _ = section(space, angle)
    sampled, sampled_left, sampled_right = sampled_section(space, angle)
    module = setup.gears.normal_module
    assert left == pytest.approx(sampled_left, abs=2e-3 * module)
    assert right == pytest.approx(sampled_right, abs=2e-3 * module)
    assert left <= sampled_left + 1e-12
    assert right <= sampled_right + 1e-12
    # a foot between two samples moves the end of a nearly closed section by up to their distance, gap times that
    assert area == pytest.approx(sampled, rel=1e-3, abs=2e-3 * module**2)


@pytest.mark.slow
@pytest.mark.parametrize("gears", [TABLE_1, CASE_1, CASE_2])
@pytest.mark.parametrize("gap", list(Gap))
@pytest.mark.parametrize("of_pinion", [True, False])
def test_area_of_the_papers_gears_against_polygons(gears: GearPairInputs, gap: Gap, *, of_pinion: bool) -> None:
    space = tooth_space(gear_pair(gears), 0.3e-3, gap, of_pinion=of_pinion)
    limits = stroke_limits(space)
    for angle in np.linspace(limits.start, limits.end, 4):
        assert section(space, angle)[0] == pytest.approx(sampled_section(space, angle, 6000)[0], rel=2e-4)


@examples(FEW, MANY, setups(), st.booleans())
def test_contact_gap_has_one_minimum_and_continuous_sections(setup: PumpingSetup, of_pinion: bool) -> None:
    space = tooth_space(gear_pair(setup.gears), setup.normal_backlash, Gap.CONTACT, of_pinion=of_pinion)
    table = continuous_sealed_table(space, of_pinion)
    assert np.abs(np.diff(table.clearance_left)).max() < 0.05 * setup.gears.normal_module


def continuous_sealed_table(space: ToothSpace, of_pinion: bool) -> StrokeTable:
    """Return the table of a stroke; check that its area is continuous and that the working flank seals in contact."""
    table = stroke_table(space, positions=1441)
    assert np.abs(np.diff(table.area)).max() < 0.02 * table.area.max()
    sealed = table.clearance_left if of_pinion else table.clearance_right
    inside = (table.angle > table.limits.contact_start) & (table.angle < table.limits.contact_end)
    assert sealed[inside].max() < 1e-12
    return table


@cache
def shortened_paths(count: int) -> list[PathOfContact]:
    """Draw paths of contact that are shortened because tips reach into a fillet or past a base circle."""
    draw = np.random.default_rng(3)
    paths: list[PathOfContact] = []
    while len(paths) < count:
        try:
            path = meshing_path(rough_gears(draw))
        except InvalidInput:
            continue
        if path.shortened_by:
            paths.append(path)
    return paths


@pytest.mark.parametrize("count", first(1, [2, 4]))
@pytest.mark.parametrize("of_pinion", [True, False])
def test_sections_beyond_the_end_of_an_involute(count: int, *, of_pinion: bool) -> None:
    draw = np.random.default_rng(4)
    for path in shortened_paths(count):
        module = path.pair.inputs.normal_module
        space = tooth_space(path.pair, 0.02 * module, Gap.CONTACT, of_pinion=of_pinion)
        table = continuous_sealed_table(space, of_pinion)
        for angle in draw.uniform(table.limits.start, table.limits.end, 4):
            area, left, right, _ = section(space, angle)
            sampled, sampled_left, sampled_right = sampled_section(space, angle)
            # an undercut counts as flank down to the base circle; its depth is what sections may differ by
            assert left == pytest.approx(sampled_left, abs=0.025 * module)
            assert right == pytest.approx(sampled_right, abs=0.025 * module)
            assert area == pytest.approx(sampled, abs=0.02 * module**2)


@pytest.mark.parametrize("of_pinion", [True, False])
def test_area_and_carried_gas_keep_step(*, of_pinion: bool) -> None:
    # where the section passes from a tip corner to the flanks the area turns by what they begin to carry
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=of_pinion)
    table = stroke_table(space, positions=2881)
    bends, together = (np.abs(np.diff(each, 2))[100:-100] for each in (table.area, table.area + table.carried))
    assert bends.max() > 20 * np.median(bends)
    assert together.max() < 0.2 * bends.max()


@examples(FEW, MANY, setups())
def test_driver_and_driven_spaces_mirror_each_other(setup: PumpingSetup) -> None:
    # time reversed, a gear that drives becomes one that is driven: equal gears have mirrored spaces
    gears = replace(setup.gears, wheel=setup.gears.pinion, centre_distance=None, rack_tip_radius=0.25)
    try:
        pair = gear_pair(gears)
        driver = stroke_table(tooth_space(pair, setup.normal_backlash, Gap.CONTACT, of_pinion=True))
    except InvalidInput:
        assume(False)
    driven = stroke_table(tooth_space(pair, setup.normal_backlash, Gap.CONTACT, of_pinion=False))
    assert driven.angle == pytest.approx(-driver.angle[::-1], abs=1e-12)
    assert driven.area == pytest.approx(driver.area[::-1], rel=1e-10)
    assert driven.clearance_left == pytest.approx(driver.clearance_right[::-1], abs=1e-12)
    assert driven.carried == pytest.approx(driver.carried[::-1] - driver.carried[-1], abs=1e-15)


@examples(FEW, MANY, setups())
def test_fillet_joins_involute_and_bottom_land(setup: PumpingSetup) -> None:
    pair = gear_pair(setup.gears)
    for gear, teeth in ((pair.pinion, setup.gears.pinion), (pair.wheel, setup.gears.wheel)):
        root = root_profile(setup.gears, teeth, gear)
        radius, half_angle = fillet_point(root.fillet, root.fillet.end)
        assert fillet_point(root.fillet, 0.0)[0] == pytest.approx(gear.root_radius, rel=1e-12)
        assert radius == pytest.approx(np.hypot(gear.base_radius, root.involute_roll), rel=1e-12)
        assert half_angle == pytest.approx(np.pi / gear.teeth - gear.half_tooth_angle(radius), abs=1e-10)


@pytest.mark.parametrize("teeth", [GearTeeth(12), GearTeeth(10, -0.3), GearTeeth(47, 0.291, 1.0, 1.475), GearTeeth(25)])
@pytest.mark.parametrize("helix", [0.0, 0.4])
def test_fillet_is_the_envelope_of_the_rack(teeth: GearTeeth, helix: float) -> None:
    # roll the rack tooth through the blank: nothing of it may pass the profile, and it must touch it everywhere
    gears = GearPairInputs(
        teeth, GearTeeth(60, 0.4), 5e-3, 0.05, pressure_angle=0.35, helix_angle=helix, rack_tip_radius=GROUND_FILLET
    )
    pair = gear_pair(gears)
    gear, root = pair.pinion, root_profile(gears, teeth, pair.pinion)
    arc = np.linspace(0, np.pi / 2 - 0.35, 400)
    tip = root.fillet
    flank_start = tip.centre_y - tip.tip_radius * np.sin(0.35)
    flank = np.linspace(flank_start, teeth.profile_shift * 5e-3 + 5e-3, 400)
    on_flank = tip.centre_x + tip.tip_radius * np.cos(0.35) + (flank - flank_start) * np.tan(0.35)
    x = np.concatenate([tip.centre_x + tip.tip_radius * np.sin(arc), on_flank]) / np.cos(helix)
    y = np.concatenate([tip.centre_y - tip.tip_radius * np.cos(arc), flank])
    removed = np.zeros(40)
    radii = np.linspace(gear.root_radius * 1.001, gear.reference_radius, 40)
    for shift in np.linspace(-1.5, 1.5, 3001) * 5e-3 * 3:
        radius = np.hypot(x + shift, y + gear.reference_radius)
        angle = np.arctan2(x + shift, y + gear.reference_radius) - shift / gear.reference_radius
        removed = np.maximum(removed, np.interp(radii, radius, angle, left=-1, right=-1))
    fillet = np.array([fillet_point(root.fillet, t) for t in np.linspace(0, root.fillet.end, 2000)])
    involute_angle = [
        np.pi / gear.teeth - gear.half_tooth_angle(max(r, gear.base_radius)) if r >= gear.base_radius else -1.0
        for r in radii
    ]
    start = np.hypot(gear.base_radius, root.involute_roll)
    profile = np.where(radii < start, np.interp(radii, fillet[:, 0], fillet[:, 1]), involute_angle)
    assert removed == pytest.approx(profile, abs=2e-5)


def test_fillet_sector_area_is_that_of_its_polygon() -> None:
    pair = gear_pair(CASE_1)
    root = root_profile(CASE_1, CASE_1.pinion, pair.pinion)
    for end in (0.3 * root.fillet.end, root.fillet.end):
        points = np.array([fillet_point(root.fillet, t) for t in np.linspace(0, end, 4001)])
        outline = np.vstack([[0.0, 0.0], polar(points[:, 0], points[:, 1])])
        assert fillet_sector_area(root.fillet, end) == pytest.approx(Polygon(outline).area, rel=1e-7)


def test_table_resolution_is_enough() -> None:
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=True)
    coarse, fine = stroke_table(space), stroke_table(space, positions=2881)
    area = np.interp(fine.angle, coarse.angle, coarse.area)
    assert area == pytest.approx(fine.area, rel=5e-4)
