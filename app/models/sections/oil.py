"""Sections that describe an oil by its grade, by its data sheet, or by its viscosity."""

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, model_validator
from pydantic_core import PydanticCustomError

from app.schema.model import Section
from app.schema.quantities import Input
from solvers.coupling.inputs import Lubricant as OilAtTeeth
from solvers.lubricants import Lubricant, OilKind
from solvers.named_oils import NamedOil, named_oils, nearest_names
from solvers.oils import SQUARE_MILLIMETRE, VISCOSITY_INDICES, IsoGrade, OilSheet, iso_vg, sheet_of_index
from solvers.quantity import UNITS

_PAPERS = Lubricant()


DESCRIBED = ("name", "iso_vg", "kinematic_viscosity_40_mm2_per_s")
"""The fields by which an oil has a viscosity at every temperature."""


def _names_a_sheet(given: dict[str, Any]) -> bool:
    """Return whether the fields that were sent for an oil include a name, a grade or a data sheet."""
    return any(given.get(name) is not None for name in DESCRIBED)


BY_NAME = {name.casefold(): oil for name, oil in named_oils().items()}


def of_name(given: Any) -> NamedOil | None:
    """Return the oil that the fields sent for an oil name; None without a name, or with an unknown one."""
    name = given.get("name") if isinstance(given, dict) else None
    return BY_NAME.get(name.casefold()) if isinstance(name, str) else None


def _known_name(text: Any) -> str:
    """Return the name as the table writes it. Anything else is refused with the most similar names."""
    oil = of_name({"name": text})
    if oil is None:
        raise PydanticCustomError(
            "unknown_oil",
            "no data sheet of this name was read; the nearest are {near}. Any other oil: leave out the name, and enter "
            "the viscosities of its data sheet",
            {"near": "; ".join(nearest_names(text if isinstance(text, str) else ""))},
        )
    return oil.name


if TYPE_CHECKING:
    OilName = str
else:
    OilName = Annotated[Literal[*named_oils()], BeforeValidator(_known_name)]


RARELY = "by the kind of oil; few data sheets state it"


def _of_a_sheet(name: str, ge: float, le: float, text: str, assumed: str | None = None) -> Input:
    """Return the declaration of an oil property that follows from the grade or data sheet, if either is given."""
    return Input.of(
        Lubricant,
        name,
        ge=ge,
        le=le,
        default_text=f"with grade or data sheet, {text}",
        assumed=f"the paper's oil; with grade or data sheet, {assumed or text}",
    )


