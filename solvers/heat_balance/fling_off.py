"""Fling-off cooling: the heat that an oil film takes from the teeth while the rotation throws it off (own derivation).

A jet lays a fresh film on the flanks once a turn. The centrifugal acceleration omega^2 r drives the film along the
tooth height H; it thins as h = min(h0, sqrt(nu x/(omega^2 r t))), while heat is conducted across it from an isothermal
wall to an adiabatic surface. Scaled by t* = sqrt(nu H/(a r))/omega and sqrt(a t*), the heat that a turn takes depends
on the film's thickness and on the duration of the turn only.
"""

from dataclasses import dataclass
from math import pi, sqrt

from solvers.heat_balance.oil import CoolingOil

TOOTH_HEIGHT = 2.25  # H over the normal module: addendum, dedendum and tip clearance of the basic rack
LONG_TURN = 0.98  # q of thick films and long turns, by similarity
FLOODED = 50.0  # scaled thickness above which a film cools no better
USED_SHARE = 0.9  # of the flooded heat; a turn can use the film that takes this share
LIMITED_FROM = 0.98  # chosen: of the oil's heat capacity; a higher conductance does not depend on the film
FILM_POWER, TIME_POWER = -5.5, -8.0  # of the closed form, fitted to the solved film (2.5 %)


@dataclass(frozen=True, slots=True)
class TurningTeeth:
    """The teeth of a rotating gear: area of both flanks of all teeth [m^2], height [m], radius [m], speed [rad/s]."""

    area: float
    height: float
    radius: float
    speed: float

    @property
    def turns(self) -> float:
        """Turns per second."""
        return self.speed / (2 * pi)


def turning_teeth(teeth: int, face_width: float, module: float, radius: float, speed: float) -> TurningTeeth:
    """Describe the flanks that a jet wets: both flanks of every tooth over the tooth height 2.25 m_n.

    Parameters
    ----------
    teeth : int
        Number of teeth.
    face_width : float
        Face width [m].
    module : float
        Normal module [m].
    radius : float
        Reference radius [m].
    speed : float
        Speed of the gear, positive [rad/s].

    Returns
    -------
    TurningTeeth
        Their area, height, radius and speed.

    Notes
    -----
    Eq. H1: A = 2 z b H, H = 2.25 m_n.
    """
    height = TOOTH_HEIGHT * module
    return TurningTeeth(2 * teeth * face_width * height, height, radius, speed)


def heat_number(film: float, turn: float) -> float:
    """Compute the heat that a film takes in one turn, over that of a film that reaches the wall's temperature.

    Parameters
    ----------
    film : float
        Thickness of the film as laid, over sqrt(a t*) [-].
    turn : float
        Duration of a turn over t* [-].

    Returns
    -------
    float
        Heat per area, kelvin and turn over sqrt(k rho c t*) [-].

    Notes
    -----
    Eq. H2. A thin film takes all that it can, q = h0'; after a short time the film is a half space, q = 2 sqrt(t'/pi);
    a thick film ends at 0.98, by similarity. The closed form joins the three within 2.5 % of the solved film.
    """
    short = 2 * sqrt(turn / pi)
    unlimited = short**TIME_POWER + LONG_TURN**TIME_POWER
    return float((film**FILM_POWER + unlimited ** (FILM_POWER / TIME_POWER)) ** (1 / FILM_POWER))


def fling_off_time(oil: CoolingOil, teeth: TurningTeeth, temperature: float) -> float:
    """Compute the time in which a film as thick as its thermal layer is thrown off.

    Parameters
    ----------
    oil : CoolingOil
        The oil.
    teeth : TurningTeeth
        The teeth.
    temperature : float
        Temperature of the film [K].

    Returns
    -------
    float
        Time t* [s].

    Notes
    -----
    Eq. H3: t* = sqrt(nu H/(a r))/omega.
    """
    viscosity = oil.viscosity(temperature) / oil.density
    return sqrt(viscosity * teeth.height / (oil.diffusivity * teeth.radius)) / teeth.speed


def laid_film(teeth: TurningTeeth, flow: float) -> float:
    """Compute the thickness of the film that the jets lay on the flanks in one turn.

    Parameters
    ----------
    teeth : TurningTeeth
        The teeth.
    flow : float
        Oil that wets the flanks [m^3/s].

    Returns
    -------
    float
        Thickness h0 [m].

    Notes
    -----
    Eq. H4: h0 = Q_i/(A_i omega/2 pi).
    """
    return flow / (teeth.area * teeth.turns)


@dataclass(frozen=True, slots=True)
class FlingOff:
    """Cooling of one gear by its film: conductances [W/K] of the film as laid and of a film that floods the flank.

    `film` is the thickness that the jets lay per turn, and `turn_film` the thickness that can take heat in a turn [m].
    `limited` is true if the heat capacity of the oil limits the conductance.
    """

    conductance: float
    flooded: float
    film: float
    turn_film: float
    limited: bool


def fling_off(oil: CoolingOil, teeth: TurningTeeth, flow: float, factor: float, flank: float) -> FlingOff:
    """Compute how well the film cools both flanks of a gear.

    Parameters
    ----------
    oil : CoolingOil
        The oil; its viscosity is taken at the mean of flank and supply temperature.
    teeth : TurningTeeth
        The teeth.
    flow : float
        Oil that wets the flanks of this gear [m^3/s].
    factor : float
        Factor on the conductance of the film [-].
    flank : float
        Temperature of the flank [K].

    Returns
    -------
    FlingOff
        Conductances from both flanks to the oil, at most the heat capacity of the flow, and thicknesses of the film.

    Notes
    -----
    Eq. H5: G = f omega/(2 pi) A sqrt(k rho c t*) q(h0', t'), G <= rho c Q_i; flooded: h0' = 50.
    """
    time = fling_off_time(oil, teeth, (flank + oil.inlet) / 2)
    length, turn = sqrt(oil.diffusivity * time), 1 / (teeth.turns * time)
    scale = factor * teeth.turns * teeth.area * sqrt(oil.thermal_conductivity * oil.heat_capacity * time)
    film, flooded, capacity = laid_film(teeth, flow), heat_number(FLOODED, turn), oil.heat_capacity * flow
    cooling = scale * heat_number(film / length, turn) if film > 0.0 else 0.0
    return FlingOff(
        conductance=min(cooling, capacity),
        flooded=scale * flooded,
        film=film,
        turn_film=length * _thickness_of(USED_SHARE * flooded, turn),
        limited=cooling >= LIMITED_FROM * capacity,
    )


def _thickness_of(heat: float, turn: float) -> float:
    """Return the scaled thickness at which a film takes `heat`; inverse of `heat_number`."""
    unlimited = (2 * sqrt(turn / pi)) ** TIME_POWER + LONG_TURN**TIME_POWER
    return float((heat**FILM_POWER - unlimited ** (FILM_POWER / TIME_POWER)) ** (1 / FILM_POWER))
