"""A quality class gives corners, load spectrum and sensitivity their tolerances; what is given wins."""

from typing import Any

import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.models.sections.gears import SECOND_BY_CLASS as SECOND_HELIX
from app.models.sections.gears import SLOPES_BY_CLASS
from app.schema.fields import value_at
from app.schema.reading import validated
from app.studies.kinds.corners import Corners
from app.studies.kinds.sensitivity import Sensitivity
from app.studies.kinds.spectrum import Spectrum
from app.studies.requests import DRIVE_TRAIN
from app.studies.tolerances import class_corners, class_tolerances
from tests.support.requests import PAIR, changed, solved
from tests.support.studies import fault_of, lines_of, timeless

HELIX, PROFILE = SLOPES_BY_CLASS

LOADS = "/v1/scuffing/load-distribution"
CLASSED = changed(
    {key: value for key, value in PAIR.items() if key != "model"},
    {"gears.quality_class": 6, "modifications": {"helix_slope_um": 3}},
)
PRESSURE, K = "pressure.max_mpa", "load.face_load_factor"
TURBO = examples()["starter-turbo-gear-drive-train"].request
UNIT = changed(TURBO, {"model.lubrication": "closed_form", "gears.quality_class": 4})
TWO = changed(examples()["starter-turbo-double-helical"].request, {"gears.quality_class": 4})


def body(request: dict[str, Any] = CLASSED, **parts: Any) -> dict[str, Any]:
    return {"endpoint": LOADS, "request": request, "outputs": [PRESSURE], **parts}


def spectrum(**parts: Any) -> list[dict[str, Any]]:
    return timeless(lines_of(Spectrum(body(cases=[{}], **parts), 20_000, 30.0)))


def stated() -> dict[str, float]:
    """Return three standard deviations as an answer states them, by the paths of the fields."""
    tolerances = solved(LOADS, CLASSED)["derived"]["tolerances"]
    return {HELIX: tolerances["helix_slope_um"], PROFILE: tolerances["profile_slope_um"]}


def test_a_class_alone_scatters_the_slopes() -> None:
    header, end = spectrum(tolerances={"count": 4, "replicates": 2})
    found = {each["path"]: each for each in header["tolerances"]["inputs"]}
    assert found.keys() == {HELIX, PROFILE}
    for path, mean in {HELIX: 3.0, PROFILE: 0.0}.items():
        assert (found[path]["distribution"], found[path]["mean"]) == ("normal", mean)
        assert found[path]["deviation"] == pytest.approx(stated()[path] / 3)
    said = {each["field"]: each for each in end["assumptions"] if each["reason"].startswith("by quality class 6")}
    assert {path: each["value"] for path, each in said.items()} == pytest.approx(stated())
    assert "three standard deviations are the tolerances" in said[HELIX]["reason"]
    assert end["outputs"][PRESSURE]["max"]["value"] > end["outputs"][PRESSURE]["min"]["value"]


def test_without_any_tolerances_the_class_draws_machines() -> None:
    study = Spectrum(body(cases=[{}]), 20_000, 30.0)
    assert study.tolerances is not None
    assert study.total == study.tolerances.count * study.tolerances.replicates > 1
    assert Spectrum(body(changed(CLASSED, {"gears": PAIR["gears"]}), cases=[{}]), 20_000, 30.0).total == 1


def test_what_is_given_wins() -> None:
    own = {"path": HELIX, "distribution": "uniform", "min": 0, "max": 1}
    header, end = spectrum(tolerances={"count": 2, "replicates": 1, "inputs": [own]})
    assert [(each["path"], each["distribution"]) for each in header["tolerances"]["inputs"]] == [
        (HELIX, "uniform"),
        (PROFILE, "normal"),
    ]
    assert {each["field"] for each in end["assumptions"] if "quality class" in each["reason"]} == {PROFILE}
    by_case = Spectrum(body(cases=[{"set": {PROFILE: 2}}]), 20_000, 30.0)
    assert [leaf.path for leaf in by_case.scattering] == [HELIX]


def test_a_spectrum_with_nothing_that_scatters_is_refused() -> None:
    plain = changed(CLASSED, {"gears": PAIR["gears"]})
    fault = fault_of(Spectrum, body(plain, cases=[{}], tolerances={"count": 4}))
    assert fault[:2] == ("/tolerances/inputs", "missing")


@pytest.mark.parametrize("kind", [Spectrum, Sensitivity])
def test_gears_beyond_the_standard_are_refused_at_the_class(kind: type) -> None:
    tiny = changed(CLASSED, {"gears.module_mm": 0.2})
    pointer, code, message = fault_of(kind, body(tiny, **({"cases": [{}]} if kind is Spectrum else {})))
    assert (pointer, code) == ("/request/gears/quality_class", "quality_class")
    assert "0.5 to 70 mm" in message


def test_what_matters_moves_the_slopes_by_the_class() -> None:
    inputs = [HELIX, PROFILE, "modifications.lead_crowning_um"]
    *lines, end = lines_of(Sensitivity(body(outputs=[K], inputs=inputs), 2500, 30.0))
    steps = {line["path"]: line["step"] for line in lines}
    assert {path: steps[path] for path in (HELIX, PROFILE)} == pytest.approx(stated())
    assert steps["modifications.lead_crowning_um"] == 3  # its own tolerance
    assert {each["field"] for each in end["assumptions"] if "quality class" in each["reason"]} == {HELIX, PROFILE}


def test_corners_take_both_ends_of_the_class() -> None:
    study = Corners({"request": UNIT, "outputs": [K]}, 2500, 30.0)
    axes = {axis.path: axis.values for axis in study.points.axes if isinstance(axis.path, str)}
    tolerance = class_tolerances(validated(BY_PATH[DRIVE_TRAIN].request, UNIT))
    for path in (HELIX, PROFILE):
        own = float(value_at(UNIT, path) or 0.0)
        assert axes[path] == pytest.approx([own - tolerance[path], own + tolerance[path]])
    plain = Corners({"request": changed(UNIT, {"gears": TURBO["gears"]}), "outputs": [K]}, 2500, 30.0)
    assert study.total == 4 * plain.total


def test_two_helices_have_slopes_of_their_own() -> None:
    request = validated(BY_PATH[DRIVE_TRAIN].request, TWO)
    assert class_tolerances(request).keys() == {HELIX, SECOND_HELIX, PROFILE}
    width = class_tolerances(request)[HELIX]
    axis = class_corners(request)["helix slope"]
    assert axis.path == [HELIX, SECOND_HELIX]
    assert axis.values is not None
    first, second = (value_at(TWO, path) or 0.0 for path in (HELIX, SECOND_HELIX))
    assert axis.values == [[first - width, second - width], [first + width, second + width]]
    plain = changed(TWO, {"gears.quality_class": None})
    both, one = (Corners({"request": each, "outputs": [K]}, 2500, 30.0).total for each in (TWO, plain))
    assert both == 4 * one
