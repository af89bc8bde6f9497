"""Recommendation of a crowning ratio for a coupling whose misalignment varies within a given range.

The paper asks for a contact surface overlap below 1, and then for the largest possible load capacity. A larger crowning
ratio reduces the overlap, which is largest at the smallest misalignment. A larger ratio also moves the contact towards
the ends of the face; the contact is nearest to an end at the largest misalignment. The limit of the overlap therefore
sets a lower bound of the ratio, and the face width sets an upper bound. The limits of pressure and width of the contact
set further lower bounds. There may be no ratio between the bounds, or the upper bound may be only one percent above the
lower bound. The module solves for the bounds, and finds the ratio with the largest load capacity between them.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from math import exp, log

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from solvers.arrays import FloatArray, frozen
from solvers.coupling.inputs import (
    MAX_MISALIGNMENT,
    CouplingInputs,
    RecommendationInputs,
    check_inputs,
)
from solvers.coupling.kinematics import max_contact_travel, mesh_motion, tooth_geometry
from solvers.coupling.lubrication import MAX_CONTACT_PRESSURE, MAX_CONTACT_WIDTH, film_state
from solvers.coupling.model import solve
from solvers.coupling.results import CouplingResult, Derived, Geometry
from solvers.coupling.tooth_loads import SLIDING_VELOCITY_LIMIT
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.quantity import quantity, record
from solvers.sources import PAHL


@record(equation="C13")
class RecommendedPoint:
    """Results of the recommended coupling at one end of the misalignment range."""

    contact_overlap: float = quantity("contact surface overlap", "Pu", PAHL)
    load_capacity_coefficient: float = quantity("load capacity coefficient", "Tr", PAHL)
    friction_coefficient: float = quantity("coefficient of friction in use", "μ", equation="C18")
    axial_thrust: float = quantity(
        "axial thrust", "F_ax", unit="n", text="axial thrust at the axial velocity given", equation="C19"
    )
    sliding_velocity: float = quantity("largest sliding velocity", "v_G,max", unit="m_per_s", equation="C2")
    load_concentration: float = quantity(
        "load concentration", "F_max/F_m", text="largest over mean tooth force", equation="C7"
    )
    loaded_teeth: int = quantity("loaded teeth", "z_L", text="teeth that carry", equation="C7")


@record
class CrowningScan:
    """Smallest load capacity and largest overlap over the range, per crowning ratio with a computable contact."""

    crowning_ratio: FloatArray = quantity("crowning ratio scanned", "ε")
    min_load_capacity_coefficient: FloatArray = quantity(
        "smallest load capacity coefficient", "Tr", axis="crowning_ratio", gaps=True
    )
    max_contact_overlap: FloatArray = quantity(
        "largest contact surface overlap", "Pu", axis="crowning_ratio", gaps=True
    )
    feasible: tuple[bool, ...] = quantity("feasible", text="whether every constraint is met", axis="crowning_ratio")


@record(equation="C32")
class Recommendation:
    """The crowning ratio with the largest load capacity of all ratios that meet every constraint.

    A constraint must be met over the whole range of misalignment. If no ratio meets every constraint, `feasible`
    is False, and `failed_constraint` names the constraint that excludes all ratios: `contact_overlap`, `edge_contact`,
    `hertz_pressure`, `contact_width` or `sliding_velocity`. The crowning, its load capacity and the results at both
    ends of the range are then None.
    """

    feasible: bool = quantity("feasible crowning", text="whether any crowning ratio meets every constraint")
    crowning_ratio: float | None = quantity("best crowning ratio", "ε")
    crowning_radius: float | None = quantity(
        "radius of the crowning", "r_b", PAHL, unit="mm", text="radius of the cutter centre's path", equation="C1"
    )
    crowning_drop: float | None = quantity(
        "drop of the crowning",
        "c_b",
        unit="um",
        text="of the flank at both ends of the face against its middle, in the tangential plane",
        equation="C33",
    )
    tangential_flank_radius: float | None = quantity("flank radius in the tangential plane", "R_t", unit="mm")
    unloading_misalignment: float | None = quantity(
        "unloading misalignment",
        "δ_L",
        unit="deg",
        text="misalignment beyond which some tooth is free, with this crowning",
        equation="C10",
    )
    unloading_margin: float | None = quantity(
        "distance to unloading",
        "δ_L/δ_max",
        text="unloading misalignment over the largest of the range; below 1 some tooth is free there",
        equation="C10",
    )
    min_load_capacity_coefficient: float | None = quantity(
        "least load capacity coefficient", "Tr_min", text="smallest over the range"
    )
    failed_constraint: str | None = quantity("failed constraint", text="the constraint that leaves no crowning ratio")
    at_min: RecommendedPoint | None = quantity("at the smallest misalignment")
    at_max: RecommendedPoint | None = quantity("at the largest misalignment")
    scan: CrowningScan = quantity("scan", text="how crowning trades off", detail="curves")
    derived: Derived = quantity("proportions and oil used")
    warnings: tuple[Notice, ...]


MIN_CROWNING_RATIO = 0.2  # chosen: far below the ratios used in practice
MAX_CROWNING_RATIO = 1000.0  # chosen: at this ratio the teeth are nearly straight
# Constraints that set a lower bound of the crowning ratio: public name, and name of the attribute of `CrowningState`.
# The values of these attributes fall as the crowning ratio rises.
_LOWER_BOUNDS = (("hertz_pressure", "pressure"), ("contact_width", "width"), ("contact_overlap", "overlap"))
MAX_SCANNED_RATIO = 100.0  # chosen: end of the scanned range
_SCAN_POINTS = 49  # chosen: neighbouring ratios differ by a factor of 1.14
_WINDOW_POINTS = 25  # chosen: points of the grid from which the search for the best ratio starts

_REASONS = {
    "contact_overlap": "no crowning ratio up to 1000 brings the contact overlap below 1 at the smallest misalignment",
    "edge_contact": (
        "no crowning ratio satisfies both conditions: a contact overlap below 1 at the smallest misalignment, and a "
        "contact within the face at the largest misalignment; choose a smaller range of misalignment"
    ),
    "hertz_pressure": "no crowning ratio up to 1000 brings the Hertzian pressure below 2 GPa",
    "contact_width": "no crowning ratio up to 1000 keeps the contact narrower than a tenth of the flank radius",
    "sliding_velocity": "the sliding velocity exceeds its limit at every crowning ratio",
}


@dataclass(frozen=True, slots=True)
class CrowningState:
    """Constraints and load capacity of one crowning ratio, each at the worse end of the range of misalignment.

    `overlap` must be below 1; `edge` (travel over half the face), `pressure` and `width` (over their limits) at most 1.
    """

    overlap: float
    edge: float
    pressure: float
    width: float
    load_capacity_coefficient: float

    @property
    def computable(self) -> bool:
        """Whether the contact is within the limits of Hertz's theory."""
        return self.pressure <= 1.0 and self.width <= 1.0

    @property
    def feasible(self) -> bool:
        """Whether every constraint of the crowning is met."""
        return self.computable and self.overlap < 1.0 and self.edge <= 1.0


