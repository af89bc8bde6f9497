"""Results of a pumping calculation, in SI."""

from typing import Literal

from solvers.arrays import FloatArray
from solvers.gears.diameters import Diameters
from solvers.notices import Notice
from solvers.pumping.lead_correction import LeadCorrection
from solvers.pumping.pulsation import Pulsation
from solvers.pumping.space.stroke import StrokeTable
from solvers.quantity import quantity, record
from solvers.sources import MILIAN

ChokingWord = Literal["choked", "not choked", "doubtful"]


@record(equation="L1")
class MeshGeometry(Diameters):
    """Geometry of the gear pair at its centre distance; lengths [m], angles [rad]."""

    centre_distance: float = quantity("centre distance", "a", unit="mm", text="centre distance in use")
    backlash_free_centre_distance: float = quantity(
        "centre distance without backlash", "a_0", unit="mm", equation="pumping#geometry-of-the-tooth-space"
    )
    working_pressure_angle: float = quantity(
        "working transverse pressure angle", "α_wt", unit="deg", text="working transverse pressure angle"
    )
    transverse_contact_ratio: float = quantity("transverse contact ratio", "ε_α", equation="Xue 2")
    normal_backlash: float = quantity(
        "total normal backlash",
        "j_bn",
        unit="um",
        text="normal backlash of centre distance and thinned tooth",
        equation="P1",
    )
    undercut: bool = quantity(
        "undercut", text="whether either gear is undercut", equation="pumping#geometry-of-the-tooth-space"
    )


@record(equation="P2")
class Stroke:
    """One stroke of a tooth space; angles of its gear [rad], 0 on the line of centres, areas in m^2."""

    start: float = quantity("start of the stroke", "φ_s", unit="deg", text="the mating tooth enters")
    contact_start: float = quantity("start of contact", "φ_A", unit="deg", text="the driving flanks touch")
    contact_end: float = quantity("end of contact", "φ_E", unit="deg", text="the driving flanks part")
    end: float = quantity("end of the stroke", "φ_e", unit="deg", text="the mating tooth has left")
    max_area: float = quantity("largest area of the tooth space", "S_A,max", unit="mm2", equation="Milian 5")
    min_area: float = quantity("smallest area of the tooth space", "S_A,min", unit="mm2", equation="Milian 5")
    curves: StrokeTable = quantity("curves of the stroke", detail="curves")


@record(equation="pumping#mass-flows")
class MassFlow:
    """Mass flow out of the tooth spaces of one gear [kg/s].

    Net flows through the five exits, whose sum is 0 (`ExitMasses`), out- and inflow at both ends, uncertainties of net
    flows.
    """

    front: float = quantity("net mass flow at the front", "m_f", unit="g_per_s", text="at the end that meshes first")
    rear: float = quantity("net mass flow at the rear", "m_r", unit="g_per_s", text="at the end that meshes last")
    radial: float = quantity(
        "net radial mass flow",
        "m_rad",
        unit="g_per_s",
        text="through the radial clearances, with what the flanks carry",
    )
    grooves: float = quantity("net mass flow into the grooves", "m_g", unit="g_per_s")
    reset: float = quantity(
        "mass flow of the reset",
        "m_0",
        unit="g_per_s",
        text="gas that a slice gives back between its strokes, with its idle neighbours",
    )
    front_out: float = quantity("mass flow out of the front", "m_f,out", unit="g_per_s", text="while gas leaves there")
    front_in: float = quantity("mass flow into the front", "m_f,in", unit="g_per_s", text="while gas enters there")
    rear_out: float = quantity("mass flow out of the rear", "m_r,out", unit="g_per_s", text="while gas leaves there")
    rear_in: float = quantity("mass flow into the rear", "m_r,in", unit="g_per_s", text="while gas enters there")
    net_uncertainty: float = quantity(
        "uncertainty of the net mass flows",
        "Δm",
        unit="g_per_s",
        text="three times the change at half the resolution; front and rear are small differences of out and in",
        equation="P15",
    )
    radial_uncertainty: float = quantity(
        "uncertainty of the radial mass flow",
        "Δm_rad",
        unit="g_per_s",
        text="three times the change at half the resolution",
        equation="P15",
    )


