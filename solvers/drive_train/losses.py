"""Power losses of the unit, and the balance of forces and moments on its shafts."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import CouplingResult, ForceBalance, ShaftResult, TrainLosses
from solvers.drive_train.shafts.influence import ShaftPorts, Unit
from solvers.heat_balance import Heat


def train_losses(
    inputs: DriveTrainInputs,
    mesh: float | None,
    pumping: float,
    shafts: tuple[ShaftResult, ShaftResult],
    couplings: tuple[CouplingResult, ...],
    heat: Heat | None = None,
) -> TrainLosses:
    """Return the losses of all parts of the unit [W].

    `mesh` [W] is the loss that the model of the mesh computes, of all helices; `pumping` [W] is the loss that the
    pumping model computes. If `heat` is given, the mesh loss in `heat` replaces `mesh`. The total then also contains
    the losses in `heat` by acceleration of the oil, by windage and by other causes. If the loss of the mesh is not
    known, the total is None. If the total is not smaller than the power, the efficiency is None.
    """
    bearings = sum(bearing.friction_power for shaft in shafts for bearing in shaft.bearings)
    coupling = sum(result.friction_power for result in couplings)
    parts: tuple[float | None, float | None, float | None] = (None, None, None)
    if heat is not None:
        # Jets that are faster than the teeth would drive them; this is not credited, for the oil pump pays for it.
        acceleration, mesh = max(heat.losses.oil_acceleration, 0.0), heat.losses.mesh
        parts = acceleration, heat.losses.windage, heat.losses.other
    if mesh is None:
        return TrainLosses(coupling, pumping, None, bearings, *parts, None, None)
    total = coupling + pumping + mesh + bearings + sum(part for part in parts if part is not None)
    power = inputs.mesh.distribution.load.transmitted_power
    return TrainLosses(coupling, pumping, mesh, bearings, *parts, total, 1 - total / power if power > total else None)


def force_balance(unit: Unit, equilibrium: Equilibrium, torques: tuple[float, float], force: float) -> ForceBalance:
    """Return the largest unbalanced force and the largest unbalanced moment on the two shafts.

    The forces on a shaft are added up in both planes. The moments are added up in both planes and about Z. In
    equilibrium all these sums are 0. `torques` [N m] drive the pinion and brake the wheel; `force` is F_bt [N]. In the
    result, the largest force is divided by F_bt, and the largest moment is divided by F_bt b.
    """
    if force == 0.0:
        return ForceBalance(None, None)
    states, width = unit.bearings(equilibrium.loads), unit.stations[-1]
    forces, moments = [], []
    for i, side in enumerate(unit.shafts):
        sums, turns = _sums(side, equilibrium.loads, [-state.load for state in states[2 * i : 2 * i + 2]])
        forces.append(np.abs(sums).max())
        moments.append(np.abs(turns).max())
        twisting = float((side.torques @ equilibrium.loads).sum())
        moments.append(abs(twisting + unit.frame.rotation * torques[i]))
    return ForceBalance(float(max(forces)) / force, float(max(moments)) / (force * width))


def _sums(side: ShaftPorts, loads: FloatArray, reactions: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the sums of forces and moments on a shaft in each plane; the moments are about the point Z = 0."""
    nodal = side.loads @ loads + side.fixed
    nodes = side.model.z.size
    sums = nodal[:, :nodes].sum(axis=1) + sum(reactions)
    turns = nodal[:, :nodes] @ side.model.z + nodal[:, nodes:].sum(axis=1)
    for bearing, reaction in zip(side.shaft.bearings, reactions, strict=True):
        turns = turns + reaction * bearing.position
    return sums, turns
