"""The recommended crowning meets its constraints, and no other feasible crowning is better."""

from functools import partial
from math import radians, tan

import numpy as np
import pytest

from benchmarks.published.pahl import pahl_coupling
from solvers.coupling.crowning import (
    at_misalignment,
    crowning_state,
    crowning_window,
    recommend,
)
from solvers.coupling.inputs import Coupling, ModelOptions, RecommendationInputs
from solvers.coupling.kinematics import tooth_geometry
from solvers.coupling.model import solve
from tests.support.couplings import random_pitch_errors
from tests.support.outcomes import codes, refused

ERRORS = random_pitch_errors(1, rms=0.5e-6)


def misalignments(low: float, high: float, **changes: object) -> RecommendationInputs:
    design = pahl_coupling(0.1, **{"friction": None, **changes})
    return RecommendationInputs(design, radians(low), radians(high))


def test_window_ends_where_overlap_is_one_and_where_the_contact_leaves_the_face() -> None:
    inputs = misalignments(0.05, 0.2)
    low, high, failed = crowning_window(partial(crowning_state, inputs))
    assert failed is None
    assert (low, high) == pytest.approx((11.30, 11.47), abs=5e-3)
    first = solve(at_misalignment(inputs, low, inputs.min_misalignment))
    assert first.lubrication.contact_overlap == pytest.approx(1.0, rel=1e-8)
    last = solve(at_misalignment(inputs, high, inputs.max_misalignment))
    reach = last.kinematics.max_contact_travel + last.lubrication.hertz_half_width
    assert reach == pytest.approx(inputs.design.coupling.face_width / 2, rel=1e-9)


@pytest.mark.parametrize(
    ("low", "high", "errors"),
    [(0.05, 0.2, None), *((*each, errors) for each in ((0.05, 0.1), (0.1, 0.3)) for errors in (None, ERRORS))],
)
def test_no_feasible_crowning_does_better(low: float, high: float, errors: tuple[float, ...] | None) -> None:
    inputs = misalignments(low, high, pitch_errors=errors)
    recommendation = recommend(inputs)
    state = partial(crowning_state, inputs)
    smallest, largest, _ = crowning_window(state)
    best = recommendation.min_load_capacity_coefficient
    for ratio in np.linspace(smallest, largest, 200):
        assert state(float(ratio)).load_capacity_coefficient <= best * (1 + 1e-6)


def test_both_ends_repeat_the_solution_there() -> None:
    inputs = misalignments(0.05, 0.1, axial_velocity=1e-3, arrangement="parallel_offset")
    recommendation = recommend(inputs)
    assert recommendation.crowning_ratio is not None
    for point, delta in (
        (recommendation.at_min, inputs.min_misalignment),
        (recommendation.at_max, inputs.max_misalignment),
    ):
        result = solve(at_misalignment(inputs, recommendation.crowning_ratio, delta))
        assert point.contact_overlap == result.lubrication.contact_overlap
        assert point.axial_thrust == result.axial_thrust.force
        assert point.sliding_velocity == result.kinematics.max_sliding_velocity


@pytest.mark.parametrize(
    ("inputs", "failed"),
    [
        (misalignments(0.04, 0.2), "edge_contact"),
        (misalignments(2e-3, 2e-3), "contact_overlap"),
        (misalignments(0.1, 0.1, torque=1e9), "hertz_pressure"),
        (misalignments(0.1, 0.1, torque=1e7, youngs_modulus=1e5), "contact_width"),
        (misalignments(0.5, 0.5), "sliding_velocity"),
    ],
)
def test_infeasible_ranges_name_the_constraint(inputs: RecommendationInputs, failed: str) -> None:
    recommendation = recommend(inputs)
    assert not recommendation.feasible
    assert recommendation.failed_constraint == failed
    assert recommendation.crowning_ratio is None
    assert recommendation.at_min is None
    assert [notice.code for notice in recommendation.warnings][-1] == "infeasible"
    assert not any(recommendation.scan.feasible)


def test_a_range_reports_sliding_instead_of_excluding_it() -> None:
    recommendation = recommend(misalignments(0.1, 0.5))
    assert recommendation.feasible
    assert [notice.code for notice in recommendation.warnings] == ["sliding_velocity"]