@record(equation="pumping#numerics")
class Balance:
    """Relative errors of the balances; `energy_error` is None if the model does not conserve energy."""

    mass_error: float = quantity("mass balance error", text="relative error of the mass balance")
    energy_error: float | None = quantity(
        "energy balance error", text="relative error of the energy balance; null if the model conserves no energy"
    )


@record(equation="P15")
class Resolution:
    """Relative uncertainties of the results due to slices, steps (pocket chain) or positions (incompressible).

    Pressures are relative to gauge pressure; none is below the relative jump of the pressure by a jump of the area.
    """

    peak_pressure: float = quantity("uncertainty of the peak pressure", text="of the largest gauge pressure")
    min_pressure: float = quantity("uncertainty of the least pressure", text="of the smallest gauge pressure")
    axial_mach: float = quantity("uncertainty of the axial Mach number")
    pumping_power: float = quantity("uncertainty of the pumping power")
    temperature_rise: float | None = quantity(
        "uncertainty of the temperature rise", text="of the largest temperature rise"
    )
    gross_flow: float = quantity(
        "uncertainty of the gross mass flows", text="of what leaves and what enters at the ends"
    )


@record
class FaceProfile:
    """Curves over the face, (slices,): temperature rises averaged over the stroke [K], and peak pressure ratios."""

    position: FloatArray = quantity("position", "z", unit="mm", text="from the end that meshes first")
    temperature_rise: FloatArray | None = quantity(
        "mean temperature rise",
        "Δθ_0",
        f"{MILIAN}, Figs. 5, 6",
        unit="k",
        text=(
            "mean over the stroke of the stagnation temperature above ambient; counts the axial "
            "speed of the gas, not that of the teeth"
        ),
        axis="position",
    )
    static_temperature_rise: FloatArray | None = quantity(
        "mean static temperature rise",
        "Δθ",
        unit="k",
        text="mean over the stroke of the temperature above ambient",
        axis="position",
    )
    peak_pressure_ratio: FloatArray = quantity(
        "local peak pressure ratio", "p_max/p_e", text="largest pressure over ambient pressure", axis="position"
    )


@record
class GasField:
    """Fields of the gas over angle [rad] and position [m], (angles, slices).

    `temperature_rise` is the rise of the stagnation temperature above the ambient temperature [K].
    """

    angle: FloatArray = quantity(
        "angle of the gear",
        "φ",
        unit="deg",
        text="angle of the gear, zero with the front end's space on the line of centres",
    )
    position: FloatArray = quantity("position of the map", "z", unit="mm", text="from the end that meshes first")
    pressure_ratio: FloatArray = quantity(
        "pressure ratio", "p/p_e", text="pressure over ambient pressure", axis=("angle", "position")
    )
    axial_mach: FloatArray = quantity("axial Mach number", "Ma", axis=("angle", "position"))
    temperature_rise: FloatArray | None = quantity(
        "temperature rise", "Δθ_0", unit="k", text="stagnation temperature above ambient", axis=("angle", "position")
    )


@record(equation="P11")
class EndOfFace:
    """Largest Mach numbers that the pressures ask for at an end of the face; above 1, the flow there is choked.

    Outflow would expand to the ambient pressure, and the air that fills the space to the pressure in the space.
    """

    outflow_mach: float = quantity("Mach number of the outflow", "Ma_out", text="above 1: choked")
    inflow_mach: float = quantity(
        "Mach number of the inflow", "Ma_in", text="of the air that fills the tooth spaces; above 1: choked"
    )
    inflow_choked: bool = quantity("choking of the inflow", text="whether the air that fills the spaces becomes sonic")


