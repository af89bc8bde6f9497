"""Oils: by grade, by data sheet, or by the viscosity where they enter."""

from typing import Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.schema.model import Derived, Section
from solvers.coupling.inputs import CouplingOil
from solvers.lubricants import Lubricant, OilInUse
from solvers.oils import SQUARE_MILLIMETRE, OilBySheet, OilChoice, iso_vg

_BY_SHEET = ("iso_vg", "kinematic_viscosity_40_mm2_per_s", "kinematic_viscosity_100_mm2_per_s")


def names_a_sheet(given: Any) -> bool:
    """Whether what was sent for an oil names a grade or a kinematic viscosity."""
    return isinstance(given, dict) and any(given.get(name) is not None for name in _BY_SHEET)


class SheetOil(Section, of=OilBySheet):
    """An oil by its ISO grade or by two kinematic viscosities, where that is what is known of it."""

    @property
    def by_sheet(self) -> bool:
        """Whether the oil is given by grade or data sheet."""
        return any(getattr(self, name) is not None for name in _BY_SHEET)

    @model_validator(mode="after")
    def one_way(self) -> Self:
        """A grade, or both viscosities."""
        given = [getattr(self, name) is not None for name in _BY_SHEET[1:]]
        if self.iso_vg is not None and any(given):
            raise PydanticCustomError("exclusive", "iso_vg and kinematic viscosities are both given; keep one")
        if any(given) and not all(given):
            raise PydanticCustomError(
                "two_viscosities", "give both kinematic_viscosity_40_mm2_per_s and kinematic_viscosity_100_mm2_per_s"
            )
        return self

    def stands_for_null(self, name: str) -> Any:
        """The typical viscosity of a grade, the density of a kind of oil."""
        if name == "kinematic_viscosity_100_mm2_per_s" and self.iso_vg is not None:
            return iso_vg(self.iso_vg).kinematic_viscosity_100 / SQUARE_MILLIMETRE
        sheet = self.si(OilBySheet).sheet()
        return sheet.reference_density if sheet and name == "density_15_kg_per_m3" else None

    def unused(self) -> set[str]:
        """All of the sheet where the oil is given otherwise; the default that belongs to a grade."""
        if not self.by_sheet:
            return set(SheetOil.model_fields)
        return {"kinematic_viscosity_100_mm2_per_s"} if self.iso_vg is None else set()


_PAPERS = Lubricant()


class Oil(SheetOil, of=OilChoice):
    """The oil of a lubricated contact: by grade, by data sheet or by its viscosity; nothing names none."""

    exclusive: ClassVar = (
        ("iso_vg", "viscosity_pa_s", "kinematic_viscosity_40_mm2_per_s"),
        ("reference_temperature_c", "iso_vg", "kinematic_viscosity_40_mm2_per_s"),
    )

    reference_temperature_c: float | None = 86.85
    pressure_viscosity_per_gpa: float | None = 21.9
    temperature_viscosity_per_k: float | None = _PAPERS.temperature_viscosity
    density_kg_per_m3: float | None = _PAPERS.density
    specific_heat_j_per_kg_k: float | None = _PAPERS.specific_heat
    thermal_conductivity_w_per_m_k: float | None = _PAPERS.thermal_conductivity

    @model_validator(mode="before")
    @classmethod
    def properties_follow_the_sheet(cls, given: Any) -> Any:
        """Properties have defaults of their own only with a viscosity; otherwise they follow from the sheet, if any."""
        if not isinstance(given, dict) or (given.get("viscosity_pa_s") is not None and not names_a_sheet(given)):
            return given
        return dict.fromkeys(_WITH_VISCOSITY) | given

    @model_validator(mode="after")
    def one_reference(self) -> Self:
        """The density belongs to a viscosity, with which no property may be null."""
        if self.by_sheet:
            if self.density_kg_per_m3 is not None:
                raise PydanticCustomError(
                    "exclusive", "density_kg_per_m3 and a grade or data sheet are both given; keep one"
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

    def unused(self) -> set[str]:
        """What this way of giving the oil leaves out of a result; whether its kind counts is the request's to say."""
        if not self.known:
            return set(type(self).model_fields)
        if self.by_sheet:
            return super().unused() | {"reference_temperature_c", "density_kg_per_m3"}
        return super().unused() - {"kind"}


_WITH_VISCOSITY = tuple(
    name
    for name, field in Oil.model_fields.items()
    if name not in SheetOil.model_fields and field.default is not None and not isinstance(field.default, bool | str)
)


class CouplingLubricant(SheetOil, of=CouplingOil):
    """Oil at the teeth."""

    exclusive: ClassVar = (("iso_vg", "viscosity_pa_s", "kinematic_viscosity_40_mm2_per_s"),)

    @model_validator(mode="before")
    @classmethod
    def viscosity_follows_the_sheet(cls, given: Any) -> Any:
        """With grade or data sheet the default viscosity is left out."""
        return {"viscosity_pa_s": None} | given if names_a_sheet(given) else given

    @model_validator(mode="after")
    def some_viscosity(self) -> Self:
        """Refuse an oil of which nothing says how viscous it is."""
        if not self.by_sheet and self.viscosity_pa_s is None:
            raise PydanticCustomError("missing_property", "give viscosity_pa_s, or the oil by its grade or data sheet")
        return self

    def unused(self) -> set[str]:
        """What this way of giving the oil leaves out of a result."""
        return super().unused() | {"viscosity_pa_s" if self.by_sheet else "temperature_c"}


class OilDerived(Derived, of=OilInUse):
    """Properties of the oil at its reference temperature, given or by grade and data sheet; null without an oil."""
