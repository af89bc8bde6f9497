"""Errors of discretisation, estimated from the same flow at half and a quarter of the resolution.

The kinks of a stroke leave numbers of first order in the width of the slices. For two grids and first order Roache's
grid convergence index states three times their difference as the uncertainty of the finer one (J. Fluids Eng. 116,
1994, 405). Extremes move between the slices, and two grids may agree on one by chance: a third grid with a quarter of
the resolution is compared as well, a fifth is added to the estimate, and places count that are not the highest yet but
rise with the resolution. Of 800 random pairs, one then changed by more than the stated uncertainty with twice the
slices, by a hundredth more.

Grids may also agree on an extreme while the pressure around it differs, because they damp its waves alike: what they
differ by close to it counts as well. And where the meshing line moves along the face about as fast as sound, its own
waves leave it within a layer too thin for the slices of the coarser grids. These do not resolve it and agree among
themselves; the rate of convergence is then not used.
"""

from math import expm1
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.space_flow import SpaceFlow
from solvers.pumping.results import Resolution

SAFETY = 3.0  # times the difference of two grids, as in the grid convergence index (Roache 1994)
OF_EXTREMES = 1.2  # times that
RISE = 2.0  # times what a place rose from half the resolution to all of it, it may still rise
NEAR = 0.97  # of the largest Mach number: from there on that of the slices may overtake the one at the end of the face
CLOSE = 0.9  # of an extreme gauge pressure: where and while that is reached, the pressure is close to the extreme
SPREAD = 4.0  # slices over which a grid spreads a wave
LOST = 1.0  # where a pressure is not known to its own size, no number is: the finer flow may be another one


class Grids(NamedTuple):
    """One stroke at the resolution asked for, at half and at a quarter of it.

    `lead`: by how much sound gets ahead of the meshing line along the face, or falls behind it, as a share of the way.
    """

    flow: SpaceFlow
    halved: SpaceFlow
    quartered: SpaceFlow
    lead: float

    @property
    def blind(self) -> bool:
        """Whether the waves of the meshing line stay closer to it than the coarsest grid resolves."""
        return self.lead * self.quartered.position.size < SPREAD


def resolution(gas: Gas, spaces: list[Grids]) -> Resolution:
    """Relative uncertainties of the summary, the largest of all spaces asked for; pressures as gauge pressures.

    Eq. P15.
    """
    shares = [_shares(gas, grids) for grids in spaces]
    uncertain = {name: max(each[name] for each in shares) for name in shares[0]}
    if max(uncertain["peak_pressure"], uncertain["min_pressure"]) >= LOST:
        uncertain = {name: max(share, LOST) for name, share in uncertain.items()}
    return Resolution(
        peak_pressure=uncertain["peak_pressure"],
        min_pressure=uncertain["min_pressure"],
        axial_mach=uncertain["axial_mach"],
        pumping_power=uncertain["pumping_power"],
        temperature_rise=uncertain.get("temperature_rise"),
        gross_flow=max(uncertain[name] for name in ("front_out", "front_in", "rear_out", "rear_in")),
    )


def behind_jumps(resolved: Resolution, gas: Gas, flows: list[SpaceFlow], jumps: list[float]) -> Resolution:
    """The uncertainties, each at least as large as the effect of the jumps of the area, which no resolution reduces.

    A jump of the logarithm of the area compresses the gas by a share of its pressure, and changes the Mach number by
    that of a wave of this pressure. Where the compression is as large as the gauge pressure, no number is certain.
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
    """Share of the pressure by which a jump of the area's logarithm changes it at once."""
    return expm1(gas.exponent * jump)


def net_uncertainty(grids: Grids, jumped: float) -> float:
    """Mass [kg] by which the net flow of an end may be off in a stroke, from half the resolution.

    At least what leaves and what enters change together: their difference may change less by luck. And at least what a
    jump of the area, of which the pressure changes by the share `jumped`, moves of all that passes the ends.
    """
    here, there = grids.flow.ends, grids.halved.ends
    ends = ((here.front, there.front), (here.rear, there.rear))
    net = max(abs(float(fine.sum() - coarse.sum())) for fine, coarse in ends)
    gross = max(abs(_sum(fine) - _sum(coarse)) + abs(_sum(-fine) - _sum(-coarse)) for fine, coarse in ends)
    passing = sum(float(np.abs(fine).sum()) for fine, _ in ends)
    return max(SAFETY * net, gross, min(jumped, LOST) * passing)


