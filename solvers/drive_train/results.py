"""Results of a drive train in SI units, with read-only arrays.

Vectors are (X, Y). A positive gap separates the flanks.
"""

from collections.abc import Callable
from typing import Literal

from solvers.arrays import FloatArray
from solvers.drive_train.derived import Derived
from solvers.drive_train.inputs import ShaftName, Vector2
from solvers.drive_train.shafts.thrust_budget import Thrust
from solvers.heat_balance import FlowCurve
from solvers.heat_balance.results import FaceHeat, Heat
from solvers.notices import Notice
from solvers.quantity import computed, described, quantity, record
from solvers.scuffing.inputs import ISO_TR_15144, TS_6336_20
from solvers.scuffing.micropitting.results import Micropitting, Wear
from solvers.scuffing.results import LoadDistribution, Place
from solvers.scuffing.standard.results import ScuffingStandard
from solvers.sources import ISO_6336, REYNOLDS


@record(equation="D3")
class Parts:
    """Contributions of single causes to the slope of the gap over the face.

    Only the gap due to the shafts is meant, without the gaps due to heat and modifications. All contributions are
    computed at the loads in equilibrium:

    - `bending`, `torsion` and `tilting_moment` are due to the elastic deformation of the shafts by the mesh force.
    - `films` are due to the displacements in all bearings under all loads.
    - `bearing_offsets` are due to the offsets of the bores.
    - `coupling`, `collar` and `weight` are due to the elastic bending of the shafts by the loads of the couplings, by
      the load of the thrust collar and by the weight of the shafts.
    """

    bending: float = quantity("slope by bending", "f_b", unit="um", text="of the mesh's transverse force")
    torsion: float = quantity("slope by torsion", "f_t", unit="um", text="of both shafts")
    tilting_moment: float = quantity(
        "slope by the tilting moment", "f_m", unit="um", text="of the axial force, elastic"
    )
    films: float = quantity("slope by the bearings", "f_f", unit="um", text="yielding of the bearings of both shafts")
    films_pinion: float = quantity("slope by the pinion's bearings", "f_f1", unit="um")
    films_wheel: float = quantity("slope by the wheel's bearings", "f_f2", unit="um")
    bearing_offsets: float = quantity("slope by offsets of the bores", "f_o", unit="um")
    coupling: float = quantity(
        "slope by the couplings", "f_c", unit="um", text="elastic part; the yielding of films counts for the bearings"
    )
    collar: float = quantity("slope by the thrust collar", "f_k", unit="um", text="elastic")
    weight: float = quantity("slope by the weight", "f_w", unit="um", text="elastic")


@record
class GapCurves:
    """Gaps and force at stations of the face; the first station is at the end that meshes first.

    `total` is the sum of the gaps due to the shafts, due to heat and due to the lead modifications.
    """

    position: FloatArray = quantity("position on the face", "y", unit="mm", text="from the end that meshes first")
    z: FloatArray = quantity("position on the unit's axis", "Z", unit="mm", axis="position")
    shaft: FloatArray = quantity("gap by the shafts", "g", unit="um", axis="position")
    thermal: FloatArray = quantity("gap by heat", "Δ_th", unit="um", axis="position")
    modification: FloatArray = quantity(
        "gap as ground", "Δ_m", unit="um", text="lead part, at the pitch point", axis="position"
    )
    total: FloatArray = quantity("total gap", "Δ", unit="um", axis="position")
    line_force: FloatArray = quantity(
        "transverse force per face", "q", unit="n_per_mm", text="mean over the roll positions", axis="position"
    )