@record(equation="P9")
class SpacesResult:
    """Results of the spaces of one gear; None, with a notice, for what the flow model does not give."""

    stroke: Stroke = quantity("stroke", text="one stroke")
    peak_pressure_ratio: float = quantity(
        "peak pressure ratio", "p_max/p_e", text="largest pressure over ambient pressure", equation="P6"
    )
    min_pressure_ratio: float = quantity(
        "least pressure ratio", "p_min/p_e", text="smallest pressure over ambient pressure", equation="P6"
    )
    peak_axial_mach: float = quantity("largest axial Mach number", "Ma_max", text="of slices and ends", equation="P8")
    peak_axial_velocity: float = quantity("largest axial velocity", "U_max", MILIAN, unit="m_per_s", equation="P8")
    radial_choked: bool = quantity(
        "radial choking", None, f"{MILIAN}, Eq. 7", text="whether radial clearances become sonic", equation="P11"
    )
    axial_choked: bool = quantity(
        "axial choking", None, f"{MILIAN}, Eq. 7", text="whether the outflow at an end becomes sonic", equation="P11"
    )
    inflow_choked: bool = quantity(
        "choking of the inflow", text="whether the inflow at an end becomes sonic", equation="P11"
    )
    front_end: EndOfFace = quantity("front end", text="the end that meshes first")
    rear_end: EndOfFace = quantity("rear end", text="the end that meshes last")
    max_temperature_rise: float | None = quantity(
        "largest temperature rise", "Δθ_0,max", MILIAN, unit="k", text="largest of the profile", equation="P10"
    )
    hottest_position: float | None = quantity("hottest position", "z_max", MILIAN, unit="mm", equation="P10")
    pumping_power: float = quantity("pumping power of these spaces", "P", unit="w")
    work_per_space: float = quantity("work per space", "W", unit="j", text="work on the gas of one space in a stroke")
    mass_flow: MassFlow = quantity("mass flow", unit="g_per_s", text="net mass flow out")
    balance: Balance = quantity("balance", text="errors of the balances of mass and energy")
    profile: FaceProfile = quantity("along the face", detail="curves")
    field: GasField = quantity("over angle and position", detail="fields")
    steps: int


@record(equation="P9")
class Totals:
    """Power of the selected spaces, meshing frequency, axial speed of the meshing point (None for spur gears)."""

    pumping_power: float = quantity(
        "pumping power", "P", unit="w", text="of the gears asked for; of double-helical gears, of both helices"
    )
    meshing_frequency: float = quantity("meshing frequency", "f_m", unit="hz")
    axial_meshing_speed: float | None = quantity(
        "axial meshing speed",
        "v_ax",
        unit="m_per_s",
        text="speed of the meshing point along the face; null for spur gears",
    )
    axial_meshing_mach: float | None = quantity(
        "axial meshing Mach number", "Ma_ax", text="over the ambient speed of sound; null for spur gears"
    )


@record(equation="pumping#numerics")
class Derived:
    """Values derived from the inputs."""

    centre_distance: float = quantity("centre distance used", "a", unit="mm", equation="L1")
    slices: int = quantity("slices asked for", "N_0", text="slices or pockets, those of the grooves included")
    rack_tip_radius: float = quantity(
        "root fillet radius used",
        "ρ_fP*",
        text="in normal modules, as far as both racks have room for it",
        equation="pumping#geometry-of-the-tooth-space",
    )
    total_face_width: float | None = quantity(
        "total face width used",
        "2b + e",
        unit="mm",
        text="both helices and the gap; left out without two helices",
        default=None,
        left_out=True,
        equation="L1",
    )


