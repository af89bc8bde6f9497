"""Errors of discretisation, estimated from the same flow at half and a quarter of the resolution.

The flow has kinks during a stroke, so errors are of first order in the width of the slices, and Roache's grid
convergence index is three times the difference of two grids (J. Fluids Eng. 116, 1994, 405).

An extreme may lie between two slices, and two grids may agree on it by chance. So the third grid counts too, extremes
get a fifth more, smaller local peaks that grow with the resolution count, and the pressures near an extreme as well. Of
800 random pairs with twice the slices, one result left its uncertainty, by 1 %.

The Mach numbers at the ends decide whether the flow chokes. They take the factor for three grids, 1.25, because a wide
band would leave the verdict in doubt without reason.

If the meshing line moves about as fast as sound, the waves ahead of it are confined to a layer thinner than the slices
of the coarser grids, which then agree without resolving it: no order of convergence is assumed there.
"""

from math import expm1
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.space_flow import SpaceFlow
from solvers.pumping.results import Resolution

SAFETY = 3.0  # factor on the difference of two grids, as in the grid convergence index (Roache 1994)
OF_THREE_GRIDS = 1.25  # factor on the difference if three grids show how the differences fall (Roache 1994)
UNSEEN = 0.002  # share of a Mach number at an end; error of the areas' table, which more slices do not show; observed
OF_EXTREMES = 1.2  # further factor on the uncertainty of extremes
RISE = 2.0  # a value may rise further by this factor times its rise from half to full resolution
NEAR = 0.97  # share of the Mach number at an end; a slice above this share may exceed the end on a finer grid
CLOSE = 0.9  # share of an extreme gauge pressure; larger pressures count as close to the extreme
SPREAD = 4.0  # number of slices over which a grid spreads a wave
LOST = 1.0  # if a pressure has this relative uncertainty, a finer grid may give another flow; no result is certain


class Grids(NamedTuple):
    """Flow in a tooth space over one stroke, at the full resolution, at half and at a quarter of this resolution.

    `lead` is |c - v|/v, where c is the ambient speed of sound, and v is the speed of the meshing line along the face.
    For flow models without waves, `lead` is infinite.
    """

    flow: SpaceFlow
    halved: SpaceFlow
    quartered: SpaceFlow
    lead: float

    @property
    def has_unresolved_waves(self) -> bool:
        """Whether the waves ahead of or behind the meshing line are too short for the coarsest grid."""
        return self.lead * self.quartered.position.size < SPREAD


def resolution(gas: Gas, spaces: list[Grids]) -> Resolution:
    """Estimate the relative uncertainties of the results from coarser grids (Eq. P15)."""
    shares = [uncertainties(gas, grids) for grids in spaces]
    uncertain = {name: max(of_space[name] for of_space in shares) for name in shares[0]}
    return Resolution(
        peak_pressure=uncertain["peak_pressure"],
        min_pressure=uncertain["min_pressure"],
        axial_mach=uncertain["axial_mach"],
        pumping_power=uncertain["pumping_power"],
        temperature_rise=uncertain.get("temperature_rise"),
        gross_flow=max(uncertain[name] for name in ("front_out", "front_in", "rear_out", "rear_in")),
    )


def behind_jumps(resolved: Resolution, gas: Gas, flows: list[SpaceFlow], jumps: list[float]) -> Resolution:
    """Raise the uncertainties to the effect of jumps of the area, which no resolution reduces.

    The Mach number gets that of a wave of the pressure rise; if a pressure is uncertain by 1, so is every result.
    """
    peak, low, mach = resolved.peak_pressure, resolved.min_pressure, resolved.axial_mach
    shares = [compressed(gas, jump) for jump in jumps]
    for flow, share in zip(flows, shares, strict=True):
        peak = max(peak, share, _of(share * flow.largest_pressure, flow.largest_pressure - gas.pressure))
        low = max(low, share, _of(share * flow.smallest_pressure, gas.pressure - flow.smallest_pressure))
        mach = max(mach, share, _of(share / gas.exponent, flow.largest_mach))
    least = LOST if max(peak, low) >= LOST else max(shares)
    heated = resolved.temperature_rise
    return Resolution(
        peak_pressure=max(peak, least),
        min_pressure=max(low, least),
        axial_mach=max(mach, least),
        pumping_power=max(resolved.pumping_power, least),
        temperature_rise=None if heated is None else max(heated, least),
        gross_flow=max(resolved.gross_flow, least),
    )


