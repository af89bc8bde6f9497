"""Inputs of a single-stage gear unit with its shafts, bearings and couplings; SI units, angles in radians.

The Z axis runs along the pinion's axis; X and Y are normal to Z. Positions along Z are measured from an arbitrary
datum, which is the same for both shafts. "Pinion" is the driving gear.
"""

from dataclasses import field
from math import cos
from typing import Literal

from solvers.coupling.inputs import Coupling, Friction, ModelOptions
from solvers.coupling.inputs import Lubricant as CouplingLubricant
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet, lubricant_at
from solvers.pumping.inputs import PumpingSetup
from solvers.quantity import described, quantity, record
from solvers.scuffing.inputs import ScuffingInputs
from solvers.sources import OCVIRK

Vector2 = tuple[float, float]
CouplingFriction = Literal["elastic_plastic", "sliding"]
BearingFilm = Literal["finite", "short"]
FaceTemperatures = Literal["uniform", "profile"]
ShaftName = Literal["pinion", "wheel"]
NAMES_OF_SHAFTS: tuple[ShaftName, ShaftName] = ("pinion", "wheel")
State = Literal["hot", "cold"]
ASSUMED_RESPONSE = 0.5  # chosen within the range of published values, 0.2 to 1
USUAL_TEETH = (90.0 + 273.15, 80.0 + 273.15)  # K, tooth temperatures of pinion and wheel where none is known
FILM_ABOVE_OIL = 15.0  # K; assumed difference between the temperatures of a bearing film and of the oil that enters
COINCIDENT = 1e-9  # m; positions that are closer together count as one position


@record
class ShaftSection:
    """A cylinder of a shaft."""

    length: float = quantity("section length", "l", unit="mm", ge=0.1, le=5000)
    outer_diameter: float = quantity("section outer diameter", "d_o", unit="mm", ge=5, le=3000)
    inner_diameter: float = quantity("section bore", "d_i", unit="mm", default=0.0, ge=0, le=3000, tolerance=0.1)


def torsion_diameter(gears: GearPairInputs, teeth: GearTeeth) -> float:
    """Diameter that carries the torsion of a toothed section (Eq. D16). This is the rule of a published program."""
    reference = teeth.teeth * gears.normal_module / cos(gears.helix_angle)
    return reference - gears.normal_module * teeth.dedendum


@record
class RadialBearing:
    """The fields that all radial bearings have: position of the bearing and offset of the bore."""

    position: float = quantity(
        "bearing position", "z_B", unit="mm", ge=-20000, le=20000, tolerance=0.1, text="along the unit's Z"
    )
    offset: Vector2 = quantity(
        "bore offset",
        "e_B",
        unit="um",
        kw_only=True,
        default=(0.0, 0.0),
        ge=-5000,
        le=5000,
        tolerance=2,
        text="[X, Y] of the bore against the datum axis",
        index="X, Y",
    )


@record
class JournalBearing(RadialBearing):
    """A plain bearing."""

    diameter: float = quantity("journal diameter", "D", OCVIRK, unit="mm", ge=5, le=3000)
    width: float = quantity("bearing width", "B", OCVIRK, unit="mm", ge=1, le=3000)
    viscosity: float = quantity("oil viscosity in the bearing", "η_B", OCVIRK, unit="pa_s")
    radial_clearance: float | None = quantity(
        "radial clearance of the bearing",
        "c",
        OCVIRK,
        unit="um",
        default=None,
        ge=5,
        le=1000,
        tolerance=15,
        default_text="1.5e-3 of the journal's radius",
        assumed="1.5e-3 of the journal's radius, usual for high-speed plain bearings",
    )
    in_gear_oil: bool = described(
        "Whether the oil of the gears lubricates the bearing; its viscosity then follows the temperature of the film "
        "in a heat balance.",
        default=False,
        kw_only=True,
    )
    oil_flow: float | None = quantity(
        "oil flow to the bearing",
        "Q_B",
        unit="l_per_min",
        kw_only=True,
        default=None,
        ge=0.01,
        le=1000,
        text="used by the heat balance",
        default_text="what leaks at the sides of the film",
    )
    feed_temperature: float | None = quantity(
        "feed temperature of the bearing",
        "θ_in",
        unit="c",
        kw_only=True,
        default=None,
        ge=-50,
        le=200,
        tolerance=5,
        text="of the oil that enters; the film is warmer",
        default_text="the oil temperature of the gears",
    )

    @property
    def clearance(self) -> float:
        """Radial clearance, given or assumed [m]."""
        return 0.75e-3 * self.diameter if self.radial_clearance is None else self.radial_clearance


