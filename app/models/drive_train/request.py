"""Requests for a complete gear unit: /v1/drive-train and /v1/drive-train/warm-up."""

from collections.abc import Iterator
from functools import partial
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from app.models.coupling.request import CrownedCoupling
from app.models.load_distribution.request import FlankModifications, ScuffingLoad
from app.models.pumping.request import GearGroove, Mist, PumpingOptions
from app.models.scuffing.request import (
    PRACTICAL_FRICTION,
    ContactTemperatures,
    MeshInOil,
    MeshModel,
    Micropitting,
    StandardLoad,
)
from app.models.sections.cooling import GearCooling
from app.models.sections.gears import BacklashGears, GearMaterials
from app.models.sections.oil import CouplingLubricant, Oil
from app.schema.model import Section
from app.schema.quantities import Input
from solvers.drive_train import inputs as si
from solvers.drive_train import warm_up
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, RACK_A, GearPairInputs
from solvers.pumping import inputs as pumping
from solvers.quantity import UNITS
from solvers.scuffing import inputs as mesh


class TrainGears(BacklashGears, of=(si.Arrangement, GearPairInputs), only=("hand", "apex_runout", "quality_class")):
    """The gear pair, with its backlash and the hand of the helix."""

    rack_tip_radius: Annotated[
        float | None,
        Input.of(
            GearPairInputs,
            "rack_tip_radius",
            text="tip radius coefficient of the rack, of mesh and pumped spaces alike",
            default_text=f"{RACK_A} for the mesh, {GROUND_FILLET} for the pumped spaces",
            assumed=f"for the mesh, rack A of ISO 53 ({RACK_A}); for the spaces, a ground fillet ({GROUND_FILLET})",
        ),
    ] = None

    def pair(self, rack_tip_radius: float) -> GearPairInputs:
        """Solver's gear pair. If the request gives no tip radius coefficient of the rack, `rack_tip_radius` is used."""
        own = self.rack_tip_radius
        return self.si(GearPairInputs, rack_tip_radius=rack_tip_radius if own is None else own)


class TrainOperation(ScuffingLoad, of=si.Arrangement, without=("hand", "apex_runout")):
    """Torque or power, speed, sense of rotation and orientation of the unit."""

    choice_missing: ClassVar = "load_missing"


class GroundCurve(Section, of=mesh.LeadCurve):
    """A modification of any shape along the face, in addition to the named modifications.

    The modification is given as a gap at positions on the face. Empty lists mean that there is no such modification.
    """


class SecondHelix(Section, of=mesh.SecondHelix):
    """What differs on the helix at the higher Z; y runs from that helix's own end that meshes first."""


class TrainModifications(FlankModifications, of=mesh.Modifications):
    """Gaps between the flanks: modifications that are made by grinding, and misalignment that has other causes.

    A gap is positive where material is missing.
    """


class TrainModel(
    MeshModel,
    PumpingOptions,
    of=si.DriveTrainInputs,
    only=("face_stations", "face_heat", "coupling_friction", "bearing_film"),
):
    """Choices that the papers leave open in the models, and the numerical resolution."""


