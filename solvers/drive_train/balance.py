"""Mesh against shafts: the gap over the face at which the load it leaves bends the shafts into just that gap.

Unknown is the gap g at the stations; the residual is g minus what shafts, bearings and couplings make of the load it
leaves. Newton's step is (I - D B) dg = -R with B = dQ/dg of the mesh (mean over a base pitch: the mesh frequency lies
far above any bending or film frequency, so the shafts follow the mean) and D the derivative of the gap by Q, the
couplings' answer included. The mean of the gap belongs to the transmission error and is taken out.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.coupling_loads import CouplingPort, coupling_loads, softened
from solvers.drive_train.face_curves import face_mean
from solvers.drive_train.influence import Unit
from solvers.errors import NoSolution
from solvers.scuffing.contact_slices import Mesh
from solvers.scuffing.face_response import FaceResponse, face_response
from solvers.scuffing.load_balance import LoadBalance, balance_load
from solvers.scuffing.model import PreparedMesh

TOLERANCE = 1e-12  # m
ITERATIONS = 40
TILT_TOLERANCE = 1e-13  # rad
TILT_ITERATIONS = 60
LEAST_STEP = 1 / 64
SOFTNESS = (1000.0, 300.0, 100.0, 50.0, 30.0, 20.0, 10.0, 7.0, 5.0, 3.0, 2.0, 1.4, 1.0)
UNIFORM_REFRESHES = 3


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """The mesh under a gap `fixed` [m] at points of the face, the stations among them, and the shafts' on top.

    `scale` turns the force of its contacts into the transverse force that the shafts carry.
    """

    prepared: PreparedMesh
    fixed: FloatArray
    stations: FloatArray
    force: float
    slices: int
    scale: float

    @property
    def transmitted(self) -> float:
        """Transverse force F_bt that the shafts carry [N], without the load factors of the contacts."""
        return self.scale * self.force * self.prepared.path.plane.cos_base_helix

    def under(self, gap: FloatArray) -> Mesh:
        """The mesh with the shafts' gap [m] at the stations."""
        points = np.linspace(0.0, self.stations[-1], self.fixed.size)
        mesh = self.prepared.mesh
        lead = self.fixed + np.interp(points, self.stations, gap)
        return mesh._replace(gap=mesh.gap._replace(lead=lead))

    def respond(self, gap: FloatArray, start: FaceResponse | None = None) -> FaceResponse:
        """Force of the contacts at the stations, from the response to a similar gap."""
        return face_response(self.under(gap), self.prepared.rolls, self.force, self.slices, self.stations.size, start)

    def balance(self, gap: FloatArray) -> LoadBalance:
        """The balance of the load with the shafts' gap [m]."""
        return balance_load(self.under(gap), self.prepared.rolls, self.force, self.slices)


