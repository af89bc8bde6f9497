"""Pumping: responses of /v1/pumping and /v1/pumping/choking-speed."""

from typing import Annotated

from app.responses.common import Derived, Group, Response
from app.responses.pumping_spaces import EQ_7, PumpingSpaces, Values
from app.schema.quantities import Output


class PumpingDerived(Derived):
    """Centre distance and resolution, where the request left them open."""

    centre_distance_mm: Annotated[float, Output("centre distance used", "a")]
    slices: Annotated[int, Output("slices asked for", "N_0", text="slices or pockets, those of the grooves included")]
    rack_tip_radius: Annotated[
        float, Output("rack tip radius used", "ρ_fP*", text="in normal modules, as far as both racks have room for it")
    ]


class PumpingGeometry(Group):
    """The mesh."""

    centre_distance_mm: Annotated[float, Output("centre distance", "a", text="centre distance in use")]
    backlash_free_centre_distance_mm: Annotated[float, Output("centre distance without backlash", "a_0")]
    working_pressure_angle_deg: Annotated[
        float, Output("working pressure angle", "α_wt", text="working transverse pressure angle")
    ]
    transverse_contact_ratio: Annotated[float, Output("transverse contact ratio", "ε_α")]
    normal_backlash_um: Annotated[
        float, Output("normal backlash", "j_n", text="normal backlash of centre distance and thinned tooth")
    ]
    undercut: Annotated[bool, Output("undercut", text="whether either gear is undercut")]


class PumpingTotal(Group):
    """Of all spaces asked for."""

    pumping_power_w: Annotated[float, Output("pumping power", "P", headline=1)]
    meshing_frequency_hz: Annotated[float, Output("meshing frequency", "f_m")]
    axial_meshing_speed_m_per_s: Annotated[
        float | None,
        Output("axial meshing speed", "v_ax", text="speed of the meshing point along the face; null for spur gears"),
    ]
    axial_meshing_mach: Annotated[
        float | None,
        Output("axial meshing Mach number", "Ma_ax", text="over the ambient speed of sound; null for spur gears"),
    ]


class LeadCurves(Group):
    """Along the pinion's face."""

    position_mm: Annotated[Values, Output("position on the pinion", "z", text="from the end that meshes first")]
    growth_um: Annotated[
        Values,
        Output(
            "thermal growth",
            "d",
            text="thermal growth along the transverse line of action, of radius and length",
            axis="position_mm",
        ),
    ]
    radial_only_um: Annotated[
        Values, Output("radial thermal growth", "d_r", text="the part of the larger radius alone", axis="position_mm")
    ]
    correction_um: Annotated[Values, Output("lead correction", "C", text="what undoes the growth", axis="position_mm")]


class PumpingLeadCorrection(Group):
    """Thermal lead correction of the pinion where the metal warms as much as the gas."""

    range_um: Annotated[float, Output("range of the thermal growth", "C_r")]
    slope_um: Annotated[
        float,
        Output("slope of the lead correction", "C_H", text="rise of the fitted parabola, front to rear"),
    ]
    crown_um: Annotated[
        float, Output("crown of the lead correction", "C_c", text="height of its middle above its ends")
    ]
    curves: Annotated[LeadCurves | None, Output("along the pinion's face", detail="curves")] = None


class PumpingPulsation(Group):
    """Amplitudes of the mass flow at the ends, at multiples of the meshing frequency."""

    frequency_hz: Annotated[Values, Output("pulsation frequency", "k f_m")]
    front_mass_flow_g_per_s: Annotated[
        Values,
        Output("front mass flow amplitude", "m_f,k", text="at the end that meshes first", axis="frequency_hz"),
    ]
    rear_mass_flow_g_per_s: Annotated[
        Values,
        Output("rear mass flow amplitude", "m_r,k", text="at the end that meshes last", axis="frequency_hz"),
    ]


class PumpingResolution(Group):
    """Relative uncertainties by what half and a quarter of the slices, steps or positions change."""

    peak_pressure: Annotated[float, Output("uncertainty of the peak pressure", text="of the largest gauge pressure")]
    min_pressure: Annotated[float, Output("uncertainty of the least pressure", text="of the smallest gauge pressure")]
    axial_mach: Annotated[float, Output("uncertainty of the axial Mach number")]
    pumping_power: Annotated[float, Output("uncertainty of the pumping power")]
    temperature_rise: Annotated[
        float | None, Output("uncertainty of the temperature rise", text="of the largest temperature rise")
    ]
    gross_flow: Annotated[
        float, Output("uncertainty of the gross mass flows", text="of what leaves and what enters at the ends")
    ]


class PumpingResponse(Response):
    """Pumping at one operating point; sections are missing where there is no solution."""

    geometry: Annotated[PumpingGeometry | None, Output("mesh", text="the mesh")] = None
    pinion_spaces: Annotated[
        PumpingSpaces | None, Output("pinion spaces", text="spaces of the pinion; null unless asked for")
    ] = None
    wheel_spaces: Annotated[
        PumpingSpaces | None, Output("wheel spaces", text="spaces of the wheel; null unless asked for")
    ] = None
    total: Annotated[PumpingTotal | None, Output("total", text="of all spaces asked for")] = None
    lead_correction: Annotated[
        PumpingLeadCorrection | None,
        Output("lead correction of the pinion", text="of the pinion; null without its temperatures"),
    ] = None
    pulsation: Annotated[PumpingPulsation | None, Output("pulsation", text="pulsating mass flow", detail="curves")] = (
        None
    )
    resolution: Annotated[
        PumpingResolution | None,
        Output("resolution", text="relative uncertainties, after the grid convergence index of first order"),
    ] = None
    slices: Annotated[
        int | None, Output("slices in force", "N", text="slices or pockets in force, grooves left out")
    ] = None
    derived: Annotated[PumpingDerived | None, Output("distance and slices used")] = None


class ChokingCurves(Group):
    """What a coarse scan saw, the largest over the spaces asked for."""

    pinion_speed_rpm: Annotated[Values, Output("pinion speed scanned", "n_1")]
    peak_pressure_ratio: Annotated[
        Values,
        Output(
            "peak pressure ratio",
            "p_max/p_e",
            text="largest pressure over ambient pressure",
            axis="pinion_speed_rpm",
        ),
    ]
    exit_mach: Annotated[
        Values,
        Output(
            "exit Mach number",
            "Ma_e",
            text="Mach number that the ambient pressure asks for at the ends; above 1: choked",
            axis="pinion_speed_rpm",
            limit=1.0,
        ),
    ]


class ChokingSpeedResponse(Response):
    """Lowest pinion speeds with sonic flow in any of the spaces asked for."""

    radial_choking_speed_rpm: Annotated[
        float | None,
        Output(
            "radial choking speed",
            "n_rad",
            EQ_7,
            text="radial clearances become sonic; null beyond the search limit",
            headline=1,
            limit="search_limit_rpm",
        ),
    ] = None
    axial_choking_speed_rpm: Annotated[
        float | None,
        Output(
            "axial choking speed",
            "n_ax",
            EQ_7,
            text="an end becomes sonic; null beyond the search limit",
            headline=2,
            limit="search_limit_rpm",
        ),
    ] = None
    curves: Annotated[ChokingCurves | None, Output("scan of the speeds", detail="curves")] = None
    derived: Annotated[PumpingDerived | None, Output("distance and slices used")] = None
