"""A gear coupling's own data: teeth, operating point and oil."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Section
from app.requests.oil import SheetOil, names_a_sheet
from solvers.coupling import inputs as si
from solvers.coupling.geometry import offset_misalignment

PAHL = "Pahl 1978"
FIG_8 = "Pahl 1978, Fig. 8"
FIG_13 = "Pahl 1978, Fig. 13"


class CouplingDesign(Section):
    """The coupling without its crowning."""

    teeth: Annotated[int, Input("number of teeth", "z", PAHL, ge=6, le=400)]
    module_mm: Annotated[float, Input("module", "m", PAHL, ge=0.1, le=100)]
    pressure_angle_deg: Annotated[
        float, Input("pressure angle", "α", ge=1, lt=45, assumed="the usual rack; the paper gives none")
    ] = 20.0
    face_width_mm: Annotated[
        float | None,
        Input(
            "hub tooth face width",
            "b",
            ge=0.1,
            le=2000,
            default_text="8 modules",
            assumed="8 modules; the paper gives none",
            tolerance=0.1,
        ),
    ] = None
    tooth_height_mm: Annotated[
        float | None,
        Input(
            "load-carrying tooth height",
            "h_trag",
            FIG_8,
            text="load-carrying tooth height, the length of the contact line",
            ge=0.05,
            le=200,
            default_text="2 modules",
            assumed="2 modules; the paper gives none",
            tolerance=0.05,
        ),
    ] = None
    hub_distance_mm: Annotated[
        float,
        Input(
            "distance of the tooth planes",
            "l_H",
            FIG_13,
            text="distance of the two tooth planes",
            ge=1,
            le=20000,
            assumed="order of magnitude",
            tolerance=0.5,
        ),
    ] = 200.0
    tooth_stiffness_n_per_um: Annotated[
        float,
        Input(
            "tooth pair stiffness",
            "c_t",
            text="tangential stiffness of one tooth pair",
            ge=0.1,
            le=1e5,
            assumed="order of magnitude of ISO 6336-1: 14 N/(mm µm) over 20 mm of effective width",
        ),
    ] = 280.0
    sleeve_mass_kg: Annotated[
        float,
        Input(
            "sleeve mass per mesh",
            "m_s",
            text="mass carried by one mesh, half the sleeve",
            ge=1e-3,
            le=1e4,
            assumed="order of magnitude",
        ),
    ] = 4.0
    pitch_errors_um: Annotated[
        list[float] | None,
        Field(min_length=1, max_length=1000),
        Input(
            "pitch errors",
            "p_i",
            "Pahl 1978, Fig. 4",
            text="pitch errors, one per tooth, positive = early, carries more",
            ge=-1e4,
            le=1e4,
            default_text="none",
        ),
    ] = None
    youngs_modulus_gpa: Annotated[float, Input("Young's modulus of the teeth", "E", ge=1, le=2000, assumed="steel")] = (
        206.0
    )
    poisson_ratio: Annotated[float, Input("Poisson's ratio of the teeth", "ν", ge=0, lt=0.5, assumed="steel")] = 0.3


class CrownedCoupling(CouplingDesign):
    """The coupling."""

    crowning_ratio: Annotated[
        float,
        Input("crowning ratio", "ε", PAHL, text="crowning radius over pitch radius, 1: heavy", ge=0.2, le=1e3),
    ] = 1.0


class CouplingLoad(Section):
    """Torque, speed and arrangement."""

    torque_n_m: Annotated[float, Input("transmitted torque", "T", PAHL, ge=0, le=1e8)]
    speed_rpm: Annotated[
        float, Input("speed", "n", PAHL, text="speed; the sign is the sense of rotation", ge=-1e5, le=1e5)
    ]
    axial_velocity_mm_per_s: Annotated[
        float,
        Input(
            "axial velocity",
            "v_ax",
            PAHL,
            text="axial speed hub against sleeve at each mesh; positive: shafts move apart",
            ge=-1e4,
            le=1e4,
        ),
    ] = 0.0
    arrangement: Annotated[
        si.Arrangement,
        Input("arrangement", None, FIG_13, text="one mesh; two with parallel offset (Z); two with an angle (M)"),
    ] = "single"
    shaft_diameter_mm: Annotated[
        float | None,
        Input(
            "shaft diameter",
            "D",
            "API 671/617 practice, from memory",
            text="of the customary thrust 0.25 T/D",
            ge=1,
            le=2000,
            default_text="no customary thrust",
        ),
    ] = None


class CouplingOperation(CouplingLoad):
    """Operating point; the tilt is given, or follows from the shafts' offset."""

    exclusive: ClassVar = (("misalignment_deg", "parallel_offset_mm"),)

    misalignment_deg: Annotated[
        float | None,
        Input(
            "misalignment",
            "δ_HS",
            PAHL,
            text="tilt of hub against sleeve at one mesh",
            ge=-6,
            le=6,
            tolerance=0.005,
            default_text="by the parallel offset",
        ),
    ] = None
    parallel_offset_mm: Annotated[
        float | None,
        Input(
            "parallel offset of the shafts",
            "e",
            text="instead of the tilt, which is atan(offset over hub distance)",
            ge=-1000,
            le=1000,
            tolerance=0.05,
        ),
    ] = None

    @model_validator(mode="after")
    def tilt_or_offset(self) -> Self:
        """Refuse both and neither."""
        if self.misalignment_deg is None and self.parallel_offset_mm is None:
            raise PydanticCustomError("misalignment_or_offset", "give misalignment_deg or parallel_offset_mm")
        if self.misalignment_deg is not None and self.parallel_offset_mm is not None:
            raise PydanticCustomError("exclusive", "misalignment_deg and parallel_offset_mm are both given; keep one")
        return self

    def operation(self, hub_distance: float) -> dict[str, Any]:
        """The solver's operating point; hub_distance [m]."""
        fields = to_si(self)
        offset = fields.pop("parallel_offset")
        if offset is not None:
            fields["misalignment"] = offset_misalignment(offset, hub_distance)
        return fields


class CouplingOperationRange(CouplingLoad):
    """Operating point with a range of misalignment."""

    misalignment_range_deg: Annotated[
        list[float],
        Field(min_length=2, max_length=2),
        Input("range of misalignment", "δ_HS", PAHL, text="smallest and largest tilt of hub in sleeve", ge=1e-4, le=6),
    ]


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
