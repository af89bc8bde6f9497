"""The speeds at which the radial gaps and the axial exits become sonic."""

from collections.abc import Callable
from functools import cache
from math import exp, log, sqrt

from scipy.optimize import brentq

from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.pumping.checks import check_speed
from solvers.pumping.inputs import ChokingInputs, Flow, rpm
from solvers.pumping.results import ChokingSpeeds
from solvers.pumping.spaces import Mesh, Space, flow_at, prepare

_COARSENING = 4  # of the slices while the speeds are bracketed
_BRACKET = 1.1  # around the coarse speed
_ACCURACY = 1e-4  # relative, of a speed
_STEPS_DOWN = 24  # factors of sqrt(2) below the search limit

Excess = Callable[[float], float]


def choking_speeds(inputs: ChokingInputs) -> ChokingSpeeds:
    """Lowest pinion speeds that choke the gaps or the exits of any of the spaces asked for.

    Radial gaps choke where the largest pressure reaches the critical ratio, exits where the ambient pressure asks for
    Mach 1. Raises InvalidInput and NoSolution as `solve` does, and choking_not_modelled.
    """
    setup, limit = inputs.setup, inputs.search_limit
    if setup.model.flow is Flow.INCOMPRESSIBLE:
        raise InvalidInput("choking_not_modelled", "incompressible flow cannot choke", "flow")
    mesh = prepare(setup)
    check_speed(mesh.pair, mesh.gas, limit)
    slices = setup.model.slice_count
    coarse = max(slices // _COARSENING, 10) if setup.model.flow is Flow.GAS_DYNAMICS else slices
    rough = [_Demand(mesh, space, coarse) for space in mesh.spaces]
    fine = [_Demand(mesh, space, slices) for space in mesh.spaces]
    radial = _lowest([(r.radial, f.radial) for r, f in zip(rough, fine, strict=True)], limit)
    axial = _lowest([(r.axial, f.axial) for r, f in zip(rough, fine, strict=True)], limit)
    notices = [
        Notice("beyond_search_limit", f"the {name} stays below sonic flow up to {rpm(limit):.6g} rpm", "search_limit")
        for name, speed in (("radial gap", radial), ("axial exit", axial))
        if speed is None
    ]
    return ChokingSpeeds(radial, axial, (*mesh.notices, *notices))


class _Demand:
    """By how much, in logarithms, a space at a logarithmic speed exceeds what chokes it; each speed is solved once."""

    def __init__(self, mesh: Mesh, space: Space, slices: int) -> None:
        @cache
        def both(log_speed: float) -> tuple[float, float]:
            flow = flow_at(mesh, space, exp(log_speed), slices)
            pressure = flow.largest_pressure * mesh.gas.critical_ratio / mesh.gas.pressure
            return log(pressure), log(max(flow.exit_demand, 1e-12))

        self._both = both

    def radial(self, log_speed: float) -> float:
        return self._both(log_speed)[0]

    def axial(self, log_speed: float) -> float:
        return self._both(log_speed)[1]


def _lowest(demands: list[tuple[Excess, Excess]], limit: float) -> float | None:
    """Lowest speed at which one of the demands is met: bracketed on the coarse grid, found on the fine one."""
    roots = [(root, fine) for rough, fine in demands if (root := _coarse_root(rough, log(limit))) is not None]
    if not roots:
        return None
    root, fine = min(roots, key=lambda pair: pair[0])
    return _refined(fine, root, log(limit))


def _coarse_root(excess: Excess, top: float) -> float | None:
    high = top
    if excess(high) < 0.0:
        return None
    for _ in range(_STEPS_DOWN):
        low = high - log(sqrt(2.0))
        if excess(low) < 0.0:
            return float(brentq(excess, low, high, xtol=1e-2))
        high = low
    return high


def _refined(excess: Excess, root: float, top: float) -> float | None:
    low, high = root - log(_BRACKET), min(root + log(_BRACKET), top)
    while excess(low) >= 0.0:
        low, high = low - log(_BRACKET), low
    while excess(high) < 0.0:
        if high >= top:
            return None
        low, high = high, min(high + log(_BRACKET), top)
    return exp(brentq(excess, low, high, xtol=_ACCURACY))