@dataclass(frozen=True, slots=True)
class Tilts:
    """The couplings' answer to a load over the face: tilts x, loads p of the ports and dp/dQ through them."""

    tilts: FloatArray
    loads: FloatArray
    motion: FloatArray
    derivative: FloatArray


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Gap [m] at the stations (mean taken out and kept), the loads of all ports, the couplings' tilts, the balance.

    `by_gap` [N/m] is the derivative of the force at the stations by a gap added there: the mesh's answer with the
    shafts' behind it.
    """

    gap: FloatArray
    mean_gap: float
    loads: FloatArray
    tilts: FloatArray
    balance: LoadBalance
    by_gap: FloatArray
    iterations: int
    residual: float


def equilibrium(unit: Unit, mesh: LoadedMesh, start: FloatArray | None = None) -> Equilibrium:
    """Newton's iteration on the gap, from that of a uniform load or a known one.

    Raises NoSolution drive_train with the residual [um] where it does not converge.
    """
    count = unit.stations.size
    tilts = np.concatenate([port.rest for port in unit.couplings]) if unit.couplings else np.zeros(0)
    if start is None:
        answer = respond(unit, uniform_force(mesh.transmitted, count), tilts)
        tilts, start = answer.tilts, centred(answer.motion[:count])
    state = _evaluate(unit, mesh, start, tilts, None)
    for iteration in range(1, ITERATIONS + 1):
        matrix = np.eye(count) - mesh.scale * _centred_rows(state.answer.derivative) @ state.response.derivative
        if state.size <= TOLERANCE:
            answer = state.answer
            return Equilibrium(
                gap=state.gap,
                mean_gap=face_mean(answer.motion[:count]),
                loads=np.concatenate([mesh.scale * state.response.force, answer.loads]),
                tilts=answer.tilts,
                balance=mesh.balance(state.gap),
                by_gap=np.asarray(np.linalg.solve(matrix.T, mesh.scale * state.response.derivative.T).T, dtype=float),
                iterations=iteration,
                residual=state.size,
            )
        step = centred(np.asarray(np.linalg.solve(matrix, -state.residual), dtype=float))
        state = _advance(unit, mesh, state, step)
    raise NoSolution("drive_train", "shafts and mesh found no common gap", {"residual_um": state.size * 1e6})


@dataclass(frozen=True, slots=True)
class _State:
    gap: FloatArray
    response: FaceResponse
    answer: Tilts
    residual: FloatArray

    @property
    def size(self) -> float:
        return float(np.max(np.abs(self.residual)))


def _evaluate(unit: Unit, mesh: LoadedMesh, gap: FloatArray, tilts: FloatArray, before: FaceResponse | None) -> _State:
    response = mesh.respond(gap, before)
    answer = respond(unit, mesh.scale * response.force, tilts)
    return _State(gap, response, answer, gap - centred(answer.motion[: gap.size]))


def _advance(unit: Unit, mesh: LoadedMesh, state: _State, step: FloatArray) -> _State:
    """The state after a step, halved while the residual does not fall."""
    share = 1.0
    while True:
        following = _evaluate(unit, mesh, state.gap + share * step, state.answer.tilts, state.response)
        if following.size < state.size or share < LEAST_STEP:
            return following
        share /= 2


def uniform_force(force: float, stations: int) -> FloatArray:
    """A force [N] spread evenly over the face, at its stations."""
    weights = np.ones(stations)
    weights[0] = weights[-1] = 0.5
    return force * weights / (stations - 1)


def centred(gap: FloatArray) -> FloatArray:
    """The gap without its mean over the face."""
    return gap - face_mean(gap)


def _centred_rows(derivative: FloatArray) -> FloatArray:
    """The derivative of the gap without its mean."""
    mean = (derivative.sum(axis=0) - 0.5 * (derivative[0] + derivative[-1])) / (derivative.shape[0] - 1)
    return np.asarray(derivative - mean)


def respond(unit: Unit, force: FloatArray, tilts: FloatArray) -> Tilts:
    """Motion of the ports under a force over the face, the couplings' loads found from the tilts they cause.

    Starts at `tilts`, and where that fails at a hub whose teeth slide late, which stiffens step by step. Raises
    NoSolution drive_train with the tilts' residual [rad].
    """
    ports = unit.couplings
    if not ports:
        motion, derivative = unit.motion(force)
        return Tilts(tilts, np.zeros(0), motion, derivative)
    found, residual = _solve_tilts(unit, ports, force, tilts)
    if found is None:
        tilts = np.concatenate([port.rest for port in ports])
        for factor in SOFTNESS:
            softer = tuple(softened(port, factor) for port in ports)
            found, residual = _solve_tilts(unit, softer, force, tilts)
            tilts = tilts if found is None else found.tilts
    if found is None:
        raise NoSolution("drive_train", "the couplings' tilts were not found", {"tilt_rad": residual})
    return found


def _solve_tilts(
    unit: Unit, ports: tuple[CouplingPort, ...], force: FloatArray, tilts: FloatArray
) -> tuple[Tilts | None, float]:
    """Newton's iteration on the tilts x = rest + lever (motion of the hubs under the couplings' loads at x)."""
    count, best = force.size, np.inf
    step, share = np.zeros_like(tilts), 1.0
    for _ in range(TILT_ITERATIONS):
        loads, by_tilts, levers, rest = _all_loads(ports, tilts)
        motion, derivative = unit.motion(np.concatenate([force, loads]))
        residual = tilts - rest - levers @ motion[count:]
        size = float(np.max(np.abs(residual)))
        if size < best or share < LEAST_STEP:
            matrix = np.eye(tilts.size) - levers @ derivative[count:, count:] @ by_tilts
            if size <= TILT_TOLERANCE:
                through = np.linalg.solve(matrix, levers @ derivative[count:, :count])
                whole = derivative[:count, :count] + derivative[:count, count:] @ by_tilts @ through
                return Tilts(tilts, loads, motion, whole), size
            best, share = size, 1.0
            step = np.asarray(np.linalg.solve(matrix, -residual), dtype=float)
        else:
            tilts, share = tilts - share * step, share / 2
        tilts = tilts + share * step
    return None, best


def _all_loads(
    ports: tuple[CouplingPort, ...], tilts: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Loads of all couplings, their derivative by the tilts, levers and rest tilts."""
    size = 4 * len(ports)
    loads, derivative, levers = np.zeros(size), np.zeros((size, size)), np.zeros((size, size))
    for k, port in enumerate(ports):
        part = slice(4 * k, 4 * k + 4)
        loads[part], derivative[part, part] = coupling_loads(port, tilts[part])
        levers[part, part] = port.lever
    return loads, derivative, levers, np.concatenate([port.rest for port in ports])
