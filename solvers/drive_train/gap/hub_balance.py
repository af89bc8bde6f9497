"""The couplings' share of the balance: tilts of the hubs that cause just the loads which cause them.

A hub's tilt x = rest + lever (motion of the hub) bends the shaft by loads p(x), and these move the hub. Newton's step
on x has the matrix I - lever D dp/dx, D the derivative of the hubs' motion by their loads.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.shafts.coupling_loads import CouplingPort, coupling_loads, softened
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import NoSolution

TILT_TOLERANCE = 1e-13  # rad
TILT_ITERATIONS = 60
LEAST_STEP = 1 / 64
SOFTNESS = (1000.0, 300.0, 100.0, 50.0, 30.0, 20.0, 10.0, 7.0, 5.0, 3.0, 2.0, 1.4, 1.0)


@dataclass(frozen=True, slots=True)
class HubLoads:
    """Tilts [rad] of all hubs, four a coupling, the loads they cause at the couplings' ports, and dp/dx."""

    tilts: FloatArray
    loads: FloatArray
    by_tilts: FloatArray


@dataclass(frozen=True, slots=True)
class Yielding:
    """Motion of the ports under a force over the face and the hubs' loads it causes, and its derivative by the force.

    The derivative (stations, stations) [m/N] has the hubs' answer in it.
    """

    hubs: HubLoads
    motion: FloatArray
    derivative: FloatArray


def loads_at_rest(unit: Unit) -> HubLoads:
    """The hubs on shafts that do not move."""
    return _hub_loads(unit.couplings, _rest(unit.couplings))


def respond(unit: Unit, force: FloatArray, start: HubLoads) -> Yielding:
    """Motion of the ports under a force over the face, the couplings' loads found from the tilts they cause.

    Starts at known loads, and where that fails at a hub whose teeth slide late, which stiffens step by step. Raises
    NoSolution drive_train with the tilts' residual [rad].
    """
    ports = unit.couplings
    if not ports:
        motion, derivative = unit.motion(force)
        return Yielding(start, motion, derivative)
    found, residual = _solve(unit, ports, force, start)
    if found is None:
        tilts = _rest(ports)
        for factor in SOFTNESS:
            softer = tuple(softened(port, factor) for port in ports)
            found, residual = _solve(unit, softer, force, _hub_loads(softer, tilts))
            tilts = tilts if found is None else found.hubs.tilts
    if found is None:
        raise NoSolution("drive_train", "the couplings' tilts were not found", {"tilt_rad": residual})
    return found


def _solve(
    unit: Unit, ports: tuple[CouplingPort, ...], force: FloatArray, hubs: HubLoads
) -> tuple[Yielding | None, float]:
    """Newton's iteration on the tilts, halved while the residual does not fall, and the least residual [rad]."""
    count, best = force.size, np.inf
    levers, rest = _levers(ports), _rest(ports)
    step, share = np.zeros_like(rest), 1.0
    for _ in range(TILT_ITERATIONS):
        motion, derivative = unit.motion(np.concatenate([force, hubs.loads]))
        residual = hubs.tilts - rest - levers @ motion[count:]
        size = float(np.max(np.abs(residual)))
        tilts = hubs.tilts
        if size < best or share < LEAST_STEP:
            matrix = np.eye(tilts.size) - levers @ derivative[count:, count:] @ hubs.by_tilts
            if size <= TILT_TOLERANCE:
                through = np.linalg.solve(matrix, levers @ derivative[count:, :count])
                whole = derivative[:count, :count] + derivative[:count, count:] @ hubs.by_tilts @ through
                return Yielding(hubs, motion, whole), size
            best, share = size, 1.0
            step = np.asarray(np.linalg.solve(matrix, -residual), dtype=float)
        else:
            tilts, share = tilts - share * step, share / 2
        hubs = _hub_loads(ports, tilts + share * step)
    return None, best


def _hub_loads(ports: tuple[CouplingPort, ...], tilts: FloatArray) -> HubLoads:
    """Loads of all couplings at their tilts, and their derivative."""
    loads, derivative = np.zeros(tilts.size), np.zeros((tilts.size, tilts.size))
    for k, port in enumerate(ports):
        part = slice(4 * k, 4 * k + 4)
        loads[part], derivative[part, part] = coupling_loads(port, tilts[part])
    return HubLoads(tilts, loads, derivative)


def _levers(ports: tuple[CouplingPort, ...]) -> FloatArray:
    levers = np.zeros((4 * len(ports), 4 * len(ports)))
    for k, port in enumerate(ports):
        levers[4 * k : 4 * k + 4, 4 * k : 4 * k + 4] = port.lever
    return levers


def _rest(ports: tuple[CouplingPort, ...]) -> FloatArray:
    return np.concatenate([port.rest for port in ports]) if ports else np.zeros(0)
