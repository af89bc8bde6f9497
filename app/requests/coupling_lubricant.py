"""The oil at the teeth of a gear coupling."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.requests.sheet_oil import SheetOil, names_a_sheet
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.coupling import inputs as si

FIG_8 = "Pahl 1978, Fig. 8"


class CouplingLubricant(SheetOil):
    """Oil at the teeth."""

    exclusive: ClassVar = (("viscosity_pa_s", "iso_vg", "kinematic_viscosity_40_mm2_per_s"),)

    viscosity_pa_s: Annotated[
        float | None,
        Input(
            "oil viscosity at the teeth",
            "η",
            FIG_8,
            ge=1e-5,
            le=100,
            default_text="by grade or data sheet",
            assumed="ISO VG 46 near 50 °C",
        ),
    ] = si.Lubricant().viscosity
    temperature_c: Annotated[
        float,
        Input(
            "oil temperature at the teeth",
            "θ_oil",
            text="at which grade or data sheet tell the viscosity",
            ge=-50,
            le=300,
            tolerance=5,
            assumed="50 °C",
        ),
    ] = 50.0
    reference_film_um: Annotated[
        float,
        Input(
            "reference film thickness",
            "h_0",
            FIG_8,
            text="film thickness at which the load capacity is stated",
            ge=1e-3,
            le=1000,
        ),
    ] = 1.0

    @model_validator(mode="before")
    @classmethod
    def viscosity_follows_the_sheet(cls, given: Any) -> Any:
        """With grade or data sheet the default viscosity is left out."""
        return {"viscosity_pa_s": None} | given if names_a_sheet(given) else given

    @model_validator(mode="after")
    def one_viscosity(self) -> Self:
        """Refuse both and neither."""
        if self.by_sheet and self.viscosity_pa_s is not None:
            raise PydanticCustomError("exclusive", "viscosity_pa_s and a grade or data sheet are both given; keep one")
        if not self.by_sheet and self.viscosity_pa_s is None:
            raise PydanticCustomError("missing_property", "give viscosity_pa_s, or the oil by its grade or data sheet")
        return self

    def lubricant(self) -> si.Lubricant:
        """The solver's lubricant."""
        fields = to_si(self)
        viscosity = self.sheet().viscosity(fields["temperature"]) if self.by_sheet else fields["viscosity"]
        return si.Lubricant(viscosity, fields["reference_film"])

    def unused_defaults(self, section: str) -> frozenset[str]:
        """What this way of giving the oil leaves out of a result."""
        own = "viscosity_pa_s" if self.by_sheet else "temperature_c"
        return self.unused_sheet_defaults(section) | {f"{section}.{own}"}
