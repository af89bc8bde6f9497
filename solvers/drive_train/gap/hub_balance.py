"""Tilts of the coupling hubs in equilibrium with the loads of the couplings.

A hub's tilt x = rest + lever (motion of the hub) bends the shaft by loads p(x), and these move the hub. Newton's step
on x has the matrix I - lever D dp/dx, D the derivative of the hubs' motion by their loads.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.shafts.coupling_loads import LOADS, TILTS, CouplingPort, coupling_loads
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import InvalidInput, NoSolution

TILT_TOLERANCE = 1e-13  # rad
TILT_ITERATIONS = 30  # chosen: beyond it the balance is followed along its path
LEAST_STEP = 1 / 64  # chosen: six halvings, then the step is taken as it is
LEAST_SIZE = 1e-9  # rad, of tilts along a path
LONGEST, SHORTEST, LONGER = 0.3, 1e-6, 1.5  # steps along a path, in units of the tilts' own size
FARTHEST = 2.0  # from the end of a step, in its lengths
PATH_POINTS = 500  # chosen: ends a search that finds no balance
PATH_ITERATIONS = 6  # chosen: beyond it a shorter step is tried
PATH_TOLERANCE = 1e-6  # of the tilts' own size


@dataclass(frozen=True, slots=True)
class HubLoads:
    """Tilts [rad] of all hubs, four a coupling, the loads they cause at the couplings' ports, five each, and dp/dx."""

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


def free_hubs(unit: Unit, force: FloatArray) -> HubLoads:
    """The hubs on shafts that a force over the face bends, and the couplings not: where the iteration begins.

    A hub on shafts that nothing bends may not tilt at all, and there its friction is as stiff as it gets. Raises
    InvalidInput where such a tilt is none of the coupling model's.
    """
    ports = unit.couplings
    if not ports:
        return HubLoads(np.zeros(0), np.zeros(0), np.zeros((0, 0)))
    motion, _ = unit.motion(np.concatenate([force, np.zeros(LOADS * len(ports))]))
    return _hub_loads(ports, _rest(ports) + _levers(ports) @ motion[force.size :])


def respond(unit: Unit, force: FloatArray, start: HubLoads) -> Yielding:
    """Motion of the ports under a force over the face, with coupling loads that fit the tilts they cause (Eq. D12).

    The iteration begins at the loads in `start`. If it does not converge it begins again at the hubs without coupling
    loads, and then at the tilts to which these move while the coupling loads are raised from zero in steps.

    Raises InvalidInput where a free hub tilts too far for the coupling model, and NoSolution drive_train with the
    residual of the tilts [rad].
    """
    found, residual = _solve(unit, force, start)
    if found is None:
        free = free_hubs(unit, force)
        found, residual = _solve(unit, force, free)
        if found is None:
            found, residual = _solve(unit, force, _grown(unit, force, free))
    if found is None:
        raise NoSolution("drive_train", "the tilts of the couplings' hubs did not converge", {"tilt_rad": residual})
    return found


@dataclass(frozen=True, slots=True)
class _Tilted:
    """Hubs at some tilts, the motion of the ports that follows, and how far from these tilts that motion is.

    `by_tilts` and `by_share` are the residual's derivatives by the tilts and by the share of the loads that acts.
    """

    hubs: HubLoads
    motion: FloatArray
    derivative: FloatArray
    residual: FloatArray
    by_tilts: FloatArray
    by_share: FloatArray

    @property
    def size(self) -> float:
        return float(np.max(np.abs(self.residual), initial=0.0))


def _tilted(unit: Unit, force: FloatArray, hubs: HubLoads, share: float = 1.0) -> _Tilted:
    """The residual of the tilts where a share of the couplings' loads acts."""
    levers, own = _levers(unit.couplings), force.size
    motion, derivative = unit.motion(np.concatenate([force, share * hubs.loads]))
    through = levers @ derivative[own:, own:]
    return _Tilted(
        hubs=hubs,
        motion=motion,
        derivative=derivative,
        residual=hubs.tilts - _rest(unit.couplings) - levers @ motion[own:],
        by_tilts=np.eye(hubs.tilts.size) - share * through @ hubs.by_tilts,
        by_share=-through @ hubs.loads,
    )


def _solve(unit: Unit, force: FloatArray, hubs: HubLoads) -> tuple[Yielding | None, float]:
    """Newton's iteration on the tilts, and the last residual [rad]."""
    state = _tilted(unit, force, hubs)
    for _ in range(TILT_ITERATIONS):
        if state.size <= TILT_TOLERANCE:
            return _yielding(unit, force.size, state), state.size
        try:
            step = solved(state.by_tilts, -state.residual)
        except NoSolution:
            break
        state = _advance(unit, force, state, step)
    return None, state.size


def solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """The solution of a linear system. Raises NoSolution drive_train where the matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=float)
    except np.linalg.LinAlgError as error:
        message = "shafts and couplings yield without bound: their equations are singular"
        raise NoSolution("drive_train", message, {"reciprocal_condition": 0.0}) from error


def _advance(unit: Unit, force: FloatArray, state: _Tilted, step: FloatArray) -> _Tilted:
    """The state after a step, halved while the residual does not fall or the parts refuse such tilts."""
    share = 1.0
    while True:
        following = _attempted(unit, force, state.hubs.tilts + share * step)
        if following is not None and (following.size < state.size or share < LEAST_STEP):
            return following
        share /= 2


def _attempted(unit: Unit, force: FloatArray, tilts: FloatArray, share: float = 1.0) -> _Tilted | None:
    """The state at tilts that may be so far off that coupling or bearing refuse them."""
    try:
        return _tilted(unit, force, _hub_loads(unit.couplings, tilts), share)
    except (InvalidInput, NoSolution):
        return None


def _yielding(unit: Unit, count: int, state: _Tilted) -> Yielding:
    """What the unit yields to a force over the face once its hubs are in balance."""
    mesh, hubs = state.derivative[:count], state.derivative[count:]
    through = solved(state.by_tilts, _levers(unit.couplings) @ hubs[:, :count])
    return Yielding(state.hubs, state.motion, mesh[:, :count] + mesh[:, count:] @ state.hubs.by_tilts @ through)


def _grown(unit: Unit, force: FloatArray, free: HubLoads) -> HubLoads:
    """Where the hubs go from the free ones as the couplings' loads grow from nothing to the whole.

    Friction that falls as a hub slides faster lets a hub jump between sliding and sticking, and there the path turns
    back in the share of the loads. So it is followed by its own length, every hub's tilts measured by their size: a
    point is Newton's on the plane across the last direction (Allgower and Georg 2003, chapter 2).
    """
    share, state, length = 0.0, _tilted(unit, force, free, 0.0), LONGEST
    direction = np.append(np.zeros(free.tilts.size), 1.0)
    for _ in range(PATH_POINTS):
        scale = _sizes(state.hubs.tilts)
        direction = _along(state, scale, direction)
        reached = _on_path(unit, force, state, share, scale, length * direction)
        while reached is None and length > SHORTEST:
            length /= 2
            reached = _on_path(unit, force, state, share, scale, length * direction)
        if reached is None:
            return state.hubs
        before, tilts = share, state.hubs.tilts
        share, state = reached
        if share >= 1.0:
            part = (1.0 - before) / (share - before)
            return _hub_loads(unit.couplings, tilts + part * (state.hubs.tilts - tilts))
        length = min(LONGER * length, LONGEST)
    return state.hubs


def _sizes(tilts: FloatArray) -> FloatArray:
    """The size of every hub's tilt [rad], for both its components."""
    return np.repeat(np.maximum(np.hypot(tilts[::2], tilts[1::2]), LEAST_SIZE), 2)


def _along(state: _Tilted, scale: FloatArray, direction: FloatArray) -> FloatArray:
    """The path's direction at a point, the way it came from; tilts in their scale."""
    found = solved(_across(state, scale, direction), np.append(np.zeros(scale.size), 1.0))
    return np.asarray(found / np.linalg.norm(found))


def _across(state: _Tilted, scale: FloatArray, direction: FloatArray) -> FloatArray:
    """The derivative of the residual and of the way along a direction, by tilts in their scale and by the share."""
    return np.vstack([np.column_stack([state.by_tilts * scale, state.by_share]) / scale[:, None], direction])


def _on_path(
    unit: Unit, force: FloatArray, start: _Tilted, share: float, scale: FloatArray, step: FloatArray
) -> tuple[float, _Tilted] | None:
    """Share and state on the plane across a step, near its end; None where Newton's iteration does not find them."""
    length = float(np.linalg.norm(step))
    place = step
    for _ in range(PATH_ITERATIONS):
        there = share + float(place[-1])
        state = _attempted(unit, force, start.hubs.tilts + scale * place[:-1], there)
        if state is None or np.linalg.norm(place - step) > FARTHEST * length:
            return None
        rest = state.residual / scale
        if np.max(np.abs(rest)) <= PATH_TOLERANCE:
            return there, state
        across = np.append(-rest, step @ (step - place) / length)
        try:
            place = place + solved(_across(state, scale, step / length), across)
        except NoSolution:
            return None
    return None


def _hub_loads(ports: tuple[CouplingPort, ...], tilts: FloatArray) -> HubLoads:
    """Loads of all couplings at their tilts, and their derivative."""
    loads, derivative = np.zeros(LOADS * len(ports)), np.zeros((LOADS * len(ports), tilts.size))
    for k, port in enumerate(ports):
        own, by = slice(LOADS * k, LOADS * (k + 1)), slice(TILTS * k, TILTS * (k + 1))
        loads[own], derivative[own, by] = coupling_loads(port, tilts[by])
    return HubLoads(tilts, loads, derivative)


def _levers(ports: tuple[CouplingPort, ...]) -> FloatArray:
    levers = np.zeros((TILTS * len(ports), LOADS * len(ports)))
    for k, port in enumerate(ports):
        levers[TILTS * k : TILTS * (k + 1), LOADS * k : LOADS * (k + 1)] = port.lever
    return levers


def _rest(ports: tuple[CouplingPort, ...]) -> FloatArray:
    return np.concatenate([np.zeros(0), *(port.rest for port in ports)])
