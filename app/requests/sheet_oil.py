"""Oils by grade or data sheet: the fields that every lubricated contact takes."""

from typing import Annotated, Any, Literal, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.schema.base import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.lubricants import OilKind
from solvers.oils import OilSheet, iso_vg
from solvers.viscosity_index import SQUARE_MILLIMETRE

IsoGrade = Literal[32, 46, 68, 100, 150, 220, 320, 460, 680]

_BY_SHEET = ("iso_vg", "kinematic_viscosity_40_mm2_per_s", "kinematic_viscosity_100_mm2_per_s")

BY_KIND = "by the kind of oil; a data sheet rarely gives it"


def names_a_sheet(given: Any) -> bool:
    """Whether what was sent for an oil names a grade or a kinematic viscosity."""
    return isinstance(given, dict) and any(given.get(name) is not None for name in _BY_SHEET)


class SheetOil(Section):
    """An oil by its ISO grade or by two kinematic viscosities, where that is what is known of it."""

    iso_vg: Annotated[IsoGrade | None, Input("ISO viscosity grade", "VG", "ISO 3448")] = None
    kinematic_viscosity_40_mm2_per_s: Annotated[
        float | None, Input("kinematic viscosity at 40 °C", "ν_40", "ASTM D341", ge=2, le=5000)
    ] = None
    kinematic_viscosity_100_mm2_per_s: Annotated[
        float | None,
        Input(
            "kinematic viscosity at 100 °C",
            "ν_100",
            "ASTM D341",
            ge=1,
            le=1000,
            default_text="with a grade, typical of a mineral oil of viscosity index 95",
            assumed="typical of a mineral oil with viscosity index 95",
        ),
    ] = None
    kind: Annotated[
        OilKind, Input("kind of oil", assumed="a mineral oil, where the data sheet's kind is not given")
    ] = "mineral"
    density_15_kg_per_m3: Annotated[
        float | None,
        Input("oil density at 15 °C", "ρ_15", ge=500, le=2000, default_text=BY_KIND, assumed=BY_KIND),
    ] = None

    @property
    def by_sheet(self) -> bool:
        """Whether the oil is given by grade or data sheet."""
        return any(getattr(self, name) is not None for name in _BY_SHEET)

    @model_validator(mode="after")
    def one_way(self) -> Self:
        """A grade, or both viscosities."""
        pair = [self.kinematic_viscosity_40_mm2_per_s, self.kinematic_viscosity_100_mm2_per_s]
        given = [value is not None for value in pair]
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
        return self.sheet().reference_density if name == "density_15_kg_per_m3" and self.by_sheet else None

    def sheet(self, **known: Any) -> OilSheet:
        """The solver's oil; `known` is what a user says beyond viscosity and density."""
        fields = to_si(self)
        thick, thin = fields["kinematic_viscosity_40"], fields["kinematic_viscosity_100"]
        if self.iso_vg is not None:
            graded = iso_vg(self.iso_vg)
            thick, thin = graded.kinematic_viscosity_40, graded.kinematic_viscosity_100
        return OilSheet(thick, thin, self.kind, fields["density_15"], **known)

    def unused_sheet_defaults(self, section: str) -> frozenset[str]:
        """What the sheet's fields leave out of a result, by dotted names below `section`."""
        if not self.by_sheet:
            return frozenset(f"{section}.{name}" for name in SheetOil.model_fields)
        both = self.iso_vg is None
        return frozenset({f"{section}.kinematic_viscosity_100_mm2_per_s"} if both else ())
