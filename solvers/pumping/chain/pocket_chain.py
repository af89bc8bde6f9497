"""March of the pocket chain of Milian et al. (Eqs. 2-7) through the strokes of its pockets.

The computed pressures change with the number of pockets. This number is therefore a constant of the model and is not
increased to refine the solution.
"""

from math import ceil

import numpy as np

from solvers.arrays import FloatArray, RecordArray
from solvers.compiled import inner_kernel, kernel
from solvers.errors import NoSolution
from solvers.pumping.chain.step import advance, empty_pockets
from solvers.pumping.flow.duct import Duct, active_range, wall_at
from solvers.pumping.flow.nozzle import Gas, throat_mach
from solvers.pumping.flow.space_flow import (
    March,
    Record,
    SpaceFlow,
    add_means,
    add_outflow,
    empty_record,
    include_demand,
    include_pressure,
    include_speed,
    space_flow,
)
from solvers.pumping.inputs import Closure
from solvers.pumping.space.face import Stretch

STEPS = 2000  # least number of time steps in a stroke
_REFINEMENTS = (1, 2, 4, 8)  # factors on the number of steps, tried in turn until all steps converge


def pocket_chain(
    gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray, closure: Closure, steps: int = STEPS
) -> SpaceFlow:
    """March the gas in all stretches of a tooth space through the stroke, in at least `steps` steps per stretch.

    The gas is recorded at each `angle` [rad]. Raises NoSolution (`newton_not_converged`) if a step does not converge.
    """
    substeps = ceil(steps / (angle.size - 1))
    marches = [_march(gas, stretch, duct, angle, closure, substeps) for stretch, duct in ducts]
    return space_flow(angle, marches, conserves_energy=closure is Closure.ENERGY)


def _march(gas: Gas, stretch: Stretch, duct: Duct, angle: FloatArray, closure: Closure, substeps: int) -> March:
    """March one stretch through the stroke; with shorter steps where reversing flow stalls Newton's method."""
    for refinement in _REFINEMENTS:
        count = refinement * substeps
        record = empty_record(gas, angle.size, duct.cells, count * (angle.size - 1))
        pockets = empty_pockets(duct.cells)
        taken, error = march_chain(gas, duct, pockets, angle, count, record, closure is Closure.ISENTROPIC)
        if taken > 0:
            return March(stretch, record, taken)
    raise NoSolution(
        "newton_not_converged",
        "a time step of the pocket chain did not converge; try a higher speed, fewer slices or flow model gas_dynamics",
        {"content_error": error},
    )


@kernel
def march_chain(
    gas: Gas, duct: Duct, pockets: RecordArray, angles: FloatArray, substeps: int, record: Record, isentropic: bool
) -> tuple[int, float]:
    """March the pockets over all `angles` [rad] in equal steps; return their number and 0, or -1 and a residual."""
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
            record.ends[taken].time = (taken + 0.5) * dt
            if high > low:
                converged, error = advance(gas, duct.width, duct.discharge, pockets, low, high, dt, isentropic)
                if not converged:
                    return -1, error
                _record_ends(gas, duct, pockets, record, low, high, dt, taken)
                _record_jets(gas, pockets, record, low, high)
                _record_pockets(gas, duct, pockets, record, low, high, dt)
            taken += 1
        _record_field(gas, pockets, record, low, high, k)
    _renew(gas, duct, pockets, record, low, high, 0, 0, angles[-1])
    return taken, 0.0


@inner_kernel
def _renew(
    gas: Gas,
    duct: Duct,
    pockets: RecordArray,
    record: Record,
    low: int,
    high: int,
    new_low: int,
    new_high: int,
    angle: float,
) -> None:
    """Fill pockets with ambient gas as their stroke begins (`begun`), and empty those whose stroke ends (`ended`)."""
    per_energy = gas.exponent - 1.0
    for i in range(low, high):
        if i < new_low or i >= new_high:
            record.mass[0].ended += pockets[i].old.mass * duct.width
            record.energy[0].ended += pockets[i].old.pressure * pockets[i].area / per_energy * duct.width
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_at(duct, duct.start + (i + 0.5) * duct.width, angle).area
            pockets[i].old.pressure, pockets[i].old.mass = gas.pressure, gas.density * area
            record.mass[0].begun += pockets[i].old.mass * duct.width
            record.energy[0].begun += gas.pressure * area / per_energy * duct.width


@inner_kernel
def _set_walls(duct: Duct, pockets: RecordArray, low: int, high: int, angle: float, turn: float) -> None:
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        after = wall_at(duct, z, angle + turn)
        pockets[i].start_area = wall_at(duct, z, angle).area
        pockets[i].area, pockets[i].gap = after.area, after.clearance
    for face in range(low, high + 1):
        pockets[face].opening = wall_at(duct, duct.start + face * duct.width, angle + turn).area


