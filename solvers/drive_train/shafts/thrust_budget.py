"""The axial forces on both shafts: the mesh's is known, a coupling's friction has a limit but no known sign.

API 613 (5th ed., 2003) adds the coupling's force numerically and loads a thrust bearing to half its ultimate rating.
"""

from dataclasses import dataclass

from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.shafts.coupling_loads import CouplingPort, hub_moments
from solvers.drive_train.shafts.frame import Frame
from solvers.gears.path_of_contact import PathOfContact

USABLE = 0.5  # of the ultimate rating
SMALL_TILT = 1e-6  # rad, where a limit is wanted before the tilts are known


@dataclass(frozen=True, slots=True)
class Thrust:
    """Of one shaft, towards +Z [N]: mesh, the limit of its couplings' friction, bounds of the thrust bearing's load.

    Bounds are None where a collar stands in for the bearing. `use` is the largest load over half the ultimate rating.
    `customary` is 0.25 T / D, the rule of thumb for couplings.
    """

    mesh: float
    coupling_limit: float
    lower: float | None
    upper: float | None
    use: float | None
    customary: float | None

    @property
    def reverses(self) -> bool:
        """Whether friction may turn the load of the bearing round."""
        return self.lower is not None and self.upper is not None and self.lower < 0.0 < self.upper


def mesh_thrust(inputs: DriveTrainInputs, path: PathOfContact, directions: Frame) -> float:
    """Axial force of the mesh on the pinion towards +Z, sigma h F_bt tan beta_b [N]."""
    tangential = inputs.mesh.distribution.load.pinion_torque / path.pair.pinion.base_radius
    return float(tangential * directions.force[2])


def collar_force(
    inputs: DriveTrainInputs, path: PathOfContact, directions: Frame, couplings: tuple[CouplingPort, ...]
) -> float:
    """Axial force of the collar on the pinion [N]: it holds what mesh and couplings push; 0 without one."""
    if inputs.collar_radius is None:
        return 0.0
    pushed = sum(
        port.inputs.thrust_fraction * hub_moments(port, SMALL_TILT).thrust_limit
        for port in couplings
        if port.inputs.shaft == "pinion" and port.torque > 0.0
    )
    return -(mesh_thrust(inputs, path, directions) + pushed)


def thrust_budget(
    inputs: DriveTrainInputs, mesh: float, limits: tuple[float, float], diameters: tuple[float | None, float | None]
) -> tuple[Thrust, Thrust]:
    """Bounds of both shafts' thrust; `mesh` on the pinion, `limits` of the couplings of each shaft [N].

    `diameters` [m] of the shafts at their couplings. A collar hands the pinion's couplings on to the wheel's bearing.
    """
    pinion, wheel = limits
    collared = inputs.collar_radius is not None
    load = inputs.mesh.distribution
    ratio = load.gears.wheel.teeth / load.gears.pinion.teeth
    torques = (load.load.pinion_torque, load.load.pinion_torque * ratio)
    customary = [
        None if diameter is None else 0.25 * torque / diameter
        for torque, diameter in zip(torques, diameters, strict=True)
    ]
    if collared:
        own = Thrust(mesh, pinion, None, None, None, customary[0])
        both = pinion + wheel
        return own, Thrust(
            -mesh, wheel, -both, both, _use(-both, both, inputs.wheel_shaft.ultimate_thrust), customary[1]
        )
    return (
        Thrust(
            mesh,
            pinion,
            mesh - pinion,
            mesh + pinion,
            _use(mesh - pinion, mesh + pinion, inputs.pinion_shaft.ultimate_thrust),
            customary[0],
        ),
        Thrust(
            -mesh,
            wheel,
            -mesh - wheel,
            -mesh + wheel,
            _use(-mesh - wheel, -mesh + wheel, inputs.wheel_shaft.ultimate_thrust),
            customary[1],
        ),
    )


def _use(lower: float, upper: float, ultimate: float | None) -> float | None:
    """Largest load over the usable half of the rating; None without one."""
    return None if ultimate is None else max(abs(lower), abs(upper)) / (USABLE * ultimate)
