"""The thermal EHL solution along the path of contact of a gear pair."""

from dataclasses import replace

import numpy as np
import pytest

from solvers.contact import ehl
from solvers.contact.ehl import continuation, path
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.published.xue import paper_pair
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
from tests.support.gear_pairs import with_torque

COARSE = ehl.Model(nodes=61, film_nodes=11)


def inputs(pair: int = 1, points: int = 21, **changes: object) -> ScuffingInputs:
    return replace(ScuffingInputs(paper_pair(pair), film=COARSE, path_points=points), **changes)


@pytest.fixture(scope="module")
def pair_1() -> Scuffing:
    return solve_scuffing(inputs())


def numbers(result: Scuffing) -> np.ndarray:
    path = result.path.thermal
    assert path is not None
    return np.array((path.pinion_flash, path.wheel_flash, path.minimum_film, path.friction_coefficient))


def test_every_point_is_solved(pair_1: Scuffing) -> None:
    assert pair_1.unsolved_points == 0
    assert set(pair_1.path.status) <= {"ok", "ok_with_warnings"}
    assert np.isfinite(numbers(pair_1)).all()


def test_formulas_stand_beside_the_solution_unchanged(pair_1: Scuffing) -> None:
    formulas = solve_scuffing(inputs(lubrication="closed_form"))
    assert pair_1.path.blok_flash == pytest.approx(formulas.path.blok_flash, rel=1e-15)
    assert pair_1.path.dowson_higginson == pytest.approx(formulas.path.dowson_higginson, rel=1e-15)
    assert pair_1.flash.blok_max == formulas.flash.blok_max
    assert formulas.flash.thermal_ehl_max is None
    assert formulas.path.thermal is None


def test_thermal_film_is_thinner_than_the_formula_along_the_whole_path(pair_1: Scuffing) -> None:
    # the paper: "h_min of the TEHL is below Dowson's"
    assert pair_1.path.thermal is not None
    assert (pair_1.path.thermal.minimum_film < pair_1.path.dowson_higginson).all()


def test_film_is_thinnest_and_flash_highest_where_the_pinion_root_meets(pair_1: Scuffing) -> None:
    assert pair_1.film.min_at_psi == 0.0
    assert pair_1.flash.thermal_ehl_at_psi == 0.0


def test_the_slower_flank_is_the_hotter_one(pair_1: Scuffing) -> None:
    assert pair_1.path.thermal is not None
    sliding = pair_1.distribution.feature_line.sliding[[0, -1]]
    assert sliding[0] < 0.0 < sliding[1]
    assert pair_1.path.thermal.pinion_flash[0] > pair_1.path.thermal.wheel_flash[0]
    assert pair_1.path.thermal.pinion_flash[-1] < pair_1.path.thermal.wheel_flash[-1]


def test_maxima_and_safety_follow_from_the_path() -> None:
    """Xue Eq. 16."""
    temperatures = Temperatures(scuffing=433.15)
    result = solve_scuffing(inputs(temperatures=temperatures))
    assert result.path.thermal is not None
    largest = max(result.path.thermal.pinion_flash.max(), result.path.thermal.wheel_flash.max())
    assert result.flash.thermal_ehl_max == largest
    assert result.contact_temperature.thermal_ehl_max == temperatures.bulk + largest
    assert result.safety is not None
    expected = (433.15 - temperatures.oil) / (temperatures.bulk + largest - temperatures.oil)
    assert result.safety.thermal_ehl_factor == pytest.approx(expected, rel=1e-12)


def test_a_point_of_the_path_is_the_contact_solved_alone(pair_1: Scuffing) -> None:
    given, middle = inputs(), 4
    alone = solve_scuffing(given)
    line = alone.distribution.feature_line
    point = int(np.flatnonzero(np.isclose(line.psi, pair_1.path.psi[middle]))[0])
    contact = ehl.solve(
        ehl.LineContactInputs(
            ehl.Contact(
                float(line.line_load[point]),
                float(line.radius[point]),
                float(line.pinion_speed[point]),
                float(line.wheel_speed[point]),
            ),
            model=COARSE,
        )
    )
    assert pair_1.path.thermal is not None
    # the path shares one mesh, graded for its mean film: 61 nodes cost up to 4 % against another grading
    assert contact.film.minimum == pytest.approx(pair_1.path.thermal.minimum_film[middle], rel=0.04)


def test_unloaded_points_have_no_numbers_and_do_not_disturb_the_others() -> None:
    lead = Modifications(helix_slope=150e-6)
    distribution = replace(paper_pair(4), modifications=lead)
    result = solve_scuffing(inputs(distribution=distribution))
    status = np.array(result.path.status)
    unloaded = status == "unloaded"
    assert unloaded.any()
    assert not unloaded.all()
    assert np.isnan(numbers(result)[:, unloaded]).all()
    assert np.isfinite(numbers(result)[:, ~unloaded]).all()
    assert "no_film" in {warning.code for warning in result.warnings}


