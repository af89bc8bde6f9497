"""Units carried in field names: `face_width_mm` is the face width in millimetres.

The one place where the service converts to and from SI.
"""

from dataclasses import dataclass
from functools import cache
from math import pi


@dataclass(frozen=True, slots=True)
class Unit:
    """SI value = scale × value + offset; `symbol` is how people write the unit."""

    symbol: str
    scale: float
    offset: float = 0.0


UNITS = {
    "mm": Unit("mm", 1e-3),
    "mm2": Unit("mm²", 1e-6),
    "mm2_per_s": Unit("mm²/s", 1e-6),
    "um": Unit("µm", 1e-6),
    "deg": Unit("°", pi / 180),
    "mrad": Unit("mrad", 1e-3),
    "rpm": Unit("1/min", pi / 30),
    "hz": Unit("Hz", 1.0),
    "m_per_s": Unit("m/s", 1.0),
    "mm_per_s": Unit("mm/s", 1e-3),
    "kg": Unit("kg", 1.0),
    "g_per_s": Unit("g/s", 1e-3),
    "g_per_mol": Unit("g/mol", 1e-3),
    "n": Unit("N", 1.0),
    "n_m": Unit("N m", 1.0),
    "n_per_mm": Unit("N/mm", 1e3),
    "n_per_um": Unit("N/µm", 1e6),
    "n_per_mm_um": Unit("N/(mm µm)", 1e9),
    "n_m_per_rad": Unit("N m/rad", 1.0),
    "mpa": Unit("MPa", 1e6),
    "kpa": Unit("kPa", 1e3),
    "gpa": Unit("GPa", 1e9),
    "per_gpa": Unit("1/GPa", 1e-9),
    "per_k": Unit("1/K", 1.0),
    "pa_s": Unit("Pa s", 1.0),
    "w": Unit("W", 1.0),
    "kw": Unit("kW", 1e3),
    "j": Unit("J", 1.0),
    "w_per_mm": Unit("W/mm", 1e3),
    "w_per_mm2": Unit("W/mm²", 1e6),
    "c": Unit("°C", 1.0, 273.15),
    "k": Unit("K", 1.0),
    "kg_per_m3": Unit("kg/m³", 1.0),
    "j_per_kg_k": Unit("J/(kg K)", 1.0),
    "w_per_m_k": Unit("W/(m K)", 1.0),
}


@cache
def split_unit(name: str) -> tuple[str, Unit | None]:
    """A field name without its unit, and the unit; the longest suffix that is a unit counts."""
    words = name.split("_")
    for start in range(1, len(words)):
        unit = UNITS.get("_".join(words[start:]))
        if unit is not None:
            return "_".join(words[:start]), unit
    return name, None
