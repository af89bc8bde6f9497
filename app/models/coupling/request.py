"""Requests of /v1/coupling, /v1/coupling/sleeve-orbit and /v1/coupling/recommendation."""

from typing import Annotated, Any, ClassVar

from pydantic import Field

from app.models.sections.oil import CouplingLubricant
from app.schema.model import Request, Section
from app.schema.quantities import Input
from solvers.coupling import inputs as si
from solvers.quantity import UNITS
from solvers.sources import PAHL


class CouplingDesign(Section, of=si.Coupling, without=("crowning_ratio",)):
    """The coupling without its crowning."""

    face_width_mm: float | None
    tooth_height_mm: float | None
    tooth_stiffness_n_per_um: float | None

    def stands_for_null(self, name: str) -> Any:
        """Return the value that the calculation uses if the field `name` is null.

        This value is known only for the tooth stiffness, which follows from the material. Return None for any other
        field.
        """
        return self.si(si.Coupling).tooth_stiffness * 1e-6 if name == "tooth_stiffness_n_per_um" else None


class CrownedCoupling(CouplingDesign, of=si.Coupling):
    """The coupling with its crowning."""


class CouplingLoad(Section, of=si.Operation, without=("misalignment",)):
    """Torque, speed and arrangement of the coupling."""


class CouplingOperation(CouplingLoad):
    """The operating point. Either the tilt or the parallel offset of the shafts is given."""

    exclusive: ClassVar = (("misalignment_deg", "parallel_offset_mm"),)
    choice_missing: ClassVar = "misalignment_or_offset"

    misalignment_deg: Annotated[
        float | None, Input.of(si.Operation, "misalignment", default_text="by the parallel offset")
    ] = None
    parallel_offset_mm: Annotated[
        float | None,
        Input(
            "parallel offset of the shafts",
            "e",
            text="instead of the tilt, which is atan(offset over hub distance)",
            unit="mm",
            ge=-1000,
            le=1000,
            tolerance=0.05,
        ),
    ] = None

    def operation(self, hub_distance: float) -> si.Operation:
        """Return the solver's operating point; `hub_distance` [m] is the distance between the two tooth planes."""
        if self.parallel_offset_mm is None:
            return self.si(si.Operation)
        offset = UNITS["mm"].to_si(self.parallel_offset_mm)
        return self.si(si.Operation, misalignment=si.tilt_of_offset(offset, hub_distance))


class CouplingOperationRange(CouplingLoad):
    """The operating point, with a range of misalignment instead of a single tilt."""

    misalignment_range_deg: Annotated[
        list[float],
        Field(min_length=2, max_length=2),
        Input(
            "range of misalignment",
            "δ_HS",
            PAHL,
            text="smallest and largest tilt of hub in sleeve",
            unit="deg",
            ge=1e-4,
            le=6,
            index="smallest, largest",
        ),
    ]


class CouplingFriction(Section, of=si.Friction):
    """Friction between the teeth."""

    def unused(self) -> dict[str, bool]:
        given = self.coefficient is not None
        return {"static_coefficient": given, "mixed_curve": given or self.mixed_law is not None}


class CouplingModel(Section, of=si.ModelOptions):
    """Choices in the coupling model. The paper leaves these choices open."""


class _CouplingRequest(Request):
    """The parts that the requests of all three coupling calculations have in common."""

    coupling: Annotated[CouplingDesign, Input("coupling")]
    operation: Annotated[CouplingLoad, Input("operating point")]
    lubricant: Annotated[CouplingLubricant, Input("oil at the teeth")] = CouplingLubricant()
    friction: Annotated[CouplingFriction, Input("friction between the teeth")] = CouplingFriction()
    model: Annotated[
        CouplingModel, Input("model", text="options where the paper leaves the model open", advanced=True)
    ] = CouplingModel()

    def unused(self) -> dict[str, bool]:
        arrangement, offset = self.operation.arrangement, getattr(self.operation, "parallel_offset_mm", None)
        return {
            "model.inlet": self.model.inlet_length_mm is not None,
            "coupling.hub_distance_mm": arrangement == "single" and offset is None,
            "model.simple_thrust_factor": arrangement != "parallel_offset",
        }

    def _design(self, operation: si.Operation) -> si.CouplingInputs:
        return self.si(si.CouplingInputs, operation=operation, lubricant=self.lubricant.at_teeth())


class CouplingRequest(_CouplingRequest):
    """A gear coupling at one operating point."""

    coupling: Annotated[CrownedCoupling, Input("coupling")]
    operation: Annotated[CouplingOperation, Input("operating point")]

    def inputs(self) -> si.CouplingInputs:
        return self._design(self.operation.operation(self.coupling.si(si.Coupling).hub_distance))


class SleeveOrbitRequest(CouplingRequest):
    """A gear coupling whose floating sleeve is followed over one revolution.

    The calculation models the teeth as springs and the sleeve as a mass. The request may give oil, friction and the
    shape of the contact, but the calculation does not use them.
    """

    def options(self) -> dict[str, Any]:
        """Return the options that the calculation uses: the chosen kinematics, and always a floating sleeve."""
        return {"kinematics": self.model.kinematics, "sleeve": "floating"}

    def unused(self) -> dict[str, bool]:
        contact = ("face_width_mm", "tooth_height_mm", "poisson_ratio", "hub_distance_mm")
        unused = dict.fromkeys(("lubricant", "friction", "model", *(f"coupling.{name}" for name in contact)), True)
        return unused | {"coupling.youngs_modulus_gpa": self.coupling.tooth_stiffness_n_per_um is not None}


class RecommendationRequest(_CouplingRequest):
    """A gear coupling for which the best crowning is sought."""

    coupling: Annotated[CouplingDesign, Input("coupling", text="the coupling without its crowning")]
    operation: Annotated[CouplingOperationRange, Input("operating point", text="with a range of misalignment")]

    def unused(self) -> dict[str, bool]:
        return super().unused() | {"model.simple_thrust_factor": True, "friction.static_coefficient": True}

    def inputs(self) -> si.RecommendationInputs:
        smallest, largest = map(UNITS["deg"].to_si, self.operation.misalignment_range_deg)
        design = self._design(self.operation.si(si.Operation, misalignment=smallest))
        return si.RecommendationInputs(design, min_misalignment=smallest, max_misalignment=largest)
