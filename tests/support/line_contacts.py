"""Return line contacts with given Hertzian pressures, and Blok's flash temperature of a contact.

The contacts form a grid or are random.
"""

from itertools import product
from math import exp, log, pi
from random import Random

from solvers.contact.ehl import Contact, LineContactInputs, Model
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import half_width, reduced_modulus
from solvers.lubricants import Lubricant
from solvers.materials import Solid

MODULUS = 226.37e9


def at_pressure(
    pressure: float, ratio: float, speed: float, viscosity: float, radius: float, model: Model
) -> LineContactInputs:
    """Return the line contact with a given Hertzian pressure [Pa] and slide-roll ratio [-]."""
    # The mean speed [m/s], the viscosity [Pa s] and the reduced radius [m] are also given.
    line_load = 2.0 * pi * radius * pressure**2 / MODULUS
    contact = Contact(line_load, radius, speed * (1 + ratio / 2), speed * (1 - ratio / 2))
    return LineContactInputs(contact, lubricant=Lubricant(viscosity=viscosity), model=model)


def random_contacts(model: Model, count: int, seed: int) -> list[LineContactInputs]:
    """Draw line contacts with Hertzian pressures of 0.3 to 3 GPa and slide-roll ratios of 0 to 1.9."""
    # The logarithms of mean speed, viscosity and radius are uniformly distributed.
    random = Random(seed)

    def between(low: float, high: float) -> float:
        return exp(random.uniform(log(low), log(high)))

    return [
        at_pressure(
            random.uniform(0.3e9, 3e9),
            random.uniform(0.0, 1.9),
            between(0.3, 20.0),
            between(0.008, 0.1),
            between(3e-3, 30e-3),
            model,
        )
        for _ in range(count)
    ]


def grid_contacts(model: Model) -> list[LineContactInputs]:
    """Return a grid of 200 contacts, on which other schemes are known to fail."""
    ranges = ((0.3e9, 0.7e9, 1.2e9, 2e9, 3e9), (0.0, 0.1, 0.5, 1.0, 1.9), (1.0, 10.0), (0.01, 0.08), (5e-3, 20e-3))
    return [at_pressure(*values, model) for values in product(*ranges)]


def blok_flash(at: Contact, friction: float) -> float:
    """Return Blok's flash temperature [K] of steel on steel, Eq. 25."""
    # The speeds u_1 and u_2 are the rolling speeds. The source prints sliding speeds instead.
    steel = Solid()
    flash = blok_flash_temperature(
        friction=friction,
        line_load=at.line_load,
        speed_1=at.speed_1,
        speed_2=at.speed_2,
        half_width=half_width(at.line_load, at.radius, reduced_modulus(steel, steel)),
        solid_1=steel,
        solid_2=steel,
    )
    return float(flash)
