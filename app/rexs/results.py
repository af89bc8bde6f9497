"""Answers written back into the file they came from.

A quantity for which the file's version has an attribute is written under that name; every other one under a name of
our own that begins with `custom_tribodrive_`, as REXS provides for programs.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

from app.rexs.document import Document
from app.rexs.model import Attribute

CUSTOM = "custom_tribodrive_"


class Result(NamedTuple):
    """Path in the answer, attribute, unit, and the first major version in which the attribute is of the standard."""

    path: str
    attribute: str
    unit: str
    standard_from: int | None = None


SCUFFING = (
    Result("load.face_load_factor", "face_load_factor_contact_stress", "none", 2),
    Result("load.max_line_load_n_per_mm", "maximum_line_load", "N / mm"),
    Result("load.contact_fraction", "contact_pattern_fraction", "none"),
    Result("pressure.max_mpa", "maximum_hertzian_pressure", "MPa"),
    Result("transmission_error.peak_to_peak_um", "transmission_error_peak_to_peak", "mum"),
    Result("friction_loss.coefficient", "mean_coefficient_of_friction", "none"),
    Result("friction_loss.power_w", "mesh_power_loss", "W"),
    Result("flash.blok_max_k", "maximum_flash_temperature_blok", "K"),
    Result("flash.thermal_ehl_max_k", "maximum_flash_temperature_thermal_ehl", "K"),
    Result("contact_temperature.bulk_c", "bulk_temperature", "C"),
    Result("contact_temperature.blok_max_c", "maximum_contact_temperature_blok", "C"),
    Result("contact_temperature.thermal_ehl_max_c", "maximum_contact_temperature_thermal_ehl", "C"),
    Result("film.dowson_higginson_min_um", "minimum_film_thickness_dowson_higginson", "mum"),
    Result("film.thermal_ehl_min_um", "minimum_film_thickness_thermal_ehl", "mum"),
    Result("film.thickness_ratio", "specific_film_thickness", "none"),
    Result("safety.scuffing_c", "scuffing_temperature", "C"),
    Result("safety.blok_factor", "scuffing_safety_blok", "none"),
    Result("safety.thermal_ehl_factor", "scuffing_safety_thermal_ehl", "none"),
    Result("safety.verdict", "scuffing_risk", "none"),
)
DRIVE_TRAIN = (
    Result("load.face_load_factor", "face_load_factor_contact_stress", "none", 2),
    Result("load.max_line_load_n_per_mm", "maximum_line_load", "N / mm"),
    Result("load.max_pressure_mpa", "maximum_hertzian_pressure", "MPa"),
    Result("load.transmission_error_pp_um", "transmission_error_peak_to_peak", "mum"),
    Result("safety.blok_flank", "scuffing_safety_blok_flank", "none"),
    Result("safety.minimum", "scuffing_safety_minimum", "none"),
    Result("losses.total_w", "total_power_loss", "W"),
    Result("losses.efficiency", "efficiency", "none"),
)
TABLES = {"/v1/scuffing": SCUFFING, "/v1/drive-train": DRIVE_TRAIN}


def write_results(document: Document, stage: int, endpoint: str, answer: dict[str, Any]) -> None:
    """Give the numbers of an answer, its status and its case to the stage's component."""
    major = int(document.model.version.split(".")[0])
    document.add(stage, _attributes(endpoint, answer, major))


def _attributes(endpoint: str, answer: dict[str, Any], major: int) -> Iterator[Attribute]:
    for result in TABLES[endpoint]:
        value: Any = answer
        for name in result.path.split("."):
            value = value.get(name) if isinstance(value, dict) else None
        if value is not None:
            standard = result.standard_from is not None and major >= result.standard_from
            yield Attribute(("" if standard else CUSTOM) + result.attribute, result.unit, value)
    for name in ("status", "case"):
        yield Attribute(f"{CUSTOM}{name}", "none", answer[name])
