"""Gear couplings: responses of /v1/coupling and its two companions."""

from typing import Annotated

from app.quantities import Output
from app.responses.common import Group, Response

PAHL = "Pahl 1978"


class CouplingGeometry(Group):
    """Radii of the crowned tooth."""

    pitch_radius_mm: Annotated[float, Output("pitch radius", "r_o", PAHL)]
    crowning_radius_mm: Annotated[float, Output("radius of the cutter centre's path", "r_b", PAHL)]
    tangential_flank_radius_mm: Annotated[float, Output("flank radius in the tangential plane", "R_t")]
    normal_flank_radius_mm: Annotated[float, Output("flank radius in the plane of action", "R_e", "Pahl 1978, Fig. 8")]


class CouplingKinematicCurves(Group):
    """Motion over one revolution of a tooth; 90° and 270° are the tilt positions."""

    angle_deg: Annotated[list[float], Output("tooth angle from the pivot position", "φ")]
    sliding_velocity_m_per_s: Annotated[
        list[float], Output("axial sliding velocity, signed", "v_G", "Pahl 1978, Fig. 6")
    ]
    hydrodynamic_velocity_m_per_s: Annotated[
        list[float], Output("hydrodynamically effective velocity", "v_H", "Pahl 1978, Fig. 6")
    ]
    tangential_displacement_um: Annotated[list[float], Output("tangential displacement", "f_t", "Pahl 1978, Fig. 6")]
    contact_position_mm: Annotated[list[float], Output("contact position on the hub tooth", "s_1", "Pahl 1978, Fig. 7")]


class CouplingKinematics(Group):
    """Largest values of the tooth's motion over a revolution."""

    max_sliding_velocity_m_per_s: Annotated[float, Output("largest sliding velocity", "v_Gmax", "Pahl 1978, Fig. 6")]
    max_contact_travel_mm: Annotated[
        float, Output("largest travel of the contact from the tooth's middle", "s_1max", "Pahl 1978, Fig. 7")
    ]
    max_hydrodynamic_velocity_m_per_s: Annotated[
        float, Output("largest hydrodynamically effective velocity", "v_Hmax", "Pahl 1978, Fig. 6")
    ]
    tangential_displacement_peak_to_peak_um: Annotated[
        float, Output("peak-to-peak tangential displacement", "f_t", "Pahl 1978, Fig. 6")
    ]
    curves: Annotated[CouplingKinematicCurves | None, Output("over one revolution", detail="curves")] = None


class CouplingLoadCurves(Group):
    """Tooth forces."""

    angle_deg: Annotated[list[float], Output("tooth angle", "φ_i")]
    tangential_force_n: Annotated[list[float], Output("tangential force of the tooth", "F_t", "Pahl 1978, Fig. 3")]


class CouplingLoadDistribution(Group):
    """Load over the teeth of one mesh, the one where the hub drives the sleeve, at the rotor angle asked for."""

    mean_tangential_force_n: Annotated[float, Output("mean tangential force of a tooth", "F_m")]
    max_tangential_force_n: Annotated[float, Output("largest tangential force", "F_max", "Pahl 1978, Fig. 3")]
    min_tangential_force_n: Annotated[float, Output("smallest tangential force", "F_min")]
    max_normal_force_n: Annotated[float, Output("largest normal force", "F_n,max", PAHL)]
    load_concentration: Annotated[float | None, Output("largest over mean force; null without torque")]
    loaded_teeth: Annotated[int, Output("teeth that carry")]
    rotation_um: Annotated[float, Output("rotation of hub against sleeve at the pitch radius", "ψ")]
    unloading_misalignment_deg: Annotated[float, Output("misalignment beyond which some tooth is free", "δ_L")]
    sleeve_displacement_um: Annotated[list[float], Output("displacement (x, y) of the sleeve", "e")]
    iterations: Annotated[int, Output("iterations of a floating sleeve's balance; 0 for a centred one")]
    curves: Annotated[CouplingLoadCurves | None, Output("tooth by tooth", detail="curves")] = None


class FrictionRegime(Group):
    """Area of the map of friction conditions; an open end of its friction band is null."""

    area: Annotated[str, Output("area of the map", None, "Pahl 1978, Fig. 9")]
    name: Annotated[str, Output("lubrication in this area", None, "Pahl 1978, Fig. 9")]
    friction_min: Annotated[float | None, Output("lower end of the friction band", "μ", "Pahl 1978, Fig. 9")]
    friction_max: Annotated[float | None, Output("upper end of the friction band", "μ", "Pahl 1978, Fig. 9")]
    distance_to_boundary: Annotated[
        float | None, Output("smallest |ln| of overlap and load capacity against the map's boundaries")
    ]