@record(equation="P11")
class Choking:
    """Whether the flow becomes sonic, over the spaces of all gears asked for.

    "doubtful" exactly if a Mach number's band contains 1; slices are doubled until none is, or the speed allows no
    more.
    """

    outflow: ChokingWord = quantity("verdict on the outflow", text="at the ends of the face")
    inflow: ChokingWord = quantity("verdict on the inflow", text="of the air that fills the spaces at the ends")
    clearances: ChokingWord = quantity("verdict on the radial clearances")
    outflow_mach: float = quantity("Mach number of the outflow that decides", "Ma_out", text="above 1: choked")
    outflow_uncertainty: float = quantity("uncertainty of the outflow's Mach number", text="relative")
    inflow_mach: float = quantity("Mach number of the inflow that decides", "Ma_in", text="above 1: choked")
    inflow_uncertainty: float = quantity("uncertainty of the inflow's Mach number", text="relative")
    slices: int = quantity(
        "slices of the verdict",
        "N_v",
        text="slices that the verdict needed; the other results use `slices`",
        equation="P15",
    )


@record(equation="pumping#numerics")
class PumpingResult:
    """Results of a pumping calculation at one operating point.

    `slices` is the number of slices outside the grooves. `lead_correction` is only valid if the pinion warms as much as
    the gas.
    """

    geometry: MeshGeometry = quantity("mesh", text="the mesh")
    pinion_spaces: SpacesResult | None = quantity("pinion spaces", text="spaces of the pinion; null unless asked for")
    wheel_spaces: SpacesResult | None = quantity("wheel spaces", text="spaces of the wheel; null unless asked for")
    total: Totals = quantity("total", text="of all spaces asked for")
    lead_correction: LeadCorrection | None = quantity(
        "lead correction of the pinion", text="of the pinion; null without its temperatures"
    )
    pulsation: Pulsation = quantity("pulsation", text="pulsating mass flow", detail="curves")
    resolution: Resolution = quantity(
        "resolution", text="relative uncertainties, after the grid convergence index of first order"
    )
    choking: Choking = quantity("choking", text="whether the flow becomes sonic, decided by refinement")
    slices: int = quantity("slices in force", "N", text="slices or pockets in force, grooves left out")
    derived: Derived = quantity("distance and slices used")
    warnings: tuple[Notice, ...]


@record
class ChokingCurves:
    """Curves of the coarse scan over the pinion speed [rad/s]: peak pressure ratio and Mach numbers, (speeds,)."""

    pinion_speed: FloatArray = quantity("pinion speed scanned", "n_1", unit="rpm")
    peak_pressure_ratio: FloatArray = quantity(
        "peak pressure ratio", "p_max/p_e", text="largest pressure over ambient pressure", axis="pinion_speed"
    )
    exit_mach: FloatArray = quantity(
        "exit Mach number",
        "Ma_e",
        text="Mach number at which the gas would leave against the ambient pressure; above 1: choked",
        axis="pinion_speed",
    )
    inflow_mach: FloatArray = quantity(
        "inflow Mach number",
        "Ma_in",
        text="Mach number of the air that fills the spaces; above 1: choked",
        axis="pinion_speed",
    )


@record(equation="P11")
class ChokingSpeeds:
    """Lowest pinion speeds [rad/s] at which the flow becomes sonic; None if there is none up to the search limit."""

    radial_choking_speed: float | None = quantity(
        "radial choking speed",
        "n_rad",
        f"{MILIAN}, Eq. 7",
        unit="rpm",
        text="radial clearances become sonic; null beyond the search limit",
    )
    axial_choking_speed: float | None = quantity(
        "axial choking speed",
        "n_ax",
        f"{MILIAN}, Eq. 7",
        unit="rpm",
        text="the outflow at an end becomes sonic; null beyond the search limit",
    )
    inflow_choking_speed: float | None = quantity(
        "inflow choking speed",
        "n_in",
        unit="rpm",
        text="the air that fills the spaces becomes sonic at an end; null beyond the search limit",
    )
    curves: ChokingCurves = quantity("scan of the speeds", detail="curves")
    derived: Derived = quantity("distance and slices used")
    warnings: tuple[Notice, ...]
