"""Scuffing of a gear pair: requests and answers of /v1/scuffing and of its load distribution."""

from abc import abstractmethod
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.schema.cooling import GearCooling
from app.schema.gears import GearMaterials, ScuffingGears
from app.schema.line_contact import FilmModel
from app.schema.model import Derived, Group, Request, Response, Section
from app.schema.oil import Oil
from app.schema.quantities import Input, View
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.heat_balance.notices import KNOWN_WITHIN
from solvers.lubricants import OilInUse
from solvers.materials import Solid
from solvers.scuffing import inputs as si
from solvers.scuffing import results, safety_results
from solvers.scuffing.micropitting import results as film_results
from solvers.scuffing.thermal.pair_heat import is_beyond_the_estimate


class FlankModifications(Section, of=si.Modifications, without=("lead_curve",)):
    """Gaps along the transverse line of action; a gap is positive where material is missing."""

    def unused(self) -> dict[str, bool]:
        """Mark the length of each relief of zero height as unused, and the exponent if all reliefs are zero."""
        amplitudes = {relief: getattr(self, f"{relief}_um") for relief in ("tip_relief", "root_relief", "end_relief")}
        lengths = {f"{relief}_length_mm": value == 0.0 for relief, value in amplitudes.items()}
        return lengths | {"relief_exponent": all(lengths.values())}


class ScuffingLoad(Section, of=si.Load):
    """The speed, and either the torque or the power."""

    exclusive: ClassVar = (("pinion_torque_n_m", "power_kw"),)
    choice_code: ClassVar = "torque_or_power"
    choice_missing: ClassVar = "torque_or_power"

    pinion_torque_n_m: float | None = None


class LoadDistributionModel(Section, of=(si.Model, si.Resolution)):
    """Options of the load distribution at points that the paper leaves open."""


class GearPairRequest(Request):
    """A loaded gear pair with modifications and misalignment."""

    gears: Annotated[ScuffingGears, Input("gear pair")]
    load: Annotated[ScuffingLoad, Input("load", text="torque or power, and speed")]
    modifications: Annotated[FlankModifications, Input("modifications", text="modification and misalignment")] = (
        FlankModifications()
    )
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()


def distribution_inputs(request: Request, gears: GearPairInputs, load: si.Load) -> si.LoadDistributionInputs:
    """Return the solver's inputs for this pair and load.

    The modifications, the materials and the coefficient of friction are taken from the request.
    """
    return request.si(
        si.LoadDistributionInputs,
        gears=gears,
        load=load,
        pinion_material=request.materials.pinion.si(Solid),
        wheel_material=request.materials.wheel.si(Solid),
        resolution=request.model.si(si.Resolution),
    )


class LoadDistributionRequest(GearPairRequest):
    """A loaded gear pair with modifications and misalignment, and the friction between its flanks."""

    friction_coefficient: Annotated[float, Input.of(si.LoadDistributionInputs, "friction_coefficient")] = 0.06
    model: Annotated[
        LoadDistributionModel, Input("model", text="choices where the paper leaves room", advanced=True)
    ] = LoadDistributionModel()

    def inputs(self) -> si.LoadDistributionInputs:
        return distribution_inputs(self, self.gears.si(GearPairInputs), self.load.si(si.Load))

    def unused(self) -> dict[str, bool]:
        """Mark the roughness as unused, because the loads do not depend on it."""
        return {"materials.pinion.roughness_um": True, "materials.wheel.roughness_um": True}


FILM_SAFETY = View(limit=1.0, bound="lower")


class MicropittingTestFilm(Group, of=film_results.FilmOfTest):
    """The film of the test gears C-GF with this oil, at the load stage at which the oil fails."""


class LocalFilmPoint(Group, of=film_results.LocalPoint):
    """The film at a point of the feature line."""

    views: ClassVar = {"safety": FILM_SAFETY}


class LocalFilm(Group, of=film_results.LocalFilm):
    """The film at each point of the flank, computed with the load at this point (method A)."""

    views: ClassVar = {"safety": replace(FILM_SAFETY, needs="micropitting.failure_load_stage", verdict=".verdict")}


class StandardFilmPoint(Group, of=film_results.StandardPoint):
    """The film at a point of the path of contact."""

    views: ClassVar = {"safety": FILM_SAFETY}


