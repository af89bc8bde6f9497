"""The axial forces on both shafts: the mesh's is known, a coupling's friction has a limit but no known sign.

API 613 (5th ed., 2003) adds the coupling's force numerically and loads a thrust bearing to half its ultimate rating.
"""

from dataclasses import dataclass

from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.shafts.frame import Frame
from solvers.gears.pair import PathOfContact

USABLE = 0.5  # of the ultimate rating


@dataclass(frozen=True, slots=True)
class Thrust:
    """Of one shaft, towards +Z [N]: mesh, its couplings, their friction's limit, bounds of the thrust bearing's load.

    `coupling` is the stated part of the limit, `collar` the force on this shaft that holds mesh and couplings of the
    pinion, None without a collar. Bounds are None where a collar stands in for the bearing. `use` is the largest load
    over half the ultimate rating. `customary` is 0.25 T / D, the rule of thumb for couplings.
    """

    mesh: float
    coupling: float
    coupling_limit: float
    collar: float | None
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


def thrust_budget(
    inputs: DriveTrainInputs,
    mesh: float,
    couplings: tuple[float, float],
    limits: tuple[float, float],
    diameters: tuple[float | None, float | None],
) -> tuple[Thrust, Thrust]:
    """Bounds of both shafts' thrust; `mesh` on the pinion, thrust and limits of the couplings of each shaft [N].

    `diameters` [m] of the shafts at their couplings. A collar hands the pinion's couplings on to the wheel's bearing.
    """
    pinion, wheel = limits
    collared = inputs.collar_radius is not None
    load = inputs.mesh.distribution
    ratio = load.gears.wheel.teeth / load.gears.pinion.teeth
    torques = (load.load.pinion_torque, load.load.pinion_torque * ratio)
    bounds = (
        ((None, None), (-pinion - wheel, pinion + wheel))
        if collared
        else (
            (mesh - pinion, mesh + pinion),
            (-mesh - wheel, -mesh + wheel),
        )
    )
    thrusts = [
        Thrust(
            mesh=sign * mesh,
            coupling=couplings[i],
            coupling_limit=limits[i],
            collar=-sign * (mesh + couplings[0]) if collared else None,
            lower=lower,
            upper=upper,
            use=_use(lower, upper, inputs.shafts[i].ultimate_thrust),
            customary=None if (diameter := diameters[i]) is None else 0.25 * torques[i] / diameter,
        )
        for i, (sign, (lower, upper)) in enumerate(zip((1.0, -1.0), bounds, strict=True))
    ]
    return thrusts[0], thrusts[1]


def _use(lower: float | None, upper: float | None, ultimate: float | None) -> float | None:
    """Largest load over the usable half of the rating; None without one, or without a bearing."""
    if lower is None or upper is None or ultimate is None:
        return None
    return max(abs(lower), abs(upper)) / (USABLE * ultimate)
