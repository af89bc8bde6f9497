"""The loaded mesh in numbers: geometry, contact lines, stiffness, transmission error, losses."""

from typing import Annotated

from app.schema.base import Group
from app.schema.quantities import Output

XUE = "Xue 2020"
ISO_6336 = "ISO 6336-1"
Values = list[float]


class ScuffingGeometry(Group):
    """The mesh."""

    centre_distance_mm: Annotated[float, Output("centre distance", "a", text="centre distance in use")]
    working_pressure_angle_deg: Annotated[
        float, Output("working pressure angle", "α_wt", text="working transverse pressure angle")
    ]
    base_helix_angle_deg: Annotated[float, Output("base helix angle", "β_b")]
    transverse_base_pitch_mm: Annotated[float, Output("transverse base pitch", "p_bt", f"{XUE}, Eq. 2")]
    path_of_contact_mm: Annotated[float, Output("length of the path of contact", "g_α")]
    transverse_contact_ratio: Annotated[float, Output("transverse contact ratio", "ε_α", f"{XUE}, Eq. 2")]
    overlap_ratio: Annotated[float, Output("overlap ratio", "ε_β", f"{XUE}, Eq. 3")]
    total_contact_ratio: Annotated[float, Output("total contact ratio", "ε_γ", f"{XUE}, Table 1")]
    undercut: Annotated[bool, Output("undercut", text="whether either gear is undercut")]


class ContactLengthCurves(Group):
    """Total contact length over one base pitch; a spur gear's jumps stand twice."""

    roll_position: Annotated[
        Values, Output("roll position of the contact length", "φ/p_bt", text="roll position over the base pitch")
    ]
    length_mm: Annotated[
        Values, Output("total length of the contact lines", "L", f"{XUE}, Fig. 5", axis="roll_position")
    ]


class ContactLineLengths(Group):
    """Total length of the contact lines."""

    min_length_mm: Annotated[float, Output("shortest contact length", "L_min", XUE)]
    max_length_mm: Annotated[float, Output("longest contact length", "L_max", XUE)]
    mean_length_mm: Annotated[float, Output("mean contact length", "L_m", f"{XUE}, Eq. 4")]
    length_ratio: Annotated[float, Output("contact length ratio", "ς", f"{XUE}, Fig. 6", text="shortest over longest")]
    curves: Annotated[ContactLengthCurves | None, Output("contact length over one base pitch", detail="curves")] = None


class ToothStiffnessCurves(Group):
    """Stiffness of one pair of teeth along the path."""

    gamma: Annotated[
        Values, Output("profile parameter of the stiffness", "Γ", text="profile parameter, 0 at the pitch point")
    ]
    single_n_per_mm_um: Annotated[Values, Output("stiffness of one pair", "k", f"{XUE}, Eq. 7", axis="gamma")]


class ToothStiffness(Group):
    """Stiffness per face width."""

    max_n_per_mm_um: Annotated[float, Output("largest stiffness of one pair", "k_max", f"{XUE}, Fig. 8")]
    max_at_gamma: Annotated[
        float, Output("place of the largest stiffness", "Γ_k,max", f"{XUE}, Fig. 8", text="by the profile parameter")
    ]
    approach_n_per_mm_um: Annotated[float, Output("stiffness of one pair at A", "k_A")]
    pitch_n_per_mm_um: Annotated[
        float | None,
        Output("stiffness of one pair at C", "k_C", text="at the pitch point; null where the path does not hold it"),
    ]
    recess_n_per_mm_um: Annotated[float, Output("stiffness of one pair at E", "k_E")]
    mean_mesh_n_per_mm_um: Annotated[
        float | None, Output("mean mesh stiffness", "c_γ", text="mean of the loaded mesh; null without load")
    ]
    standard_single_n_per_mm_um: Annotated[float, Output("single stiffness by ISO 6336-1", "c'", ISO_6336)]
    standard_mesh_n_per_mm_um: Annotated[float, Output("mesh stiffness by ISO 6336-1", "c_γα", ISO_6336)]
    secant_load_n_per_mm: Annotated[
        float,
        Output(
            "line load of the stiffnesses",
            "w_s",
            text="line load of the single stiffnesses: the mean, or 100 without load",
        ),
    ]
    curves: Annotated[ToothStiffnessCurves | None, Output("stiffness along the path", detail="curves")] = None


class TransmissionErrorCurves(Group):
    """Transmission error over one base pitch; a spur gear's jumps stand twice."""

    roll_position: Annotated[
        Values, Output("roll position of the transmission error", "φ/p_bt", text="roll position over the base pitch")
    ]
    error_um: Annotated[
        Values,
        Output(
            "transmission error",
            "TE",
            f"{XUE}, Fig. 12",
            text="along the transverse line of action",
            axis="roll_position",
        ),
    ]


class TransmissionErrorResult(Group):
    """Transmission error along the transverse line of action."""

    peak_to_peak_um: Annotated[float, Output("peak-to-peak transmission error", "PPTE", f"{XUE}, Fig. 12", headline=3)]
    mean_um: Annotated[float, Output("mean transmission error", "TE_m", text="mean over the base pitch")]
    min_um: Annotated[float, Output("smallest transmission error", "TE_min")]
    max_um: Annotated[float, Output("largest transmission error", "TE_max")]
    harmonics_um: Annotated[
        Values,
        Output(
            "harmonics of the transmission error",
            "TE_k",
            text="amplitudes 2|c_k| of the first five mesh harmonics",
            index="order from 1",
        ),
    ]
    curves: Annotated[
        TransmissionErrorCurves | None, Output("transmission error over one base pitch", detail="curves")
    ] = None


class MeshLoss(Group):
    """Friction loss at the mean coefficient; power and efficiency are those of the transmitted power."""

    coefficient: Annotated[
        float | None,
        Output("mean coefficient of friction", "μ_m", text="the one in force; null if neither it nor an oil is given"),
    ]
    loss_factor: Annotated[float | None, Output("tooth loss factor", "H_V", text="loss factor; null without load")]
    power_w: Annotated[float | None, Output("friction power", "P_V", text="null without a coefficient of friction")]
    efficiency: Annotated[float | None, Output("mesh efficiency", "η_z", text="1 - μ_m H_V; null without load")]
