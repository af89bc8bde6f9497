"""Tooth spaces prepared for all speeds, and the flow through them at one speed."""

from dataclasses import dataclass
from math import sqrt, tan

import numpy as np

from solvers.arrays import FloatArray
from solvers.gears.gear import rack_tip_radius
from solvers.gears.pair import GearPair, PathOfContact, meshing_path
from solvers.notices import Notice
from solvers.pumping.chain.pocket_chain import STEPS, pocket_chain
from solvers.pumping.checks import check_setup, refuse_cost
from solvers.pumping.flow.duct import Duct, wall_table
from solvers.pumping.flow.nozzle import Gas, gas
from solvers.pumping.flow.space_flow import SpaceFlow
from solvers.pumping.gas.gas_dynamics import LEAST_SLICES, cell_steps, gas_dynamics
from solvers.pumping.incompressible import incompressible
from solvers.pumping.inputs import MOST_SLICES, Flow, PumpingSetup, Spaces
from solvers.pumping.notices import jump_notices, setup_notices
from solvers.pumping.results import Derived
from solvers.pumping.space.face import Stretch, stretches
from solvers.pumping.space.stroke import StrokeTable, stroke_table
from solvers.pumping.space.tooth_space import tooth_space

CELL_STEP_LIMIT = 5_000_000  # largest number of cells times number of steps; this takes about ten seconds
_ANGLES = 201  # number of angles at which fields are recorded, enough for figures


@dataclass(frozen=True, slots=True)
class Space:
    """The tooth spaces of one gear; the stroke begins later by `lag` [rad/m] away from the end that meshes first."""

    of_pinion: bool
    table: StrokeTable
    speed_ratio: float
    lag: float


@dataclass(frozen=True, slots=True)
class Mesh:
    """The parts of a calculation that do not depend on the speed."""

    setup: PumpingSetup
    path: PathOfContact
    gas: Gas
    spaces: tuple[Space, ...]
    notices: tuple[Notice, ...]

    @property
    def pair(self) -> GearPair:
        return self.path.pair


def prepare(setup: PumpingSetup) -> Mesh:
    """Geometry, stroke tables and warnings; raises what `check_setup`, `meshing_path` and the tables refuse."""
    check_setup(setup)
    path = meshing_path(setup.gears)
    wanted = setup.model.spaces
    spaces = []
    if wanted is not Spaces.WHEEL:
        spaces.append(_space(setup, path.pair, of_pinion=True))
    if wanted is not Spaces.PINION:
        spaces.append(_space(setup, path.pair, of_pinion=False))
    active = min(_active_share(space, setup.gears.face_width) for space in spaces) * setup.model.slice_count
    notices = (*setup_notices(setup, path, active), *jump_notices([space.table for space in spaces]))
    return Mesh(setup, path, gas(setup.ambient), tuple(spaces), notices)


def derived(mesh: Mesh) -> Derived:
    """Return values that follow from the inputs, including the defaults of inputs that are not given."""
    gears = mesh.setup.gears
    room = min(rack_tip_radius(gears, teeth) for teeth in (gears.pinion, gears.wheel))
    gears = mesh.setup.gears
    total = None if gears.helices == 1 else gears.total_width
    return Derived(mesh.pair.centre_distance, mesh.setup.model.slice_count, room, total)


def _active_share(space: Space, face_width: float) -> float:
    """Largest share of the face width on which a tooth space is in its stroke at one instant."""
    limits, lag = space.table.limits, space.lag * face_width
    return min((limits.end - limits.start) / lag, 1.0) if lag > 0.0 else 1.0


def _space(setup: PumpingSetup, pair: GearPair, *, of_pinion: bool) -> Space:
    owner = pair.pinion if of_pinion else pair.wheel
    space = tooth_space(pair, setup.normal_backlash, setup.model.gap, of_pinion=of_pinion)
    return Space(
        of_pinion=of_pinion,
        table=stroke_table(space, minimum_gap=setup.model.minimum_gap),
        speed_ratio=pair.pinion.teeth / owner.teeth,
        lag=tan(abs(setup.gears.helix_angle)) / owner.reference_radius,
    )


def face_stretches(setup: PumpingSetup, slices: int) -> list[Stretch]:
    """Return the stretches of the face between the grooves. Each stretch has enough slices for the flow model."""
    least = LEAST_SLICES if setup.model.flow is Flow.GAS_DYNAMICS else 1
    return stretches(setup.gears.face_width, setup.grooves, slices, least)


