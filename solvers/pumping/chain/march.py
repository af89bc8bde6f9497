"""The march of a chain of pockets through its strokes: pockets that come and go, and the books."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.chain.pockets import (
    AREA,
    CONTENT,
    END,
    FLOW,
    GAP,
    HEAT,
    LEAK,
    MASS,
    NEW,
    OLD,
    OPENING,
    PRESSURE,
    START,
)
from solvers.pumping.chain.step import advance
from solvers.pumping.flow import record as columns
from solvers.pumping.flow.duct import Duct, active_range, wall_at
from solvers.pumping.flow.nozzle import Gas, throat_mach
from solvers.pumping.flow.record import (
    BEGUN,
    ENDED,
    IDLE,
    LOW_END,
    LOW_OUTFLOW,
    TIME,
    WALLS,
    WORK,
    Record,
    book,
    book_demand,
    book_means,
    book_pressure,
    book_speed,
)


@kernel
def march_chain(
    gas: Gas, duct: Duct, pockets: FloatArray, angles: FloatArray, substeps: int, record: Record, isentropic: bool
) -> tuple[int, float]:
    """March over all `angles` [rad] in equal steps; their number, or -1 if one did not converge, and its residual."""
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
            record.ends[taken, TIME] = (taken + 0.5) * dt
            if high > low:
                converged, error = advance(gas, duct.width, duct.discharge, pockets, low, high, dt, isentropic)
                if not converged:
                    return -1, error
                _book_ends(gas, duct, pockets, record, low, high, dt, taken)
                _book_jets(gas, pockets, record, low, high)
                _book_pockets(gas, duct, pockets, record, low, high, dt)
            taken += 1
        _sample(gas, pockets, record, low, high, k)
    _renew(gas, duct, pockets, record, low, high, 0, 0, angles[-1])
    return taken, 0.0


@kernel
def _renew(
    gas: Gas,
    duct: Duct,
    pockets: FloatArray,
    record: Record,
    low: int,
    high: int,
    new_low: int,
    new_high: int,
    angle: float,
) -> None:
    """Give the content of pockets whose stroke is over back, fill those whose stroke begins with ambient gas."""
    per_energy = gas.exponent - 1.0
    for i in range(low, high):
        if i < new_low or i >= new_high:
            energy = pockets[i, OLD + PRESSURE] * pockets[i, AREA + END] / per_energy * duct.width
            book(record, ENDED, pockets[i, OLD + CONTENT] * duct.width, energy)
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_at(duct, duct.start + (i + 0.5) * duct.width, angle).area
            pockets[i, OLD + PRESSURE], pockets[i, OLD + CONTENT] = gas.pressure, gas.density * area
            book(record, BEGUN, pockets[i, OLD + CONTENT] * duct.width, gas.pressure * area / per_energy * duct.width)


@kernel
def _set_walls(duct: Duct, pockets: FloatArray, low: int, high: int, angle: float, turn: float) -> None:
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        after = wall_at(duct, z, angle + turn)
        pockets[i, AREA + START] = wall_at(duct, z, angle).area
        pockets[i, AREA + END], pockets[i, GAP] = after.area, after.clearance
    for face in range(low, high + 1):
        pockets[face, OPENING] = wall_at(duct, duct.start + face * duct.width, angle + turn).area


@kernel
def _temperature(gas: Gas, pressure: float, area: float, content: float) -> float:
    """Temperature of a pocket [K]."""
    return pressure * area / (content * gas.constant)


@kernel
def _mach(gas: Gas, left: float, right: float) -> float:
    """Mach number in the narrowest section of the jet between two pressures [Pa]."""
    return throat_mach(gas, max(left, right), min(left, right))


@kernel
def _sample(gas: Gas, pockets: FloatArray, record: Record, low: int, high: int, k: int) -> None:
    """Field of the active pockets at a recorded angle."""
    field = record.field
    mach = 0.0
    for i in range(low, high):
        p = pockets[i, NEW + PRESSURE]
        before = mach if i > low else _mach(gas, gas.pressure, p)
        mach = _mach(gas, p, pockets[i + 1, NEW + PRESSURE] if i + 1 < high else gas.pressure)
        field[k, i, columns.PRESSURE], field[k, i, columns.MACH] = p, max(before, mach)
        field[k, i, columns.TEMPERATURE] = _temperature(gas, p, pockets[i, AREA + END], pockets[i, NEW + CONTENT])


@kernel
def _book_ends(
    gas: Gas, duct: Duct, pockets: FloatArray, record: Record, low: int, high: int, dt: float, taken: int
) -> None:
    """Book what left through both ends of the active pockets: ends of the duct, or borders to idle pockets."""
    for end in range(2):
        face, outward = (low, -1.0) if end == 0 else (high, 1.0)
        open_end = (low == 0) if end == 0 else (high == duct.cells)
        entry = LOW_END + end if open_end else IDLE
        mass = outward * pockets[face, FLOW + MASS] * dt
        book(record, entry, mass, outward * pockets[face, FLOW + HEAT] * dt)
        if open_end:
            record.ends[taken, LOW_OUTFLOW + end] = mass
            inside = pockets[low if end == 0 else high - 1, NEW + PRESSURE]
            asked = (gas.pressure / inside) ** ((1.0 - gas.exponent) / gas.exponent) - 1.0
            book_demand(record, np.sqrt(max(2.0 / (gas.exponent - 1.0) * asked, 0.0)))


@kernel
def _book_jets(gas: Gas, pockets: FloatArray, record: Record, low: int, high: int) -> None:
    """Book the largest Mach number and velocity of the jets through the faces."""
    largest, fastest = 0.0, 0.0
    right = gas.pressure
    for face in range(low, high + 1):
        left, right = right, pockets[face, NEW + PRESSURE] if face < high else gas.pressure
        source = face - 1 if pockets[face, FLOW + MASS] > 0.0 else face
        stagnation = gas.temperature
        if low <= source < high:
            stagnation = _temperature(
                gas, pockets[source, NEW + PRESSURE], pockets[source, AREA + END], pockets[source, NEW + CONTENT]
            )
        mach = _mach(gas, left, right)
        static = stagnation / (1.0 + 0.5 * (gas.exponent - 1.0) * mach * mach)
        largest = max(largest, mach)
        fastest = max(fastest, mach * np.sqrt(gas.exponent * gas.constant * static))
    book_speed(record, largest, fastest)


@kernel
def _book_pockets(gas: Gas, duct: Duct, pockets: FloatArray, record: Record, low: int, high: int, dt: float) -> None:
    """Book what the walls did, means and extremes, and take over the new state."""
    mass = energy = work = 0.0
    for i in range(low, high):
        growth = pockets[i, AREA + END] - pockets[i, AREA + START]
        mean = 0.5 * (pockets[i, OLD + PRESSURE] + pockets[i, NEW + PRESSURE])
        mass += pockets[i, LEAK + MASS] * dt
        energy += pockets[i, LEAK + HEAT] * dt + mean * growth
        work -= (mean - gas.pressure) * growth
        before = _temperature(gas, pockets[i, OLD + PRESSURE], pockets[i, AREA + START], pockets[i, OLD + CONTENT])
        after = _temperature(gas, pockets[i, NEW + PRESSURE], pockets[i, AREA + END], pockets[i, NEW + CONTENT])
        temperature = 0.5 * (before + after)
        pockets[i, OLD + PRESSURE], pockets[i, OLD + CONTENT] = pockets[i, NEW + PRESSURE], pockets[i, NEW + CONTENT]
        book_means(record, i, temperature, temperature, dt, 1.0)
        book_pressure(record, i, pockets[i, NEW + PRESSURE])
    book(record, WALLS, mass * duct.width, energy * duct.width)
    record.energy[WORK] += work * duct.width