class StandardFilm(Group, of=film_results.StandardFilm):
    """The film of a spur pair without relief, computed with a uniform load over the face (method B)."""

    views: ClassVar = {"safety": FILM_SAFETY}


class MicropittingResult(Group, of=film_results.Micropitting):
    """The film over the flanks, compared with the film that the micropitting test of the oil requires."""


class FlankWear(Group, of=film_results.Wear):
    """Depth of mild wear of each gear per million revolutions of this gear."""


class ScuffingGeometry(Group, of=results.Geometry):
    """Geometry of the mesh."""


class ContactLengthCurves(Group, of=results.LengthCurves):
    """Total length of the contact lines over one base pitch.

    If the length of a spur gear jumps at a roll position, this position occurs twice: first with the length before the
    jump, and then with the length after the jump.
    """


class ContactLineLengths(Group, of=results.ContactLines):
    """Extremes and mean of the total length of the contact lines."""


class ToothStiffnessCurves(Group, of=results.StiffnessCurves):
    """Stiffness of one pair of teeth along the path of contact."""


class ToothStiffness(Group, of=results.Stiffness):
    """Stiffness of one pair of teeth and of the mesh, per face width."""


class TransmissionErrorCurves(Group, of=results.ErrorCurves):
    """Transmission error over one base pitch.

    If the error of a spur gear jumps at a roll position, this position occurs twice: first with the error before the
    jump, and then with the error after the jump.
    """


class TransmissionErrorResult(Group, of=results.TransmissionError):
    """Transmission error along the transverse line of action."""

    views: ClassVar = {"peak_to_peak": View(headline=3)}


class MeshLoss(Group, of=results.FrictionLoss):
    """Friction loss of the mesh, computed with the mean coefficient of friction.

    Power and efficiency are computed for the transmitted power, without load factors.
    """


class FlankPlace(Group, of=results.Place):
    """A point of the flank."""


class FlankPressure(Group, of=results.Pressure):
    """Largest Hertzian pressure of the dry contact, and its place."""

    views: ClassVar = {"max": View(headline=1)}


class FeatureLineCurves(Group, of=results.FeatureLine):
    """Curves along the feature line from A1 to E2.

    The points A, C and E of the path of contact lie on this line.
    """


class FlankFields(Group, of=results.Flank):
    """Maps of the flank, indexed `[profile][face]`."""


class FlashTemperature(Group, of=safety_results.Flash):
    """Largest flash temperatures and their places.

    Values by thermal EHL are null if `model.lubrication` is `closed_form`.
    """


class ContactTemperatureResult(Group, of=safety_results.ContactTemperature):
    """The bulk temperature, and the largest sum of bulk and flash temperature (contact temperature)."""

    views: ClassVar = {
        "blok_max": View(headline=2, limit="safety.scuffing_c", bound="upper"),
        "thermal_ehl_max": View(limit="safety.scuffing_c", bound="upper"),
    }


class ThinnestFilm(Group, of=safety_results.Film):
    """The thinnest film and its place; null if no point of the flank carries load."""

    views: ClassVar = {"thickness_ratio": View(headline=3, limit=1.0, bound="lower", verdict=".thickness_regime")}


class ScuffingSafety(Group, of=safety_results.Safety):
    """Safety factors against scuffing, with the scuffing temperature."""

    views: ClassVar = {
        "blok_factor": View(
            headline=1,
            limit=1.0,
            bound="lower",
            needs="temperatures.scuffing_c",
            verdict=".verdict",
            band="heat.band.safety",
        ),
        "feature_line_factor": View(limit=1.0, bound="lower"),
        "thermal_ehl_factor": View(limit=1.0, bound="lower"),
    }


class ScuffingPathCurves(Group, of=(safety_results.ScuffingPath, safety_results.ThermalPath)):
    """Curves along a line from A to E.

    Values that only the thermal EHL solution provides are null if `model.lubrication` is `closed_form`.
    """

    views: ClassVar = {"thickness_ratio": View(limit=1.0, bound="lower")}


class MeshDerived(Derived, of=results.Derived, without=("rack_tip_radius",)):
    """Load and lengths as used, including the values that the request left open."""


class ScuffingDerived(MeshDerived, of=results.Derived):
    """Load, lengths and tip radius of the rack as used, including the values that the request left open."""


class FlankLoad(Group, of=results.LoadOnFlank):
    """Load on the flank."""

    views: ClassVar = {"face_load_factor": View(headline=2), "contact_fraction": View(percent=True)}

    pair_share: list[list[float]] | None