def test_warnings_are_those_of_the_solution_at_both_ends() -> None:
    inputs = misalignments(0.1, 0.5, friction=0.0, torque=5.0, axial_velocity=1e-3)
    recommendation = recommend(inputs)
    assert recommendation.crowning_ratio is not None
    low, high = (
        codes(solve(at_misalignment(inputs, recommendation.crowning_ratio, delta)))
        for delta in (inputs.min_misalignment, inputs.max_misalignment)
    )
    assert {"sliding_velocity"} | low | high == {"sliding_velocity", "no_friction", "sleeve_not_centred"}
    found = [notice.code for notice in recommendation.warnings]
    assert sorted(found) == ["no_friction", "sleeve_not_centred", "sliding_velocity"]
    # The sliding velocity is that of the largest misalignment, and the field one of this request.
    sliding = recommendation.warnings[found.index("sliding_velocity")]
    assert "0.136 m/s" in sliding.message
    assert sliding.field == "misalignment_range"


@pytest.mark.parametrize(("low", "high"), [(0.05, 0.1), (0.05, 0.2), (0.1, 0.3), (0.03, 0.06), (0.3, 0.35)])
def test_a_recommended_contact_never_leaves_the_face(low: float, high: float) -> None:
    for kinematics in ("tangential", "spatial"):
        inputs = misalignments(low, high, model=ModelOptions(kinematics=kinematics, inlet="infinite"))
        recommendation = recommend(inputs)
        assert recommendation.feasible
        assert "edge_contact" not in codes(recommendation)


def test_scan_agrees_with_the_constraints() -> None:
    inputs = misalignments(0.1, 0.3)
    scan = recommend(inputs).scan
    low, high, _ = crowning_window(partial(crowning_state, inputs))
    inside = (scan.crowning_ratio > low) & (scan.crowning_ratio <= high)
    assert tuple(inside) == scan.feasible
    assert np.all(np.diff(scan.max_contact_overlap) < 0.0)


@pytest.mark.parametrize(
    ("inputs", "code", "field"),
    [
        (misalignments(0.0, 0.1), "misalignment_range", "misalignment_range"),
        (misalignments(0.2, 0.1), "misalignment_range", "misalignment_range"),
        (misalignments(0.1, 6.5), "misalignment_range", "misalignment_range"),
        (misalignments(float("nan"), 0.1), "misalignment_range", "misalignment_range"),
        (misalignments(0.1, 0.2, torque=0.0), "no_load", None),
        (misalignments(0.1, 0.2, speed=0.0), "not_turning", None),
    ],
)
def test_nothing_to_recommend(inputs: RecommendationInputs, code: str, field: str | None) -> None:
    found, named = refused(recommend, inputs)
    assert found == code
    assert field is None or named == field


def test_a_ratio_is_a_radius_and_a_drop() -> None:
    """The coupling of issue and manual: 80 teeth of 3 mm, a face of 32 mm, ratio 15.6."""
    coupling = Coupling(80, 3e-3, face_width=32e-3, crowning_ratio=15.6)
    geometry = tooth_geometry(coupling)
    assert geometry.crowning_radius == pytest.approx(1.872)
    drop = geometry.crowning_drop
    assert drop == pytest.approx(25e-6, rel=0.01)
    infeed = geometry.crowning_radius - (geometry.crowning_radius**2 - 0.016**2) ** 0.5  # of the cutter's circle
    assert drop == pytest.approx(infeed * tan(coupling.pressure_angle), rel=1e-4)


def test_the_cost_of_the_crowning_is_that_of_the_coupling_with_it() -> None:
    inputs = misalignments(0.05, 0.2)
    found = recommend(inputs)
    assert found.crowning_ratio
    assert found.at_min
    assert found.at_max
    assert found.unloading_misalignment
    for point, tilt in ((found.at_min, inputs.min_misalignment), (found.at_max, inputs.max_misalignment)):
        load = solve(at_misalignment(inputs, found.crowning_ratio, tilt)).load_distribution
        assert (point.load_concentration, point.loaded_teeth) == (load.load_concentration, load.loaded_teeth)
    assert found.unloading_margin == pytest.approx(found.unloading_misalignment / inputs.max_misalignment)
    teeth = inputs.design.coupling.teeth
    for share, all_carry in ((0.98, True), (1.02, False)):
        tilt = share * found.unloading_misalignment
        load = solve(at_misalignment(inputs, found.crowning_ratio, tilt)).load_distribution
        assert (load.loaded_teeth == teeth) is all_carry


def test_without_a_crowning_there_is_no_radius() -> None:
    found = recommend(misalignments(0.05, 1.0))
    assert not found.feasible
    values = (found.crowning_radius, found.crowning_drop, found.unloading_misalignment, found.unloading_margin)
    assert values == (None, None, None, None)
