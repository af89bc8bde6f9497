"""What happens in the tooth spaces of one gear."""

from typing import Annotated, ClassVar

from app.responses.common import Group
from app.schema.quantities import Output
from solvers.quantity import UNITS

MILIAN = "Milian 2004"
FIG_3 = f"{MILIAN}, Fig. 3"
FIGS_5_6 = f"{MILIAN}, Figs. 5, 6"
EQ_7 = f"{MILIAN}, Eq. 7"
Values = list[float]
Rows = list[list[float]]
MAP = ("angle_deg", "position_mm")


class StrokeCurves(Group):
    """Section of the tooth space over one stroke."""

    angle_deg: Annotated[
        Values, Output("angle of the tooth space", "φ", text="angle of the space's gear from the line of centres")
    ]
    area_mm2: Annotated[
        Values, Output("area of the tooth space", "S_A", FIG_3, text="area left by the mating tooth", axis="angle_deg")
    ]
    clearance_left_mm: Annotated[
        Values,
        Output("left clearance", "L_1", FIG_3, text="clearance of the flank behind", axis="angle_deg"),
    ]
    clearance_right_mm: Annotated[
        Values,
        Output("right clearance", "L_2", FIG_3, text="clearance of the flank ahead", axis="angle_deg"),
    ]


class PumpingStroke(Group):
    """One stroke of a tooth space; angles of its gear from the line of centres."""

    start_deg: Annotated[float, Output("start of the stroke", "φ_s", text="the mating tooth enters")]
    contact_start_deg: Annotated[float, Output("start of contact", "φ_A", text="the driving flanks touch")]
    contact_end_deg: Annotated[float, Output("end of contact", "φ_E", text="the driving flanks part")]
    end_deg: Annotated[float, Output("end of the stroke", "φ_e", text="the mating tooth has left")]
    max_area_mm2: Annotated[float, Output("largest area of the tooth space", "S_A,max")]
    min_area_mm2: Annotated[float, Output("smallest area of the tooth space", "S_A,min")]
    curves: Annotated[StrokeCurves | None, Output("curves of the stroke", detail="curves")] = None


class PumpingMassFlow(Group):
    """Mass flow out of the tooth spaces: net by exit, the first five sum to zero; gross at the ends."""

    member_unit: ClassVar = UNITS["g_per_s"]

    front: Annotated[float, Output("net mass flow at the front", "m_f", text="at the end that meshes first")]
    rear: Annotated[float, Output("net mass flow at the rear", "m_r", text="at the end that meshes last")]
    radial: Annotated[
        float,
        Output("net radial mass flow", "m_rad", text="through the radial clearances, with what the flanks carry"),
    ]
    grooves: Annotated[float, Output("net mass flow into the grooves", "m_g")]
    reset: Annotated[
        float,
        Output(
            "mass flow of the reset",
            "m_0",
            text="given back when a slice's stroke ends and begins, with its idle neighbours",
        ),
    ]
    front_out: Annotated[float, Output("mass flow out of the front", "m_f,out", text="while gas leaves there")]
    front_in: Annotated[float, Output("mass flow into the front", "m_f,in", text="while gas enters there")]
    rear_out: Annotated[float, Output("mass flow out of the rear", "m_r,out", text="while gas leaves there")]
    rear_in: Annotated[float, Output("mass flow into the rear", "m_r,in", text="while gas enters there")]
    net_uncertainty: Annotated[
        float,
        Output(
            "uncertainty of the net mass flows",
            "Δm",
            text="of front and rear, small differences of out and in: three times what half the resolution changes",
        ),
    ]
    radial_uncertainty: Annotated[
        float,
        Output(
            "uncertainty of the radial mass flow", "Δm_rad", text="three times what half the resolution changes of it"
        ),
    ]


class PumpingBalance(Group):
    """Relative errors of the books."""

    mass_error: Annotated[float, Output("mass balance error", text="relative error of the books on mass")]
    energy_error: Annotated[
        float | None,
        Output("energy balance error", text="relative error of the books on energy; null where none is conserved"),
    ]


class PumpingProfile(Group):
    """Along the face, outside the grooves."""

    position_mm: Annotated[Values, Output("position", "z", text="from the end that meshes first")]
    temperature_rise_k: Annotated[
        Values | None,
        Output(
            "mean temperature rise",
            "Δθ_0",
            FIGS_5_6,
            text="stroke mean of the stagnation temperature above ambient, by the axial speed alone, not that of the "
            "teeth",
            axis="position_mm",
        ),
    ]
    static_temperature_rise_k: Annotated[
        Values | None,
        Output(
            "mean static temperature rise",
            "Δθ",
            text="stroke mean of the temperature above ambient",
            axis="position_mm",
        ),
    ]
    peak_pressure_ratio: Annotated[
        Values,
        Output(
            "local peak pressure ratio",
            "p_max/p_e",
            text="largest pressure over ambient pressure",
            axis="position_mm",
        ),
    ]


class PumpingField(Group):
    """Over angle and position, indexed [angle][position]."""

    angle_deg: Annotated[
        Values,
        Output(
            "angle of the gear", "φ", text="angle of the gear, zero with the front end's space on the line of centres"
        ),
    ]
    position_mm: Annotated[Values, Output("position of the map", "z", text="from the end that meshes first")]
    pressure_ratio: Annotated[Rows, Output("pressure ratio", "p/p_e", text="pressure over ambient pressure", axis=MAP)]
    axial_mach: Annotated[Rows, Output("axial Mach number", "Ma", axis=MAP, limit=1.0)]
    temperature_rise_k: Annotated[
        Rows | None, Output("temperature rise", "Δθ_0", text="stagnation temperature above ambient", axis=MAP)
    ]


class PumpingSpaces(Group):
    """The tooth spaces of one gear."""

    stroke: Annotated[PumpingStroke, Output("stroke", text="one stroke")]
    peak_pressure_ratio: Annotated[
        float,
        Output("peak pressure ratio", "p_max/p_e", text="largest pressure over ambient pressure", headline=3),
    ]
    min_pressure_ratio: Annotated[
        float, Output("least pressure ratio", "p_min/p_e", text="smallest pressure over ambient pressure")
    ]
    peak_axial_mach: Annotated[
        float, Output("largest axial Mach number", "Ma_max", text="of slices and ends", limit=1.0)
    ]
    peak_axial_velocity_m_per_s: Annotated[float, Output("largest axial velocity", "U_max", MILIAN)]
    radial_choked: Annotated[bool, Output("radial choking", None, EQ_7, text="whether radial clearances become sonic")]
    axial_choked: Annotated[bool, Output("axial choking", None, EQ_7, text="whether an end becomes sonic")]
    max_temperature_rise_k: Annotated[
        float | None,
        Output("largest temperature rise", "Δθ_0,max", MILIAN, text="largest of the profile", headline=2),
    ]
    hottest_position_mm: Annotated[float | None, Output("hottest position", "z_max", MILIAN)]
    pumping_power_w: Annotated[float, Output("pumping power of these spaces", "P")]
    work_per_space_j: Annotated[float, Output("work per space", "W", text="work on the gas of one space in a stroke")]
    mass_flow_g_per_s: Annotated[PumpingMassFlow, Output("mass flow", text="net mass flow out")]
    balance: Annotated[PumpingBalance, Output("balance", text="how the books close")]
    profile: Annotated[PumpingProfile | None, Output("along the face", detail="curves")] = None
    field: Annotated[PumpingField | None, Output("over angle and position", detail="fields")] = None