@record
class LinearBearing(RadialBearing):
    """A bearing with a given stiffness matrix ((xx, xy), (yx, yy)), which need not be symmetric."""

    stiffness: tuple[Vector2, Vector2] = quantity(
        "bearing stiffness",
        "k_B",
        unit="n_per_um",
        ge=-1e5,
        le=1e5,
        tolerance=1,
        relative_tolerance=0.1,
        text="a number or [[xx, xy], [yx, yy]]",
    )


@record
class RigidBearing(RadialBearing):
    """A bearing that does not yield."""


Bearing = JournalBearing | LinearBearing | RigidBearing


def gear_oil_viscosity(oil: OilSheet | Lubricant, feed_temperature: float, film_temperature: float | None) -> float:
    """Compute the viscosity of the gears' oil in a plain bearing [Pa s].

    `film_temperature`: temperature of the film [K]; if None, the film is assumed to be 15 K warmer than the entering
    oil.
    """
    film = feed_temperature + FILM_ABOVE_OIL if film_temperature is None else film_temperature
    return lubricant_at(oil, film).viscosity_at(0.0, film)


@record
class GearBody:
    """A gear body of rim, web and hub; the web is at mid-face, and the hub as wide as the face."""

    rim_thickness: float = quantity(
        "thickness of the rim", "s_R", unit="mm", ge=1, le=2000, tolerance=1, text="under the root circle"
    )
    web_width: float = quantity("width of the web", "b_s", unit="mm", ge=1, le=3000, tolerance=1)
    hub_diameter: float = quantity("diameter of the hub", "d_N", unit="mm", ge=5, le=5000, tolerance=1)


@record
class Shaft:
    """A shaft in two bearings; the sections of the shaft follow one another along Z and begin at `start`."""

    start: float = quantity(
        "start of the shaft",
        "z_0",
        unit="mm",
        kw_only=True,
        default=0.0,
        ge=-20000,
        le=20000,
        tolerance=0.1,
        text="its end of lowest Z",
    )
    sections: tuple[ShaftSection, ...] = quantity("sections", length=(1, 40), text="cylinders in order of Z")
    torque_position: float | None = quantity(
        "place where torque enters or leaves",
        "z_T",
        unit="mm",
        kw_only=True,
        default=None,
        ge=-20000,
        le=20000,
        tolerance=0.1,
        default_text="the coupling's position; required without one",
    )
    bearings: tuple[Bearing, ...] = quantity("bearings", length=(0, 40), text="exactly two")
    youngs_modulus: float = quantity("Young's modulus", "E", unit="gpa", default=206.0, ge=1, le=2000)
    poisson_ratio: float = quantity("Poisson's ratio", "ν", default=0.3, ge=0, lt=0.5, tolerance=0.01)
    density: float = quantity("density", "ρ", unit="kg_per_m3", default=7850.0, ge=100, le=30000)
    ultimate_thrust: float | None = quantity(
        "ultimate load of the thrust bearing",
        "F_ult",
        "API 613",
        unit="n",
        default=None,
        ge=1,
        le=1e8,
        default_text="no verdict on the thrust bearing",
    )
    gear_body: GearBody | None = quantity(
        "body of the gear",
        kw_only=True,
        default=None,
        text="rim, web and hub; used where the temperatures follow the face",
        default_text="solid",
        assumed="solid, from the bore to the root circle",
    )

    @property
    def end(self) -> float:
        """Position of the end with the highest Z [m]."""
        return self.start + sum(section.length for section in self.sections)


