"""Results of a load distribution; SI units, read-only arrays.

x runs along the path from A to E; y runs along the face from the end that meshes first; gamma is the profile parameter.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from solvers.arrays import BoolArray, FloatArray, frozen
from solvers.gears.diameters import Diameters
from solvers.gears.pair import PathOfContact
from solvers.gears.tolerances import FlankTolerances
from solvers.notices import Notice
from solvers.quantity import computed, quantity, record
from solvers.scuffing.load_balance import LoadBalance
from solvers.sources import ISO_6336, SCHLENK, XUE


@record(equation="Xue 9")
class Place:
    """A point of the flank.

    The position along the path is given in two ways: by the profile parameter, and by the fraction of the path from A.
    The position on the face is given by the fraction of the face from the end that meshes first.
    """

    gamma: float = quantity("profile parameter", "Γ", text="profile parameter, 0 at the pitch point")
    profile_fraction: float = quantity("profile position", "ξ", text="fraction of the path from A to E")
    face_fraction: float = quantity("face position", "η", text="fraction of the face from the end that meshes first")


@record(equation="L1")
class Geometry(Diameters):
    """Geometry of the mesh: lengths [m], angles [rad]; `undercut` is True if either gear is undercut."""

    centre_distance: float = quantity("centre distance", "a", unit="mm", text="centre distance in use")
    working_pressure_angle: float = quantity(
        "working transverse pressure angle", "α_wt", unit="deg", text="working transverse pressure angle"
    )
    base_helix_angle: float = quantity("base helix angle", "β_b", unit="deg", equation="load-distribution#geometry")
    transverse_base_pitch: float = quantity(
        "transverse base pitch", "p_bt", f"{XUE}, Eq. 2", unit="mm", equation="load-distribution#geometry"
    )
    path_of_contact: float = quantity("length of the path of contact", "g_α", unit="mm", equation="L2")
    transverse_contact_ratio: float = quantity("transverse contact ratio", "ε_α", f"{XUE}, Eq. 2", equation="Xue 2")
    overlap_ratio: float = quantity("overlap ratio", "ε_β", f"{XUE}, Eq. 3", equation="Xue 3")
    total_contact_ratio: float = quantity("total contact ratio", "ε_γ", f"{XUE}, Table 1", equation="Xue 3")
    undercut: bool = quantity("undercut", text="whether either gear is undercut", equation="load-distribution#geometry")


@record
class LengthCurves:
    """Total contact length [m] as a function of the roll position, which is a fraction of the base pitch.

    If the contact length of a spur gear jumps at a roll position, this position occurs twice: with the length before
    the jump and with the length after the jump.
    """

    roll_position: FloatArray = quantity(
        "roll position of the contact length", "φ/p_bt", text="roll position over the base pitch"
    )
    length: FloatArray = quantity(
        "total length of the contact lines", "L", f"{XUE}, Fig. 5", unit="mm", axis="roll_position"
    )


@record(equation="Xue 4")
class ContactLines:
    """Shortest, longest and mean total length of the contact lines [m], computed in closed form."""

    min_length: float = quantity("shortest contact length", "L_min", XUE, unit="mm")
    max_length: float = quantity("longest contact length", "L_max", XUE, unit="mm")
    mean_length: float = quantity("mean contact length", "L_m", f"{XUE}, Eq. 4", unit="mm")
    length_ratio: float = quantity("contact length ratio", "ς", f"{XUE}, Fig. 6", text="shortest over longest")
    curves: LengthCurves = quantity("contact length over one base pitch", detail="curves")


@record
class StiffnessCurves:
    """Stiffness of one pair of teeth [Pa] as a function of the profile parameter gamma."""

    gamma: FloatArray = quantity(
        "profile parameter of the stiffness", "Γ", text="profile parameter, 0 at the pitch point"
    )
    single: FloatArray = quantity("stiffness of one pair", "k", f"{XUE}, Eq. 7", unit="n_per_mm_um", axis="gamma")


@record(equation="Xue 7")
class Stiffness:
    """Stiffness per face width [Pa] of one pair of teeth and of the mesh.

    The stiffness of one pair is the secant stiffness at the line load `secant_load` [N/m]. `approach`, `pitch` and
    `recess` are the stiffnesses of one pair at A, at the pitch point and at E. `pitch` is None if the pitch point lies
    outside the path. `mean_mesh` is None without load. `standard_single` and `standard_mesh` follow ISO 6336-1,
    method B.
    """

    max: float = quantity("largest stiffness of one pair", "k_max", f"{XUE}, Fig. 8", unit="n_per_mm_um")
    max_at_gamma: float = quantity(
        "place of the largest stiffness", "Γ_k,max", f"{XUE}, Fig. 8", text="by the profile parameter"
    )
    approach: float = quantity("stiffness of one pair at A", "k_A", unit="n_per_mm_um")
    pitch: float | None = quantity(
        "stiffness of one pair at C",
        "k_C",
        unit="n_per_mm_um",
        text="at the pitch point; null where the path does not hold it",
    )
    recess: float = quantity("stiffness of one pair at E", "k_E", unit="n_per_mm_um")
    mean_mesh: float | None = quantity(
        "mean mesh stiffness",
        "c_γ",
        unit="n_per_mm_um",
        text="mean of the loaded mesh; null without load",
        equation="L15",
    )
    standard_single: float = quantity(
        "single stiffness by ISO 6336-1", "c'", ISO_6336, unit="n_per_mm_um", equation="L16"
    )
    standard_mesh: float = quantity(
        "mesh stiffness by ISO 6336-1", "c_γα", ISO_6336, unit="n_per_mm_um", equation="L16"
    )
    secant_load: float = quantity(
        "line load of the stiffnesses",
        "w_s",
        unit="n_per_mm",
        text="line load at which the stiffnesses hold: the mean, or 100 N/mm without load",
    )
    curves: StiffnessCurves = quantity("stiffness along the path", detail="curves")


@record
class ErrorCurves:
    """Transmission error [m] as a function of the roll position, which is a fraction of the base pitch.

    If the error of a spur gear jumps at a roll position, this position occurs twice: with the error before the jump and
    with the error after the jump.
    """

    roll_position: FloatArray = quantity(
        "roll position of the transmission error", "φ/p_bt", text="roll position over the base pitch"
    )
    error: FloatArray = quantity(
        "transmission error",
        "TE",
        f"{XUE}, Fig. 12",
        unit="um",
        text="along the transverse line of action",
        axis="roll_position",
    )


@record(equation="L18")
class TransmissionError:
    """Transmission error along the transverse line of action [m].

    `harmonics` are the amplitudes 2 |c_k| of the orders k = 1, 2, and so on.
    """

    peak_to_peak: float = quantity("peak-to-peak transmission error", "PPTE", f"{XUE}, Fig. 12", unit="um")
    mean: float = quantity("mean transmission error", "TE_m", unit="um", text="mean over the base pitch")
    min: float = quantity("smallest transmission error", "TE_min", unit="um")
    max: float = quantity("largest transmission error", "TE_max", unit="um")
    harmonics: FloatArray = quantity(
        "harmonics of the transmission error",
        "TE_k",
        unit="um",
        text="amplitudes 2|c_k| of the first five mesh harmonics",
        index="order from 1",
    )
    curves: ErrorCurves = quantity("transmission error over one base pitch", detail="curves")


@record(equation="Xue 1")
class LoadOnFlank:
    """Forces [N], torque [N m], largest line load [N/m] and its place, and loaded share of the contact length.

    `pinion_torque` is the transmitted torque; the forces follow from the torque `pinion_torque` times `contact_factor`.
    `tangential_force` is F_bt. `normal_force` is the force that the load balance distributes over the contact lines.
    `pair_share` [line, roll position] is the force on a contact line, divided by `normal_force`.
    """

    pinion_torque: float = quantity("pinion torque", "T_1", unit="n_m", text="the transmitted one")
    contact_factor: float = quantity(
        "load factor of the contacts", "K", text="K_A K_v K_γ: multiplies the forces below"
    )
    tangential_force: float = quantity(
        "transverse tooth force", "F_bt", f"{XUE}, Eq. 1", unit="n", text="force in the transverse plane"
    )
    normal_force: float = quantity("force in the balance", "F_bn", unit="n")
    max_line_load: float = quantity(
        "largest line load",
        "w_max",
        f"{XUE}, Fig. 11",
        unit="n_per_mm",
        text="largest over all roll positions",
        equation="Xue 9",
    )
    max_at: Place | None = quantity("place of the largest line load", text="where; null without load")
    contact_fraction: float = quantity(
        "contact pattern", text="share of the flank under load, weighted by contact length", equation="Xue 9"
    )
    face_load_factor: float | None = quantity(
        "face load factor", "K_Hβ", ISO_6336, text="largest over mean load across the face", equation="L17"
    )
    balance_error: float = quantity("load balance error", text="relative error of the load balance", equation="Xue 11")
    pair_share: FloatArray | None = quantity(
        "load share of each line",
        "F_i/F",
        text="force share of each line over the roll positions",
        detail="fields",
        index="line, roll position",
        equation="Xue 9",
    )


@record(equation="Xue 14")
class Pressure:
    """Largest Hertzian pressure [Pa] over all roll positions, and its place.

    Pressure and place are None if the loaded path reaches a base circle, because the pressure has no limit there.
    """

    max: float | None = quantity(
        "largest Hertzian pressure",
        "p_H",
        f"{XUE}, Eq. 14",
        unit="mpa",
        text="largest over all roll positions; null where the loaded path reaches a base circle",
    )
    max_at: Place | None = quantity(
        "place of the largest pressure", text="where; null without load or largest pressure"
    )


@record(equation="L19")
class FrictionLoss:
    """Mean coefficient of friction, loss factor H_V, friction power [W] and efficiency.

    Loss factor and efficiency are None without load. Power and efficiency are None without a coefficient of friction.
    """

    coefficient: float | None = quantity(
        "mean coefficient of friction of the losses",
        "μ_m",
        SCHLENK,
        text="given, or by the oil (Schlenk); null without both",
        equation="R10",
    )
    loss_factor: float | None = quantity("tooth loss factor", "H_V", text="loss factor; null without load")
    power: float | None = quantity("friction power", "P_V", unit="w", text="null without a coefficient of friction")
    efficiency: float | None = quantity("mesh efficiency", "η_z", text="1 − μ_m H_V; null without load")


@record(equation="D20")
class HelixShare:
    """Share of the load that the more loaded helix of a double-helical pair carries."""

    share: float = quantity("share of the more loaded helix", "F_i/F")
    share_factor: float = quantity("load factor of unequal shares", "K_γ", text="larger share over half the load")
    unloading_force: float = quantity(
        "axial force that unloads a helix", "F_bt tan β_b", unit="n", text="at which one helix lifts off"
    )


@dataclass(frozen=True, slots=True)
class ContactPoints:
    """Contacts at points of the flank.

    The fields are arrays over the points: line load [N/m], half width [m], reduced radius [m], surface speeds [m/s].
    """

    line_load: FloatArray
    half_width: FloatArray
    radius: FloatArray
    pinion_speed: FloatArray
    wheel_speed: FloatArray

    @property
    def in_contact(self) -> BoolArray:
        """True at points at which the flanks touch and move.

        Film and flash temperature have a meaning only at these points.
        """
        return (self.line_load > 0.0) & (self.half_width > 0.0) & (self.pinion_speed + self.wheel_speed > 0.0)

    @property
    def undefined(self) -> BoolArray:
        """True at loaded points that are too near a base circle.

        Such points have no contact width, no pressure and no flash temperature.
        """
        return (self.line_load > 0.0) & (self.half_width <= 0.0)


@record(kw_only=True)
class FeatureLine:
    """Points along the feature line.

    `load_sharing` is None without load. `iso_load_sharing` is None if ISO/TS 6336-20 has no diagram for the pair. The
    pressure is NaN at points where the reduced radius vanishes.
    """

    gamma: FloatArray = quantity("profile parameter along the feature line", "Γ", axis="psi")
    line_load: FloatArray = quantity(
        "line load along the feature line", "w", f"{XUE}, Fig. 18", unit="n_per_mm", axis="psi"
    )
    pressure: FloatArray = quantity(
        "Hertzian pressure along the feature line",
        "p_H",
        unit="mpa",
        text="null at a base circle",
        axis="psi",
        gaps=True,
    )
    half_width: FloatArray = quantity("half width of the contact", "b_0", unit="mm", axis="psi")
    radius: FloatArray = quantity(
        "radius of relative curvature",
        "R_n",
        f"{XUE}, Eq. 13",
        unit="mm",
        text="reduced radius across the contact line",
        axis="psi",
    )
    pinion_speed: FloatArray = quantity(
        "surface speed of the pinion", "u_1", f"{XUE}, Eq. 18", unit="m_per_s", axis="psi"
    )
    wheel_speed: FloatArray = quantity(
        "surface speed of the wheel", "u_2", f"{XUE}, Eq. 18", unit="m_per_s", axis="psi"
    )
    psi: FloatArray = quantity(
        "feature line position", "Ψ", f"{XUE}, Fig. 18", text="fraction of the feature line, A1 to E2"
    )
    load_sharing: FloatArray | None = quantity(
        "load sharing", "X_Γ", f"{XUE}, Fig. 19", text="w b / F_bt; null without load", axis="psi"
    )
    iso_load_sharing: FloatArray | None = quantity(
        "load sharing by ISO/TS 6336-20",
        "X_Γ,ISO",
        "ISO/TS 6336-20, quoted, not verified against the standard",
        text="the standard's diagram; null where it has none",
        axis="psi",
    )

    @property
    @computed("sliding speed", "u_1 − u_2", unit="m_per_s", axis="psi")
    def sliding(self) -> FloatArray:
        """Sliding velocity u_1 - u_2 [m/s]."""
        return frozen(self.pinion_speed - self.wheel_speed)


@record
class Flank:
    """Maps [profile, face] of modification [m], line load [N/m] and pressure [Pa].

    The pressure is NaN at points where the reduced radius R_n vanishes.
    """

    profile_fraction: FloatArray = quantity("profile position of the map", "ξ", text="fraction of the path from A to E")
    face_fraction: FloatArray = quantity(
        "face position of the map", "η", text="fraction of the face from the end that meshes first"
    )
    modification: FloatArray = quantity(
        "modification",
        "Δ",
        f"{XUE}, Fig. 15",
        unit="um",
        text="gap between the unloaded flanks",
        axis=("profile_fraction", "face_fraction"),
    )
    line_load: FloatArray = quantity(
        "line load", "w", f"{XUE}, Fig. 11", unit="n_per_mm", axis=("profile_fraction", "face_fraction")
    )
    pressure: FloatArray = quantity(
        "Hertzian pressure",
        "p_H",
        f"{XUE}, Figs. 13-17",
        unit="mpa",
        text="null at a base circle",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
    )


@record(equation="Xue 1")
class Derived:
    """Values that follow directly from the inputs: torque [N m], power [W], lengths [m].

    `rack_tip_radius` is the fillet radius in normal modules, limited to the largest radius that fits both racks.
    """

    pinion_torque: float = quantity("pinion torque used", "T_1", unit="n_m")
    power: float = quantity("power used", "P", unit="kw")
    centre_distance: float = quantity("centre distance used", "a", unit="mm", equation="L1")
    tip_relief_length: float = quantity("tip relief length used", "L_Ca", unit="mm", equation="L11")
    root_relief_length: float = quantity("root relief length used", "L_Cf", unit="mm", equation="L11")
    end_relief_length: float = quantity("end relief length used", "L_Ce", unit="mm", equation="L11")
    rack_tip_radius: float = quantity(
        "root fillet radius used",
        "ρ_fP*",
        text="in normal modules, as far as both racks have room for it",
        equation="load-distribution#geometry",
    )
    total_face_width: float | None = quantity(
        "total face width used",
        "2b + e",
        unit="mm",
        text="both helices and the gap; left out without two helices",
        default=None,
        left_out=True,
    )
    tolerances: FlankTolerances | None = quantity(
        "tolerances of the quality class", text="left out without a quality class", default=None, left_out=True
    )


@record(slots=False)
class LoadDistribution:
    """Load distribution of a pair of gears.

    `path_of_contact` and `balance` are intermediate results, which further checks of the pair use.

    `feature` is the function that computes the curves along the feature line, and `maps` is the function that computes
    the maps over the flank. Each of the two functions is called when its result is first used.
    """

    path_of_contact: PathOfContact
    balance: LoadBalance
    feature: Callable[[], FeatureLine] = field(repr=False)
    maps: Callable[[], Flank] = field(repr=False)
    geometry: Geometry = quantity("mesh", text="the mesh")
    contact_lines: ContactLines = quantity("length of the contact lines")
    stiffness: Stiffness = quantity("stiffness of teeth and mesh")
    transmission_error: TransmissionError = quantity("transmission error of the mesh")
    load: LoadOnFlank = quantity("load on the flank")
    pressure: Pressure = quantity("Hertzian pressure of the flank")
    friction_loss: FrictionLoss = quantity("friction loss")
    derived: Derived = quantity("load and lengths used")
    warnings: tuple[Notice, ...]
    helix: HelixShare | None = quantity(
        "more loaded helix",
        text="whose load and safety are stated; the losses are those of both; left out without two helices",
        default=None,
        left_out=True,
    )

    @cached_property
    @computed("along the feature line", detail="curves")
    def feature_line(self) -> FeatureLine:
        """Curves along the feature line."""
        return self.feature()

    @cached_property
    @computed("over the flank", detail="fields")
    def flank(self) -> Flank:
        """Maps over the flank."""
        return self.maps()
