"""Tilts of the coupling hubs in equilibrium with the loads of the couplings.

A coupling has one hub on a shaft of the unit and one on a machine. The motion u of the hub on the shaft determines the
tilts of both, x = rest + lever u. The loads p(x) of the coupling bend the shaft, which moves the hub. Newton's step on
x has the matrix I - lever D dp/dx; D is the derivative of u with respect to the loads of the couplings. `influence`
defines the ports of a unit.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.shafts.coupling_loads import LOADS, TILTS, CouplingPort, coupling_loads
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import InvalidInput, NoSolution

TILT_TOLERANCE = 1e-13  # rad
TILT_ITERATIONS = 30  # chosen: if this number of iterations is not enough, the solution path is followed
LEAST_STEP = 1 / 64  # chosen: a step that was shortened to a smaller share is accepted even if the residual grows
LEAST_SIZE = 1e-9  # rad; least scale of the tilts along the path
LONGEST, SHORTEST, LONGER = 0.3, 1e-6, 1.5  # longest and shortest step, in scales of the tilts; growth factor of a step
FARTHEST = 2.0  # in step lengths; largest distance between the end of a step and the solution found from there
PATH_POINTS = 500  # chosen: after this number of points the search ends without a balance
PATH_ITERATIONS = 6  # chosen: after this number of iterations a shorter step is tried
PATH_TOLERANCE = 1e-6  # in scales of the tilts


@dataclass(frozen=True, slots=True)
class HubLoads:
    """Tilts of all hubs, and the loads of the couplings."""

    tilts: FloatArray  # four of each coupling, rad
    loads: FloatArray  # five of each coupling, N and N m
    by_tilts: FloatArray  # derivative of the loads


@dataclass(frozen=True, slots=True)
class Yielding:
    """Motion of the ports under a force over the face, with the hubs in balance."""

    hubs: HubLoads
    motion: FloatArray
    derivative: FloatArray  # (stations, stations) m/N, of the stations' motion by the force, as the hubs respond


def free_hubs(unit: Unit, force: FloatArray) -> HubLoads:
    """Tilts of the hubs while the shafts carry only a force over the face [N], and the couplings' loads at these tilts.

    These loads do not act on the shafts. Raises InvalidInput if a tilt is out of the range of the coupling model.
    """
    ports = unit.couplings
    if not ports:
        return HubLoads(np.zeros(0), np.zeros(0), np.zeros((0, 0)))
    motion, _ = unit.motion(np.concatenate([force, np.zeros(LOADS * len(ports))]))
    return _hub_loads(ports, _rest(ports) + _levers(ports) @ motion[force.size :])


def respond(unit: Unit, force: FloatArray, start: HubLoads) -> Yielding:
    """Motion of the ports under a force over the face, with the hubs in balance (Eq. D12).

    Raises InvalidInput if a hub tilts too far for the coupling model even without coupling loads on the shafts, and
    NoSolution `drive_train` with the residual of the tilts [rad] if none of three iterations converges.
    """
    yielding, residual = _solve(unit, force, start)
    if yielding is None:
        free = free_hubs(unit, force)
        yielding, residual = _solve(unit, force, free)
        if yielding is None:  # so the loads of the couplings grow step by step from zero
            yielding, residual = _solve(unit, force, _raise_loads(unit, force, free))
    if yielding is None:
        raise NoSolution(
            "drive_train", "the iteration for the tilts of the coupling hubs did not converge", {"tilt_rad": residual}
        )
    return yielding


@dataclass(frozen=True, slots=True)
class _State:
    """Hubs at assumed tilts, the resulting motion of the shafts, and the residual of the tilts."""

    hubs: HubLoads
    motion: FloatArray
    derivative: FloatArray
    residual: FloatArray  # the assumed tilts minus those that follow from the motion
    by_tilts: FloatArray  # derivative of the residual
    by_share: FloatArray  # the same by the fraction of the coupling loads that acts on the shafts

    @property
    def size(self) -> float:
        return float(np.max(np.abs(self.residual), initial=0.0))


def _evaluate(unit: Unit, force: FloatArray, hubs: HubLoads, share: float = 1.0) -> _State:
    """Return the state of hubs at given tilts. Only the fraction `share` of the coupling loads acts on the shafts."""
    levers, own = _levers(unit.couplings), force.size
    motion, derivative = unit.motion(np.concatenate([force, share * hubs.loads]))
    through = levers @ derivative[own:, own:]
    return _State(
        hubs=hubs,
        motion=motion,
        derivative=derivative,
        residual=hubs.tilts - _rest(unit.couplings) - levers @ motion[own:],
        by_tilts=np.eye(hubs.tilts.size) - share * through @ hubs.by_tilts,
        by_share=-through @ hubs.loads,
    )


def _solve(unit: Unit, force: FloatArray, hubs: HubLoads) -> tuple[Yielding | None, float]:
    """Find the balance of the tilts by Newton's iteration: None if it fails, and the last residual [rad]."""
    state = _evaluate(unit, force, hubs)
    for _ in range(TILT_ITERATIONS):
        if state.size <= TILT_TOLERANCE:
            return _yielding(unit, force.size, state), state.size
        try:
            step = solve_linear(state.by_tilts, -state.residual)
        except NoSolution:
            break
        state = _advance(unit, force, state, step)
    return None, state.size