class LoadDistributionResponse(Response, of=results.LoadDistribution):
    """Results of the load distribution of a gear pair.

    If there is no solution, the sections with results are missing.
    """


class ScuffingTest(Section, of=si.ScuffingTest):
    """A scuffing test of the oil.

    Only the test A/8.3/90 is accepted. In other tests, the same load stage corresponds to a different temperature.
    """


class ContactTemperatures(Section, of=si.Temperatures):
    """Temperatures of the teeth and the oil.

    The temperatures are given as numbers, or follow from the scuffing test and the oil supply by rules of practice.
    """

    exclusive: ClassVar = (("scuffing_c", "scuffing_test"),)

    @model_validator(mode="after")
    def one_bulk(self) -> Self:
        """Refuse a bulk temperature if the method is not `given`, and a heat balance if no jets supply the oil."""
        if self.bulk_method != "given" and self.bulk_c is not None:
            method = (
                "an estimated bulk temperature"
                if self.bulk_method == "estimated"
                else "a bulk temperature by heat balance"
            )
            raise PydanticCustomError(
                "exclusive",
                "bulk_c and {method} are both given; leave bulk_c out, or set bulk_method to given",
                {"method": method},
            )
        if self.bulk_method == "heat_balance" and self.oil_supply != "spray":
            raise PydanticCustomError(
                "exclusive",
                "the heat balance holds only for gears under jets (oil_supply spray). For gears that dip into oil, "
                "set bulk_method to estimated, or give a measured bulk_c",
            )
        return self

    def unused(self) -> dict[str, bool]:
        """Mark the bulk temperature as unused if it is estimated or computed by the heat balance."""
        return {"bulk_c": self.bulk_method != "given"}


class ScuffingTemperatures(ContactTemperatures):
    """Temperatures of the teeth and the oil."""

    @model_validator(mode="after")
    def known_bulk(self) -> Self:
        """Refuse the method `given` if no bulk temperature is given."""
        if self.bulk_method == "given" and self.bulk_c is None:
            raise PydanticCustomError("missing_bulk", "give bulk_c, or set bulk_method to estimated or heat_balance")
        return self


class Surfaces(Section, of=si.FlankSurfaces):
    """How the flanks are hardened."""


class Micropitting(Section, of=si.MicropittingCheck):
    """Inputs of the checks against micropitting and wear.

    The film that the flanks need is either given, or it follows from a micropitting test of the oil. The wear follows
    from a wear coefficient.
    """

    exclusive: ClassVar = (("failure_load_stage", "permissible_ratio"),)

    def unused(self) -> dict[str, bool]:
        """Mark the test of the oil and the material factor as unused if the permissible ratio is given.

        Mark the surfaces as unused if the permissible ratio or the material factor is given, or if the test is not
        given.
        """
        given = self.permissible_ratio is not None
        return dict.fromkeys(("failure_load_stage", "material_factor"), given) | {
            "surface": given or self.failure_load_stage is None or self.material_factor is not None
        }


class MeshModel(LoadDistributionModel, FilmModel, of=si.ScuffingInputs, without=("line", "micropitting", "cooling")):
    """Options of the load distribution and of the film."""


class ScuffingModel(MeshModel, of=si.ScuffingInputs, only=("line",)):
    """Options of the load distribution and of the film, and the part of the flank that is checked."""


PRACTICAL_FRICTION = Input.of(
    si.LoadDistributionInputs,
    "friction_coefficient",
    assumed=None,
    default_text="by the friction law, from the oil",
)
LAW = (
    "for scuffing, the mean coefficient of ISO/TR 13989-1 is used, with the computed K_Hβ and with K_Hα = 1; for the "
    "losses, Schlenk's coefficient is used, without load factors"
)
NOT_USED = "not used, because `model.friction` selects the coefficient of ISO/TR 13989-1"
ESTER_FACTOR = (
    "the lubricant factor of an ester is not known. For scuffing, the factor of a mineral oil is used; for the "
    "losses, the factor of a polyalphaolefin is used if no coefficient of friction is given"
)
ESTER_FILM = (
    f"{ESTER_FACTOR}. For the film against micropitting, the pressure-viscosity coefficient of a mineral oil is used"
)
NOT_VALIDATED, KNOWN = "not_validated", f"known to about ±{KNOWN_WITHIN:g} K"
GIVEN_BULK = (
    "a given bulk temperature does not change with the oil temperature. If only the oil becomes hotter, the stated "
    "safety rises, because the safety compares temperature differences from the oil temperature"
)
SMOOTH_FILM = (
    "the flanks do not touch. A hotter oil makes the full film thinner and reduces its friction. The safety by "
    "thermal EHL may therefore rise by some percent with the oil temperature, although the film becomes thinner and "
    "the safety by Blok falls"
)


