"""Pumping: responses of /v1/pumping and /v1/pumping/choking-speed."""

from typing import Annotated

from app.quantities import Output
from app.responses.common import Group, Response

MILIAN = "Milian 2004"
Values = list[float]
Rows = list[list[float]]


class PumpingGeometry(Group):
    """The mesh."""

    centre_distance_mm: Annotated[float, Output("centre distance in use", "a")]
    backlash_free_centre_distance_mm: Annotated[float, Output("centre distance without backlash", "a_0")]
    working_pressure_angle_deg: Annotated[float, Output("working transverse pressure angle", "α_wt")]
    transverse_contact_ratio: Annotated[float, Output("transverse contact ratio", "ε_α")]
    normal_backlash_um: Annotated[float, Output("normal backlash of centre distance and thinned tooth", "j_n")]
    undercut: Annotated[bool, Output("whether either gear is undercut")]


class StrokeCurves(Group):
    """Section of the tooth space over one stroke."""

    angle_deg: Annotated[Values, Output("angle of the space's gear from the line of centres", "φ")]
    area_mm2: Annotated[Values, Output("area left by the mating tooth", "S_A", f"{MILIAN}, Fig. 3")]
    clearance_left_mm: Annotated[Values, Output("clearance of the flank behind", "L_1", f"{MILIAN}, Fig. 3")]
    clearance_right_mm: Annotated[Values, Output("clearance of the flank ahead", "L_2", f"{MILIAN}, Fig. 3")]


class PumpingStroke(Group):
    """One stroke of a tooth space; angles of its gear from the line of centres."""

    start_deg: Annotated[float, Output("the mating tooth enters", "φ_s")]
    contact_start_deg: Annotated[float, Output("the driving flanks touch", "φ_A")]
    contact_end_deg: Annotated[float, Output("the driving flanks part", "φ_E")]
    end_deg: Annotated[float, Output("the mating tooth has left", "φ_e")]
    max_area_mm2: Annotated[float, Output("largest area", "S_A")]
    min_area_mm2: Annotated[float, Output("smallest area", "S_A")]
    curves: Annotated[StrokeCurves | None, Output("over one stroke", detail="curves")] = None


class PumpingMassFlow(Group):
    """Net mass flow out of the tooth spaces, by exit; the five sum to zero."""

    front: Annotated[float, Output("at the end that meshes first")]
    rear: Annotated[float, Output("at the end that meshes last")]
    radial: Annotated[float, Output("through the radial clearances, with what the flanks carry")]
    grooves: Annotated[float, Output("into the grooves")]
    reset: Annotated[float, Output("given back when a slice's stroke ends and begins, with its idle neighbours")]


class PumpingBalance(Group):
    """Relative errors of the books."""

    mass_error: Annotated[float, Output("of mass")]
    energy_error: Annotated[float | None, Output("of energy; null where the model conserves none")]


class PumpingProfile(Group):
    """Along the face, outside the grooves."""

    position_mm: Annotated[Values, Output("from the end that meshes first", "z")]
    temperature_rise_k: Annotated[
        Values | None,
        Output(
            "stroke mean of the stagnation temperature above ambient, by the axial speed alone, not that of the teeth",
            "T_0",
            f"{MILIAN}, Figs. 5, 6",
        ),
    ]
    static_temperature_rise_k: Annotated[Values | None, Output("stroke mean of the temperature above ambient", "T")]
    peak_pressure_ratio: Annotated[Values, Output("largest pressure over ambient pressure", "p/p_e")]


class PumpingField(Group):
    """Over angle and position, indexed [angle][position]."""

    angle_deg: Annotated[Values, Output("angle of the gear, zero with the front end's space on the line of centres")]
    position_mm: Annotated[Values, Output("from the end that meshes first", "z")]
    pressure_ratio: Annotated[Rows, Output("pressure over ambient pressure", "p/p_e")]
    axial_mach: Annotated[Rows, Output("axial Mach number")]
    temperature_rise_k: Annotated[Rows | None, Output("stagnation temperature above ambient", "T_0")]


