"""Scuffing: responses of /v1/scuffing/load-distribution and /v1/scuffing."""

from typing import Annotated, Literal

from app.quantities import Output
from app.responses.common import Group, Response

XUE = "Xue 2020"
ISO_6336 = "ISO 6336-1"
Values = list[float]
Gaps = list[float | None]


class ScuffingGeometry(Group):
    """The mesh."""

    centre_distance_mm: Annotated[float, Output("centre distance in use", "a")]
    working_pressure_angle_deg: Annotated[float, Output("working transverse pressure angle", "α_wt")]
    base_helix_angle_deg: Annotated[float, Output("base helix angle", "β_b")]
    transverse_base_pitch_mm: Annotated[float, Output("transverse base pitch", "p_bt", f"{XUE}, Eq. 2")]
    path_of_contact_mm: Annotated[float, Output("length of the path of contact", "g_α")]
    transverse_contact_ratio: Annotated[float, Output("transverse contact ratio", "ε_α", f"{XUE}, Eq. 2")]
    overlap_ratio: Annotated[float, Output("overlap ratio", "ε_β", f"{XUE}, Eq. 3")]
    total_contact_ratio: Annotated[float, Output("total contact ratio", "ε_γ", f"{XUE}, Table 1")]
    undercut: Annotated[bool, Output("whether either gear is undercut")]


class ContactLengthCurves(Group):
    """Total contact length over one base pitch; a spur gear's jumps stand twice."""

    roll_position: Annotated[Values, Output("roll position over the base pitch", "φ/p_bt")]
    length_mm: Annotated[Values, Output("total length of the contact lines", "L", f"{XUE}, Fig. 5")]


class ContactLineLengths(Group):
    """Total length of the contact lines."""

    min_length_mm: Annotated[float, Output("smallest", "L_min", XUE)]
    max_length_mm: Annotated[float, Output("largest", "L_max", XUE)]
    mean_length_mm: Annotated[float, Output("mean", "L", f"{XUE}, Eq. 4")]
    length_ratio: Annotated[float, Output("smallest over largest", "ς", f"{XUE}, Fig. 6")]
    curves: Annotated[ContactLengthCurves | None, Output("over one base pitch", detail="curves")] = None


class ToothStiffnessCurves(Group):
    """Stiffness of one pair of teeth along the path."""

    gamma: Annotated[Values, Output("profile parameter, 0 at the pitch point", "Γ")]
    single_n_per_mm_um: Annotated[Values, Output("stiffness of one pair", "k", f"{XUE}, Eq. 7")]


class ToothStiffness(Group):
    """Stiffness per face width."""

    max_n_per_mm_um: Annotated[float, Output("largest of one pair", "k", f"{XUE}, Fig. 8")]
    max_at_gamma: Annotated[float, Output("where, by the profile parameter", "Γ", f"{XUE}, Fig. 8")]
    approach_n_per_mm_um: Annotated[float, Output("of one pair at A", "k_A")]
    pitch_n_per_mm_um: Annotated[
        float | None, Output("of one pair at the pitch point; null where the path does not hold it", "k_C")
    ]
    recess_n_per_mm_um: Annotated[float, Output("of one pair at E", "k_E")]
    mean_mesh_n_per_mm_um: Annotated[float | None, Output("mean of the loaded mesh; null without load", "c_γ")]
    standard_single_n_per_mm_um: Annotated[float, Output("single stiffness of the standard", "c'", ISO_6336)]
    standard_mesh_n_per_mm_um: Annotated[float, Output("mesh stiffness of the standard", "c_γα", ISO_6336)]
    secant_load_n_per_mm: Annotated[float, Output("line load of the single stiffnesses: the mean, or 100 without load")]
    curves: Annotated[ToothStiffnessCurves | None, Output("along the path", detail="curves")] = None


class TransmissionErrorCurves(Group):
    """Transmission error over one base pitch; a spur gear's jumps stand twice."""

    roll_position: Annotated[Values, Output("roll position over the base pitch", "φ/p_bt")]
    error_um: Annotated[Values, Output("along the transverse line of action", "TE", f"{XUE}, Fig. 12")]


class TransmissionErrorResult(Group):
    """Transmission error along the transverse line of action."""

    peak_to_peak_um: Annotated[float, Output("peak to peak", "PPTE", f"{XUE}, Fig. 12")]
    mean_um: Annotated[float, Output("mean over the base pitch", "TE")]
    min_um: Annotated[float, Output("smallest", "TE")]
    max_um: Annotated[float, Output("largest", "TE")]
    harmonics_um: Annotated[Values, Output("amplitudes of the first five mesh harmonics", "2|c_k|")]
    curves: Annotated[TransmissionErrorCurves | None, Output("over one base pitch", detail="curves")] = None


