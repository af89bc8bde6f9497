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
HIGHEST_ROOT_LOAD = 400.0  # N/mm2, F_t/(b m_n); the stress in the root is four times it, beyond steel's strength
LEAST_LOAD = 1.0  # N/mm


def unusual(request: Request, content: dict[str, Any]) -> list[Notice]:
    """The warnings `unusual_value` of a request and of the numbers of its answer."""
    found = [*_of_oil(content), *_of_temperatures(request, content), *_of_air(request), *_of_tooth(request)]
    found += [*_of_gears(request), *_of_modifications(request), *_of_load(request, content)]
    return [Notice(code="unusual_value", message=message, field=field) for field, message in found]


Found = Iterator[tuple[str, str]]


def _of_oil(content: dict[str, Any]) -> Found:
    """Of gears and of plain bearings; that of a coupling's teeth is warned of by the coupling itself."""
    derived = content.get("derived") or {}
    viscosities = {"lubricant": (derived.get("lubricant") or derived).get("viscosity_pa_s")}
    for shaft in ("pinion_shaft", "wheel_shaft"):
        for k, bearing in enumerate((derived.get(shaft) or {}).get("bearings", ())):
            viscosities[f"{shaft}.bearings.{k}"] = bearing["viscosity_pa_s"]
    for section, viscosity in viscosities.items():
        if viscosity is not None and (thick := thick_oil(viscosity)) is not None:
            yield f"{section}.viscosity_pa_s", thick.message


def _of_temperatures(request: Request, content: dict[str, Any]) -> Found:
    oil = getattr(getattr(request, "temperatures", None), "oil_c", None)
    known = content.get("contact_temperature") or (content.get("derived") or {}).get("temperatures") or {}
    bulk = known.get("bulk_c")
    if oil is not None and bulk is not None and oil > bulk:
        yield "temperatures.oil_c", f"the oil at {oil:g} °C is hotter than the teeth at {bulk:g} °C; exchanged?"


def _of_air(request: Request) -> Found:
    ambient = getattr(request, "ambient", None)
    if ambient is not None and ambient.pressure_kpa < THIN_AIR:
        yield "ambient.pressure_kpa", f"{ambient.pressure_kpa:g} kPa is nearly a vacuum; bar?"


def _of_tooth(request: Request) -> Found:
    couplings = {f"couplings.{k}.": one.coupling for k, one in enumerate(getattr(request, "couplings", ()))}
    for prefix, coupling in couplings.items() if couplings else [("", getattr(request, "coupling", None))]:
        height = getattr(coupling, "tooth_height_mm", None)
        if coupling is not None and height is not None and height > TALLEST_TOOTH * coupling.module_mm:
            yield f"{prefix}coupling.tooth_height_mm", f"{height:g} mm is beyond {TALLEST_TOOTH:g} modules; a diameter?"


def _of_gears(request: Request) -> Found:
    gears = getattr(request, "gears", None)
    if gears is None:
        return
    diameter, width = _pitch_diameter(gears), gears.face_width_mm
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


def _pitch_diameter(gears: Any) -> float:
    """Of the pinion [mm]."""
    transverse = 1.0 if gears.module_plane == "transverse" else cos(radians(gears.helix_angle_deg))
    return float(gears.module_mm / transverse * gears.pinion.teeth)


def _of_modifications(request: Request) -> Found:
    modifications = getattr(request, "modifications", None)
    if modifications is None:
        return
    for name, value in modifications:
        if name.endswith("_um") and value and abs(value) < LEAST_MODIFICATION:
            yield f"modifications.{name}", f"{value:g} µm is less than can be ground; mm?"
    curve = getattr(getattr(modifications, "lead_curve", None), "gap_um", None)
    if curve and 0.0 < (highest := max(map(abs, curve))) < LEAST_MODIFICATION:
        yield "modifications.lead_curve.gap_um", f"{highest:g} µm is less than can be ground; mm?"


def _of_load(request: Request, content: dict[str, Any]) -> Found:
    load, field = content.get("load") or {}, _load_field(request)
    pressures = (
        (content.get("pressure") or {}).get("max_mpa"),
        (content.get("hertz") or {}).get("max_pressure_mpa"),
        load.get("max_pressure_mpa"),
    )
    pressure = next((one for one in pressures if one), None)
    if pressure is not None and pressure > HIGHEST_PRESSURE:
        message = f"the Hertz pressure of {pressure:.4g} MPa is beyond what steel carries; too much load?"
        yield field, message
    gears, torque = getattr(request, "gears", None), (content.get("derived") or {}).get("pinion_torque_n_m")
    if gears is not None and torque is not None:
        root = 2e3 * torque / _pitch_diameter(gears) / (gears.face_width_mm * gears.module_mm)
        if root > HIGHEST_ROOT_LOAD:
            message = f"the tooth force of {root:.4g} N per mm of face and module breaks a tooth of steel; W or N mm?"
            yield field, message
    highest = load.get("max_line_load_n_per_mm")
    if highest is not None and 0.0 < highest < LEAST_LOAD:
        yield field, f"the line load is {highest:.3g} N/mm at most; kW or kN m?"


def _load_field(request: Request) -> str:
    """Where the request says its load."""
    for section in ("load", "operation"):
        sent = getattr(getattr(request, section, None), "model_fields_set", ())
        for name in ("power_kw", "pinion_torque_n_m"):
            if name in sent:
                return f"{section}.{name}"
    return "contact.line_load_n_per_mm" if hasattr(request, "contact") else "load"
