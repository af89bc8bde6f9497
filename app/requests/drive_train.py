"""A gear unit whole: request of /v1/drive-train."""

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, model_validator

from app.requests.drive_train_couplings import UnitCoupling
from app.requests.drive_train_heat import ToothHeat, TrainTemperatures
from app.requests.drive_train_mesh import TrainGears, TrainModel, TrainModifications, TrainOperation
from app.requests.drive_train_shafts import UnitShaft
from app.requests.oil import Oil
from app.requests.practice import (
    PRACTICAL_FRICTION,
    assumed_in_practice,
    check_friction,
    friction_said,
    lubricant_factor_asked,
    with_default,
)
from app.schema.base import Request, Section
from app.schema.conversion import to_si
from app.schema.gears import GearMaterials
from app.schema.pumping import GearGroove, Mist
from app.schema.quantities import Input
from solvers.drive_train import inputs as si
from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.pumping import inputs as pumping
from solvers.scuffing import inputs as mesh


def _only_hot() -> list[si.State]:
    return ["hot"]


class TrainEffects(Section):
    """What is taken into account."""

    shafts: Annotated[bool, Input("shafts", text="whether shafts and bearings yield; without, couplings neither")] = (
        True
    )
    coupling: Annotated[bool, Input("couplings", text="whether couplings load their shafts")] = True
    thermal: Annotated[bool, Input("heat", text="whether heat deforms the flanks")] = True


class ThrustCollar(Section):
    """A collar on the pinion that takes the place of its thrust bearing."""

    radius_mm: Annotated[
        float | None,
        Input("radius of the thrust collar", "r_k", text="where it touches", ge=1, le=5000, default_text="no collar"),
    ] = None


