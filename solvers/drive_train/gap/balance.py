"""The gap over the face at which the gear mesh and the shafts are in equilibrium.

The gap between the flanks spreads the load over the face; the load bends the shafts, which changes the gap. The unknown
is the gap g at stations along every face. The residual R is g minus the gap that shafts, bearings and couplings cause
under the load that belongs to g. Newton's step dg solves (I - D B) dg = -R: B = dQ/dg is the derivative of the mesh
force Q, and D that of the shafts' gap with respect to Q, with the response of the couplings. Q is a mean over a base
pitch, because the mesh frequency is far higher than the natural frequencies of bending and of the bearing films. The
mean of g over each face is subtracted: it belongs to the transmission error and to the axial float. The shares of two
faces follow from the thrust of the couplings in the last step.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.gap.hub_balance import HubLoads, Yielding, free_hubs, respond, solve_linear
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import NoSolution
from solvers.scuffing.contact_lines import roll_positions
from solvers.scuffing.contact_slices import Mesh
from solvers.scuffing.face_response import FaceResponse, face_response
from solvers.scuffing.load_balance import LoadBalance, balance_load
from solvers.scuffing.model import PreparedMesh
from solvers.scuffing.modification import kinks_along_face, kinks_along_path

TOLERANCE = 1e-12  # m
ITERATIONS = 40  # chosen: an iteration that needs more iterations than this does not converge
COARSER = 4  # divisor of the numbers of roll positions and slices; the coarse mesh changes the gap by a nanometre
ROUGH_TOLERANCE = 1e-9  # m
PER_SHARE = 1e-3  # m; a share that still moves counts as a residual of this length per unit: settled within 1e-9
ROUGH_ITERATIONS = 10  # the rough gap need not be exact, because the iteration only starts from it
LEAST_STEP = 1 / 64  # chosen: a step that was shortened to a smaller share is accepted even if the residual grows


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """The mesh of a face, and the part of its gap that does not depend on the load."""

    prepared: PreparedMesh
    fixed: FloatArray  # this part at points of the face, m
    stations: FloatArray  # where the mesh force acts on the shafts, m
    force: float
    slices: int
    scale: float  # from the force of the contacts to the transverse force that the shafts carry

    @property
    def transmitted(self) -> float:
        """Transverse force F_bt on the shafts [N], without the load factors of the contacts."""
        return self.scale * self.force * self.prepared.path.plane.cos_base_helix

    def sharing(self, share: float) -> "LoadedMesh":
        """Return the mesh under a share of its force."""
        return replace(self, prepared=self.prepared.sharing(share), force=share * self.force)

    def under(self, gap: FloatArray) -> Mesh:
        """Return the mesh whose gap is the fixed gap plus the gap [m] that the shafts cause at the stations."""
        points = np.linspace(0.0, self.stations[-1], self.fixed.size)
        mesh = self.prepared.mesh
        lead = self.fixed + np.interp(points, self.stations, gap)
        return mesh._replace(gap=mesh.gap._replace(lead=lead))

    @property
    def coarser(self) -> "LoadedMesh":
        """The same mesh with fewer roll positions and slices."""
        given, form = self.prepared, self.prepared.mesh.gap
        count = given.rolls.phase.size // COARSER
        rolls = roll_positions(given.path.plane, count, kinks_along_path(form), kinks_along_face(form))
        return replace(self, prepared=replace(given, rolls=rolls), slices=self.slices // COARSER)

    def respond(self, gap: FloatArray, start: FaceResponse | None = None) -> FaceResponse:
        """Force of the contacts at the stations; `start` is the response to a similar gap, to start from."""
        count, slices = self.stations.size, self.slices
        # Contact lines of a spur pair run along the face. Therefore all intervals between stations get the same number
        # of slices.
        if self.prepared.path.plane.tan_base_helix == 0.0:
            slices = -(-slices // (count - 1)) * (count - 1)
        return face_response(self.under(gap), self.prepared.rolls, self.force, slices, count, start)

    def balance(self, gap: FloatArray, near: FaceResponse | None = None) -> LoadBalance:
        """Solve the load balance with the shafts' gap [m]; `near` is the response to a similar gap, to start from."""
        start = None if near is None else (near.error, near.log_load)
        return balance_load(self.under(gap), self.prepared.rolls, self.force, self.slices, start)


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Equilibrium of mesh and shafts."""

    gap: FloatArray  # (faces, stations) m, that the shafts cause, minus the mean over each face
    mean_gap: FloatArray  # (faces,) m, these means
    shares: FloatArray
    meshes: tuple[LoadedMesh, ...]  # of the faces, under their shares of the force
    loads: FloatArray  # at the stations and on the hubs, N and N m
    hubs: HubLoads
    balances: tuple[LoadBalance, ...]
    by_gap: FloatArray  # N/m, of the forces by an additional gap, both at all stations, as mesh and shafts respond
    iterations: int
    residual: float


def equilibrium(unit: Unit, meshes: tuple[LoadedMesh, ...], start: FloatArray | None = None) -> Equilibrium:
    """Find the gap at which mesh and shafts are in equilibrium, by Newton's iteration (Eq. D11).

    `meshes` are those of the faces, each under the whole force. `start` (faces, stations) [m] is the gap to start from,
    by default that of a coarse mesh. Raises NoSolution: `drive_train` with the residual [um] if the iteration does not
    converge, `helix_unloaded` if one of two helices lifts off.
    """
    force = meshes[0].transmitted
    hubs = free_hubs(unit, uniform_force(force, unit.stations.size, [1 / len(meshes)] * len(meshes)))
    if start is None:  # fewer roll positions and slices make most of the steps
        start, hubs = _rough(unit, tuple(mesh.coarser for mesh in meshes), hubs)
    state = _evaluate(unit, meshes, start, hubs, None)
    for iteration in range(1, ITERATIONS + 1):
        if state.size <= TOLERANCE:
            if unit.split is not None:
                unit.split.check(state.answer.hubs.loads, force)
            return _equilibrium_at(state, iteration)
        state = _advance(unit, meshes, state)
    raise NoSolution(
        "drive_train",
        "the iteration between the deflections of the shafts and the loads of the mesh did not converge",
        {"residual_um": state.size * 1e6},
    )


def at_rest(unit: Unit, meshes: tuple[LoadedMesh, ...]) -> Equilibrium:
    """Return the equilibrium while shafts and bearings do not yield: the shafts cause no gap."""
    gap = np.zeros((len(meshes), unit.stations.size))
    nothing = HubLoads(np.zeros(0), np.zeros(0), np.zeros((0, 0)))
    state = _evaluate(unit, meshes, gap, nothing, None)
    if unit.split is not None:
        unit.split.check(nothing.loads, meshes[0].transmitted)
    return Equilibrium(
        gap=gap,
        mean_gap=np.zeros(len(meshes)),
        shares=state.shares,
        meshes=state.meshes,
        loads=state.force,
        hubs=nothing,
        balances=tuple(mesh.balance(own) for mesh, own in zip(state.meshes, gap, strict=True)),
        by_gap=state.by_gap,
        iterations=0,
        residual=0.0,
    )


def shares_of(unit: Unit, hubs: HubLoads, force: float) -> FloatArray:
    """Return the shares of the faces of the transverse force [N]."""
    return np.ones(1) if unit.split is None else unit.split.shares(hubs.loads, force)


def _rough(unit: Unit, meshes: tuple[LoadedMesh, ...], hubs: HubLoads) -> tuple[FloatArray, HubLoads]:
    """Return an approximate gap and the loads of the hubs, by an iteration with the coarse mesh from a uniform load."""
    count, force = unit.stations.size, meshes[0].transmitted
    answer = respond(unit, uniform_force(force, count, list(shares_of(unit, hubs, force))), hubs)
    state = _evaluate(unit, meshes, remove_mean(_of_faces(answer.motion, unit)), answer.hubs, None)
    for _ in range(ROUGH_ITERATIONS):  # may end before it has converged: the full mesh follows
        if state.size <= ROUGH_TOLERANCE:
            break
        state = _advance(unit, meshes, state)
    return state.gap, state.answer.hubs


def _equilibrium_at(state: "_State", iterations: int) -> Equilibrium:
    answer = state.answer
    return Equilibrium(
        gap=state.gap,
        mean_gap=state.mean_gap,
        shares=state.shares,
        meshes=state.meshes,
        loads=np.concatenate([state.force, answer.hubs.loads]),
        hubs=answer.hubs,
        balances=tuple(
            mesh.balance(gap, response)
            for mesh, gap, response in zip(state.meshes, state.gap, state.responses, strict=True)
        ),
        by_gap=solve_linear(_matrix(state).T, state.by_gap.T).T,
        iterations=iterations,
        residual=state.size,
    )


@dataclass(frozen=True, slots=True)
class _State:
    """Gaps of the faces, the meshes and their responses under the shares, and the motion of the shafts."""

    gap: FloatArray
    meshes: tuple[LoadedMesh, ...]
    responses: tuple[FaceResponse, ...]
    answer: Yielding
    shares: FloatArray
    mean_gap: FloatArray
    residual: FloatArray
    moved: float  # what the shares would still change

    @property
    def size(self) -> float:
        return max(float(np.max(np.abs(self.residual))), PER_SHARE * self.moved)

    @property
    def force(self) -> FloatArray:
        """Transverse force at the stations of all faces [N]."""
        return _joined(self.meshes, self.responses)

    @property
    def by_gap(self) -> FloatArray:
        """Derivative of the force with respect to the gap while the shafts are at rest: a block for every face."""
        count = self.gap.shape[1]
        blocks = np.zeros((self.gap.size, self.gap.size))
        for k, (mesh, response) in enumerate(zip(self.meshes, self.responses, strict=True)):
            blocks[k * count : (k + 1) * count, k * count : (k + 1) * count] = mesh.scale * response.derivative
        return blocks


def _evaluate(
    unit: Unit, meshes: tuple[LoadedMesh, ...], gap: FloatArray, hubs: HubLoads, before: _State | None
) -> _State:
    force = meshes[0].transmitted
    shares = shares_of(unit, hubs, force)
    sharing = tuple(mesh.sharing(float(share)) for mesh, share in zip(meshes, shares, strict=True))
    starts = [None] * len(meshes) if before is None else before.responses
    responses = tuple(mesh.respond(own, start) for mesh, own, start in zip(sharing, gap, starts, strict=True))
    answer = respond(unit, _joined(sharing, responses), hubs)
    motion = _of_faces(answer.motion, unit)
    return _State(
        gap=gap,
        meshes=sharing,
        responses=responses,
        answer=answer,
        shares=shares,
        mean_gap=np.array([face_mean(own) for own in motion]),
        residual=gap - remove_mean(motion),
        moved=float(np.max(np.abs(shares_of(unit, answer.hubs, force) - shares))),
    )


def _joined(meshes: tuple[LoadedMesh, ...], responses: tuple[FaceResponse, ...]) -> FloatArray:
    return np.concatenate([mesh.scale * each.force for mesh, each in zip(meshes, responses, strict=True)])


def _of_faces(motion: FloatArray, unit: Unit) -> FloatArray:
    """Return the motion of the stations (faces, stations) out of that of all ports."""
    return motion[: unit.count].reshape(len(unit.frame.faces), unit.stations.size)


def _matrix(state: _State) -> FloatArray:
    """Return the matrix I - D B of Newton's step; the docstring of this module explains D and B."""
    faces = len(state.meshes)
    by_force = np.concatenate([_remove_mean_of_rows(rows) for rows in np.split(state.answer.derivative, faces)])
    return np.asarray(np.eye(state.gap.size) - by_force @ state.by_gap)


