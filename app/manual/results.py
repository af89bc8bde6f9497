"""The places in the manual that say how the results are computed.

A place is a numbered equation, or a section if no equation defines the result. Results without an equation are, for
example, counts, the settings that were used, and measures of convergence.
"""

from functools import cache
from typing import NamedTuple

from app.manual.equations import equations
from solvers.quantity import Quantity

PLACES = {
    "coupling.results.Geometry": "C1; pitch_radius crowning_radius: coupling#geometry",
    "coupling.results.Kinematics": (
        "C2; max_contact_travel: C3; max_hydrodynamic_velocity: C6; tangential_displacement_peak_to_peak: C5"
    ),
    "coupling.results.LoadDistribution": (
        "C7; mean_tangential_force unloading_misalignment: C10; rotation: C8; sleeve_displacement iterations: C9"
    ),
    "coupling.results.Lubrication": (
        "C12; contact_overlap load_capacity_coefficient: C13; inlet_ratio hydrodynamic_capacity: C14; "
        "inlet_factor: C16; friction_coefficient: C18"
    ),
    "coupling.results.Regime": "coupling#friction",
    "coupling.results.AxialThrust": (
        "C19; coaxial_limit breakaway_force design_force fraction_of_limit customary_force: C20; "
        "uniform_load_force: C21"
    ),
    "coupling.results.SelfInducedThrust": "C22; simple_model_force: C23; uniform_load_force: C24",
    "coupling.results.Losses": "C25; contact_shift_moment: C27; hub_bending_moment: C28",
    "coupling.results.Limits": ("C31; sliding_velocity_limit allowable_misalignment: C29; sleeve_centring_torque: C30"),
    "coupling.inputs.Coupling": "coupling#geometry; tooth_stiffness: C7",
    "coupling.results.Derived": "R3; viscosity_index: R2",
    "coupling.results.InertiaForce": "C11",
    "coupling.results.OrbitResult": "C11",
    "coupling.crowning.Recommendation": "C32",
    "coupling.crowning.RecommendedPoint": "C13; friction_coefficient: C18; axial_thrust: C19; sliding_velocity: C2",
    "pumping.results.MeshGeometry": (
        "L1; transverse_contact_ratio: Xue 2; normal_backlash: P1; pinion_tip_diameter wheel_tip_diameter "
        "pinion_root_diameter wheel_root_diameter undercut backlash_free_centre_distance: "
        "pumping#geometry-of-the-tooth-space"
    ),
    "pumping.results.Stroke": "P2; max_area min_area: Milian 5",
    "pumping.results.SpacesResult": (
        "P9; peak_pressure_ratio min_pressure_ratio: P6; peak_axial_mach peak_axial_velocity: P8; "
        "radial_choked axial_choked inflow_choked: P11; max_temperature_rise hottest_position: P10"
    ),
    "pumping.results.EndOfFace": "P11",
    "pumping.results.Choking": "P11; slices: P15",
    "pumping.results.MassFlow": "pumping#mass-flows; net_uncertainty radial_uncertainty: P15",
    "pumping.results.Balance": "pumping#numerics",
    "pumping.results.Totals": "P9",
    "pumping.lead_correction.LeadCorrection": "P12",
    "pumping.pulsation.Pulsation": "P13",
    "pumping.results.Resolution": "P15",
    "pumping.results.PumpingResult": "pumping#numerics",
    "pumping.results.Derived": (
        "pumping#numerics; centre_distance: L1; rack_tip_radius: pumping#geometry-of-the-tooth-space"
    ),
    "pumping.results.ChokingSpeeds": "P11",
    "scuffing.results.Geometry": (
        "L1; path_of_contact: L2; transverse_contact_ratio: Xue 2; overlap_ratio total_contact_ratio: Xue 3; "
        "base_helix_angle transverse_base_pitch pinion_tip_diameter wheel_tip_diameter pinion_root_diameter "
        "wheel_root_diameter undercut: load-distribution#geometry"
    ),
    "scuffing.results.ContactLines": "Xue 4",
    "scuffing.results.Stiffness": "Xue 7; mean_mesh: L15; standard_single standard_mesh: L16",
    "scuffing.results.TransmissionError": "L18",
    "scuffing.results.LoadOnFlank": (
        "Xue 1; max_line_load contact_fraction pair_share: Xue 9; balance_error: Xue 11; face_load_factor: L17"
    ),
    "scuffing.results.Place": "Xue 9",
    "scuffing.results.Pressure": "Xue 14",
    "scuffing.results.FrictionLoss": "L19; coefficient: R10",
    "scuffing.results.Derived": (
        "Xue 1; centre_distance: L1; tip_relief_length root_relief_length end_relief_length: L11; "
        "rack_tip_radius: load-distribution#geometry"
    ),
    "scuffing.safety_results.Flash": (
        "Xue 25; blok_at_psi thermal_ehl_at_psi: S1; thermal_ehl_max thermal_ehl_at_profile thermal_ehl_at_face: "
        "Xue 16; friction_coefficient: R5"
    ),
    "scuffing.safety_results.ContactTemperature": "Xue 16; bulk: R8",
    "scuffing.safety_results.Film": (
        "Xue 27; thickness_ratio thickness_regime: Xue 28; thermal_ehl_min: scuffing#film; min_at_psi: S1"
    ),
    "scuffing.safety_results.Safety": "Xue 26; scuffing: R9",
    "scuffing.safety_results.Scuffing": "scuffing#numerics",
    "scuffing.safety_results.ScuffingDerived": "R1; density_15: R3; lubricant_factor: R9",
    "scuffing.micropitting.results.Micropitting": "M14",
    "scuffing.micropitting.results.FilmOfTest": "M14; bulk: M11; friction_coefficient: M9",
    "scuffing.micropitting.results.LocalFilm": (
        "M7; friction_coefficient: M9; at_psi at_face thermal_ehl_ratio: micropitting#method-a-the-own-load"
    ),
    "scuffing.micropitting.results.LocalPoint": "M7; point psi: micropitting#method-a-the-own-load",
    "scuffing.micropitting.results.StandardFilm": "M7; friction_coefficient: M9; bulk: M11; loss_factor: M10",
    "scuffing.micropitting.results.StandardPoint": (
        "M7; point: micropitting#method-b-the-standard; force_ratio: M12; pressure: M13; flash: M4; film: M6"
    ),
    "scuffing.micropitting.results.Wear": "M15",
    "heat_balance.results.GearTemperatures": (
        "H18; friction: H7; oil_conductance flooded_conductance turn_film oil_limited: H5; film: H4"
    ),
    "heat_balance.results.Heat": (
        "H18; drain drain_deviation: H20; gear_flow: H11; total_flow: H12; wetting_share: H4; friction_to_pinion: H7; "
        "wheel_deviation: H19; backlash_loss: H22"
    ),
    "heat_balance.results.BearingHeat": "H18; film oil_flow: H12; friction_power: D5",
    "heat_balance.results.HeatFlow": "heat-balance#network",
    "heat_balance.results.HeatLosses": (
        "H6; oil_acceleration jets: H9; windage: H8; bearings: D5; couplings: D9; "
        "pumping other total: heat-balance#losses"
    ),
    "heat_balance.results.Balance": "H17",
    "heat_balance.results.BulkEstimates": "R8; iso_ts_6336_22_bulk: H13",
    "heat_balance.results.HeatBand": "H21",
    "heat_balance.results.CoolingInForce": (
        "H11; wetting_share: H4; rewetting_share: heat-balance#network; fling_off_factor: H5; windage: H8; "
        "other: heat-balance#losses"
    ),
    "lubricants.OilInUse": (
        "practice#oils; viscosity density: R3; viscosity_index: R2; "
        "pressure_viscosity temperature_viscosity specific_heat thermal_conductivity: R4"
    ),
    "contact.ehl.results.HertzContact": "E1",
    "contact.ehl.results.Dimensionless": (
        "E2; slide_roll_ratio: line-contact#hertz-contact-and-similarity; peclet_1 peclet_2: E11"
    ),
    "contact.ehl.results.FilmThickness": "Xue 21",
    "contact.ehl.results.ContactPressure": "E7",
    "contact.ehl.results.ContactTemperature": "Xue 24; film_max: E8",
    "contact.ehl.results.ContactFriction": "E9",
    "contact.ehl.results.ContactHeat": "E10",
    "contact.ehl.results.MeshError": "line-contact#numerics",
    "contact.ehl.results.Convergence": "line-contact#numerics; departure: E12",
    "contact.ehl.results.Derived": "E1; entrainment_speed: Xue 18",
    "drive_train.results.Misalignment": "D13; thermal_profile_slope base_pitch: D10",
    "drive_train.results.Parts": "D3",
    "drive_train.results.FaceLoad": (
        "L17; face_load_at: drive-train#results; max_line_load contact_fraction: Xue 9; max_pressure: Xue 14; "
        "transmission_error_pp: L18"
    ),
    "drive_train.results.BearingResult": "D5; reaction displacement: drive-train#bearings; eccentricity_ratio: D4",
    "drive_train.shafts.thrust_budget.Thrust": "D14; coupling: D7; coupling_limit: C20",
    "drive_train.results.CouplingResult": (
        "D6; tilt: D12; stuck: D8; friction_share friction_power: D9; thrust: D7; thrust_limit: C20; "
        "friction_coefficient: C18"
    ),
    "drive_train.results.FlashPlaces": "D15; friction_coefficient: R5",
    "drive_train.results.TrainSafety": "D15",
    "drive_train.results.TrainLosses": (
        "drive-train#results; coupling: D9; pumping: P9; bearings: D5; oil_acceleration: H9; windage: H8; "
        "other: heat-balance#losses"
    ),
    "drive_train.results.ForceBalance": "drive-train#bearings",
    "drive_train.results.Convergence": "D11",
    "scuffing.safety_results.BulkInForce": "H25; bulk_estimate: R8; bulk_balance: H18",
    "drive_train.derived.DerivedTemperatures": "D15; scuffing lubricant_factor: R9",
    "drive_train.derived.Derived": "Xue 1",
    "drive_train.derived.DerivedShaft": "drive-train#shafts",
    "drive_train.derived.DerivedSection": "D16",
    "drive_train.derived.DerivedBearing": "D4",
    "drive_train.derived.DerivedCoupling": "R3; viscosity_index: R2; axial_tooth_stiffness: D8",
    "drive_train.derived.DerivedHeat": "D10",
    "heat_balance.warm_up.WarmUp": "H24",
    "drive_train.warm_up.UnitWarmUp": "H24; least_backlash: H22",
}
"""Targets in the manual, to which the numbers in the solvers' dataclasses lead. The keys are the dataclasses.

A target is the number of an equation, such as "D15", or a section of a chapter, such as "drive-train#shafts". In
"D15; scuffing lubricant_factor: R9", the target R9 belongs to the fields `scuffing` and `lubricant_factor`, and the
target D15 belongs to all other fields of the dataclass.
"""


class Place(NamedTuple):
    """A place in the manual: the text of a link to the place, its address, and its chapter."""

    text: str
    address: str
    chapter: str


@cache
def place_of(declared: Quantity) -> Place | None:
    """Return the place in the manual that says how a result is computed, or None if no solver declares the result."""
    origin = getattr(declared, "origin", None)
    if origin is None:
        return None
    record, name = origin
    for kind in record.__mro__:
        targets = PLACES.get(f"{kind.__module__.removeprefix('solvers.')}.{kind.__qualname__}")
        if targets is not None:
            return _place(_target(targets, name))
    return None


def _target(targets: str, name: str) -> str:
    """Return the target of the field `name`: the number of an equation, or a section of a chapter.

    `targets` is the text that `PLACES` holds for the dataclass with this field.
    """
    target, *others = targets.split("; ")
    for other in others:
        names, _, own = other.partition(": ")
        if name in names.split():
            return own
    return target


def _place(target: str) -> Place:
    chapter, _, section = target.partition("#")
    if section:
        return Place(f"section {section.replace('-', ' ')}", f"/manual/{target}", chapter)
    equation = equations()[target]
    return Place(f"Eq. {target}", equation.address, equation.chapter)
