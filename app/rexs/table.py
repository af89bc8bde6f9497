"""Names in REXS files: units, attributes from which request fields are filled, and attributes for results.

Sources: the specification and the published schemas of REXS 1.0 to 2.0 (https://www.rexs.info). Only names and units
are taken from these sources. If the versions of REXS have different names for an attribute, the preferred name comes
first.
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
    {"N": 1.0, "kN": 1e3},
    {"W": 1.0, "kW": 1e3},
    {"C": 1.0, "°C": 1.0, "K": 1.0},
    {"mm^2/s": 1e-6, "m^2/s": 1.0},
    {"kg/dm^3": 1e3, "kg/m^3": 1.0},
    {"N/mm^2": 1e6, "MPa": 1e6, "GPa": 1e9, "Pa": 1.0},
    {"N/m": 1.0, "N/mm": 1e3, "N/mum": 1e6, "N/um": 1e6},
    {"h": 3600.0, "s": 1.0},
    {"W/(mK)": 1.0},
    {"J/(kgK)": 1.0, "kJ/(kgK)": 1e3},
    {"1/GPa": 1e-9, "mm^2/N": 1e-6, "1/MPa": 1e-6, "1/Pa": 1.0},
    {"m/s^2": 1.0},
    {"l/min": 1e-3 / 60.0, "l/s": 1e-3, "m^3/s": 1.0, "m^3/h": 1.0 / 3600.0},
)
"""The units of each quantity: the spelling of a unit in files, without blanks, and the size of this unit in SI units.

