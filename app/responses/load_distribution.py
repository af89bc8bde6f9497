"""How a gear pair carries its load: response of /v1/scuffing/load-distribution."""

from typing import Annotated

from app.responses.gear_mesh import (
    ISO_6336,
    XUE,
    ContactLineLengths,
    MeshLoss,
    ScuffingGeometry,
    ToothStiffness,
    TransmissionErrorResult,
    Values,
)
from app.schema.base import Derived, Group, Response
from app.schema.quantities import Output

Gaps = list[float | None]
MAP = ("profile_fraction", "face_fraction")


class MeshDerived(Derived):
    """Load and lengths where the request left them open."""

    pinion_torque_n_m: Annotated[float, Output("pinion torque used", "T_1")]
    power_kw: Annotated[float, Output("power used", "P")]
    centre_distance_mm: Annotated[float, Output("centre distance used", "a")]
    tip_relief_length_mm: Annotated[float, Output("tip relief length used", "L_Ca")]
    root_relief_length_mm: Annotated[float, Output("root relief length used", "L_Cf")]
    end_relief_length_mm: Annotated[float, Output("end relief length used", "L_Ce")]


class ScuffingDerived(MeshDerived):
    """Load and lengths where the request left them open, and what is used of the rack."""

    rack_tip_radius: Annotated[
        float, Output("rack tip radius used", "ρ_fP*", text="in normal modules, as far as both racks have room for it")
    ]


class FlankPlace(Group):
    """A point of the flank."""

    gamma: Annotated[float, Output("profile parameter", "Γ", text="profile parameter, 0 at the pitch point")]
    profile_fraction: Annotated[float, Output("profile position", "ξ", text="fraction of the path from A to E")]
    face_fraction: Annotated[
        float, Output("face position", "η", text="fraction of the face from the end that meshes first")
    ]


class FlankLoad(Group):
    """Load on the flank."""

    pinion_torque_n_m: Annotated[float, Output("pinion torque", "T_1", text="the transmitted one")]
    contact_factor: Annotated[
        float, Output("load factor of the contacts", "K", text="K_A K_v K_γ: multiplies the forces below")
    ]
    tangential_force_n: Annotated[
        float, Output("transverse tooth force", "F_bt", f"{XUE}, Eq. 1", text="force in the transverse plane")
    ]
    normal_force_n: Annotated[float, Output("force in the balance", "F_bn")]
    max_line_load_n_per_mm: Annotated[
        float, Output("largest line load", "w_max", f"{XUE}, Fig. 11", text="largest over all roll positions")
    ]
    max_at: Annotated[FlankPlace | None, Output("place of the largest line load", text="where; null without load")]
    contact_fraction: Annotated[
        float, Output("contact pattern", text="share of the flank under load, weighted by contact length")
    ]
    face_load_factor: Annotated[
        float | None,
        Output("face load factor", "K_Hβ", ISO_6336, text="largest over mean load across the face", headline=2),
    ]
    balance_error: Annotated[float, Output("load balance error", text="force left over, relative")]
    pair_share: Annotated[
        list[Values] | None,
        Output(
            "load share of each line",
            "F_i/F",
            text="force share of each line over the roll positions",
            detail="fields",
            index="line, roll position",
        ),
    ] = None


class FlankPressure(Group):
    """Dry Hertz pressure."""

    max_mpa: Annotated[
        float | None,
        Output(
            "largest Hertz pressure",
            "p_H",
            f"{XUE}, Eq. 14",
            text="largest over all roll positions; null where the loaded path reaches a base circle",
            headline=1,
        ),
    ]
    max_at: Annotated[
        FlankPlace | None, Output("place of the largest pressure", text="where; null without load or largest pressure")
    ]


class FeatureLineCurves(Group):
    """Along the feature line from A1 to E2; the points A, C and E of the path lie on it."""

    psi: Annotated[
        Values, Output("feature line position", "Ψ", f"{XUE}, Fig. 18", text="fraction of the feature line, A1 to E2")
    ]
    gamma: Annotated[Values, Output("profile parameter along the feature line", "Γ", axis="psi")]
    line_load_n_per_mm: Annotated[
        Values, Output("line load along the feature line", "w", f"{XUE}, Fig. 18", axis="psi")
    ]
    pressure_mpa: Annotated[
        Gaps,
        Output(
            "Hertz pressure along the feature line", "p_H", text="null where the reduced radius vanishes", axis="psi"
        ),
    ]
    half_width_mm: Annotated[Values, Output("half width of the contact", "b_0", axis="psi")]
    radius_mm: Annotated[
        Values,
        Output("reduced radius", "R_n", f"{XUE}, Eq. 13", text="reduced radius across the contact line", axis="psi"),
    ]
    pinion_speed_m_per_s: Annotated[Values, Output("surface speed of the pinion", "u_1", f"{XUE}, Eq. 18", axis="psi")]
    wheel_speed_m_per_s: Annotated[Values, Output("surface speed of the wheel", "u_2", f"{XUE}, Eq. 18", axis="psi")]
    sliding_m_per_s: Annotated[Values, Output("sliding speed", "u_1 − u_2", axis="psi")]
    iso_load_sharing: Annotated[
        Values | None,
        Output(
            "load sharing by ISO/TR 13989-1",
            "X_Γ,ISO",
            "ISO/TR 13989-1, from memory",
            text="the standard's diagram; null where it has none",
            axis="psi",
        ),
    ]
    load_sharing: Annotated[
        Values | None,
        Output("load sharing", "X_Γ", f"{XUE}, Fig. 19", text="w b / F_bt; null without load", axis="psi"),
    ]


class FlankFields(Group):
    """Over the flank, `[profile][face]`."""

    profile_fraction: Annotated[
        Values, Output("profile position of the map", "ξ", text="fraction of the path from A to E")
    ]
    face_fraction: Annotated[
        Values, Output("face position of the map", "η", text="fraction of the face from the end that meshes first")
    ]
    modification_um: Annotated[
        list[Values],
        Output("modification", "Δ", f"{XUE}, Fig. 15", text="gap between the unloaded flanks", axis=MAP),
    ]
    line_load_n_per_mm: Annotated[list[Values], Output("line load", "w", f"{XUE}, Fig. 11", axis=MAP)]
    pressure_mpa: Annotated[
        list[Gaps],
        Output("Hertz pressure", "p_H", f"{XUE}, Figs. 13-17", text="null where the reduced radius vanishes", axis=MAP),
    ]


class LoadDistributionResponse(Response):
    """How a gear pair carries its load; sections are missing where there is no solution."""

    geometry: Annotated[ScuffingGeometry | None, Output("mesh", text="the mesh")] = None
    contact_lines: Annotated[ContactLineLengths | None, Output("length of the contact lines")] = None
    stiffness: Annotated[ToothStiffness | None, Output("stiffness of teeth and mesh")] = None
    transmission_error: Annotated[TransmissionErrorResult | None, Output("transmission error of the mesh")] = None
    load: Annotated[FlankLoad | None, Output("load on the flank")] = None
    pressure: Annotated[FlankPressure | None, Output("Hertz pressure of the flank")] = None
    friction_loss: Annotated[MeshLoss | None, Output("friction loss")] = None
    feature_line: Annotated[FeatureLineCurves | None, Output("along the feature line", detail="curves")] = None
    flank: Annotated[FlankFields | None, Output("over the flank", detail="fields")] = None
    derived: Annotated[ScuffingDerived | None, Output("load and lengths used")] = None
