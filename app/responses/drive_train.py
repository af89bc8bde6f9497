"""A gear unit whole: response of /v1/drive-train."""

from typing import Annotated, ClassVar

from app.responses.drive_train_parts import DriveTrainDerived, ShaftState, ShaftSummary, StateDerived, UnitCouplingState
from app.responses.gear_mesh import ISO_6336, Values
from app.responses.load_distribution import MAP, FlankPlace, Gaps
from app.schema.base import Group, Response
from app.schema.quantities import Output
from solvers.quantity import UNITS


class MisalignmentParts(Group):
    """Slope of the shafts' gap over the face by its causes, as the load lies that shafts and mesh agreed on."""

    member_unit: ClassVar = UNITS["um"]

    bending: Annotated[float, Output("slope by bending", "f_b", text="of the mesh's transverse force")]
    torsion: Annotated[float, Output("slope by torsion", "f_t", text="of both shafts")]
    tilting_moment: Annotated[float, Output("slope by the tilting moment", "f_m", text="of the axial force, elastic")]
    films: Annotated[
        float, Output("slope by the bearings", "f_f", text="by what yields in the bearings of both shafts")
    ]
    films_pinion: Annotated[float, Output("slope by the pinion's bearings", "f_f1")]
    films_wheel: Annotated[float, Output("slope by the wheel's bearings", "f_f2")]
    bearing_offsets: Annotated[float, Output("slope by offsets of the bores", "f_o")]
    coupling: Annotated[
        float, Output("slope by the couplings", "f_c", text="elastic; what films yield to it is theirs")
    ]
    collar: Annotated[float, Output("slope by the thrust collar", "f_k", text="elastic")]
    weight: Annotated[float, Output("slope by the weight", "f_w", text="elastic")]


class GapCurves(Group):
    """Over the face, positive where the flanks part."""

    position_mm: Annotated[Values, Output("position on the face", "y", text="from the end that meshes first")]
    z_mm: Annotated[Values, Output("position on the unit's axis", "Z", axis="position_mm")]
    shaft_um: Annotated[Values, Output("gap by the shafts", "g", axis="position_mm")]
    thermal_um: Annotated[Values, Output("gap by heat", "Δ_th", axis="position_mm")]
    modification_um: Annotated[
        Values, Output("gap as ground", "Δ_m", text="lead part, at the pitch point", axis="position_mm")
    ]
    total_um: Annotated[Values, Output("gap in all", "Δ", axis="position_mm")]
    line_force_n_per_mm: Annotated[
        Values, Output("transverse force per face", "q", text="mean over the roll positions", axis="position_mm")
    ]


class MisalignmentSummary(Group):
    """Gap over the face by shafts and heat; minus: it opens towards the end that meshes first, which carries less."""

    shaft_slope_um: Annotated[float, Output("slope by the shafts", "f_sh", headline=3)]
    shaft_crown_um: Annotated[float, Output("crown by the shafts", "C_sh")]
    shaft_range_um: Annotated[float, Output("range of the shafts' gap", "R_sh")]
    shaft_mean_um: Annotated[float, Output("mean of the shafts' gap", "g_m", text="which the transmission error takes")]
    parts: Annotated[MisalignmentParts, Output("slope by parts")]
    thermal_slope_um: Annotated[float, Output("slope by heat", "f_th")]
    thermal_crown_um: Annotated[float, Output("crown by heat", "C_th")]
    thermal_range_um: Annotated[float, Output("range of the gap by heat", "R_th")]
    thermal_profile_slope_um: Annotated[float, Output("profile slope by heat", "f_Hα,th")]
    base_pitch_um: Annotated[
        float, Output("base pitch error by heat", "Δp_bt", text="pinion's growth over the wheel's")
    ]
    total_slope_um: Annotated[float, Output("slope by shafts and heat", "f_Hβ")]
    recommended_helix_slope_um: Annotated[
        float, Output("helix slope to grind", "f_Hβ,rec", text="in all; sized at a load spread evenly over the face")
    ]
    recommended_lead_crowning_um: Annotated[
        float, Output("helix crowning to grind", "C_β,rec", text="in all; it only undoes crowns of shafts and heat")
    ]
    recommended_profile_slope_um: Annotated[float, Output("profile slope to grind", "f_Hα,rec", text="in all")]


class MisalignmentState(MisalignmentSummary):
    """Gap over the face with its curves."""

    curves: Annotated[GapCurves | None, Output("gap over the face", detail="curves")] = None


class TrainLoad(Group):
    """How the face carries."""

    face_load_factor: Annotated[
        float | None,
        Output("face load factor", "K_Hβ", ISO_6336, text="largest over mean load across the face", headline=2),
    ]
    face_load_at: Annotated[
        float | None, Output("place of the largest face load", "y/b", text="fraction of the face; null without load")
    ]
    max_line_load_n_per_mm: Annotated[float, Output("largest line load", "w_max")]
    max_pressure_mpa: Annotated[
        float | None,
        Output("largest Hertz pressure", "p_H", text="null where the loaded path reaches a base circle"),
    ]
    contact_fraction: Annotated[float, Output("contact pattern", text="share of the flank under load")]
    transmission_error_pp_um: Annotated[float, Output("peak-to-peak transmission error", "PPTE")]


class TrainFlash(Group):
    """Largest flash temperature by Blok."""

    feature_k: Annotated[float | None, Output("flash temperature on the feature line", "Δθ_fl,1")]
    flank_k: Annotated[float | None, Output("flash temperature on the flank", "Δθ_fl,2")]


