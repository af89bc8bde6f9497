"""Displacements of bearings under load.

Plain bearings have the film of their width or that of a short bearing (DuBois and Ocvirk, NACA 1157, 1953). Other
bearings are linear springs or rigid.
"""

from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.film.law import FilmLaw, eccentricity_at, film_at, film_law
from solvers.drive_train.film.table import LARGEST_ECCENTRICITY
from solvers.drive_train.inputs import Bearing, BearingFilm, JournalBearing, LinearBearing
from solvers.errors import NoSolution


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


def law_of(bearing: JournalBearing, film: BearingFilm) -> FilmLaw:
    """Return the film of a plain bearing: that of its width, or that of the short bearing."""
    return film_law(bearing.width / bearing.diameter if film == "finite" else 0.0)


def film_force(bearing: JournalBearing, speed: float, law: FilmLaw) -> float:
    """Force eta omega (D/2) L^3/(4 c^2) [N] of a load number of 1 at a speed [rad/s] (Eq. D4).

    A bearing wider than its film law has the same load per width as a bearing of that law.
    """
    reach = law.ratio * bearing.diameter if law.ratio > 0.0 else bearing.width
    return bearing.viscosity * speed * bearing.diameter / 2 * bearing.width * reach**2 / (4 * bearing.clearance**2)


def bearing_state(bearing: Bearing, load: FloatArray, speed: float, rotation: float, film: BearingFilm) -> BearingState:
    """Compute displacement and flexibility of a bearing under a load (Eq. D5).

    `rotation`: sense of rotation of the shaft, +1 if counter-clockwise about Z, else -1. Raises NoSolution: `journal`
    if the film would be thinner than a thousandth of the clearance.
    """
    if isinstance(bearing, JournalBearing):
        return _journal(bearing, load, speed, rotation, law_of(bearing, film))
    if isinstance(bearing, LinearBearing):
        flexibility = np.linalg.inv(np.array(bearing.stiffness))
        return BearingState(load, flexibility @ load, flexibility)
    return BearingState(load, np.zeros(2), np.zeros((2, 2)))


def _journal(bearing: JournalBearing, load: FloatArray, speed: float, rotation: float, law: FilmLaw) -> BearingState:
    clearance, scale = bearing.clearance, film_force(bearing, speed, law)
    force = hypot(load[0], load[1])
    eccentricity = _eccentricity(law, force / scale)
    film = film_at(law, eccentricity)
    turn = _turn(rotation * film.attitude)
    direction = load / force if force > 0.0 else np.array([1.0, 0.0])
    across = np.array([-direction[1], direction[0]])
    slope = 1.0 / (scale * film.load_slope)
    along_load = slope * (turn + eccentricity * rotation * film.attitude_slope * turn @ _turn(pi / 2)) @ direction
    secant = eccentricity / force if force > 0.0 else slope
    flexibility = clearance * (np.outer(along_load, direction) + secant * np.outer(turn @ across, across))
    return BearingState(
        load=load,
        displacement=clearance * eccentricity * turn @ direction,
        flexibility=flexibility,
        eccentricity_ratio=eccentricity,
        attitude=film.attitude,
        minimum_film=clearance * (1 - eccentricity),
        specific_pressure=force / (bearing.diameter * bearing.width),
        friction_power=_friction(bearing, speed, law, eccentricity),
    )


def _friction(bearing: JournalBearing, speed: float, law: FilmLaw, eccentricity: float) -> float:
    """Friction power of the journal [W] (Eq. D5): shear of the full ring, and the pressure on the inclined film."""
    film, radius = film_at(law, eccentricity), bearing.diameter / 2
    shear = 2 * pi / sqrt(1 - eccentricity**2)
    pressure = eccentricity / 2 * law.ratio**2 * film.load * sin(film.attitude)
    return bearing.viscosity * speed**2 * radius**3 * bearing.width / bearing.clearance * (shear + pressure)


def friction_and_leakage(bearing: JournalBearing, load: float, speed: float, film: BearingFilm) -> tuple[float, float]:
    """Return friction power [W] and side leakage [m^3/s] of a plain bearing under a load [N] at a speed [rad/s].

    Eq. D5 and H12. Raises NoSolution `journal` if the film would be thinner than a thousandth of the clearance.
    """
    law = law_of(bearing, film)
    eccentricity = _eccentricity(law, load / film_force(bearing, speed, law))
    couette = speed * bearing.diameter / 2 * bearing.width * bearing.clearance
    return _friction(bearing, speed, law, eccentricity), couette * film_at(law, eccentricity).side_flow


def _eccentricity(law: FilmLaw, load: float) -> float:
    """Return the eccentricity ratio at a load number."""
    if load > film_at(law, LARGEST_ECCENTRICITY).load:
        message = (
            "the film of a plain bearing cannot carry the load, because the film would be thinner than a thousandth "
            "of the clearance"
        )
        raise NoSolution("journal", message, {"load_number": load})
    return eccentricity_at(law, load)


def _turn(angle: float) -> FloatArray:
    """Return the matrix that rotates a vector by `angle` [rad]."""
    return np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
