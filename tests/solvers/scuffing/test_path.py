"""A thermal path is its points, whatever their number and direction; a path with gaps gives no verdict."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.published.xue import PAPER_LOAD, paper_pair
from solvers.scuffing.inputs import (
    LoadDistributionInputs,
    ScuffingInputs,
    Temperatures,
)
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.thermal_path import contact_at
from tests.support.modified_pairs import (
    PATH_POINTS,
    check_path,
    points_of,
    random_pair,
    relieved_pair,
    search_paths,
    turbo_pair,
    with_points,
)
from tests.support.stored import stored

SCUFFING = Temperatures(scuffing=573.15)
POINTS = [pytest.param(points, marks=() if points < 100 else pytest.mark.slow) for points in PATH_POINTS]
COARSE = ehl.Model(nodes=61, film_nodes=11, refine_mesh=False)


@pytest.mark.parametrize("points", POINTS)
def test_relieved_pair(points: int) -> None:
    """Once 48, 48, 271 and 3026 K; each point alone says 25.5 K."""
    result = check_path(relieved_pair(points), every=points // 5)
    assert result.flash.thermal_ehl_max == pytest.approx(25.5, abs=0.2)
    assert result.safety is not None
    assert result.safety.thermal_ehl_factor == pytest.approx(4.59, abs=0.03)


@pytest.mark.parametrize("slope", [pytest.param(0.0, marks=pytest.mark.slow), -20e-6, 20e-6])
@pytest.mark.parametrize("points", POINTS)
def test_turbo_pair(slope: float, points: int) -> None:
    """Once 77, 248 and 72 K for helix slopes 0, -20 and 20 um at 50 points."""
    result = check_path(with_points(turbo_pair(slope), points), every=points // 4)
    assert result.flash.thermal_ehl_max is not None
    assert 8.0 < result.flash.thermal_ehl_max < 17.0
    assert result.unsolved_points == 0


@pytest.mark.parametrize("seed", range(6))
def test_random_pairs(seed: int) -> None:
    check_path(with_points(random_pair(np.random.default_rng(seed)), 25), every=6)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_many_random_pairs_and_backwards(seed: int) -> None:
    """All points of 25, every eighth of 200."""
    inputs = random_pair(np.random.default_rng([2, seed]))
    try:
        result = check_path(inputs, every=inputs.path_points // 25)
    except InvalidInput:
        return
    check_backwards(inputs, result)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_search_draws_and_checks(seed: int) -> None:
    search_paths(np.random.default_rng([3, seed]))


def check_backwards(inputs: ScuffingInputs, result: Scuffing) -> None:
    """From E2 to A1 as from A1 to E2."""
    solved = [k for k, status in enumerate(result.path.status) if status in {"ok", "ok_with_warnings"}]
    points = points_of(inputs, result)
    backward = ehl.solve_path([contact_at(inputs, points, k) for k in reversed(solved)])
    assert result.path.thermal is not None
    for k, along in zip(reversed(solved), backward, strict=True):
        if along.status == "no_solution":
            continue
        assert along.temperature is not None
        assert along.film.minimum == pytest.approx(result.path.thermal.minimum_film[k], rel=0.01)
        assert along.temperature.surface_1_flash == pytest.approx(
            result.path.thermal.pinion_flash[k], rel=0.01, abs=0.5
        )


@pytest.mark.parametrize("inputs", stored(ScuffingInputs, "scuffing", "path taken backwards"))
def test_direction_does_not_matter(inputs: ScuffingInputs) -> None:
    coarse = with_points(inputs, 25)
    check_backwards(coarse, solve_scuffing(coarse))


@pytest.mark.parametrize("inputs", stored(ScuffingInputs, "scuffing", "twice the points"))
def test_number_of_points_does_not_decide(inputs: ScuffingInputs) -> None:
    """Twice the points move no summary number by more than 1 %: the formulas' extremes are among them."""
    check_number_of_points(inputs)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(30))
def test_number_of_points_does_not_decide_for_many(seed: int) -> None:
    check_number_of_points(random_pair(np.random.default_rng([4, seed])))