A file states the unit of every attribute. The stated unit alone decides how a value is converted; the version of the
file does not matter. The versions of REXS use different spellings and units. For example, degrees are "°" up to version
1.3 and "deg" from version 1.4, and modifications are in "mum" or in "mm".
"""
ZEROS = {"C": 273.15, "°C": 273.15}  # zero points of the scales of temperature [K]


def convert(value: float, stated: str, wanted: str) -> float | None:
    """Convert a value to the wanted unit. Return None if the stated unit is unknown or belongs to another quantity."""
    stated = "".join(stated.split())
    sizes = next(units for units in UNITS if wanted in units)
    if stated not in sizes:
        return None
    shift = ZEROS.get(stated, 0.0) - ZEROS.get(wanted, 0.0)
    if sizes[stated] == sizes[wanted] and shift == 0.0:
        return value
    return (value * sizes[stated] + shift) / sizes[wanted]


class Row(NamedTuple):
    """A number that is copied from the file into a request.

    `field` is the field of the request, and `unit` is the unit of this field. `attributes` names the attributes that
    may contain the number; the preferred attribute comes first.
    """

    field: str
    attributes: tuple[str, ...]
    unit: str = ""

    @property
    def name(self) -> str:
        """The name of the preferred attribute."""
        return self.attributes[0]


# The editions of standards, as versions of REXS spell them at the ends of names; the newest spelling comes first.
ISO_6336 = ("iso_6336_2019", "iso_6336_2006")
AGMA_925 = ("agma_925_2003", "agma_925_a03")
AGMA_2101 = ("agma_2101_1995", "agma_2101_c95")


def _by(name: str, *editions: str) -> tuple[str, ...]:
    """Return the names of an attribute that depends on a standard, one for each edition."""
    return tuple(f"{name}_{edition}" for edition in editions)


APPLICATION_FACTOR, SCUFFING_FACTOR = "load.application_factor", "scuffing.application_factor"
"""Two fields of a draft. If a draft has both, only `scuffing.application_factor` is sent to /v1/scuffing."""
STAGE = (
    Row("gears.centre_distance_mm", ("center_distance",), "mm"),
    Row(APPLICATION_FACTOR, _by("application_factor", *ISO_6336, "din_3990_1987")),
    Row("load.dynamic_factor", _by("dynamic_factor", *ISO_6336, "din_3990_1987", *AGMA_2101, *AGMA_925)),
    Row("load.mesh_load_factor", _by("mesh_load_factor", *ISO_6336)),
    Row(SCUFFING_FACTOR, ("application_factor_scuffing_iso_6336_2022",)),
    Row("temperatures.scuffing_c", _by("mean_scuffing_temperature", *AGMA_925), "C"),
)
MATERIAL = (
    Row("youngs_modulus_gpa", ("elastic_modulus",), "GPa"),
    Row("poisson_ratio", ("poisson_ratio",)),
    Row("density_kg_per_m3", ("density",), "kg/m^3"),
)
HEAT = (
    Row("thermal_conductivity_w_per_m_k", ("thermal_conductivity",), "W/(mK)"),
    Row("specific_heat_j_per_kg_k", ("thermal_capacity",), "J/(kgK)"),
)
"""Thermal properties of gears and oils. No request has fields for the thermal properties of shafts."""
OIL = (
    Row("kinematic_viscosity_40_mm2_per_s", ("viscosity_at_40_degree_celsius",), "mm^2/s"),
    Row("kinematic_viscosity_100_mm2_per_s", ("viscosity_at_100_degree_celsius",), "mm^2/s"),
    Row("density_15_kg_per_m3", ("density_at_15_degree_celsius",), "kg/m^3"),
    Row("pressure_viscosity_per_gpa", _by("pressure_viscosity_coefficient", *AGMA_925), "1/GPa"),
    *HEAT,
)
PRESSURE_VISCOSITY_38 = Row(
    "lubricant.pressure_viscosity_38_per_gpa", ("pressure_viscosity_coefficient_at_38_degrees_celsius",), "1/GPa"
)
EXTERNAL = ("data_source", "referenced_component_id")
"""Attributes that refer to data in another file."""
MODULE = Row("gears.module_mm", ("normal_module",), "mm")
TRANSVERSE_MODULE = Row("gears.module_mm", ("transverse_module",), "mm")
FACE_WIDTH = Row("gears.face_width_mm", ("face_width",), "mm")
GEAR_TORQUE = Row("load.pinion_torque_n_m", ("torque",), "Nm")
GEAR_SPEED = Row("load.pinion_speed_rpm", ("rotational_speed",), "1/min")
COMMON_WIDTH = Row("gears.face_width_mm", ("common_face_width",), "mm")
HELIX_ANGLE = Row("gears.helix_angle_deg", ("helix_angle_reference_diameter",), "deg")
PRESSURE_ANGLE = Row("gears.pressure_angle_deg", ("normal_pressure_angle",), "deg")
BASE_HELIX_ANGLE = Row("gears.helix_angle_deg", ("helix_angle_base_diameter", "helix_angle_base_circle"), "deg")
TRANSVERSE_PRESSURE_ANGLE = Row("gears.pressure_angle_deg", ("pressure_angle_in_the_transverse_section",), "deg")
QUALITY_CLASS = Row("gears.quality_class", ("global_tolerance_class_iso_1328_2013",))
TIP_DIAMETER_LIMITS = ("minimum_tip_diameter", "maximum_tip_diameter")
PROFILE_SHIFT = Row("profile_shift", ("addendum_modification_coefficient",))
FINISHED_SHIFT = Row(
    "profile_shift",
    ("addendum_modification_coefficient_after_finishing", "generated_addendum_modification_coefficient"),
)
BASIC_ADDENDUM = Row("addendum", ("addendum_coefficient_basic_profile",))
BASIC_ADDENDUM_LENGTH = Row("addendum", ("addendum_basic_profile",), "mm")
TOOL_ADDENDUM = Row("dedendum", ("addendum_coefficient_reference_profile",))
TOOL_ADDENDUM_LENGTH = Row("dedendum", ("addendum_reference_profile",), "mm")
TOOL_TIP_RADIUS = Row("rack_tip_radius", ("tip_corner_radius_factor_reference_profile", "tip_radius_factor"))
TOOL_TIP_RADIUS_LENGTH = Row("rack_tip_radius", ("tip_corner_radius_reference_profile", "tip_radius"), "mm")
TIP_DIAMETER = Row("addendum", ("tip_diameter",), "mm")
ROOT_DIAMETER = Row("dedendum", ("root_diameter",), "mm")
ROUGHNESS = Row(
    "roughness_um",
    (
        "arithmetic_mean_roughness_flank_iso_4287_1997",
        "arithmetic_average_roughness_flank",
        *_by("arithmentic_mean_roughness_at_filter_cutoff_of_wavelength", *AGMA_925),
    ),
    "um",
)
MEAN_PEAK_TO_VALLEY = Row(
    "roughness_um", ("mean_peak_to_valley_roughness_flank_iso_4287_1997", "averaged_peak_to_valley_height_flank"), "um"
)
RA_OF_RZ = 1.0 / 6.0  # Ra over Rz of a ground flank; ISO 6336-2 converts so
POSITION = Row("position_mm", ("u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side"), "mm")
WIDTH = Row("width_mm", ("face_width", "width"), "mm")
AXIAL_FORCE = Row("load.axial_force_n", ("force_u_direction",), "N")
HOLDS_ALONG_U, HOLDS_NOTHING = "axial_force_absorption", {"", "no_direction"}
OIL_TEMPERATURE = Row(
    "temperatures.oil_c", ("temperature_lubricant", *_by("oil_inlet_or_sump_temperature", *AGMA_925)), "C"
)
BULK_TEMPERATURE = Row("temperatures.bulk_c", ("bulk_temperature", *_by("tooth_temperature", *AGMA_925)), "C")
FRICTION = Row("friction_coefficient", _by("mean_coefficient_of_friction_constant", *AGMA_925))
FRICTION_METHODS = _by("determination_of_mean_coefficient_of_friction", *AGMA_925)
OIL_SUPPLY = (
    *_by("lubrication_type", *AGMA_925, "vdi_2736_2014"),
    "determination_of_lubrication_type_vdi_2736_2014",
    "lubrication_type",
)
SUPPLY_FACTOR = "lubrication_factor_scuffing_iso_6336_2022"
SUPPLY_FACTORS = {1.2: "spray", 1.0: "dip", 0.2: "submerged"}
SUPPLIES = {"splash": "dip", "dip": "dip", "bath": "dip", "submerged": "submerged", "spray": "spray",
            "injection": "spray", "circulating": "spray"}  # fmt: skip
"""Words that identify the oil supply of a mesh in files, and the oil supply that each word means."""
REFERENCE_TEMPERATURE = Row("thermal.reference_c", ("reference_temperature",), "C")
TOOTH_TEMPERATURES = (
    Row("thermal.pinion_bulk_c", ("bulk_temperature",), "C"),
    Row("thermal.wheel_bulk_c", ("bulk_temperature",), "C"),
)
BEARING_BORE = Row("diameter_mm", ("reference_diameter_relative_clearance_plain_bearing", "inner_diameter"), "mm")
JOURNAL = (
    Row("diameter_mm", ("inner_diameter",), "mm"),
    Row("width_mm", ("width",), "mm"),
    Row("radial_clearance_um", ("diameter_clearance_plain_bearing",), "um"),  # a diameter; half of it is used
    Row("feed_temperature_c", ("lubricant_feed_temperature",), "C"),
    Row("oil_flow_l_per_min", ("lubricant_flow_through_bearing",), "l/min"),
)
OIL_TYPES = _by("lubricant_type", *ISO_6336, *AGMA_925)
OIL_WORDS = ("basis", "kind", "name")
OTHER_OILS = ("phosphat", "traction", "traktion", "silicon", "water_soluble", "wasserl")
NOT_SOLUBLE = ("non_water_soluble", "nicht_wasserl")
"""Words that identify oils that are not modelled, and words that begin as one of these but mean the contrary."""
BASE_OILS = {"polyglycol": "polyglycol",
             "polyglykol": "polyglycol", "polyalkylen": "polyglycol", "pag_": "polyglycol", "pao": "pao",
             "polyalpha": "pao", "polyalfa": "pao",
             "ester": "ester", "mil_l_": "ester", "miner": "mineral", "synthetic": None, "biologic": None,
             "food": None}  # fmt: skip
"""Words that identify the base oil in files, and the base oil that each word means. Specific words come first.