class SheetOil(Section):
    """An oil that is described by its name, by its ISO grade or by its data sheet.

    A data sheet states the viscosity at 40 °C. A second value may say how the viscosity changes with temperature: the
    viscosity at 100 °C or the viscosity index. The name stands for a data sheet that was read; a value that is given
    beside the name replaces the value of this sheet.
    """

    exclusive: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("iso_vg", "viscosity_pa_s", "kinematic_viscosity_40_mm2_per_s"),
        ("kinematic_viscosity_100_mm2_per_s", "viscosity_index"),
        ("name", "iso_vg"),
        ("name", "viscosity_pa_s"),
    )
    alternatives: ClassVar = (("iso_vg", "name", "viscosity_pa_s", "kinematic_viscosity_40_mm2_per_s"),)

    name: Annotated[
        OilName | None,
        Input(
            "name of the oil",
            source="data sheets, each cited among the assumptions",
            text="an oil whose data sheet was read; given values replace those of the sheet",
            default_text="by grade, data sheet or viscosity",
        ),
    ] = None
    iso_vg: Annotated[IsoGrade | None, Input("ISO viscosity grade", "VG", "ISO 3448")] = None
    kinematic_viscosity_40_mm2_per_s: Annotated[float | None, Input.of(OilSheet, "kinematic_viscosity_40")] = None
    kinematic_viscosity_100_mm2_per_s: Annotated[
        float | None,
        Input.of(
            OilSheet,
            "kinematic_viscosity_100",
            default_text="by the viscosity index, otherwise typical of the kind of oil",
            assumed=(
                "typical viscosity index of the kind of oil: 94 to 102 mineral, 145 to 190 PAO by its viscosity, 150 "
                "ester, 210 polyglycol"
            ),
        ),
    ] = None
    viscosity_index: Annotated[
        float | None,
        Input(
            "viscosity index",
            "VI",
            "ASTM D2270",
            ge=VISCOSITY_INDICES[0],
            le=VISCOSITY_INDICES[1],
            tolerance=5,
            text="instead of the viscosity at 100 °C",
            default_text="by the viscosity at 100 °C, otherwise typical of the kind of oil",
        ),
    ] = None
    kind: Annotated[OilKind, Input.of(OilSheet, "kind")] = "mineral"
    density_15_kg_per_m3: Annotated[float | None, Input.of(OilSheet, "density_15")] = None

    @property
    def by_sheet(self) -> bool:
        """Whether the oil is given by name, grade or data sheet."""
        return _names_a_sheet(vars(self))

    @model_validator(mode="before")
    @classmethod
    def values_of_the_named_oil(cls, given: Any) -> Any:
        """Fill in the values of the data sheet that the name stands for, where the request gives none."""
        oil = of_name(given)
        second = ("iso_vg", "viscosity_pa_s", "reference_temperature_c")
        if oil is None or any(given.get(name) is not None for name in second):
            return given  # what does not go with a name is refused later
        left_out = {"kinematic_viscosity_100_mm2_per_s"} if given.get("viscosity_index") is not None else set()
        values = ((name, getattr(oil, name)) for name in OF_A_NAME if name not in left_out)
        return given | {name: value for name, value in values if value is not None and given.get(name) is None}

    def values_by_source(self) -> dict[str, str]:
        if self.name is None:
            return {}
        oil = named_oils()[self.name]
        printed = ((name, getattr(oil, name)) for name in OF_A_NAME)
        found = {name: from_sheet(oil) for name, value in printed if value is not None and getattr(self, name) == value}
        index = "kinematic_viscosity_100_mm2_per_s"
        return found | ({index: found[index] + oil.index_remark} if index in found else {})

    @model_validator(mode="after")
    def one_way(self) -> Self:
        """Refuse incomplete data. Also refuse two values that both determine the same property.

        If the viscosity at 100 °C is given, the viscosity at 40 °C must be given, and the grade must not be given. If
        the viscosity index is given, the viscosity at 40 °C or the grade must be given.
        """
        thin = self.kinematic_viscosity_100_mm2_per_s
        if self.iso_vg is not None and thin is not None:
            raise PydanticCustomError(
                "exclusive",
                "iso_vg and kinematic viscosities are both given; keep either iso_vg or the kinematic viscosities",
            )
        if self.kinematic_viscosity_40_mm2_per_s is None and thin is not None:
            raise PydanticCustomError(
                "two_viscosities", "give both kinematic_viscosity_40_mm2_per_s and kinematic_viscosity_100_mm2_per_s"
            )
        if self.viscosity_index is not None and not self.by_sheet:
            raise PydanticCustomError(
                "two_viscosities",
                "viscosity_index is given without a viscosity; give kinematic_viscosity_40_mm2_per_s or iso_vg as well",
            )
        return self

    def sheet(self) -> OilSheet | None:
        """Return the oil that the grade or data sheet describes, or None if neither is given.

        Raises InvalidInput (`viscosity_order`, `viscosity_index`) if no oil can have the given viscosities.
        """
        index, kind, density = self.viscosity_index, self.kind, self.density_15_kg_per_m3
        if self.iso_vg is not None:
            return iso_vg(self.iso_vg, kind, index, density)
        if self.kinematic_viscosity_40_mm2_per_s is None:
            return None
        if self.kinematic_viscosity_100_mm2_per_s is None:
            return sheet_of_index(self.kinematic_viscosity_40_mm2_per_s * SQUARE_MILLIMETRE, index, kind, density)
        return self.si(OilSheet)

    def stands_for_null(self, name: str) -> Any:
        """Return the value that the calculation uses if the field `name` is null.

        The grade or data sheet determines the viscosity at 100 °C and the density at 15 °C. Return None for any other
        field, or if neither a grade nor a data sheet is given.
        """
        sheet = self.sheet()
        if sheet and name == "kinematic_viscosity_100_mm2_per_s":
            return sheet.kinematic_viscosity_100 / SQUARE_MILLIMETRE
        return sheet.reference_density if sheet and name == "density_15_kg_per_m3" else None

    def unused(self) -> dict[str, bool]:
        of_a_sheet = ("kinematic_viscosity_100_mm2_per_s", "viscosity_index", "density_15_kg_per_m3")
        by_index = {"kinematic_viscosity_100_mm2_per_s": self.viscosity_index is not None}
        return by_index if self.by_sheet else dict.fromkeys(of_a_sheet, True)