def at_misalignment(inputs: RecommendationInputs, ratio: float, misalignment: float) -> CouplingInputs:
    """Return the design with this crowning ratio at this misalignment [rad]."""
    design = inputs.design
    return replace(
        design,
        coupling=replace(design.coupling, crowning_ratio=ratio),
        operation=replace(design.operation, misalignment=misalignment),
    )


def crowning_state(inputs: RecommendationInputs, ratio: float) -> CrowningState:
    """Compute the constraints and the load capacity of a crowning ratio over the whole range of misalignment."""
    design = inputs.design
    crowned = replace(design, coupling=replace(design.coupling, crowning_ratio=ratio))
    geometry = tooth_geometry(crowned.coupling)
    first = _state_at(inputs.min_misalignment, crowned, geometry)
    last = _state_at(inputs.max_misalignment, crowned, geometry)
    return CrowningState(
        overlap=max(first.overlap, last.overlap),
        edge=max(first.edge, last.edge),
        pressure=max(first.pressure, last.pressure),
        width=max(first.width, last.width),
        load_capacity_coefficient=min(first.load_capacity_coefficient, last.load_capacity_coefficient),
    )


def _state_at(misalignment: float, crowned: CouplingInputs, geometry: Geometry) -> CrowningState:
    """Compute the constraints and the load capacity at one misalignment [rad]."""
    operation = replace(crowned.operation, misalignment=misalignment)
    mesh = mesh_motion(crowned.coupling, geometry, operation, crowned.model.kinematics)
    film = film_state(crowned, geometry, mesh)
    reach = max_contact_travel(mesh) + film.contact_half_width
    return CrowningState(
        overlap=film.overlap,
        edge=reach / (crowned.coupling.face_width / 2.0),
        pressure=film.contact_pressure / MAX_CONTACT_PRESSURE,
        width=film.contact_half_width / (MAX_CONTACT_WIDTH * geometry.normal_flank_radius),
        load_capacity_coefficient=film.load_capacity_coefficient,
    )


