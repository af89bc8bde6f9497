"""Film between two flanks at the temperature of their contact, and the ratio of the film to the roughness."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import reduced_modulus
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.scuffing.micropitting.oil import pressure_viscosity, viscosity


@dataclass(frozen=True, slots=True)
class Conditions:
    """Values that all contacts of a mesh share.

    The bulk temperature [K] is either one number for all contacts, or an array with one number for each contact.
    """

    oil: OilSheet | Lubricant
    bulk: float | FloatArray
    friction: float
    pinion: Solid
    wheel: Solid

    @property
    def modulus(self) -> float:
        """Reduced modulus E_r [Pa]."""
        return reduced_modulus(self.pinion, self.wheel)

    @property
    def roughness(self) -> float:
        """Mean value of the roughness Ra of both flanks [m]."""
        return (self.pinion.roughness + self.wheel.roughness) / 2


class Contacts(NamedTuple):
    """Hertzian pressure [Pa], reduced radius [m] and surface speeds [m/s] of contacts.

    All arrays have the same shape. Every pressure is above 0.
    """

    pressure: FloatArray
    radius: FloatArray
    pinion_speed: FloatArray
    wheel_speed: FloatArray


class Films(NamedTuple):
    """Flash temperature [K], film [m] and film ratio (film over roughness) [-] of contacts."""

    flash: FloatArray
    film: FloatArray
    ratio: FloatArray


def films(conditions: Conditions, contacts: Contacts) -> Films:
    """Compute the flash temperature, the film and the film ratio lambda = h / Ra of contacts.

    Eq. M7 of the chapter on micropitting.
    """
    flash = flash_temperature(conditions, contacts)
    film = film_thickness(conditions, contacts, flash)
    return Films(flash, film, film / conditions.roughness)


def flash_temperature(conditions: Conditions, contacts: Contacts) -> FloatArray:
    """Flash temperature of contacts [K]. Eq. M4 of the chapter on micropitting; formula 80 of ISO/TR 15144-1."""
    pressure, radius, pinion_speed, wheel_speed = contacts
    conducted = _effusivity(conditions.pinion) * np.sqrt(pinion_speed) + _effusivity(conditions.wheel) * np.sqrt(
        wheel_speed
    )
    generated = conditions.friction * pressure * np.abs(pinion_speed - wheel_speed)
    width = np.sqrt(8.0 * radius * pressure / conditions.modulus)
    return np.asarray(np.sqrt(np.pi) / 2 * generated / conducted * width)


def _effusivity(solid: Solid) -> float:
    """Return the thermal contact coefficient B_M = sqrt(lambda rho c) [W s^0.5/(m^2 K)]."""
    return float(np.sqrt(solid.thermal_conductivity * solid.density * solid.specific_heat))


def film_thickness(conditions: Conditions, contacts: Contacts, flash: FloatArray) -> FloatArray:
    """Film of contacts at the bulk temperature, thinned by the flash temperature [m] (Eqs. M5, M6).

    Formulas 4 and 27 of ISO/TR 15144-1.
    """
    oil, bulk, modulus = conditions.oil, np.asarray(conditions.bulk), conditions.modulus
    thickness, coefficient = viscosity(oil, bulk), pressure_viscosity(oil, bulk)
    speed = thickness * (contacts.pinion_speed + contacts.wheel_speed) / (2.0 * modulus * contacts.radius)  # U
    load = 2.0 * np.pi * (contacts.pressure / modulus) ** 2  # W
    heated = pressure_viscosity(oil, bulk + flash) * viscosity(oil, bulk + flash) / (coefficient * thickness)  # S_GF
    film = 1.6 * contacts.radius * (coefficient * modulus) ** 0.6 * speed**0.7 * load**-0.13
    return np.asarray(film * heated**0.22)