def _isotropic(value: Any) -> Any:
    """Convert the stiffness of a bearing from a single number into a matrix."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return [[value, 0.0], [0.0, value]]
    return value


Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Matrix = Annotated[list[Pair], Field(min_length=2, max_length=2)]
Stiffness = Annotated[Matrix, BeforeValidator(_isotropic, json_schema_input_type=float | Matrix)]


class CylindricalSection(Section, of=si.ShaftSection):
    """A cylindrical section of a shaft."""

    outer_diameter_mm: Annotated[
        float | None,
        Input.of(
            si.ShaftSection,
            "outer_diameter",
            text="under the teeth the diameter that carries torsion",
            default_text="under the teeth d − m_n h_fP*; required elsewhere",
            assumed=(
                "under the teeth d − m_n h_fP*, without profile shift the mean of root and reference "
                "diameter; with the reference diameter the torsion would be too small"
            ),
        ),
    ] = None


class ShaftBearing(Section):
    """A radial bearing: a short plain bearing, a bearing with a given stiffness, or a rigid bearing."""

    position_mm: Annotated[float, Input.of(si.RadialBearing, "position")]
    type: Annotated[
        Literal["journal", "linear", "rigid"],
        Input("bearing type", text="plain bearing, given stiffness, or rigid"),
    ] = "journal"
    offset_um: Annotated[Pair, Input.of(si.RadialBearing, "offset")] = Field(
        default_factory=partial(list[float], (0.0, 0.0))
    )
    diameter_mm: Annotated[
        float | None, Input.of(si.JournalBearing, "diameter", default_text="required of plain bearings")
    ] = None
    width_mm: Annotated[
        float | None, Input.of(si.JournalBearing, "width", default_text="required of plain bearings")
    ] = None
    radial_clearance_um: Annotated[float | None, Input.of(si.JournalBearing, "radial_clearance")] = None
    viscosity_pa_s: Annotated[
        float | None,
        Input.of(
            si.JournalBearing,
            "viscosity",
            ge=1e-5,
            le=100,
            default_text="the gears' oil at the film temperature",
            assumed="the viscosity of the gears' oil at the film temperature. If no film temperature is given, the "
            f"film temperature is taken from the heat balance; without a heat balance it is {si.FILM_ABOVE_OIL:.0f} K "
            "above the feed temperature of the bearing, or above the oil temperature if no feed temperature is given",
        ),
    ] = None
    film_temperature_c: Annotated[
        float | None,
        Input(
            "film temperature of the bearing",
            "θ_B",
            unit="c",
            ge=-50,
            le=300,
            tolerance=5,
            text="temperature at which the oil's viscosity is taken where none is given",
            default_text=f"by the heat balance if there is one, else feed temperature and {si.FILM_ABOVE_OIL:.0f} K",
        ),
    ] = None
    feed_temperature_c: Annotated[float | None, Input.of(si.JournalBearing, "feed_temperature")] = None
    oil_flow_l_per_min: Annotated[float | None, Input.of(si.JournalBearing, "oil_flow")] = None
    stiffness_n_per_um: Annotated[
        Stiffness | None, Input.of(si.LinearBearing, "stiffness", default_text="required of linear bearings")
    ] = None

    def unused(self) -> dict[str, bool]:
        names = ("radial_clearance_um", "viscosity_pa_s", "feed_temperature_c")
        return dict.fromkeys(names, self.type != "journal")

    def bearing(self, scuffing: mesh.ScuffingInputs) -> si.Bearing:
        """Return the solver's bearing. If a plain bearing has no given viscosity, the oil of the gears is used.

        Raises InvalidInput `no_oil` if a plain bearing has no given viscosity and the gears have no oil. Raises
        InvalidInput `bearing_data` if data that this type of bearing requires are missing.
        """
        if self.type == "rigid":
            return self.si(si.RigidBearing)
        if self.type == "linear":
            if self.stiffness_n_per_um is None:
                raise InvalidInput("bearing_data", "A linear bearing needs a stiffness", "stiffness")
            return self.si(si.LinearBearing)
        if self.diameter_mm is None or self.width_mm is None:
            missing = "diameter" if self.diameter_mm is None else "width"
            raise InvalidInput("bearing_data", "A journal bearing needs a diameter and a width", missing)
        if self.viscosity_pa_s is not None:
            return self.si(si.JournalBearing)
        if scuffing.oil is None:
            message = (
                "a plain bearing needs a viscosity if the gears have no oil; give a viscosity at the bearing, or give "
                "an oil for the gears"
            )
            raise InvalidInput("no_oil", message, "viscosity")
        film, feed = (
            None if given is None else UNITS["c"].to_si(given)
            for given in (self.film_temperature_c, self.feed_temperature_c)
        )
        feed = scuffing.temperatures.oil if feed is None else feed
        viscosity = si.gear_oil_viscosity(scuffing.oil, feed, film)
        return self.si(si.JournalBearing, viscosity=viscosity, in_gear_oil=film is None)


class ThrustBearing(Section):
    """The bearing that holds a shaft in the axial direction."""

    ultimate_load_n: Annotated[float | None, Input.of(si.Shaft, "ultimate_thrust")] = None


class UnitShaft(Section, of=si.Shaft, without=("ultimate_thrust",)):
    """A shaft of the unit, with two radial bearings and a thrust bearing."""

    bearings: list[ShaftBearing]
    thrust_bearing: Annotated[ThrustBearing, Input("thrust bearing")] = ThrustBearing()

    def shaft(self, name: str, scuffing: mesh.ScuffingInputs, face_start: float) -> si.Shaft:
        """Return the solver's shaft.

        `name` is "pinion_shaft" or "wheel_shaft". `face_start` [m] is the position at which the face starts. If a
        section or a bearing is invalid, raises InvalidInput with the full name of the wrong field.
        """
        sections = tuple(self._sections(name, scuffing.distribution.gears, face_start))
        bearings = []
        for k, bearing in enumerate(self.bearings):
            try:
                bearings.append(bearing.bearing(scuffing))
            except InvalidInput as error:
                raise InvalidInput(error.code, error.message, f"{name}.bearings.{k}.{error.field}") from error
        return self.si(si.Shaft, self.thrust_bearing, bearings=tuple(bearings), sections=sections)

    def _sections(self, name: str, gears: GearPairInputs, face_start: float) -> Iterator[si.ShaftSection]:
        """Yield the solver's sections of the shaft.

        If a section under the teeth has no diameter, the diameter that carries the torsion is used. Raises InvalidInput
        `section_diameter` if a section has no diameter and is not under the teeth, or reaches from helix to helix.
        """
        teeth = gears.pinion if name == "pinion_shaft" else gears.wheel
        starts = [face_start + k * (gears.total_width - gears.face_width) for k in range(gears.helices)]
        helices = [(start, start + gears.face_width) for start in starts]
        position = UNITS["mm"].to_si(self.start_mm)
        for k, cylinder in enumerate(self.sections):
            left_out = cylinder.outer_diameter_mm is None
            default = {"outer_diameter": si.torsion_diameter(gears, teeth)} if left_out else {}
            section = cylinder.si(si.ShaftSection, **default)
            end = position + section.length
            toothed = sum(position < high - si.COINCIDENT and end > low + si.COINCIDENT for low, high in helices)
            if left_out and toothed != 1:
                message = (
                    "the outer diameter may be left out only under the teeth"
                    + (", not in the gap between the helices" if gears.helices > 1 else "")
                    + f"; give the outer diameter of section {k}"
                )
                raise InvalidInput("section_diameter", message, f"{name}.sections.{k}.outer_diameter")
            yield section
            position = end


class ShaftAlignment(Section, of=si.Alignment):
    """Shaft heights of the unit and of the machine above their feet, and temperature rises of their supports.

    If these data are given, the `offset` of the coupling is the offset of the machine's hub in the cold state.
    """


class UnitCoupling(Section, of=si.UnitCoupling):
    """A gear coupling between a shaft of the unit and a machine."""

    coupling: CrownedCoupling
    lubricant: CouplingLubricant

    def unused(self) -> dict[str, bool]:
        return {"friction.static_coefficient": True, "lubricant": self.friction.coefficient is not None}


class ToothHeat(Section, of=si.Heat):
    """Temperatures of the teeth, and the wall responses of both gears.

    The wall response is the temperature rise of the metal divided by the temperature rise of the pumped gas.
    """


class TrainTemperatures(ContactTemperatures, of=si.DriveTrainInputs, only=("local_bulk",)):
    """Temperatures of the contact and of the oil."""

    bulk_c: Annotated[
        float | None,
        Input.of(
            mesh.Temperatures,
            "bulk",
            text="bulk temperature of the contact, at which the oil enters",
            default_text="mean of the tooth temperatures if they are given, otherwise by the bulk temperature method",
            assumed="the mean of the two tooth temperatures",
        ),
    ] = None


class TrainEffects(Section, of=si.Effects):
    """The effects that the calculation takes into account."""


class ThrustCollar(Section):
    """A collar on the pinion that replaces the thrust bearing of the pinion's shaft."""

    radius_mm: Annotated[float | None, Input.of(si.DriveTrainInputs, "collar_radius")] = None


