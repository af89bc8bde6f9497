"""What the models do not know well is drawn by one switch; what is stated or measured is not, but for its error."""

from typing import Any

import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.schema.reading import validated
from app.studies.kinds.spectrum import Spectrum
from app.studies.requests import Lognormal, Normal
from app.studies.uncertainty import model_distributions
from solvers.heat_balance.band import FLING_OFF_FACTORS, WETTING_SHARES
from tests.support.requests import changed
from tests.support.studies import fault_of, lines_of

UNIT = examples()["starter-turbo-gear-heat"].request
COOLING = {f"cooling.{name}" for name in ("wetting_share", "fling_off_factor", "rewetting_share", "windage_w")}


def drawn(request: dict[str, Any], endpoint: str = "/v1/drive-train") -> dict[str, Any]:
    found = model_distributions(validated(BY_PATH[endpoint].request, request))
    return {path: scatter for path, (scatter, _) in found.items()}


def test_the_inputs_of_the_heat_band_and_the_friction_are_drawn() -> None:
    found = drawn(UNIT)
    friction = {"friction_factor", *(path for path in found if path.startswith("couplings."))}
    assert found.keys() - friction == COOLING
    for path, ends in {"cooling.wetting_share": WETTING_SHARES, "cooling.fling_off_factor": FLING_OFF_FACTORS}.items():
        assert isinstance(found[path], Lognormal)
        assert found[path].factor ** 4 == pytest.approx(ends[1] / ends[0])  # two deviations to either side
    assert found["friction_factor"].factor ** 2 == pytest.approx(1.3)


def test_the_windage_is_drawn_about_that_of_the_balance() -> None:
    answer = BY_PATH["/v1/drive-train"]
    inputs = validated(answer.request, UNIT).inputs()
    # Mauz for both gears of the worked example (spec: 14.6 kW)
    assert drawn(UNIT)["cooling.windage_w"].median == pytest.approx(14_622, rel=1e-4)
    assert inputs.mesh.cooling.windage is None


@pytest.mark.parametrize(
    ("changes", "gone"),
    [
        ({"cooling.wetting_share": 0.4}, {"cooling.wetting_share"}),
        ({"cooling.fling_off_factor": 1.0}, {"cooling.fling_off_factor"}),
        ({"cooling.windage_w": 9000.0}, {"cooling.windage_w"}),
        ({"cooling.measured": {"pinion_body_c": 80.0}}, {"cooling.wetting_share"}),
        ({"friction_coefficient": 0.05}, {"friction_factor"}),
    ],
)
def test_what_is_stated_is_not_drawn(changes: dict[str, Any], gone: set[str]) -> None:
    before, after = drawn(UNIT), drawn(changed(UNIT, changes))
    assert before.keys() - after.keys() == gone


def test_a_measured_or_given_value_is_drawn_within_its_error() -> None:
    found = drawn(changed(UNIT, {"cooling.measured": {"pinion_body_c": 80.0}}))["cooling.measured.pinion_body_c"]
    assert isinstance(found, Normal)
    assert (found.mean, found.deviation) == (80.0, 1.5)
    given = drawn(changed(UNIT, {"friction_coefficient": 0.05}))["friction_coefficient"]
    assert (given.median, given.factor) == (0.05, pytest.approx(1.3**0.5))
    typed = drawn(examples()["starter-turbo-gear-drive-train"].request)
    assert {path for path in typed if path.endswith("bulk_c")} == {"thermal.pinion_bulk_c", "thermal.wheel_bulk_c"}


def test_one_switch_draws_them_in_a_spectrum_and_says_so() -> None:
    request = examples()["pahl-axial-displacement"].request
    body = {"endpoint": "/v1/coupling", "request": request, "cases": [{}], "outputs": ["axial_thrust.coaxial_limit_n"]}
    tolerances = {"count": 16, "replicates": 1, "model_uncertainty": True}
    header, *_, end = lines_of(Spectrum({**body, "tolerances": tolerances}, 20_000, 30.0))
    (own,) = header["tolerances"]["inputs"]
    assert (own["path"], own["distribution"]) == ("friction.coefficient", "lognormal")
    (said,) = [each for each in end["assumptions"] if each["reason"].startswith("uncertainty of the model")]
    assert said["field"] == "friction.coefficient"
    without = changed(body, {"request.friction": {}, "tolerances": tolerances})
    assert fault_of(Spectrum, without)[:2] == ("/tolerances/inputs", "missing")


def test_the_factor_on_the_friction_multiplies_the_laws_alone() -> None:
    request, calculation = examples()["starter-high-speed-scuffing"].request, BY_PATH["/v1/scuffing"]
    light = changed(request, {"model.lubrication": "closed_form"})

    def solved(**changes: Any) -> Any:
        return calculation.solve(validated(calculation.request, changed(light, changes)).inputs())

    own, more = solved(), solved(friction_factor=1.2)
    assert more.flash.friction_coefficient == pytest.approx(1.2 * own.flash.friction_coefficient)
    assert more.distribution.friction_loss.coefficient == pytest.approx(
        1.2 * own.distribution.friction_loss.coefficient
    )
    stated = {"friction_coefficient": 0.05, "model.friction": "given"}
    given, alike = solved(**stated), solved(**stated, friction_factor=1.2)
    assert given.flash.friction_coefficient == alike.flash.friction_coefficient == 0.05
    assert given.flash.blok_max == alike.flash.blok_max