class DriveTrainRequest(Request):
    """A single-stage gear unit with its shafts, bearings, couplings and heat."""

    solver_names: ClassVar = {
        "heat": "thermal",
        "collar_radius": "thrust_collar.radius",
        "ultimate_thrust": "thrust_bearing.ultimate_load",
        "mesh.distribution.modifications": "modifications",
    }

    gears: Annotated[TrainGears, Input("gear pair")]
    grooves: Annotated[
        list[GearGroove], Field(max_length=50), Input("grooves", text="circumferential grooves; they do not carry less")
    ] = Field(default_factory=list)
    operation: Annotated[TrainOperation, Input("operating point")]
    face_start_mm: Annotated[
        float,
        Input(
            "start of the face", "z_F", text="end of lowest Z of the common face", ge=-20000, le=20000, tolerance=0.1
        ),
    ]
    pinion_shaft: Annotated[UnitShaft, Input("pinion shaft", text="shaft of the driving gear")]
    wheel_shaft: Annotated[UnitShaft, Input("wheel shaft", text="shaft of the driven gear")]
    thrust_collar: Annotated[ThrustCollar, Input("thrust collar")] = ThrustCollar()
    couplings: Annotated[
        list[UnitCoupling], Field(max_length=10), Input("couplings", text="at most one on each shaft")
    ] = Field(default_factory=list)
    modifications: Annotated[
        TrainModifications, Input("modifications", text="what is ground, and misalignment from elsewhere")
    ] = TrainModifications()
    thermal: Annotated[ToothHeat, Input("heat of the teeth")] = ToothHeat()
    effects: Annotated[TrainEffects, Input("effects", text="what is taken into account")] = TrainEffects()
    ambient: Annotated[Mist, Input("ambient", text="the mist around the mesh")] = Mist()
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[TrainTemperatures, Input("temperatures", text="of contact and oil")] = TrainTemperatures()
    friction_coefficient: Annotated[float | None, PRACTICAL_FRICTION] = None
    states: Annotated[
        list[si.State],
        Field(min_length=1, max_length=2),
        Input("states", text="the unit as described is hot; with cold the answer tells both"),
    ] = Field(default_factory=_only_hot)
    model: Annotated[TrainModel, Input("model", text="choices where the papers leave room", advanced=True)] = (
        TrainModel()
    )

    @model_validator(mode="before")
    @classmethod
    def said_in_other_sections(cls, given: Any) -> Any:
        """A coefficient of friction, or a tooth temperature, says by itself that friction, or bulk, is given."""
        if not isinstance(given, dict):
            return given
        teeth = given.get("thermal")
        if isinstance(teeth, dict) and any(teeth.get(name) is not None for name in ("pinion_bulk_c", "wheel_bulk_c")):
            given = with_default(given, "temperatures", "bulk_method", "given")
        return friction_said(given)

    @model_validator(mode="after")
    def known_friction(self) -> Self:
        """A coefficient of friction that is given is a number."""
        check_friction(self.friction_coefficient, self.model)
        return self

    def inputs(self) -> si.DriveTrainInputs:
        """The solver's inputs. Raises InvalidInput no_oil where a plain bearing has neither a viscosity nor an oil."""
        temperatures, oil = self.temperatures.contact_temperatures(), self.lubricant.oil()
        shafts = [
            shaft.shaft(name, oil, temperatures.oil)
            for name, shaft in (("pinion_shaft", self.pinion_shaft), ("wheel_shaft", self.wheel_shaft))
        ]
        fields = to_si(self)
        return si.DriveTrainInputs(
            mesh=self._mesh(temperatures, oil),
            pumping=pumping.PumpingSetup(
                gears=self.gears.pumping_pair(),
                normal_backlash=to_si(self.gears)["normal_backlash"],
                grooves=tuple(groove.si(pumping.Groove) for groove in self.grooves),
                ambient=self.ambient.si(pumping.Ambient),
                model=self.model.si(pumping.PumpingModel),
            ),
            face_start=fields["face_start"],
            pinion_shaft=shafts[0],
            wheel_shaft=shafts[1],
            arrangement=self.operation.arrangement(self.gears),
            couplings=tuple(self._couplings()),
            collar_radius=to_si(self.thrust_collar)["radius"],
            heat=si.Heat(**to_si(self.thermal)),
            effects=si.Effects(**to_si(self.effects)),
            coupling_friction=self.model.coupling_friction,
            face_stations=self.model.face_stations,
            local_bulk=self.temperatures.local_bulk,
            bulk_given=self.temperatures.bulk_c is not None,
            states=fields["states"],
        )

    def _couplings(self) -> Iterator[si.UnitCoupling]:
        """The solver's couplings; an oil that none can be is that of its own coupling."""
        for k, coupling in enumerate(self.couplings):
            try:
                yield coupling.unit_coupling()
            except InvalidInput as error:
                raise InvalidInput(error.code, error.message, f"couplings.{k}.{error.field}") from error

    def _mesh(self, temperatures: mesh.Temperatures, oil: OilSheet | Lubricant | None) -> mesh.ScuffingInputs:
        distribution = mesh.LoadDistributionInputs(
            gears=self.gears.mesh_pair(),
            load=self.operation.load(),
            modifications=self.modifications.modifications(),
            pinion_material=self.materials.pinion.si(Solid),
            wheel_material=self.materials.wheel.si(Solid),
            friction_coefficient=self.friction_coefficient,
            model=self.model.mesh_model(),
            resolution=mesh.Resolution(feature_points=self.model.feature_points),
        )
        return mesh.ScuffingInputs(
            distribution=distribution,
            lubricant=None,
            oil=oil,
            temperatures=temperatures,
            lubrication=self.model.lubrication,
            friction=self.model.friction,
            film=self.model.film(),
            path_points=self.model.path_points,
        )

    def options(self) -> dict[str, Any]:
        """The model section, the number of slices filled in."""
        return self.model.model_dump() | {"slices": self.model.si(pumping.PumpingModel).slice_count}

    def unused_defaults(self) -> frozenset[str]:
        """Of reliefs that are zero, of bearings and couplings of another kind, of effects that are left out."""
        unused = set(self.modifications.unused_defaults("modifications"))
        factor = lubricant_factor_asked(self.lubricant, self.temperatures, self.model)
        unused |= self.lubricant.unused_defaults("lubricant", factor=factor)
        unused |= self.temperatures.unused_temperature_defaults("temperatures", oil=self.lubricant.known)
        unused |= self.model.unused_pumping_defaults("model")
        unused |= self.pinion_shaft.unused_shaft_defaults("pinion_shaft")
        unused |= self.wheel_shaft.unused_shaft_defaults("wheel_shaft")
        for index, coupling in enumerate(self.couplings):
            unused |= coupling.unused_coupling_defaults(f"couplings.{index}")
        if not (self.couplings and self.effects.shafts and self.effects.coupling):
            unused |= {"couplings", "model.coupling_friction"}
        if not self.effects.thermal:
            unused |= {"thermal.wall_response", "thermal.wall_response_wheel"}
        if self.model.lubrication == "closed_form" or not self.lubricant.known:
            return frozenset({*unused, "model.rheology", "model.eyring_stress_mpa"})
        return frozenset(unused | self.model.unused_film_defaults("model"))

    def assumed_by_the_model(self) -> dict[str, str]:
        """What friction, oil and bulk temperature take for granted."""
        return assumed_in_practice(self.friction_coefficient, self.lubricant, self.temperatures, self.model)