@record(equation="D13")
class Misalignment:
    """Slope, crown and range of the gap due to shafts and heat, and the modifications that compensate this gap.

    The recommended modifications replace the present modifications and are not added to them. The recommended values
    are the negative slope and the negative crown of the gap under a load that is spread evenly over the face, because a
    corrected flank carries such a load.
    """

    shaft_slope: float = quantity("mesh misalignment", "f_sh", unit="um", text="slope of the gap by the shafts")
    shaft_crown: float = quantity("crown by the shafts", "C_sh", unit="um")
    shaft_range: float = quantity("range of the shafts' gap", "R_sh", unit="um")
    shaft_mean: float = quantity(
        "mean of the shafts' gap", "g_m", unit="um", text="part of the gap that becomes transmission error"
    )
    parts: Parts = quantity("slope by parts")
    thermal_slope: float = quantity("slope by heat", "f_th", unit="um")
    thermal_crown: float = quantity("crown by heat", "C_th", unit="um")
    thermal_range: float = quantity("range of the gap by heat", "R_th", unit="um")
    thermal_profile_slope: float = quantity("profile slope by heat", "f_Hα,th", unit="um", equation="D10")
    base_pitch: float = quantity(
        "base pitch deviation by heat", "Δp_bt", unit="um", text="pinion's growth over the wheel's", equation="D10"
    )
    total_slope: float = quantity("slope by shafts and heat", "f_Hβ", unit="um")
    recommended_helix_slope: float = quantity(
        "helix slope to grind",
        "f_Hβ,rec",
        unit="um",
        text="for the pair, sized for a load spread evenly over the face",
    )
    recommended_lead_crowning: float = quantity(
        "helix crowning to grind",
        "C_β,rec",
        unit="um",
        text="for the pair; undoes only the crowns due to shafts and heat",
    )
    recommended_profile_slope: float = quantity("profile slope to grind", "f_Hα,rec", unit="um", text="of the pair")
    curves: GapCurves = quantity("gap over the face", detail="curves")


@record(equation="L17")
class FaceLoad:
    """The load over the face, and the peak-to-peak transmission error.

    The load over the face is described by the face load factor, the place of the largest face load, the largest line
    load, the largest Hertzian pressure, and the share of the flank under load.
    """

    face_load_factor: float | None = quantity(
        "face load factor", "K_Hβ", ISO_6336, text="largest over mean load across the face"
    )
    face_load_at: float | None = quantity(
        "place of the largest face load",
        "y/b",
        text="fraction of the face; null without load",
        equation="drive-train#results",
    )
    max_line_load: float = quantity("largest line load", "w_max", unit="n_per_mm", equation="Xue 9")
    max_pressure: float | None = quantity(
        "largest Hertzian pressure",
        "p_H",
        unit="mpa",
        text="null where the loaded path reaches a base circle",
        equation="Xue 14",
    )
    contact_fraction: float = quantity("contact pattern", text="share of the flank under load", equation="Xue 9")
    transmission_error_pp: float = quantity("peak-to-peak transmission error", "PPTE", unit="um", equation="L18")


@record(equation="D5")
class BearingResult:
    """Reaction and displacement of a bearing; the other results exist for plain bearings only."""

    reaction: Vector2 = quantity(
        "bearing reaction", "F_B", unit="n", text="on the shaft", index="X, Y", equation="drive-train#bearings"
    )
    displacement: Vector2 = quantity(
        "displacement in the bearing",
        "u_B",
        unit="um",
        text="of the shaft, without the bore's offset",
        index="X, Y",
        equation="drive-train#bearings",
    )
    eccentricity_ratio: float | None = quantity("eccentricity ratio", "ε", REYNOLDS, equation="D4")
    attitude: float | None = quantity(
        "attitude angle", "φ_B", REYNOLDS, unit="deg", text="of displacement against load"
    )
    min_film: float | None = quantity("thinnest film of the bearing", "h_min,B", REYNOLDS, unit="um")
    specific_pressure: float | None = quantity(
        "specific bearing pressure", "p_B", unit="mpa", text="load over the projected area"
    )
    friction_power: float = quantity("friction power of the bearing", "P_B", unit="w")


@record
class ShaftCurves:
    """Displacement and twist of a shaft's axis along Z."""

    z: FloatArray = quantity("position along the shaft", "Z", unit="mm")
    x: FloatArray = quantity("displacement along X", "u", unit="um", axis="z")
    y: FloatArray = quantity("displacement along Y", "v", unit="um", axis="z")
    twist: FloatArray = quantity("twist of the shaft", "ϑ_Z", unit="mrad", axis="z")


@record
class ShaftResult:
    """Results of a shaft."""

    bearings: tuple[BearingResult, BearingResult] = quantity("bearings", text="in the order of the request")
    thrust: Thrust = quantity("thrust")
    curves: ShaftCurves = quantity("displaced axis", detail="curves")