class TrainSafety(Group):
    """Safety against scuffing; thermal EHL values are null in closed form, or where a point is not known."""

    blok_feature: Annotated[
        float | None, Output("scuffing safety on the feature line", "S_B,1", limit=1.0, bound="lower")
    ]
    blok_flank: Annotated[float | None, Output("scuffing safety on the flank", "S_B,2", limit=1.0, bound="lower")]
    blok_at: Annotated[FlankPlace | None, Output("hottest place by Blok", text="null without load")]
    thermal_ehl_feature: Annotated[
        float | None, Output("scuffing safety by thermal EHL on the feature line", "S_T,1", limit=1.0, bound="lower")
    ]
    thermal_ehl_profile: Annotated[
        float | None,
        Output(
            "scuffing safety by thermal EHL on the worst profile",
            "S_T,2",
            text="on the profile line through the hottest place by Blok",
            limit=1.0,
            bound="lower",
        ),
    ]
    minimum: Annotated[
        float | None,
        Output(
            "scuffing safety",
            "S_B",
            text="least of all; null where one is unknown",
            headline=1,
            limit=1.0,
            bound="lower",
        ),
    ]


class TrainLosses(Group):
    """What the unit loses."""

    coupling_w: Annotated[float, Output("loss of the couplings", "P_C")]
    pumping_w: Annotated[float, Output("loss by pumping", "P_P", text="of air and mist between the teeth")]
    mesh_w: Annotated[float | None, Output("loss of the mesh", "P_V", text="null without a coefficient of friction")]
    bearings_w: Annotated[float, Output("loss of the plain bearings", "P_B")]
    total_w: Annotated[float | None, Output("loss in all", "P_L", text="null without the loss of the mesh")]
    efficiency: Annotated[
        float | None, Output("efficiency", "η", text="null without power, or where the losses exceed it")
    ]


class TrainBalance(Group):
    """How well forces and moments on the shafts balance; null without load."""

    force_error: Annotated[
        float | None, Output("unbalanced force", "ΣF/F_bt", text="largest of a shaft, over the tooth force")
    ]
    moment_error: Annotated[
        float | None, Output("unbalanced moment", "ΣM/(F_bt b)", text="largest of a shaft, over tooth force and face")
    ]


class TrainConvergence(Group):
    """How shafts and mesh came to one gap."""

    iterations: Annotated[int, Output("iterations")]
    residual_um: Annotated[float, Output("residual of the gap", "ΔΔ")]


class TrainMaps(Group):
    """Over the flank, `[profile][face]`."""

    profile_fraction: Annotated[
        Values, Output("profile position of the map", "ξ", text="fraction of the path from A to E")
    ]
    face_fraction: Annotated[
        Values, Output("face position of the map", "η", text="fraction of the face from the end that meshes first")
    ]
    line_load_n_per_mm: Annotated[list[Values], Output("line load", "w", axis=MAP)]
    pressure_mpa: Annotated[
        list[Gaps], Output("Hertz pressure", "p_H", text="null where the reduced radius vanishes", axis=MAP)
    ]
    contact_temperature_c: Annotated[
        list[Gaps], Output("contact temperature by Blok", "θ_B", text="bulk and flash; null without an oil", axis=MAP)
    ]


class TrainSummary(Group):
    """The unit in another state, in short."""

    misalignment: Annotated[MisalignmentSummary, Output("misalignment")]
    load: Annotated[TrainLoad, Output("load")]
    shafts: Annotated[list[ShaftSummary], Output("shafts", text="the pinion's and the wheel's")]
    couplings: Annotated[list[UnitCouplingState], Output("couplings")]
    flash: Annotated[TrainFlash, Output("flash temperature")]
    safety: Annotated[TrainSafety | None, Output("safety")]
    losses: Annotated[TrainLosses, Output("losses")]
    balance: Annotated[TrainBalance, Output("balance")]
    convergence: Annotated[TrainConvergence, Output("convergence")]
    derived: Annotated[StateDerived, Output("what was left open, as used")]


class TrainStates(Group):
    """The unit in other states than the one described."""

    cold: Annotated[TrainSummary | None, Output("cold unit", text="as drawn, at the reference temperature")]


class DriveTrainResponse(Response):
    """A gear unit whole; sections are missing where there is no solution."""

    misalignment: Annotated[MisalignmentState | None, Output("misalignment", text="gap over the face, by causes")] = (
        None
    )
    load: Annotated[TrainLoad | None, Output("load", text="how the face carries")] = None
    shafts: Annotated[list[ShaftState] | None, Output("shafts", text="the pinion's and the wheel's")] = None
    couplings: Annotated[
        list[UnitCouplingState] | None, Output("couplings", text="in the order of the request; empty without effect")
    ] = None
    flash: Annotated[TrainFlash | None, Output("flash temperature")] = None
    safety: Annotated[
        TrainSafety | None, Output("safety", text="safety against scuffing; null without a scuffing temperature")
    ] = None
    losses: Annotated[TrainLosses | None, Output("losses")] = None
    balance: Annotated[TrainBalance | None, Output("balance", text="forces and moments on the shafts")] = None
    convergence: Annotated[TrainConvergence | None, Output("convergence")] = None
    flank: Annotated[TrainMaps | None, Output("over the flank", detail="fields")] = None
    states: Annotated[TrainStates | None, Output("states", text="null unless other states were asked for")] = None
    derived: Annotated[DriveTrainDerived | None, Output("what was left open, as used")] = None