def check_number_of_points(inputs: ScuffingInputs) -> None:
    """25 against 50 points."""
    try:
        one, other = (solve_scuffing(with_points(inputs, points)) for points in (25, 50))
    except InvalidInput:
        return
    assert one.flash.blok_max == pytest.approx(other.flash.blok_max, rel=1e-3)
    assert one.film.dowson_higginson_min == pytest.approx(other.film.dowson_higginson_min, rel=1e-3)
    if one.unsolved_points or other.unsolved_points:
        return
    assert one.flash.thermal_ehl_max == pytest.approx(other.flash.thermal_ehl_max, rel=0.01, abs=0.1), inputs
    assert one.film.thermal_ehl_min == pytest.approx(other.film.thermal_ehl_min, rel=0.01), inputs


def test_a_path_with_unsolved_points_gives_no_verdict() -> None:
    """80 instead of 0.08 Pa s: once S 1.84 and full film from the other 20 of 50 points."""
    inputs = replace(relieved_pair(8), lubricant=Lubricant(viscosity=80.0), film=COARSE)
    result = solve_scuffing(inputs)
    missing = result.path.status.count("no_solution") + result.path.status.count("refused")
    assert 0 < missing == result.unsolved_points
    assert_no_verdict(result)
    (warning,) = [warning for warning in result.warnings if warning.code == "unsolved_points"]
    assert f"{result.path.status.count('no_solution')} of {len(result.path.status)} points" in warning.message
    assert result.flash.blok_max is not None
    assert result.film.dowson_higginson_min is not None


def assert_no_verdict(result: Scuffing) -> None:
    """Nothing of the thermal solution is stated of the whole path."""
    assert (result.flash.thermal_ehl_max, result.flash.thermal_ehl_at_psi) == (None, None)
    assert result.contact_temperature.thermal_ehl_max is None
    film = result.film
    assert (film.thermal_ehl_min, film.min_at_psi, film.thickness_ratio, film.thickness_regime) == (None,) * 4
    assert result.safety is None or result.safety.thermal_ehl_factor is None


def test_a_refused_point_counts_and_takes_the_verdict() -> None:
    """At 9.5 times the torque the Hertzian pressure passes 4 GPa over part of the path."""
    strong = paper_pair(1)
    strong = replace(strong, load=replace(strong.load, pinion_torque=9.5 * strong.load.pinion_torque))
    result = solve_scuffing(ScuffingInputs(strong, temperatures=SCUFFING, film=COARSE, path_points=11))
    assert "no_solution" not in result.path.status
    assert result.unsolved_points == result.path.status.count("refused") > 0
    assert_no_verdict(result)


def test_a_point_too_light_to_matter_keeps_the_verdict() -> None:
    """200 points of the relieved pair: one carries next to nothing, and more load would not make it the hottest."""
    result = solve_scuffing(replace(relieved_pair(200), film=COARSE))
    assert result.path.status.count("refused") == result.unsolved_points > 0
    assert result.flash.thermal_ehl_max is not None
    assert result.safety is not None
    assert result.safety.thermal_ehl_factor is not None
    assert "unsolved_points" not in {warning.code for warning in result.warnings}
    assert "load_range" in {warning.code for warning in result.warnings}


def test_lightest_load_is_the_edge_of_what_is_refused() -> None:
    inputs = ehl.LineContactInputs(ehl.Contact(1.0, 4e-3, 1.0, 3.7))
    edge = ehl.lightest(inputs)
    ehl.check(edge)
    with pytest.raises(InvalidInput) as refusal:
        ehl.check(replace(edge, contact=replace(edge.contact, line_load=0.99 * edge.contact.line_load)))
    assert refusal.value.code == "load_range"


@pytest.mark.parametrize("points", [10, 50, 100])
def test_a_path_that_reaches_a_base_circle_has_no_maximum(points: int) -> None:
    """12/60 teeth, undercut: once Blok safeties of 3.8, 2.4, 2.1 with 10, 50, 100 points."""
    gears = GearPairInputs(GearTeeth(12), GearTeeth(60), 2e-3, 20e-3, helix_angle=radians(15.0), rack_tip_radius=0.38)
    distribution = LoadDistributionInputs(gears, replace(PAPER_LOAD, pinion_torque=50.0))
    inputs = ScuffingInputs(distribution, temperatures=SCUFFING, lubrication="closed_form", path_points=points)
    result = solve_scuffing(inputs)
    assert (result.flash.blok_max, result.contact_temperature.blok_max) == (None, None)
    assert result.safety is not None
    assert result.safety.blok_factor is None
    assert "path_reaches_base_circle" in {warning.code for warning in result.warnings}
    assert result.unsolved_points > 0
