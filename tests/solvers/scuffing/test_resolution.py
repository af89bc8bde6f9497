"""The results of a load distribution do not depend on its resolution, do not jump, and agree with each other."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import radians

import numpy as np
import pytest

from benchmarks.published.xue import paper_gears, paper_pair
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import PathOfContact, meshing_path
from solvers.scuffing.inputs import LoadDistributionInputs, Model, Modifications, Resolution
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.modification import gap
from tests.support import flanks
from tests.support.gear_pairs import with_torque
from tests.support.properties import first
from tests.support.stored import stored

CASES = [
    *first(1, ([1, case] for case in range(5))),
    *(pytest.param([2, case], marks=pytest.mark.slow) for case in range(60)),
]


@pytest.mark.parametrize("case", CASES, ids=str)
@pytest.mark.parametrize("check", flanks.SEARCHES)
def test_random_flanks(check: flanks.Check, case: list[int]) -> None:
    check(np.random.default_rng(case))


@pytest.mark.parametrize(
    ("name", "check"),
    [
        # Where lines are loaded in part a first look erred by more than two peaks differ.
        ("two peaks over the face", flanks.check_books_of),
        # It was taken at the kink, and the mesh was 3 % too stiff on 100 slices.
        ("least gap within half a slice of a kink", flanks.check_resolution_of),
        # Between roll positions its line loads are interpolated to 2 %.
        ("largest line load of a light contact", flanks.check_books_of),
    ],
)
def test_flanks_that_once_failed(name: str, check: Callable[[LoadDistributionInputs], None]) -> None:
    check(*stored(LoadDistributionInputs, "scuffing", name))


PEAKED = {
    "roof over the face": (238.0, Modifications(end_relief=1e-3, end_relief_length=10e-3)),
    "sharp lead crowning": (1.0, Modifications(lead_crowning=1e-3)),
    "sharp profile crowning": (1.0, Modifications(profile_crowning=1e-3)),
    "ball": (1.0, Modifications(profile_crowning=1e-3, lead_crowning=1e-3)),
    "edge": (1.0, Modifications(helix_slope=1e-3)),
    "steep start of relief": (1.0, Modifications(tip_relief=50e-6, root_relief=50e-6, relief_exponent=0.5)),
}


@pytest.mark.parametrize("helix", [0.0, 9.8])
@pytest.mark.parametrize(("torque", "shape"), PEAKED.values(), ids=PEAKED.keys())
def test_peaked_flanks_have_their_maxima_with_few_slices(torque: float, shape: Modifications, helix: float) -> None:
    inputs = with_torque(paper_pair(1, shape, Model()), torque)
    inputs = replace(inputs, gears=replace(inputs.gears, helix_angle=radians(helix)))
    few, many = (
        flanks.summary(solve_load_distribution(replace(inputs, resolution=Resolution(count, count // 2, 21, points))))
        for count, points in ((100, 51), (400, 401))
    )
    for name in ("max_line_load", "max_pressure", "face_load_factor", "contact_fraction"):
        assert few[name][0] == pytest.approx(many[name][0], rel=3e-3), name


def test_the_line_load_of_a_sharp_edge_in_closed_form() -> None:
    """A steep helix slope leaves a spur flank in contact only near one end of the face."""
    # The line load falls linearly from w at this end, and the force is F = w^2 / (2 k slope).
    slope = 1e-3 / 20e-3
    inputs = with_torque(paper_pair(1, Modifications(helix_slope=1e-3), Model(contact="linear")), 1.0)
    result = solve_load_distribution(replace(inputs, gears=replace(inputs.gears, helix_angle=0.0)))
    single = result.balance.survey.line_forces.max(axis=1) / result.balance.force > 1 - 1e-12
    # Where one pair carries all, its stiffness is what is in between; the largest is at the stiffest place.
    peak = result.balance.survey.peak_load
    table = result.balance.mesh.compliance
    stiffness = 1 / np.interp(peak.x[single] * table.points_per_metre, np.arange(table.constant.size), table.constant)
    expected = np.sqrt(2 * result.balance.force * stiffness * slope)
    assert peak.value[single] == pytest.approx(expected, rel=1e-4)
    assert np.all(peak.y[single] == 0.0)


# Jumps that were


def taller(addendum: float, helix: float = 20.2) -> GearPairInputs:
    teeth = [GearTeeth(count, addendum=addendum, dedendum=addendum + 0.3) for count in (40, 50)]
    return replace(paper_gears(3), pinion=teeth[0], wheel=teeth[1], helix_angle=radians(helix), rack_tip_radius=0.2)


@cache
def taller_paths() -> list[PathOfContact]:
    return [meshing_path(taller(float(addendum))) for addendum in np.linspace(0.45, 1.45, 4001)]


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_default_relief_lengths_are_continuous_in_the_contact_ratio(ratio: float) -> None:
    paths = [path for path in taller_paths() if abs(path.transverse_contact_ratio - ratio) < 0.05]
    assert paths[0].transverse_contact_ratio < ratio < paths[-1].transverse_contact_ratio
    lengths = [gap(Modifications(tip_relief=1e-6), path).tip_relief_length / path.length for path in paths]
    assert np.max(np.abs(np.diff(lengths))) < 5e-4


@pytest.mark.parametrize(
    ("ratio", "fraction"), [(0.9, 0.1), (1.05, 0.1), (1.5, 1 / 3), (1.9, 0.9 / 1.9), (2.1, 0.5), (2.3, 0.5)]
)
def test_default_relief_length(ratio: float, fraction: float) -> None:
    """The default length of a relief is (eps_alpha - 1) p_bt, but at least a tenth and at most half of the path."""
    path = meshing_path(paper_gears(1))
    cut = replace(path, end=path.start + ratio * path.pair.transverse_base_pitch)
    form = gap(Modifications(tip_relief=1e-6, root_relief=1e-6), cut)
    assert form.tip_relief_length == pytest.approx(fraction * cut.length, rel=1e-12)
    assert form.root_relief_length == form.tip_relief_length
