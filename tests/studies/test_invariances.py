"""The order of cases, the order of inputs and load factors of 1 change nothing in a study; shares are weights."""

from typing import Any

import numpy as np
import pytest

from app.studies.kinds.sensitivity import Sensitivity
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from tests.support.pools import InlinePool
from tests.support.properties import seeds
from tests.support.studies import lines_of, study_of, timeless

MU, TORQUE = "friction.coefficient", "operation.torque_n_m"
OUTPUTS = ["axial_thrust.coaxial_limit_n", "losses.friction_power_w", "load_distribution.max_tangential_force_n"]


def spectrum(**parts: Any) -> dict[str, Any]:
    """Run a spectrum of a coupling, and return its last line."""
    body = study_of("pahl-axial-displacement", **{"outputs": OUTPUTS, **parts})
    return timeless(lines_of(Spectrum(body, 20_000, 30.0), InlinePool(1)))[-1]


def draw_cases(random: np.random.Generator) -> list[dict[str, Any]]:
    count = int(random.integers(2, 7))
    shares = random.dirichlet(np.ones(count))
    torques = random.uniform(500, 5000, count)
    return [
        {"name": f"case {number}", "share": float(share), "set": {TORQUE: float(torque)}}
        for number, (share, torque) in enumerate(zip(shares, torques, strict=True), 1)
    ]


def draw_parts(random: np.random.Generator) -> dict[str, Any]:
    scatter = {"path": MU, "distribution": "normal", "mean": 0.15, "deviation": float(random.uniform(0.005, 0.03))}
    limit = {"output": OUTPUTS[0], "above": {"mean": float(random.uniform(3e3, 2e4)), "deviation": 800.0}}
    return {"tolerances": {"inputs": [scatter], "count": 8, "replicates": 4}, "limits": [limit], "hours_per_year": 8000}


@seeds(3, 60)
@pytest.mark.ci
def test_order_of_cases_does_not_matter(random: np.random.Generator) -> None:
    cases, parts = draw_cases(random), draw_parts(random)
    order = random.permutation(len(cases))
    one, other = spectrum(cases=cases, **parts), spectrum(cases=[cases[place] for place in order], **parts)
    for place, there in zip(order, other["cases"], strict=True):
        here = one["cases"][place]
        assert there == {**here, "share": pytest.approx(here["share"], rel=1e-14)}, "shares are parts of another sum"
    for here, there in zip(one["limits"], other["limits"], strict=True):
        assert [here["decides"][place] for place in order] == there["decides"]
        assert here["probability"] == there["probability"]
        assert here["interval"] == there["interval"]
    for name in OUTPUTS:
        assert other["outputs"][name]["mean"] == pytest.approx(one["outputs"][name]["mean"], rel=1e-12)
        for end in ("min", "max"):
            assert other["outputs"][name][end]["value"] == one["outputs"][name][end]["value"]


@seeds(3, 60)
def test_shares_are_weights(random: np.random.Generator) -> None:
    """The shares of the cases add up to 1."""
    # A mean over the operating time is the sum of the means of the single cases, each multiplied by its share.
    cases = draw_cases(random)
    end = spectrum(cases=cases)
    assert sum(case["share"] for case in end["cases"]) == pytest.approx(1.0, rel=1e-12)
    alone = [spectrum(cases=[{"set": case["set"]}]) for case in cases]
    for name in OUTPUTS:
        values = [one["outputs"][name]["mean"] for one in alone]
        mean = sum(case["share"] * value for case, value in zip(cases, values, strict=True))
        assert end["outputs"][name]["mean"] == pytest.approx(mean, rel=1e-12)
        assert end["outputs"][name]["min"]["value"] == min(values)
        assert end["outputs"][name]["max"]["value"] == max(values)


@seeds(3, 60)
def test_a_factor_of_one_changes_nothing(random: np.random.Generator) -> None:
    """A load distribution does not change if one of its three load factors, or all three, are set to 1."""
    names = ["load.application_factor", "load.dynamic_factor", "load.mesh_load_factor"]
    torque = float(random.uniform(20, 800))
    plain = study_of("xue-pair-1-modified", outputs=["pressure.max_mpa", "transmission_error.peak_to_peak_um"])
    sets: list[dict[str, float]] = [{}, *({name: 1.0} for name in names), dict.fromkeys(names, 1.0)]
    cases = [{"load.pinion_torque_n_m": torque, **each} for each in sets]
    points = [line["outputs"] for line in lines_of(Sweep({**plain, "cases": cases}, 100, 30.0)) if "outputs" in line]
    assert all(point == points[0] for point in points[1:])


@seeds(2, 40)
def test_order_of_inputs_of_a_sensitivity_does_not_matter(random: np.random.Generator) -> None:
    inputs = [MU, TORQUE, "operation.speed_rpm", "operation.misalignment_deg", "coupling.module_mm"]
    shuffled = [inputs[place] for place in random.permutation(len(inputs))]
    set_up = study_of("pahl-axial-displacement", outputs=OUTPUTS)
    set_up["request"] = {**set_up["request"], "friction": {"coefficient": float(random.uniform(0.05, 0.3))}}
    one, other = (
        [line for line in lines_of(Sensitivity({**set_up, "inputs": each}, 2500, 30.0)) if "derivative" in line]
        for each in (inputs, shuffled)
    )
    by_place = [{(line["output"], line["path"]): line["derivative"] for line in each} for each in (one, other)]
    assert by_place[0] == by_place[1]
    assert by_place[0]
