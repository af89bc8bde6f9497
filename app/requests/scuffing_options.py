"""Temperatures and options of a scuffing check: sections of /v1/scuffing and /v1/drive-train."""

from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.requests.line_contact import FilmModel
from app.requests.load_distribution import LoadDistributionModel
from app.requests.temperatures import OIL_TEMPERATURE, SCUFFING_TEMPERATURE
from app.schema.base import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.scuffing import inputs as si
from solvers.scuffing.inputs import BulkMethod, OilSupply
from solvers.sources import XUE

FZG = "ISO 14635-1"
TR_13989 = "ISO/TR 13989-1, as read in a public implementation"

_TEMPERATURES = si.Temperatures()


class ScuffingTest(Section):
    """A scuffing test of the oil; stages of other tests than A/8.3/90 mean other temperatures."""

    fzg_stage: Annotated[int, Input("failing load stage", "S", FZG, ge=1, le=12)]
    test: Annotated[Literal["A/8.3/90"], Input("scuffing test", None, FZG)] = "A/8.3/90"
    structure_factor: Annotated[
        float,
        Input("structure factor", "X_W", TR_13989, ge=0.1, le=2, assumed="case-hardened steel with normal austenite"),
    ] = 1.0
    lubricant_factor: Annotated[
        float | None,
        Input(
            "lubricant factor",
            "X_L",
            TR_13989,
            ge=0.1,
            le=2,
            default_text="by the oil's kind, and its viscosity at 90 °C",
        ),
    ] = None


class ContactTemperatures(Section):
    """Temperatures of teeth and oil, as numbers or by what practice makes of test and supply."""

    exclusive: ClassVar = (("scuffing_c", "scuffing_test"),)

    bulk_c: Annotated[float | None, Input("bulk temperature")] = None
    bulk_method: Annotated[
        BulkMethod,
        Input(
            "bulk temperature method",
            None,
            TR_13989,
            text="given, or estimated from oil, its supply and flash; what is left out follows `bulk_c`",
            assumed="estimated from the oil, its supply and the mean flash temperature, of flanks flooded with oil",
        ),
    ] = "estimated"
    oil_supply: Annotated[
        OilSupply, Input("oil supply", "X_S", TR_13989, assumed="spray lubrication; it decides the estimated bulk")
    ] = _TEMPERATURES.oil_supply
    oil_c: Annotated[float, replace(OIL_TEMPERATURE, assumed="60 °C, as in the paper")] = 60.0
    scuffing_c: Annotated[
        float | None,
        replace(SCUFFING_TEMPERATURE, default_text="by `scuffing_test`; with neither no safety factor"),
    ] = None
    scuffing_test: Annotated[
        ScuffingTest | None, Input("scuffing test", text="instead of the temperature: the stage at which the oil fails")
    ] = None

    @model_validator(mode="after")
    def one_way(self) -> Self:
        """One bulk temperature, one scuffing temperature."""
        if self.bulk_method == "estimated" and self.bulk_c is not None:
            raise PydanticCustomError("exclusive", "bulk_c and an estimated bulk are both given; keep one")
        if self.scuffing_c is not None and self.scuffing_test is not None:
            raise PydanticCustomError("exclusive", "scuffing_c and scuffing_test are both given; keep one")
        return self

    @model_validator(mode="before")
    @classmethod
    def bulk_given(cls, given: Any) -> Any:
        """A bulk temperature says by itself that it is given."""
        if isinstance(given, dict) and given.get("bulk_c") is not None:
            return {"bulk_method": "given"} | given
        return given

    def contact_temperatures(self) -> si.Temperatures:
        """The solver's temperatures."""
        fields = to_si(self)
        test = None
        if self.scuffing_test is not None:
            said = to_si(self.scuffing_test)
            test = si.ScuffingTest(**{name: said[name] for name in si.ScuffingTest.__dataclass_fields__})
        return si.Temperatures(
            bulk=fields["bulk"],
            oil=fields["oil"],
            scuffing=fields["scuffing"],
            scuffing_test=test,
            bulk_method=fields["bulk_method"],
            oil_supply=fields["oil_supply"],
        )

    def unused_temperature_defaults(self, section: str, *, oil: bool) -> frozenset[str]:
        """What the way of saying bulk and scuffing temperature leaves out of a result, or that there is no oil."""
        if not oil:
            return frozenset(f"{section}.{name}" for name in type(self).model_fields)
        return frozenset({f"{section}.bulk_c"} if self.bulk_method == "estimated" else {f"{section}.oil_supply"})


class ScuffingTemperatures(ContactTemperatures):
    """Temperatures of teeth and oil."""

    bulk_c: Annotated[
        float | None,
        Input(
            "bulk temperature",
            "θ_M",
            f"{XUE}, Eq. 16",
            text="bulk temperature of the teeth, at which the oil enters",
            ge=-70,
            le=500,
            tolerance=5,
            default_text="estimated",
        ),
    ] = None

    @model_validator(mode="after")
    def known_bulk(self) -> Self:
        """A bulk temperature that is given is a number."""
        if self.bulk_method == "given" and self.bulk_c is None:
            raise PydanticCustomError("missing_bulk", "give bulk_c, or bulk_method estimated")
        return self


class ScuffingModel(LoadDistributionModel, FilmModel):
    """Choices where the paper leaves room, and physics and resolution of the film."""

    friction: Annotated[
        si.FrictionMethod,
        Input(
            "friction law",
            None,
            TR_13989,
            text="the coefficient given, or the mean one of ISO/TR 13989-1, for Blok and the losses; what is left out "
            "follows `friction_coefficient`",
        ),
    ] = "iso_tr_13989"

    lubrication: Annotated[
        si.Lubrication,
        Input(
            "lubrication model",
            None,
            XUE,
            text="film and flash temperature by the thermal EHL solution, or by formulas alone",
            advanced=True,
        ),
    ] = "thermal_ehl"
    path_points: Annotated[
        int,
        Input(
            "points of the scuffing check",
            None,
            XUE,
            text="points of the check along the feature line",
            ge=2,
            le=500,
            advanced=True,
        ),
    ] = 50
