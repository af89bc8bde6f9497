"""Inputs of a load distribution and of a scuffing check."""

from dataclasses import field, replace
from math import pi
from typing import Literal

from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.heat_balance.inputs import Cooling
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.quantity import described, quantity, record
from solvers.sources import ISO_6336, XUE

FZG = "ISO 14635-1"
ASSUMED_GRADE = 7  # quality grade where neither it nor a quality class is given: that of the test gears
ISO_TR_15144 = "ISO/TR 15144-1:2014, as read in a public implementation"
TS_6336_20 = "ISO/TS 6336-20:2017 (ISO/TR 13989-1), as read in a public implementation"
TS_6336_21 = "ISO/TS 6336-21:2017 (ISO/TR 13989-2), as read in a public implementation"

FrictionMethod = Literal["given", "iso_tr_13989"]
BulkMethod = Literal["given", "estimated", "heat_balance"]
OilSupply = Literal["spray", "dip", "submerged"]
StandardEdition = Literal["2017", "2000"]

ToothModel = Literal["ishikawa", "parabola"]
ContactModel = Literal["hertzian", "linear"]
ToothSection = Literal["normal", "transverse"]
LoadConvention = Literal["exact", "paper"]
Lubrication = Literal["thermal_ehl", "closed_form"]
CheckedPart = Literal["flank", "feature_line"]
FlankSurface = Literal[
    "case_hardened", "case_hardened_retained_austenite", "nitrided", "induction_hardened", "through_hardened"
]


@record
class Load:
    """Speed of the driving pinion, and its torque or power; if torque and power are both given, the torque is used.

    The factors K_A, K_v and K_gamma multiply the load of the contacts, not the transmitted power.
    """

    pinion_torque: float | None = quantity(
        "pinion torque", "T_1", XUE, unit="n_m", ge=0, le=1e7, tolerance=1, relative_tolerance=0.05
    )
    power: float | None = quantity(
        "transmitted power",
        "P",
        f"{XUE}, Eq. 1",
        unit="kw",
        kw_only=True,
        default=None,
        ge=0,
        le=1e6,
        tolerance=0.1,
        relative_tolerance=0.05,
    )
    pinion_speed: float = quantity("pinion speed", "n_1", XUE, unit="rpm", ge=0.1, le=2e5)
    application_factor: float = quantity(
        "application factor",
        "K_A",
        ISO_6336,
        default=1.0,
        ge=0.1,
        le=10,
        relative_tolerance=0.1,
        text="multiplies the load of the contacts",
        assumed="1, driver and machine add no shocks to the load",
    )
    dynamic_factor: float = quantity(
        "dynamic factor",
        "K_v",
        ISO_6336,
        default=1.0,
        ge=0.1,
        le=10,
        text="multiplies the load of the contacts",
        assumed="1, the mesh vibrates without adding to the load",
    )
    mesh_load_factor: float = quantity(
        "mesh load factor", "K_γ", ISO_6336, default=1.0, ge=0.1, le=10, text="multiplies the load of the contacts"
    )
    axial_force: float = quantity(
        "external axial force",
        "F_ext",
        unit="n",
        kw_only=True,
        default=0.0,
        ge=-1e8,
        le=1e8,
        tolerance=100,
        text="on the shaft that floats, towards +Z, without the thrust of couplings; loads one helix of double-helical "
        "gears more than the other",
    )
    helix_share: float = described("Share of the torque that the helix carries.", kw_only=True, default=1.0)

    @property
    def contact_factor(self) -> float:
        """Load factor of the contacts, K_A K_v K_gamma [-]."""
        return self.application_factor * self.dynamic_factor * self.mesh_load_factor

    @property
    def contact_torque(self) -> float:
        """Pinion torque that loads the contacts of the helix [N m]."""
        return self.contact_factor * self.helix_torque

    @property
    def helix_torque(self) -> float:
        """Pinion torque that the helix carries, without load factors [N m]."""
        return self.helix_share * self.torque

    @property
    def torque(self) -> float:
        """Transmitted torque of the pinion [N m], else P/omega; raises `torque_or_power` without both."""
        if self.pinion_torque is not None:
            return self.pinion_torque
        if self.power is None:
            raise InvalidInput("torque_or_power", "give pinion_torque or power", "pinion_torque")
        return self.power / self.pinion_speed

    @property
    def transmitted_power(self) -> float:
        """Transmitted power [W]."""
        return self.torque * self.pinion_speed