@record(equation="D6")
class CouplingResult:
    """Tilts and friction of both hubs of a coupling, and the loads of the coupling on the unit's hub.

    In a pair of values, the first value belongs to hub A on the unit's shaft, and the second value to hub B on the
    machine's shaft.
    """

    tilt: Vector2 = quantity(
        "tilt of the hubs",
        "δ",
        unit="mrad",
        text="of hub against sleeve",
        index="the unit's hub, the machine's",
        equation="D12",
    )
    stuck: tuple[bool, bool] = quantity(
        "sticking hubs", text="whether no tooth of a hub slides", index="the unit's hub, the machine's", equation="D8"
    )
    friction_share: Vector2 = quantity(
        "share of full sliding",
        "M_H/M_f",
        text="friction moment of a hub over that of full sliding",
        index="the unit's hub, the machine's",
        equation="D9",
    )
    moment: Vector2 = quantity("moment on the unit's hub", "M_H", unit="n_m", index="X, Y")
    force: Vector2 = quantity(
        "force on the unit's hub", "F_H", unit="n", text="with half the sleeve's weight", index="X, Y"
    )
    friction_coefficient: float = quantity(
        "coefficient of friction of the coupling", "μ", text="the smaller of both hubs", equation="C18"
    )
    thrust: float = quantity(
        "thrust of the coupling on its shaft",
        "τ F_max",
        unit="n",
        text="the stated share of the limit, along +Z",
        equation="D7",
    )
    thrust_limit: float = quantity("limit of the axial friction", "F_max", unit="n", equation="C20")
    friction_power: float = quantity(
        "friction power of the coupling", "P_C", unit="w", text="of both hubs", equation="D9"
    )
    held_thrust_fraction: float | None = quantity(
        "share of the friction limit that a tilted hub holds along the shaft",
        "τ_held",
        text="max(0, 1 − δ/δ_0) of the hub that holds less; above 0 the coupling can lock; left out without two "
        "helices",
        default=None,
        left_out=True,
        equation="D21",
    )


@record(equation="D15")
class FlashPlaces:
    """Largest flash temperatures by Blok's formula; these values are None if the contact reaches a base circle.

    `contact_max` is the largest contact temperature. The contact temperature at a place is the sum of the bulk
    temperature and the flash temperature at this place.
    """

    feature: float | None = quantity("flash temperature on the feature line", "Δθ_fl,1", unit="k")
    flank: float | None = quantity("flash temperature on the flank", "Δθ_fl,2", unit="k")
    flank_at: Place | None
    contact_max: float | None = quantity(
        "largest contact temperature",
        "θ_B,max",
        unit="c",
        text="by Blok over the flank and the feature line; null without a bulk temperature",
    )
    friction_coefficient: float | None = quantity(
        "mean coefficient of friction of the flash temperature",
        "μ_mB",
        TS_6336_20,
        text="given, or by the oil (ISO/TS 6336-20); null without both",
        equation="R5",
    )


@record(equation="D15")
class TrainSafety:
    """Safety factors by Blok's method and by thermal EHL, on the feature line and over the flank.

    Over the flank, thermal EHL is solved at the places that decide. A factor that is not known is None. If a factor is
    not known, `minimum` is None too. `standard` never counts for `minimum`.
    """

    blok_feature: float | None = quantity("safety factor on the feature line (flash temperature method)", "S_B,1")
    blok_flank: float | None = quantity("safety factor on the flank (flash temperature method)", "S_B,2")
    blok_at: Place | None = quantity("hottest place by Blok", text="null without load")
    thermal_ehl_feature: float | None = quantity("safety factor on the feature line (thermal EHL)", "S_T,1")
    thermal_ehl_profile: float | None = quantity(
        "safety factor on the flank (thermal EHL)",
        "S_T,2",
        text="at the decisive places of the flank",
    )
    minimum: float | None = quantity(
        "safety factor against scuffing", "S_B", text="smallest of the safety factors; null if one is unknown"
    )
    standard: ScuffingStandard | None = quantity(
        "scuffing by the standard",
        text="flash and integral temperature method with their own temperatures and K_Hβ of this face, beside the "
        "local check; null without an oil, load or motion",
        default=None,
    )


@record(equation="drive-train#results")
class TrainLosses:
    """Power losses of the unit, their total and the efficiency.

    If the coefficient of friction of the mesh is not known, the loss of the mesh, the total and the efficiency are
    None. With a heat balance, the loss of the mesh is calculated at the temperature of the flanks. The total then also
    contains the loss due to acceleration of the oil, the loss due to windage, and the loss in other parts.
    """

    coupling: float = quantity("loss of the couplings", "P_C", unit="w", equation="D9")
    pumping: float = quantity(
        "loss by pumping", "P_P", unit="w", text="of air and mist between the teeth", equation="P9"
    )
    mesh: float | None = quantity("loss of the mesh", "P_V", unit="w", text="null without a coefficient of friction")
    bearings: float = quantity("loss of the plain bearings", "P_B", unit="w", equation="D5")
    oil_acceleration: float | None = quantity(
        "loss by acceleration of the oil", "P_acc", unit="w", text="null without a heat balance", equation="H9"
    )
    windage: float | None = quantity(
        "loss by windage", "P_wind", unit="w", text="null without a heat balance", equation="H8"
    )
    other: float | None = quantity(
        "loss in seals and other parts",
        "P_other",
        unit="w",
        text="as given for the heat balance; null without one",
        equation="heat-balance#losses",
    )
    total: float | None = quantity("total loss", "P_L", unit="w", text="null without the loss of the mesh")
    efficiency: float | None = quantity("efficiency", "η", text="null without power, or if the losses exceed it")


