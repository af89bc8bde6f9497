"""Units as REXS files spell them.

A file states the unit of each attribute, so a value is converted by that text and never by the version of the file:
degrees are "°" up to version 1.3 and "deg" from 1.4, modifications are in "mum" or in "mm".
"""

from typing import NamedTuple


class Unit(NamedTuple):
    """A unit: what it measures, and its size and zero in SI."""

    quantity: str
    factor: float
    zero: float = 0.0


DEGREE = 0.017453292519943295  # rad
REVOLUTION_PER_MINUTE = 0.10471975511965977  # rad/s
HOUR = 3600.0  # s

UNITS = {
    "": Unit("number", 1.0),
    "none": Unit("number", 1.0),
    "%": Unit("number", 0.01),
    "m": Unit("length", 1.0),
    "mm": Unit("length", 1e-3),
    "mum": Unit("length", 1e-6),
    "um": Unit("length", 1e-6),
    "µm": Unit("length", 1e-6),
    "rad": Unit("angle", 1.0),
    "deg": Unit("angle", DEGREE),
    "°": Unit("angle", DEGREE),
    "1/min": Unit("speed", REVOLUTION_PER_MINUTE),
    "1/s": Unit("speed", 60.0 * REVOLUTION_PER_MINUTE),
    "rad/s": Unit("speed", 1.0),
    "Nm": Unit("torque", 1.0),
    "kNm": Unit("torque", 1e3),
    "Nmm": Unit("torque", 1e-3),
    "W": Unit("power", 1.0),
    "kW": Unit("power", 1e3),
    "C": Unit("temperature", 1.0, 273.15),
    "°C": Unit("temperature", 1.0, 273.15),
    "K": Unit("temperature", 1.0),
    "mm^2/s": Unit("kinematic viscosity", 1e-6),
    "m^2/s": Unit("kinematic viscosity", 1.0),
    "kg/dm^3": Unit("density", 1e3),
    "kg/m^3": Unit("density", 1.0),
    "N/mm^2": Unit("pressure", 1e6),
    "MPa": Unit("pressure", 1e6),
    "GPa": Unit("pressure", 1e9),
    "Pa": Unit("pressure", 1.0),
    "N/m": Unit("stiffness", 1.0),
    "N/mm": Unit("stiffness", 1e3),
    "N/mum": Unit("stiffness", 1e6),
    "N/um": Unit("stiffness", 1e6),
    "h": Unit("time", HOUR),
    "s": Unit("time", 1.0),
}


def converted(value: float, stated: str, wanted: str) -> float | None:
    """The value in the wanted unit, or None where the stated unit measures something else or is not known."""
    found, target = UNITS.get("".join(stated.split())), UNITS[wanted]
    if found is None or found.quantity != target.quantity:
        return None
    if found == target:
        return value
    return (value * found.factor + found.zero - target.zero) / target.factor
