"""What one revolution of a floating sleeve answers, in SI: lengths [m], angles [rad], forces [N], arrays read-only."""

from dataclasses import dataclass

from solvers.arrays import FloatArray
from solvers.coupling.results import Geometry
from solvers.notices import Notice


@dataclass(frozen=True, slots=True)
class Orbit:
    """Path of the sleeve centre against the hub over one revolution."""

    rotor_angle: FloatArray
    x: FloatArray
    y: FloatArray


@dataclass(frozen=True, slots=True)
class InertiaForce:
    """Inertia force of the sleeve mass of one mesh over the orbit's rotor angles; harmonics are amplitudes 2 |c_k|.

    Order 0 comes first and is the magnitude of the mean.
    """

    x: FloatArray
    y: FloatArray
    harmonics_x: FloatArray
    harmonics_y: FloatArray


@dataclass(frozen=True, slots=True)
class OrbitResult:
    """One revolution of a floating sleeve under its own inertia.

    `sweeps` over the revolution until it repeated to `change` [m]. The uncertainties are how far the largest
    displacement [m] and any harmonic of the force [N] move with two or three times the rotor angles and twice the
    orders; None where such a path does not settle. `derived` is the tooth that moves.
    """

    orbit: Orbit
    inertia_force: InertiaForce
    max_displacement: float
    displacement_uncertainty: float | None
    harmonics_uncertainty: float | None
    sweeps: int
    change: float
    derived: Geometry
    warnings: tuple[Notice, ...]