@record(equation="drive-train#bearings")
class ForceBalance:
    """Largest unbalanced force on a shaft divided by F_bt, and largest unbalanced moment divided by F_bt b.

    Both values are None if the unit has no load.
    """

    force_error: float | None = quantity("unbalanced force", "ΣF/F_bt", text="largest of a shaft, over the tooth force")
    moment_error: float | None = quantity(
        "unbalanced moment", "ΣM/(F_bt b)", text="largest of a shaft, over tooth force and face"
    )


@record(equation="D11")
class Convergence:
    """Number of iterations on the gap, and the last residual."""

    iterations: int = quantity("iterations")
    residual: float = quantity("residual of the gap", "ΔΔ", unit="um")


@record
class FlankMaps:
    """Maps [profile, face] of load, pressure, temperature and film over the flank; NaN where there is no value."""

    profile_fraction: FloatArray = quantity("profile position of the map", "ξ", text="fraction of the path from A to E")
    face_fraction: FloatArray = quantity(
        "face position of the map", "η", text="fraction of the face from the end that meshes first"
    )
    line_load: FloatArray = quantity("line load", "w", unit="n_per_mm", axis=("profile_fraction", "face_fraction"))
    pressure: FloatArray = quantity(
        "Hertzian pressure",
        "p_H",
        unit="mpa",
        text="null at a base circle",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
    )
    contact_temperature: FloatArray = quantity(
        "contact temperature by Blok",
        "θ_B",
        unit="c",
        text="bulk and flash; null without a bulk temperature",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
    )
    micropitting_ratio: FloatArray | None = quantity(
        "specific film thickness against micropitting over the flank",
        "λ_GF",
        f"{ISO_TR_15144}, formula 2",
        text="null without a micropitting check and out of contact",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
        default=None,
    )


@record(kw_only=True, equation="double-helical#the-faces")
class HelixResult:
    """One helix of a double-helical unit."""

    hand: Literal["right", "left"] = quantity("hand of the helix", text="of the pinion")
    start: float = quantity("start of the helix", "z_F", unit="mm", text="its end of lowest Z")
    share: float = quantity("share of the load", "F_i/F", text="of the helix", equation="D20")
    axial_force: float = quantity(
        "axial force of the helix", "F_a", unit="n", text="on the pinion, towards +Z", equation="D20"
    )
    pinion_flank: float | None = quantity(
        "flank temperature of the helix on the pinion",
        "θ_F1",
        unit="c",
        text="mean over its face; where temperatures are uniform along the face, as if the other helix carried the "
        "same; null without a heat balance",
        equation="D24",
    )
    wheel_flank: float | None = quantity(
        "flank temperature of the helix on the wheel",
        "θ_F2",
        unit="c",
        text="mean over its face; where temperatures are uniform along the face, as if the other helix carried the "
        "same; null without a heat balance",
        equation="D24",
    )
    bulk: float | None = quantity(
        "bulk temperature of the helix",
        "θ_M",
        unit="c",
        text="of its contact; null without an oil, unless given",
        equation="D15",
    )
    face_heat: FaceHeat | None = quantity(
        "temperatures along the helix", text="left out where they are uniform", default=None, left_out=True
    )
    misalignment: Misalignment = quantity("misalignment", text="gap over the face, by causes")
    load: FaceLoad = quantity("load", text="how the face carries")
    flash: FlashPlaces = quantity("flash temperature")
    safety: TrainSafety | None = quantity("safety", text="safety factors; null without a scuffing temperature")
    micropitting: Micropitting | None = quantity(
        "micropitting", text="film against micropitting; null if not asked for"
    )
    wear: Wear | None = quantity("wear", text="mild wear; null without a wear coefficient")
    mesh: LoadDistribution = described("Load distribution of the helix.")
    contact_temperature: FloatArray = described("Contact temperature by Blok over the flank [profile, face] [K].")
    film_ratio: FloatArray | None = described(
        "Film ratio against micropitting over the flank [profile, face]; or None."
    )


