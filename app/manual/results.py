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
        "C7; mean_tangential_force unloading_misalignment: C10; rotation: C8; sleeve_displacement: C9; "
        "iterations: coupling#numerics"
    ),
    "coupling.results.Lubrication": (
        "C12; max_normal_force: C7; contact_overlap load_capacity_coefficient: C13; inlet_ratio hydrodynamic_capacity: "
        "C14; inlet_factor: C16; friction_coefficient: C18"
    ),
    "coupling.results.Regime": "coupling#friction",
    "coupling.results.AxialThrust": (
        "C19; coaxial_limit breakaway_force design_force fraction_of_limit: C20; uniform_load_force: C21; "
        "customary_force: coupling#axial-thrust"
    ),
    "coupling.results.SelfInducedThrust": "C22; simple_model_force: C23; uniform_load_force: C24",
    "coupling.results.Losses": "C25; contact_shift_moment: C27; hub_bending_moment: C28",
    "coupling.results.Limits": ("C31; sliding_velocity_limit allowable_misalignment: C29; sleeve_centring_torque: C30"),
    "coupling.inputs.Coupling": "coupling#geometry; tooth_stiffness: C7",
    "coupling.results.Derived": "R3; viscosity_index: R2",
    "coupling.results.InertiaForce": "C11",
    "coupling.results.OrbitResult": "C11; sweeps change: coupling#numerics",
    "coupling.crowning.Recommendation": "C32",
    "coupling.crowning.RecommendedPoint": "C13; friction_coefficient: C18; axial_thrust: C19; sliding_velocity: C2",
    "pumping.results.MeshGeometry": (
        "L1; transverse_contact_ratio: Xue 2; normal_backlash: P1; pinion_tip_diameter wheel_tip_diameter "
        "pinion_root_diameter wheel_root_diameter undercut: pumping#geometry-of-the-tooth-space"
    ),
    "pumping.results.Stroke": "P2; max_area min_area: Milian 5; contact_start contact_end: L2",
    "pumping.results.SpacesResult": (
        "P9; peak_pressure_ratio min_pressure_ratio: P6; peak_axial_mach peak_axial_velocity: P8; "
        "radial_choked axial_choked: Milian 7; max_temperature_rise hottest_position: P10"
    ),
    "pumping.results.MassFlow": "pumping#mass-flows; net_uncertainty radial_uncertainty: P15",
    "pumping.results.Balance": "Milian 3; energy_error: P5",
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
        "L1; path_of_contact: L2; transverse_base_pitch transverse_contact_ratio total_contact_ratio: Xue 2; "
        "overlap_ratio: Xue 3; pinion_tip_diameter wheel_tip_diameter pinion_root_diameter wheel_root_diameter "
        "undercut: load-distribution#geometry"
    ),
    "scuffing.results.ContactLines": "Xue 4",
    "scuffing.results.Stiffness": ("Xue 7; mean_mesh: L15; standard_single standard_mesh: L16; secant_load: L9"),
    "scuffing.results.TransmissionError": "L18",
    "scuffing.results.LoadOnFlank": (
        "Xue 1; max_line_load contact_fraction: Xue 9; balance_error: Xue 11; face_load_factor: L17"
    ),
    "scuffing.results.Place": "S1",
    "scuffing.results.Pressure": "Xue 14",
    "scuffing.results.FrictionLoss": "L19; coefficient: R10",
    "scuffing.results.Derived": (
        "Xue 1; centre_distance: L1; tip_relief_length root_relief_length end_relief_length: L11; "
        "rack_tip_radius: load-distribution#geometry"
    ),
    "scuffing.safety_results.Flash": (
        "Xue 25; blok_at_psi thermal_ehl_at_psi: S1; thermal_ehl_max thermal_ehl_at_profile thermal_ehl_at_face: "
        "Xue 24; friction_coefficient: R5"
    ),
    "scuffing.safety_results.ContactTemperature": "Xue 16; bulk: R8",
    "scuffing.safety_results.Film": (
        "Xue 27; thickness_ratio thickness_regime: Xue 28; thermal_ehl_min: Xue 21; min_at_psi: S1"
    ),
    "scuffing.safety_results.Safety": "Xue 26; scuffing: R9",
    "scuffing.safety_results.Scuffing": "scuffing#numerics",
    "scuffing.safety_results.ScuffingDerived": "R1; density_15: R3; lubricant_factor: R6",
    "scuffing.micropitting.results.Micropitting": "M14",
    "scuffing.micropitting.results.FilmOfTest": "M14; bulk: M11; friction_coefficient: M9",
    "scuffing.micropitting.results.LocalFilm": "M7; friction_coefficient: M9; thermal_ehl_ratio: Xue 21",
    "scuffing.micropitting.results.LocalPoint": "M7",
    "scuffing.micropitting.results.StandardFilm": "M7; friction_coefficient: M9; bulk: M11; loss_factor: M10",
    "scuffing.micropitting.results.StandardPoint": "M7; force_ratio: M12; pressure: M13; flash: M4; film: M6",
    "scuffing.micropitting.results.Wear": "M15",
    "heat_balance.results.GearTemperatures": (
        "H18; friction: H7; oil_conductance oil_limited: H5; flooded_conductance: H5; film: H4; turn_film: H4"
    ),
    "heat_balance.results.Heat": (
        "H18; gear_flow total_flow: H11; wetting_share: H4; friction_to_pinion: H7; wheel_deviation: H19; "
        "backlash_loss: H22"
    ),
    "heat_balance.results.BearingHeat": "H18; film oil_flow: H12; friction_power: D5",
    "heat_balance.results.HeatFlow": "H17",
    "heat_balance.results.HeatLosses": (
        "H6; pumping: P9; oil_acceleration: H9; windage: H8; bearings: D5; couplings: C25; total other: H17"
    ),
    "heat_balance.results.Balance": "H17",
    "heat_balance.results.BulkEstimates": "R8; iso_ts_6336_22_bulk: H13",
    "heat_balance.results.HeatBand": "H21",
    "heat_balance.results.CoolingInForce": (
        "H11; wetting_share rewetting_share: H4; fling_off_factor: H5; windage: H8; other: H17"
    ),
    "lubricants.OilInUse": (
        "R1; reference_temperature specific_heat thermal_conductivity: practice#oils; viscosity density: R3; "
        "pressure_viscosity temperature_viscosity: R4; viscosity_index: R2"
    ),
    "contact.ehl.results.HertzContact": "E1",
    "contact.ehl.results.Dimensionless": (
        "E2; slide_roll_ratio: line-contact#hertz-contact-and-similarity; peclet_1 peclet_2: E11"
    ),
    "contact.ehl.results.FilmThickness": "Xue 21; dowson_higginson: Xue 27",
    "contact.ehl.results.ContactPressure": "Xue 17",
    "contact.ehl.results.ContactTemperature": ("Xue 24; film_max: Xue 23"),
    "contact.ehl.results.ContactFriction": "E9; max_shear_stress: E6",
    "contact.ehl.results.ContactHeat": "E10",
    "contact.ehl.results.MeshError": "line-contact#numerics",
    "contact.ehl.results.Convergence": "line-contact#numerics; eyring_stress: E5",
    "contact.ehl.results.Derived": "E1; entrainment_speed: Xue 18",
    "drive_train.results.Misalignment": (
        "D13; thermal_range thermal_profile_slope base_pitch: D10; recommended_helix_slope recommended_lead_crowning "
        "recommended_profile_slope: drive-train#results"
    ),
    "drive_train.results.Parts": "D3; films films_pinion films_wheel: D5; coupling: D6; collar: D14",
    "drive_train.results.FaceLoad": (
        "L17; max_line_load contact_fraction transmission_error_pp: D11; max_pressure: Xue 14"
    ),
    "drive_train.results.BearingResult": "D5; reaction displacement: D3; eccentricity_ratio: D4",
    "drive_train.shafts.thrust_budget.Thrust": "D14; coupling_limit: C20",
    "drive_train.results.CouplingResult": (
        "D6; tilt: D8; stuck friction_share: D7; thrust thrust_limit: D7; friction_coefficient: C18; "
        "friction_power: C25"
    ),
    "drive_train.results.FlashPlaces": "Xue 25; contact_max: D15; friction_coefficient: R5",
    "drive_train.results.TrainSafety": "D15; thermal_ehl_feature thermal_ehl_profile: Xue 26",
    "drive_train.results.TrainLosses": (
        "H17; coupling: C25; pumping: P9; mesh: L19; bearings: D5; oil_acceleration: H9; windage: H8; efficiency: L19"
    ),
    "drive_train.results.ForceBalance": "D3",
    "drive_train.results.Convergence": "D11",
    "drive_train.derived.DerivedTemperatures": "R8; scuffing: R9; lubricant_factor: R6",
    "drive_train.derived.Derived": "Xue 1",
    "drive_train.derived.DerivedShaft": "drive-train#shafts",
    "drive_train.derived.DerivedSection": "D16",
    "drive_train.derived.DerivedBearing": "D4; viscosity: R3",
    "drive_train.derived.DerivedCoupling": "R3; viscosity_index: R2; axial_tooth_stiffness: D8",
    "drive_train.derived.DerivedHeat": "D10",
    "heat_balance.warm_up.WarmUp": "H24",
    "drive_train.warm_up.UnitWarmUp": "D15; largest_face_load_factor: L17; least_backlash: H22",
}
"""The targets in the manual for each of the solvers' dataclasses that declare results.

A target is the number of an equation, or a chapter and the anchor of a section. The value for a dataclass is a text
that lists targets, separated by semicolons. The names of some fields and a colon stand before every target except the
first; the target belongs to these fields. The first target belongs to all other fields of the dataclass.
"""


class Place(NamedTuple):
    """A place in the manual: the text of a link to the place, its address, and its chapter."""

    text: str
    address: str
    chapter: str


@cache
def place_of(declared: Quantity) -> Place | None:
    """Return the place that says how a declared result is computed; None if no solver declares the result."""
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
    """Return the place in the manual for the field `name`, written as in `PLACES`, such as "coupling#numerics".

    `targets` is the text in `PLACES` for the dataclass of the field.
    """
    target, *others = targets.split("; ")
    for other in others:
        names, _, own = other.partition(": ")
        if name in names.split():
            return own
    return target


def _place(target: str) -> Place:
    """Return the place in the manual to which a target leads."""
    chapter, _, section = target.partition("#")
    if section:
        return Place(f"section {section.replace('-', ' ')}", f"/manual/{target}", chapter)
    equation = equations()[target]
    return Place(f"Eq. {target}", equation.address, equation.chapter)
