"""Which attribute of a REXS file becomes which field of a request, and the other names that versions have had for both.

Sources: the specification and the published schemas of REXS 1.0 to 2.0 (https://www.rexs.info). Only names and units
are used here.
"""

from typing import NamedTuple


class Row(NamedTuple):
    """A number that is taken over as it stands: our field, attributes in order of preference, unit of our field."""

    field: str
    attributes: tuple[str, ...]
    unit: str = ""


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
OIL_TEMPERATURE = Row("temperatures.oil_c", ("temperature_lubricant",), "C")
BACKLASH = ("minimum_normal_backlash", "maximum_normal_backlash")

FLANKS = ("cylindrical_gear_flank", "flank_geometry")  # the second up to version 1.0
TOOLS = ("rack_shaped_tool",)
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