class CouplingLubrication(Group):
    """Contact and film of the highest loaded tooth in the tilt position."""

    max_normal_force_n: Annotated[
        float, Output("normal force of a tooth in the tilt position, or largest with pitch errors", "F_n,max", PAHL)
    ]
    hertz_half_width_mm: Annotated[float, Output("half width of the Hertzian contact", "a_HZ", "Pahl 1978, Fig. 7")]
    hertz_pressure_mpa: Annotated[float, Output("largest Hertzian pressure", "p_H")]
    contact_overlap: Annotated[float | None, Output("contact surface overlap", "Pu", "Pahl 1978, Fig. 7")]
    inlet_ratio: Annotated[
        float | None, Output("inlet length over its scale; null: infinite", "B", "Pahl 1978, Fig. 8")
    ]
    inlet_factor: Annotated[float, Output("effect of the shortened inlet", "f(B)", "Pahl 1978, Fig. 8")]
    hydrodynamic_capacity_n: Annotated[float, Output("hydrodynamic load capacity", "F_HD", "Pahl 1978, Fig. 8")]
    load_capacity_coefficient: Annotated[float | None, Output("load capacity coefficient", "Tr", PAHL)]
    regime: Annotated[FrictionRegime, Output("friction regime")]
    friction_coefficient: Annotated[float, Output("coefficient in use", "μ")]


class SelfInducedThrust(Group):
    """Thrust without axial motion."""

    force_n: Annotated[float, Output("force on one shaft, positive: pulled together", "F_ax", "Pahl 1978, Fig. 17")]
    overturning_moment_n_m: Annotated[float, Output("moment of friction on the sleeve", "M_2", "Pahl 1978, Fig. 13")]
    simple_model_force_n: Annotated[
        float, Output("one tooth pair per mesh; zero with an angle (M)", "F_ax", "Pahl 1978, Fig. 13")
    ]
    uniform_load_force_n: Annotated[
        float, Output("closed form, all teeth loaded alike; zero with an angle (M)", "F_ax")
    ]


class CouplingThrust(Group):
    """Axial thrust, mean over one tooth pitch (one revolution with pitch errors)."""

    force_n: Annotated[
        float,
        Output("thrust of one mesh, or with two meshes force on one shaft, positive: pulled together", "F_ax", PAHL),
    ]
    coaxial_limit_n: Annotated[float, Output("thrust of sliding coaxial shafts", "F_max", PAHL)]
    breakaway_force_n: Annotated[float, Output("thrust at which coaxial shafts start to slide", None, PAHL)]
    fraction_of_limit: Annotated[float | None, Output("force over coaxial limit")]
    uniform_load_force_n: Annotated[float, Output("closed form of one mesh, all teeth loaded alike", "F_ax")]
    lower_bound_n: Annotated[float, Output("least thrust where friction at rest is indeterminate")]
    upper_bound_n: Annotated[float, Output("largest thrust where friction at rest is indeterminate")]
    indeterminate: Annotated[bool, Output("whether teeth stick, so that friction takes any value up to its limit")]
    self_induced: Annotated[SelfInducedThrust | None, Output("with axial velocity zero; null for a single mesh")]


class CouplingLosses(Group):
    """Friction losses and moments of one mesh, the one where the hub drives the sleeve."""

    friction_power_w: Annotated[float, Output("friction power", "P")]
    friction_moment_n_m: Annotated[float, Output("friction moment", "M_f")]
    contact_shift_moment_n_m: Annotated[float, Output("moment of the shifted contacts", "M_s")]
    hub_bending_moment_n_m: Annotated[float, Output("bending moment on the hub, resultant")]


class CouplingLimits(Group):
    """Limits and stiffnesses."""

    sliding_velocity_limit_m_per_s: Annotated[
        float, Output("largest lasting sliding velocity", None, "Tribology Handbook B4.6")
    ]
    allowable_misalignment_deg: Annotated[
        float | None,
        Output("misalignment at that sliding velocity; null where none reaches it", "δ", "Tribology Handbook B4.6"),
    ]
    sleeve_centring_torque_n_m: Annotated[float, Output("torque that keeps a heavy sleeve centred", "T")]
    torsional_stiffness_n_m_per_rad: Annotated[float, Output("of one mesh, all teeth loaded")]
    lateral_stiffness_n_per_um: Annotated[float, Output("of one mesh, all teeth loaded")]