class FlankPlace(Group):
    """A point of the flank."""

    gamma: Annotated[float, Output("profile parameter, 0 at the pitch point", "Γ")]
    profile_fraction: Annotated[float, Output("fraction of the path from A to E", "ξ")]
    face_fraction: Annotated[float, Output("fraction of the face from the end that meshes first", "η")]


class FlankLoad(Group):
    """Load on the flank."""

    pinion_torque_n_m: Annotated[float, Output("pinion torque", "T_1")]
    tangential_force_n: Annotated[float, Output("force in the transverse plane", "F_bt", f"{XUE}, Eq. 1")]
    normal_force_n: Annotated[float, Output("force in the balance", "F_bn")]
    max_line_load_n_per_mm: Annotated[float, Output("largest over all roll positions", "w", f"{XUE}, Fig. 11")]
    max_at: Annotated[FlankPlace | None, Output("where; null without load")]
    contact_fraction: Annotated[float, Output("share of the flank under load, weighted by contact length")]
    face_load_factor: Annotated[float | None, Output("largest over mean load across the face", "K_Hβ", ISO_6336)]
    balance_error: Annotated[float, Output("force left over, relative")]
    pair_share: Annotated[
        list[Values] | None, Output("force share of each line over the roll positions", detail="fields")
    ] = None


class FlankPressure(Group):
    """Dry Hertz pressure."""

    max_mpa: Annotated[
        float | None,
        Output(
            "largest over all roll positions; null where the loaded path reaches a base circle",
            "p_H",
            f"{XUE}, Eq. 14",
        ),
    ]
    max_at: Annotated[FlankPlace | None, Output("where; null without load or largest pressure")]


class MeshLoss(Group):
    """Friction loss at the coefficient given."""

    loss_factor: Annotated[float | None, Output("loss factor; null without load", "H_V")]
    power_w: Annotated[float, Output("friction power", "P_V")]


class FeatureLineCurves(Group):
    """Along the feature line from A1 to E2."""

    psi: Annotated[Values, Output("fraction of the feature line", "ψ", f"{XUE}, Fig. 18")]
    gamma: Annotated[Values, Output("profile parameter", "Γ")]
    line_load_n_per_mm: Annotated[Values, Output("line load", "w", f"{XUE}, Fig. 18")]
    pressure_mpa: Annotated[Gaps, Output("Hertz pressure; null where the reduced radius vanishes", "p_H")]
    half_width_mm: Annotated[Values, Output("half width of the contact", "b_0")]
    radius_mm: Annotated[Values, Output("reduced radius across the contact line", "R_n", f"{XUE}, Eq. 13")]
    pinion_speed_m_per_s: Annotated[Values, Output("surface speed of the pinion", "u_1", f"{XUE}, Eq. 18")]
    wheel_speed_m_per_s: Annotated[Values, Output("surface speed of the wheel", "u_2", f"{XUE}, Eq. 18")]
    sliding_m_per_s: Annotated[Values, Output("sliding speed", "u_1 − u_2")]
    iso_load_sharing: Annotated[
        Values | None, Output("the standard's diagram; null where it has none", "X_Γ", "ISO/TR 13989-1, from memory")
    ]
    load_sharing: Annotated[Values | None, Output("w b / F_bt; null without load", "X_Γ", f"{XUE}, Fig. 19")]


class FlankFields(Group):
    """Over the flank, `[profile][face]`."""

    profile_fraction: Annotated[Values, Output("fraction of the path from A to E", "ξ")]
    face_fraction: Annotated[Values, Output("fraction of the face from the end that meshes first", "η")]
    modification_um: Annotated[list[Values], Output("gap between the unloaded flanks", "Δ", f"{XUE}, Fig. 15")]
    line_load_n_per_mm: Annotated[list[Values], Output("line load", "w", f"{XUE}, Fig. 11")]
    pressure_mpa: Annotated[
        list[Gaps], Output("Hertz pressure; null where the reduced radius vanishes", "p_H", f"{XUE}, Figs. 13-17")
    ]


class LoadDistributionResponse(Response):
    """How a gear pair carries its load; sections are missing where there is no solution."""

    geometry: Annotated[ScuffingGeometry | None, Output("the mesh")] = None
    contact_lines: Annotated[ContactLineLengths | None, Output("length of the contact lines")] = None
    stiffness: Annotated[ToothStiffness | None, Output("stiffness of teeth and mesh")] = None
    transmission_error: Annotated[TransmissionErrorResult | None, Output("transmission error")] = None
    load: Annotated[FlankLoad | None, Output("load on the flank")] = None
    pressure: Annotated[FlankPressure | None, Output("Hertz pressure")] = None
    friction_loss: Annotated[MeshLoss | None, Output("friction loss")] = None
    feature_line: Annotated[FeatureLineCurves | None, Output("along the feature line", detail="curves")] = None
    flank: Annotated[FlankFields | None, Output("over the flank", detail="fields")] = None


