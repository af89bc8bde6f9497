"""Requests and answers of /v1/coupling, /v1/coupling/sleeve-orbit and /v1/coupling/recommendation."""

from typing import Annotated, Any, ClassVar

from pydantic import Field

from app.schema.model import Derived, Group, Request, Response, Section
from app.schema.oil import CouplingLubricant
from app.schema.quantities import Input, Output, View
from solvers.coupling import crowning, results
from solvers.coupling import inputs as si
from solvers.quantity import UNITS, quantities
from solvers.sources import PAHL

STIFFNESS = "tooth_stiffness_n_per_um"


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
        return self.si(si.Coupling).tooth_stiffness * 1e-6 if name == STIFFNESS else None


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
        ),
    ]


class MixedFrictionTable(Section, of=si.MixedFrictionTable):
    """Measured coefficients of mixed friction, in the order of increasing sliding velocity.

    Below the first velocity and above the last velocity, the coefficient is constant. A table with a single point means
    a constant coefficient.
    """


class MixedFrictionCurve(Section, of=si.MixedFrictionCurve):
    """A law of mixed friction. The law comes from this project and not from the paper.

    With increasing sliding velocity, the coefficient first falls to its lowest value and then rises again.
    """


class CouplingFriction(Section, of=si.Friction):
    """Friction between the teeth."""

    def unused(self) -> dict[str, bool]:
        """Mark the friction curve as unused if a coefficient or a table is given.

        If a coefficient is given, mark the coefficient at rest as unused too.
        """
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
    model: Annotated[CouplingModel, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        CouplingModel()
    )

    def unused(self) -> dict[str, bool]:
        """Mark inputs as unused if other inputs make them ineffective.

        If the inlet length is given, the choice of what limits the oil inlet is ineffective. In the arrangement
        `single`, the distance between the hubs is ineffective, unless a parallel offset is given. In arrangements other
        than `parallel_offset`, the factor of the simple thrust model is ineffective.
        """
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
        """Mark the inputs that do not affect the orbit of the sleeve as unused.

        These inputs describe the oil, the friction, the model, the contact and the second mesh. Young's modulus is
        also unused if the tooth stiffness is given.
        """
        contact = ("face_width_mm", "tooth_height_mm", "poisson_ratio", "hub_distance_mm")
        unused = dict.fromkeys(("lubricant", "friction", "model", *(f"coupling.{name}" for name in contact)), True)
        return unused | {"coupling.youngs_modulus_gpa": self.coupling.tooth_stiffness_n_per_um is not None}


class RecommendationRequest(_CouplingRequest):
    """A gear coupling for which the best crowning is sought."""

    coupling: Annotated[CouplingDesign, Input("coupling", text="the coupling without its crowning")]
    operation: Annotated[CouplingOperationRange, Input("operating point", text="with a range of misalignment")]

    def unused(self) -> dict[str, bool]:
        """Mark two inputs as unused in addition to the inputs that the base class marks.

        The two inputs are the factor of the simple thrust model and the coefficient of friction at rest. Only the
        calculation of a coupling at one operating point uses these two inputs.
        """
        return super().unused() | {"model.simple_thrust_factor": True, "friction.static_coefficient": True}

    def inputs(self) -> si.RecommendationInputs:
        smallest, largest = map(UNITS["deg"].to_si, self.operation.misalignment_range_deg)
        design = self._design(self.operation.si(si.Operation, misalignment=smallest))
        return si.RecommendationInputs(design, min_misalignment=smallest, max_misalignment=largest)


class CouplingGeometry(Group, of=results.Geometry):
    """Radii of the crowned tooth."""


class CouplingKinematicCurves(Group, of=results.KinematicCurves):
    """The motion of a tooth over one revolution. The tooth is in a tilt position at the angles 90° and 270°."""


class CouplingKinematics(Group, of=results.Kinematics):
    """Largest values of the motion of a tooth over one revolution."""

    views: ClassVar = {
        "max_sliding_velocity": View(headline=3, limit="limits.sliding_velocity_limit_m_per_s", bound="upper")
    }


class CouplingLoadCurves(Group, of=results.LoadCurves):
    """The tangential force of each tooth at the requested rotor angle."""


class CouplingLoadDistribution(Group, of=results.LoadDistribution):
    """The load on the teeth at the requested rotor angle, for the mesh in which the hub drives the sleeve."""


class FrictionRegime(Group, of=results.Regime):
    """An area of the paper's map of friction conditions, and the range of the coefficient of friction in this area.

    An end of the range is null if the paper does not state this end.
    """