def compressed(gas: Gas, jump: float) -> float:
    """Compute the relative change of the pressure that a jump of the logarithm of the area causes."""
    return expm1(gas.exponent * jump)


def net_uncertainty(grids: Grids, jumped: float) -> float:
    """Uncertainty of the net mass [kg] that passes an end in a stroke, from the flow at half the resolution.

    At least the changes of outflow and inflow together, which may cancel, and the share `jumped` of all mass that
    passes.
    """
    here, there = grids.flow.ends, grids.halved.ends
    ends = ((here.front, there.front), (here.rear, there.rear))
    net = max(abs(float(fine.sum() - coarse.sum())) for fine, coarse in ends)
    gross = max(abs(_sum(fine) - _sum(coarse)) + abs(_sum(-fine) - _sum(-coarse)) for fine, coarse in ends)
    passing = sum(float(np.abs(fine).sum()) for fine, _ in ends)
    return max(SAFETY * net, gross, min(jumped, LOST) * passing)


def radial_uncertainty(grids: Grids, jumped: float) -> float:
    """Uncertainty of the net mass [kg] that leaves radially in a stroke, at least that of `net_uncertainty`."""
    radial = SAFETY * abs(grids.flow.masses.radial - grids.halved.masses.radial)
    return max(radial, net_uncertainty(grids, jumped))


def uncertainties(gas: Gas, grids: Grids) -> dict[str, float]:
    """Estimate the relative uncertainties of the results of one tooth space.

    If a pressure is entirely uncertain, so is every result.
    """
    shares = _shares(gas, grids)
    lost = max(shares["peak_pressure"], shares["min_pressure"]) >= LOST
    return {name: max(share, LOST) for name, share in shares.items()} if lost else shares


def _shares(gas: Gas, grids: Grids) -> dict[str, float]:
    fine, half, quarter = (_summary(gas, flow) for flow in (grids.flow, grids.halved, grids.quartered))
    shares = {name: _relative(value, half[name], quarter[name]) for name, value in fine.items()}
    for name in ("outflow_mach", "inflow_mach"):
        shares[name] = _of_three_grids(fine[name], half[name], quarter[name])
    for name, reach in _reaches(gas, grids).items():
        shares[name] = max(OF_EXTREMES * shares[name], _of(reach - fine[name], fine[name]))
    apart = _side_by_side(gas, grids.flow, grids.halved)
    for name, sign in (("peak_pressure", 1.0), ("min_pressure", -1.0)):
        around = _difference(*(sign * pressure for pressure in apart))
        shares[name] = max(shares[name], SAFETY * _of(around, fine[name]))
    if grids.has_unresolved_waves:
        for name in ("peak_pressure", "min_pressure", "pumping_power"):
            shares[name] = max(shares[name], SAFETY * _of(abs(quarter[name] - fine[name]), abs(fine[name])))
    return shares


def _side_by_side(gas: Gas, fine: SpaceFlow, coarse: SpaceFlow) -> tuple[FloatArray, FloatArray]:
    """Interpolate the gauge pressures [Pa] of two flows to the angles of `coarse` and the positions of `fine`."""
    here = [np.interp(coarse.angle, fine.angle, column) for column in fine.pressure.T]
    there = [np.interp(fine.position, coarse.position, row) for row in coarse.pressure]
    return np.transpose(here) - gas.pressure, np.array(there) - gas.pressure


def _difference(here: FloatArray, there: FloatArray) -> float:
    """Compute the root mean square difference of two fields, over the points at which both are near their maxima."""
    close = (here >= CLOSE * here.max()) & (there >= CLOSE * there.max())
    return float(np.sqrt(np.mean((here - there)[close] ** 2))) if close.any() else 0.0


