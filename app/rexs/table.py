"""What REXS calls things: units, and the attributes that become fields of a request or take numbers of an answer.

Sources: the specification and the published schemas of REXS 1.0 to 2.0 (https://www.rexs.info). Only names and units
are used here; of other names that versions have had, the preferred one comes first.
"""

from math import pi
from typing import NamedTuple

REVOLUTION_PER_MINUTE = pi / 30.0  # rad/s
UNITS = (
    {"": 1.0, "none": 1.0, "%": 0.01},
    {"m": 1.0, "mm": 1e-3, "mum": 1e-6, "um": 1e-6, "µm": 1e-6},
    {"rad": 1.0, "deg": pi / 180.0, "°": pi / 180.0},
    {"1/min": REVOLUTION_PER_MINUTE, "1/s": 60.0 * REVOLUTION_PER_MINUTE, "rad/s": 1.0},
    {"Nm": 1.0, "kNm": 1e3, "Nmm": 1e-3},
    {"W": 1.0, "kW": 1e3},
    {"C": 1.0, "°C": 1.0, "K": 1.0},
    {"mm^2/s": 1e-6, "m^2/s": 1.0},
    {"kg/dm^3": 1e3, "kg/m^3": 1.0},
    {"N/mm^2": 1e6, "MPa": 1e6, "GPa": 1e9, "Pa": 1.0},
    {"N/m": 1.0, "N/mm": 1e3, "N/mum": 1e6, "N/um": 1e6},
    {"h": 3600.0, "s": 1.0},
)
"""Units of each quantity as files spell them, without blanks, and their size in SI.

A file states the unit of each attribute, so a value is converted by that text and never by the version of the file:
degrees are "°" up to version 1.3 and "deg" from 1.4, modifications are in "mum" or in "mm".
"""
ZEROS = {"C": 273.15, "°C": 273.15}  # K


def converted(value: float, stated: str, wanted: str) -> float | None:
    """The value in the wanted unit, or None where the stated unit measures something else or is not known."""
    stated = "".join(stated.split())
    sizes = next(each for each in UNITS if wanted in each)
    if stated not in sizes:
        return None
    shift = ZEROS.get(stated, 0.0) - ZEROS.get(wanted, 0.0)
    if sizes[stated] == sizes[wanted] and shift == 0.0:
        return value
    return (value * sizes[stated] + shift) / sizes[wanted]


class Row(NamedTuple):
    """A number that is taken over as it stands: our field, attributes in order of preference, unit of our field."""

    field: str
    attributes: tuple[str, ...]
    unit: str = ""

    @property
    def name(self) -> str:
        """The preferred attribute."""
        return self.attributes[0]


STAGE = (
    Row("gears.centre_distance_mm", ("center_distance",), "mm"),
    Row(
        "load.application_factor",
        ("application_factor_iso_6336_2019", "application_factor_iso_6336_2006", "application_factor_din_3990_1987"),
    ),
    Row(
        "load.dynamic_factor",
        ("dynamic_factor_iso_6336_2019", "dynamic_factor_iso_6336_2006", "dynamic_factor_din_3990_1987"),
    ),
)
MATERIAL = (
    Row("youngs_modulus_gpa", ("elastic_modulus",), "GPa"),
    Row("poisson_ratio", ("poisson_ratio",)),
    Row("density_kg_per_m3", ("density",), "kg/m^3"),
)
OIL = (
    Row("kinematic_viscosity_40_mm2_per_s", ("viscosity_at_40_degree_celsius",), "mm^2/s"),
    Row("kinematic_viscosity_100_mm2_per_s", ("viscosity_at_100_degree_celsius",), "mm^2/s"),
    Row("density_15_kg_per_m3", ("density_at_15_degree_celsius",), "kg/m^3"),
)
MODULE = Row("gears.module_mm", ("normal_module", "transverse_module"), "mm")
FACE_WIDTH = Row("gears.face_width_mm", ("face_width",), "mm")
HELIX_ANGLE = Row("gears.helix_angle_deg", ("helix_angle_reference_diameter",), "deg")
PRESSURE_ANGLE = Row("gears.pressure_angle_deg", ("normal_pressure_angle",), "deg")
PROFILE_SHIFT = Row(
    "profile_shift", ("addendum_modification_coefficient_after_finishing", "addendum_modification_coefficient")
)
BASIC_ADDENDUM = Row("addendum", ("addendum_coefficient_basic_profile",))
TOOL_ADDENDUM = Row("dedendum", ("addendum_coefficient_reference_profile",))
TOOL_ADDENDUM_LENGTH = Row("dedendum", ("addendum_reference_profile",), "mm")
TOOL_TIP_RADIUS = Row("rack_tip_radius", ("tip_corner_radius_factor_reference_profile", "tip_radius_factor"))
TOOL_TIP_RADIUS_LENGTH = Row("rack_tip_radius", ("tip_corner_radius_reference_profile", "tip_radius"), "mm")
TIP_DIAMETER = Row("addendum", ("tip_diameter",), "mm")
ROOT_DIAMETER = Row("dedendum", ("root_diameter",), "mm")
ROUGHNESS = Row(
    "roughness_um", ("arithmetic_mean_roughness_flank_iso_4287_1997", "arithmetic_average_roughness_flank"), "um"
)
POSITION = Row("position_mm", ("u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side"), "mm")
WIDTH = Row("width_mm", ("face_width", "width"), "mm")
OIL_TEMPERATURE = Row("temperatures.oil_c", ("temperature_lubricant",), "C")
JOURNAL = (
    Row("diameter_mm", ("inner_diameter",), "mm"),
    Row("width_mm", ("width",), "mm"),
    Row("radial_clearance_um", ("diameter_clearance_plain_bearing",), "um"),  # half of it
    Row("film_temperature_c", ("lubricant_feed_temperature",), "C"),
)
BASE_OILS = {"polyglycol": "polyglycol", "polyglykol": "polyglycol", "pao": "pao", "polyalpha": "pao", "ester": "ester",
             "miner": "mineral"}  # fmt: skip
