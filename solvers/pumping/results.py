"""What a pumping calculation gives back, SI."""

from dataclasses import dataclass

from solvers.arrays import FloatArray
from solvers.notices import Notice
from solvers.pumping.lead_correction import LeadCorrection
from solvers.pumping.pulsation import Pulsation
from solvers.pumping.space.stroke import StrokeTable


@dataclass(frozen=True, slots=True)
class MeshGeometry:
    """The pair as meshed; lengths [m], angle [rad]."""

    centre_distance: float
    backlash_free_centre_distance: float
    working_pressure_angle: float
    transverse_contact_ratio: float
    normal_backlash: float
    undercut: bool


@dataclass(frozen=True, slots=True)
class Stroke:
    """One stroke of a tooth space: angles of its gear from the line of centres [rad], areas [m^2]."""

    start: float
    contact_start: float
    contact_end: float
    end: float
    max_area: float
    min_area: float
    curves: StrokeTable


@dataclass(frozen=True, slots=True)
class MassFlow:
    """Mass flow out of the spaces of one gear [kg/s].

    Net by exit: the first five sum to nought, see `ExitMasses`. What leaves and what enters at each end. And how far
    the net flows of the ends, small differences of these, and the radial one may be off by their resolution.
    """

    front: float
    rear: float
    radial: float
    grooves: float
    reset: float
    front_out: float
    front_in: float
    rear_out: float
    rear_in: float
    net_uncertainty: float
    radial_uncertainty: float


@dataclass(frozen=True, slots=True)
class Balance:
    """Relative errors of the books; `energy_error` is None where the model conserves no energy."""

    mass_error: float
    energy_error: float | None


@dataclass(frozen=True, slots=True)
class Resolution:
    """Relative uncertainties of the summary by its resolution, pressures as gauge pressures; see `resolution`.

    Slices of gas dynamics, steps of the chain, positions of the single pocket; at least what a jump of the area alone
    would compress. `temperature_rise` is None where the flow model gives none; net flows state theirs.
    """

    peak_pressure: float
    min_pressure: float
    axial_mach: float
    pumping_power: float
    temperature_rise: float | None
    gross_flow: float


@dataclass(frozen=True, slots=True)
class FaceProfile:
    """Over the face, (slices,): stroke means of the rise of stagnation and static temperature [K], peak pressures."""

    position: FloatArray
    temperature_rise: FloatArray | None
    static_temperature_rise: FloatArray | None
    peak_pressure_ratio: FloatArray


@dataclass(frozen=True, slots=True)
class GasField:
    """The gas over angle [rad] and position [m], (angles, slices); `temperature_rise` [K] of stagnation."""

    angle: FloatArray
    position: FloatArray
    pressure_ratio: FloatArray
    axial_mach: FloatArray
    temperature_rise: FloatArray | None


@dataclass(frozen=True, slots=True)
class SpacesResult:
    """The spaces of one gear: power [W], work per space and stroke [J], `mass_flow` [kg/s], temperatures [K].

    Pressures are ratios to the ambient one. None where the flow model gives no such value; a notice says so.
    """

    stroke: Stroke
    peak_pressure_ratio: float
    min_pressure_ratio: float
    peak_axial_mach: float
    peak_axial_velocity: float
    radial_choked: bool
    axial_choked: bool
    max_temperature_rise: float | None
    hottest_position: float | None
    pumping_power: float
    work_per_space: float
    mass_flow: MassFlow
    balance: Balance
    profile: FaceProfile
    field: GasField
    steps: int


@dataclass(frozen=True, slots=True)
class Totals:
    """Power of all spaces asked for [W], meshing frequency [Hz], speed of the meshing point along the face [m/s].

    `axial_meshing_mach` refers it to the ambient speed of sound; both are None for spur gears, whose whole face meshes
    at once.
    """

    pumping_power: float
    meshing_frequency: float
    axial_meshing_speed: float | None
    axial_meshing_mach: float | None


@dataclass(frozen=True, slots=True)
class Derived:
    """What follows from the inputs before any physics: centre distance [m], slices with the grooves' parts.

    rack_tip_radius is what both racks have room for, in normal modules.
    """

    centre_distance: float
    slices: int
    rack_tip_radius: float


@dataclass(frozen=True, slots=True)
class PumpingResult:
    """One operating point. `slices` is the number in force; `lead_correction` is for the pinion, wall response 1."""

    geometry: MeshGeometry
    pinion_spaces: SpacesResult | None
    wheel_spaces: SpacesResult | None
    total: Totals
    lead_correction: LeadCorrection | None
    pulsation: Pulsation
    resolution: Resolution
    slices: int
    derived: Derived
    warnings: tuple[Notice, ...]


@dataclass(frozen=True, slots=True)
class ChokingCurves:
    """Coarse scan, (speeds,): peak pressure ratio and Mach number asked for at the ends over pinion speed [rad/s]."""

    pinion_speed: FloatArray
    peak_pressure_ratio: FloatArray
    exit_mach: FloatArray


@dataclass(frozen=True, slots=True)
class ChokingSpeeds:
    """Pinion speeds [rad/s] at which the flow becomes sonic: None beyond the search limit."""

    radial_choking_speed: float | None
    axial_choking_speed: float | None
    curves: ChokingCurves
    derived: Derived
    warnings: tuple[Notice, ...]
