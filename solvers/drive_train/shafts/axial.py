"""The split of a double-helical pair's load over its helices, by the axial balance of the shaft that floats.

One shaft floats: nothing but the mesh holds it along Z. External forces and the friction of its couplings therefore
load one helix more than the other, whatever the stiffnesses. Neglected are the friction of the mesh, which slides along
the profile at many times the axial speed, the shear of the oil in plain bearings, and the inertia of the shaft.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import DriveTrainInputs, floating_shaft
from solvers.drive_train.shafts.coupling_loads import LOADS, CouplingPort
from solvers.drive_train.shafts.frame import Frame
from solvers.errors import NoSolution

LEAST_SHARE = 1e-9  # of a helix while the iteration runs; at the end such a share means that the helix lifts off


@dataclass(frozen=True, slots=True)
class AxialSplit:
    """The floating shaft of a double-helical unit and the axial forces on it."""

    shaft: int  # 0 pinion, 1 wheel
    lever: float  # axial part of the mesh force of helix 1 on the shaft over the transverse force, towards +Z
    external: float  # axial force from outside, without the couplings, N
    thrusts: tuple[int, ...]  # where the thrusts of the shaft's couplings stand among the loads of the hubs

    def force(self, hub_loads: FloatArray) -> float:
        """Return the axial force on the floating shaft, external and of its couplings, towards +Z [N]."""
        return self.external + float(sum(hub_loads[place] for place in self.thrusts))

    def difference(self, force: float, transmitted: float) -> float:
        """Difference q of the shares of helix 1 and 2 under an axial force, q = -F_ext/(F_bt d_Z) (Eq. D20)."""
        if force == 0.0:
            return 0.0
        return -force / (transmitted * self.lever) if transmitted > 0.0 else float(np.copysign(np.inf, -force))

    def shares(self, hub_loads: FloatArray, transmitted: float) -> FloatArray:
        """Return the shares of the helices, of which none is below `LEAST_SHARE`."""
        most = 1.0 - 2.0 * LEAST_SHARE
        split = min(max(self.difference(self.force(hub_loads), transmitted), -most), most)
        return np.array([(1.0 + split) / 2, (1.0 - split) / 2])

    def check(self, hub_loads: FloatArray, transmitted: float) -> None:
        """Raise NoSolution `helix_unloaded` if a helix lifts off."""
        force, limit = self.force(hub_loads), self.unloading_force(transmitted)
        if abs(force) < (1.0 - 2.0 * LEAST_SHARE) * limit or force == 0.0:
            return
        message = (
            f"axial force of {abs(force) / 1e3:.4g} kN on the floating shaft; one helix lifts off at "
            f"{limit / 1e3:.4g} kN: lower the friction of the coupling or its share along the shaft, or the external "
            "axial force, or raise the torque or the helix angle"
        )
        thrust = max(self.thrusts, key=lambda place: abs(hub_loads[place]), default=None)
        by_coupling = thrust is not None and abs(hub_loads[thrust]) > abs(self.external)
        field = f"couplings.{thrust // LOADS}.thrust_fraction" if by_coupling and thrust is not None else "axial_force"
        raise NoSolution("helix_unloaded", message, {"axial_force_n": force, "unloading_force_n": limit}, field)

    def unloading_force(self, transmitted: float) -> float:
        """Return the axial force at which one helix lifts off, F_bt tan beta_b [N]."""
        return transmitted * abs(self.lever)


def axial_split(inputs: DriveTrainInputs, directions: Frame, couplings: tuple[CouplingPort, ...]) -> AxialSplit | None:
    """Return the axial balance of a double-helical unit; None for a single helix."""
    if len(directions.faces) == 1:
        return None
    name = floating_shaft(inputs)
    shaft = 0 if name == "pinion" else 1
    return AxialSplit(
        shaft=shaft,
        lever=(1.0, -1.0)[shaft] * float(directions.faces[0].force[2]),
        external=inputs.mesh.distribution.load.axial_force,
        thrusts=tuple(LOADS * k + LOADS - 1 for k, port in enumerate(couplings) if port.inputs.shaft == name),
    )
