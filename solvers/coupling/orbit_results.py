"""What one revolution of a floating sleeve answers, in SI: lengths [m], angles [rad], forces [N], arrays read-only."""

from solvers.arrays import FloatArray
from solvers.coupling.results import Geometry
from solvers.notices import Notice
from solvers.quantity import quantity, record
from solvers.sources import PAHL


@record
class Orbit:
    """Path of the sleeve centre against the hub over one revolution."""

    rotor_angle: FloatArray = quantity("rotor angle", "θ", unit="deg")
    x: FloatArray = quantity("sleeve displacement in the pivot direction", "e_x", unit="um", axis="rotor_angle")
    y: FloatArray = quantity("sleeve displacement along the tilt axis", "e_y", unit="um", axis="rotor_angle")


@record
class InertiaForce:
    """Inertia force of the sleeve mass of one mesh over the orbit's rotor angles; harmonics are amplitudes 2 |c_k|.

    Order 0 comes first and is the magnitude of the mean.
    """

    x: FloatArray = quantity(
        "inertia force in the pivot direction",
        "F_x",
        f"{PAHL}, Fig. 5",
        unit="n",
        detail="curves",
        axis="orbit.rotor_angle_deg",
    )
    y: FloatArray = quantity(
        "inertia force along the tilt axis",
        "F_y",
        f"{PAHL}, Fig. 5",
        unit="n",
        detail="curves",
        axis="orbit.rotor_angle_deg",
    )
    harmonics_x: FloatArray = quantity(
        "harmonics of the force in the pivot direction",
        "F_x,k",
        f"{PAHL}, Fig. 5",
        unit="n",
        text="amplitudes from order 0 up",
        index="order from 0",
    )
    harmonics_y: FloatArray = quantity(
        "harmonics of the force along the tilt axis",
        "F_y,k",
        f"{PAHL}, Fig. 5",
        unit="n",
        text="amplitudes from order 0 up",
        index="order from 0",
    )


@record
class OrbitResult:
    """One revolution of a floating sleeve under its own inertia.

    `sweeps` over the revolution until it repeated to `change` [m]. The uncertainties are how far the largest
    displacement [m] and any harmonic of the force [N] move with two or three times the rotor angles and twice the
    orders; None where such a path does not settle. `derived` is the tooth that moves.
    """

    orbit: Orbit = quantity("path of the sleeve centre", detail="curves")
    inertia_force: InertiaForce = quantity("inertia force")
    max_displacement: float = quantity("largest displacement", "e_max", unit="um")
    displacement_uncertainty: float | None = quantity(
        "uncertainty of the displacement",
        "Δe_max",
        unit="um",
        text="change of the largest displacement with more rotor angles and orders",
    )
    harmonics_uncertainty: float | None = quantity(
        "uncertainty of the harmonics",
        "ΔF_k",
        unit="n",
        text="largest change of a harmonic with more rotor angles and orders",
    )
    sweeps: int = quantity("sweeps", text="sweeps over the revolution until it repeated")
    change: float = quantity(
        "change in the last sweep", "Δe", unit="um", text="how far the last sweep still moved the path"
    )
    derived: Geometry = quantity("radius used")
    warnings: tuple[Notice, ...]