_Number = float  # the class below has a field of the name `float`


@record(kw_only=True, equation="D20")
class AxialBalance:
    """The axial balance of the shaft that floats, which splits the load over two helices."""

    apex: Literal["leading", "trailing"] = quantity(
        "apex of the helices", text="leading: both helices mesh first at the gap; trailing: at their outer ends"
    )
    floating_shaft: ShaftName = quantity("shaft that floats", text="held along Z by the mesh alone")
    force: _Number = quantity(
        "axial force on the floating shaft", "F_ext", unit="n", text="external and of its couplings, towards +Z"
    )
    share_factor: _Number = quantity("load factor of unequal shares", "K_γ", text="larger share over half the load")
    share_bounds: tuple[Vector2, Vector2] = quantity(
        "bounds of the shares",
        "F_i/F",
        text="with the couplings' friction at its limit towards -Z and towards +Z",
        index="thrust towards -Z, towards +Z; helix",
    )
    unloading_force: _Number = quantity(
        "axial force that unloads a helix", "F_bt tan β_b", unit="n", text="at which one helix lifts off"
    )
    runout_thrust_fraction: _Number | None = quantity(
        "share of the friction limit by the apex's runout",
        "τ_A",
        text="(2/π) asin(e_A/(r_o (δ_A + δ_B))) of the sliding hubs; null without a runout or a coupling on the "
        "floating shaft",
        equation="D21",
    )
    float: _Number | None = quantity(
        "axial float", "a", unit="um", text="of the pinion against the wheel, towards +Z", equation="D22"
    )


@record
class States:
    """The unit in states other than the hot state; a state without a solution is None."""

    cold: "DriveTrainResult | None" = quantity("cold unit", text="as drawn, at the reference temperature")


@record
class DriveTrainResult:
    """The result of a gear unit."""

    misalignment: Misalignment = quantity("misalignment", text="gap over the face, by causes")
    load: FaceLoad = quantity("load", text="how the face carries")
    shafts: tuple[ShaftResult, ShaftResult] = quantity("shafts", text="the pinion's and the wheel's")
    couplings: tuple[CouplingResult, ...] = quantity(
        "couplings", text="in the order of the request; empty without effect"
    )
    flash: FlashPlaces = quantity("flash temperature")
    safety: TrainSafety | None = quantity("safety", text="safety factors; null without a scuffing temperature")
    losses: TrainLosses = quantity("losses")
    balance: ForceBalance = quantity("balance", text="forces and moments on the shafts")
    convergence: Convergence = quantity("convergence")
    micropitting: Micropitting | None = quantity(
        "micropitting", text="null unless asked for, with an oil and a bulk temperature"
    )
    wear: Wear | None = quantity("wear", text="mild wear; null without a wear coefficient")
    heat: Heat | None = quantity("heat balance", text="null unless the bulk temperature comes from a heat balance")
    over_the_flow: Callable[[FloatArray], FlowCurve] | None = described(
        "Function that returns the temperatures of the heat balance at other oil flows [m^3/s]; None without a balance."
    )
    mesh: LoadDistribution = described("Load distribution in equilibrium with the gap of the whole unit.")
    contact_temperature: FloatArray = described("Contact temperature by Blok over the flank [profile, face] [K].")
    film_ratio: FloatArray | None = described(
        "Film ratio against micropitting over the flank [profile, face]; None if it is not asked for [-]."
    )
    warnings: tuple[Notice, ...]
    derived: Derived = quantity("what was left open, as used")
    states: States | None = quantity("states", text="null unless other states were asked for", default=None)
    axial: AxialBalance | None = quantity(
        "axial balance", text="of double-helical gears; left out otherwise", default=None, left_out=True
    )
    helices: tuple[HelixResult, ...] | None = quantity(
        "helices", text="of double-helical gears, in the order of Z; left out otherwise", default=None, left_out=True
    )
    decisive_helix: int | None = quantity(
        "decisive helix",
        text="1 at the lower Z, or 2: the one with the least safety, else the largest pressure, whose results stand "
        "above; left out without two helices",
        default=None,
        left_out=True,
        equation="double-helical#which-helix-decides",
    )

    @property
    @computed("over the flank", detail="fields")
    def flank(self) -> FlankMaps:
        """Maps over the flank."""
        maps = self.mesh.flank
        return FlankMaps(
            maps.profile_fraction,
            maps.face_fraction,
            maps.line_load,
            maps.pressure,
            self.contact_temperature,
            self.film_ratio,
        )