class DriveTrainRequest(MeshInOil):
    """A single-stage gear unit with its shafts, bearings, couplings and heat."""

    methods: ClassVar = MeshInOil.methods | {
        "temperatures.bulk_method": ("temperatures.bulk_c", "thermal.pinion_bulk_c", "thermal.wheel_bulk_c")
    }

    gears: Annotated[TrainGears, Input("gear pair")]
    grooves: Annotated[
        list[GearGroove],
        Input(
            "grooves",
            text="circumferential grooves, in each helix; they let the mist out; the face carries as before",
            length=(0, 50),
        ),
    ] = Field(default_factory=list)
    operation: Annotated[TrainOperation, Input("operating point")]
    face_start_mm: Annotated[float, Input.of(si.DriveTrainInputs, "face_start")]
    pinion_shaft: Annotated[UnitShaft, Input.of(si.DriveTrainInputs, "pinion_shaft")]
    wheel_shaft: Annotated[UnitShaft, Input.of(si.DriveTrainInputs, "wheel_shaft")]
    floating_shaft: Annotated[si.ShaftName | None, Input.of(si.DriveTrainInputs, "floating_shaft")] = None
    thrust_collar: Annotated[ThrustCollar, Input("thrust collar")] = ThrustCollar()
    couplings: Annotated[list[UnitCoupling], Input.of(si.DriveTrainInputs, "couplings")] = Field(default_factory=list)
    modifications: Annotated[
        TrainModifications, Input("modifications", text="what is ground, and misalignment from elsewhere")
    ] = TrainModifications()
    thermal: Annotated[ToothHeat, Input.of(si.DriveTrainInputs, "heat")] = ToothHeat()
    effects: Annotated[TrainEffects, Input.of(si.DriveTrainInputs, "effects")] = TrainEffects()
    ambient: Annotated[Mist, Input("ambient", text="the mist around the mesh")] = Mist()
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[TrainTemperatures, Input("temperatures", text="of contact and oil")] = TrainTemperatures()
    friction_coefficient: Annotated[float | None, PRACTICAL_FRICTION] = None
    friction_factor: Annotated[float, Input.of(mesh.ScuffingInputs, "friction_factor")] = 1.0
    cooling: Annotated[GearCooling, Input.of(mesh.ScuffingInputs, "cooling")] = GearCooling()
    micropitting: Annotated[Micropitting | None, Input.of(mesh.ScuffingInputs, "micropitting")] = None
    standard: Annotated[StandardLoad, Input.of(mesh.ScuffingInputs, "standard")] = StandardLoad()
    states: Annotated[list[si.State], Input.of(si.DriveTrainInputs, "states")] = Field(
        default_factory=partial(list[si.State], ("hot",))
    )
    model: Annotated[
        TrainModel, Input("model", text="options where the papers leave the model open", advanced=True)
    ] = TrainModel()

    @model_validator(mode="after")
    def bodies_hold_the_pumped_heat(self) -> Self:
        """Set `thermal.bulk_includes_pumping` to true if the bulk temperature comes from the heat balance."""
        if not self.is_balanced:
            return self
        thermal = self.thermal
        if "bulk_includes_pumping" in thermal.model_fields_set and not thermal.bulk_includes_pumping:
            raise PydanticCustomError(
                "exclusive",
                "set thermal.bulk_includes_pumping to true, because the bulk temperature of the heat balance already "
                "includes the heat of pumping",
            )
        heat = thermal.model_copy(update={"bulk_includes_pumping": True})
        return self.model_copy(update={"thermal": heat})

    def running(self) -> tuple[GearPairInputs, mesh.Load]:
        return self.gears.pair(RACK_A), self.operation.si(mesh.Load)

    def inputs(self) -> si.DriveTrainInputs:
        """Return the solver's inputs.

        Raises InvalidInput `no_oil` if a plain bearing has no given viscosity and the gears have no oil.
        """
        scuffing, face_start = self.scuffing_inputs(*self.running()), UNITS["mm"].to_si(self.face_start_mm)
        return self.si(
            si.DriveTrainInputs,
            self.model,
            self.temperatures,
            self.thrust_collar,
            mesh=scuffing,
            pumping=self.si(pumping.PumpingSetup, self.gears, gears=self.gears.pair(GROUND_FILLET)),
            pinion_shaft=self.pinion_shaft.shaft("pinion_shaft", scuffing, face_start),
            wheel_shaft=self.wheel_shaft.shaft("wheel_shaft", scuffing, face_start),
            arrangement=self.operation.si(si.Arrangement, self.gears),
            couplings=tuple(self._couplings()),
            bulk_given=self.temperatures.bulk_c is not None,
        )

    def _couplings(self) -> Iterator[si.UnitCoupling]:
        """Yield the solver's couplings.

        Raises InvalidInput with the full name of the wrong field if no oil can have the properties given for a
        coupling.
        """
        for k, unit in enumerate(self.couplings):
            try:
                lubricant = unit.lubricant.at_teeth()
            except InvalidInput as error:
                raise InvalidInput(error.code, error.message, f"couplings.{k}.{error.field}") from error
            yield unit.si(si.UnitCoupling, lubricant=lubricant)

    def options(self) -> dict[str, Any]:
        """Return the model options, with the number of slices that the calculation uses."""
        return super().options() | {"slices": self.model.si(pumping.PumpingModel).slice_count}

    def assumed_by_the_model(self) -> dict[str, str]:
        """Add to the assumptions of the base class the given inputs that have no effect in a unit."""
        reasons = super().assumed_by_the_model()
        if self.cooling.pumping_w:
            reasons["cooling.pumping_w"] = "not used, because the unit computes its pumping loss"
        for name in ("pinion_bulk_c", "wheel_bulk_c") if self.is_balanced else ():
            if getattr(self.thermal, name) is not None:
                reasons[f"thermal.{name}"] = "not used, because the heat balance computes the temperatures of the teeth"
        if self.gears.gap_width_mm is None:
            second = self.modifications.second_helix
            given = {
                "floating_shaft": self.floating_shaft,
                "operation.axial_force_n": self.operation.axial_force_n,
                "gears.apex_runout_um": self.gears.apex_runout_um,
                "modifications.second_helix.helix_slope_um": second and second.helix_slope_um,
                "modifications.second_helix.lead_crowning_um": second and second.lead_crowning_um,
            }
            reasons |= {path: "not used, because the gears have one helix" for path, value in given.items() if value}
        return reasons

    def unused(self) -> dict[str, bool]:
        coupled = self.couplings and self.effects.shafts and self.effects.coupling
        plain = any(one.type == "journal" for shaft in (self.pinion_shaft, self.wheel_shaft) for one in shaft.bearings)
        return (
            super().unused()
            | dict.fromkeys(("couplings", "model.coupling_friction"), not coupled)
            | {"model.bearing_film": not plain}
            | dict.fromkeys(("thermal.wall_response", "thermal.wall_response_wheel"), not self.effects.thermal)
            | dict.fromkeys(("thermal.pinion_bulk_c", "thermal.wheel_bulk_c"), self.is_balanced)
            | dict.fromkeys(("cooling.pumping_w", "cooling.casing.mass_kg"), True)
            | dict.fromkeys(
                ("cooling.jet_distribution", "pinion_shaft.gear_body", "wheel_shaft.gear_body"), not self._along_face()
            )
            | dict.fromkeys(
                ("gears.apex_runout_um", "floating_shaft", "operation.axial_force_n", "modifications.second_helix"),
                self.gears.gap_width_mm is None,
            )
            | {f"{self._floating()}_shaft.thrust_bearing": self.gears.gap_width_mm is not None}
        )

    def _along_face(self) -> bool:
        """Whether the temperatures follow the face."""
        return self.is_balanced and self.model.face_heat != "uniform"

    def _floating(self) -> si.ShaftName:
        return self.floating_shaft or ("pinion" if self.gears.pinion.teeth <= self.gears.wheel.teeth else "wheel")


class WarmUpRequest(DriveTrainRequest, of=warm_up.WarmUpInputs):
    """A gear unit that starts and warms up. The bulk temperature comes from the heat balance."""

    @model_validator(mode="after")
    def with_a_balance(self) -> Self:
        """Refuse a request with an oil but without a heat balance, because a warm-up needs the heat balance."""
        if self.lubricant.known and not self.is_balanced:
            raise PydanticCustomError(
                "not_asked",
                "a warm-up needs the heat balance: set temperatures.bulk_method to heat_balance, oil_supply to spray, "
                "and leave out bulk temperatures",
            )
        return self

    def _along_face(self) -> bool:
        return False  # a warm-up has uniform temperatures along the face

    def unused(self) -> dict[str, bool]:
        without_effect = ("states", "model.face_heat", "standard", "model.standard_edition")
        return super().unused() | {"cooling.casing.mass_kg": False} | dict.fromkeys(without_effect, True)

    def inputs(self) -> warm_up.WarmUpInputs:  # type: ignore[override]
        return self.si(warm_up.WarmUpInputs, unit=super().inputs())