None marks a word that leaves the kind of oil open.
"""
BACKLASH = ("minimum_normal_backlash", "maximum_normal_backlash")
TRANSVERSE_BACKLASH = ("minimum_transverse_backlash", "maximum_transverse_backlash")

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
ON_SHAFTS = ("shaft_section", "external_load")
CASING, SWITCHABLE = "gear_casing", "switchable_coupling"
GEARS = {"cylindrical_gear", "ring_gear", "bevel_gear", "worm_gear", "worm_wheel", "general_gear"}
JOINED = {*GEARS, "shaft", "side_plate", CASING}
JOINTS = {"coupling", "fixed_coupling", SWITCHABLE, "feather_key_connection", "involute_spline_connection",
          "cylindrical_interference_fit", "tapered_interference_fit"}  # fmt: skip
"""The types of the connections through which a torque goes; a switchable coupling only where it is engaged."""
RADIAL_BEARINGS = (
    "hydrodynamic_radial_plain_bearing",
    "slide_bearing",
    "concept_bearing",
    "rolling_bearing_with_catalog_geometry",
    "rolling_bearing_with_detailed_geometry",
)

_BOOKKEEPING = (
    "name|part_number|revision_number|sequence_number|version|modification_date|data_source|referenced_component_id|"
    "display_color|customer|model_name|number_of_gears|gear_shift_index|gde_file|manufacturer|"
    "reference_component_for_position|description_.*|flag_designation.*|transmits_torque|defines_.*"
)
_POSITIONS = (
    "w_axis_vector|u_axis_vector|support_vector|u_coordinate.*|rotating_angle_around_neg_u_axis|datum_face_orientation"
)
_RATINGS = "(iso_6336|din_3990|din_3996|vdi_2736|agma_2101|agma_925|plewe|fkm|din_743|din_6892|fva|iso_281)"
_SAID_OF_TEETH = (
    "(diameter|thickness|pitch|module|space_width|chord|tooth_depth|tooth_tip_height|lever|half_angle|virtual_number|"
    "_ratio|span|over_balls|over_pins|undercut|helix_angle_base|transverse_section|normal_section|radius_of|"
    "number_of_teeth|radius_at_30|working_depth|diametral_measurement|conversion_factor|path_of_contact|tip_clearance|bottom_clearance|axial_backlash|angle_at_tip)"
)
_RESULTS = (
    "(force|torque|power|stress|displacement|torsion|tilting|load|temperature|pressure|velocity|safety|stiffness|"
    "speed|sliding|contact|nodes|meshing|strength|tangential)"
)
_ROWS = (
    *STAGE, *MATERIAL, *HEAT, *OIL, PRESSURE_VISCOSITY_38, MODULE, TRANSVERSE_MODULE, FACE_WIDTH, COMMON_WIDTH,
    PROFILE_SHIFT, FINISHED_SHIFT, BASIC_ADDENDUM, BASIC_ADDENDUM_LENGTH, TIP_DIAMETER, ROOT_DIAMETER, ROUGHNESS,
    MEAN_PEAK_TO_VALLEY, OIL_TEMPERATURE, BULK_TEMPERATURE, FRICTION, GEAR_TORQUE, GEAR_SPEED, QUALITY_CLASS,
)  # fmt: skip
_TAKEN = {name for row in _ROWS for name in row.attributes}
_TAKEN |= {*BACKLASH, *TRANSVERSE_BACKLASH, *OIL_TYPES, *OIL_WORDS, *OIL_SUPPLY, *FRICTION_METHODS, *MODIFICATIONS}
_TAKEN |= {*BASE_HELIX_ANGLE.attributes, *TRANSVERSE_PRESSURE_ANGLE.attributes, *TIP_DIAMETER_LIMITS}
_TAKEN |= {"addendum_modification", "is_driving_gear", SUPPLY_FACTOR}
IGNORED = (
    (
        "(cylindrical|flank|stage|lubricant|material|gear_casing).*",
        f"^({'|'.join(sorted(_TAKEN))})$",
        "another value of the file is used instead",
    ),
    (".*", "^custom_", "a value that only another program uses"),
    (".*", f"^({_BOOKKEEPING})$", "bookkeeping of the file"),
    (".*", "^(machining|grinding)_allowance", "the flank is taken as finished"),
    (".*", "friction.*(agma|vdi)", "calculated by a method that is not used here; the models have their own methods"),
    (".*", f"{_RATINGS}(_|$)", "belongs to a rating that is not made here"),
    (
        "cylindrical_.*",
        "case_hardening|endurance_limit|basic_strength|capacity|resistance",
        "belongs to a rating that is not made here",
    ),
    (
        ".*",
        "(iso_1328|din_39|din_26281|tolerance|deviation|allowance|_variation$)",
        "tolerances are not part of the nominal gear",
    ),
    (".*", f"^({_POSITIONS})$", "a position, which is used only if a drive train is formed"),
    (
        "(concept|rolling|slide|hydrodynamic).*",
        "",
        "of radial bearings only stiffness and offset are used; of plain bearings only dimensions and feed temperature",
    ),
    ("material", "", "of materials only elasticity, density and heat are used"),
    ("rack_shaped_tool", "", "of tools only addendum and tip radius are used"),
    ("lubricant", "", "of the oil only the kind and the values at 15, 40 and 100 °C are used"),
    (
        "external_load",
        "",
        "of loads on shafts only the torque about the axis is used, and the axial force on a floating shaft",
    ),
    ("shaft_section", "", "sections are used only if a drive train is formed"),
    (
        "shaft|gear_casing|cylindrical_gear",
        "temperature|mass",
        "temperatures and masses of shafts and casing are calculated or not needed",
    ),
    ("gear_unit", "operating_time|load_duration", "shares of time are used only in load cases"),
    (
        "gear_unit",
        "gravit|reference_temperature|shear",
        "weight and thermal shape; used only if a drive train is formed",
    ),
    ("gear_casing|cylindrical_stage", "viscosity", "the viscosity follows from the oil and its temperature"),
    (".*_(relief|crowning|slope)(_.*)?", "", "of modifications only amount, length and shape are used"),
    (
        ".*",
        "chamfer|protuberance|edge_radius|topographical|facewidth_usable|peak_to_valley|valley_height|roughness.*root",
        "chamfers, undercuts, measured flanks and roots are not modelled; of roughness only that of flanks is used",
    ),
    (
        "cylindrical_.*|stage_gear_data|flank_geometry",
        "basic_profile|addendum_modification",
        "the tip diameter or the nominal profile shift is used instead",
    ),
    (
        "cylindrical_.*|stage_gear_data|flank_geometry",
        _SAID_OF_TEETH,
        "follows from the teeth, which are described by other values",
    ),
    (".*", _RESULTS, "a result of the program that wrote the file"),
    (".*", "", "the models have no such input"),
)
"""Reasons why attributes are not used.

An entry has a pattern for the type of the component, a pattern for the name of the attribute, and the reason. The
reason is taken from the first entry in which both patterns match.
"""

CUSTOM = "custom_tribodrive_"
STANDARD_FROM = {"face_load_factor_contact_stress": 2}
"""Result attributes that REXS itself defines, and the major version of REXS that introduced each attribute."""