def crowning_window(state: Callable[[float], CrowningState]) -> tuple[float, float, str | None]:
    """Find the smallest and the largest crowning ratio that meet every constraint (Eq. C32).

    The limits of overlap, pressure and width each set a lower bound of the crowning ratio. The condition that the
    contact stays on the face sets the upper bound. Returns `low`: smallest crowning ratio of the window [-]; `high`:
    largest crowning ratio of the window [-]; `failed`: name of the constraint that excludes every crowning ratio; None
    if the window is not empty.
    """
    low = MIN_CROWNING_RATIO
    for name, constraint in _LOWER_BOUNDS:
        bound = _root(state, constraint)
        if bound >= MAX_CROWNING_RATIO:
            return low, low, name
        low = max(low, bound)
    # The overlap must be below 1, not equal to 1. A margin therefore keeps the window inside both bounds despite
    # rounding errors.
    low *= 1.0 + 1e-9
    high = _root(state, "edge") * (1.0 - 1e-9)
    return low, high, None if low < high else "edge_contact"


def _root(state: Callable[[float], CrowningState], constraint: str) -> float:
    """Crowning ratio at which a constraint is 1, or the nearer end of the permissible range."""

    def excess(logarithm: float) -> float:
        return log(getattr(state(exp(logarithm)), constraint))

    low, high = log(MIN_CROWNING_RATIO), log(MAX_CROWNING_RATIO)
    at_low, at_high = excess(low), excess(high)
    if at_low * at_high < 0.0:
        return exp(brentq(excess, low, high, xtol=1e-12, rtol=1e-12))
    rising = at_high > at_low
    below = at_low < 0.0
    return MAX_CROWNING_RATIO if rising == below else MIN_CROWNING_RATIO


def recommend(inputs: RecommendationInputs) -> Recommendation:
    """Find the crowning ratio with the largest load capacity coefficient for a range of misalignment.

    Parameters
    ----------
    inputs : RecommendationInputs
        Design, and smallest and largest misalignment.

    Returns
    -------
    Recommendation
        The crowning ratio with the results at both ends of the range, or the constraint that excludes every ratio.

    Raises
    ------
    InvalidInput
        The codes of `solve`; also `misalignment_range`, `no_load` and `not_turning`.
    NoSolution
        The codes of `solve`.

    Notes
    -----
    Eq. C32. The load capacity coefficient of a crowning ratio is the smaller of the coefficients at both ends of the
    range. There are three constraints: the overlap is below 1 at both ends of the range, the contact stays on the face
    at the largest misalignment, and the contact stays within the limits of Hertz's theory. If the range is a single
    value, the limit of the sliding velocity is a fourth constraint. If the range is wider, a sliding velocity above
    this limit only causes a warning. The warnings include the warnings that `solve` gives at both ends of the range.

    Examples
    --------
    >>> from math import radians
    >>> from solvers import coupling
    >>> design = coupling.Coupling(teeth=52, module=3e-3)
    >>> running = coupling.Operation(3000.0, 200.0, misalignment=0.0)
    >>> inputs = coupling.CouplingInputs(design, running)
    >>> found = coupling.recommend(coupling.RecommendationInputs(inputs, radians(0.1), radians(0.3)))
    >>> found.feasible
    True
    """
    _check(inputs)
    state = cache(partial(crowning_state, inputs))
    scan = _scan(state)
    sliding = _sliding_notices(inputs)
    if inputs.min_misalignment == inputs.max_misalignment and sliding:
        nowhere = replace(scan, feasible=(False,) * len(scan.feasible))
        return _infeasible("sliding_velocity", nowhere, Derived.of(inputs.design), sliding)
    low, high, failed = crowning_window(state)
    if failed is not None:
        return _infeasible(failed, scan, Derived.of(inputs.design), sliding)
    ratio = _best_ratio(state, low, high)
    at_min = solve(at_misalignment(inputs, ratio, inputs.min_misalignment))
    at_max = solve(at_misalignment(inputs, ratio, inputs.max_misalignment))
    unloading = at_max.load_distribution.unloading_misalignment
    return Recommendation(
        feasible=True,
        crowning_ratio=ratio,
        crowning_radius=at_max.geometry.crowning_radius,
        crowning_drop=at_max.geometry.crowning_drop,
        tangential_flank_radius=at_max.geometry.tangential_flank_radius,
        unloading_misalignment=unloading,
        unloading_margin=unloading / inputs.max_misalignment,
        min_load_capacity_coefficient=state(ratio).load_capacity_coefficient,
        failed_constraint=None,
        at_min=_point(at_min),
        at_max=_point(at_max),
        scan=scan,
        derived=Derived.of(inputs.design),
        warnings=_merged((*sliding, *at_min.warnings, *at_max.warnings)),
    )