class FlashTemperature(Group):
    """Largest flash temperature; thermal EHL values are null in closed form."""

    blok_max_k: Annotated[float, Output("by Blok", "t_f", f"{XUE}, Eq. 25")]
    blok_at_psi: Annotated[float | None, Output("where; null without load", "ψ")]
    thermal_ehl_max_k: Annotated[float | None, Output("by the thermal EHL solution", "t_f", f"{XUE}, Fig. 22")]
    thermal_ehl_at_psi: Annotated[float | None, Output("where", "ψ")]


class ContactTemperatureResult(Group):
    """Largest contact temperature, bulk plus flash."""

    blok_max_c: Annotated[float, Output("by Blok", "t_B", f"{XUE}, Eq. 16")]
    thermal_ehl_max_c: Annotated[float | None, Output("by the thermal EHL solution; null in closed form", "t_B")]


class ThinnestFilm(Group):
    """Thinnest film; null where nothing is loaded."""

    dowson_higginson_min_um: Annotated[float | None, Output("by Dowson and Higginson", "h_min", f"{XUE}, Eq. 27")]
    thermal_ehl_min_um: Annotated[float | None, Output("by the thermal EHL solution; null in closed form", "h_min")]
    min_at_psi: Annotated[float | None, Output("where", "ψ")]
    thickness_ratio: Annotated[float | None, Output("over the roughness of both flanks", "χ", f"{XUE}, Eq. 28")]
    thickness_regime: Annotated[
        Literal["boundary", "mixed", "full_film"] | None,
        Output("below 1 boundary, scuffing probable; to 4 mixed; above full film", None, XUE),
    ]


class ScuffingSafety(Group):
    """Safety against scuffing."""

    blok_factor: Annotated[
        float | None, Output("by Blok; null where the teeth stay as cool as the oil", "S", f"{XUE}, Eq. 26")
    ]
    thermal_ehl_factor: Annotated[float | None, Output("by the thermal EHL solution; null in closed form", "S")]


class ScuffingPathCurves(Group):
    """Along the feature line; what only the thermal EHL solution knows is null in closed form."""

    psi: Annotated[Values, Output("fraction of the feature line", "ψ")]
    status: Annotated[
        list[Literal["ok", "ok_with_warnings", "no_solution", "refused", "unloaded"]],
        Output("outcome at the point; refused: outside the range of the thermal EHL solver"),
    ]
    blok_flash_k: Annotated[Values, Output("flash temperature by Blok", "t_f", f"{XUE}, Fig. 22")]
    pinion_flash_k: Annotated[Gaps | None, Output("flash temperature of the pinion", "t_f1", f"{XUE}, Fig. 22")]
    wheel_flash_k: Annotated[Gaps | None, Output("flash temperature of the wheel", "t_f2", f"{XUE}, Fig. 22")]
    dowson_higginson_um: Annotated[
        Gaps, Output("film by Dowson and Higginson; null without load", "h_min", f"{XUE}, Fig. 23")
    ]
    minimum_film_um: Annotated[Gaps | None, Output("minimum film", "h_min", f"{XUE}, Fig. 23")]
    central_film_um: Annotated[Gaps | None, Output("central film", "h_c")]
    max_pressure_mpa: Annotated[Gaps | None, Output("largest film pressure", "p")]
    friction_coefficient: Annotated[Gaps | None, Output("coefficient of friction", "μ")]
    film_max_temperature_c: Annotated[Gaps | None, Output("largest film temperature", "t")]
    thickness_ratio: Annotated[Gaps, Output("film over roughness; null without load", "χ", f"{XUE}, Eq. 28")]


class ScuffingResponse(LoadDistributionResponse):
    """Load distribution and scuffing check; sections are missing where there is no solution."""

    flash: Annotated[FlashTemperature | None, Output("flash temperature")] = None
    contact_temperature: Annotated[ContactTemperatureResult | None, Output("contact temperature")] = None
    film: Annotated[ThinnestFilm | None, Output("film thickness")] = None
    safety: Annotated[ScuffingSafety | None, Output("safety factors; null without a scuffing temperature")] = None
    path: Annotated[ScuffingPathCurves | None, Output("along the feature line", detail="curves")] = None
    unsolved_points: Annotated[int | None, Output("points of the path without a solution")] = None
