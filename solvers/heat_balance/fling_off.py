"""Fling-off cooling: an oil film takes heat from the teeth while the rotation throws the film off (own derivation).

A jet lays a fresh film of thickness h0 on the flanks once per turn. The centrifugal acceleration omega^2 r drives the
film along the tooth height H. The thickness of the film decreases as h = min(h0, sqrt(nu x/(omega^2 r t))). Meanwhile
heat is conducted through the film, from an isothermal wall to an adiabatic free surface. All times are divided by
t* = sqrt(nu H/(a r))/omega, and all thicknesses are divided by sqrt(a t*). The scaled heat per turn then depends on two
numbers only: the scaled thickness of the fresh film, and the scaled duration of the turn.

The oil has the kinematic viscosity nu and the thermal diffusivity a. The gear has the speed omega and the radius r.
The distance along the tooth height is x, and the time since the jet is t.
"""

from dataclasses import dataclass
from math import pi, sqrt

from solvers.heat_balance.oil import CoolingOil

TOOTH_HEIGHT = 2.25  # H in normal modules: addendum 1.0 plus dedendum 1.25 of the basic rack
LONG_TURN = 0.98  # heat number q of a thick film in a long turn, from a similarity solution
FLOODED = 50.0  # scaled thickness; a thicker film does not cool better
USED_SHARE = 0.9  # share of the heat of a flooded flank; `turn_film` is the thickness of a film that takes this share
LIMITED_FROM = 0.98  # chosen: share of the oil's heat capacity above which the oil flow limits the cooling
FILM_POWER, TIME_POWER = -5.5, -8.0  # exponents of the closed form, fitted to numerical solutions within 2.5 %


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
    """Describe the flanks that a jet wets: both flanks of every tooth, over the whole tooth height of 2.25 m_n.

    Eq. H1: A = 2 z b H, H = 2.25 m_n. `speed`: speed of the gear, positive [rad/s].
    """
    height = TOOTH_HEIGHT * module
    return TurningTeeth(2 * teeth * face_width * height, height, radius, speed)


def heat_number(film: float, turn: float) -> float:
    """Compute the dimensionless heat that a film takes from the flank in one turn [-] (Eq. H2).

    Here h0' is `film` and t' is `turn`. There are three limiting cases. A thin film reaches the temperature of the
    wall: q = h0'. In a short turn the film acts as a half space: q = 2 sqrt(t'/pi). For a thick film and a long turn a
    similarity solution gives q = 0.98. The closed form joins these three limiting cases, and agrees with numerical
    solutions within 2.5 %. Returns heat per area, kelvin and turn, divided by sqrt(k rho c t*) [-].
    """
    short = 2 * sqrt(turn / pi)
    unlimited = short**TIME_POWER + LONG_TURN**TIME_POWER
    return float((film**FILM_POWER + unlimited ** (FILM_POWER / TIME_POWER)) ** (1 / FILM_POWER))


def fling_off_time(oil: CoolingOil, teeth: TurningTeeth, temperature: float) -> float:
    """Compute the time t* after which the heat of the flank has passed through the whole film [s].

    Eq. H3: t* = sqrt(nu H/(a r))/omega. At the time t*, the rotation has thinned the film at x = H to the thickness
    sqrt(a t*). By this time, the heat of the flank has reached a layer of the same thickness.
    """
    viscosity = oil.viscosity(temperature) / oil.density
    return sqrt(viscosity * teeth.height / (oil.diffusivity * teeth.radius)) / teeth.speed


def laid_film(teeth: TurningTeeth, flow: float) -> float:
    """Compute the thickness of the film that the jets lay on the flanks in one turn [m].

    Eq. H4: h0 = Q_i/(A_i omega/2 pi).
    """
    return flow / (teeth.area * teeth.turns)


@dataclass(frozen=True, slots=True)
class FlingOff:
    """Cooling of one gear by its oil film.

    `film` [m] is the thickness of the film that the jets lay in one turn, and `conductance` [W/K] is the conductance of
    this film. `flooded` [W/K] is the conductance of a film so thick that more oil would not take more heat. `turn_film`
    [m] is the thickness of a film whose conductance is 90 % of `flooded`. `limited` is true if `conductance` is at
    least 98 % of the heat capacity of the oil flow; `conductance` cannot exceed this heat capacity.
    """

    conductance: float
    flooded: float
    film: float
    turn_film: float
    limited: bool


def fling_off(oil: CoolingOil, teeth: TurningTeeth, flow: float, factor: float, flank: float) -> FlingOff:
    """Compute the cooling of both flanks of a gear by the oil film.

    Eq. H5: G = f omega/(2 pi) A sqrt(k rho c t*) q(h0', t'), but at most rho c Q_i. `flooded` is G for h0' = 50,
    without the limit rho c Q_i.
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
    """Return the scaled thickness of the film for which `heat_number` returns `heat`."""
    unlimited = (2 * sqrt(turn / pi)) ** TIME_POWER + LONG_TURN**TIME_POWER
    return float((heat**FILM_POWER - unlimited ** (FILM_POWER / TIME_POWER)) ** (1 / FILM_POWER))