def angular_speed(revolutions_per_minute: float) -> float:
    """Convert a speed in revolutions per minute into an angular speed [rad/s]."""
    return revolutions_per_minute * pi / 30


@record
class LeadCurve:
    """A gap [m] that varies over the face.

    The gap is measured along the transverse line of action, and is positive where material is missing. The positions
    [m] are distances from the end that meshes first, in ascending order. The gap is linear between the positions, and
    constant before the first and after the last position.
    """

    position: tuple[float, ...] = quantity(
        "positions of the lead curve",
        "y",
        unit="mm",
        default=(),
        ge=0,
        le=5000,
        tolerance=0.1,
        length=(0, 1000),
        text="rising, from the end that meshes first",
    )
    gap: tuple[float, ...] = quantity(
        "lead curve",
        "Δ_β",
        unit="um",
        default=(),
        ge=-1000,
        le=1000,
        tolerance=2,
        length=(0, 1000),
        text="gap, positive where material is missing",
    )


@record
class SecondHelix:
    """What differs on the helix at the higher Z; y runs from that helix's own end that meshes first."""

    helix_slope: float | None = quantity(
        "helix slope of the second helix",
        "f_Hβ,2",
        XUE,
        unit="um",
        default=None,
        ge=-1000,
        le=1000,
        tolerance=8,
        text="positive opens the gap towards the end that leaves the mesh last",
        default_text="as on the first helix",
    )
    lead_crowning: float | None = quantity(
        "helix crowning of the second helix",
        "C_β,2",
        XUE,
        unit="um",
        default=None,
        ge=-1000,
        le=1000,
        tolerance=3,
        default_text="as on the first helix",
    )
    lead_curve: LeadCurve | None = quantity(
        "lead curve", default=None, text="any gap along the second helix's face; null: as on the first helix"
    )


