"""The oil of a lubricated contact: by grade, by data sheet, or by the viscosity where it enters."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.requests.sheet_oil import BY_KIND, SheetOil, names_a_sheet
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.oils import OilSheet
from solvers.sources import XUE

TABLE = f"{XUE}, Table 2"
_OIL = Lubricant()
_THE_PAPERS = "the paper's oil"


class Oil(SheetOil):
    """The oil of a lubricated contact; without grade or data sheet it is the paper's, at 360 K."""

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
            default_text="by grade or data sheet",
            assumed=f"{_THE_PAPERS}, 0.08 Pa s at 86.85 °C; an ISO VG 220 has 0.024 there",
        ),
    ] = _OIL.viscosity
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
            assumed="360 K: the only temperature at which the paper's viscosity gives its film thickness",
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
        """With grade or data sheet, what is not given is no default of the paper's but follows from the sheet."""
        return dict.fromkeys(_OF_THE_PAPER) | given if names_a_sheet(given) else given

    @model_validator(mode="after")
    def one_reference(self) -> Self:
        """Viscosity and its temperature stand alone; without a sheet no property may be null."""
        if self.by_sheet:
            for name in ("viscosity_pa_s", "reference_temperature_c", "density_kg_per_m3"):
                if getattr(self, name) is not None:
                    raise PydanticCustomError(
                        "exclusive", "{name} and a grade or data sheet are both given; keep one", {"name": name}
                    )
            return self
        missing = [name for name in _OF_THE_PAPER if getattr(self, name) is None]
        if missing:
            raise PydanticCustomError(
                "missing_property", "give {name}, or the oil by its grade or data sheet", {"name": missing[0]}
            )
        return self

    def oil(self) -> OilSheet | None:
        """The solver's oil, where it is given by grade or data sheet."""
        fields = to_si(self)
        return self.sheet(**{name: fields[name] for name in _BEYOND_VISCOSITY}) if self.by_sheet else None

    def lubricant(self, temperature: float = _OIL.reference_temperature) -> Lubricant:
        """The solver's lubricant; one by grade or data sheet as it is at a temperature [K]."""
        oil = self.oil()
        if oil is not None:
            return oil.lubricant(temperature)
        fields = to_si(self)
        return Lubricant(**{name: fields[name] for name in Lubricant.__dataclass_fields__})

    def unused_defaults(self, section: str) -> frozenset[str]:
        """What this way of giving the oil leaves out of a result."""
        unused = self.unused_sheet_defaults(section)
        replaced = {"viscosity_pa_s", "reference_temperature_c", "density_kg_per_m3"}
        return unused | ({f"{section}.{name}" for name in replaced} if self.by_sheet else set())


_BEYOND_VISCOSITY = (
    "pressure_viscosity",
    "temperature_viscosity",
    "specific_heat",
    "thermal_conductivity",
    "pressure_viscosity_law",
    "compressible",
)
_OF_THE_PAPER = tuple(
    name
    for name, field in Oil.model_fields.items()
    if name not in SheetOil.model_fields and field.default is not None and not isinstance(field.default, bool | str)
)
