"""The axial forces on both shafts.

The axial force of the mesh is known. The axial force that friction causes in a coupling has a known limit, but an
unknown sign. API 613 (5th ed., 2003) adds the magnitudes of both forces. According to API 613, the load on the thrust
bearing must not exceed half the ultimate rating of the bearing.
"""

from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.shafts.axial import AxialSplit
from solvers.drive_train.shafts.frame import Frame
from solvers.gears.pair import PathOfContact
from solvers.quantity import computed, quantity, record
from solvers.sources import API_613

USABLE = 0.5  # usable share of the ultimate rating


@record(equation="D14")
class Thrust:
    """Axial forces on one shaft, positive towards +Z, and the bounds of the load on the thrust bearing.

    The bounds are None if a thrust collar replaces the bearing, or if the shaft of a double-helical unit floats.
    `customary` is the thrust of a coupling by a rule of thumb.
    """

    mesh: float = quantity("axial force of the mesh", "F_a", unit="n")
    coupling: float = quantity(
        "thrust of the couplings",
        "τ F_max",
        unit="n",
        text="the stated share of the friction limit of all couplings",
        equation="D7",
    )
    coupling_limit: float = quantity(
        "limit of the coupling's thrust", "F_max", unit="n", text="of all couplings of the shaft", equation="C20"
    )
    collar: float | None = quantity(
        "force of the thrust collar",
        "F_k",
        unit="n",
        text=("axial force of mesh and pinion couplings on the collar; null without a collar"),
    )
    lower: float | None = quantity(
        "least bearing thrust", "F_ax,min", API_613, unit="n", text="null where a collar or the mesh holds the shaft"
    )
    upper: float | None = quantity(
        "largest bearing thrust", "F_ax,max", API_613, unit="n", text="null where a collar or the mesh holds the shaft"
    )
    use: float | None = quantity(
        "use of the thrust bearing",
        "F/(0.5 F_ult)",
        API_613,
        text="largest load over half the ultimate load; null without an ultimate load",
    )
    customary: float | None = quantity(
        "customary thrust of a coupling",
        "0.25 T/D",
        "API 671/617 practice, quoted, not verified against the standard",
        unit="n",
        text="null without a coupling",
    )

    @property
    @computed("thrust reversal", text="whether the coupling's friction can reverse the bearing's load")
    def reverses(self) -> bool:
        """Whether the coupling's friction can reverse the load of the thrust bearing."""
        return self.lower is not None and self.upper is not None and self.lower < 0.0 < self.upper


def mesh_thrust(inputs: DriveTrainInputs, path: PathOfContact, directions: Frame) -> float:
    """Compute the axial force of the mesh on the pinion of a single-helical unit.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit.
    path : PathOfContact
        Path of contact of the gear pair of the unit.
    directions : Frame
        The unit's frame of reference.

    Returns
    -------
    float
        Axial force sigma h F_bt tan beta_b, positive towards +Z [N].

    Notes
    -----
    Eq. D14. Here sigma is the sense of rotation of the pinion, h is +1 for a right-hand pinion and -1 for a left-hand
    pinion, F_bt is the transverse force, and beta_b is the base helix angle.
    """
    tangential = inputs.mesh.distribution.load.torque / path.pair.pinion.base_radius
    return float(tangential * directions.faces[0].force[2])


def thrust_budget(
    inputs: DriveTrainInputs,
    mesh: float,
    couplings: tuple[float, float],
    limits: tuple[float, float],
    diameters: tuple[float | None, float | None],
) -> tuple[Thrust, Thrust]:
    """Compute the axial forces on both shafts and the bounds of the load on each thrust bearing.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit.
    mesh : float
        Axial force of the mesh on the pinion [N].
    couplings : tuple of float
        Thrust of the couplings on the pinion's shaft, and thrust of the couplings on the wheel's shaft [N].
    limits : tuple of float
        Largest thrust on each shaft that the friction in the couplings of this shaft can cause [N].
    diameters : tuple of float or None
        Diameter of each shaft at the coupling [m]; None for a shaft without a coupling.

    Returns
    -------
    tuple of Thrust
        Axial forces on the shafts of pinion and wheel [N].

    Notes
    -----
    Eq. D14. A thrust collar transfers the thrust of the pinion's couplings to the wheel's thrust bearing.
    """
    pinion, wheel = limits
    bounds: tuple[_Bounds, _Bounds] = (
        ((None, None), (-pinion - wheel, pinion + wheel))
        if inputs.collar_radius is not None
        else (
            (mesh - pinion, mesh + pinion),
            (-mesh - wheel, -mesh + wheel),
        )
    )
    return _thrusts(inputs, (mesh, -mesh), couplings, limits, diameters, bounds)


def split_thrust_budget(
    inputs: DriveTrainInputs,
    split: AxialSplit,
    force: float,
    couplings: tuple[float, float],
    limits: tuple[float, float],
    diameters: tuple[float | None, float | None],
) -> tuple[Thrust, Thrust]:
    """Return the axial forces on the shafts of a double-helical unit (Eq. D23); the parameters of `thrust_budget`.

    `force` [N] is the axial force on the floating shaft, which the mesh passes on to the other shaft's thrust bearing.
    """
    floating = split.shaft
    mesh = (0.0 - force, force) if floating == 0 else (force, 0.0 - force)  # 0 - 0 is 0, -0 is not
    held = (split.external - sum(limits), split.external + sum(limits))
    bounds = ((None, None), held) if floating == 0 else (held, (None, None))
    return _thrusts(inputs, mesh, couplings, limits, diameters, bounds)


_Bounds = tuple[float, float] | tuple[None, None]


def _thrusts(
    inputs: DriveTrainInputs,
    mesh: tuple[float, float],
    couplings: tuple[float, float],
    limits: tuple[float, float],
    diameters: tuple[float | None, float | None],
    bounds: tuple[_Bounds, _Bounds],
) -> tuple[Thrust, Thrust]:
    load, collared = inputs.mesh.distribution, inputs.collar_radius is not None
    ratio = load.gears.wheel.teeth / load.gears.pinion.teeth
    torques = (load.load.torque, load.load.torque * ratio)
    thrusts = [
        Thrust(
            mesh=mesh[i],
            coupling=couplings[i],
            coupling_limit=limits[i],
            collar=-sign * (mesh[0] + couplings[0]) if collared else None,
            lower=lower,
            upper=upper,
            use=_use(lower, upper, inputs.shafts[i].ultimate_thrust),
            customary=None if (diameter := diameters[i]) is None else 0.25 * torques[i] / diameter,
        )
        for i, (sign, (lower, upper)) in enumerate(zip((1.0, -1.0), bounds, strict=True))
    ]
    return thrusts[0], thrusts[1]


def _use(lower: float | None, upper: float | None, ultimate: float | None) -> float | None:
    """Return the largest load on the thrust bearing divided by the permissible load of the bearing.

    The permissible load is half of the ultimate rating `ultimate`. Return None if the rating is not given or if there
    is no thrust bearing.
    """
    if lower is None or upper is None or ultimate is None:
        return None
    return max(abs(lower), abs(upper)) / (USABLE * ultimate)