class CouplingLubrication(Group, of=results.Lubrication):
    """Contact and film of the most heavily loaded tooth.

    Without pitch deviations, the teeth are compared at a rotor angle at which one tooth is in the tilt position. With
    pitch deviations, the teeth are compared at all rotor angles of a revolution.
    """

    views: ClassVar = {
        "hertz_pressure": View(limit=2000.0, bound="upper"),
        "contact_overlap": View(limit=1.0, bound="upper"),
        "load_capacity_coefficient": View(headline=2, limit=0.8, bound="lower", verdict=".regime.name"),
    }


class SelfInducedThrust(Group, of=results.SelfInducedThrust):
    """The axial thrust that two meshes cause even if the shafts do not move axially."""


class CouplingThrust(Group, of=results.AxialThrust):
    """Axial thrust, as a mean over one tooth pitch.

    If there are pitch deviations, the mean is taken over one revolution.
    """

    views: ClassVar = {
        "design_force": View(headline=1),
        "force": View(limit="axial_thrust.coaxial_limit_n", bound="upper"),
        "fraction_of_limit": View(limit=1.0),
    }


class CouplingLosses(Group, of=results.Losses):
    """Friction power and moments of the mesh in which the hub drives the sleeve."""


class CouplingLimits(Group, of=results.Limits):
    """Limits for the operation of the coupling, and the stiffnesses of one mesh."""

    views: ClassVar = {"allowable_misalignment": View(headline=4)}


class SleeveOrbit(Group, of=results.Orbit):
    """The path of the sleeve's centre over one revolution."""


class SleeveInertia(Group, of=results.InertiaForce):
    """Inertia force of the part of the sleeve's mass that is assigned to one mesh."""


class RecommendedPoint(Group, of=crowning.RecommendedPoint):
    """Results of the coupling with the recommended crowning at one end of the range of misalignment."""

    views: ClassVar = {
        "contact_overlap": View(limit=1.0, bound="upper"),
        "load_capacity_coefficient": View(limit=0.8, bound="lower"),
    }


class CrowningScan(Group, of=crowning.CrowningScan):
    """Curves over the crowning ratio.

    For each crowning ratio, the curves state the smallest load capacity and the largest contact overlap in the range of
    misalignment.
    """

    views: ClassVar = {"max_contact_overlap": View(limit=1.0)}


def _used(name: str, title: str) -> Output:
    """Declare an answer field that states which value the calculation used for an input of the coupling.

    `name` is the field of this input in the solver's `Coupling`.
    """
    declared = quantities(si.Coupling)[name]
    return Output(title, declared.symbol, unit=declared.unit, origin=(si.Coupling, name))


class ProportionsInForce(Group):
    """Face width, tooth height and tooth stiffness that the calculation uses for a coupling."""

    face_width_mm: Annotated[float, _used("face_width", "face width used")]
    tooth_height_mm: Annotated[float, _used("tooth_height", "tooth height used")]
    tooth_stiffness_n_per_um: Annotated[float, _used("tooth_stiffness", "tooth pair stiffness used")]


class CouplingProportions(ProportionsInForce, Derived):
    """Face width, tooth height and tooth stiffness that the calculation uses.

    If the request omits one of these values, the default of this value is used.
    """


class CouplingDerived(CouplingProportions, of=results.Derived):
    """Face width, tooth height, tooth stiffness and oil viscosity that the calculation uses.

    If the request omits one of these values, the default of this value is used.
    """


class CouplingResponse(Response, of=results.CouplingResult):
    """Results of a gear coupling at one operating point.

    If there is no solution, the sections with results are missing.
    """

    derived: CouplingDerived


class SleeveOrbitDerived(Derived, of=results.Geometry, only=("pitch_radius",)):
    """The pitch radius of the coupling."""


class SleeveOrbitResponse(Response, of=results.OrbitResult):
    """Path and inertia force of a floating sleeve over one revolution."""

    derived: SleeveOrbitDerived

    views: ClassVar = {"max_displacement": View(headline=1)}


class RecommendationResponse(Response, of=crowning.Recommendation):
    """The recommended crowning ratio for a range of misalignment.

    Of all permissible crowning ratios, the recommended ratio has the largest load capacity. The load capacity depends
    on the misalignment. For each ratio, the smallest load capacity in the range of misalignment counts.
    """

    derived: CouplingDerived

    views: ClassVar = {
        "feasible": View(headline=2),
        "crowning_ratio": View(headline=1),
        "min_load_capacity_coefficient": View(headline=3),
    }