OF_A_NAME = (
    "kinematic_viscosity_40_mm2_per_s",
    "kinematic_viscosity_100_mm2_per_s",
    "kind",
    "density_15_kg_per_m3",
)
"""The fields that follow from the name of an oil; `NamedOil` has the same names."""


def from_sheet(oil: NamedOil) -> str:
    """Say from which data sheet a value comes."""
    return f"from the data sheet of {oil.name}: {oil.source}, read {oil.read}"


class Oil(SheetOil, of=Lubricant):
    """The oil of a lubricated contact, described by its name, its grade, its data sheet or its viscosity.

    If none of the four is given, the calculation has no oil.
    """

    exclusive: ClassVar = (
        *SheetOil.exclusive,
        ("reference_temperature_c", "iso_vg", "kinematic_viscosity_40_mm2_per_s"),
        ("pressure_viscosity_per_gpa", "pressure_viscosity_38_per_gpa"),
    )

    viscosity_pa_s: Annotated[
        float | None,
        Input.of(
            Lubricant,
            "viscosity",
            ge=1e-5,
            le=100,
            default_text="by name, grade or data sheet; with none of them no oil is known",
        ),
    ] = None
    reference_temperature_c: Annotated[
        float | None,
        Input.of(
            Lubricant,
            "reference_temperature",
            ge=-50,
            le=300,
            default_text="with grade or data sheet, where the oil enters the contact",
        ),
    ] = 86.85
    pressure_viscosity_per_gpa: Annotated[
        float | None, _of_a_sheet("pressure_viscosity", 1, 60, "by kind and viscosity (Gold, secondary source)")
    ] = 21.9
    pressure_viscosity_38_per_gpa: Annotated[float | None, Input.of(OilSheet, "pressure_viscosity_38")] = None
    temperature_viscosity_per_k: Annotated[
        float | None, _of_a_sheet("temperature_viscosity", 0, 0.2, "the slope of the Walther law")
    ] = _PAPERS.temperature_viscosity
    density_kg_per_m3: Annotated[
        float | None,
        Input.of(
            Lubricant, "density", ge=100, le=5000, default_text="with grade or data sheet, from the density at 15 °C"
        ),
    ] = _PAPERS.density
    specific_heat_j_per_kg_k: Annotated[float | None, _of_a_sheet("specific_heat", 100, 10000, "by kind", RARELY)] = (
        _PAPERS.specific_heat
    )
    thermal_conductivity_w_per_m_k: Annotated[
        float | None, _of_a_sheet("thermal_conductivity", 0.01, 10, "by kind", RARELY)
    ] = _PAPERS.thermal_conductivity

    @model_validator(mode="before")
    @classmethod
    def properties_follow_the_sheet(cls, given: Any) -> Any:
        """Use null as the default of the oil's properties, so that they follow from the grade or data sheet."""
        if not isinstance(given, dict) or (given.get("viscosity_pa_s") is not None and not _names_a_sheet(given)):
            return given
        return dict.fromkeys(_WITH_VISCOSITY) | given

    @model_validator(mode="after")
    def one_reference(self) -> Self:
        """Refuse a reference temperature beside a name, and a density together with a grade or data sheet."""
        if self.name is not None and self.reference_temperature_c is not None:
            raise PydanticCustomError("exclusive", "name and reference_temperature_c are both given; keep one")
        if self.by_sheet and self.density_kg_per_m3 is not None:
            raise PydanticCustomError(
                "exclusive",
                "density_kg_per_m3 is given, but the grade or data sheet of the oil already determines the "
                "density; give only one of the two",
            )
        missing = [name for name in _WITH_VISCOSITY if getattr(self, name) is None]
        if self.viscosity_pa_s is not None and missing:
            raise PydanticCustomError(
                "missing_property", "give {name}, or describe the oil by its grade or data sheet", {"name": missing[0]}
            )
        return self

    def resolve(self) -> OilSheet | Lubricant | None:
        """Return the solver's oil, or None if the request describes no oil. Raises the errors of `sheet`."""
        sheet, properties = self.sheet(), self.filling(Lubricant, kind=self.kind)
        if sheet is not None:
            beyond = (field.name for field in fields(OilSheet) if field.name in properties)
            at_38 = self.filling(OilSheet)["pressure_viscosity_38"]
            return replace(sheet, pressure_viscosity_38=at_38, **{name: properties[name] for name in beyond})
        return None if self.viscosity_pa_s is None else Lubricant(**properties)

    @property
    def known(self) -> bool:
        """Whether an oil is given."""
        return self.by_sheet or self.viscosity_pa_s is not None

    def unused(self) -> dict[str, bool]:
        of_one_temperature = dict.fromkeys(("reference_temperature_c", "density_kg_per_m3"), self.by_sheet)
        at_38 = self.by_sheet and self.pressure_viscosity_38_per_gpa is not None
        replaced = {"pressure_viscosity_per_gpa": at_38, "pressure_viscosity_38_per_gpa": not self.by_sheet}
        return super().unused() | of_one_temperature | replaced