@record
class Modifications:
    """Gaps [m] along the transverse line of action; positive where material is missing.

    A positive `profile_slope` opens the gap towards E (pinion tip). A positive `helix_slope` opens the gap towards the
    end of the face that leaves the mesh last. `in_plane_deviation` and `out_of_plane_deviation` are shaft deviations
    over the face width; they act like a helix slope. `tip_relief` acts at E and is the sum of the reliefs of pinion tip
    and wheel root. `root_relief` acts at A and is the sum of the reliefs of pinion root and wheel tip. The lengths of
    tip and root relief are measured along the line of action [m]. The length of the end relief is measured along the
    face [m]. If a length is None, the function `modification.gap` chooses a default length. `lead_curve` adds a gap
    that varies over the face in any way.
    """

    profile_crowning: float = quantity(
        "profile crowning", "C_α", XUE, unit="um", default=0.0, ge=-1000, le=1000, tolerance=2
    )
    lead_crowning: float = quantity(
        "helix crowning", "C_β", XUE, unit="um", default=0.0, ge=-1000, le=1000, tolerance=3
    )
    profile_slope: float = quantity(
        "profile slope",
        "f_Hα",
        XUE,
        unit="um",
        default=0.0,
        ge=-1000,
        le=1000,
        tolerance=5,
        text="pressure-angle slope; positive opens the gap towards the pinion tip",
    )
    helix_slope: float = quantity(
        "helix slope",
        "f_Hβ",
        XUE,
        unit="um",
        default=0.0,
        ge=-1000,
        le=1000,
        tolerance=8,
        text="helix slope and misalignment; positive opens the gap towards the end that leaves the mesh last",
        assumed="0, flanks ground and mounted in line; a real pair carries more load at one end of the face",
    )
    in_plane_deviation: float = quantity(
        "in-plane shaft deviation",
        "f_Σδ",
        "ISO/TR 10064-3",
        unit="um",
        default=0.0,
        ge=-1000,
        le=1000,
        tolerance=10,
        text="shaft deviation in their plane over the face; adds to the helix slope",
    )
    out_of_plane_deviation: float = quantity(
        "out-of-plane shaft deviation",
        "f_Σβ",
        "ISO/TR 10064-3",
        unit="um",
        default=0.0,
        ge=-1000,
        le=1000,
        tolerance=10,
        text="shaft deviation out of their plane over the face; adds to the helix slope",
    )
    tip_relief: float = quantity(
        "tip relief",
        "C_a",
        XUE,
        unit="um",
        default=0.0,
        ge=0,
        le=1000,
        tolerance=3,
        text="relief at E: pinion tip plus wheel root",
        assumed="0, no relief: the load is full where a pair of teeth leaves the mesh",
    )
    tip_relief_length: float | None = quantity(
        "tip relief length",
        "L_Ca",
        unit="mm",
        default=None,
        ge=1e-3,
        le=1000,
        text="length along the line of action",
        default_text="to the single contact, a tenth to half of the path",
        assumed="the paper gives no relief lengths",
    )
    root_relief: float = quantity(
        "root relief",
        "C_f",
        XUE,
        unit="um",
        default=0.0,
        ge=0,
        le=1000,
        tolerance=3,
        text="relief at A: pinion root plus wheel tip",
        assumed="0, no relief: the load is full where a pair of teeth enters the mesh",
    )
    root_relief_length: float | None = quantity(
        "root relief length",
        "L_Cf",
        unit="mm",
        default=None,
        ge=1e-3,
        le=1000,
        text="length along the line of action",
        default_text="to the single contact, a tenth to half of the path",
        assumed="the paper gives no relief lengths",
    )
    end_relief: float = quantity(
        "end relief",
        "C_e",
        XUE,
        unit="um",
        default=0.0,
        ge=0,
        le=1000,
        tolerance=3,
        text="relief at both ends of the face",
    )
    end_relief_length: float | None = quantity(
        "end relief length",
        "L_Ce",
        unit="mm",
        default=None,
        ge=1e-3,
        le=5000,
        text="length along the face",
        default_text="a tenth of the face",
        assumed="the paper gives no relief lengths",
    )
    relief_exponent: float = quantity(
        "relief exponent",
        "p",
        default=1.0,
        ge=0.5,
        le=10,
        text="1: linear reliefs, 2: parabolic",
        assumed="linear; the paper does not say",
    )
    lead_curve: LeadCurve = quantity("lead curve", default_factory=LeadCurve, text="any gap along the face")
    second_helix: SecondHelix | None = quantity(
        "second helix",
        default=None,
        text="what differs on the helix at the higher Z of double-helical gears; null: both are ground alike",
    )

    @property
    def of_second_helix(self) -> "Modifications":
        """Modifications on the helix at the higher Z. A tilt of the axes acts there with the opposite sign."""
        own = SecondHelix() if self.second_helix is None else self.second_helix
        return replace(
            self,
            helix_slope=self.helix_slope if own.helix_slope is None else own.helix_slope,
            lead_crowning=self.lead_crowning if own.lead_crowning is None else own.lead_crowning,
            lead_curve=self.lead_curve if own.lead_curve is None else own.lead_curve,
            in_plane_deviation=-self.in_plane_deviation,
            out_of_plane_deviation=-self.out_of_plane_deviation,
        )


