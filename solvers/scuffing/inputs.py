"""What a load distribution is computed from."""

from dataclasses import dataclass, field
from math import pi
from typing import Literal

from solvers.contact import ehl
from solvers.gears.inputs import GearPairInputs
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.oils import OilSheet

FrictionMethod = Literal["given", "iso_tr_13989"]
BulkMethod = Literal["given", "estimated"]
OilSupply = Literal["spray", "dip", "submerged"]

ToothModel = Literal["ishikawa", "parabola"]
ContactModel = Literal["hertzian", "linear"]
ToothSection = Literal["normal", "transverse"]
LoadConvention = Literal["exact", "paper"]
Lubrication = Literal["thermal_ehl", "closed_form"]


@dataclass(frozen=True, slots=True)
class Load:
    """Torque [N m] and speed [rad/s] of the driving pinion.

    The factors K_A, K_v and K_gamma multiply the load of the contacts, not the transmitted power.
    """

    pinion_torque: float
    pinion_speed: float
    application_factor: float = 1.0
    dynamic_factor: float = 1.0
    mesh_load_factor: float = 1.0

    @property
    def contact_factor(self) -> float:
        """K_A K_v K_gamma."""
        return self.application_factor * self.dynamic_factor * self.mesh_load_factor

    @property
    def contact_torque(self) -> float:
        """Pinion torque that loads the contacts [N m]."""
        return self.contact_factor * self.pinion_torque

    @property
    def power(self) -> float:
        """Transmitted power [W]."""
        return self.pinion_torque * self.pinion_speed


def torque_from_power(power: float, pinion_speed: float) -> float:
    """Torque [N m] of a power [W] at a speed [rad/s]; the paper's 9549 P/n."""
    return power / pinion_speed


def angular_speed(revolutions_per_minute: float) -> float:
    """Angular speed [rad/s]."""
    return revolutions_per_minute * pi / 30


@dataclass(frozen=True, slots=True)
class LeadCurve:
    """Any gap [m] over the face: linear between rising positions [m] from the end that meshes first, constant outside.

    Positive where material is missing, along the transverse line of action.
    """

    position: tuple[float, ...]
    gap: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Modifications:
    """Gaps [m] along the transverse line of action; positive where material is missing.

    profile_slope opens the gap towards E (pinion tip), helix_slope towards E2 (the end that leaves the mesh last); so
    do shaft deviations over the face, in the plane of the shafts and out of it.
    tip_relief acts at E (pinion tip and gear root), root_relief at A; the caller adds the two members. Relief lengths
    run along the line of action, end relief length along the face [m]; None is the default of `modification.gap`.
    lead_curve adds whatever else the gap does over the face.
    """

    profile_crowning: float = 0.0
    lead_crowning: float = 0.0
    profile_slope: float = 0.0
    helix_slope: float = 0.0
    in_plane_deviation: float = 0.0
    out_of_plane_deviation: float = 0.0
    tip_relief: float = 0.0
    tip_relief_length: float | None = None
    root_relief: float = 0.0
    root_relief_length: float | None = None
    end_relief: float = 0.0
    end_relief_length: float | None = None
    relief_exponent: float = 1.0
    lead_curve: LeadCurve | None = None


@dataclass(frozen=True, slots=True)
class Model:
    """Physics in force.

    tooth_stiffness: "ishikawa", or "parabola" through Ishikawa's maximum with `parabola_end_ratio` at A and E, which
    is calibrated to the paper's load maxima. contact: "hertzian" half-spaces (Weber, Johnson) or the paper's "linear"
    term. section: where the tooth is cut for its compliance. load_convention: "exact" puts F_bn into the balance,
    "paper" (Eq. 1) F_bt.
    """

    tooth_stiffness: ToothModel = "ishikawa"
    parabola_end_ratio: float = 0.757
    contact: ContactModel = "hertzian"
    section: ToothSection = "normal"
    load_convention: LoadConvention = "exact"


@dataclass(frozen=True, slots=True)
class Resolution:
    """Points of the numerical solution and of its output.

    roll_positions in one base pitch, slices of each contact line, points of the flank map along the profile and along
    the face, points of the feature line.
    """

    roll_positions: int = 200
    slices: int = 100
    profile_points: int = 201
    face_points: int = 101
    feature_points: int = 51


@dataclass(frozen=True, slots=True)
class LoadDistributionInputs:
    """A loaded pair of modified, misaligned gears; without a coefficient of friction its loss is not known."""

    gears: GearPairInputs
    load: Load
    modifications: Modifications = field(default_factory=Modifications)
    pinion_material: Solid = field(default_factory=Solid)
    wheel_material: Solid = field(default_factory=Solid)
    friction_coefficient: float | None = 0.06
    model: Model = field(default_factory=Model)
    resolution: Resolution = field(default_factory=Resolution)


@dataclass(frozen=True, slots=True)
class ScuffingTest:
    """The FZG A/8.3/90 load stage at which the oil fails; X_W of the steel, X_L of the oil (None: that at 90 C)."""

    fzg_stage: int
    structure_factor: float = 1.0
    lubricant_factor: float | None = None


@dataclass(frozen=True, slots=True)
class Temperatures:
    """Bulk temperature of the teeth and of the oil they draw in, oil temperature, scuffing temperature [K].

    With bulk_method "estimated" the bulk follows from the oil, its supply and Blok's flash temperature, and `bulk` is
    None until it does. The scuffing temperature is a property of oil and material that the paper does not give: a
    number, or what a test says; with neither there is no safety.
    """

    bulk: float | None = 360.0
    oil: float = 333.15
    scuffing: float | None = None
    scuffing_test: ScuffingTest | None = None
    bulk_method: BulkMethod = "given"
    oil_supply: OilSupply = "spray"


@dataclass(frozen=True, slots=True)
class ScuffingInputs:
    """What scuffing depends on; `path_points` along the feature line.

    An `oil` takes the place of the lubricant, as it is at the bulk temperature; with neither there are no film, contact
    temperature and safety. friction: "given" is the coefficient of the distribution,
    "iso_tr_13989" the mean coefficient of that report, for Blok and the losses.
    lubrication: "thermal_ehl" solves the film under the local load (`film` is its model), "closed_form" leaves it at
    Blok's and Dowson and Higginson's formulas, which are there in either case.
    """

    distribution: LoadDistributionInputs
    lubricant: Lubricant | None = field(default_factory=Lubricant)
    oil: OilSheet | Lubricant | None = None
    temperatures: Temperatures = field(default_factory=Temperatures)
    lubrication: Lubrication = "thermal_ehl"
    friction: FrictionMethod = "given"
    film: ehl.Model = field(default_factory=ehl.Model)
    path_points: int = 50

    @property
    def known_oil(self) -> OilSheet | Lubricant | None:
        """The oil, however it is described."""
        return self.lubricant if self.oil is None else self.oil
