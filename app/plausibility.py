"""Values inside the legal range that look like slips, often of a unit: a warning names field and likely slip."""

from collections.abc import Iterator
from math import cos, pi, radians
from typing import Any

from app.schema.base import Notice, Request
from solvers.lubricants import thick_oil

THIN_AIR = 20.0  # kPa
LEAST_MODIFICATION = 0.5  # um
WIDEST_FACE = 3.0  # pitch diameters
NARROWEST_FACE = 0.5  # modules
TALLEST_TOOTH = 4.0  # modules
FASTEST = 250.0  # m/s
HIGHEST_PRESSURE = 2500.0  # MPa
LEAST_LOAD = 1.0  # N/mm


def unusual(request: Request, content: dict[str, Any]) -> list[Notice]:
    """The warnings `unusual_value` of a request and of the numbers of its answer."""
    found = [*_of_oil(request, content), *_of_air(request), *_of_tooth(request)]
    found += [*_of_gears(request), *_of_modifications(request), *_of_load(content)]
    return [Notice(code="unusual_value", message=message, field=field) for field, message in found]


Found = Iterator[tuple[str, str]]


def _of_oil(request: Request, content: dict[str, Any]) -> Found:
    viscosity = (content.get("derived") or {}).get("viscosity_pa_s")
    if viscosity is not None and (thick := thick_oil(viscosity)) is not None:
        yield "lubricant.viscosity_pa_s", thick.message
    temperatures, bulk = getattr(request, "temperatures", None), content.get("contact_temperature") or {}
    oil = getattr(temperatures, "oil_c", None)
    if oil is not None and bulk and oil > bulk["bulk_c"]:
        yield (
            "temperatures.oil_c",
            f"the oil at {oil:g} °C is hotter than the teeth at {bulk['bulk_c']:g} °C; exchanged?",
        )


def _of_air(request: Request) -> Found:
    ambient = getattr(request, "ambient", None)
    if ambient is not None and ambient.pressure_kpa < THIN_AIR:
        yield "ambient.pressure_kpa", f"{ambient.pressure_kpa:g} kPa is nearly a vacuum; bar?"


def _of_tooth(request: Request) -> Found:
    coupling = getattr(request, "coupling", None)
    height = getattr(coupling, "tooth_height_mm", None)
    if coupling is not None and height is not None and height > TALLEST_TOOTH * coupling.module_mm:
        yield "coupling.tooth_height_mm", f"{height:g} mm is beyond {TALLEST_TOOTH:g} modules; a diameter?"


def _of_gears(request: Request) -> Found:
    gears = getattr(request, "gears", None)
    if gears is None:
        return
    module = gears.module_mm / (1.0 if gears.module_plane == "transverse" else cos(radians(gears.helix_angle_deg)))
    diameter, width = module * gears.pinion.teeth, gears.face_width_mm
    if width > WIDEST_FACE * diameter:
        yield "gears.face_width_mm", f"{width:g} mm is beyond {WIDEST_FACE:g} pitch diameters of the pinion; cm?"
    if width < NARROWEST_FACE * gears.module_mm:
        yield "gears.face_width_mm", f"{width:g} mm is below half a module; cm or inches?"
    for section in ("load", "operation"):
        speed = getattr(getattr(request, section, None), "pinion_speed_rpm", None)
        if speed is not None and (velocity := speed * pi / 30 * diameter / 2e3) > FASTEST:
            yield (
                f"{section}.pinion_speed_rpm",
                f"the pitch-line velocity is {velocity:.4g} m/s, beyond {FASTEST:g}; the speed of another shaft?",
            )


def _of_modifications(request: Request) -> Found:
    modifications = getattr(request, "modifications", None)
    if modifications is None:
        return
    for name, value in modifications:
        if name.endswith("_um") and value and abs(value) < LEAST_MODIFICATION:
            yield f"modifications.{name}", f"{value:g} µm is less than can be ground; mm?"


def _of_load(content: dict[str, Any]) -> Found:
    pressure = (content.get("pressure") or {}).get("max_mpa") or (content.get("hertz") or {}).get("max_pressure_mpa")
    if pressure is not None and pressure > HIGHEST_PRESSURE:
        message = f"the Hertz pressure of {pressure:.4g} MPa is beyond what steel carries; too much load?"
        yield ("contact.line_load_n_per_mm" if "hertz" in content else "load"), message
    highest = (content.get("load") or {}).get("max_line_load_n_per_mm")
    if highest is not None and 0.0 < highest < LEAST_LOAD:
        yield "load", f"the line load is {highest:.3g} N/mm at most; kW or kN m?"