def _is_given(sent: Any, path: str) -> bool:
    """Return whether the body that was sent has a value other than null at a dotted path."""
    for name in path.split("."):
        sent = sent.get(name) if isinstance(sent, dict) else None
    return sent is not None


class MeshInOil(Request):
    """The parts that requests about scuffing have in common: a loaded pair, an oil, temperatures, a law of friction.

    `methods` maps the field of a method to fields of values: if one of the values is given, and the request does not
    name the method, the method is "given".
    """

    balance_is_default: ClassVar = False  # whether the heat balance is the default at any speed
    methods: ClassVar[dict[str, tuple[str, ...]]] = {
        "model.friction": ("friction_coefficient",),
        "temperatures.bulk_method": ("temperatures.bulk_c",),
    }

    @model_validator(mode="before")
    @classmethod
    def methods_of_given_values(cls, sent: Any) -> Any:
        """Set a method that the request does not name to "given" if one of its values is given."""
        for method, values in cls.methods.items() if isinstance(sent, dict) else ():
            section, name = method.split(".")
            held = sent.get(section, {})
            if isinstance(held, dict) and any(_is_given(sent, path) for path in values):
                sent = sent | {section: {name: "given"} | held}
        return sent

    @model_validator(mode="after")
    def known_friction(self) -> Self:
        """Refuse the method `given` of friction if no coefficient of friction is given."""
        if self.model.friction == "given" and self.friction_coefficient is None:
            raise PydanticCustomError(
                "missing_friction", "give friction_coefficient, or set model.friction to iso_tr_13989"
            )
        return self

    @model_validator(mode="after")
    def balance_where_the_estimate_ends(self) -> Self:
        """Set the method of the bulk temperature to the heat balance if the request does not name a method.

        The method is only set if an oil is given, jets supply the oil, and one of three conditions is met: the heat
        balance is the default, the cooling is given, or the pair is too fast for the estimated bulk temperature.
        """
        temperatures = self.temperatures
        if "bulk_method" in temperatures.model_fields_set or temperatures.oil_supply != "spray":
            return self
        asked = self.balance_is_default or self.cooling.is_given
        if not self.lubricant.known or not (asked or self._is_fast()):
            return self
        balanced = temperatures.model_copy(update={"bulk_method": "heat_balance"})
        balanced.model_fields_set.discard("bulk_method")  # so that the method counts as a default
        request = self.model_copy(update={"temperatures": balanced})
        if "temperatures" not in self.model_fields_set:
            request.model_fields_set.discard("temperatures")
        return request

    @abstractmethod
    def running(self) -> tuple[GearPairInputs, si.Load]:
        """Return the pair and its load."""

    def _is_fast(self) -> bool:
        """Return whether the pitch line velocity exceeds the validity of the estimated bulk temperature."""
        try:
            gears, load = self.running()
            return is_beyond_the_estimate(gears, load.pinion_speed)
        except InvalidInput:  # the gears are invalid; the solver reports the reason later
            return False

    def scuffing_inputs(self, gears: GearPairInputs, load: si.Load) -> si.ScuffingInputs:
        """Return the solver's inputs for this pair and load."""
        return self.si(
            si.ScuffingInputs,
            self.model,
            distribution=distribution_inputs(self, gears, load),
            lubricant=None,
            oil=self.lubricant.resolve(),
            film=self.model.si(ehl.Model),
        )

    @property
    def is_balanced(self) -> bool:
        """Whether the bulk temperature comes from a heat balance."""
        return bool(self.lubricant.known) and self.temperatures.bulk_method == "heat_balance"

    @property
    def _lubricant_factor_asked(self) -> bool:
        """Whether friction, scuffing temperature or micropitting film depends on the lubricant factor."""
        test = self.temperatures.scuffing_test
        by_test = test is not None and test.lubricant_factor is None
        asked = self.model.friction == "iso_tr_13989" or by_test or self.micropitting is not None
        return self.lubricant.known and asked

    @property
    def _standard_film_asked(self) -> bool:
        """Whether micropitting is checked by the standard's film, which is valid for spur gears without relief."""
        relief = self.modifications.tip_relief_um or self.modifications.root_relief_um
        return self.micropitting is not None and not relief and self.gears.helix_angle_deg == 0.0

    def unused(self) -> dict[str, bool]:
        """Mark inputs as unused if they have no effect in this case.

        Some inputs have no effect if there is no oil, some if the film is computed in closed form, and some if the
        standard's film is not computed.
        """
        dry, standard = not self.lubricant.known, self._standard_film_asked
        no_film = dry or self.model.lubrication == "closed_form"
        of_the_film = (name for name in Micropitting.model_fields if not name.startswith("wear"))
        return dict.fromkeys((f"micropitting.{name}" for name in of_the_film), dry) | {
            "micropitting.quality_grade": dry or not standard,
            "temperatures.oil_supply": self.temperatures.bulk_method == "given" and not standard,
            "cooling": not self.is_balanced,
            "lubricant": dry,
            "temperatures": dry,
            "model.rheology": no_film,
            "model.eyring_stress_mpa": no_film,
            "lubricant.kind": not (self.lubricant.by_sheet or self._lubricant_factor_asked),
        }

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumptions about friction, oil, bulk temperature and film; empty if no oil is given."""
        reasons: dict[str, str] = {}
        if not self.lubricant.known:
            return reasons
        if self.model.friction == "iso_tr_13989":
            reasons["model.friction"] = LAW
            if self.friction_coefficient is not None:
                reasons["friction_coefficient"] = NOT_USED
        if self.lubricant.kind == "ester" and self._lubricant_factor_asked:
            reasons["lubricant.kind"] = ESTER_FACTOR if self.micropitting is None else ESTER_FILM
        if self.temperatures.bulk_method == "given":
            reasons["temperatures.bulk_method"] = GIVEN_BULK
        if self.model.lubrication == "thermal_ehl":
            reasons["model.lubrication"] = SMOOTH_FILM
        return reasons


class ScuffingRequest(MeshInOil, GearPairRequest):
    """A loaded gear pair, its oil, its cooling and its temperatures."""

    friction_coefficient: Annotated[float | None, PRACTICAL_FRICTION] = None
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[ScuffingTemperatures, Input("temperatures", text="temperatures of teeth and oil")] = (
        ScuffingTemperatures()
    )
    cooling: Annotated[GearCooling, Input.of(si.ScuffingInputs, "cooling")] = GearCooling()
    micropitting: Annotated[Micropitting | None, Input.of(si.ScuffingInputs, "micropitting")] = None
    model: Annotated[ScuffingModel, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        ScuffingModel()
    )

    def running(self) -> tuple[GearPairInputs, si.Load]:
        return self.gears.si(GearPairInputs), self.load.si(si.Load)

    def unused(self) -> dict[str, bool]:
        """Also mark the inputs as unused that only a gear unit has: the bearings and the mass of the casing."""
        of_a_unit = ("cooling.bearing_film_share", "cooling.casing.mass_kg")
        return super().unused() | dict.fromkeys(of_a_unit, True)

    def inputs(self) -> si.ScuffingInputs:
        return self.scuffing_inputs(*self.running())


class ScuffingOilDerived(ScuffingDerived, of=(safety_results.ScuffingDerived, OilInUse)):
    """Load and lengths as used, and properties of the oil at the place where the oil enters the contact."""


def how_well_known(response: Response, *paths: str) -> dict[str, str]:
    """Return the uncertainty of the temperatures of a heat balance; empty if a temperature was measured."""
    return dict.fromkeys(paths, KNOWN) if NOT_VALIDATED in {notice.code for notice in response.warnings} else {}


class HeatedFlankFields(Group, of=safety_results.HeatedFlank):
    """Maps of the flank, indexed `[profile][face]`."""


class ScuffingResponse(LoadDistributionResponse, of=safety_results.Scuffing):
    """Results of the load distribution and of the scuffing check.

    If there is no solution, the sections with results are missing.
    """

    flank: HeatedFlankFields | None
    derived: ScuffingOilDerived

    def remarks(self) -> dict[str, str]:
        """Return the uncertainty of the bulk temperature of a heat balance without measured temperatures."""
        return how_well_known(self, "contact_temperature.bulk_c")
