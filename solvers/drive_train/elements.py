"""Results of the shafts and couplings: bearing loads, deflection, thrust and hub loads."""

from math import hypot

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.inputs import DriveTrainInputs, Vector2
from solvers.drive_train.results import BearingResult, CouplingResult, ShaftCurves, ShaftResult
from solvers.drive_train.shafts.bearings import BearingState
from solvers.drive_train.shafts.coupling_loads import (
    LEAST_TILT,
    LOADS,
    TILTS,
    HubMoments,
    held_thrust,
    hub_moments,
    hub_warnings,
)
from solvers.drive_train.shafts.influence import ShaftPorts, Unit
from solvers.drive_train.shafts.thrust_budget import mesh_thrust, split_thrust_budget, thrust_budget
from solvers.gears.pair import PathOfContact
from solvers.notices import Notice


def hubs_of(unit: Unit, equilibrium: Equilibrium) -> list[tuple[HubMoments, HubMoments]]:
    """Return the moments of both hubs of every coupling at the tilts in equilibrium."""
    return [
        (hub_moments(port, sizes[0]), hub_moments(port, sizes[1]))
        for port, sizes in zip(unit.couplings, _tilt_sizes(unit, equilibrium), strict=True)
    ]


def warnings_of(unit: Unit, equilibrium: Equilibrium) -> list[tuple[Notice, ...]]:
    """Return the warnings of the coupling model for both hubs of every coupling."""
    return [
        (*hub_warnings(port, sizes[0]), *hub_warnings(port, sizes[1]))
        for port, sizes in zip(unit.couplings, _tilt_sizes(unit, equilibrium), strict=True)
    ]


def _tilt_sizes(unit: Unit, equilibrium: Equilibrium) -> list[Vector2]:
    """Return the sizes of the tilts [rad] of both hubs of every coupling.

    A size below `LEAST_TILT` is raised to `LEAST_TILT`.
    """
    tilts = equilibrium.hubs.tilts.reshape(len(unit.couplings), 2, 2)
    return [(max(hypot(*a), LEAST_TILT), max(hypot(*b), LEAST_TILT)) for a, b in tilts]


def coupling_results(
    unit: Unit, equilibrium: Equilibrium, hubs: list[tuple[HubMoments, HubMoments]]
) -> tuple[CouplingResult, ...]:
    """Return tilts, friction and loads of the couplings.

    `equilibrium` contains the conjugate moment m = -Z x M of each coupling. The results contain the moment M.
    """
    results = []
    for k, (port, pair) in enumerate(zip(unit.couplings, hubs, strict=True)):
        tilts = equilibrium.hubs.tilts[TILTS * k : TILTS * (k + 1)]
        *force, turned_x, turned_y, thrust = map(float, equilibrium.loads[unit.count + LOADS * k :][:LOADS])
        sizes = (hypot(tilts[0], tilts[1]), hypot(tilts[2], tilts[3]))
        held = None
        if unit.split is not None:
            held = min(held_thrust(port, hub.friction_coefficient, size) for hub, size in zip(pair, sizes, strict=True))
        results.append(
            CouplingResult(
                tilt=sizes,
                stuck=(pair[0].sticks, pair[1].sticks),
                friction_share=(pair[0].share, pair[1].share),
                moment=(-turned_y, turned_x),
                force=_pair(np.array(force) + port.sleeve_weight),
                friction_coefficient=min(hub.friction_coefficient for hub in pair),
                thrust=thrust,
                thrust_limit=min(hub.thrust_limit for hub in pair),
                friction_power=sum(hub.loss * port.speed * size for hub, size in zip(pair, sizes, strict=True)),
                held_thrust_fraction=held,
            )
        )
    return tuple(results)


def shaft_results(
    inputs: DriveTrainInputs,
    path: PathOfContact,
    unit: Unit,
    equilibrium: Equilibrium,
    couplings: tuple[CouplingResult, ...],
) -> tuple[ShaftResult, ShaftResult]:
    """Return bearings, thrust and deflection of both shafts."""
    couplings_of_shafts = [
        [coupling for port, coupling in zip(unit.couplings, couplings, strict=True) if port.inputs.shaft == name]
        for name in ("pinion", "wheel")
    ]
    acting = [sum(coupling.thrust for coupling in own) for own in couplings_of_shafts]
    limits = [sum(coupling.thrust_limit for coupling in own) for own in couplings_of_shafts]
    forces = (acting[0], acting[1]), (limits[0], limits[1]), (_hub_diameter(inputs, 0), _hub_diameter(inputs, 1))
    if unit.split is None:
        thrusts = thrust_budget(inputs, mesh_thrust(inputs, path, unit.frame), *forces)
    else:
        thrusts = split_thrust_budget(inputs, unit.split, unit.split.force(equilibrium.hubs.loads), *forces)
    states = unit.bearings(equilibrium.loads)
    shafts = []
    for i, side in enumerate(unit.shafts):
        bearings = states[2 * i : 2 * i + 2]
        curves = _curves(side, equilibrium.loads, bearings, unit.offsets[4 * i : 4 * i + 4])
        shafts.append(ShaftResult((_bearing(bearings[0]), _bearing(bearings[1])), thrusts[i], curves))
    return shafts[0], shafts[1]


def _hub_diameter(inputs: DriveTrainInputs, index: int) -> float | None:
    """Return the diameter [m] of a shaft at the hub of its coupling, or None if the shaft has no coupling."""
    shaft, name = inputs.shafts[index], ("pinion", "wheel")[index]
    for coupling in inputs.couplings:
        if coupling.shaft == name:
            ends = shaft.start + np.cumsum([section.length for section in shaft.sections])
            return shaft.sections[min(int(np.searchsorted(ends, coupling.position)), ends.size - 1)].outer_diameter
    return None


def _bearing(state: BearingState) -> BearingResult:
    return BearingResult(
        reaction=_pair(-state.load),
        displacement=_pair(state.displacement),
        eccentricity_ratio=state.eccentricity_ratio,
        attitude=state.attitude,
        min_film=state.minimum_film,
        specific_pressure=state.specific_pressure,
        friction_power=state.friction_power,
    )


def _curves(side: ShaftPorts, loads: FloatArray, bearings: list[BearingState], offsets: FloatArray) -> ShaftCurves:
    """Return the elastic line of a shaft in its displaced bearings, and the twist of the shaft."""
    nodes = side.model.z.size
    displacement = np.array([state.displacement for state in bearings]) + offsets.reshape(2, 2)
    motion = side.motion(side.loads @ loads + side.fixed) + displacement.T @ side.model.bearing_share
    return ShaftCurves(
        z=frozen(side.model.z),
        x=frozen(motion[0, :nodes]),
        y=frozen(motion[1, :nodes]),
        twist=frozen(side.model.torsion @ (side.torques @ loads)),
    )


def _pair(vector: FloatArray) -> Vector2:
    return float(vector[0]), float(vector[1])
