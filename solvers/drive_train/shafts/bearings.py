"""Displacements of bearings under load.

Plain bearings have the film of a short bearing (DuBois and Ocvirk, NACA 1157, 1953). Other bearings are linear springs
or rigid.
"""

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.drive_train.inputs import Bearing, JournalBearing, LinearBearing
from solvers.errors import NoSolution

LARGEST_ECCENTRICITY = 0.999  # chosen: the film is then a thousandth of the clearance, thinner than any roughness


@dataclass(frozen=True, slots=True)
class BearingState:
    """A loaded bearing.

    `displacement` [m] is the displacement of the shaft without the offset of the bore. `flexibility` [m/N] is the
    derivative of the displacement with respect to the load.

    The next four values describe a plain bearing: eccentricity ratio [-], attitude angle between load and displacement
    [rad], minimum film thickness [m], and load per projected area [Pa]. If the bearing is not a plain bearing, these
    four values are None, and `friction_power` [W] is 0.
    """

    load: FloatArray
    displacement: FloatArray
    flexibility: FloatArray
    eccentricity_ratio: float | None = None
    attitude: float | None = None
    minimum_film: float | None = None
    specific_pressure: float | None = None
    friction_power: float = 0.0


@kernel
def load_number(eccentricity: float) -> float:
    """Compute the dimensionless load of a short bearing.

    Parameters
    ----------
    eccentricity : float
        Eccentricity ratio [-].

    Returns
    -------
    float
        Load divided by eta omega (D/2) L^3 / (4 c^2) [-].

    Notes
    -----
    Eq. D4, for a film that covers only the half of the circumference in which the pressure is positive.
    """
    square = eccentricity**2
    return eccentricity / (1 - square) ** 2 * sqrt(pi**2 * (1 - square) + 16 * square)


def attitude_angle(eccentricity: float) -> float:
    """Compute the angle from the load to the displacement, in the sense of rotation.

    Parameters
    ----------
    eccentricity : float
        Eccentricity ratio e [-].

    Returns
    -------
    float
        Attitude angle phi [rad], with tan phi = pi sqrt(1 - e^2) / (4 e).

    Notes
    -----
    Eq. D5.
    """
    return atan2(pi * sqrt(1 - eccentricity**2), 4 * eccentricity)


def film_force(bearing: JournalBearing, speed: float) -> float:
    """Compute the reference force for the dimensionless load of a short bearing.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    speed : float
        Angular speed of the shaft [rad/s].

    Returns
    -------
    float
        Reference force eta omega (D/2) L^3 / (4 c^2) [N].

    Notes
    -----
    Eq. D4.
    """
    return bearing.viscosity * speed * bearing.diameter / 2 * bearing.width**3 / (4 * bearing.clearance**2)


def bearing_state(bearing: Bearing, load: FloatArray, speed: float, rotation: float) -> BearingState:
    """Compute displacement and flexibility of a bearing under a load.

    Parameters
    ----------
    bearing : JournalBearing, LinearBearing or RigidBearing
        The bearing.
    load : FloatArray of shape (2,)
        Load (X, Y) on the bearing [N].
    speed : float
        Angular speed of the shaft [rad/s].
    rotation : float
        Sense of rotation of the shaft, +1 if counter-clockwise about Z, else -1.

    Returns
    -------
    BearingState
        The loaded bearing.

    Raises
    ------
    NoSolution
        `journal` if the film would be thinner than a thousandth of the clearance.

    Notes
    -----
    Eq. D5.
    """
    if isinstance(bearing, JournalBearing):
        return _journal(bearing, load, speed, rotation)
    if isinstance(bearing, LinearBearing):
        flexibility = np.linalg.inv(np.array(bearing.stiffness))
        return BearingState(load, flexibility @ load, flexibility)
    return BearingState(load, np.zeros(2), np.zeros((2, 2)))


def _journal(bearing: JournalBearing, load: FloatArray, speed: float, rotation: float) -> BearingState:
    clearance, scale = bearing.clearance, film_force(bearing, speed)
    force = hypot(load[0], load[1])
    eccentricity = _eccentricity(force / scale)
    attitude = attitude_angle(eccentricity)
    turn = _turn(rotation * attitude)
    direction = load / force if force > 0.0 else np.array([1.0, 0.0])
    across = np.array([-direction[1], direction[0]])
    slope, swing = 1.0 / (scale * _load_slope(eccentricity)), _attitude_slope(eccentricity)
    along_load = slope * (turn + eccentricity * rotation * swing * turn @ _turn(pi / 2)) @ direction
    secant = eccentricity / force if force > 0.0 else slope
    flexibility = clearance * (np.outer(along_load, direction) + secant * np.outer(turn @ across, across))
    return BearingState(
        load=load,
        displacement=clearance * eccentricity * turn @ direction,
        flexibility=flexibility,
        eccentricity_ratio=eccentricity,
        attitude=attitude,
        minimum_film=clearance * (1 - eccentricity),
        specific_pressure=force / (bearing.diameter * bearing.width),
        friction_power=_friction(bearing, speed, eccentricity),
    )


def _friction(bearing: JournalBearing, speed: float, eccentricity: float) -> float:
    """Return the friction power [W], which is the power of the concentric bearing divided by sqrt(1 - e^2)."""
    concentric = 2 * pi * bearing.viscosity * speed**2 * (bearing.diameter / 2) ** 3 * bearing.width
    return concentric / (bearing.clearance * sqrt(1 - eccentricity**2))


def friction_and_eccentricity(bearing: JournalBearing, load: float, speed: float) -> tuple[float, float]:
    """Compute friction power [W] and eccentricity ratio of a plain bearing under a load [N] at a speed [rad/s].

    Raises NoSolution `journal` if the film would be thinner than a thousandth of the clearance.
    """
    eccentricity = _eccentricity(load / film_force(bearing, speed))
    return _friction(bearing, speed, eccentricity), eccentricity


def _eccentricity(load: float) -> float:
    """Return the eccentricity ratio at a load number."""
    if load > load_number(LARGEST_ECCENTRICITY):
        message = (
            "the film of a plain bearing cannot carry the load, because the film would be thinner than a thousandth "
            "of the clearance"
        )
        raise NoSolution("journal", message, {"load_number": load})
    return _invert_load_number(load)


@kernel
def _invert_load_number(load: float) -> float:
    """Return the eccentricity ratio at a load number, by Newton's iteration from the largest eccentricity ratio.

    The load number is a convex function of the eccentricity ratio. Newton's steps therefore decrease the ratio until
    rounding ends the iteration.
    """
    eccentricity, before = LARGEST_ECCENTRICITY, 1.0
    while eccentricity < before:
        before = eccentricity
        eccentricity -= (load_number(eccentricity) - load) / _load_slope(eccentricity)
    return max(eccentricity, 0.0)


@kernel
def _load_slope(eccentricity: float) -> float:
    """Return the derivative of `load_number`."""
    rest, root = 1 - eccentricity**2, sqrt(pi**2 * (1 - eccentricity**2) + 16 * eccentricity**2)
    return root / rest**2 + 4 * eccentricity**2 * root / rest**3 + eccentricity**2 * (16 - pi**2) / (rest**2 * root)


def _attitude_slope(eccentricity: float) -> float:
    """Return the derivative of `attitude_angle`."""
    rest = 1 - eccentricity**2
    return -4 * pi / (sqrt(rest) * (pi**2 * rest + 16 * eccentricity**2))


def _turn(angle: float) -> FloatArray:
    """Return the matrix that rotates a vector by `angle` [rad]."""
    return np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
