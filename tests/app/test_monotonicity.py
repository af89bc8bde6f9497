"""If one input of a random industrial request changes, the answer changes in the direction that physics demands.

The requests leave fields out, so the defaults are in force.
"""

import json
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from tests.support.properties import first
from tests.support.requests import changed, solved

SCUFFING = "/v1/scuffing"
GRADES = (68, 100, 150, 220, 320, 460)
CASES = 10
MORE_CASES = 120
ROUNDING = 1e-6


def industrial(seed: int) -> dict[str, Any]:
    """Return the request for a random gear stage of industrial size."""
    # The pitch-line velocity is 3 to 35 m/s. The tooth force is 25 to 60 N per mm of face and mm of module.
    rng = np.random.default_rng([22, seed])
    teeth, module = int(rng.integers(18, 36)), float(rng.choice((2, 3, 4, 5, 6, 8, 10)))
    helix, width = float(rng.choice((0, 8, 10, 12, 15, 20))), float(rng.uniform(8, 14)) * module
    diameter = teeth * module / np.cos(np.radians(helix))
    velocity = float(np.exp(rng.uniform(np.log(3), np.log(35))))
    line_load = float(rng.uniform(25, 60)) * module
    return {
        "gears": {
            "pinion": {"teeth": teeth, "profile_shift": round(float(rng.uniform(0, 0.4)), 2)},
            "wheel": {"teeth": int(teeth * rng.uniform(1.2, 4.5))},
            "module_mm": module,
            "helix_angle_deg": helix,
            "face_width_mm": width,
        },
        "load": {
            "pinion_torque_n_m": line_load * width * diameter / 2e3,
            "pinion_speed_rpm": velocity / (np.pi * diameter) * 6e4,
            "application_factor": float(rng.choice((1.0, 1.25, 1.5))),
        },
        "modifications": {
            "tip_relief_um": float(rng.uniform(0, 5)) * module,
            "root_relief_um": float(rng.uniform(0, 5)) * module,
            "lead_crowning_um": float(rng.uniform(0, 12)),
            "helix_slope_um": float(rng.uniform(-15, 15)),
        },
        "lubricant": {"iso_vg": int(rng.choice(GRADES[:-1]))},
        "temperatures": {
            "oil_c": float(rng.uniform(40, 80)),
            "oil_supply": str(rng.choice(("spray", "dip"))),
            "scuffing_test": {"fzg_stage": int(rng.integers(9, 13))},
        },
        "model": {"lubrication": "closed_form"},
    }


@lru_cache(maxsize=8)
def answer_to(endpoint: str, body: str) -> dict[str, Any]:
    return solved(endpoint, json.loads(body))


def answers(body: dict[str, Any], path: str, *values: Any, endpoint: str = SCUFFING) -> list[dict[str, Any]]:
    """Set each of the values at a path of the body, and return the answers. Recent answers are reused."""
    return [answer_to(endpoint, json.dumps(changed(body, {path: value}), sort_keys=True)) for value in values]


def check_oil_temperature(body: dict[str, Any]) -> None:
    """Check that the safety factor by Blok does not rise if the oil is 15 K hotter."""
    # The safety factor by thermal EHL may rise by up to 5 %: the film is full, and its friction falls as the film
    # thins. The answer then says so.
    oil = body["temperatures"]["oil_c"]
    cool, hot = answers(body, "temperatures.oil_c", oil, oil + 15)
    assert hot["safety"]["blok_factor"] <= cool["safety"]["blok_factor"] * (1 + ROUNDING)
    by_film = [answer["safety"]["thermal_ehl_factor"] for answer in (cool, hot)]
    if None not in by_film and by_film[1] > by_film[0]:
        assert by_film[1] < 1.05 * by_film[0]
        assert hot["flash"]["thermal_ehl_max_k"] < cool["flash"]["thermal_ehl_max_k"]
        assert hot["film"]["thermal_ehl_min_um"] < cool["film"]["thermal_ehl_min_um"]
        said = {each["field"]: each["reason"] for each in hot["assumptions"]}
        assert "A hotter oil makes the full film thinner" in said["model.lubrication"]


def check_torque(body: dict[str, Any], temperature: str) -> None:
    """Check that the contact and bulk temperatures do not fall if the torque is 20 % larger."""
    torque = body["load"]["pinion_torque_n_m"]
    light, heavy = answers(body, "load.pinion_torque_n_m", torque, 1.2 * torque)
    assert heavy["contact_temperature"][temperature] >= light["contact_temperature"][temperature] - ROUNDING
    assert heavy["contact_temperature"]["bulk_c"] >= light["contact_temperature"]["bulk_c"] - ROUNDING


def check_viscosity(body: dict[str, Any], film: str) -> None:
    """Check that the film does not get thinner with the next thicker grade."""
    grade = body["lubricant"]["iso_vg"]
    thin, thick = answers(body, "lubricant.iso_vg", grade, GRADES[GRADES.index(grade) + 1])
    assert thick["film"][film] >= thin["film"][film] * (1 - ROUNDING)


def check_misalignment(body: dict[str, Any]) -> None:
    """Check that the face load factor does not fall if the helix slope grows, for both signs."""
    # The pair has no modifications other than the helix slope.
    uniform = {name: body[name] for name in ("gears", "load")}
    for sign in (-1.0, 1.0):
        slopes = (0.0, sign * 5.0, sign * 15.0, sign * 40.0)
        found = answers(uniform, "modifications.helix_slope_um", *slopes, endpoint=f"{SCUFFING}/load-distribution")
        factors = [each["load"]["face_load_factor"] for each in found]
        assert all(np.diff(factors) >= -ROUNDING), factors


@pytest.mark.parametrize("seed", first(3, range(CASES)))
def test_physics_of_a_random_stage(seed: int) -> None:
    body = industrial(seed)
    check_oil_temperature(body)
    check_torque(body, "blok_max_c")
    check_viscosity(body, "dowson_higginson_min_um")
    check_misalignment(body)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(CASES, MORE_CASES))
def test_physics_of_more_random_stages(seed: int) -> None:
    test_physics_of_a_random_stage(seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(CASES))
def test_physics_of_the_thermal_film(seed: int) -> None:
    body = industrial(seed) | {"model": {"path_points": 8}}
    check_oil_temperature(body)
    check_torque(body, "thermal_ehl_max_c")
    check_viscosity(body, "thermal_ehl_min_um")