@record
class Alignment:
    """For unit and machine: the height of the shaft above the feet, and the temperature rise of the supports."""

    unit_height: float | None = quantity(
        "height of the unit's shaft",
        "h_U",
        unit="mm",
        default=None,
        ge=0,
        le=20000,
        tolerance=1,
        text="over its feet",
        default_text="no growth",
    )
    unit_rise: float | None = quantity(
        "temperature rise of the unit's supports",
        "ΔT_U",
        unit="k",
        default=None,
        ge=-100,
        le=300,
        tolerance=5,
        default_text="no growth",
    )
    machine_height: float | None = quantity(
        "height of the machine's shaft",
        "h_M",
        unit="mm",
        default=None,
        ge=0,
        le=20000,
        tolerance=1,
        text="over its feet",
        default_text="no growth",
    )
    machine_rise: float | None = quantity(
        "temperature rise of the machine's supports",
        "ΔT_M",
        unit="k",
        default=None,
        ge=-100,
        le=300,
        tolerance=5,
        default_text="no growth",
    )
    expansion: float = quantity(
        "thermal expansion of the supports",
        "α_S",
        unit="per_k",
        default=1.1e-5,
        ge=0,
        le=1e-4,
        tolerance=1e-6,
        text="of cast iron and steel",
    )

    @property
    def growth(self) -> float:
        """Amount by which the machine's shaft rises more than the unit's shaft while both warm up [m]."""
        unit, machine = (
            (height or 0.0) * (rise or 0.0)
            for height, rise in ((self.unit_height, self.unit_rise), (self.machine_height, self.machine_rise))
        )
        return self.expansion * (machine - unit)


@record
class UnitCoupling:
    """A gear coupling between a shaft of the unit and a machine."""

    shaft: ShaftName = quantity("shaft of the coupling", text="which of the unit's shafts it sits on")
    position: float = quantity(
        "hub position", "z_H", unit="mm", ge=-20000, le=20000, tolerance=0.1, text="tooth plane of the unit's hub"
    )
    machine_side: Literal["minus", "plus"] = quantity(
        "side of the machine", text="to which side along Z the machine lies"
    )
    coupling: Coupling = quantity("coupling")
    lubricant: CouplingLubricant = quantity("oil at the coupling's teeth", default_factory=CouplingLubricant)
    friction: Friction = quantity("friction between the coupling's teeth", default_factory=Friction)
    model: ModelOptions = field(default_factory=ModelOptions)
    axial_tooth_stiffness: float | None = quantity(
        "axial tooth stiffness",
        "c_a",
        unit="n_per_um",
        default=None,
        ge=0.1,
        le=1e5,
        text="of one tooth, that lets it yield before it slides",
        default_text="the tooth pair stiffness",
        assumed="the same as the tangential stiffness",
    )
    offset: Vector2 = quantity(
        "offset of the machine's hub",
        "e_M",
        unit="um",
        default=(0.0, 0.0),
        ge=-5000,
        le=5000,
        tolerance=100,
        text="[X, Y] against the unit's datum axis; running, or cold where an alignment is given",
        index="X, Y",
    )
    slope: Vector2 = quantity(
        "slope of the machine's axis",
        "φ_M",
        unit="mrad",
        default=(0.0, 0.0),
        ge=-20,
        le=20,
        tolerance=0.2,
        text="[dX/dZ, dY/dZ] against the unit's datum axis",
        index="dX/dZ, dY/dZ",
    )
    thrust_fraction: float = quantity(
        "share of the friction that acts axially",
        "τ",
        default=0.0,
        ge=-1,
        le=1,
        tolerance=0.1,
        text="share of the friction limit that acts along the shaft, towards +Z if positive",
        assumed="none: all friction resists the tilting, which bends the shaft most",
    )
    alignment: Alignment | None = quantity(
        "alignment", default=None, text="heights and temperature rises of both machines"
    )


@record
class Arrangement:
    """Position and rotation of the unit; angles are measured counter-clockwise from X, seen from +Z."""

    hand: Literal["right", "left"] = quantity(
        "hand of the pinion's helix",
        default="right",
        text="without meaning for spur gears; of double-helical gears, of the helix at the lower Z",
    )
    apex_runout: float | None = quantity(
        "axial runout of the apex",
        "e_A",
        unit="um",
        kw_only=True,
        default=None,
        ge=0,
        le=1000,
        tolerance=2,
        text="of double-helical gears, amplitude over a turn of the pinion; makes the coupling slide to and fro",
        default_text="not given",
    )
    rotation: Literal["counterclockwise", "clockwise"] = quantity(
        "rotation of the pinion", default="counterclockwise", text="rotation of the pinion, seen from +Z"
    )
    wheel_angle: float = quantity(
        "direction to the wheel",
        "γ_W",
        unit="deg",
        default=0.0,
        ge=-360,
        le=360,
        tolerance=1,
        text="from pinion to wheel, from X towards Y",
    )
    gravity_angle: float = quantity(
        "direction of gravity", "γ_g", unit="deg", default=-90.0, ge=-360, le=360, tolerance=1, text="from X towards Y"
    )
    gravity_factor: float = quantity(
        "gravity factor", "g/g_0", default=1.0, ge=0, le=10, tolerance=0.1, text="weight relative to that on earth"
    )