def _best_ratio(state: Callable[[float], CrowningState], low: float, high: float) -> float:
    """Crowning ratio between `low` and `high` with the largest load capacity: the best of a scan, then refined."""
    grid = np.geomspace(low, high, _WINDOW_POINTS)
    capacity = [state(float(ratio)).load_capacity_coefficient for ratio in grid]
    best = int(np.argmax(capacity))
    bounds = log(grid[max(best - 1, 0)]), log(grid[min(best + 1, grid.size - 1)])

    def loss(logarithm: float) -> float:
        return -state(exp(logarithm)).load_capacity_coefficient

    refined = minimize_scalar(loss, bounds=bounds, method="bounded", options={"xatol": 1e-6})
    return exp(refined.x) if -refined.fun > capacity[best] else float(grid[best])


def _merged(notices: tuple[Notice, ...]) -> tuple[Notice, ...]:
    """First notice of each code; a notice about `misalignment` is one about `misalignment_range` here."""
    first: dict[str, Notice] = {}
    for notice in notices:
        first.setdefault(notice.code, notice)
    return tuple(
        replace(notice, field="misalignment_range") if notice.field == "misalignment" else notice
        for notice in first.values()
    )


def _point(result: CouplingResult) -> RecommendedPoint:
    overlap, capacity = result.lubrication.contact_overlap, result.lubrication.load_capacity_coefficient
    concentration = result.load_distribution.load_concentration
    assert overlap is not None
    assert capacity is not None
    assert concentration is not None
    return RecommendedPoint(
        contact_overlap=overlap,
        load_capacity_coefficient=capacity,
        friction_coefficient=result.lubrication.friction_coefficient,
        axial_thrust=result.axial_thrust.force,
        sliding_velocity=result.kinematics.max_sliding_velocity,
        load_concentration=concentration,
        loaded_teeth=result.load_distribution.loaded_teeth,
    )


def _scan(state: Callable[[float], CrowningState]) -> CrowningScan:
    """Compute the curves over all scanned crowning ratios for which the contact can be computed."""
    ratios = np.geomspace(MIN_CROWNING_RATIO, MAX_SCANNED_RATIO, _SCAN_POINTS)
    points = [(ratio, point) for ratio in ratios if (point := state(float(ratio))).computable]
    return CrowningScan(
        crowning_ratio=frozen([ratio for ratio, _ in points]),
        min_load_capacity_coefficient=frozen([point.load_capacity_coefficient for _, point in points]),
        max_contact_overlap=frozen([point.overlap for _, point in points]),
        feasible=tuple(point.feasible for _, point in points),
    )


def _infeasible(failed: str, scan: CrowningScan, used: Derived, warnings: tuple[Notice, ...]) -> Recommendation:
    """Return the recommendation that states that no crowning ratio meets every constraint."""
    return Recommendation(
        feasible=False,
        crowning_ratio=None,
        crowning_radius=None,
        crowning_drop=None,
        tangential_flank_radius=None,
        unloading_misalignment=None,
        unloading_margin=None,
        min_load_capacity_coefficient=None,
        failed_constraint=failed,
        at_min=None,
        at_max=None,
        scan=scan,
        derived=used,
        warnings=(*warnings, Notice("infeasible", _REASONS[failed], "misalignment_range", rank="invalid")),
    )


def _sliding_notices(inputs: RecommendationInputs) -> tuple[Notice, ...]:
    """Return a notice if the sliding velocity at the largest misalignment exceeds the limit."""
    radius = tooth_geometry(inputs.design.coupling).pitch_radius
    sliding = abs(inputs.design.operation.speed) * radius * inputs.max_misalignment
    if sliding <= SLIDING_VELOCITY_LIMIT:
        return ()
    message = (
        f"at the largest misalignment the sliding velocity is {sliding:.3g} m/s, which exceeds the limit of "
        f"{SLIDING_VELOCITY_LIMIT} m/s"
    )
    return (Notice("sliding_velocity", message, "misalignment_range"),)


def _check(inputs: RecommendationInputs) -> None:
    if not 0.0 < inputs.min_misalignment <= inputs.max_misalignment <= MAX_MISALIGNMENT:
        raise InvalidInput(
            "misalignment_range",
            "the smallest misalignment must be above 0, and the largest misalignment must lie between the smallest "
            "misalignment and 6 degrees",
            "misalignment_range",
        )
    check_inputs(at_misalignment(inputs, 1.0, inputs.max_misalignment))
    if inputs.design.operation.torque == 0.0:
        raise InvalidInput("no_load", "without torque every crowning ratio is suitable; give a torque", "torque")
    if inputs.design.operation.speed == 0.0:
        raise InvalidInput("not_turning", "without speed there is no oil film to maximise; give a speed", "speed")
