"""Request of /v1/scuffing, and what requests about gear units share with it."""

from abc import abstractmethod
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.models.line_contact.request import FilmModel
from app.models.load_distribution.request import GearPairRequest, LoadDistributionModel, distribution_inputs
from app.models.sections.cooling import GearCooling
from app.models.sections.oil import Oil, from_sheet, of_name
from app.schema.fields import value_at
from app.schema.model import Request, Section
from app.schema.quantities import Input
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import gear_pair
from solvers.heat_balance import Cooling
from solvers.named_oils import named_oils
from solvers.scuffing import inputs as si
from solvers.scuffing.thermal.bulk import balance_share, method_asked


class ContactTemperatures(Section, of=si.Temperatures):
    """Temperatures of the teeth and of the oil.

    The scuffing temperature is given as a number or follows from a scuffing test. The bulk temperature is given as a
    number, estimated by a standard, or computed by the heat balance.
    """

    exclusive: ClassVar = (("scuffing_c", "scuffing_test"),)

    @model_validator(mode="after")
    def one_bulk(self) -> Self:
        """Refuse `bulk_c` beside another method than "given", and a heat balance unless oil jets supply the gears."""
        if self.bulk_method not in {None, "given"} and self.bulk_c is not None:
            method = (
                "an estimated bulk temperature"
                if self.bulk_method == "estimated"
                else "a bulk temperature by heat balance"
            )
            raise PydanticCustomError(
                "exclusive",
                "bulk_c gives the bulk temperature, but bulk_method selects {method}; leave out one of the two",
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
        return {"bulk_c": self.bulk_method not in {None, "given"}}


class ScuffingTemperatures(ContactTemperatures):
    """Temperatures of the teeth and of the oil, for a gear pair."""

    @model_validator(mode="after")
    def known_bulk(self) -> Self:
        """Refuse the value "given" of `bulk_method` if the request has no `bulk_c`."""
        if self.bulk_method == "given" and self.bulk_c is None:
            raise PydanticCustomError("missing_bulk", "give bulk_c, or set bulk_method to estimated or heat_balance")
        return self


class Surfaces(Section, of=si.FlankSurfaces):
    """Hardening of the flanks."""


class Micropitting(Section, of=si.MicropittingCheck):
    """Inputs of the checks against micropitting and wear.

    The film that the flanks need is given, or it follows from a micropitting test of the oil. The wear follows from a
    wear coefficient.
    """

    exclusive: ClassVar = (("failure_load_stage", "permissible_ratio"),)

    @model_validator(mode="before")
    @classmethod
    def passed_the_last_stage(cls, sent: Any) -> Any:
        """Take ">10", as FVA 54/7 prints it, for the last stage."""
        if isinstance(sent, dict) and sent.get("failure_load_stage") == f">{LAST_STAGE}":
            return sent | {"failure_load_stage": LAST_STAGE}
        return sent

    def unused(self) -> dict[str, bool]:
        given = self.permissible_ratio is not None
        return dict.fromkeys(("failure_load_stage", "material_factor"), given) | {
            "surface": given or self.failure_load_stage is None or self.material_factor is not None
        }


class StandardLoad(Section, of=si.StandardFactors):
    """Load factors and flanks for the checks by the standard; they never load the local checks."""


class MeshModel(
    LoadDistributionModel,
    FilmModel,
    of=si.ScuffingInputs,
    without=("line", "micropitting", "cooling", "standard", "friction_factor"),
):
    """Model options of the load distribution and of the film, and the edition of the standard."""


class ScuffingModel(MeshModel, of=si.ScuffingInputs, only=("line",)):
    """Model options of load distribution and film, the edition of the standard, and the part of the flank to check."""


PRACTICAL_FRICTION = Input.of(
    si.LoadDistributionInputs,
    "friction_coefficient",
    assumed=None,
    default_text="by the friction law, from the oil",
)
LAW = (
    "for scuffing, the mean coefficient of ISO/TS 6336-20 is used, with the computed K_Hβ and with K_Hα = 1; for the "
    "losses, Schlenk's coefficient is used, without load factors"
)
NOT_USED = "not used, because `model.friction` selects the coefficient of ISO/TS 6336-20"
OF_A_TEST = {
    "temperatures.scuffing_test.fzg_stage": "fzg_stage",
    "micropitting.failure_load_stage": "micropitting_stage",
}
"""The load stages that the data sheet of a named oil may print; the items are fields of `NamedOil`."""
ESTER_FACTOR = (
    "the lubricant factor of an ester is not known. For scuffing, the factor of a mineral oil is used; for the "
    "losses, the factor of a polyalphaolefin is used if no coefficient of friction is given"
)
ESTER_FILM = (
    f"{ESTER_FACTOR}. For the film against micropitting, the pressure-viscosity coefficient of a mineral oil is used"
)
GIVEN_BULK = (
    "a given bulk temperature does not change with the oil temperature. If only the oil becomes hotter, the stated "
    "safety rises, because the safety compares temperature differences from the oil temperature"
)
SMOOTH_FILM = (
    "the flanks do not touch. A hotter oil makes the full film thinner and reduces its friction. The safety by "
    "thermal EHL may therefore rise by some percent with the oil temperature, although the film becomes thinner and "
    "the safety by Blok falls"
)


LAST_STAGE = 10
PASSED = '10 is the last stage of the test; an oil that passed it (">10") is taken as 10, which is on the safe side'


class MeshInOil(Request):
    """The parts that requests about scuffing have in common: a loaded pair, an oil, temperatures, a law of friction.

    A request either gives a value or chooses a method that computes the value. For example, `model.friction` chooses
    the method for the coefficient of friction, and `friction_coefficient` holds a given coefficient. A key of `methods`
    is the path of a field that chooses a method, and the item under this key holds the paths of the fields for given
    values. If a request gives such a value but does not choose the method, the method is set to "given".
    """

    methods: ClassVar[dict[str, tuple[str, ...]]] = {
        "model.friction": ("friction_coefficient",),
        "temperatures.bulk_method": ("temperatures.bulk_c",),
    }

    @model_validator(mode="before")
    @classmethod
    def methods_of_given_values(cls, sent: Any) -> Any:
        """Set a method to "given" if the request gives the value but does not choose a method."""
        for method, values in cls.methods.items() if isinstance(sent, dict) else ():
            section, name = method.split(".")
            held = sent.get(section, {})
            if isinstance(held, dict) and any(value_at(sent, path) is not None for path in values):
                sent = sent | {section: {**held, name: "given" if held.get(name) is None else held[name]}}
        return sent

    @model_validator(mode="before")
    @classmethod
    def stages_of_the_named_oil(cls, sent: Any) -> Any:
        """Fill in the load stages that the data sheet of a named oil prints, where the request gives nothing else."""
        oil = of_name(sent.get("lubricant")) if isinstance(sent, dict) else None
        if oil is None:
            return sent
        temperatures, film = sent.get("temperatures", {}), sent.get("micropitting")
        if oil.fzg_stage and isinstance(temperatures, dict) and temperatures.get("scuffing_c") is None:
            test = temperatures.get("scuffing_test") or {}
            if isinstance(test, dict) and test.get("fzg_stage") is None:
                test = {**test, "fzg_stage": oil.fzg_stage}
                sent = sent | {"temperatures": {**temperatures, "scuffing_test": test}}
        if oil.micropitting_stage and isinstance(film, dict) and film.get("permissible_ratio") is None:
            stage = film.get("failure_load_stage")
            film = {**film, "failure_load_stage": oil.micropitting_stage if stage is None else stage}
            sent = sent | {"micropitting": film}
        return sent

    @model_validator(mode="after")
    def known_friction(self) -> Self:
        """Refuse the friction method `given` if the request gives no coefficient of friction."""
        if self.model.friction == "given" and self.friction_coefficient is None:
            raise PydanticCustomError(
                "missing_friction", "give friction_coefficient, or set model.friction to iso_tr_13989"
            )
        return self

    @abstractmethod
    def running(self) -> tuple[GearPairInputs, si.Load]:
        """Return the solver's gear pair and load."""

    def scuffing_inputs(self, gears: GearPairInputs, load: si.Load) -> si.ScuffingInputs:
        """Return the solver's inputs for the pair `gears` under `load`."""
        return self.si(
            si.ScuffingInputs,
            self.model,
            distribution=distribution_inputs(self, gears, load),
            lubricant=None,
            oil=self.lubricant.resolve(),
            film=self.model.si(ehl.Model),
        )

    @property
    def bulk_method(self) -> si.BulkMethod | None:
        """The method for the bulk temperature; None for the rule between the estimate and the heat balance."""
        temperatures, cooling = self.temperatures.si(si.Temperatures), self.cooling.si(Cooling)
        return method_asked(temperatures, cooling, has_oil=bool(self.lubricant.known))

    @property
    def asks_for_balance(self) -> bool:
        """Whether a heat balance runs if an oil is known."""
        return self.bulk_method in {None, "heat_balance"}

    @property
    def is_balanced(self) -> bool:
        """Whether a heat balance runs."""
        return bool(self.lubricant.known) and self.asks_for_balance

    @property
    def _lubricant_factor_asked(self) -> bool:
        """Whether the friction, the scuffing temperature or the micropitting film depends on the lubricant factor."""
        test = self.temperatures.scuffing_test
        by_test = test is not None and test.lubricant_factor is None
        asked = self.model.friction == "iso_tr_13989" or by_test or self.micropitting is not None
        return self.lubricant.known and asked

    @property
    def _standard_film_asked(self) -> bool:
        """Whether the film of the standard is computed. This film is only valid for gears without relief."""
        relief = self.modifications.tip_relief_um or self.modifications.root_relief_um
        return self.lubricant.known and self.micropitting is not None and not relief

    @property
    def _scuffing_asked(self) -> bool:
        """Whether the pair is checked against scuffing, locally and by the standard."""
        limit = self.temperatures.scuffing_c is not None or self.temperatures.scuffing_test is not None
        return bool(self.lubricant.known) and limit

    def unused(self) -> dict[str, bool]:
        dry, film, scuffing = not self.lubricant.known, self._standard_film_asked, self._scuffing_asked
        no_film, given = dry or self.model.lubrication == "closed_form", self.bulk_method == "given"
        standard, test = scuffing or film, self.temperatures.scuffing_test
        of_the_film = (name for name in Micropitting.model_fields if not name.startswith("wear"))
        return dict.fromkeys((f"micropitting.{name}" for name in of_the_film), dry) | {
            "micropitting.quality_grade": not film,
            "standard": not standard,
            "standard.running_in": not scuffing,
            "model.standard_edition": not scuffing,
            "temperatures": dry and not given,
            "temperatures.oil_supply": dry or (given and not standard),
            "temperatures.scuffing_test": dry and test is not None and test.lubricant_factor is None,
            "cooling": not self.is_balanced,
            "lubricant": dry,
            "model.rheology": no_film,
            "model.eyring_stress_mpa": no_film,
            "friction_factor": dry or self.model.friction == "given",
            "lubricant.kind": not (self.lubricant.by_sheet or self._lubricant_factor_asked),
        }

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumptions about friction, oil, bulk temperature and film."""
        reasons: dict[str, str] = self.gears.assumed_widths()
        if not self.lubricant.known:
            return reasons
        if self.lubricant.name is not None:
            oil = named_oils()[self.lubricant.name]
            printed = {path: getattr(oil, name) for path, name in OF_A_TEST.items()}
            reasons |= {
                path: from_sheet(oil) for path, stage in printed.items() if stage and value_at(self, path) == stage
            }
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
        if self.micropitting is not None and self.micropitting.failure_load_stage == LAST_STAGE:
            reasons.setdefault("micropitting.failure_load_stage", PASSED)
        return reasons


class ScuffingRequest(MeshInOil, GearPairRequest):
    """A loaded gear pair, its oil, its cooling and its temperatures."""

    friction_coefficient: Annotated[float | None, PRACTICAL_FRICTION] = None
    friction_factor: Annotated[float, Input.of(si.ScuffingInputs, "friction_factor")] = 1.0
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[ScuffingTemperatures, Input("temperatures", text="temperatures of teeth and oil")] = (
        ScuffingTemperatures()
    )
    cooling: Annotated[GearCooling, Input.of(si.ScuffingInputs, "cooling")] = GearCooling()
    micropitting: Annotated[Micropitting | None, Input.of(si.ScuffingInputs, "micropitting")] = None
    standard: Annotated[StandardLoad, Input.of(si.ScuffingInputs, "standard")] = StandardLoad()
    model: Annotated[
        ScuffingModel, Input("model", text="options where the paper leaves the model open", advanced=True)
    ] = ScuffingModel()

    def running(self) -> tuple[GearPairInputs, si.Load]:
        return self.gears.si(GearPairInputs), self.load.si(si.Load)

    @property
    def asks_for_balance(self) -> bool:
        """Whether a heat balance runs if an oil is known: of a pair, only where it can affect the bulk temperature."""
        return super().asks_for_balance and (self.bulk_method is not None or self._is_fast())

    def _is_fast(self) -> bool:
        """Return whether the heat balance has a share in the bulk temperature at this speed."""
        try:
            gears, load = self.running()
            return balance_share(load.pinion_speed * gear_pair(gears).pinion_working_radius) > 0.0
        except InvalidInput:  # the gears are invalid; the solver reports the reason later
            return False

    def unused(self) -> dict[str, bool]:
        along_the_face = ("cooling.jet_distribution", "cooling.measured.face")
        of_a_unit = ("cooling.bearing_film_share", "cooling.casing.mass_kg", *along_the_face)
        single = {"load.axial_force_n": self.gears.gap_width_mm is None}
        return super().unused() | dict.fromkeys(of_a_unit, True) | single

    def inputs(self) -> si.ScuffingInputs:
        return self.scuffing_inputs(*self.running())