@record
class Model:
    """Options of the physical model.

    `tooth_stiffness` is "ishikawa" for Ishikawa's tooth. It is "parabola" for a stiffness that varies along the path
    as a parabola; the maximum of the parabola is the maximum of the stiffness of Ishikawa's tooth. `parabola_end_ratio`
    is the stiffness at A and E divided by this maximum. With the default of `parabola_end_ratio`, the largest loads
    agree with those in the paper. `contact` is "hertzian" to compute the compliance of the contact for half-spaces
    (Weber, Johnson), or "linear" to use the paper's linear term. `section` selects the section of the tooth that is
    used to compute the bending. `load_convention` is "exact" to use F_bn in the load balance, or "paper" to use F_bt
    (Eq. 1).
    """

    tooth_stiffness: ToothModel = quantity(
        "tooth stiffness model",
        "k",
        f"{XUE}, Eqs. 5-7",
        default="ishikawa",
        text="Ishikawa's tooth, or a parabola calibrated to the paper's load maxima",
        advanced=True,
    )
    parabola_end_ratio: float = quantity(
        "end ratio of the stiffness parabola",
        "r",
        XUE,
        default=0.757,
        ge=0.01,
        le=1,
        text="stiffness at the ends of the path over its maximum",
        advanced=True,
    )
    contact: ContactModel = quantity(
        "contact flattening",
        "δ_PV",
        f"{XUE}, Eq. 6",
        default="hertzian",
        text="flattening of the contact: Weber's half-space, or the paper's linear term",
        assumed="with the paper's term the mesh is 15 to 31 % stiffer than ISO 6336-1",
        advanced=True,
    )
    section: ToothSection = quantity(
        "section of the tooth",
        default="normal",
        text="where the tooth is cut for its compliance",
        assumed="the paper does not say; keeps the agreement with ISO 6336-1 at every helix angle",
        advanced=True,
    )
    load_convention: LoadConvention = quantity(
        "force in the balance",
        "W_sum",
        f"{XUE}, Eq. 1",
        default="exact",
        text="balance of the normal force, or of the tangential force as printed",
        advanced=True,
    )


@record
class Resolution:
    """Numbers of points of the numerical solution and of the results."""

    roll_positions: int = described("Number of roll positions per base pitch.", default=200)
    slices: int = described("Number of slices of each contact line.", default=100)
    profile_points: int = described("Number of points of the flank map along the profile.", default=201)
    face_points: int = described("Number of points of the flank map along the face.", default=101)
    feature_points: int = quantity("points of the feature line", None, XUE, default=51, ge=2, le=1001, advanced=True)


@record
class LoadDistributionInputs:
    """A loaded pair of modified, misaligned gears.

    If the coefficient of friction is None, the friction loss is not computed.
    """

    gears: GearPairInputs
    load: Load
    modifications: Modifications = field(default_factory=Modifications)
    pinion_material: Solid = field(default_factory=Solid)
    wheel_material: Solid = field(default_factory=Solid)
    friction_coefficient: float | None = quantity(
        "coefficient of friction",
        "μ_m",
        f"{XUE}, Eq. 25",
        default=0.06,
        ge=0,
        le=1,
        tolerance=0.01,
        relative_tolerance=0.3,
        assumed="0.06, the paper's; the scuffing check computes it from the oil, which this check does not know",
    )
    model: Model = field(default_factory=Model)
    resolution: Resolution = field(default_factory=Resolution)


@record
class ScuffingTest:
    """Result of the FZG test A/8.3/90 of an oil: the load stage at which the oil fails.

    The scuffing temperature follows from this load stage, from the structural factor X_W of the steel and from the
    lubricant factor X_L of the oil. If X_L is None, X_L is computed for the oil at 90 C.
    """

    fzg_stage: int = quantity(
        "failure load stage",
        "S",
        FZG,
        ge=1,
        le=14,
        text="stage at which the oil fails; 13 if a data sheet says above 12",
        if_above=(
            '"above 12" on a data sheet means that the oil passed stage 12; enter 13 as a lower limit, or the stage at '
            "which the oil failed if you know it"
        ),
    )
    test: Literal["A/8.3/90"] = quantity(
        "scuffing test",
        None,
        FZG,
        kw_only=True,
        default="A/8.3/90",
        if_above=(
            "load stages of faster or hotter tests, such as A/16.6/90, mean other temperatures; enter the stage of "
            "A/8.3/90, or the scuffing temperature itself"
        ),
    )
    structure_factor: float = quantity(
        "structural factor",
        "X_W",
        TS_6336_20,
        default=1.0,
        ge=0.1,
        le=2,
        assumed="case-hardened steel with normal austenite",
    )
    lubricant_factor: float | None = quantity(
        "lubricant factor",
        "X_L",
        TS_6336_20,
        default=None,
        ge=0.1,
        le=2,
        default_text="by the oil's kind, and its viscosity at 90 °C",
        assumed=(
            "X_L at the 90 °C of the test, because the scuffing temperature belongs to oil and steel; "
            "other programs take the oil temperature of the gear"
        ),
    )