@inner_kernel
def _temperature(gas: Gas, pressure: float, area: float, content: float) -> float:
    return pressure * area / (content * gas.constant)


@inner_kernel
def _mach(gas: Gas, left: float, right: float) -> float:
    """Compute the Mach number in the narrowest section of a jet from the pressures on both sides of the jet [Pa]."""
    return throat_mach(gas, max(left, right), min(left, right))


@inner_kernel
def _record_field(gas: Gas, pockets: RecordArray, record: Record, low: int, high: int, k: int) -> None:
    """Record the gas in the active pockets in row k of the record; k is the index of the angle."""
    field = record.field
    mach = 0.0
    for i in range(low, high):
        p = pockets[i].new.pressure
        before = mach if i > low else _mach(gas, gas.pressure, p)
        mach = _mach(gas, p, pockets[i + 1].new.pressure if i + 1 < high else gas.pressure)
        field[k, i].pressure, field[k, i].mach = p, max(before, mach)
        field[k, i].temperature = _temperature(gas, p, pockets[i].area, pockets[i].new.mass)


@inner_kernel
def _record_ends(
    gas: Gas, duct: Duct, pockets: RecordArray, record: Record, low: int, high: int, dt: float, taken: int
) -> None:
    """Record the flow out of both ends of the active pockets: out of the duct, or into an idle pocket."""
    for end in range(2):
        face, outward = (low, -1.0) if end == 0 else (high, 1.0)
        open_end = (low == 0) if end == 0 else (high == duct.cells)
        mass, energy = outward * pockets[face].mass_balance.flow * dt, outward * pockets[face].heat_balance.flow * dt
        if open_end:
            add_outflow(record, end, taken, mass, energy)
            inside = pockets[low if end == 0 else high - 1].new.pressure
            outwards = _asked(gas, inside, gas.pressure)
            include_demand(record.extremes, outwards if outwards > 0.0 else -_asked(gas, gas.pressure, inside), end)
        else:
            record.mass[0].idle += mass
            record.energy[0].idle += energy


@inner_kernel
def _asked(gas: Gas, upstream: float, downstream: float) -> float:
    """Compute the Mach number of an expansion from one pressure to another; 0 if there is no expansion."""
    warming = (downstream / upstream) ** ((1.0 - gas.exponent) / gas.exponent) - 1.0
    return float(np.sqrt(max(2.0 / (gas.exponent - 1.0) * warming, 0.0)))


@inner_kernel
def _record_jets(gas: Gas, pockets: RecordArray, record: Record, low: int, high: int) -> None:
    """Record the largest Mach number and the largest velocity of the jets between pockets and at the ends."""
    largest, fastest = 0.0, 0.0
    right = gas.pressure
    for face in range(low, high + 1):
        left, right = right, pockets[face].new.pressure if face < high else gas.pressure
        source = face - 1 if pockets[face].mass_balance.flow > 0.0 else face
        stagnation = gas.temperature
        if low <= source < high:
            stagnation = _temperature(gas, pockets[source].new.pressure, pockets[source].area, pockets[source].new.mass)
        mach = _mach(gas, left, right)
        static = stagnation / (1.0 + 0.5 * (gas.exponent - 1.0) * mach * mach)
        largest = max(largest, mach)
        fastest = max(fastest, mach * np.sqrt(gas.exponent * gas.constant * static))
    include_speed(record.extremes, largest, fastest)


@inner_kernel
def _record_pockets(gas: Gas, duct: Duct, pockets: RecordArray, record: Record, low: int, high: int, dt: float) -> None:
    """Record wall losses, mean temperatures and extreme pressures of the active pockets.

    Also copy the new state of each active pocket to `old`, the state from which the next step starts.
    """
    mass = energy = work = 0.0
    for i in range(low, high):
        growth = pockets[i].area - pockets[i].start_area
        mean = 0.5 * (pockets[i].old.pressure + pockets[i].new.pressure)
        mass += pockets[i].mass_balance.leak * dt
        energy += pockets[i].heat_balance.leak * dt + mean * growth
        work -= (mean - gas.pressure) * growth
        before = _temperature(gas, pockets[i].old.pressure, pockets[i].start_area, pockets[i].old.mass)
        after = _temperature(gas, pockets[i].new.pressure, pockets[i].area, pockets[i].new.mass)
        temperature = 0.5 * (before + after)
        pockets[i].old = pockets[i].new
        add_means(record.profile, i, temperature, temperature, dt, 1.0)
        include_pressure(record.profile, i, pockets[i].new.pressure)
    record.mass[0].walls += mass * duct.width
    record.energy[0].walls += energy * duct.width
    record.energy[0].work += work * duct.width
