"""Every endpoint with an oil rejects impossible oils, and oils at temperatures where no law describes them."""

from typing import Any

import numpy as np
import pytest
from numpy.random import Generator

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.evaluate import evaluate, written
from app.examples import examples
from solvers.oils import GRADES
from tests.support.requests import CONTACT, COUPLING, PAIR, changed, solved

OPERATION = {"torque_n_m": 3000, "speed_rpm": 1910}
RECOMMENDED = {**COUPLING, "operation": {**OPERATION, "misalignment_range_deg": [0.05, 0.1]}}
UNIT: dict[str, Any] = examples()["starter-turbo-gear-drive-train"].request
WAX = {"kinematic_viscosity_40_mm2_per_s": 5000, "kinematic_viscosity_100_mm2_per_s": 1}
# an endpoint, a request, the path of its oil, and the temperatures at which that is used
USES: dict[str, tuple[str, dict[str, Any], str, tuple[str, ...]]] = {
    "coupling": ("/v1/coupling", COUPLING, "lubricant", ("lubricant.temperature_c",)),
    "orbit": ("/v1/coupling/sleeve-orbit", COUPLING, "lubricant", ("lubricant.temperature_c",)),
    "recommendation": ("/v1/coupling/recommendation", RECOMMENDED, "lubricant", ("lubricant.temperature_c",)),
    "scuffing": ("/v1/scuffing", PAIR, "lubricant", ("temperatures.oil_c", "temperatures.bulk_c")),
    "line contact": ("/v1/scuffing/line-contact", CONTACT, "lubricant", ("temperatures.inlet_c",)),
    "unit": ("/v1/drive-train", UNIT, "lubricant", ("temperatures.oil_c", "temperatures.bulk_c")),
    "coupling of a unit": ("/v1/drive-train", UNIT, "couplings.0.lubricant", ("couplings.0.lubricant.temperature_c",)),
}


def outcome(use: str, oil: dict[str, Any], temperatures: list[float]) -> Unprocessable | None:
    """Return the error that rejects the request, or None if the request is answered."""
    endpoint, body, path, places = USES[use]
    calculation = BY_PATH[endpoint]
    request = changed(body, {path: dict(oil), **dict(zip(places, temperatures, strict=True)), "detail": "summary"})
    try:
        written(evaluate(calculation, calculation.request.model_validate(request)))
    except Unprocessable as refusal:
        return refusal
    return None


@pytest.mark.parametrize("use", USES)
def test_an_oil_whose_index_none_has_is_refused_at_its_field(use: str) -> None:
    """Viscosities of 5000 mm2/s at 40 C and 1 mm2/s at 100 C correspond to an index of -10^6."""
    # At -50 C, Walther's law would overflow for this oil.
    refusal = outcome(use, WAX, [-50.0] * len(USES[use][3]))
    assert isinstance(refusal, Unprocessable)
    assert (refusal.code, refusal.path) == ("viscosity_index", f"{USES[use][2]}.kinematic_viscosity_100_mm2_per_s")


@pytest.mark.parametrize("use", USES)
def test_an_oil_too_cold_to_flow_is_refused_at_its_field(use: str) -> None:
    """VG 680 has 10^8 mm2/s at -45 C."""
    # In an earlier version, VG 680 at -50 C gave a coupling a capacity of 8.9e7 N without a warning.
    refusal = outcome(use, {"iso_vg": 680}, [-45.0] * len(USES[use][3]))
    assert isinstance(refusal, Unprocessable)
    assert (refusal.code, refusal.path) == ("oil_too_thick", f"{USES[use][2]}.iso_vg")
    assert "10^8.0 mm²/s at -45 °C" in refusal.message


@pytest.mark.parametrize(
    ("oil", "field"),
    [({"viscosity_pa_s": 25}, "lubricant.viscosity_pa_s"), ({"iso_vg": 460, "temperature_c": 10}, "lubricant.iso_vg")],
)
def test_a_coupling_s_oil_that_is_very_thick_is_warned_of(oil: dict[str, Any], field: str) -> None:
    warnings = solved("/v1/coupling", COUPLING, {"lubricant": oil})["warnings"]
    told = [(each["field"], each["message"]) for each in warnings if each["code"] == "unusual_value"]
    assert [place for place, _ in told] == [field]
    assert "Pa s at operating temperature is unusually high" in told[0][1]


def random_oil(draw: Generator, use: str) -> dict[str, Any]:
    """Return a random oil that the schema of a use allows: a grade, a data sheet or a viscosity."""
    match draw.integers(3):
        case 0:
            return {"iso_vg": int(draw.choice(GRADES))}
        case 1:
            thick, thin = np.exp(draw.uniform([np.log(2), 0.0], np.log([5000, 1000])))
            return {"kinematic_viscosity_40_mm2_per_s": float(thick), "kinematic_viscosity_100_mm2_per_s": float(thin)}
    oil: dict[str, Any] = {"viscosity_pa_s": float(np.exp(draw.uniform(*np.log([1e-5, 100]))))}
    if not any(place.startswith(USES[use][2]) for place in USES[use][3]):
        oil["reference_temperature_c"] = draw.uniform(-50, 300)
        oil["temperature_viscosity_per_k"] = draw.uniform(0, 0.2)
        oil["pressure_viscosity_per_gpa"] = draw.uniform(1, 60)
        oil["pressure_viscosity_law"] = str(draw.choice(["roelands", "barus"]))
    return oil


@pytest.mark.slow
@pytest.mark.parametrize("use", USES)
def test_any_oil_at_any_temperature_is_answered_or_refused_at_a_field(use: str) -> None:
    """The test tries 60 random oils. If a number in an answer were not finite, an error would be raised."""
    draw = np.random.default_rng(14)
    outcomes = [
        outcome(use, random_oil(draw, use), list(draw.uniform(-50.0, 300.0, len(USES[use][3])))) for _ in range(60)
    ]
    refusals = [each for each in outcomes if isinstance(each, Unprocessable)]
    assert all(refusal.path for refusal in refusals)
    assert 10 <= len(refusals) <= 50