class PumpingSpaces(Group):
    """The tooth spaces of one gear."""

    stroke: Annotated[PumpingStroke, Output("one stroke")]
    peak_pressure_ratio: Annotated[float, Output("largest pressure over ambient pressure", "p/p_e")]
    min_pressure_ratio: Annotated[float, Output("smallest pressure over ambient pressure", "p/p_e")]
    peak_axial_mach: Annotated[float, Output("largest axial Mach number of slices and ends")]
    peak_axial_velocity_m_per_s: Annotated[float, Output("largest axial velocity", "U", MILIAN)]
    radial_choked: Annotated[bool, Output("whether radial clearances become sonic", None, f"{MILIAN}, Eq. 7")]
    axial_choked: Annotated[bool, Output("whether an end becomes sonic", None, f"{MILIAN}, Eq. 7")]
    max_temperature_rise_k: Annotated[float | None, Output("largest of the profile", "T_0", MILIAN)]
    hottest_position_mm: Annotated[float | None, Output("where", "z", MILIAN)]
    pumping_power_w: Annotated[float, Output("power", "P")]
    work_per_space_j: Annotated[float, Output("work on the gas of one space in a stroke", "W")]
    mass_flow_g_per_s: Annotated[PumpingMassFlow, Output("net mass flow out")]
    balance: Annotated[PumpingBalance, Output("how the books close")]
    profile: Annotated[PumpingProfile | None, Output("along the face", detail="curves")] = None
    field: Annotated[PumpingField | None, Output("over angle and position", detail="fields")] = None


class PumpingTotal(Group):
    """Of all spaces asked for."""

    pumping_power_w: Annotated[float, Output("power", "P")]
    meshing_frequency_hz: Annotated[float, Output("meshing frequency", "f_m")]
    axial_meshing_speed_m_per_s: Annotated[
        float | None, Output("speed of the meshing point along the face; null for spur gears", "v_ax")
    ]
    axial_meshing_mach: Annotated[float | None, Output("over the ambient speed of sound; null for spur gears")]


class LeadCurves(Group):
    """Along the pinion's face."""

    position_mm: Annotated[Values, Output("from the end that meshes first", "z")]
    growth_um: Annotated[Values, Output("thermal growth normal to the flank")]
    correction_um: Annotated[Values, Output("what undoes it")]


class PumpingLeadCorrection(Group):
    """Thermal lead correction of the pinion where the metal warms as much as the gas."""

    range_um: Annotated[float, Output("range of the growth")]
    slope_um: Annotated[float, Output("rise of the parabola fitted to the correction, front to rear")]
    crown_um: Annotated[float, Output("height of its middle above its ends")]
    curves: Annotated[LeadCurves | None, Output("along the face", detail="curves")] = None


class PumpingPulsation(Group):
    """Amplitudes of the mass flow at the ends, at multiples of the meshing frequency."""

    frequency_hz: Annotated[Values, Output("frequency", "k f_m")]
    front_mass_flow_g_per_s: Annotated[Values, Output("at the end that meshes first", "m_k")]
    rear_mass_flow_g_per_s: Annotated[Values, Output("at the end that meshes last", "m_k")]


class PumpingResponse(Response):
    """Pumping at one operating point; sections are missing where there is no solution."""

    geometry: Annotated[PumpingGeometry | None, Output("the mesh")] = None
    pinion_spaces: Annotated[PumpingSpaces | None, Output("spaces of the pinion; null unless asked for")] = None
    wheel_spaces: Annotated[PumpingSpaces | None, Output("spaces of the wheel; null unless asked for")] = None
    total: Annotated[PumpingTotal | None, Output("of all spaces asked for")] = None
    lead_correction: Annotated[PumpingLeadCorrection | None, Output("of the pinion; null without its temperatures")] = (
        None
    )
    pulsation: Annotated[PumpingPulsation | None, Output("pulsating mass flow", detail="curves")] = None
    slices: Annotated[int | None, Output("slices or pockets in force, grooves left out", "N")] = None


class ChokingCurves(Group):
    """What a coarse scan saw, the largest over the spaces asked for."""

    pinion_speed_rpm: Annotated[Values, Output("pinion speed", "n_1")]
    peak_pressure_ratio: Annotated[Values, Output("largest pressure over ambient pressure", "p/p_e")]
    exit_mach: Annotated[Values, Output("Mach number that the ambient pressure asks for at the ends; above 1: choked")]


class ChokingSpeedResponse(Response):
    """Lowest pinion speeds with sonic flow in any of the spaces asked for."""

    radial_choking_speed_rpm: Annotated[
        float | None, Output("radial clearances become sonic; null beyond the search limit", None, f"{MILIAN}, Eq. 7")
    ] = None
    axial_choking_speed_rpm: Annotated[
        float | None, Output("an end becomes sonic; null beyond the search limit", None, f"{MILIAN}, Eq. 7")
    ] = None
    curves: Annotated[ChokingCurves | None, Output("scan of the speeds", detail="curves")] = None
