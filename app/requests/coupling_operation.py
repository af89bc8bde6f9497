"""Operating point of a gear coupling: torque, speed, tilt and arrangement."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Section
from app.requests.coupling_design import FIG_13, PAHL
from solvers.coupling import inputs as si
from solvers.coupling.teeth.geometry import offset_misalignment


class CouplingLoad(Section):
    """Torque, speed and arrangement."""

    torque_n_m: Annotated[
        float, Input("transmitted torque", "T", PAHL, ge=0, le=1e8, tolerance=1, relative_tolerance=0.01)
    ]
    speed_rpm: Annotated[
        float,
        Input(
            "speed",
            "n",
            PAHL,
            text="speed; the sign is the sense of rotation",
            ge=-1e5,
            le=1e5,
            tolerance=1,
            relative_tolerance=0.01,
        ),
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
            tolerance=0.1,
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
