"""The gap over the face at which the gear mesh and the shafts are in equilibrium.

The gap between the flanks determines how the load is distributed over the face. The load bends the shafts, and the bent
shafts in turn cause a gap. In equilibrium, both gaps are equal. The unknown is the gap g at the stations, which are
points along the face. The residual R is g minus the gap that shafts, bearings and couplings cause under the load that
belongs to g. Newton's step dg is the solution of the linear equations (I - D B) dg = -R. Here B = dQ/dg is the
derivative of the mesh force Q. The force Q is a mean over a base pitch. The shafts follow only this mean, because the
mesh frequency is far higher than the natural frequencies of bending and of the bearing films. D is the derivative of
the shafts' gap with respect to Q; the response of the couplings is part of D. The mean of g over the face is
subtracted, because this mean belongs to the transmission error. If no start value is given, an iteration with fewer
roll positions and slices comes first. This first iteration makes most of the steps.
"""

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
ROUGH_ITERATIONS = 10  # the rough gap need not be exact, because the iteration only starts from it
LEAST_STEP = 1 / 64  # chosen: a step that was shortened to a smaller share is accepted even if the residual grows


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """The mesh, and the part of the gap that does not depend on the load.

    `fixed` [m] is this part at points of the face. The mesh force acts on the shafts at the `stations` [m].
    `scale` converts the force of the contacts into the transverse force that the shafts carry.
    """

    prepared: PreparedMesh
    fixed: FloatArray
    stations: FloatArray
    force: float
    slices: int
    scale: float

    @property
    def transmitted(self) -> float:
        """Transverse force F_bt on the shafts [N], without the load factors of the contacts."""
        return self.scale * self.force * self.prepared.path.plane.cos_base_helix

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
        """Compute the force of the contacts at the stations.

        The iteration starts from `start`, the response to a similar gap.
        """
        count, slices = self.stations.size, self.slices
        # Contact lines of a spur pair run along the face. Therefore all intervals between stations get the same number
        # of slices.
        if self.prepared.path.plane.tan_base_helix == 0.0:
            slices = -(-slices // (count - 1)) * (count - 1)
        return face_response(self.under(gap), self.prepared.rolls, self.force, slices, count, start)

    def balance(self, gap: FloatArray, near: FaceResponse | None = None) -> LoadBalance:
        """Solve the load balance with the shafts' gap [m].

        The iteration starts from `near`, the response to a similar gap.
        """
        start = None if near is None else (near.error, near.log_load)
        return balance_load(self.under(gap), self.prepared.rolls, self.force, self.slices, start)


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Equilibrium of mesh and shafts.

    `gap` [m] is the gap that the shafts cause at the stations, minus the mean over the face; `mean_gap` [m] is this
    mean. `loads` are the loads at the stations and on the hubs [N, N m]. `by_gap` [N/m] is the derivative of the force
    at the stations with respect to an additional gap at the stations. This derivative includes the responses of both
    mesh and shafts.
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
    """Find the gap at which mesh and shafts are in equilibrium, by Newton's iteration.

    Parameters
    ----------
    unit : Unit
        Shafts, bearings and couplings.
    mesh : LoadedMesh
        The mesh.
    start : FloatArray of shape (stations,), optional
        Gap from which the iteration starts; by default the gap of the coarse mesh [m].

    Returns
    -------
    Equilibrium
        The gap, with the loads and the response at this gap.

    Raises
    ------
    NoSolution
        `drive_train` with the residual [um] if the iteration does not converge.

    Notes
    -----
    Eq. D11.
    """
    hubs = free_hubs(unit, uniform_force(mesh.transmitted, unit.stations.size))
    if start is None:
        start, hubs = _rough(unit, mesh.coarser, hubs)
    state = _evaluate(unit, mesh, start, hubs, None)
    for iteration in range(1, ITERATIONS + 1):
        if state.size <= TOLERANCE:
            return _equilibrium_at(mesh, state, iteration)
        state = _advance(unit, mesh, state)
    raise NoSolution(
        "drive_train",
        "the iteration between the deflections of the shafts and the loads of the mesh did not converge",
        {"residual_um": state.size * 1e6},
    )


def _rough(unit: Unit, mesh: LoadedMesh, hubs: HubLoads) -> tuple[FloatArray, HubLoads]:
    """Return an approximate gap and the loads of the hubs, by an iteration with the coarse mesh.

    The iteration starts from a uniform load. This iteration may end before it has converged, because the iteration with
    the full mesh follows.
    """
    count = unit.stations.size
    answer = respond(unit, uniform_force(mesh.transmitted, count), hubs)
    state = _evaluate(unit, mesh, remove_mean(answer.motion[:count]), answer.hubs, None)
    for _ in range(ROUGH_ITERATIONS):
        if state.size <= ROUGH_TOLERANCE:
            break
        state = _advance(unit, mesh, state)
    return state.gap, state.answer.hubs


def _equilibrium_at(mesh: LoadedMesh, state: "_State", iterations: int) -> Equilibrium:
    answer, by_gap = state.answer, mesh.scale * state.response.derivative
    return Equilibrium(
        gap=state.gap,
        mean_gap=face_mean(answer.motion[: state.gap.size]),
        loads=np.concatenate([mesh.scale * state.response.force, answer.hubs.loads]),
        hubs=answer.hubs,
        balance=mesh.balance(state.gap, state.response),
        by_gap=solve_linear(_matrix(mesh, state).T, by_gap.T).T,
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
    return _State(gap, response, answer, gap - remove_mean(answer.motion[: gap.size]))


def _matrix(mesh: LoadedMesh, state: _State) -> FloatArray:
    """Return the matrix I - D B of Newton's step; the docstring of this module explains D and B."""
    by_force = _remove_mean_of_rows(state.answer.derivative)
    return np.asarray(np.eye(state.gap.size) - mesh.scale * by_force @ state.response.derivative)


def _advance(unit: Unit, mesh: LoadedMesh, state: _State) -> _State:
    """Return the state after Newton's step.

    The step is halved until two conditions are met: every part of the unit has a solution after the step, and the
    residual falls. If less than `LEAST_STEP` of the step is left, the residual need not fall, and a part without a
    solution raises NoSolution.
    """
    step, share = remove_mean(solve_linear(_matrix(mesh, state), -state.residual)), 1.0
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
    """Spread a force [N] evenly over the face, and return the forces at the stations [N]."""
    weights = np.ones(stations)
    weights[0] = weights[-1] = 0.5
    return force * weights / (stations - 1)


def remove_mean(gap: FloatArray) -> FloatArray:
    """Return the gap minus its mean over the face."""
    return gap - face_mean(gap)


def _remove_mean_of_rows(derivative: FloatArray) -> FloatArray:
    """Return the derivative of the gap minus the derivative of the mean gap."""
    mean = (derivative.sum(axis=0) - 0.5 * (derivative[0] + derivative[-1])) / (derivative.shape[0] - 1)
    return np.asarray(derivative - mean)
