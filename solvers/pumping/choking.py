"""The speeds at which the flow through the radial gaps and through the axial exits becomes sonic."""

from collections.abc import Callable
from itertools import pairwise
from math import exp, log, sqrt
from operator import itemgetter
from typing import NoReturn

from scipy.optimize import brentq

from solvers.arrays import frozen
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.pumping.checks import check_speed
from solvers.pumping.inputs import ChokingInputs, Flow, rpm
from solvers.pumping.results import ChokingCurves, ChokingSpeeds
from solvers.pumping.spaces import CELL_STEP_LIMIT, Mesh, Space, derived, flow_at, prepare
from solvers.pumping.verdict import bands, decide, on_grids

_COARSENING = 4  # the number of slices is divided by this factor while the speeds are bracketed
_BRACKET = log(1.1)  # half width of the bracket around the result of the coarse grid, as a logarithm of the speed
_ACCURACY = 1e-4  # accuracy of the logarithm of the speed, which means 0.01 % of the speed
_STEP_DOWN, _STEPS_DOWN = log(sqrt(2.0)), 24  # logarithmic step of the scan; number of steps to 1/4096 of the limit
_SOLVES = 8  # divisor of the permitted cost of a single solution, because the search needs several solutions

Excess = Callable[[float], float]


def choking_speeds(inputs: ChokingInputs) -> ChokingSpeeds:
    """Find the lowest pinion speeds at which the radial gaps or the axial exits of a tooth space choke.

    Parameters
    ----------
    inputs : ChokingInputs
        Gears, grooves, ambient gas and model, and the speed at which the search ends [rad/s].

    Returns
    -------
    ChokingSpeeds
        Lowest choking speeds over the selected spaces [rad/s], the curves of a scan over the speed, and warnings.

    Raises
    ------
    InvalidInput
        `choking_not_modelled` if the flow is incompressible, `always_choked` if the spaces choke even at the lowest
        speed of the scan; the codes of `solve`.
    NoSolution
        The codes of `solve`.

    Notes
    -----
    Eq. P11. A radial gap chokes where the largest pressure over the ambient one reaches the inverse of the critical
    ratio, an exit where the gas would reach Mach 1 by an expansion to ambient pressure, and the inflow where the air
    that fills the spaces would exceed Mach 1 by its expansion to the pressure inside.

    Examples
    --------
    >>> from solvers import pumping
    >>> from solvers.gears.inputs import GearPairInputs, GearTeeth
    >>> gears = GearPairInputs(GearTeeth(39), GearTeeth(130), 6e-3, 0.2, rack_tip_radius=0.25)
    >>> chain = pumping.PumpingModel(pumping.Flow.POCKET_CHAIN, slices=4)
    >>> found = pumping.choking_speeds(pumping.ChokingInputs(pumping.PumpingSetup(gears, model=chain)))
    >>> round(found.axial_choking_speed)
    1019
    """
    setup, top = inputs.setup, log(inputs.search_limit)
    if setup.model.flow is Flow.INCOMPRESSIBLE:
        raise InvalidInput(
            "choking_not_modelled", "incompressible flow cannot choke; choose another flow model", "flow"
        )
    mesh = prepare(setup)
    check_speed(inputs.search_limit)
    slices = setup.model.slice_count
    coarse = max(slices // _COARSENING, 10) if setup.model.flow is Flow.GAS_DYNAMICS else slices
    rough = [_Demand(mesh, space, coarse) for space in mesh.spaces]
    fine = [_Demand(mesh, space, slices) for space in mesh.spaces]
    scan = _scan(rough, top)  # brackets the speeds on a coarse grid; the full grid then refines them
    radial = _find_lowest([(r.radial, f.radial) for r, f in zip(rough, fine, strict=True)], scan)
    axial = _find_lowest([(r.axial, f.axial) for r, f in zip(rough, fine, strict=True)], scan)
    inflow = _find_lowest([(r.inflow, f.inflow) for r, f in zip(rough, fine, strict=True)], scan)
    notices = _beyond_limit(mesh, inputs.search_limit, radial, axial, inflow)
    return ChokingSpeeds(radial, axial, inflow, _curves(mesh, rough, scan), derived(mesh), (*mesh.notices, *notices))


def _beyond_limit(
    mesh: Mesh, limit: float, radial: float | None, axial: float | None, inflow: float | None
) -> list[Notice]:
    """Say which flows are not sonic up to the search limit, and whether that is doubtful at this number of slices."""
    speeds = {"clearances": radial, "outflow": axial, "inflow": inflow}
    names = {"clearances": "radial gap", "outflow": "axial exit", "inflow": "axial inlet"}
    if all(speed is not None for speed in speeds.values()):
        return []
    slices = mesh.setup.model.slice_count
    found = [bands(mesh.gas, space.table, on_grids(mesh, space, limit, slices)) for space in mesh.spaces]
    verdict, notices = decide(found, slices, slices), []
    for flow, speed in speeds.items():
        if speed is None:
            message = f"the flow through the {names[flow]} stays below the speed of sound up to {rpm(limit):.6g} rpm"
            if getattr(verdict, flow) == "doubtful":
                message = f"with {slices} slices {message}, but the uncertainty of the result includes sonic flow"
            notices.append(Notice("beyond_search_limit", message, "search_limit", rank="note"))
    return notices


class _Demand:
    """Distance of a tooth space from choking over the logarithm of the pinion speed; at least 0: it chokes.

    `radial` is ln(p/p_c) of the largest pressure, `axial` and `inflow` are logarithms of Mach numbers at the ends.
    """

    def __init__(self, mesh: Mesh, space: Space, slices: int) -> None:
        self._mesh, self._space, self._slices = mesh, space, slices
        self._excess: dict[float, tuple[float, float, float]] = {}

    def radial(self, log_speed: float) -> float:
        return self.excess(log_speed)[0]

    def axial(self, log_speed: float) -> float:
        return self.excess(log_speed)[1]

    def inflow(self, log_speed: float) -> float:
        return self.excess(log_speed)[2]

    def excess(self, log_speed: float) -> tuple[float, float, float]:
        """Return the results of `radial`, `axial` and `inflow`."""
        if log_speed not in self._excess:
            gas, limit = self._mesh.gas, CELL_STEP_LIMIT // _SOLVES
            flow = flow_at(self._mesh, self._space, exp(log_speed), self._slices, cell_step_limit=limit)
            pressure = flow.largest_pressure * gas.critical_ratio / gas.pressure
            outflow, inflow = (log(max(demand, 1e-12)) for demand in (flow.exit_demand, flow.inflow_demand))
            self._excess[log_speed] = log(pressure), outflow, inflow
        return self._excess[log_speed]


def _scan(demands: list[_Demand], top: float) -> list[float]:
    """Lower the speed from e^`top` until nothing chokes; return the logarithms of the speeds, ascending."""
    speeds = [top]
    while any(max(demand.excess(speeds[-1])) >= 0.0 for demand in demands):
        if len(speeds) > _STEPS_DOWN:
            _refuse_sealed(exp(speeds[-1]))
        speeds.append(speeds[-1] - _STEP_DOWN)
    return speeds[::-1]


def _refuse_sealed(speed: float) -> NoReturn:
    message = (
        f"even at {rpm(speed):.3g} rpm of the pinion the tooth spaces are choked, because the openings are too small; "
        "increase the openings"
    )
    raise InvalidInput("always_choked", message, "discharge_coefficient")


def _find_lowest(demands: list[tuple[Excess, Excess]], scan: list[float]) -> float | None:
    """Lowest pinion speed at which a space chokes, bracketed on a coarse grid and refined on a fine one."""
    roots = [(root, fine) for rough, fine in demands if (root := _find_coarse_root(rough, scan)) is not None]
    if not roots:
        return None
    root, fine = min(roots, key=itemgetter(0))
    return _refine(fine, root, scan[-1])


def _find_coarse_root(excess: Excess, scan: list[float]) -> float | None:
    for low, high in pairwise(scan):
        if excess(high) >= 0.0:
            return float(brentq(excess, low, high, xtol=1e-2))
    return None


def _refine(excess: Excess, root: float, top: float) -> float | None:
    low, high = root - _BRACKET, min(root + _BRACKET, top)
    while excess(low) >= 0.0:
        low, high = low - _BRACKET, low
    while excess(high) < 0.0:
        if high >= top:
            return None
        low, high = high, min(high + _BRACKET, top)
    return exp(brentq(excess, low, high, xtol=_ACCURACY))


def _curves(mesh: Mesh, demands: list[_Demand], scan: list[float]) -> ChokingCurves:
    """Return peak pressure ratio and Mach numbers at the speeds of the scan.

    Every value is the largest value of all tooth spaces.
    """
    return ChokingCurves(
        pinion_speed=frozen([exp(speed) for speed in scan]),
        peak_pressure_ratio=frozen(
            [exp(max(d.radial(speed) for d in demands)) / mesh.gas.critical_ratio for speed in scan]
        ),
        exit_mach=frozen([exp(max(d.axial(speed) for d in demands)) for speed in scan]),
        inflow_mach=frozen([exp(max(d.inflow(speed) for d in demands)) for speed in scan]),
    )