@record
class Temperatures:
    """Bulk temperature of the teeth, oil temperature and scuffing temperature [K].

    If `bulk_method` is "given", the bulk temperature `bulk` is an input. If it is "estimated", the bulk temperature
    follows from the oil temperature, the oil supply and Blok's flash temperature; `bulk` is None before this estimate.
    If it is "heat_balance", the heat balance computes the temperatures `flanks` of both flanks [K], and `bulk` is their
    mean. If it is None, `thermal.bulk` chooses, and leads from the estimate to the balance without a step. The oil
    enters the contact at the bulk temperature.

    The scuffing temperature is a property of oil and material. The user gives either the scuffing temperature or the
    result of a scuffing test. If neither is given, there is no safety factor.
    """

    bulk: float | None = quantity(
        "bulk temperature",
        "θ_M",
        f"{XUE}, Eq. 16",
        unit="c",
        default=None,
        ge=-70,
        le=500,
        tolerance=5,
        text="bulk temperature of the teeth, at which the oil enters",
        default_text="estimated",
    )
    bulk_method: BulkMethod | None = quantity(
        "bulk temperature method",
        None,
        TS_6336_20,
        default=None,
        text=(
            "given: the bulk temperature stated; estimated: from oil temperature, lubrication and "
            "flash temperature; heat balance: from losses and oil flow"
        ),
        default_text=(
            "given, if a bulk temperature is; otherwise the estimate, which with jets of a known oil goes "
            "to the heat balance between 20 and 60 m/s"
        ),
        assumed=(
            "the estimate holds for flooded flanks, the heat balance for jets; from 20 to 60 m/s the bulk "
            "temperature goes from one to the other, never below the estimate"
        ),
    )
    oil_supply: OilSupply = quantity(
        "lubrication system factor",
        "X_S",
        TS_6336_20,
        default="spray",
        assumed="spray lubrication; scales the estimated bulk temperature",
    )
    oil: float = quantity(
        "oil temperature",
        "θ_oil",
        f"{XUE}, Eq. 26",
        unit="c",
        default=60.0,
        ge=-70,
        le=500,
        tolerance=5,
        assumed="60 °C, as in the paper",
    )
    scuffing: float | None = quantity(
        "scuffing temperature",
        "θ_S",
        f"{XUE}, Eq. 26",
        unit="c",
        default=None,
        ge=-70,
        le=1500,
        tolerance=20,
        text="scuffing temperature of oil and material",
        default_text="by the scuffing test; without both, no safety factor",
    )
    scuffing_test: ScuffingTest | None = quantity(
        "scuffing test", default=None, text="instead of the temperature: the stage at which the oil fails"
    )
    flanks: tuple[float, float] | None = described(
        "Temperatures of both flanks from the heat balance; None with another method [K].", default=None
    )

    @property
    def surfaces(self) -> tuple[float, float] | None:
        """Bulk temperatures of pinion and wheel [K]: `flanks`, else twice `bulk`, else None."""
        if self.flanks is not None or self.bulk is None:
            return self.flanks
        return self.bulk, self.bulk

    @property
    def lubricant_factor(self) -> float | None:
        """X_L of the scuffing test; None without a test."""
        return None if self.scuffing_test is None else self.scuffing_test.lubricant_factor


