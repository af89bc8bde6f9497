"""A path has the thermal solution of its single points, and no verdict if unsolved points might change the verdict."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from benchmarks.published.xue import PAPER_LOAD, paper_pair
from solvers.contact import ehl
from solvers.contact.ehl import continuation, path
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Modifications,
    ScuffingInputs,
    Temperatures,
    angular_speed,
)
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.thermal_path import contact_at
from tests.support import modified_pairs
from tests.support.changes import changed
from tests.support.gear_pairs import UNDERCUT_PAIR, with_torque
from tests.support.outcomes import codes, refused
from tests.support.properties import first
from tests.support.stored import stored

SCUFFING = Temperatures(scuffing=573.15, bulk=360.0, bulk_method="given")
MARKS = {25: (), 50: pytest.mark.ci}
POINTS = [pytest.param(points, marks=MARKS.get(points, pytest.mark.slow)) for points in modified_pairs.PATH_POINTS]
COARSE = ehl.Model(nodes=61, film_nodes=11)
AS_GIVEN = replace(COARSE, refine_mesh=False)
STRONG = with_torque(paper_pair(1), 9.5 * paper_pair(1).load.pinion_torque)
"""Pair 1 under a torque at which the Hertzian pressure exceeds 4 GPa at some, but not all, points of the path."""


@pytest.mark.parametrize("points", POINTS)
def test_relieved_pair(points: int) -> None:
    """The largest flash temperature is 25.5 K, both along the path and at points that are solved alone."""
    # An earlier version gave 48, 48, 271 and 3026 K on paths of 25, 50, 100 and 200 points.
    result = modified_pairs.check_path(modified_pairs.relieved_pair(points), every=points // 5)
    assert result.flash.thermal_ehl_max == pytest.approx(25.5, abs=0.2)
    assert result.safety.thermal_ehl_factor == pytest.approx(4.59, abs=0.03)


@pytest.mark.parametrize("slope", first(1, [-20e-6, 20e-6, 0.0]))
@pytest.mark.parametrize("points", POINTS)
def test_turbo_pair(slope: float, points: int) -> None:
    """The largest flash temperature is between 8 and 17 K."""
    # An earlier version gave 77, 248 and 72 K for helix slopes of 0, -20 and 20 um on paths of 50 points.
    result = modified_pairs.check_path(replace(modified_pairs.turbo_pair(slope), path_points=points), every=points // 4)
    assert 8.0 < result.flash.thermal_ehl_max < 17.0
    assert result.unsolved_points == 0


@pytest.mark.parametrize("seed", first(2, range(6)))
def test_random_pairs(seed: int) -> None:
    drawn = modified_pairs.random_pair(np.random.default_rng(seed))
    modified_pairs.check_path(replace(drawn, path_points=25, line="feature_line"), every=6)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_many_random_pairs_and_backwards(seed: int) -> None:
    """About 25 points of every path are compared with the same points solved alone."""
    # Then the path is solved backwards.
    inputs = modified_pairs.random_pair(np.random.default_rng([2, seed]))
    try:
        result = modified_pairs.check_path(inputs, every=inputs.path_points // 25)
    except InvalidInput:
        return
    check_backwards(inputs, result)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_search_draws_and_checks(seed: int) -> None:
    modified_pairs.search_paths(np.random.default_rng([3, seed]))


def check_backwards(inputs: ScuffingInputs, result: Scuffing) -> None:
    """Check that films and flash temperatures are the same from E2 to A1 as from A1 to E2."""
    solved = [k for k, status in enumerate(result.path.status) if status in {"ok", "ok_with_warnings"}]
    points = modified_pairs.points_of(inputs, result)
    backward = ehl.solve_path([contact_at(inputs, points, k) for k in reversed(solved)])
    for k, along in zip(reversed(solved), backward, strict=True):
        if along.status == "no_solution":
            continue
        assert along.film.minimum == pytest.approx(result.path.thermal.minimum_film[k], rel=0.01)
        flash = result.path.thermal.pinion_flash[k]
        assert along.temperature.surface_1_flash == pytest.approx(flash, rel=0.01, abs=0.5)


@pytest.mark.parametrize("inputs", stored(ScuffingInputs, "scuffing", "path taken backwards"))
def test_direction_does_not_matter(inputs: ScuffingInputs) -> None:
    coarse = replace(inputs, path_points=25)
    check_backwards(coarse, solve_scuffing(coarse))


@pytest.mark.parametrize("inputs", first(1, stored(ScuffingInputs, "scuffing", "twice the points")))
def test_number_of_points_does_not_decide(inputs: ScuffingInputs) -> None:
    """Twice as many points change no summary number by more than 1 % or 0.1 K."""
    # The reason is that every path contains the points at which the closed formulas have their extremes.
    check_number_of_points(inputs)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(30))
def test_number_of_points_does_not_decide_for_many(seed: int) -> None:
    check_number_of_points(modified_pairs.random_pair(np.random.default_rng([4, seed])))


def check_number_of_points(inputs: ScuffingInputs) -> None:
    """Check that paths of 25 and of 50 points have the same largest flash temperatures and the same thinnest films."""
    try:
        one, other = (solve_scuffing(replace(inputs, path_points=points)) for points in (25, 50))
    except InvalidInput:
        return
    assert one.flash.blok_max == pytest.approx(other.flash.blok_max, rel=1e-3)
    assert one.film.dowson_higginson_min == pytest.approx(other.film.dowson_higginson_min, rel=1e-3)
    if one.unsolved_points or other.unsolved_points:
        return
    assert one.flash.thermal_ehl_max == pytest.approx(other.flash.thermal_ehl_max, rel=0.01, abs=0.1), inputs
    assert one.film.thermal_ehl_min == pytest.approx(other.film.thermal_ehl_min, rel=0.01), inputs


def test_a_path_with_unsolved_points_gives_no_verdict() -> None:
    """With an oil of 80 Pa s instead of 0.08 Pa s, some points have no solution, and the path has no safety factor."""
    # An earlier version solved only 20 of 50 points, and still stated a safety factor of 1.84 and a full film.
    inputs = replace(modified_pairs.relieved_pair(8), lubricant=Lubricant(viscosity=80.0), film=AS_GIVEN)
    result = solve_scuffing(inputs)
    missing = result.path.status.count("no_solution") + result.path.status.count("refused")
    assert 0 < missing <= result.unsolved_points
    assert_no_verdict(result)
    (warning,) = [warning for warning in result.warnings if warning.code == "unsolved_points"]
    unsolved, outside = map(int, re.findall(r"(\d+) of \d+ points have no solution and (\d+) are", warning.message)[0])
    assert unsolved + outside == result.unsolved_points
    assert result.flash.blok_max is not None
    assert result.film.dowson_higginson_min is not None


def assert_no_verdict(result: Scuffing) -> None:
    """Check that thermal EHL states no maximum, no thinnest film and no safety factor of the whole path."""
    flash, film = result.flash, result.film
    assert (flash.thermal_ehl_max, flash.thermal_ehl_at_psi, result.contact_temperature.thermal_ehl_max) == (None,) * 3
    assert (film.thermal_ehl_min, film.min_at_psi, film.thickness_ratio, film.thickness_regime) == (None,) * 4
    assert result.safety is None or result.safety.thermal_ehl_factor is None


def test_a_refused_point_counts_and_takes_the_verdict() -> None:
    result = solve_scuffing(
        ScuffingInputs(
            STRONG, temperatures=SCUFFING, film=AS_GIVEN, path_points=11, lubricant=Lubricant(), friction="given"
        )
    )
    assert "no_solution" not in result.path.status
    assert result.unsolved_points >= result.path.status.count("refused") > 0
    assert_no_verdict(result)


def test_a_point_too_light_to_matter_keeps_the_verdict() -> None:
    """Of 200 points of the relieved pair, a point with almost no load is refused."""
    # Even under the least permissible load, this point would not be the hottest, so that the path keeps its safety
    # factor.
    result = solve_scuffing(replace(modified_pairs.relieved_pair(200), film=AS_GIVEN))
    assert result.path.status.count("refused") == result.unsolved_points > 0
    assert result.flash.thermal_ehl_max is not None
    assert result.safety.thermal_ehl_factor is not None
    assert "unsolved_points" not in codes(result)
    assert "load_range" in codes(result)


def test_lightest_load_is_the_edge_of_what_is_refused() -> None:
    inputs = ehl.LineContactInputs(ehl.Contact(1.0, 4e-3, 1.0, 3.7), lubricant=Lubricant())
    edge = ehl.lightest(inputs)
    ehl.check(edge)
    lighter = changed(edge, {"contact.line_load": 0.99 * edge.contact.line_load})
    assert refused(ehl.check, lighter)[0] == "load_range"


@pytest.mark.parametrize("points", [10, 50, 100])
def test_a_path_that_reaches_a_base_circle_has_no_maximum(points: int) -> None:
    """The undercut pair with 12 and 60 teeth has no largest flash temperature and no safety factor."""
    # An earlier version gave safety factors by Blok of 3.8, 2.4 and 2.1 on paths of 10, 50 and 100 points.
    distribution = LoadDistributionInputs(UNDERCUT_PAIR, replace(PAPER_LOAD, pinion_torque=50.0))
    inputs = ScuffingInputs(
        distribution,
        temperatures=SCUFFING,
        lubrication="closed_form",
        path_points=points,
        lubricant=Lubricant(),
        friction="given",
    )
    result = solve_scuffing(inputs)
    assert (result.flash.blok_max, result.contact_temperature.blok_max) == (None, None)
    assert result.safety.blok_factor is None
    assert "path_reaches_base_circle" in codes(result)
    assert result.unsolved_points > 0


# The thermal solution along the path of pair 1


def inputs(pair: int = 1, points: int = 21, **changes: object) -> ScuffingInputs:
    return replace(
        ScuffingInputs(
            paper_pair(pair),
            film=COARSE,
            path_points=points,
            lubricant=Lubricant(),
            friction="given",
            temperatures=Temperatures(bulk=360.0, bulk_method="given"),
        ),
        **changes,
    )


@pytest.fixture(scope="module")
def pair_1() -> Scuffing:
    return solve_scuffing(inputs())


@cache
def strong() -> Scuffing:
    return solve_scuffing(inputs(distribution=STRONG))


def numbers(result: Scuffing) -> np.ndarray:
    path = result.path.thermal
    return np.array((path.pinion_flash, path.wheel_flash, path.minimum_film, path.friction_coefficient))


def test_every_point_is_solved_and_formulas_stand_beside_the_solution_unchanged(pair_1: Scuffing) -> None:
    assert pair_1.unsolved_points == 0
    assert set(pair_1.path.status) <= {"ok", "ok_with_warnings"}
    assert np.isfinite(numbers(pair_1)).all()
    formulas = solve_scuffing(inputs(lubrication="closed_form"))
    assert pair_1.path.blok_flash == pytest.approx(formulas.path.blok_flash, rel=1e-15)
    assert pair_1.path.dowson_higginson == pytest.approx(formulas.path.dowson_higginson, rel=1e-15)
    assert pair_1.flash.blok_max == formulas.flash.blok_max
    assert (formulas.flash.thermal_ehl_max, formulas.path.thermal) == (None, None)


def test_film_is_thinnest_and_flash_highest_at_the_pinion_root_and_the_slower_flank_the_hotter(
    pair_1: Scuffing,
) -> None:
    thermal = pair_1.path.thermal
    # the paper: "h_min of the TEHL is below Dowson's"
    assert (thermal.minimum_film < pair_1.path.dowson_higginson).all()
    assert pair_1.film.min_at_psi == pair_1.flash.thermal_ehl_at_psi == 0.0
    sliding = pair_1.distribution.feature_line.sliding[[0, -1]]
    assert sliding[0] < 0.0 < sliding[1]
    assert thermal.pinion_flash[0] > thermal.wheel_flash[0]
    assert thermal.pinion_flash[-1] < thermal.wheel_flash[-1]


def test_maxima_and_safety_follow_from_the_path() -> None:
    """The largest contact temperature is the bulk temperature plus the largest flash temperature (Xue Eq. 16)."""
    temperatures = Temperatures(scuffing=433.15, bulk=360.0, bulk_method="given")
    result = solve_scuffing(inputs(temperatures=temperatures))
    largest = max(result.path.thermal.pinion_flash.max(), result.path.thermal.wheel_flash.max())
    assert result.flash.thermal_ehl_max == largest
    assert result.contact_temperature.thermal_ehl_max == temperatures.bulk + largest
    expected = (433.15 - temperatures.oil) / (temperatures.bulk + largest - temperatures.oil)
    assert result.safety.thermal_ehl_factor == pytest.approx(expected, rel=1e-12)


def test_a_point_of_the_path_is_the_contact_solved_alone(pair_1: Scuffing) -> None:
    line, middle = pair_1.distribution.feature_line, 4
    point = int(np.flatnonzero(np.isclose(line.psi, pair_1.path.psi[middle]))[0])
    at = (float(curve[point]) for curve in (line.line_load, line.radius, line.pinion_speed, line.wheel_speed))
    contact = ehl.solve(ehl.LineContactInputs(ehl.Contact(*at), model=COARSE, lubricant=Lubricant()))
    # the path shares one mesh, graded for its mean film: 61 nodes cost up to 4 % against another grading
    assert contact.film.minimum == pytest.approx(pair_1.path.thermal.minimum_film[middle], rel=0.04)


def test_unloaded_points_have_no_numbers_and_do_not_disturb_the_others() -> None:
    result = solve_scuffing(inputs(distribution=paper_pair(4, Modifications(helix_slope=150e-6))))
    unloaded = np.array(result.path.status) == "unloaded"
    assert unloaded.any()
    assert not unloaded.all()
    assert np.isnan(numbers(result)[:, unloaded]).all()
    assert np.isfinite(numbers(result)[:, ~unloaded]).all()
    assert "no_film" in codes(result)


def test_points_outside_the_solver_are_refused_one_by_one() -> None:
    status = np.array(strong().path.status)
    assert {"refused"} < set(status)
    assert np.isnan(numbers(strong())[:, status == "refused"]).all()


def test_an_oil_outside_the_law_is_refused_as_a_whole() -> None:
    with pytest.raises(InvalidInput, match="viscosity") as refusal:
        solve_scuffing(inputs(lubricant=Lubricant(viscosity=6e-5)))
    assert refusal.value.code == "viscosity_range"


def test_roughness_decides_the_thickness_ratio(pair_1: Scuffing) -> None:
    smooth = Solid(roughness=0.1e-6)
    result = solve_scuffing(inputs(distribution=replace(paper_pair(1), pinion_material=smooth, wheel_material=smooth)))
    assert result.film.thickness_ratio == pytest.approx(4.0 * (pair_1.film.thickness_ratio or 0.0), rel=1e-9)


def test_warnings_count_the_points_they_concern(pair_1: Scuffing) -> None:
    slow = [warning.message for warning in pair_1.warnings if warning.code == "low_peclet"]
    count = (pair_1.path.status + pair_1.hottest_path.status).count("ok_with_warnings")
    assert count > 0
    assert len(slow) == 1
    concerned, points = map(int, re.findall(r"^at (\d+) of (\d+) points", slow[0])[0])
    assert count <= concerned < points, "the points of both lines and the places that decide"


def compressor_gears(power: float, points: int = 11) -> ScuffingInputs:
    """Wide, fast pair with a thick film. Its module is 7 mm, its speed is 2000 1/min, and it transmits `power` [W]."""
    gears = GearPairInputs(GearTeeth(47), GearTeeth(117), 7e-3, 0.2, rack_tip_radius=0.38)
    speed = angular_speed(2000.0)
    distribution = LoadDistributionInputs(gears=gears, load=Load(power / speed, speed))
    return ScuffingInputs(
        distribution,
        film=COARSE,
        path_points=points,
        lubricant=Lubricant(),
        friction="given",
        temperatures=Temperatures(bulk=360.0, bulk_method="given"),
        line="feature_line",
    )


@pytest.mark.parametrize("power", [1e6, 1e5, 3e4])
def test_light_loads_are_solved(power: float) -> None:
    """Light loads are solved, although the film is up to about 10^4 times as thick as the deformation of the flanks."""
    result = solve_scuffing(compressor_gears(power))
    assert set(result.path.status) <= {"ok", "ok_with_warnings"}
    assert result.film.thermal_ehl_min > 2e-6


@pytest.mark.parametrize("power", [5e3, 1e3, 10.0])
def test_a_load_too_light_for_an_elastic_contact_is_refused(power: float) -> None:
    with pytest.raises(InvalidInput, match="raise the line load") as refusal:
        solve_scuffing(compressor_gears(power))
    assert (refusal.value.code, refusal.value.field) == ("load_range", "power")


@pytest.mark.parametrize(("pair", "count"), first(1, [(1, 7), (1, 19), (4, 19)]))
def test_torque_from_nominal_to_a_millionth(pair: int, count: int) -> None:
    """Large torques are solved, and all torques below a limit are refused as too light."""
    # If only some points of a path are refused, all other points have numbers.
    refusals: set[str] = set()
    nominal = paper_pair(pair)
    for factor in 10.0 ** np.linspace(0.0, -6.0, count):
        distribution = with_torque(nominal, nominal.load.pinion_torque * float(factor))
        try:
            result = solve_scuffing(inputs(points=7, distribution=distribution, line="feature_line"))
        except InvalidInput as refusal:
            refusals.add(refusal.code)
            continue
        assert not refusals
        status = np.array(result.path.status)
        assert set(status) <= {"ok", "ok_with_warnings", "refused"}
        assert np.isfinite(numbers(result)[:, status != "refused"]).all()
    assert refusals == {"load_range"}


def test_notices_name_the_input_of_the_gear_pair(pair_1: Scuffing) -> None:
    fields = {warning.code: warning.field for result in (pair_1, strong()) for warning in result.warnings}
    assert fields["low_peclet"] == "pinion_speed"
    assert fields["pressure_range"] == "power"


def test_temperature_out_of_range_names_the_bulk_temperature() -> None:
    cold = inputs(temperatures=Temperatures(bulk=180.0, bulk_method="given"))
    even = replace(cold, lubricant=Lubricant(temperature_viscosity=0.0))
    assert refused(solve_scuffing, even) == ("temperature_range", "temperatures.bulk")
    with pytest.raises(InvalidInput, match="at 180 K the law"):
        solve_scuffing(cold)


@pytest.mark.ci
def test_a_path_that_nowhere_converges_ends_with_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """With tolerances of zero no point converges."""
    # The first 12 points may take all the steps of a contact that is solved alone, and each further point may take a
    # tenth of these steps.
    monkeypatch.setattr(continuation, "TIGHT", (0.0, 0.0))
    monkeypatch.setattr(continuation, "LOOSE", (0.0, 0.0))
    taken: list[float] = []
    charge = continuation.Budget.charge

    def counted(given: continuation.Budget, resolution: continuation.Resolution, nodes: int, steps: int) -> None:
        taken.append(steps * continuation.price(resolution, nodes))
        charge(given, resolution, nodes, steps)

    monkeypatch.setattr(continuation.Budget, "charge", counted)
    result = solve_scuffing(inputs(points=40, line="feature_line"))
    assert set(result.path.status) == {"no_solution"}
    assert result.unsolved_points == 40
    assert sum(taken) < (path.HOPELESS + 28 * path.SHARE_WITHOUT_HOPE) * continuation.STEPS_IN_ALL
    assert "not_converged" in codes(result)