@record
class Heat:
    """Tooth temperatures and wall responses.

    The wall response of a gear is the temperature rise of the metal divided by the temperature rise of the pumped gas.
    If `wall_response` is None, a response of 0.5 is assumed and a warning states this assumption. If
    `wall_response_wheel` is None, the response of the wheel is the response of the pinion times z1/z2, because a wheel
    tooth meets the hot gas once per turn of the wheel.

    The pumped gas heats the metal. Normally the tooth temperatures do not include this temperature rise, and the model
    adds the rise. If the tooth temperatures include the rise, the model adds only the deviation of the rise from its
    mean over the face.
    """

    wall_response: float | None = quantity(
        "wall response",
        "κ_1",
        default=None,
        ge=0,
        le=1.5,
        tolerance=0.1,
        text="temperature rise of the pinion's teeth over that of the pumped gas",
        default_text=f"{ASSUMED_RESPONSE}",
        assumed="only a measurement gives it; known values lie between 0.2 and 1",
    )
    wall_response_wheel: float | None = quantity(
        "wall response of the wheel",
        "κ_2",
        default=None,
        ge=0,
        le=1.5,
        tolerance=0.1,
        default_text="the pinion's times z1/z2",
        assumed="a wheel tooth meets the hot gas once a turn of the wheel",
    )
    pinion_bulk: float | None = quantity(
        "tooth temperature of the pinion",
        "θ_M1",
        unit="c",
        default=None,
        ge=-70,
        le=500,
        tolerance=5,
        text="without the heat of pumping; give both gears or neither",
        default_text="from the heat balance; without one, 90 °C",
        assumed="usual for high-speed gears; measure yours",
    )
    wheel_bulk: float | None = quantity(
        "tooth temperature of the wheel",
        "θ_M2",
        unit="c",
        default=None,
        ge=-70,
        le=500,
        tolerance=5,
        text="without the heat of pumping; give both gears or neither",
        default_text="from the heat balance; without one, 80 °C",
        assumed="usual for high-speed gears; measure yours",
    )
    reference: float = quantity(
        "temperature of the drawing",
        "θ_0",
        unit="c",
        default=20.0,
        ge=-70,
        le=200,
        tolerance=5,
        text="temperature at which the flanks have the drawn shape",
    )
    bulk_includes_pumping: bool = quantity(
        "tooth temperatures with pumping",
        default=False,
        text=(
            "whether the tooth temperatures contain the heat of pumping; then only its variation "
            "along the face is added"
        ),
    )

    @property
    def states_teeth(self) -> bool:
        """Whether a tooth temperature is given."""
        return self.pinion_bulk is not None or self.wheel_bulk is not None

    @property
    def states_both_teeth(self) -> bool:
        """Whether the temperatures of both gears are given."""
        return self.pinion_bulk is not None and self.wheel_bulk is not None

    @property
    def teeth(self) -> tuple[float, float]:
        """Tooth temperatures of pinion and wheel, given or assumed [K]."""
        given = self.pinion_bulk, self.wheel_bulk
        pinion, wheel = (usual if own is None else own for own, usual in zip(given, USUAL_TEETH, strict=True))
        return pinion, wheel

    def responses(self, speed_ratio: float) -> tuple[float, float]:
        """Return the wall responses of pinion and wheel [-]."""
        pinion = ASSUMED_RESPONSE if self.wall_response is None else self.wall_response
        return pinion, pinion * speed_ratio if self.wall_response_wheel is None else self.wall_response_wheel


@record
class Effects:
    """The effects that the model takes into account; `coupling` has no effect if `shafts` is false."""

    shafts: bool = quantity(
        "shafts", default=True, text="whether shafts and bearings yield; if not, couplings have no effect either"
    )
    coupling: bool = quantity("couplings", default=True, text="whether couplings load their shafts")
    thermal: bool = quantity("heat", default=True, text="whether heat deforms the flanks")


