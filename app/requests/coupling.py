"""Gear couplings: requests of /v1/coupling and its two companions."""

from typing import Annotated, Any

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Request, Section
from app.requests.coupling_design import FIG_8, FIG_13, PAHL, CouplingDesign, CrownedCoupling
from app.requests.coupling_friction import CouplingFriction
from app.requests.coupling_lubricant import CouplingLubricant
from app.requests.coupling_operation import CouplingLoad, CouplingOperation, CouplingOperationRange
from solvers.coupling import inputs as si

_DEFAULTS = si.ModelOptions()


class CouplingModel(Section):
    """Choices where the paper leaves room."""

    kinematics: Annotated[
        si.KinematicModel,
        Input(
            "kinematics of the teeth",
            None,
            PAHL,
            text="tangential: as the paper describes; spatial: exact to first order, with the pivot motion",
            advanced=True,
        ),
    ] = _DEFAULTS.kinematics
    sleeve: Annotated[
        si.SleeveSupport,
        Input(
            "support of the sleeve",
            text="whether the sleeve of the single mesh is centred or finds its place",
            advanced=True,
        ),
    ] = _DEFAULTS.sleeve
    inlet: Annotated[
        si.InletModel,
        Input(
            "limit of the oil inlet",
            "b_Ix",
            FIG_8,
            text="what limits the oil inlet: the face left ahead of the contact, the contact's travel, nothing",
            assumed="the paper does not define the inlet length",
            advanced=True,
        ),
    ] = _DEFAULTS.inlet
    inlet_length_mm: Annotated[
        float | None,
        Input(
            "inlet length",
            "b_Ix",
            text="inlet length instead of `inlet`",
            ge=1e-3,
            le=2000,
            default_text="by the limit of the oil inlet",
            advanced=True,
        ),
    ] = None
    film_angle_deg: Annotated[
        float | None,
        Input(
            "tooth angle of the film",
            "φ",
            FIG_8,
            text="tooth angle whose hydrodynamic velocity builds the film, 90 at the tilt position",
            ge=-360,
            le=360,
            tolerance=1,
            default_text="that of the largest hydrodynamic velocity",
            assumed="the largest hydrodynamic velocity of a revolution; the paper does not say which it takes",
            advanced=True,
        ),
    ] = None
    rotor_angle_deg: Annotated[
        float, Input("rotor angle of the tooth forces", "θ", ge=-360, le=360, tolerance=0.1, advanced=True)
    ] = _DEFAULTS.rotor_angle
    simple_thrust_factor: Annotated[
        float,
        Input(
            "share of the sleeve force in the one-pair model",
            "κ",
            FIG_13,
            text="share of the sleeve force that the one-pair model of self-induced thrust turns into tooth forces",
            ge=0,
            le=10,
            tolerance=0.1,
            assumed="all of it; the paper does not state the share",
            advanced=True,
        ),
    ] = _DEFAULTS.simple_thrust_factor


class _CouplingRequest(Request):
    """What the three coupling calculations have in common."""

    coupling: Annotated[CouplingDesign, Input("coupling")]
    operation: Annotated[CouplingLoad, Input("operating point")]
    lubricant: Annotated[CouplingLubricant, Input("oil at the teeth")] = CouplingLubricant()
    friction: Annotated[CouplingFriction, Input("friction between the teeth")] = CouplingFriction()
    model: Annotated[CouplingModel, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        CouplingModel()
    )

    def options(self) -> dict[str, Any]:
        """The model section."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """What given values replace, and what the arrangement does without."""
        unused = {*self.friction.unused_friction_defaults("friction"), *self.lubricant.unused_defaults("lubricant")}
        if self.model.inlet_length_mm is not None:
            unused.add("model.inlet")
        offset = getattr(self.operation, "parallel_offset_mm", None)
        if self.operation.arrangement == "single" and offset is None:
            unused.add("coupling.hub_distance_mm")
        if self.operation.arrangement != "parallel_offset":
            unused.add("model.simple_thrust_factor")
        return frozenset(unused)

    def _design(self, coupling: dict[str, Any], operation: dict[str, Any]) -> si.CouplingInputs:
        return si.CouplingInputs(
            coupling=si.proportioned(**coupling),
            operation=si.Operation(**operation),
            lubricant=self.lubricant.lubricant(),
            friction=self.friction.friction(),
            model=si.ModelOptions(**to_si(self.model)),
        )


class CouplingRequest(_CouplingRequest):
    """A gear coupling at one operating point."""

    coupling: Annotated[CrownedCoupling, Input("coupling")]
    operation: Annotated[CouplingOperation, Input("operating point")]

    def inputs(self) -> si.CouplingInputs:
        """The solver's inputs."""
        coupling = to_si(self.coupling)
        return self._design(coupling, self.operation.operation(coupling["hub_distance"]))


class SleeveOrbitRequest(CouplingRequest):
    """A gear coupling whose floating sleeve is followed over one revolution.

    Its motion is one of tooth springs and sleeve mass: oil, friction and the contact's shape are accepted, not used.
    """

    def options(self) -> dict[str, Any]:
        """The kinematics; the sleeve always floats."""
        return {"kinematics": self.model.kinematics, "sleeve": "floating"}

    def unused_defaults(self) -> frozenset[str]:
        """All that belongs to contact, film, friction and a second mesh."""
        contact = {"face_width_mm", "tooth_height_mm", "youngs_modulus_gpa", "poisson_ratio", "hub_distance_mm"}
        return frozenset({"lubricant", "friction", "model", *(f"coupling.{name}" for name in contact)})


class RecommendationRequest(_CouplingRequest):
    """A gear coupling whose crowning is sought."""

    coupling: Annotated[CouplingDesign, Input("coupling", text="the coupling without its crowning")]
    operation: Annotated[CouplingOperationRange, Input("operating point", text="with a range of misalignment")]

    def unused_defaults(self) -> frozenset[str]:
        """Also what only a result at one operating point shows: the one-pair model of thrust, breakaway."""
        return super().unused_defaults() | {"model.simple_thrust_factor", "friction.static_coefficient"}

    def inputs(self) -> si.RecommendationInputs:
        """The solver's inputs."""
        operation = to_si(self.operation)
        smallest, largest = operation.pop("misalignment_range")
        design = self._design(to_si(self.coupling), {**operation, "misalignment": smallest})
        return si.RecommendationInputs(design, min_misalignment=smallest, max_misalignment=largest)