def flow_at(
    mesh: Mesh, space: Space, pinion_speed: float, slices: int, *, cell_step_limit: int = CELL_STEP_LIMIT
) -> SpaceFlow:
    """Compute one stroke of the spaces of one gear at a pinion speed [rad/s].

    Raises InvalidInput: too_many_steps or narrow_land if gas dynamics would need too many steps; incompressible_vacuum
    if the suction would exceed the ambient pressure; the codes of `stretches` if the grooves do not fit the face.
    Raises NoSolution: unphysical_state if the gas dynamics fails; newton_not_converged if the pocket chain fails.
    """
    if mesh.setup.model.flow is Flow.INCOMPRESSIBLE:
        return _single_pocket(mesh, space, pinion_speed, space.table)
    parts = face_stretches(mesh.setup, slices)
    if mesh.setup.model.flow is Flow.POCKET_CHAIN:
        return _chain(mesh, space, pinion_speed, parts, STEPS)
    _check_cost(mesh, pinion_speed, parts, cell_step_limit)
    return _gas(mesh, space, pinion_speed, parts, _angles(mesh, space))


def coarser_flow_at(mesh: Mesh, space: Space, pinion_speed: float, slices: int, times: int) -> SpaceFlow:
    """The stroke of `flow_at` at a resolution `times` lower: slices and angles, steps of the chain, or positions."""
    if mesh.setup.model.flow is Flow.INCOMPRESSIBLE:
        return _single_pocket(mesh, space, pinion_speed, space.table.coarser(times))
    parts = face_stretches(mesh.setup, slices)
    if mesh.setup.model.flow is Flow.POCKET_CHAIN:
        return _chain(mesh, space, pinion_speed, parts, STEPS // times)
    return _gas(
        mesh, space, pinion_speed, [part.coarser(times) for part in parts], _angles(mesh, space)[::times].copy()
    )


def _single_pocket(mesh: Mesh, space: Space, pinion_speed: float, table: StrokeTable) -> SpaceFlow:
    width, discharge = mesh.setup.gears.face_width, mesh.setup.model.discharge_coefficient
    return incompressible(mesh.gas, table, width, pinion_speed, space.speed_ratio, discharge)


def _chain(mesh: Mesh, space: Space, pinion_speed: float, parts: list[Stretch], steps: int) -> SpaceFlow:
    ducts = [(part, space_duct(mesh, space, pinion_speed, part, transport=False)) for part in parts]
    return pocket_chain(mesh.gas, ducts, _angles(mesh, space), mesh.setup.model.closure, steps)


def _gas(mesh: Mesh, space: Space, pinion_speed: float, parts: list[Stretch], angles: FloatArray) -> SpaceFlow:
    return gas_dynamics(mesh.gas, _gas_ducts(mesh, space, pinion_speed, parts), angles)


def _gas_ducts(mesh: Mesh, space: Space, pinion_speed: float, parts: list[Stretch]) -> list[tuple[Stretch, Duct]]:
    transport = mesh.setup.model.wall_transport
    return [(part, space_duct(mesh, space, pinion_speed, part, transport=transport)) for part in parts]


def finest_slices(mesh: Mesh, pinion_speed: float, slices: int) -> int:
    """Largest number of slices that the speed allows; in chain and incompressible model, whose part it is, `slices`."""
    if mesh.setup.model.flow is not Flow.GAS_DYNAMICS:
        return slices
    cost = _largest_cost(mesh, pinion_speed, face_stretches(mesh.setup, slices))
    return max(slices, min(MOST_SLICES, int(slices * sqrt(CELL_STEP_LIMIT / cost))))


def _largest_cost(mesh: Mesh, pinion_speed: float, parts: list[Stretch]) -> float:
    return max(
        cell_steps(mesh.gas, _gas_ducts(mesh, space, pinion_speed, parts), _angles(mesh, space))
        for space in mesh.spaces
    )


def _check_cost(mesh: Mesh, pinion_speed: float, parts: list[Stretch], limit: int) -> None:
    """Refuse a speed at which gas dynamics would take too many steps in the tooth spaces of one of the gears."""
    largest_cost = _largest_cost(mesh, pinion_speed, parts)
    if largest_cost > limit:
        refuse_cost(pinion_speed, parts, largest_cost / limit)


def space_duct(mesh: Mesh, space: Space, pinion_speed: float, part: Stretch, *, transport: bool) -> Duct:
    """Describe a stretch of the spaces of one gear as a duct (Eq. 5)."""
    table = space.table
    carried = table.carried if transport else np.zeros_like(table.carried)
    clearance = table.clearance_left + table.clearance_right
    return Duct(
        start=part.start,
        width=part.width,
        cells=part.cells,
        lag=space.lag,
        speed=pinion_speed * space.speed_ratio,
        first_angle=table.limits.start,
        angle_step=(table.limits.end - table.limits.start) / (table.angle.size - 1),
        table=wall_table(table.area, clearance, carried),
        discharge=mesh.setup.model.discharge_coefficient,
    )


def _angles(mesh: Mesh, space: Space) -> FloatArray:
    """Angles of the gear [rad] at which its flow is recorded, from the first to the last stroke over the face."""
    limits = space.table.limits
    return np.linspace(limits.start, limits.end + space.lag * mesh.setup.gears.face_width, _ANGLES)