def radial_uncertainty(grids: Grids, jumped: float) -> float:
    """Mass [kg] by which the net radial flow, the rest of the mass balance, may be wrong in a stroke."""
    radial = SAFETY * abs(grids.flow.masses.radial - grids.halved.masses.radial)
    return max(radial, net_uncertainty(grids, jumped))


def _shares(gas: Gas, grids: Grids) -> dict[str, float]:
    """Relative uncertainties of the summary of one space."""
    fine, half, quarter = (_summary(gas, flow) for flow in (grids.flow, grids.halved, grids.quartered))
    shares = {name: _relative(value, half[name], quarter[name]) for name, value in fine.items()}
    for name, reach in _reaches(gas, grids).items():
        shares[name] = max(OF_EXTREMES * shares[name], _of(reach - fine[name], fine[name]))
    apart = _side_by_side(gas, grids.flow, grids.halved)
    for name, sign in (("peak_pressure", 1.0), ("min_pressure", -1.0)):
        around = _difference(*(sign * pressure for pressure in apart))
        shares[name] = max(shares[name], SAFETY * _of(around, fine[name]))
    if grids.blind:
        for name in ("peak_pressure", "min_pressure", "pumping_power"):
            shares[name] = max(shares[name], SAFETY * _of(abs(quarter[name] - fine[name]), abs(fine[name])))
    return shares


def _side_by_side(gas: Gas, fine: SpaceFlow, coarse: SpaceFlow) -> tuple[FloatArray, FloatArray]:
    """Gauge pressures [Pa] of two grids at the angles of the coarse and the positions of the fine one."""
    here = [np.interp(coarse.angle, fine.angle, column) for column in fine.pressure.T]
    there = [np.interp(fine.position, coarse.position, row) for row in coarse.pressure]
    return np.transpose(here) - gas.pressure, np.array(there) - gas.pressure


def _difference(here: FloatArray, there: FloatArray) -> float:
    """Root mean square of the difference of two pressures where and while both are close to their maximum."""
    close = (here >= CLOSE * here.max()) & (there >= CLOSE * there.max())
    return float(np.sqrt(np.mean((here - there)[close] ** 2))) if close.any() else 0.0


def _summary(gas: Gas, flow: SpaceFlow) -> dict[str, float]:
    numbers = {
        "peak_pressure": flow.largest_pressure - gas.pressure,
        "min_pressure": gas.pressure - flow.smallest_pressure,
        "axial_mach": flow.largest_mach,
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
    """What extremes over the face may reach with more slices."""
    fine, half = grids.flow, grids.halved
    here, there = _profiles(gas, fine), _profiles(gas, half)
    reaches = {name: _reach(fine.position, here[name], half.position, there[name]) for name in here}
    reaches["axial_mach"] = _mach_reach(fine, half)
    return reaches


def _mach_reach(fine: SpaceFlow, half: SpaceFlow) -> float:
    """The same for the Mach number, which may be largest at an end of the face or in a slice.

    A choked end holds its own at one on every grid. The slices beside any end near its own as they get shorter: what
    they would reach beyond it counts.
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
    """Over the face: the extremes of each slice, as they enter the summary."""
    profiles = {
        "peak_pressure": flow.peak_pressure - gas.pressure,
        "min_pressure": gas.pressure - flow.lowest_pressure,
    }
    if flow.mean_stagnation_temperature is not None:
        profiles["temperature_rise"] = flow.mean_stagnation_temperature - gas.temperature
    return profiles


def _reach(position: FloatArray, here: FloatArray, coarse: FloatArray, there: FloatArray, times: float = RISE) -> float:
    """Largest value that a local maximum over the face may reach, if it rises on by so many times its last rise."""
    edged = np.pad(here, 1, constant_values=-np.inf)
    tops = (here >= edged[:-2]) & (here >= edged[2:])
    around = np.pad(np.interp(position, coarse, there), 1, mode="edge")
    before = np.lib.stride_tricks.sliding_window_view(around, 3).max(axis=1)
    return float((here + times * np.maximum(here - before, 0.0))[tops].max())


def _relative(value: float, half: float, quarter: float) -> float:
    """Three times the error, if of first order: a quarter of the resolution differs by that, half by a third of it."""
    return max(SAFETY * abs(half / value - 1.0), abs(quarter / value - 1.0)) if value != 0.0 else 0.0


def _of(error: float, value: float) -> float:
    """An error as a share of its value."""
    return error / value if value > 0.0 else 0.0


def _sum(masses: FloatArray) -> float:
    return float(np.maximum(masses, 0.0).sum())
