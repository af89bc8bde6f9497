"""The loaded gear pair: request of /v1/scuffing/load-distribution."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.requests.flank_modifications import FlankModifications
from app.schema.base import Request, Section
from app.schema.conversion import to_si
from app.schema.gears import GearMaterials, ScuffingGears
from app.schema.quantities import Input
from solvers.gears.inputs import GearPairInputs
from solvers.materials import Solid
from solvers.scuffing import inputs as si
from solvers.sources import XUE

ISO_6336 = "ISO 6336-1"

FRICTION_COEFFICIENT = Input(
    "coefficient of friction",
    "μ_m",
    f"{XUE}, Eq. 25",
    ge=0,
    le=1,
    tolerance=0.01,
    assumed="0.06, the paper's; the scuffing check computes it from the oil, which this check does not know",
)

_DEFAULTS = si.Model()


class ScuffingLoad(Section):
    """Torque or power, and speed; exactly one of torque and power is given."""

    exclusive: ClassVar = (("pinion_torque_n_m", "power_kw"),)

    pinion_torque_n_m: Annotated[
        float | None, Input("pinion torque", "T_1", XUE, ge=0, le=1e7, tolerance=1, relative_tolerance=0.01)
    ] = None
    power_kw: Annotated[
        float | None,
        Input("transmitted power", "P", f"{XUE}, Eq. 1", ge=0, le=1e6, tolerance=0.1, relative_tolerance=0.01),
    ] = None
    pinion_speed_rpm: Annotated[float, Input("pinion speed", "n_1", XUE, ge=0.1, le=2e5)]
    application_factor: Annotated[
        float, Input("application factor", "K_A", ISO_6336, text="multiplies the load of the contacts", ge=0.1, le=10)
    ] = 1.0
    dynamic_factor: Annotated[
        float, Input("dynamic factor", "K_v", ISO_6336, text="multiplies the load of the contacts", ge=0.1, le=10)
    ] = 1.0
    mesh_load_factor: Annotated[
        float, Input("mesh load factor", "K_γ", ISO_6336, text="multiplies the load of the contacts", ge=0.1, le=10)
    ] = 1.0

    @model_validator(mode="after")
    def torque_or_power(self) -> Self:
        """Refuse both and neither."""
        if self.pinion_torque_n_m is None and self.power_kw is None:
            raise PydanticCustomError("torque_or_power", "give pinion_torque_n_m or power_kw")
        if self.pinion_torque_n_m is not None and self.power_kw is not None:
            raise PydanticCustomError("torque_or_power", "pinion_torque_n_m and power_kw are both given; keep one")
        return self

    def load(self) -> si.Load:
        """The solver's load."""
        fields = to_si(self)
        torque, power, speed = fields["pinion_torque"], fields["power"], fields["pinion_speed"]
        factors = {name: getattr(self, name) for name in ("application_factor", "dynamic_factor", "mesh_load_factor")}
        return si.Load(si.torque_from_power(power, speed) if torque is None else torque, speed, **factors)


class LoadDistributionModel(Section):
    """Choices where the paper leaves room."""

    tooth_stiffness: Annotated[
        si.ToothModel,
        Input(
            "tooth stiffness model",
            "k",
            f"{XUE}, Eqs. 5-7",
            text="Ishikawa's tooth, or a parabola calibrated to the paper's load maxima",
            advanced=True,
        ),
    ] = _DEFAULTS.tooth_stiffness
    parabola_end_ratio: Annotated[
        float,
        Input(
            "end ratio of the stiffness parabola",
            "r",
            XUE,
            text="stiffness at the ends of the path over its maximum",
            ge=0.01,
            le=1,
            advanced=True,
        ),
    ] = _DEFAULTS.parabola_end_ratio
    contact: Annotated[
        si.ContactModel,
        Input(
            "contact flattening",
            "δ_PV",
            f"{XUE}, Eq. 6",
            text="flattening of the contact: Weber's half-space, or the paper's linear term",
            assumed="with the paper's term the mesh is 15 to 31 % stiffer than ISO 6336-1",
            advanced=True,
        ),
    ] = _DEFAULTS.contact
    section: Annotated[
        si.ToothSection,
        Input(
            "section of the tooth",
            text="where the tooth is cut for its compliance",
            assumed="the paper does not say; keeps the agreement with ISO 6336-1 at every helix angle",
            advanced=True,
        ),
    ] = _DEFAULTS.section
    load_convention: Annotated[
        si.LoadConvention,
        Input(
            "force in the balance",
            "W_sum",
            f"{XUE}, Eq. 1",
            text="balance of the normal force, or of the tangential force as printed",
            advanced=True,
        ),
    ] = _DEFAULTS.load_convention
    feature_points: Annotated[int, Input("points of the feature line", None, XUE, ge=2, le=1001, advanced=True)] = (
        si.Resolution().feature_points
    )

    def mesh_model(self) -> si.Model:
        """The solver's choices."""
        fields = to_si(self)
        return si.Model(**{name: fields[name] for name in si.Model.__dataclass_fields__})


class GearPairRequest(Request):
    """A loaded, modified, misaligned gear pair."""

    gears: Annotated[ScuffingGears, Input("gear pair")]
    load: Annotated[ScuffingLoad, Input("load", text="torque or power, and speed")]
    modifications: Annotated[FlankModifications, Input("modifications", text="modification and misalignment")] = (
        FlankModifications()
    )
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()

    def distribution(self, friction: float | None, model: LoadDistributionModel) -> si.LoadDistributionInputs:
        """The solver's inputs of the load distribution."""
        return si.LoadDistributionInputs(
            gears=self.gears.si(GearPairInputs),
            load=self.load.load(),
            modifications=si.Modifications(**to_si(self.modifications)),
            pinion_material=self.materials.pinion.si(Solid),
            wheel_material=self.materials.wheel.si(Solid),
            friction_coefficient=friction,
            model=model.mesh_model(),
            resolution=si.Resolution(feature_points=model.feature_points),
        )


class LoadDistributionRequest(GearPairRequest):
    """A loaded, modified, misaligned gear pair and the friction between its flanks."""

    friction_coefficient: Annotated[
        float,
        FRICTION_COEFFICIENT,
    ] = 0.06
    model: Annotated[
        LoadDistributionModel, Input("model", text="choices where the paper leaves room", advanced=True)
    ] = LoadDistributionModel()

    def inputs(self) -> si.LoadDistributionInputs:
        """The solver's inputs."""
        return self.distribution(self.friction_coefficient, self.model)

    def options(self) -> dict[str, Any]:
        """The model section."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """Of reliefs that are zero; roughness, which loads do not depend on."""
        roughness = {"materials.pinion.roughness_um", "materials.wheel.roughness_um"}
        return self.modifications.unused_defaults("modifications") | roughness
