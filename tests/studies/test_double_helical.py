"""Studies of double-helical units: thrust of either sense, results of one helix, a correction for each helix."""

from typing import Any

import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.studies.kinds.corners import Corners
from app.studies.kinds.design import Design
from app.studies.kinds.sensitivity import Sensitivity
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from app.studies.points import needs_film
from app.studies.requests import DRIVE_TRAIN
from solvers.drive_train.checks import check_inputs
from solvers.drive_train.uncertainty import MOST_CORNERS
from solvers.scuffing.model import mesh_of
from tests.support import studies
from tests.support.requests import GONE, changed
from tests.support.studies import Planner, fault_of

STARTER = examples()["starter-turbo-double-helical"].request
GIVEN = {
    "effects.thermal": False,
    "temperatures.bulk_c": 95.0,
    "thermal.pinion_bulk_c": 95.0,
    "thermal.wheel_bulk_c": 80.0,
    "cooling": GONE,
    "modifications.second_helix": GONE,
}
UNIT: dict[str, Any] = changed(STARTER, GIVEN)
SINGLE = examples()["starter-turbo-gear-drive-train"].request
THRUST = "couplings.0.thrust_fraction"
SAFETIES = ["helices.0.safety.blok_flank", "helices.1.safety.blok_flank"]
SLOPE, SECOND = "modifications.helix_slope_um", "modifications.second_helix.helix_slope_um"


def lines_of(planner: Planner, request: dict[str, Any] = UNIT, **body: Any) -> list[dict[str, Any]]:
    named = {} if planner in {Corners, Design} else {"endpoint": DRIVE_TRAIN}
    return studies.lines_of(planner({"request": request, **named, **body}, 2500, 30.0))


def test_the_thrust_loads_either_helix_at_the_usual_corners() -> None:
    points = Corners({"request": STARTER}, 2500, 30.0).points
    assert points.axes[-1].path == THRUST
    assert points.axes[-1].values == [-1.0, 0.0, 1.0]
    assert points.total == 192 <= MOST_CORNERS
    assert Corners({"request": SINGLE}, 2500, 30.0).points.axes[-1].values == [0.0, 1.0]


def test_a_sweep_tells_of_each_helix() -> None:
    outputs = ["helices.0.share", *SAFETIES, "safety.blok_flank", "axial.share_factor", "decisive_helix"]
    vary = [{"path": THRUST, "values": [-1.0, 1.0]}]
    study = Sweep({"endpoint": DRIVE_TRAIN, "request": UNIT, "vary": vary, "outputs": outputs}, 2500, 30.0)
    lines = studies.lines_of(study)
    rows = [line["out"] for line in lines if line["type"] == "point"]
    for share, *safeties, least, factor, decisive in rows:
        assert least == min(safeties) == safeties[decisive - 1]
        assert factor == pytest.approx(2.0 * max(share, 1.0 - share), rel=1e-12)
    assert [decisive for *_, decisive in rows] == [1, 2], "each sense of the thrust loads another helix"
    head, *table = b"".join(map(study.encoder("csv"), lines)).decode().splitlines()
    assert head == ",".join(["index", THRUST, "status", *outputs, "warnings", "error"])
    assert [row.split(",")[3:9] for row in table] == [[f"{value!r}" for value in row] for row in rows]


def test_a_single_helix_has_none_of_two() -> None:
    lines = lines_of(Sweep, SINGLE, vary=[{"path": "operation.power_kw", "values": [9000.0]}], outputs=SAFETIES)
    assert lines[1]["status"].startswith("ok")
    assert lines[1]["out"] == [None, None]
    _, _, error = lines_of(
        Design, SINGLE, variables=[{"path": SLOPE, "min": 0, "max": 50}], objective=SAFETIES[0], evaluations=3
    )
    assert error["code"] == "no_start"
    assert f"no value of {SAFETIES[0]}" in error["message"]


@pytest.mark.parametrize("path", ["helices.0.safety.minimum", "states.cold.helices.1.safety.minimum"])
def test_the_least_safety_of_a_helix_needs_the_film(path: str) -> None:
    assert needs_film(DRIVE_TRAIN, path)
    assert not needs_film(DRIVE_TRAIN, path.replace("minimum", "blok_flank"))