def solve_linear(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve a linear system. Raises NoSolution `drive_train` if the matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=float)
    except np.linalg.LinAlgError as error:
        message = "the deflections of shafts and couplings cannot be computed, because the equations are singular"
        raise NoSolution("drive_train", message, {"reciprocal_condition": 0.0}) from error


def _advance(unit: Unit, force: FloatArray, state: _State, step: FloatArray) -> _State:
    """Return the state after a step of the tilts, halved until all models accept the tilts and the residual falls.

    If less than `LEAST_STEP` of the step is left, the residual need not fall.
    """
    share = 1.0
    while True:
        following = _try_tilts(unit, force, state.hubs.tilts + share * step)
        if following is not None and (following.size < state.size or share < LEAST_STEP):
            return following
        share /= 2


def _try_tilts(unit: Unit, force: FloatArray, tilts: FloatArray, share: float = 1.0) -> _State | None:
    """Return the state at given tilts; None if the model of a coupling or bearing rejects these tilts."""
    try:
        return _evaluate(unit, force, _hub_loads(unit.couplings, tilts), share)
    except (InvalidInput, NoSolution):
        return None


def _yielding(unit: Unit, count: int, state: _State) -> Yielding:
    """Return the motion of all ports in balance, with the derivative that `Yielding` describes."""
    mesh, hubs = state.derivative[:count], state.derivative[count:]
    through = solve_linear(state.by_tilts, _levers(unit.couplings) @ hubs[:, :count])
    return Yielding(state.hubs, state.motion, mesh[:, :count] + mesh[:, count:] @ state.hubs.by_tilts @ through)


def _raise_loads(unit: Unit, force: FloatArray, free: HubLoads) -> HubLoads:
    """Follow the tilts of the hubs while a growing fraction of the coupling loads acts on the shafts.

    The path begins at `free`, the hubs without coupling loads, and ends at the fraction 1 (interpolated) or at the last
    point reached. If friction falls with the sliding velocity, a hub can jump between sliding and sticking; to follow
    it the fraction must decrease for a while. So it is an unknown, and the length of a step along the path is given
    (pseudo-arclength continuation, Allgower and Georg 2003, chapter 2).
    """
    share, state, length = 0.0, _evaluate(unit, force, free, 0.0), LONGEST
    direction = np.append(np.zeros(free.tilts.size), 1.0)
    for _ in range(PATH_POINTS):
        scale = _sizes(state.hubs.tilts)
        direction = _path_direction(state, scale, direction)
        point = _find_on_path(unit, force, state, share, scale, length * direction)
        while point is None and length > SHORTEST:
            length /= 2
            point = _find_on_path(unit, force, state, share, scale, length * direction)
        if point is None:
            return state.hubs
        before, tilts = share, state.hubs.tilts
        share, state = point
        if share >= 1.0:
            part = (1.0 - before) / (share - before)
            return _hub_loads(unit.couplings, tilts + part * (state.hubs.tilts - tilts))
        length = min(LONGER * length, LONGEST)
    return state.hubs


def _sizes(tilts: FloatArray) -> FloatArray:
    """Scale of each component of the tilts [rad]: the magnitude of the tilt it belongs to, at least `LEAST_SIZE`."""
    return np.repeat(np.maximum(np.hypot(tilts[::2], tilts[1::2]), LEAST_SIZE), 2)


def _path_direction(state: _State, scale: FloatArray, direction: FloatArray) -> FloatArray:
    """Return the unit tangent of the path in scaled tilts, at an acute angle to `direction`, that of the last step."""
    # The angle is acute so that the path is not followed backwards.
    tangent = solve_linear(_path_matrix(state, scale, direction), np.append(np.zeros(scale.size), 1.0))
    return np.asarray(tangent / np.linalg.norm(tangent))


def _path_matrix(state: _State, scale: FloatArray, direction: FloatArray) -> FloatArray:
    """Return the matrix of Newton's step on the path, for the scaled tilts and the fraction of the coupling loads.

    The last row is the derivative of the distance along `direction`; the others are those of the scaled residual.
    """
    return np.vstack([np.column_stack([state.by_tilts * scale, state.by_share]) / scale[:, None], direction])


def _find_on_path(
    unit: Unit, force: FloatArray, start: _State, share: float, scale: FloatArray, step: FloatArray
) -> tuple[float, _State] | None:
    """Find the next point of the path, in the plane through the end of `step` and normal to it, by Newton's iteration.

    Return the fraction of the coupling loads and the state there; None if the iteration fails.
    """
    length = float(np.linalg.norm(step))
    place = step
    for _ in range(PATH_ITERATIONS):
        there = share + float(place[-1])
        state = _try_tilts(unit, force, start.hubs.tilts + scale * place[:-1], there)
        if state is None or np.linalg.norm(place - step) > FARTHEST * length:
            return None
        rest = state.residual / scale
        if np.max(np.abs(rest)) <= PATH_TOLERANCE:
            return there, state
        right = np.append(-rest, step @ (step - place) / length)
        try:
            place = place + solve_linear(_path_matrix(state, scale, step / length), right)
        except NoSolution:
            return None
    return None


def _hub_loads(ports: tuple[CouplingPort, ...], tilts: FloatArray) -> HubLoads:
    """Return the loads of all couplings at the tilts of the hubs, with the derivative with respect to the tilts."""
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
