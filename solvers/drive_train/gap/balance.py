"""The gap over the face at which mesh and shafts are in equilibrium.

A gap distributes the load over the face, and that load bends the shafts into a gap: the two have to be equal. Unknown
is the gap g at the stations; the residual is g minus the gap that shafts, bearings and couplings have under the load
that g gives. Newton's step is (I - D B) dg = -R with B = dQ/dg of the mesh (mean over a base pitch: the mesh frequency
lies far above any bending or film frequency, so the shafts follow the mean) and D the derivative of the gap by Q, the
couplings included. The mean of the gap belongs to the transmission error and is taken out. The iteration starts on a
coarse mesh of roll positions and slices, where most of its steps are made.
"""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.gap.hub_balance import HubLoads, Yielding, free_hubs, respond, solved
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import NoSolution
from solvers.scuffing.contact_lines import roll_positions
from solvers.scuffing.contact_slices import Mesh
from solvers.scuffing.face_response import FaceResponse, face_response
from solvers.scuffing.load_balance import LoadBalance, balance_load
from solvers.scuffing.model import PreparedMesh
from solvers.scuffing.modification import kinks_along_face, kinks_along_path

TOLERANCE = 1e-12  # m
ITERATIONS = 40  # chosen: what has not converged by then does not
COARSER = 4  # times fewer roll positions and slices, by which the gap changes by a nanometre
ROUGH_TOLERANCE = 1e-9  # m
ROUGH_ITERATIONS = 10  # the start need not be exact
LEAST_STEP = 1 / 64  # chosen: six halvings, then the step is taken as it is


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """The mesh under a gap `fixed` [m] at points of the face, the stations among them, and the shafts' on top.

    `scale` turns the force of its contacts into the transverse force that the shafts carry. Lines that run along the
    face have whole numbers of slices between stations, or some would get more of them than others.
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

    @property
    def coarser(self) -> "LoadedMesh":
        """The same mesh at fewer roll positions and slices."""
        given, form = self.prepared, self.prepared.mesh.gap
        count = given.rolls.phase.size // COARSER
        rolls = roll_positions(given.path.plane, count, kinks_along_path(form), kinks_along_face(form))
        return replace(self, prepared=replace(given, rolls=rolls), slices=self.slices // COARSER)

    def respond(self, gap: FloatArray, start: FaceResponse | None = None) -> FaceResponse:
        """Force of the contacts at the stations, from the response to a similar gap."""
        count, slices = self.stations.size, self.slices
        if self.prepared.path.plane.tan_base_helix == 0.0:
            slices = -(-slices // (count - 1)) * (count - 1)
        return face_response(self.under(gap), self.prepared.rolls, self.force, slices, count, start)

    def balance(self, gap: FloatArray, near: FaceResponse | None = None) -> LoadBalance:
        """The balance of the load with the shafts' gap [m], from the response to a similar gap."""
        start = None if near is None else (near.error, near.log_load)
        return balance_load(self.under(gap), self.prepared.rolls, self.force, self.slices, start)


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Gap [m] at the stations (mean taken out and kept), the loads of all ports, those of the hubs, the balance.

    `by_gap` [N/m] is the derivative of the force at the stations by a gap added there: the mesh's answer with the
    shafts' behind it.
    """

    gap: FloatArray
    mean_gap: float
    loads: FloatArray
    hubs: HubLoads
    balance: LoadBalance
    by_gap: FloatArray
    iterations: int
    residual: float


def equilibrium(unit: Unit, mesh: LoadedMesh, start: FloatArray | None = None) -> Equilibrium:
    """Newton's iteration on the gap, from a known one, else from that of a coarse mesh under a uniform load (Eq. D11).

    Raises NoSolution drive_train with the residual [um] where it does not converge.
    """
    hubs = free_hubs(unit, uniform_force(mesh.transmitted, unit.stations.size))
    if start is None:
        start, hubs = _rough(unit, mesh.coarser, hubs)
    state = _evaluate(unit, mesh, start, hubs, None)
    for iteration in range(1, ITERATIONS + 1):
        if state.size <= TOLERANCE:
            return _settled(mesh, state, iteration)
        state = _advance(unit, mesh, state)
    raise NoSolution("drive_train", "shafts and mesh found no common gap", {"residual_um": state.size * 1e6})


def _rough(unit: Unit, mesh: LoadedMesh, hubs: HubLoads) -> tuple[FloatArray, HubLoads]:
    """About the gap, and the loads of the hubs: how near they are is for the mesh itself to say."""
    count = unit.stations.size
    answer = respond(unit, uniform_force(mesh.transmitted, count), hubs)
    state = _evaluate(unit, mesh, centred(answer.motion[:count]), answer.hubs, None)
    for _ in range(ROUGH_ITERATIONS):
        if state.size <= ROUGH_TOLERANCE:
            break
        state = _advance(unit, mesh, state)
    return state.gap, state.answer.hubs


def _settled(mesh: LoadedMesh, state: "_State", iterations: int) -> Equilibrium:
    """What a gap that its load leaves means."""
    answer, by_gap = state.answer, mesh.scale * state.response.derivative
    return Equilibrium(
        gap=state.gap,
        mean_gap=face_mean(answer.motion[: state.gap.size]),
        loads=np.concatenate([mesh.scale * state.response.force, answer.hubs.loads]),
        hubs=answer.hubs,
        balance=mesh.balance(state.gap, state.response),
        by_gap=solved(_matrix(mesh, state).T, by_gap.T).T,
        iterations=iterations,
        residual=state.size,
    )


@dataclass(frozen=True, slots=True)
class _State:
    gap: FloatArray
    response: FaceResponse
    answer: Yielding
    residual: FloatArray

    @property
    def size(self) -> float:
        return float(np.max(np.abs(self.residual)))


def _evaluate(unit: Unit, mesh: LoadedMesh, gap: FloatArray, hubs: HubLoads, before: FaceResponse | None) -> _State:
    response = mesh.respond(gap, before)
    answer = respond(unit, mesh.scale * response.force, hubs)
    return _State(gap, response, answer, gap - centred(answer.motion[: gap.size]))


def _matrix(mesh: LoadedMesh, state: _State) -> FloatArray:
    """I - D B."""
    by_force = _centred_rows(state.answer.derivative)
    return np.asarray(np.eye(state.gap.size) - mesh.scale * by_force @ state.response.derivative)


def _advance(unit: Unit, mesh: LoadedMesh, state: _State) -> _State:
    """The state after Newton's step, halved while the residual does not fall or the parts find no balance there."""
    step, share = centred(solved(_matrix(mesh, state), -state.residual)), 1.0
    while True:
        try:
            following = _evaluate(unit, mesh, state.gap + share * step, state.answer.hubs, state.response)
        except NoSolution:
            if share < LEAST_STEP:
                raise
        else:
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