@record
class FlankSurfaces:
    """Hardening of both flanks; retained austenite counts above 25 %."""

    pinion: FlankSurface = quantity(
        "surface of the pinion", "W_W1", ISO_TR_15144, default="case_hardened", assumed="case-hardened flanks"
    )
    wheel: FlankSurface = quantity(
        "surface of the wheel", "W_W2", ISO_TR_15144, default="case_hardened", assumed="case-hardened flanks"
    )


@record
class MicropittingCheck:
    """Inputs of the checks against micropitting and wear.

    Without test and `permissible_ratio` only the film is computed. `quality_grade` serves method B alone.
    """

    failure_load_stage: int | None = quantity(
        "failure load stage of the micropitting test",
        "SKS",
        "FVA 54/7, C-GF/8.3/90",
        default=None,
        ge=5,
        le=10,
        text="load stage at which the oil fails the micropitting test",
        if_above=(
            '"above 10" on a data sheet means that the oil passed the last stage; enter 10 or ">10", which is on the '
            "safe side, or the permissible specific film thickness instead"
        ),
        default_text="no safety factor, unless a permissible film thickness is given",
        assumed="no failure load stage and no permissible film thickness given: films without a safety factor",
    )
    surface: FlankSurfaces = quantity("surfaces of the flanks", default_factory=FlankSurfaces)
    material_factor: float | None = quantity(
        "material factor",
        "W_W",
        ISO_TR_15144,
        default=None,
        ge=0.1,
        le=3,
        tolerance=0.1,
        text="permissible film of these flanks over that of the test flanks",
        default_text="by the surfaces",
    )
    permissible_ratio: float | None = quantity(
        "permissible specific film thickness",
        "λ_GFP",
        ISO_TR_15144,
        default=None,
        ge=1e-3,
        le=10,
        tolerance=0.05,
        text="film over roughness that the flanks need, instead of a test",
        default_text="by the micropitting test",
    )
    quality_grade: int | None = quantity(
        "quality grade",
        "Q",
        ISO_TR_15144,
        default=None,
        ge=5,
        le=12,
        text="for the load sharing of the standard; finer grades count as 7",
        default_text="the quality class of the gears, else 7",
        assumed="the quality class of the gears; without one grade 7, as of the test gears",
    )
    wear_coefficient: float | None = quantity(
        "wear coefficient",
        "k_W",
        "Archard",
        unit="mm3_per_n_m",
        default=None,
        ge=1e-15,
        le=1e-2,
        tolerance=1e-9,
        text="of both flanks",
        default_text="no wear",
    )


def grade_in_force(grade: int | None, gears: GearPairInputs) -> int:
    """Quality grade of the checks by the standard: given, else the quality class of the gears, else 7."""
    known = gears.quality_class if grade is None else grade
    return ASSUMED_GRADE if known is None else known


@record
class StandardFactors:
    """What the checks by the standard take beside the pair; the local checks never use it.

    A factor that is None follows from method B of ISO 6336-1 or from the load distribution.
    """

    face_load_factor: float | None = quantity(
        "face load factor for the standard",
        "K_Hβ",
        ISO_6336,
        default=None,
        ge=1,
        le=20,
        tolerance=0.1,
        text="for the checks by the standard alone",
        default_text="that of the load distribution",
    )
    transverse_load_factor: float | None = quantity(
        "transverse load factor for the standard",
        "K_Hα",
        ISO_6336,
        default=None,
        ge=1,
        le=20,
        tolerance=0.05,
        text="for the checks by the standard alone",
        default_text="by method B of ISO 6336-1",
    )
    dynamic_factor: float | None = quantity(
        "dynamic factor for the standard",
        "K_v",
        ISO_6336,
        default=None,
        ge=1,
        le=20,
        tolerance=0.05,
        text="for the checks by the standard alone",
        default_text="that of the load if it is not 1, otherwise by method B of ISO 6336-1",
    )
    quality_grade: int | None = quantity(
        "quality grade for the standard",
        "A",
        "ISO 1328-1:2013",
        default=None,
        ge=1,
        le=11,
        text="flank tolerance class: deviations in K_v and K_Hα, load sharing, tip relief factor",
        default_text="the quality class of the gears, else 7",
        assumed="the quality class of the gears, 7 without one; a coarser gear has larger load factors",
    )
    running_in: float = quantity(
        "state of running in",
        "Φ_E",
        TS_6336_21,
        default=0.0,
        ge=0,
        le=1,
        tolerance=0.5,
        text="1: run in; 0: as manufactured; for the integral temperature method",
        assumed="0, flanks as manufactured; run-in ones have a lower integral temperature",
    )