def floating_shaft(inputs: "DriveTrainInputs") -> ShaftName:
    """Shaft of a double-helical unit that floats, given or that of the gear with fewer teeth."""
    if inputs.floating_shaft is not None:
        return inputs.floating_shaft
    gears = inputs.mesh.distribution.gears
    return "pinion" if gears.pinion.teeth <= gears.wheel.teeth else "wheel"


@record
class DriveTrainInputs:
    """Inputs of a gear unit: mesh, pumping of gas by the teeth, shafts, couplings, and heat.

    `mesh` and `pumping` both contain the gear pair. The two descriptions of the pair must agree, except for the tip
    radius of the rack. The load factors of the mesh raise only the load of the contacts, not the load of the shafts. A
    thrust collar on the pinion replaces the pinion's thrust bearing. The result describes the hot unit; if `states`
    contains "cold", the result also contains the cold unit.
    """

    mesh: ScuffingInputs
    pumping: PumpingSetup
    face_start: float = quantity(
        "start of the face",
        "z_F",
        unit="mm",
        ge=-20000,
        le=20000,
        tolerance=0.1,
        text="end of lowest Z of the common face; of double-helical gears, of the first helix",
    )
    pinion_shaft: Shaft = quantity("pinion shaft", text="shaft of the driving gear")
    wheel_shaft: Shaft = quantity("wheel shaft", text="shaft of the driven gear")
    arrangement: Arrangement = field(default_factory=Arrangement)
    couplings: tuple[UnitCoupling, ...] = quantity(
        "couplings", default=(), length=(0, 10), text="at most one on each shaft"
    )
    floating_shaft: ShaftName | None = quantity(
        "shaft that floats",
        kw_only=True,
        default=None,
        text="of double-helical gears: held along Z by the mesh alone; the other one has the thrust bearing",
        default_text="that of the gear with fewer teeth",
        assumed="the shaft of the gear with fewer teeth, which a locked coupling loads least unequally",
    )
    collar_radius: float | None = quantity(
        "radius of the thrust collar",
        "r_k",
        unit="mm",
        default=None,
        ge=1,
        le=5000,
        text="where it touches",
        default_text="no collar",
    )
    heat: Heat = quantity("heat of the teeth", default_factory=Heat)
    effects: Effects = quantity("effects", default_factory=Effects, text="what is taken into account")
    coupling_friction: CouplingFriction = quantity(
        "friction law of the hubs",
        default="elastic_plastic",
        text="teeth yield before they slide, or, for comparison, slide fully at any tilt",
        assumed="own derivation; no measurement of a well aligned hub is known",
        advanced=True,
    )
    bearing_film: BearingFilm = quantity(
        "film of the plain bearings",
        default="finite",
        text="bearing of finite width, or short bearing, which is too stiff if wider than a third of its diameter",
        advanced=True,
    )
    face_stations: int = quantity(
        "stations over the face",
        "n",
        default=41,
        ge=5,
        le=201,
        text="stations at which shafts and mesh act on each other",
        advanced=True,
    )
    face_heat: FaceTemperatures | None = quantity(
        "temperatures along the face",
        kw_only=True,
        default=None,
        text="uniform: one of flank and body per gear; profile: the loaded end heats itself, and rotors are elastic",
        default_text="profile where the heat balance of the unit runs, else uniform",
    )
    local_bulk: bool = quantity(
        "local bulk temperature",
        default=False,
        text="whether the bulk temperature is higher where more heat is pumped",
    )
    bulk_given: bool = described(
        "Whether the bulk temperature is given: the cold unit then has the same one, else the reference temperature.",
        default=True,
    )
    states: tuple[State, ...] = quantity(
        "states",
        default=("hot",),
        length=(1, 2),
        text='the unit as described is hot; "cold" adds the unit at the temperature of the drawing',
    )

    @property
    def shafts(self) -> tuple[Shaft, Shaft]:
        """Shafts of pinion and wheel."""
        return self.pinion_shaft, self.wheel_shaft

    @property
    def acting_couplings(self) -> tuple[UnitCoupling, ...]:
        """Couplings whose loads the model takes into account."""
        return self.couplings if self.effects.shafts and self.effects.coupling else ()

    @property
    def contact_load_factor(self) -> float:
        """Product K_A K_v K_gamma of the load factors."""
        return self.mesh.distribution.load.contact_factor
