"""Units carried in field names: `face_width_mm` is the face width in millimetres."""

from functools import cache

from solvers.quantity import UNITS, Unit


@cache
def split_unit(name: str) -> tuple[str, Unit | None]:
    """A field name without its unit, and the unit; the longest suffix that is a unit counts."""
    words = name.split("_")
    for start in range(1, len(words)):
        unit = UNITS.get("_".join(words[start:]))
        if unit is not None:
            return "_".join(words[:start]), unit
    return name, None