def test_a_path_of_both_helices_is_refused() -> None:
    body = {"endpoint": DRIVE_TRAIN, "request": UNIT, "vary": [{"path": THRUST, "values": [0.0]}]}
    assert fault_of(Sweep, {**body, "outputs": ["helices.safety"]})[:2] == ("/outputs/0", "unknown_output")
    assert fault_of(Sweep, {**body, "outputs": ["helices.0.safety"]})[:2] == ("/outputs/0", "not_scalar")


@pytest.mark.parametrize("path", ["gears.gap_width_mm", "gears.face_width_mm", "face_start_mm"])
def test_a_face_that_moves_by_its_tolerance_stays_above_its_sections(path: str) -> None:
    study = Sensitivity({"endpoint": DRIVE_TRAIN, "request": UNIT, "inputs": [path]}, 2500, 30.0)
    (moved,) = study.perturbations
    assert len(moved.places) == 4
    for place in moved.places:
        unit = BY_PATH[DRIVE_TRAIN].request.model_validate(changed(UNIT, {path: place})).inputs()
        check_inputs(unit, mesh_of(unit.mesh.distribution).path)


@pytest.mark.ci
def test_what_matters_of_two_helices() -> None:
    unit = changed(UNIT, {SECOND: 5.0})
    inputs = [SLOPE, SECOND, "operation.axial_force_n"]
    *lines, end = lines_of(Sensitivity, unit, inputs=inputs, outputs=SAFETIES)
    assert [(each["path"], each["value"]) for each in end["inputs"]] == [
        (SLOPE, 13.0),
        (SECOND, 5.0),
        ("operation.axial_force_n", 0.0),
    ]
    found = {(line["output"], line["path"]): line["change"] for line in lines}
    for own, other, slope in ((*SAFETIES, SLOPE), (*SAFETIES[::-1], SECOND)):
        assert abs(found[own, slope]) > 20.0 * abs(found[other, slope]) > 0.0, "through the shafts alone"
    force = [found[safety, "operation.axial_force_n"] for safety in SAFETIES]
    assert force[0] * force[1] < 0.0, "what one helix loses the other one carries"


def test_a_spectrum_scatters_the_second_helix() -> None:
    tolerances = {
        "method": "latin_hypercube",
        "count": 2,
        "replicates": 1,
        "inputs": [
            {"path": SECOND, "distribution": "uniform", "min": 0, "max": 20},
            {"path": "operation.axial_force_n", "distribution": "uniform", "min": -5e3, "max": 5e3},
        ],
    }
    limits = [{"output": SAFETIES[1], "below": {"value": 1.0}}]
    cases = [{"set": {THRUST: 0.0}}, {"set": {THRUST: 1.0}}]
    end = lines_of(Spectrum, cases=cases, tolerances=tolerances, limits=limits, outputs=SAFETIES)[-1]
    assert end["counts"] == {"ok_with_warnings": 4}
    free, locked = (case["means"][SAFETIES[1]] for case in end["cases"])
    assert locked < free
    assert not [note for note in end["notes"] if "no effect" in note]
    unused = lines_of(Spectrum, SINGLE, cases=[{}], tolerances=tolerances, outputs=["load.face_load_factor"])[-1]
    assert len([note for note in unused["notes"] if "has no effect" in note]) == 2


@pytest.mark.ci
def test_a_design_corrects_each_helix_and_starts_from_the_case() -> None:
    variables = [{"path": path, "min": -20, "max": 40} for path in (SLOPE, SECOND)]
    _, first, *_, end = lines_of(
        Design, variables=variables, corners=[{"path": THRUST, "values": [-1.0, 1.0]}],
        objective="safety.blok_flank", evaluations=12,
    )  # fmt: skip
    assert first["at"] == pytest.approx({SLOPE: 13.0, SECOND: 13.0}), "the second helix starts as the first"
    assert end["objective_best"] > end["objective_start"]
    assert end["best"][SLOPE] > end["best"][SECOND], "they need different corrections"
