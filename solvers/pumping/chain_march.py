"""The march of a chain of pockets through its strokes: pockets that come and go, and the books."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.chain_step import Pockets, advance
from solvers.pumping.duct import (
    ACTIVE,
    BEGUN,
    ENDED,
    IDLE,
    LARGEST_DEMAND,
    LARGEST_MACH,
    LARGEST_PRESSURE,
    LARGEST_VELOCITY,
    LOW_END,
    PEAK,
    SMALLEST_PRESSURE,
    STAGNATION,
    STATIC,
    WALLS,
    WORK,
    Duct,
    Record,
    active_range,
    wall_values,
)
from solvers.pumping.nozzle import Gas, throat_mach


@kernel
def march_chain(
    gas: Gas, duct: Duct, pockets: Pockets, angles: FloatArray, substeps: int, record: Record, isentropic: bool
) -> int:
    """March over all `angles` [rad] in equal steps; their number, or -1 if one did not converge."""
    turn = (angles[-1] - angles[0]) / ((angles.size - 1) * substeps)
    dt = turn / duct.speed
    low, high, taken = 0, 0, 0
    for k in range(1, angles.size):
        for _ in range(substeps):
            angle = angles[0] + taken * turn
            new_low, new_high = active_range(duct, angle + 0.5 * turn)
            _renew(gas, duct, pockets, record, low, high, new_low, new_high, angle)
            low, high = new_low, new_high
            _set_walls(duct, pockets, low, high, angle, turn)
            if high > low and not advance(gas, duct, pockets, low, high, dt, isentropic):
                return -1
            record.ends[taken, 0] = (taken + 0.5) * dt
            if high > low:
                _book(gas, duct, pockets, record, low, high, dt, taken)
            taken += 1
        for i in range(low, high):
            record.field[k, i, 0], record.field[k, i, 2] = pockets.old[i, 0], _temperature(gas, pockets, i, 1)
            record.field[k, i, 1] = max(_mach(gas, pockets, i, low, high), _mach(gas, pockets, i + 1, low, high))
    _renew(gas, duct, pockets, record, low, high, 0, 0, angles[-1])
    return taken


@kernel
def _renew(
    gas: Gas,
    duct: Duct,
    pockets: Pockets,
    record: Record,
    low: int,
    high: int,
    new_low: int,
    new_high: int,
    angle: float,
) -> None:
    """Give the content of pockets whose stroke is over back, fill those whose stroke begins with ambient gas."""
    for i in range(low, high):
        if i < new_low or i >= new_high:
            record.mass[ENDED] += pockets.old[i, 1] * duct.width
            record.energy[ENDED] += pockets.old[i, 0] * pockets.area[i, 1] / (gas.exponent - 1.0) * duct.width
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_values(duct, duct.start + (i + 0.5) * duct.width, angle)[0]
            pockets.old[i, 0], pockets.old[i, 1] = gas.pressure, gas.density * area
            record.mass[BEGUN] += pockets.old[i, 1] * duct.width
            record.energy[BEGUN] += gas.pressure * area / (gas.exponent - 1.0) * duct.width


@kernel
def _set_walls(duct: Duct, pockets: Pockets, low: int, high: int, angle: float, turn: float) -> None:
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        pockets.area[i, 0] = wall_values(duct, z, angle)[0]
        pockets.area[i, 1], pockets.gap[i], _ = wall_values(duct, z, angle + turn)
    for face in range(low, high + 1):
        pockets.opening[face] = wall_values(duct, duct.start + face * duct.width, angle + turn)[0]


@kernel
def _temperature(gas: Gas, pockets: Pockets, i: int, when: int) -> float:
    """Temperature of a pocket [K] by its area at the start (0) or the end (1) of the step."""
    temperature: float = pockets.old[i, 0] * pockets.area[i, when] / (pockets.old[i, 1] * gas.constant)
    return temperature


@kernel
def _mach(gas: Gas, pockets: Pockets, face: int, low: int, high: int) -> float:
    """Mach number in the narrowest section of the jet through a face."""
    left = pockets.new[face - 1, 0] if face > low else gas.pressure
    right = pockets.new[face, 0] if face < high else gas.pressure
    return throat_mach(gas, max(left, right), min(left, right))


@kernel
def _book(gas: Gas, duct: Duct, pockets: Pockets, record: Record, low: int, high: int, dt: float, taken: int) -> None:
    """Book all flows, means and extremes, and take over the new state."""
    for end in range(2):
        face, outward = (low, -1.0) if end == 0 else (high, 1.0)
        open_end = (low == 0) if end == 0 else (high == duct.cells)
        entry = LOW_END + end if open_end else IDLE
        record.mass[entry] += outward * pockets.flow[face, 0] * dt
        record.energy[entry] += outward * pockets.flow[face, 1] * dt
        if open_end:
            record.ends[taken, 1 + end] = outward * pockets.flow[face, 0] * dt
            inside = pockets.new[low if end == 0 else high - 1, 0]
            asked = (gas.pressure / inside) ** ((1.0 - gas.exponent) / gas.exponent) - 1.0
            record.extremes[LARGEST_DEMAND] = max(
                record.extremes[LARGEST_DEMAND], np.sqrt(max(2.0 / (gas.exponent - 1.0) * asked, 0.0))
            )
    for face in range(low, high + 1):
        _follow_jet(gas, pockets, record, face, low, high)
    for i in range(low, high):
        growth = pockets.area[i, 1] - pockets.area[i, 0]
        mean = 0.5 * (pockets.old[i, 0] + pockets.new[i, 0])
        record.mass[WALLS] += pockets.leak[i, 0] * dt * duct.width
        record.energy[WALLS] += (pockets.leak[i, 1] * dt + mean * growth) * duct.width
        record.energy[WORK] -= (mean - gas.pressure) * growth * duct.width
        before = _temperature(gas, pockets, i, 0)
        pockets.old[i, 0], pockets.old[i, 1] = pockets.new[i, 0], pockets.new[i, 1]
        temperature = 0.5 * (before + _temperature(gas, pockets, i, 1))
        profile, p = record.profile[i], pockets.new[i, 0]
        profile[STATIC] += temperature * dt
        profile[STAGNATION] += temperature * dt
        profile[ACTIVE] += dt
        profile[PEAK] = max(profile[PEAK], p)
        extremes = record.extremes
        extremes[LARGEST_PRESSURE] = max(extremes[LARGEST_PRESSURE], p)
        extremes[SMALLEST_PRESSURE] = min(extremes[SMALLEST_PRESSURE], p)


@kernel
def _follow_jet(gas: Gas, pockets: Pockets, record: Record, face: int, low: int, high: int) -> None:
    """Extremes of Mach number and velocity in the jet through a face."""
    source = face - 1 if pockets.flow[face, 0] > 0.0 else face
    stagnation = gas.temperature
    if low <= source < high:
        stagnation = pockets.new[source, 0] * pockets.area[source, 1] / (pockets.new[source, 1] * gas.constant)
    mach = _mach(gas, pockets, face, low, high)
    static = stagnation / (1.0 + 0.5 * (gas.exponent - 1.0) * mach * mach)
    velocity = mach * np.sqrt(gas.exponent * gas.constant * static)
    record.extremes[LARGEST_MACH] = max(record.extremes[LARGEST_MACH], mach)
    record.extremes[LARGEST_VELOCITY] = max(record.extremes[LARGEST_VELOCITY], velocity)