def _advance(unit: Unit, meshes: tuple[LoadedMesh, ...], state: _State) -> _State:
    """Return the state after Newton's step, halved until every part of the unit has a solution and the residual falls.

    If less than `LEAST_STEP` of the step is left, the residual need not fall, and a part without a solution raises
    NoSolution.
    """
    step = remove_mean(solve_linear(_matrix(state), -state.residual.ravel()).reshape(state.gap.shape))
    share = 1.0
    while True:
        try:
            following = _evaluate(unit, meshes, state.gap + share * step, state.answer.hubs, state)
        except NoSolution:
            if share < LEAST_STEP:
                raise
        else:
            if following.size < state.size or share < LEAST_STEP:
                return following
        share /= 2


def uniform_force(force: float, stations: int, shares: Sequence[float] = (1.0,)) -> FloatArray:
    """Spread the shares of a force [N] evenly over their faces, and return the forces at the stations [N]."""
    weights = np.ones(stations)
    weights[0] = weights[-1] = 0.5
    return np.concatenate([share * force * weights / (stations - 1) for share in shares])


def remove_mean(gap: FloatArray) -> FloatArray:
    """Return the gaps (faces, stations) minus their means over each face."""
    return np.asarray(gap - np.array([[face_mean(own)] for own in gap]))


def _remove_mean_of_rows(derivative: FloatArray) -> FloatArray:
    """Return the derivative of the gap minus the derivative of the mean gap."""
    mean = (derivative.sum(axis=0) - 0.5 * (derivative[0] + derivative[-1])) / (derivative.shape[0] - 1)
    return np.asarray(derivative - mean)
