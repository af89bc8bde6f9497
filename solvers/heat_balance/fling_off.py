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
    """Flanks that a jet wets, both of every tooth: A = 2 z b H, H = 2.25 m_n (Eq. H1)."""
    height = TOOTH_HEIGHT * module
    return TurningTeeth(2 * teeth * face_width * height, height, radius, speed)


def heat_number(film: float, turn: float) -> float:
    """Heat q that a film h0' (`film`) takes in a turn t' (`turn`) over sqrt(k rho c t*) per area and kelvin (Eq. H2).

    Joins three limits within 2.5 % of numerical solutions: thin film q = h0'; short turn (half space) q = 2
    sqrt(t'/pi); thick film and long turn (similarity) q = 0.98.
    """
    short = 2 * sqrt(turn / pi)
    unlimited = short**TIME_POWER + LONG_TURN**TIME_POWER
    return float((film**FILM_POWER + unlimited ** (FILM_POWER / TIME_POWER)) ** (1 / FILM_POWER))


def fling_off_time(oil: CoolingOil, teeth: TurningTeeth, temperature: float) -> float:
    """Time t* = sqrt(nu H/(a r))/omega after which the heat has passed through the whole film [s] (Eq. H3).

    The rotation has then thinned the film at x = H to sqrt(a t*), the depth that the heat has reached.
    """
    viscosity = oil.viscosity(temperature) / oil.density
    return sqrt(viscosity * teeth.height / (oil.diffusivity * teeth.radius)) / teeth.speed


def laid_film(teeth: TurningTeeth, flow: float) -> float:
    """Thickness h0 = Q_i/(A_i omega/2 pi) of the film that the jets lay on the flanks in one turn [m] (Eq. H4)."""
    return flow / (teeth.area * teeth.turns)


@dataclass(frozen=True, slots=True)
class FlingOff:
    """Cooling of one gear by its oil film.

    `film` [m] is laid in one turn, `turn_film` [m] has 90 % of the conductance `flooded` [W/K] of a film that more oil
    does not help. `limited`: `conductance` [W/K] is at least 98 % of the heat capacity of the flow, which it cannot
    exceed.
    """

    conductance: float
    flooded: float
    film: float
    turn_film: float
    limited: bool


def fling_off(oil: CoolingOil, teeth: TurningTeeth, flow: float, factor: float, flank: float) -> FlingOff:
    """Cooling of both flanks: G = f omega/(2 pi) A sqrt(k rho c t*) q(h0', t'), at most rho c Q_i (Eq. H5).

    `flooded` is G for h0' = 50 without that limit.
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
