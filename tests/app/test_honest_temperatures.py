"""Temperatures behave as physics does, for random pairs: no step over the speed, more heat is not cooler."""

from collections.abc import Callable
from functools import cache
from math import sqrt
from typing import Any

import numpy as np
import pytest

from app.errors import Unprocessable
from app.evaluate import answer
from solvers.errors import InvalidInput
from tests.support.fast_pairs import random_request
from tests.support.properties import seeds
from tests.support.requests import GONE, changed, example

SCUFFING = "/v1/scuffing"
DRY = {"model.lubrication": "closed_form", "detail": "summary"}
STEPS = 1e-3  # ratio of neighbouring speeds less one


def pair(random: np.random.Generator, **cooling: Any) -> dict[str, Any]:
    """Return a random pair in oil whose bulk temperature follows the rule."""
    request = changed(random_request(random), {"temperatures.bulk_method": GONE})
    return {**request, "cooling": {**request["cooling"], **cooling}}


def solved(request: dict[str, Any], changes: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return the answer; a refused or unsolved draw is one that the property says nothing about."""
    try:
        found = answer(SCUFFING, changed(request, changes or {}))
    except Unprocessable as error:
        raise InvalidInput(error.code, error.message) from error
    if found["status"] == "no_solution" or found["safety"] is None or found["safety"]["blok_factor"] is None:
        raise InvalidInput("no_solution", "nothing to compare")
    return found


def bulk(found: dict[str, Any]) -> float:
    return float(found["contact_temperature"]["bulk_c"])


def velocity_per_rpm(request: dict[str, Any]) -> float:
    gears = request["gears"]
    diameter = gears["module_mm"] * gears["pinion"]["teeth"] / np.cos(np.radians(gears["helix_angle_deg"]))
    return float(np.pi * diameter / 6e4)


def at_constant_torque(request: dict[str, Any]) -> Callable[[float], dict[str, Any]]:
    """Return a function of the pitch-line velocity [m/s] that solves the request with the torque of its load."""
    torque = request["load"]["power_kw"] * 9549 / request["load"]["pinion_speed_rpm"]
    per_rpm = velocity_per_rpm(request)

    @cache
    def at(velocity: float) -> dict[str, Any]:
        return solved(request, {"load": {"pinion_torque_n_m": torque, "pinion_speed_rpm": velocity / per_rpm}})

    return at


@seeds(6, 50)
def test_no_step_over_the_speed(random: np.random.Generator) -> None:
    """Safety, bulk temperature and film ratio move by less than 1 % between speeds 0.1 % apart, 5 to 150 m/s."""
    at = at_constant_torque(changed(pair(random), {"cooling": GONE}))
    for velocity in [*np.exp(random.uniform(np.log(5.0), np.log(150.0), 4)), 20.0, 60.0]:
        before, after = (at(velocity * near) for near in (1.0 - STEPS / 2, 1.0 + STEPS / 2))
        for name, read in CONTINUOUS.items():
            low, high = read(before), read(after)
            assert abs(high - low) < 0.01 * abs(high), f"{name} at {velocity:.4g} m/s: {low:.6g}, {high:.6g}"


@seeds(1, 15)
def test_no_step_hides_between_two_speeds(random: np.random.Generator) -> None:
    """Where an interval of speeds is halved towards the larger change, again and again, the change vanishes."""
    at = at_constant_torque(changed(pair(random), {"cooling": GONE}))
    ends = np.geomspace(5.0, 150.0, 9).tolist()
    for place in random.choice(8, 2, replace=False):
        for name, read in CONTINUOUS.items():
            low, high = ends[place], ends[place + 1]
            while high / low > 1.0 + STEPS:
                middle = sqrt(low * high)
                changes = [abs(read(at(middle)) - read(at(end))) for end in (low, high)]
                low, high = (low, middle) if changes[0] >= changes[1] else (middle, high)
            before, after = read(at(low)), read(at(high))
            assert abs(after - before) < 0.01 * abs(after), f"{name} at {low:.6g} m/s: {before:.6g}, {after:.6g}"


CONTINUOUS = {
    "safety": lambda found: found["safety"]["blok_factor"],
    "bulk": bulk,
    "lambda": lambda found: found["film"]["thickness_ratio"],
    "safety at worst": lambda found: (
        found["heat"]["band"]["safety"][0]
        if found["heat"] and found["heat"]["band"] and found["heat"]["band"]["safety"]
        else found["safety"]["blok_factor"]
    ),
}


@seeds(3, 200)
def test_more_heat_is_not_cooler(random: np.random.Generator) -> None:
    """No heat that the user adds cools the contact: pumping, windage, other losses, friction."""
    request = changed(pair(random), {"cooling.band": False, "cooling.windage_w": GONE})
    found, power = solved(request), request["load"]["power_kw"]
    windage = (found["heat"] or {"losses": {"windage_w": 0.0}})["losses"]["windage_w"]
    added = {
        "cooling.pumping_w": request["cooling"].get("pumping_w", 0.0) + 5 * power,
        "cooling.other_w": request["cooling"].get("other_w", 0.0) + 5 * power,
        "cooling.windage_w": 2 * windage + 1.0,
    }
    for field, value in added.items():
        hotter = solved(request, {field: value})
        assert bulk(hotter) >= bulk(found) - 1e-6, field
        assert hotter["safety"]["blok_factor"] <= found["safety"]["blok_factor"] + 1e-9, field
    rubbing = [solved(request, {"friction_coefficient": value}) for value in (0.04, 0.06)]
    assert bulk(rubbing[1]) >= bulk(rubbing[0]) - 1e-6


@seeds(3, 200)
def test_more_oil_is_not_hotter(random: np.random.Generator) -> None:
    """More oil cools, unless a cold casing keeps the mist cooler than the oil that is supplied."""
    request = changed(pair(random), {"cooling.band": False, "cooling.gear_flow_l_per_min": GONE})
    found = solved(request)
    if found["heat"] is None or found["heat"]["mist_c"] < request["temperatures"]["oil_c"]:
        return
    more = solved(request, {"cooling.gear_flow_l_per_min": min(1.3 * found["heat"]["gear_flow_l_per_min"], 5000.0)})
    assert bulk(more) <= bulk(found) + 1e-6


@seeds(3, 200)
def test_more_load_is_not_safer(random: np.random.Generator) -> None:
    request = changed(pair(random), {"cooling.band": False})
    found = solved(request)
    heavier = solved(request, {"load.power_kw": 1.1 * request["load"]["power_kw"]})
    assert heavier["safety"]["blok_factor"] <= found["safety"]["blok_factor"] * (1 + 1e-9)


STATED = {
    "wetting_share": 0.5,
    "rewetting_share": 0,
    "fling_off_factor": 1,
    "jets": "into_mesh",
    "jet_speed_m_per_s": 20,
    "flow_rise_k": 20,
    "flow_to_pinion": 0.5,
    "mist_convection_factor": 3,
    "pumping_to_teeth": 0.1,
    "pumping_w": 0,
    "band": True,
}
MAY_CHANGE = {"assumptions", "inputs", "case"}


@seeds(3, 200)
def test_a_stated_default_changes_the_band_alone(random: np.random.Generator) -> None:
    """What is stated is stated, even where it equals the default: band, verdict and grounds follow, nothing else."""
    request = changed(pair(random), {"cooling": GONE})
    found = solved(request)
    names = [name for name in STATED if random.random() < 0.4]
    told = solved(request, {f"cooling.{name}": STATED[name] for name in names})
    for answers in (found, told):
        for name in MAY_CHANGE:
            answers.pop(name)
        answers["safety"].pop("verdict")
    if found["heat"] is not None:
        bands = [answers["heat"].pop("band") for answers in (told, found)]
        assert bands[0]["safety"][0] >= bands[1]["safety"][0] - 1e-9
        assert bands[0]["safety"][1] <= bands[1]["safety"][1] + 1e-9
    assert told == found


@seeds(3, 200)
def test_what_is_measured_is_met_or_reported(random: np.random.Generator) -> None:
    """A measured temperature is met, or the answer says by how much it is not; no loss is negative."""
    nodes = ["pinion_flank_c", "pinion_body_c", "wheel_flank_c", "wheel_body_c", "drain_c"]
    request = changed(pair(random), {"cooling": {"band": False}, "temperatures.bulk_method": "heat_balance"})
    heat = solved(request)["heat"]
    node = str(random.choice(nodes))
    gear, _, part = node.partition("_")
    own = heat[node] if node == "drain_c" else heat[gear][part]
    wanted = own + random.uniform(-6, 12)
    try:
        found = solved(request, {f"cooling.measured.{node}": wanted})
    except InvalidInput as refusal:
        assert refusal.code == "measured_unreachable"  # noqa: PT017  the refusal is the report
        return
    heat, codes = found["heat"], {each["code"] for each in found["warnings"]}
    assert heat["losses"]["other_w"] >= 0.0
    if node != "drain_c":
        assert heat[gear][part] == pytest.approx(wanted, abs=1e-3)
    elif abs(heat["drain_c"] - wanted) > 0.01:
        assert heat["drain_deviation_k"] == pytest.approx(heat["drain_c"] - wanted, abs=1e-6)
        assert "losses_overestimated" in codes


def test_what_flatters_is_an_assumption() -> None:
    """Aligned flanks, K_A = K_v = 1 and no relief are listed unless they are given."""
    random = np.random.default_rng(1)
    request = changed(pair(random), {"modifications": GONE})
    assumed = {each["field"] for each in solved(request)["assumptions"]}
    flattering = {"load.application_factor", "load.dynamic_factor"} | {
        f"modifications.{name}" for name in ("helix_slope_um", "tip_relief_um", "root_relief_um")
    }
    assert flattering <= assumed
    given = {"load.application_factor": 1, "load.dynamic_factor": 1, "modifications.helix_slope_um": 0}
    told = {each["field"] for each in solved(request, given)["assumptions"]}
    assert flattering - told == set(given)


def test_a_wide_pair_says_what_a_misalignment_would_do() -> None:
    """Where b/d > 1 and no misalignment is given, a note states the safety with 25 µm of helix slope."""
    base = changed(pair(np.random.default_rng(1)), {"modifications": GONE, "cooling": GONE})
    gears = base["gears"]
    diameter = gears["module_mm"] * gears["pinion"]["teeth"] / np.cos(np.radians(gears["helix_angle_deg"]))

    def notes(width: float, slope: float) -> list[str]:
        found = solved(base, {"gears.face_width_mm": width * diameter, "modifications.helix_slope_um": slope})
        return [each["message"] for each in found["warnings"] if each["code"] == "no_misalignment"]

    assert notes(0.9, 0) == notes(1.1, 25) == []
    (told,) = notes(1.1, 0)
    tilted = solved(base, {"gears.face_width_mm": 1.1 * diameter, "modifications.helix_slope_um": 25})
    assert f"would make S_B {tilted['safety']['blok_factor']:.3g} instead of" in told


def test_jets_faster_than_the_teeth_make_no_energy() -> None:
    jets = {"jet_speed_m_per_s": 80, "gear_flow_l_per_min": 500, "wetting_share": 1, "band": False}
    slow = {"operation.pinion_speed_rpm": 2000, "operation.power_kw": 400, "cooling": jets}
    found = answer("/v1/drive-train", changed(example("starter-turbo-gear-heat"), DRY | slow))
    assert found["heat"]["losses"]["oil_acceleration_w"] < 0.0 < found["heat"]["losses"]["jets_w"]
    assert found["losses"]["oil_acceleration_w"] == 0.0
    assert found["losses"]["efficiency"] < 1.0


def test_litres_per_second_are_asked_about_by_name() -> None:
    """2.33 l/s typed as l/min: the refusal or the warning names the flow, not the load."""
    request = example("starter-turbo-pair-heat")
    with pytest.raises(Unprocessable) as refusal:
        answer(SCUFFING, changed(request, DRY | {"cooling": {"gear_flow_l_per_min": 2.33, "band": False}}))
    assert refusal.value.path == "cooling.gear_flow_l_per_min"
    assert "l/min" in refusal.value.message