class CouplingResponse(Response):
    """A gear coupling at one operating point; sections are missing where there is no solution."""

    geometry: Annotated[CouplingGeometry | None, Output("radii")] = None
    kinematics: Annotated[CouplingKinematics | None, Output("motion of the teeth")] = None
    load_distribution: Annotated[CouplingLoadDistribution | None, Output("load over the teeth")] = None
    lubrication: Annotated[CouplingLubrication | None, Output("overlap, load capacity, regime")] = None
    axial_thrust: Annotated[CouplingThrust | None, Output("axial thrust")] = None
    losses: Annotated[CouplingLosses | None, Output("friction losses and moments")] = None
    limits: Annotated[CouplingLimits | None, Output("limits and stiffnesses")] = None


class SleeveOrbit(Group):
    """Path of the sleeve centre."""

    rotor_angle_deg: Annotated[list[float], Output("rotor angle", "θ")]
    x_um: Annotated[list[float], Output("displacement in the pivot direction", "e_x")]
    y_um: Annotated[list[float], Output("displacement along the tilt axis", "e_y")]


class SleeveInertia(Group):
    """Inertia force of the sleeve mass of one mesh."""

    x_n: Annotated[
        list[float] | None, Output("force in the pivot direction", None, "Pahl 1978, Fig. 5", detail="curves")
    ] = None
    y_n: Annotated[
        list[float] | None, Output("force along the tilt axis", None, "Pahl 1978, Fig. 5", detail="curves")
    ] = None
    harmonics_x_n: Annotated[list[float], Output("amplitudes from order 0 up", None, "Pahl 1978, Fig. 5")]
    harmonics_y_n: Annotated[list[float], Output("amplitudes from order 0 up", None, "Pahl 1978, Fig. 5")]


class SleeveOrbitResponse(Response):
    """One revolution of a floating sleeve under its own inertia."""

    orbit: Annotated[SleeveOrbit | None, Output("path of the sleeve centre", detail="curves")] = None
    inertia_force: Annotated[SleeveInertia | None, Output("inertia force")] = None
    max_displacement_um: Annotated[float | None, Output("largest displacement")] = None
    displacement_uncertainty_um: Annotated[
        float | None, Output("change of the largest displacement with twice the orders and rotor angles")
    ] = None
    harmonics_uncertainty_n: Annotated[
        float | None, Output("largest change of a harmonic with twice the orders and rotor angles")
    ] = None
    sweeps: Annotated[int | None, Output("sweeps over the revolution until it repeated")] = None
    change_um: Annotated[float | None, Output("how far the last sweep still moved the path")] = None


class RecommendedPoint(Group):
    """The recommended coupling at one end of the range."""

    contact_overlap: Annotated[float, Output("contact surface overlap", "Pu", PAHL)]
    load_capacity_coefficient: Annotated[float, Output("load capacity coefficient", "Tr", PAHL)]
    friction_coefficient: Annotated[float, Output("coefficient of friction", "μ")]
    axial_thrust_n: Annotated[float, Output("axial thrust at the axial velocity given", "F_ax")]
    sliding_velocity_m_per_s: Annotated[float, Output("largest sliding velocity", "v_Gmax")]


class CrowningScan(Group):
    """How crowning trades off."""

    crowning_ratio: Annotated[list[float], Output("crowning ratio", "ε")]
    min_load_capacity_coefficient: Annotated[list[float | None], Output("smallest over the range", "Tr")]
    max_contact_overlap: Annotated[list[float | None], Output("largest over the range", "Pu")]
    feasible: Annotated[list[bool], Output("whether every constraint is met")]


class RecommendationResponse(Response):
    """The crowning ratio with the largest load capacity over a range of misalignment."""

    feasible: Annotated[bool | None, Output("whether any crowning ratio meets every constraint")] = None
    crowning_ratio: Annotated[float | None, Output("the best crowning ratio", "ε")] = None
    min_load_capacity_coefficient: Annotated[float | None, Output("smallest over the range", "Tr")] = None
    failed_constraint: Annotated[str | None, Output("the constraint that leaves no crowning ratio")] = None
    at_min: Annotated[RecommendedPoint | None, Output("at the smallest misalignment")] = None
    at_max: Annotated[RecommendedPoint | None, Output("at the largest misalignment")] = None
    scan: Annotated[CrowningScan | None, Output("how crowning trades off", detail="curves")] = None