@record
class ScuffingInputs:
    """Inputs of a scuffing check.

    If `oil` is given, a given `lubricant` is not used; the calculation computes `lubricant` from `oil` at the bulk
    temperature. If neither `oil` nor `lubricant` is given, the pair is dry or greased: no film, and contact temperature
    and safety factor only from given temperatures and friction.

    If `friction` is "given", the coefficient of friction in `distribution` is used. If `friction` is "iso_tr_13989",
    Blok's flash temperature uses the mean coefficient of ISO/TS 6336-20, and the losses use Schlenk's coefficient.

    If `lubrication` is "closed_form", only the formulas of Blok and of Dowson and Higginson are evaluated. If
    `lubrication` is "thermal_ehl", the thermal EHL contact under the local load is also solved, with the options in
    `film`.

    `standard` and `standard_edition` belong to the checks by the standard, which stand beside the local ones.

    `line` is "flank" to check the whole flank, or "feature_line" to check only the paper's diagonal from A1 to E2.
    Every checked line has `path_points` equidistant points. `cooling` is only used if the bulk temperature follows from
    the heat balance.
    """

    distribution: LoadDistributionInputs
    lubricant: Lubricant | None = None
    oil: OilSheet | Lubricant | None = None
    temperatures: Temperatures = field(default_factory=Temperatures)
    friction: FrictionMethod = quantity(
        "friction law",
        None,
        TS_6336_20,
        default="iso_tr_13989",
        text="given coefficient; or by the oil: ISO/TS 6336-20 for the flash temperature, Schlenk for the losses",
    )
    lubrication: Lubrication = quantity(
        "lubrication model",
        None,
        XUE,
        default="thermal_ehl",
        text="film and flash temperature by thermal EHL, or by closed formulas alone",
        advanced=True,
    )
    film: ehl.Model = field(default_factory=ehl.Model)
    path_points: int = quantity(
        "points of the scuffing check",
        None,
        XUE,
        default=50,
        ge=2,
        le=500,
        text="points of the check along each line",
        advanced=True,
    )
    line: CheckedPart = quantity(
        "part of the flank that is checked",
        None,
        XUE,
        default="flank",
        text="the whole flank, or the paper's feature line alone, which misses hot corners",
        advanced=True,
    )
    micropitting: MicropittingCheck | None = quantity(
        "micropitting and wear", default=None, text="check of the film against micropitting; null: none"
    )
    cooling: Cooling = quantity(
        "cooling",
        default_factory=Cooling,
        text="for the heat balance: how the oil reaches the teeth, what else heats it, what was measured",
    )

    standard: StandardFactors = quantity(
        "standard", default_factory=StandardFactors, text="load factors and flanks for the checks by the standard alone"
    )
    standard_edition: StandardEdition = quantity(
        "edition of the standard",
        None,
        TS_6336_20,
        default="2017",
        text="2017: ISO/TS 6336-20 and -21, X_R = Ra^0.25; 2000: ISO/TR 13989 as programs print it, X_R = Ra^0.5",
        advanced=True,
    )
    friction_factor: float = quantity(
        "factor on the friction by law",
        "f_μ",
        default=1.0,
        ge=0.1,
        le=10,
        relative_tolerance=0.3,
        text="on the coefficients that follow from the oil, of flash, losses and film; a given one is not multiplied",
        folded=True,
    )

    @property
    def known_oil(self) -> OilSheet | Lubricant | None:
        """The oil, described by `oil` or `lubricant`; None if neither is given."""
        return self.lubricant if self.oil is None else self.oil
