"""What a lubricated line contact is given, in SI units."""

from dataclasses import dataclass, field
from typing import Literal

from solvers.lubricants import Lubricant
from solvers.materials import Solid

Rheology = Literal["ree_eyring", "newtonian"]


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

    `refine` adds nodes until the estimated error of the mesh, but for what spikes of pressure leave, is below 2 %.
    The paper's film is Newtonian; near pure rolling its friction is not physical, so Ree-Eyring is the default.
    """

    thermal: bool = True
    rheology: Rheology = "ree_eyring"
    eyring_stress: float = 5e6
    nodes: int = 121
    film_nodes: int = 21
    refine: bool = True


@dataclass(frozen=True, slots=True)
class LineContactInputs:
    """One line contact."""

    contact: Contact
    surface_1: Solid = field(default_factory=Solid)
    surface_2: Solid = field(default_factory=Solid)
    lubricant: Lubricant = field(default_factory=Lubricant)
    temperatures: Temperatures = field(default_factory=Temperatures)
    model: Model = field(default_factory=Model)
