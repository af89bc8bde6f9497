"""The thermal film at the places that decide: mirror images agree, and no small change of the inputs makes a step."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.scuffing.inputs import Load, MicropittingCheck, ScuffingInputs
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.places import largest_over_face
from tests.solvers.scuffing.test_symmetries import mirrored
from tests.support.answers import differences, leaves
from tests.support.modified_pairs import random_pair
from tests.support.properties import seeds

EXACT = 1e-6
PARTS = r"^(?!(flash|contact_temperature|film|safety|hottest_path|micropitting|wear)\.)"
# The paper's feature line is a diagonal; its mirror image is the other one.
DIAGONAL = r"_at_psi$|feature_line|^micropitting\.local\.points"
PLACE = r"_at_(profile|face|psi)$|\.at_(psi|face)$"  # of two places that are equally bad the first is told
STEP = 0.01


def pair(random: np.random.Generator) -> ScuffingInputs:
    """Draw a pair with a short path and a Ree-Eyring film, with a check against micropitting and wear."""
    check = MicropittingCheck(permissible_ratio=0.3, wear_coefficient=1e-18)
    return replace(random_pair(random), film=ehl.Model(), path_points=5, micropitting=check)


def exchanged(inputs: ScuffingInputs) -> ScuffingInputs:
    """Return the pair with its wheel as the driver: the path leads from E to A, and the other end meshes first."""
    given = inputs.distribution
    gears, shape = given.gears, given.modifications
    ratio = gears.wheel.teeth / gears.pinion.teeth
    slopes = ("profile_slope", "in_plane_deviation", "out_of_plane_deviation", "helix_slope")
    return replace(
        inputs,
        distribution=replace(
            given,
            gears=replace(gears, pinion=gears.wheel, wheel=gears.pinion),
            load=Load(given.load.torque * ratio, given.load.pinion_speed / ratio),
            modifications=replace(
                shape,
                tip_relief=shape.root_relief,
                root_relief=shape.tip_relief,
                **{name: -getattr(shape, name) for name in slopes},
            ),
        ),
    )


@seeds(15, 300)
def test_a_spur_pair_and_its_mirror_image(random: np.random.Generator) -> None:
    inputs = pair(random)
    given = inputs.distribution
    inputs = replace(inputs, distribution=replace(given, gears=replace(given.gears, helix_angle=0.0)))
    one, other = solve_scuffing(inputs), solve_scuffing(replace(inputs, distribution=mirrored(inputs.distribution)))

    def turned(_: str, values: FloatArray, __: str | None) -> FloatArray:
        return values[:, ::-1] if values.ndim == 2 else values

    without = f"{PARTS}|{DIAGONAL}|{PLACE}"
    assert not differences(one, other, turned, tolerance=EXACT, without=without)


@seeds(15, 300)
def test_a_pair_whose_wheel_drives(random: np.random.Generator) -> None:
    inputs = pair(random)
    one, other = solve_scuffing(inputs), solve_scuffing(exchanged(inputs))
    before = leaves(one)

    def expected(name: str, _: FloatArray, __: str | None) -> FloatArray:
        swap = {"pinion": "wheel", "wheel": "pinion"}
        found = before[re.sub("pinion|wheel", lambda word: swap[word[0]], name)].values
        assert not isinstance(found, str)
        turned = found[::-1] if re.search(r"^(hottest_path|wear)\.", name) else found
        if name in ("hottest_path.psi", "wear.psi"):
            return 1.0 - turned
        return turned[:, ::-1] if turned.ndim == 2 else turned

    points = r"^micropitting\.(local|standard)\.points|^micropitting\.test\.|^hottest_path.status"
    approach = r"^safety\.standard\.(flash|integral)\."  # X_J and X_Q depend on which gear drives
    without = f"{PARTS}|{PLACE}|{points}|{approach}"
    assert not differences(one, other, expected, tolerance=EXACT, without=without)
    if one.hottest_path is not None and other.hottest_path is not None:
        assert one.hottest_path.status == other.hottest_path.status[::-1]
    ratios = [{each.point: each.ratio for each in found.micropitting.local.points} for found in (one, other)]
    image = {"A": "E", "AB": "DE", "B": "D", "C": "C", "D": "B", "DE": "AB", "E": "A"}
    for point, ratio in ratios[0].items():
        assert ratios[1][image[point]] == (None if ratio is None else pytest.approx(ratio, rel=EXACT)), point


def test_the_worst_place_over_the_face_is_found_where_the_load_has_a_kink() -> None:
    """A place found before, equal to one of the refinement but for rounding, ended the search 2e-5 of the face away."""
    face = np.linspace(0.0, 1.0, 101)
    for kink in np.random.default_rng(56).uniform(size=100).tolist():

        def load(_: FloatArray, y: FloatArray, kink: float = kink) -> FloatArray:
            return 1.0 - np.where(y > kink, 1.0, 0.1) * np.abs(y - kink)

        found_before = int(kink * 51200) / 51200
        assert largest_over_face(face, [found_before], load)(0.0) == pytest.approx(kink, abs=1e-9), kink


SWEPT = ("helix_slope", "lead_crowning", "torque")


def neighbours(random: np.random.Generator, count: int) -> list[ScuffingInputs]:
    """Return a pair at `count` values, 0.1 % apart, of helix slope, lead crowning or torque."""
    inputs, swept = pair(random), random.choice(SWEPT)
    given, factors = inputs.distribution, 1.001 ** np.arange(count)
    if swept == "torque":
        loads = [Load(given.load.torque * factor, given.load.pinion_speed) for factor in factors.tolist()]
        return [replace(inputs, distribution=replace(given, load=load)) for load in loads]
    amount = random.uniform(5e-6, 40e-6)
    shapes = [replace(given.modifications, **{swept: amount * factor}) for factor in factors.tolist()]
    return [replace(inputs, distribution=replace(given, modifications=shape)) for shape in shapes]


def steps(answers: list[Scuffing]) -> list[str]:
    """Return a text for every number that moves by more than `STEP` from one answer to the next."""
    told = []
    for one, other in pairwise(answers):
        for part, name in (
            ("film", "thickness_ratio"),
            ("film", "thermal_ehl_min"),
            ("flash", "thermal_ehl_max"),
            ("safety", "thermal_ehl_factor"),
            ("micropitting.local", "thermal_ehl_ratio"),
        ):
            values = [leaves(each)[f"{part}.{name}"].values for each in (one, other)]
            if str(values[0]) == "None" == str(values[1]):
                continue
            first, second = (float(np.ravel(value)[0]) for value in values)
            if not abs(second / first - 1.0) <= STEP:
                told.append(f"{part}.{name}: {first:.6g} and {second:.6g}")
    return told


@seeds(1, 100)
def test_neighbours_are_nearly_alike(random: np.random.Generator) -> None:
    answers = [solve_scuffing(each) for each in neighbours(random, 3)]
    if answers[0].film is None or answers[0].film.thermal_ehl_min is None:
        raise InvalidInput("unsolved", "a contact of the pair is not solved")
    assert not steps(answers)
