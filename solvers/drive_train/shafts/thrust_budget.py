"""The axial forces on both shafts.

The axial force of the mesh is known; friction in a coupling causes one of known limit and unknown sign. API 613 (5th
ed., 2003) adds the magnitudes of both, and allows half the ultimate rating of the thrust bearing.
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
        text="axial force of mesh and pinion couplings on the collar; null without a collar",
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
    """Axial force sigma h F_bt tan beta_b of a single helix on the pinion, towards +Z [N] (Eq. D14; signs: `frame`)."""
    tangential = inputs.mesh.distribution.load.torque / path.pair.pinion.base_radius
    return float(tangential * directions.faces[0].force[2])


def thrust_budget(
    inputs: DriveTrainInputs,
    mesh: float,
    couplings: tuple[float, float],
    limits: tuple[float, float],
    diameters: tuple[float | None, float | None],
) -> tuple[Thrust, Thrust]:
    """Axial forces on the shafts of pinion and wheel, and the bounds of the loads on their thrust bearings (Eq. D14).

    For each shaft: `couplings` is the thrust of its couplings, `limits` the largest that their friction can cause [N],
    `diameters` its diameter at the coupling [m], None without one. `mesh` [N] acts on the pinion.
    """
    pinion, wheel = limits
    # A thrust collar passes the thrust of the pinion's couplings on to the wheel's thrust bearing.
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
    """Largest load on the thrust bearing over half its ultimate rating; None without a rating or a thrust bearing."""
    if lower is None or upper is None or ultimate is None:
        return None
    return max(abs(lower), abs(upper)) / (USABLE * ultimate)
