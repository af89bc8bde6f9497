"""Which crowning suits a coupling whose misalignment stays within a range.

The paper asks for a contact surface overlap below 1 and then for as much load capacity as possible. Overlap is largest
at the smallest misalignment and falls with the crowning ratio; the contact reaches the end of the face at the largest
misalignment and sooner the larger the ratio. Both leave a window, which may be a percent wide or empty: its ends are
solved for, and the load capacity is maximised between them.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from math import exp, log

import numpy as np
from scipy.optimize import minimize_scalar

from solvers.arrays import frozen
from solvers.coupling.checks import MAX_MISALIGNMENT, check_inputs
from solvers.coupling.crowning.results import CrowningScan, Recommendation, RecommendedPoint
from solvers.coupling.crowning.window import (
    MIN_CROWNING_RATIO,
    CrowningState,
    at_misalignment,
    crowning_state,
    crowning_window,
)
from solvers.coupling.inputs import Coupling, RecommendationInputs
from solvers.coupling.model import solve
from solvers.coupling.results import CouplingResult
from solvers.coupling.teeth.geometry import tooth_geometry
from solvers.coupling.teeth.limits import SLIDING_VELOCITY_LIMIT
from solvers.errors import InvalidInput
from solvers.notices import Notice

MAX_SCANNED_RATIO = 100.0
_SCAN_POINTS = 49
_WINDOW_POINTS = 25

_REASONS = {
    "contact_overlap": "no crowning ratio up to 1000 brings the overlap below 1 at the smallest misalignment",
    "edge_contact": "with an overlap below 1 at the smallest misalignment the contact leaves the face at the largest",
    "hertz_pressure": "no crowning ratio up to 1000 brings the Hertz pressure below 2 GPa",
    "contact_width": "no crowning ratio up to 1000 keeps the contact below a tenth of the flank radius",
    "sliding_velocity": "the sliding velocity exceeds its limit whatever the crowning",
}


def recommend(inputs: RecommendationInputs) -> Recommendation:
    """The crowning ratio with the largest load capacity coefficient at the worse end of the range of misalignment.

    Constraints: overlap < 1 at both ends, contact within the face at the largest misalignment, Hertz contact; with a
    range of one value also the sliding velocity, which a wider range only reports. The warnings are those of `solve`
    at both ends. Raises InvalidInput as `solve` and misalignment_range, no_load, not_turning; NoSolution as `solve`.
    """
    _check(inputs)
    state = cache(partial(crowning_state, inputs))
    scan = _scan(state)
    sliding = _sliding_notices(inputs)
    if inputs.min_misalignment == inputs.max_misalignment and sliding:
        nowhere = replace(scan, feasible=(False,) * len(scan.feasible))
        return _infeasible("sliding_velocity", nowhere, inputs.design.coupling, sliding)
    low, high, failed = crowning_window(state)
    if failed is not None:
        return _infeasible(failed, scan, inputs.design.coupling, sliding)
    ratio = _best_ratio(state, low, high)
    at_min = solve(at_misalignment(inputs, ratio, inputs.min_misalignment))
    at_max = solve(at_misalignment(inputs, ratio, inputs.max_misalignment))
    return Recommendation(
        feasible=True,
        crowning_ratio=ratio,
        min_load_capacity_coefficient=state(ratio).load_capacity_coefficient,
        failed_constraint=None,
        at_min=_point(at_min),
        at_max=_point(at_max),
        scan=scan,
        derived=inputs.design.coupling,
        warnings=_merged((*sliding, *at_min.warnings, *at_max.warnings)),
    )


def _best_ratio(state: Callable[[float], CrowningState], low: float, high: float) -> float:
    """The crowning ratio in the window with the largest load capacity: a grid, refined around its best point."""
    grid = np.geomspace(low, high, _WINDOW_POINTS)
    capacity = [state(float(ratio)).load_capacity_coefficient for ratio in grid]
    best = int(np.argmax(capacity))
    bounds = log(grid[max(best - 1, 0)]), log(grid[min(best + 1, grid.size - 1)])

    def loss(logarithm: float) -> float:
        return -state(exp(logarithm)).load_capacity_coefficient

    refined = minimize_scalar(loss, bounds=bounds, method="bounded", options={"xatol": 1e-6})
    return exp(refined.x) if -refined.fun > capacity[best] else float(grid[best])


def _merged(notices: tuple[Notice, ...]) -> tuple[Notice, ...]:
    """The first notice of every code; those about the misalignment are about its range here."""
    first: dict[str, Notice] = {}
    for notice in notices:
        first.setdefault(notice.code, notice)
    return tuple(
        replace(notice, field="misalignment_range") if notice.field == "misalignment" else notice
        for notice in first.values()
    )


def _point(result: CouplingResult) -> RecommendedPoint:
    """The recommended coupling at one misalignment."""
    overlap, capacity = result.lubrication.contact_overlap, result.lubrication.load_capacity_coefficient
    assert overlap is not None
    assert capacity is not None
    return RecommendedPoint(
        contact_overlap=overlap,
        load_capacity_coefficient=capacity,
        friction_coefficient=result.lubrication.friction_coefficient,
        axial_thrust=result.axial_thrust.force,
        sliding_velocity=result.kinematics.max_sliding_velocity,
    )


def _scan(state: Callable[[float], CrowningState]) -> CrowningScan:
    """Trade-off over the crowning ratios whose contact can be computed."""
    ratios = np.geomspace(MIN_CROWNING_RATIO, MAX_SCANNED_RATIO, _SCAN_POINTS)
    points = [(ratio, point) for ratio in ratios if (point := state(float(ratio))).computable]
    return CrowningScan(
        crowning_ratio=frozen([ratio for ratio, _ in points]),
        min_load_capacity_coefficient=frozen([point.load_capacity_coefficient for _, point in points]),
        max_contact_overlap=frozen([point.overlap for _, point in points]),
        feasible=tuple(point.feasible for _, point in points),
    )


def _infeasible(failed: str, scan: CrowningScan, coupling: Coupling, warnings: tuple[Notice, ...]) -> Recommendation:
    """No crowning ratio serves the whole range."""
    return Recommendation(
        feasible=False,
        crowning_ratio=None,
        min_load_capacity_coefficient=None,
        failed_constraint=failed,
        at_min=None,
        at_max=None,
        scan=scan,
        derived=coupling,
        warnings=(*warnings, Notice("infeasible", _REASONS[failed], "misalignment_range")),
    )


def _sliding_notices(inputs: RecommendationInputs) -> tuple[Notice, ...]:
    """A notice where the largest misalignment slides faster than the limit."""
    radius = tooth_geometry(inputs.design.coupling).pitch_radius
    sliding = abs(inputs.design.operation.speed) * radius * inputs.max_misalignment
    if sliding <= SLIDING_VELOCITY_LIMIT:
        return ()
    message = f"the sliding velocity reaches {sliding:.3g} m/s, beyond the limit of {SLIDING_VELOCITY_LIMIT} m/s"
    return (Notice("sliding_velocity", message, "misalignment_range"),)


def _check(inputs: RecommendationInputs) -> None:
    """Raise InvalidInput where no recommendation is possible at all."""
    if not 0.0 < inputs.min_misalignment <= inputs.max_misalignment <= MAX_MISALIGNMENT:
        raise InvalidInput(
            "misalignment_range",
            "give a rising range of misalignment above 0 and within 6 degrees",
            "misalignment_range",
        )
    check_inputs(at_misalignment(inputs, 1.0, inputs.max_misalignment))
    if inputs.design.operation.torque == 0.0:
        raise InvalidInput("no_load", "without torque every crowning serves; give a torque", "torque")
    if inputs.design.operation.speed == 0.0:
        raise InvalidInput("not_turning", "without speed there is no oil film to maximise; give a speed", "speed")
