"""The tooth spaces to compute, ready for any speed: what the choking search and a single solution share."""

from dataclasses import dataclass
from math import tan

from solvers.gears.pair import GearPair
from solvers.gears.path_of_contact import PathOfContact, meshing_path
from solvers.notices import Notice
from solvers.pumping.checks import check_setup, check_tips_meet_involutes
from solvers.pumping.face import Stretch, stretches
from solvers.pumping.flow import SpaceFlow
from solvers.pumping.gas_dynamics import CELL_STEP_LIMIT, LEAST_SLICES, duct, gas_dynamics, sample_angles
from solvers.pumping.incompressible import incompressible
from solvers.pumping.inputs import Flow, PumpingSetup, Spaces
from solvers.pumping.notices import setup_notices
from solvers.pumping.nozzle import Gas, gas
from solvers.pumping.pocket_chain import pocket_chain
from solvers.pumping.stroke import StrokeTable, stroke_table
from solvers.pumping.tooth_space import tooth_space


@dataclass(frozen=True, slots=True)
class Space:
    """The spaces of one gear: its speed per pinion speed, the lag of the stroke per metre of face [rad/m]."""

    of_pinion: bool
    table: StrokeTable
    speed_ratio: float
    lag: float


@dataclass(frozen=True, slots=True)
class Mesh:
    """All that does not depend on the speed."""

    setup: PumpingSetup
    path: PathOfContact
    gas: Gas
    spaces: tuple[Space, ...]
    notices: tuple[Notice, ...]

    @property
    def pair(self) -> GearPair:
        """The gear pair."""
        return self.path.pair


def prepare(setup: PumpingSetup) -> Mesh:
    """Geometry, stroke tables and the notices they call for.

    Raises InvalidInput with the codes of `check_setup`, `meshing_path`, `check_tips_meet_involutes`, `tooth_space`,
    `stroke_table` and `stretches`.
    """
    check_setup(setup)
    path = meshing_path(setup.gears)
    check_tips_meet_involutes(path)
    wanted = setup.model.spaces
    spaces = []
    if wanted is not Spaces.WHEEL:
        spaces.append(_space(setup, path.pair, of_pinion=True))
    if wanted is not Spaces.PINION:
        spaces.append(_space(setup, path.pair, of_pinion=False))
    active = min(_active_share(space, setup.gears.face_width) for space in spaces) * setup.model.slice_count
    return Mesh(setup, path, gas(setup.ambient), tuple(spaces), tuple(setup_notices(setup, path, active)))


def _active_share(space: Space, face_width: float) -> float:
    """Largest share of the face whose slices are in their stroke at one time."""
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
    """The stretches of face between the grooves, in slices fit for the flow model."""
    least = LEAST_SLICES if setup.model.flow is Flow.GAS_DYNAMICS else 1
    return stretches(setup.gears.face_width, setup.grooves, slices, least)


def flow_at(
    mesh: Mesh, space: Space, pinion_speed: float, slices: int, *, cell_step_limit: int = CELL_STEP_LIMIT
) -> SpaceFlow:
    """One stroke of the spaces of one gear at a pinion speed [rad/s].

    Raises InvalidInput: too_many_steps; NoSolution: unphysical_state, newton_not_converged.
    """
    setup, model = mesh.setup, mesh.setup.model
    speed, width = pinion_speed * space.speed_ratio, setup.gears.face_width
    if model.flow is Flow.INCOMPRESSIBLE:
        return incompressible(mesh.gas, space.table, width, speed, model.discharge_coefficient)
    transport = model.flow is Flow.GAS_DYNAMICS and model.wall_transport
    ducts = [
        (part, duct(space.table, part, space.lag, speed, model.discharge_coefficient, transport=transport))
        for part in face_stretches(setup, slices)
    ]
    angle = sample_angles(space.table, space.lag, width)
    if model.flow is Flow.POCKET_CHAIN:
        return pocket_chain(mesh.gas, ducts, angle, model.closure)
    return gas_dynamics(mesh.gas, ducts, angle, cell_step_limit=cell_step_limit)