_WITH_VISCOSITY = [name for name, field in Oil.model_fields.items() if isinstance(field.default, float)]


class CouplingLubricant(SheetOil):
    """The oil at the teeth of the coupling."""

    viscosity_pa_s: Annotated[
        float | None,
        Input.of(OilAtTeeth, "viscosity", default_text="by grade or data sheet", assumed="ISO VG 46 near 50 °C"),
    ] = OilAtTeeth().viscosity
    temperature_c: Annotated[
        float,
        Input.of(
            OilAtTeeth,
            "temperature",
            default=50.0,
            text="temperature at which the viscosity is taken from grade or data sheet",
            assumed="50 °C",
        ),
    ] = 50.0
    reference_film_um: Annotated[float, Input.of(OilAtTeeth, "reference_film")] = 1.0

    @model_validator(mode="before")
    @classmethod
    def viscosity_follows_the_sheet(cls, given: Any) -> Any:
        """Drop the default viscosity if a grade or data sheet is given."""
        return {"viscosity_pa_s": None} | given if isinstance(given, dict) and _names_a_sheet(given) else given

    @model_validator(mode="after")
    def some_viscosity(self) -> Self:
        """Refuse an oil for which neither a viscosity nor a grade nor a data sheet is given."""
        if not self.by_sheet and self.viscosity_pa_s is None:
            raise PydanticCustomError(
                "missing_property", "give viscosity_pa_s, or describe the oil by its grade or data sheet"
            )
        return self

    def at_teeth(self) -> OilAtTeeth:
        """Return the solver's oil. A grade or data sheet takes precedence over a given viscosity."""
        sheet = self.sheet()
        if sheet is None:
            return self.si(OilAtTeeth, temperature=None)
        viscosity = sheet.viscosity(UNITS["c"].to_si(self.temperature_c))
        return self.si(OilAtTeeth, viscosity=viscosity, viscosity_index=sheet.viscosity_index)

    def unused(self) -> dict[str, bool]:
        of_a_sheet = () if self.by_sheet else (*SheetOil.model_fields, "temperature_c")
        return super().unused() | dict.fromkeys(of_a_sheet, True) | {"viscosity_pa_s": self.by_sheet}