"""Parts of what programs write for the base oil."""
BACKLASH = ("minimum_normal_backlash", "maximum_normal_backlash")

TOOL = "rack_shaped_tool"
MODIFICATIONS = (
    "tip_relief",
    "root_relief",
    "helix_slope",
    "helix_crowning",
    "profile_crowning",
    "profile_slope",
    "end_relief_datum_face",
    "end_relief_non_datum_face",
)
OTHER_MODIFICATIONS = {
    "topographical_modification": "topographies cannot be expressed by the modifications of the model",
    "profile_twist": "twist of the flank is not modelled",
    "triangular_tip_relief": "triangular relief is not modelled",
    "triangular_root_relief": "triangular relief is not modelled",
    "helix_deviation": "measured deviations are not part of the nominal flank",
    "profile_deviation": "measured deviations are not part of the nominal flank",
}
OTHER_STAGES = {
    "bevel_stage": "bevel stages are not modelled",
    "worm_stage": "worm stages are not modelled",
    "planetary_stage": "planetary stages are not modelled",
    "general_stage": "stages without tooth data are not modelled",
}
RADIAL_BEARINGS = (
    "hydrodynamic_radial_plain_bearing",
    "slide_bearing",
    "concept_bearing",
    "rolling_bearing_with_catalog_geometry",
    "rolling_bearing_with_detailed_geometry",
)

IGNORED = {
    "custom_": "a value of another program's own",
    "reference_component_for_position": "bookkeeping of the file",
    "w_axis_vector": "orientation; needed where a drive train is formed only",
    "u_axis_vector": "orientation; needed where a drive train is formed only",
    "support_vector": "position; needed where a drive train is formed only",
    "u_coordinate": "position; needed where a drive train is formed only",
    "rotating_angle_around_neg_u_axis": "position; follows from the axes where a drive train is formed",
    "name": "bookkeeping of the file",
    "flag_designation": "says how another program was told; the value itself is used",
    "machining_allowance": "the flank is taken as finished",
    "grinding_allowance": "the flank is taken as finished",
    "": "the models have no such input",
}
"""Why attributes are not used, by the beginning of their names; the last one for all others."""

CUSTOM = "custom_tribodrive_"
STANDARD_FROM = {"face_load_factor_contact_stress": 2}
"""Attributes of results that are of the standard, and since which major version; all others are custom ones."""
LOAD_RESULTS = (
    ("load.face_load_factor", "face_load_factor_contact_stress", "none"),
    ("load.max_line_load_n_per_mm", "maximum_line_load", "N / mm"),
)
RESULTS = {
    "/v1/scuffing": (
        *LOAD_RESULTS,
        ("load.contact_fraction", "contact_pattern_fraction", "none"),
        ("pressure.max_mpa", "maximum_hertzian_pressure", "MPa"),
        ("transmission_error.peak_to_peak_um", "transmission_error_peak_to_peak", "mum"),
        ("friction_loss.coefficient", "mean_coefficient_of_friction", "none"),
        ("friction_loss.power_w", "mesh_power_loss", "W"),
        ("flash.blok_max_k", "maximum_flash_temperature_blok", "K"),
        ("flash.thermal_ehl_max_k", "maximum_flash_temperature_thermal_ehl", "K"),
        ("contact_temperature.bulk_c", "bulk_temperature", "C"),
        ("contact_temperature.blok_max_c", "maximum_contact_temperature_blok", "C"),
        ("contact_temperature.thermal_ehl_max_c", "maximum_contact_temperature_thermal_ehl", "C"),
        ("film.dowson_higginson_min_um", "minimum_film_thickness_dowson_higginson", "mum"),
        ("film.thermal_ehl_min_um", "minimum_film_thickness_thermal_ehl", "mum"),
        ("film.thickness_ratio", "specific_film_thickness", "none"),
        ("safety.scuffing_c", "scuffing_temperature", "C"),
        ("safety.blok_factor", "scuffing_safety_blok", "none"),
        ("safety.thermal_ehl_factor", "scuffing_safety_thermal_ehl", "none"),
        ("safety.verdict", "scuffing_risk", "none"),
    ),
    "/v1/drive-train": (
        *LOAD_RESULTS,
        ("load.max_pressure_mpa", "maximum_hertzian_pressure", "MPa"),
        ("load.transmission_error_pp_um", "transmission_error_peak_to_peak", "mum"),
        ("safety.blok_flank", "scuffing_safety_blok_flank", "none"),
        ("safety.minimum", "scuffing_safety_minimum", "none"),
        ("losses.total_w", "total_power_loss", "W"),
        ("losses.efficiency", "efficiency", "none"),
    ),
}
"""What of an answer is written into the file: path in the answer, attribute and its unit."""