def _summary(gas: Gas, flow: SpaceFlow) -> dict[str, float]:
    numbers = {
        "peak_pressure": flow.largest_pressure - gas.pressure,
        "min_pressure": gas.pressure - flow.smallest_pressure,
        "axial_mach": flow.largest_mach,
        "outflow_mach": flow.exit_demand,
        "inflow_mach": flow.inflow_demand,
        "pumping_power": flow.work,
        "front_out": _sum(flow.ends.front),
        "front_in": _sum(-flow.ends.front),
        "rear_out": _sum(flow.ends.rear),
        "rear_in": _sum(-flow.ends.rear),
    }
    if flow.mean_stagnation_temperature is not None:
        numbers["temperature_rise"] = float(flow.mean_stagnation_temperature.max()) - gas.temperature
    return numbers


def _reaches(gas: Gas, grids: Grids) -> dict[str, float]:
    """Estimate the values that the extremes over the face may reach with more slices."""
    fine, half = grids.flow, grids.halved
    here, there = _profiles(gas, fine), _profiles(gas, half)
    reaches = {name: _reach(fine.position, here[name], half.position, there[name]) for name in here}
    reaches["axial_mach"] = _mach_reach(fine, half)
    return reaches


def _mach_reach(fine: SpaceFlow, half: SpaceFlow) -> float:
    """How large the Mach number may become with more slices.

    A choked end is at 1 on every grid; slices beside it approach 1 and may rise above it.
    """
    slices, end = float(fine.peak_mach.max()), fine.largest_mach
    if slices == end:
        return _reach(fine.position, fine.peak_mach, half.position, half.peak_mach)
    if fine.exit_demand >= 1.0:
        return end + OF_EXTREMES * abs(slices - float(half.peak_mach.max()))
    if slices < NEAR * end:
        return end
    return end + RISE * max(_reach(fine.position, fine.peak_mach, half.position, half.peak_mach, 1.0) - end, 0.0)


def _profiles(gas: Gas, flow: SpaceFlow) -> dict[str, FloatArray]:
    """Largest gauge pressure, depth below ambient [Pa] and mean temperature rise [K] of every slice in the stroke."""
    profiles = {
        "peak_pressure": flow.peak_pressure - gas.pressure,
        "min_pressure": gas.pressure - flow.lowest_pressure,
    }
    if flow.mean_stagnation_temperature is not None:
        profiles["temperature_rise"] = flow.mean_stagnation_temperature - gas.temperature
    return profiles


def _reach(position: FloatArray, here: FloatArray, coarse: FloatArray, there: FloatArray, times: float = RISE) -> float:
    """Largest local peak over the face if every peak grows again by `times` its growth from the coarse grid."""
    edged = np.pad(here, 1, constant_values=-np.inf)
    tops = (here >= edged[:-2]) & (here >= edged[2:])
    around = np.pad(np.interp(position, coarse, there), 1, mode="edge")
    before = np.lib.stride_tricks.sliding_window_view(around, 3).max(axis=1)
    return float((here + times * np.maximum(here - before, 0.0))[tops].max())


def _relative(value: float, half: float, quarter: float) -> float:
    """Relative uncertainty: three times the difference from half the resolution, or that from a quarter if larger."""
    return max(SAFETY * abs(half / value - 1.0), abs(quarter / value - 1.0)) if value != 0.0 else 0.0


def _of_three_grids(value: float, half: float, quarter: float) -> float:
    """Relative uncertainty of a Mach number by which choking is decided.

    The difference from half the resolution, or half that between the coarser grids if larger: two may agree by chance.
    """
    if value == 0.0:
        return 0.0
    error = max(abs(half - value), abs(quarter - half) / 2) / value
    return max(OF_THREE_GRIDS * error, UNSEEN)


def _of(error: float, value: float) -> float:
    """Return an error divided by `value`, or 0 if `value` is not positive."""
    return error / value if value > 0.0 else 0.0


def _sum(masses: FloatArray) -> float:
    return float(np.maximum(masses, 0.0).sum())