def test_points_outside_the_solver_are_refused_one_by_one() -> None:
    # at 9.5 times the torque the Hertzian pressure passes 4 GPa over part of the path only
    strong = paper_pair(1)
    strong = replace(strong, load=replace(strong.load, pinion_torque=9.5 * strong.load.pinion_torque))
    result = solve_scuffing(inputs(distribution=strong))
    status = np.array(result.path.status)
    assert {"refused"} < set(status)
    assert np.isnan(numbers(result)[:, status == "refused"]).all()
    assert "pressure_range" in {warning.code for warning in result.warnings}


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
    count = pair_1.path.status.count("ok_with_warnings")
    assert count > 0
    assert slow == [message for message in slow if message.startswith(f"at {count} of 21 points")]
    assert len(slow) == 1


def compressor_gears(power: float, points: int = 11) -> ScuffingInputs:
    """A wide pair of module 7 mm at 2000 1/min under `power` [W]: fast, with a thick film."""
    gears = GearPairInputs(GearTeeth(47), GearTeeth(117), 7e-3, 0.2, rack_tip_radius=0.38)
    speed = angular_speed(2000.0)
    distribution = LoadDistributionInputs(gears=gears, load=Load(power / speed, speed))
    return ScuffingInputs(distribution, film=COARSE, path_points=points)


@pytest.mark.parametrize("power", [1e6, 1e5, 3e4])
def test_light_loads_are_solved(power: float) -> None:
    """Films up to 10^4 times the deformation; the lighter the load, the thicker."""
    result = solve_scuffing(compressor_gears(power))
    assert set(result.path.status) <= {"ok", "ok_with_warnings"}
    assert result.film.thermal_ehl_min is not None
    assert result.film.thermal_ehl_min > 2e-6


@pytest.mark.parametrize("power", [5e3, 1e3, 10.0])
def test_a_load_too_light_for_an_elastic_contact_is_refused(power: float) -> None:
    with pytest.raises(InvalidInput, match="raise the line load") as refusal:
        solve_scuffing(compressor_gears(power))
    assert (refusal.value.code, refusal.value.field) == ("load_range", "power")


@pytest.mark.parametrize("pair", [1, 4])
def test_torque_from_nominal_to_a_millionth(pair: int) -> None:
    """Every load is solved or refused as too light, in this order; a path of both has numbers where it is solved."""
    codes: set[str] = set()
    nominal = paper_pair(pair)
    for factor in 10.0 ** np.linspace(0.0, -6.0, 19):
        distribution = with_torque(nominal, nominal.load.pinion_torque * float(factor))
        try:
            result = solve_scuffing(inputs(points=7, distribution=distribution))
        except InvalidInput as refusal:
            codes.add(refusal.code)
            continue
        assert not codes
        status = np.array(result.path.status)
        assert set(status) <= {"ok", "ok_with_warnings", "refused"}
        assert np.isfinite(numbers(result)[:, status != "refused"]).all()
    assert codes == {"load_range"}


def test_notices_name_the_input_of_the_gear_pair(pair_1: Scuffing) -> None:
    strong = paper_pair(1)
    refused = solve_scuffing(inputs(distribution=with_torque(strong, 9.5 * strong.load.pinion_torque)))
    fields = {warning.code: warning.field for result in (pair_1, refused) for warning in result.warnings}
    assert fields["low_peclet"] == "pinion_speed"
    assert fields["pressure_range"] == "power"


def test_temperature_out_of_range_names_the_bulk_temperature() -> None:
    with pytest.raises(InvalidInput) as refusal:
        solve_scuffing(inputs(temperatures=Temperatures(bulk=180.0), lubricant=Lubricant(temperature_viscosity=0.0)))
    assert (refusal.value.code, refusal.value.field) == ("temperature_range", "temperatures.bulk")
    with pytest.raises(InvalidInput, match="Pa s at 180 K"):
        solve_scuffing(inputs(temperatures=Temperatures(bulk=180.0)))


def test_a_path_that_nowhere_converges_ends_with_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tolerances that cannot be met: a few points take all the steps of a contact alone, the others a tenth of them."""
    monkeypatch.setattr(continuation, "TIGHT", (0.0, 0.0))
    monkeypatch.setattr(continuation, "LOOSE", (0.0, 0.0))
    taken: list[float] = []
    charge = continuation.Budget.charge

    def counted(given: continuation.Budget, resolution: continuation.Resolution, nodes: int, steps: int) -> None:
        taken.append(steps * continuation.price(resolution, nodes))
        charge(given, resolution, nodes, steps)

    monkeypatch.setattr(continuation.Budget, "charge", counted)
    result = solve_scuffing(inputs(points=40))
    assert set(result.path.status) == {"no_solution"}
    assert result.unsolved_points == 40
    assert sum(taken) < (path.HOPELESS + 28 * path.SHARE_WITHOUT_HOPE) * continuation.STEPS_IN_ALL
    assert "not_converged" in {warning.code for warning in result.warnings}
