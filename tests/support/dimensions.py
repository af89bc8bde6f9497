"""Convert inputs into other units of length, mass and time, and compute the results to expect.

The unit that is declared for a number decides how the number is converted.
"""

from dataclasses import fields, is_dataclass, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from solvers.arrays import FloatArray
from solvers.quantity import quantities

Inputs = TypeVar("Inputs")


class Units(NamedTuple):
    """Lengths, masses and times are multiplied by these factors. Temperatures remain in kelvins."""

    length: float
    mass: float
    time: float


# Powers of length, mass and time by the unit in which a quantity is shown. The gas constant is the same in all units
# of mass if the mole is chosen to suit, so a molar mass is a temperature times the square of a time over a length's.
DIMENSIONS: dict[str | None, tuple[float, float, float]] = {
    None: (0, 0, 0),
    "m2": (2, 0, 0),
    "l_per_min": (3, 0, -1),
    "w_per_k": (2, 1, -3),
    "w_per_m2_k": (0, 1, -3),
    "mm": (1, 0, 0),
    "mm2": (2, 0, 0),
    "mm2_per_s": (2, 0, -1),
    "um": (1, 0, 0),
    "deg": (0, 0, 0),
    "mrad": (0, 0, 0),
    "rpm": (0, 0, -1),
    "hz": (0, 0, -1),
    "m_per_s": (1, 0, -1),
    "mm_per_s": (1, 0, -1),
    "kg": (0, 1, 0),
    "g_per_s": (0, 1, -1),
    "g_per_mol": (-2, 0, 2),
    "n": (1, 1, -2),
    "n_m": (2, 1, -2),
    "n_per_mm": (0, 1, -2),
    "n_per_um": (0, 1, -2),
    "n_per_mm_um": (-1, 1, -2),
    "n_m_per_rad": (2, 1, -2),
    "mpa": (-1, 1, -2),
    "kpa": (-1, 1, -2),
    "gpa": (-1, 1, -2),
    "per_gpa": (1, -1, 2),
    "per_k": (0, 0, 0),
    "pa_s": (-1, 1, -1),
    "w": (2, 1, -3),
    "kw": (2, 1, -3),
    "j": (2, 1, -2),
    "w_per_mm": (1, 1, -3),
    "w_per_mm2": (0, 1, -3),
    "c": (0, 0, 0),
    "k": (0, 0, 0),
    "kg_per_m3": (-3, 1, 0),
    "j_per_kg_k": (2, 0, -2),
    "w_per_m_k": (1, 1, -3),
}


def factor(units: Units, unit: str | None) -> float:
    """Return the factor by which a number with the unit `unit` is multiplied."""
    length, mass, time = DIMENSIONS[unit]
    return float(units.length**length * units.mass**mass * units.time**time)


def in_other_units(inputs: Inputs, units: Units) -> Inputs:
    """Return the same inputs in other units. Every declared number is converted, also in nested inputs."""
    kind: Any = type(inputs)
    declared = quantities(kind)
    values = {}
    for each in fields(kind):
        unit = declared[each.name].unit if each.name in declared else None
        values[each.name] = _converted(getattr(inputs, each.name), unit, units)
    return replace(inputs, **values)


def _converted(value: Any, unit: str | None, units: Units) -> Any:
    match value:
        case None | bool() | str():
            return value
        case _ if is_dataclass(value):
            return in_other_units(value, units)
        case tuple():
            return tuple(_converted(item, unit, units) for item in value)
        case float() | int():
            return value if unit is None else value * factor(units, unit)
    return value


def rescaled(units: Units) -> Any:
    """Return a function that converts the numbers of a result into other units."""

    def expected(_: str, values: FloatArray, unit: str | None) -> FloatArray:
        return np.asarray(values * factor(units, unit))

    return expected
