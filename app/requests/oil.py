"""The oil of a lubricated contact: by grade, by data sheet, or by the viscosity where it enters."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.requests.sheet_oil import BY_KIND, SheetOil, names_a_sheet
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.oil_choice import OilChoice
from solvers.oils import OilSheet
from solvers.sources import XUE

TABLE = f"{XUE}, Table 2"
_OIL = Lubricant()
_THE_PAPERS = "the paper's oil"


class Oil(SheetOil):
    """The oil of a lubricated contact: by grade, by data sheet or by its viscosity; nothing names none."""

    exclusive: ClassVar = (
        ("viscosity_pa_s", "iso_vg", "kinematic_viscosity_40_mm2_per_s"),
        ("reference_temperature_c", "iso_vg", "kinematic_viscosity_40_mm2_per_s"),
    )

    viscosity_pa_s: Annotated[
        float | None,
        Input(
            "oil viscosity",
            "η_0",
            TABLE,
            text="viscosity at the reference temperature and no pressure",
            ge=1e-5,
            le=100,
            default_text="by grade or data sheet; with neither no oil is known",
        ),
    ] = None
    reference_temperature_c: Annotated[
        float | None,
        Input(
            "oil reference temperature",
            "θ_0",
            f"{XUE}, Eq. 20",
            text="temperature of viscosity and density",
            ge=-50,
            le=300,
            tolerance=1,
            default_text="with grade or data sheet, where the oil enters the contact",
            assumed="86.85 °C, 360 K, at which the paper's viscosity gives its film thickness; give that of yours",
        ),
    ] = 86.85
    pressure_viscosity_per_gpa: Annotated[
        float | None,
        Input(
            "pressure-viscosity coefficient",
            "α",
            TABLE,
            ge=1,
            le=60,
            default_text="with grade or data sheet, by kind and viscosity (Gold, from memory)",
            assumed=f"{_THE_PAPERS}; with grade or data sheet, by kind and viscosity (Gold, from memory)",
        ),
    ] = 21.9
    temperature_viscosity_per_k: Annotated[
        float | None,
        Input(
            "temperature-viscosity coefficient",
            "β",
            TABLE,
            ge=0,
            le=0.2,
            tolerance=0.001,
            default_text="with grade or data sheet, the slope of the Walther law",
            assumed=f"{_THE_PAPERS}; with grade or data sheet, the slope of the Walther law",
        ),
    ] = _OIL.temperature_viscosity
    density_kg_per_m3: Annotated[
        float | None,
        Input(
            "oil density",
            "ρ_0",
            TABLE,
            text="density at the reference temperature",
            ge=100,
            le=5000,
            default_text="with grade or data sheet, from the density at 15 °C",
            assumed=_THE_PAPERS,
        ),
    ] = _OIL.density
    specific_heat_j_per_kg_k: Annotated[
        float | None,
        Input(
            "oil specific heat",
            "c_oil",
            TABLE,
            ge=100,
            le=10000,
            default_text="with grade or data sheet, by kind",
            assumed=f"{_THE_PAPERS}; with grade or data sheet, {BY_KIND}",
        ),
    ] = _OIL.specific_heat
    thermal_conductivity_w_per_m_k: Annotated[
        float | None,
        Input(
            "oil thermal conductivity",
            "λ_oil",
            TABLE,
            ge=0.01,
            le=10,
            default_text="with grade or data sheet, by kind",
            assumed=f"{_THE_PAPERS}; with grade or data sheet, {BY_KIND}",
        ),
    ] = _OIL.thermal_conductivity
    pressure_viscosity_law: Annotated[
        PressureViscosityLaw,
        Input(
            "pressure-viscosity law",
            None,
            TABLE,
            text="how viscosity depends on pressure and temperature",
            advanced=True,
        ),
    ] = _OIL.pressure_viscosity_law
    compressible: Annotated[
        bool,
        Input(
            "compressible oil",
            None,
            TABLE,
            text="whether density follows pressure and temperature (Dowson and Higginson)",
            advanced=True,
        ),
    ] = _OIL.compressible

    @model_validator(mode="before")
    @classmethod
    def properties_follow_the_sheet(cls, given: Any) -> Any:
        """Properties have defaults of their own only with a viscosity; otherwise they follow from the sheet, if any."""
        if not isinstance(given, dict) or (given.get("viscosity_pa_s") is not None and not names_a_sheet(given)):
            return given
        return dict.fromkeys(_WITH_VISCOSITY) | given

    @model_validator(mode="after")
    def one_reference(self) -> Self:
        """Viscosity and its temperature stand alone; with a viscosity no property may be null."""
        if self.by_sheet:
            for name in ("viscosity_pa_s", "reference_temperature_c", "density_kg_per_m3"):
                if getattr(self, name) is not None:
                    raise PydanticCustomError(
                        "exclusive", "{name} and a grade or data sheet are both given; keep one", {"name": name}
                    )
        elif self.viscosity_pa_s is not None:
            missing = [name for name in _WITH_VISCOSITY if getattr(self, name) is None]
            if missing:
                raise PydanticCustomError(
                    "missing_property", "give {name}, or the oil by its grade or data sheet", {"name": missing[0]}
                )
        return self

    @property
    def known(self) -> bool:
        """Whether an oil is given."""
        return self.by_sheet or self.viscosity_pa_s is not None

    def oil(self) -> OilSheet | Lubricant | None:
        """The solver's oil. Raises what `OilChoice.resolve` raises."""
        return OilChoice(**to_si(self)).resolve()

    def unused_defaults(self, section: str, *, factor: bool = False) -> frozenset[str]:
        """What this way of giving the oil leaves out of a result; `factor` says that its kind counts."""
        if not self.known:
            return frozenset(f"{section}.{name}" for name in type(self).model_fields)
        unused = self.unused_sheet_defaults(section)
        if self.by_sheet:
            return unused | {f"{section}.{name}" for name in ("reference_temperature_c", "density_kg_per_m3")}
        return unused - {f"{section}.kind"} if factor else unused


_WITH_VISCOSITY = tuple(
    name
    for name, field in Oil.model_fields.items()
    if name not in SheetOil.model_fields and field.default is not None and not isinstance(field.default, bool | str)
)
