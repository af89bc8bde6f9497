"""The rules by which an endpoint may refuse a request that fits the schema of the endpoint.

If an endpoint refuses such a request for any other reason, the schema has a fault. Schemathesis loads this module as
its hooks (`schemathesis.toml`).
"""

import re
from typing import Any

import schemathesis

STUDIES = "/v1/(sweep|solve-for|sensitivity|spectrum|drive-train/(corners|design))$"
RULES = {
    # One of several ways to say a thing, and what one of them needs.
    "/v1/(coupling|scuffing|drive-train)": (
        "exclusive two_viscosities missing_property no_oil oil_too_thick viscosity_index viscosity_order"
    ),
    "/v1/(scuffing|drive-train)": (
        "torque_or_power load_missing missing_bulk missing_friction oil_temperature scuffing_temperature contact_law "
        "lead_curve root_circle overlap_range viscosity_range"
    ),
    # Gears that cannot be made or do not mesh.
    "/v1/(pumping|scuffing|drive-train)": (
        "pointed_tooth pointed_rack no_tip_clearance no_mesh no_involute no_contact flank_interference "
        "involute_interference form_diameter negative_backlash too_few_teeth exclusive tip_diameter missing_property "
        "double_helical_spur"
    ),
    "/v1/coupling": (
        "misalignment_or_offset pitch_errors_length mixed_law mixed_curve misalignment_range no_load not_turning "
        "no_contact_to_scan torque_too_low hertz_pressure contact_width"
    ),
    "/v1/pumping": (
        "groove_outside groove_overlap grooves_incompressible always_choked choking_not_modelled slices_incompressible "
        "helix_incompressible incompressible_vacuum discharge_coefficient isentropic_exponent face_width narrow_land "
        "too_few_slices too_many_steps tooth_space_closed tooth_space_minima speed_not_positive"
    ),
    "/v1/scuffing/line-contact": (
        "no_load no_entrainment stationary_surface load_range film_range pressure_range temperature_range "
        "viscosity_range resolution"
    ),
    "/v1/drive-train": (
        "bearing_data bearing_count bearing_distance bearing_order bearing_outside couplings_on_shaft face_outside "
        "machine_side position_outside section_diameter stiffness_matrix thrust_collar_radius torque_position "
        "thrust_collar_double_helical"
    ),
    # Too large or small together, as an offset for its length, or a calculation longer than its deadline.
    "/v1/": "out_of_range unbelievable too_many_objects cannot_finish",
    # Figures of what the case does not have.
    ".*/figures/": (
        "no_modification no_misalignment no_lead_correction no_load no_oil no_solution no_temperature no_rise "
        "no_scuffing_temperature no_plain_bearing no_coupling isothermal closed_form not_asked no_film no_wear"
    ),
    # What names fields of another endpoint.
    STUDIES: (
        "unknown_endpoint unknown_path unknown_output duplicate_path not_scalar not_continuous not_integer "
        "too_many_points shares above_or_below value_or_mean vary_cases_or_sample values_or_range values_per_field "
        "ranges_or_inputs minimise_or_maximise equals_or_extreme not_power_of_two log_needs_positive no_corners "
        "direction_missing variable_range variable_step path_type scalar_type"
    ),
    "/v1/rexs": "not_rexs unknown_stage",
}


@schemathesis.check
def refused_by_a_known_rule(context: Any, response: Any, case: Any) -> None:
    """Fail if an endpoint refuses a request that fits the schema, and `RULES` does not list the code for this endpoint.

    In a study, any fault is allowed inside `request` and `cases`, because the schema leaves their content open.
    """
    del context
    if response.status_code != 422 or case.meta is None or not case.meta.generation.mode.is_positive:
        return
    path = case.operation.path
    known = {code for pattern, codes in RULES.items() if re.match(pattern, path) for code in codes.split()}
    for fault in response.json()["errors"]:
        inside = re.match(STUDIES, path) and re.match(r"/(request|cases/\d+)(/|$)", fault["pointer"])
        if not inside and fault["code"] not in known:
            raise AssertionError(f"{path} refuses what fits its schema: {fault}")
