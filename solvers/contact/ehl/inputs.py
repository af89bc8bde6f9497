"""What a lubricated line contact is given, in SI units, and what cannot be computed."""

from dataclasses import dataclass, field
from typing import Literal

from solvers.contact import hertz
from solvers.errors import InvalidInput
from solvers.lubricants import ROELANDS_POLE_TEMPERATURE, Lubricant
from solvers.materials import Solid

LOWEST_VISCOSITY = 7e-5  # Pa s; Roelands' law ends at 6.31e-5
HIGHEST_PRESSURE = 4e9  # Pa
LOWEST_TEMPERATURE = ROELANDS_POLE_TEMPERATURE + 60.0  # K; no oil flows there
MIN_NODES = 41
MIN_FILM_NODES = 5


@dataclass(frozen=True, slots=True)
class Contact:
    """Two cylinders rolling and sliding on a film that enters with the surfaces' mean speed.

    Units: line_load [N/m], radius (reduced, 1/R = 1/R1 + 1/R2) [m], speed_1 and speed_2 (surface speeds relative to
    the contact, positive into it) [m/s].
    """

    line_load: float
    radius: float
    speed_1: float
    speed_2: float

    @property
    def entrainment_speed(self) -> float:
        """Mean surface speed [m/s]."""
        return 0.5 * (self.speed_1 + self.speed_2)

    @property
    def slide_roll_ratio(self) -> float:
        """(u1 - u2) / mean speed [-]."""
        return (self.speed_1 - self.speed_2) / self.entrainment_speed


@dataclass(frozen=True, slots=True)
class Temperatures:
    """Bulk temperatures of the two surfaces and temperature of the oil at the inlet [K]."""

    surface_1: float = 360.0
    surface_2: float = 360.0
    inlet: float = 360.0


@dataclass(frozen=True, slots=True)
class Model:
    """Physics and resolution; eyring_stress [Pa], `nodes` along the contact, `film_nodes` across the film.

    The paper's film is Newtonian; near pure rolling its friction is not physical, so Ree-Eyring is the default.
    """

    thermal: bool = True
    rheology: Literal["ree_eyring", "newtonian"] = "ree_eyring"
    eyring_stress: float = 5e6
    nodes: int = 121
    film_nodes: int = 21


@dataclass(frozen=True, slots=True)
class LineContactInputs:
    """One line contact."""

    contact: Contact
    surface_1: Solid = field(default_factory=Solid)
    surface_2: Solid = field(default_factory=Solid)
    lubricant: Lubricant = field(default_factory=Lubricant)
    temperatures: Temperatures = field(default_factory=Temperatures)
    model: Model = field(default_factory=Model)


def check(inputs: LineContactInputs) -> None:
    """Refuse what has no solution or lies outside the laws of the lubricant.

    Raises InvalidInput: no_load, no_entrainment, stationary_surface, viscosity_range, temperature_range,
    pressure_range, resolution.
    """
    contact, lubricant = inputs.contact, inputs.lubricant
    if contact.line_load <= 0.0 or contact.radius <= 0.0:
        raise InvalidInput("no_load", "line load and reduced radius must be positive", "line_load")
    if contact.entrainment_speed <= 0.0:
        raise InvalidInput("no_entrainment", "the mean surface speed must be positive: it draws the film in", "speed_1")
    if inputs.model.thermal and min(contact.speed_1, contact.speed_2) <= 0.0:
        name = "speed_1" if contact.speed_1 <= contact.speed_2 else "speed_2"
        raise InvalidInput(
            "stationary_surface",
            "a surface that does not move through the contact heats up without limit; both speeds must be positive "
            "(or switch thermal off)",
            name,
        )
    if lubricant.viscosity < LOWEST_VISCOSITY:
        raise InvalidInput(
            "viscosity_range", f"the viscosity must be at least {LOWEST_VISCOSITY:g} Pa s, Roelands' limit", "viscosity"
        )
    temperatures = inputs.temperatures
    coldest = min(temperatures.surface_1, temperatures.surface_2, temperatures.inlet, lubricant.reference_temperature)
    if coldest < LOWEST_TEMPERATURE:
        raise InvalidInput("temperature_range", f"temperatures must be above {LOWEST_TEMPERATURE:g} K", "temperatures")
    modulus = hertz.reduced_modulus(inputs.surface_1, inputs.surface_2)
    if hertz.maximum_pressure(contact.line_load, contact.radius, modulus) > HIGHEST_PRESSURE:
        raise InvalidInput("pressure_range", "the Hertz pressure must not exceed 4 GPa", "line_load")
    if inputs.model.nodes < MIN_NODES or inputs.model.film_nodes < MIN_FILM_NODES:
        raise InvalidInput(
            "resolution", f"at least {MIN_NODES} nodes along and {MIN_FILM_NODES} across the film are needed", "nodes"
        )
