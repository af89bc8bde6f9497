"""Whether a finished thermal contact obeys what it was solved for, by code that the solution does not share.

Only what is reported enters: curves, field and inputs in SI units. The temperature of each surface must be that of its
bulk plus what the heat fluxes into it make of it, the oil must enter as warm as it was said to, and nothing may be
colder than all that surrounds it by more than the decompression of the oil takes.
"""

from math import pi, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.results import ContactCurves, ContactField
from solvers.materials import Solid


def departure(inputs: LineContactInputs, curves: ContactCurves, field: ContactField) -> float:
    """The largest departure [K] of temperatures from what they must be."""
    contact, bulk = inputs.contact, inputs.temperatures
    t = field.temperature
    fluxes = (curves.surface_1_heat_flux, curves.surface_2_heat_flux)
    sides = zip(
        (inputs.surface_1, inputs.surface_2),
        (contact.speed_1, contact.speed_2),
        (bulk.surface_1, bulk.surface_2),
        fluxes,
        (t[:, 0], t[:, -1]),
        strict=True,
    )
    departures = [inlet_departure(inputs, t), undercooling(inputs, curves, t)]
    for solid, speed, at_bulk, flux, surface in sides:
        assert flux is not None
        departures.append(float(np.abs(surface - at_bulk - surface_heating(solid, speed, curves.x, flux)).max()))
    return max(departures)


def surface_heating(solid: Solid, speed: float, x: FloatArray, flux: FloatArray) -> FloatArray:
    """Temperature rise (n,) [K] of a surface under a heat flux [W/m^2] that is linear between positions x (n,) [m].

    Strip sources on a fast half-space (Carslaw and Jaeger): (pi rho c lambda u)^-1/2 int q(s) (x - s)^-1/2 ds.
    """
    effusivity_squared = solid.density * solid.specific_heat * solid.thermal_conductivity
    return strip_integral(x, flux) / sqrt(pi * effusivity_squared * speed)


@kernel
def strip_integral(x: FloatArray, flux: FloatArray) -> FloatArray:
    """The integral of q(s) (x - s)^-1/2 up to each x (n,), by parts: 2 q_0 (x - x_0)^1/2 + int 2 q' (x - s)^1/2 ds."""
    n = x.size
    slope = np.empty(n)
    before = 0.0
    for j in range(n):
        after = (flux[j + 1] - flux[j]) / (x[j + 1] - x[j]) if j + 1 < n else 0.0
        slope[j] = (after - before) * 4.0 / 3.0
        before = after
    integral = np.empty(n)
    for i in range(n):
        total = 2.0 * flux[0] * np.sqrt(x[i] - x[0])
        for j in range(i):
            distance = x[i] - x[j]
            total += slope[j] * distance * np.sqrt(distance)
        integral[i] = total
    return integral


def inlet_departure(inputs: LineContactInputs, t: FloatArray) -> float:
    """How far [K] the first column of t (n, k) is off.

    Its walls are at bulk temperature; oil has that of the inlet or, where it leaves, of the column behind.
    """
    bulk = inputs.temperatures
    walls = max(abs(t[0, 0] - bulk.surface_1), abs(t[0, -1] - bulk.surface_2))
    inside = t[0, 1:-1]
    entering, leaving = np.abs(inside - bulk.inlet), np.abs(inside - t[1, 1:-1])
    return max(float(walls), float(np.minimum(entering, leaving).max()))


def undercooling(inputs: LineContactInputs, curves: ContactCurves, t: FloatArray) -> float:
    """How much colder [K] the coldest place of t (n, k) is than bulk, inlet and decompression explain.

    Decompression takes q = 0.00065 T u |dp/dx| h per area, which cools the surfaces by its strip integral and the
    film between them by q h/(8 lambda).
    """
    bulk, contact, oil = inputs.temperatures, inputs.contact, inputs.lubricant
    missing = min(bulk.surface_1, bulk.surface_2, bulk.inlet) - float(t.min())
    if missing <= 0.0:
        return 0.0
    gradient = np.abs(np.gradient(curves.pressure, curves.x))
    faster = max(contact.speed_1, contact.speed_2)
    cooling = oil.laws.thermal_expansion * float(t.max()) * faster * gradient * curves.film
    film = float((cooling * curves.film).max()) / (8.0 * oil.thermal_conductivity)
    solids = ((inputs.surface_1, contact.speed_1), (inputs.surface_2, contact.speed_2))
    surfaces = max(float(surface_heating(solid, speed, curves.x, cooling).max()) for solid, speed in solids)
    return max(missing - film - surfaces, 0.0)
