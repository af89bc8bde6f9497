"""Scuffing: requests of /v1/scuffing/load-distribution and /v1/scuffing."""

from typing import Annotated, Any, Literal, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from app.conversion import to_si
from app.quantities import Input
from app.requests.common import Request, Section
from app.requests.gears import Gears
from app.requests.line_contact import FilmModel
from app.requests.materials import XUE, Oil, Surface
from solvers.errors import InvalidInput
from solvers.gears.path_of_contact import meshing_path
from solvers.scuffing import inputs as si
from solvers.scuffing.modification import gap

RELIEFS = ("tip_relief", "root_relief", "end_relief")
NO_LENGTHS = "the paper gives no relief lengths"


class ScuffingGears(Gears):
    """The gear pair."""

    rack_tip_radius: Annotated[
        float,
        Input(
            "tip radius coefficient of the rack",
            "ρ_fP*",
            "ISO 53",
            ge=0,
            le=0.6,
            assumed="rack A of ISO 53; the paper gives none",
        ),
    ] = 0.38


class ScuffingLoad(Section):
    """Torque or power, and speed; exactly one of torque and power is given."""

    pinion_torque_n_m: Annotated[float | None, Input("pinion torque", "T_1", XUE, ge=0, le=1e7)] = None
    power_kw: Annotated[float | None, Input("transmitted power", "P", f"{XUE}, Eq. 1", ge=0, le=1e6)] = None
    pinion_speed_rpm: Annotated[float, Input("pinion speed", "n_1", XUE, ge=0.1, le=2e5)]

    @model_validator(mode="after")
    def torque_or_power(self) -> Self:
        """Refuse both and neither."""
        if (self.pinion_torque_n_m is None) == (self.power_kw is None):
            raise PydanticCustomError("torque_or_power", "Give either pinion_torque_n_m or power_kw")
        return self

    def load(self) -> si.Load:
        """The solver's load."""
        fields = to_si(self)
        torque, power, speed = fields["pinion_torque"], fields["power"], fields["pinion_speed"]
        return si.Load(si.torque_from_power(power, speed) if torque is None else torque, speed)


class FlankModifications(Section):
    """Gaps along the transverse line of action, positive where material is missing."""

    profile_crowning_um: Annotated[float, Input("profile crowning", "C_α", XUE, ge=-1000, le=1000)] = 0.0
    lead_crowning_um: Annotated[float, Input("lead crowning", "C_β", XUE, ge=-1000, le=1000)] = 0.0
    profile_slope_um: Annotated[
        float,
        Input("pressure-angle slope; positive opens the gap towards the pinion tip", "f_Hα", XUE, ge=-1000, le=1000),
    ] = 0.0
    helix_slope_um: Annotated[
        float,
        Input(
            "helix slope and misalignment; positive opens the gap towards the end that leaves the mesh last",
            "f_Hβ",
            XUE,
            ge=-1000,
            le=1000,
        ),
    ] = 0.0
    in_plane_deviation_um: Annotated[
        float,
        Input(
            "shaft deviation in their plane over the face; adds to the helix slope",
            "f_Σδ",
            "ISO/TR 10064-3",
            ge=-1000,
            le=1000,
        ),
    ] = 0.0
    out_of_plane_deviation_um: Annotated[
        float,
        Input(
            "shaft deviation out of their plane over the face; adds to the helix slope",
            "f_Σβ",
            "ISO/TR 10064-3",
            ge=-1000,
            le=1000,
        ),
    ] = 0.0
    tip_relief_um: Annotated[float, Input("relief at E: pinion tip plus wheel root", "C_a", XUE, ge=0, le=1000)] = 0.0
    tip_relief_length_mm: Annotated[
        float | None,
        Input(
            "length along the line of action; null: to the single contact, a tenth to half of the path",
            "L_a",
            ge=1e-3,
            le=1000,
            assumed=NO_LENGTHS,
        ),
    ] = None
    root_relief_um: Annotated[float, Input("relief at A: pinion root plus wheel tip", "C_f", XUE, ge=0, le=1000)] = 0.0
    root_relief_length_mm: Annotated[
        float | None,
        Input(
            "length along the line of action; null: to the single contact, a tenth to half of the path",
            "L_f",
            ge=1e-3,
            le=1000,
            assumed=NO_LENGTHS,
        ),
    ] = None
    end_relief_um: Annotated[float, Input("relief at both ends of the face", "C_e", XUE, ge=0, le=1000)] = 0.0
    end_relief_length_mm: Annotated[
        float | None,
        Input("length along the face; null: a tenth of it", "L_e", ge=1e-3, le=5000, assumed=NO_LENGTHS),
    ] = None
    relief_exponent: Annotated[
        float,
        Input("1: linear reliefs, 2: parabolic", "p", ge=0.5, le=10, assumed="linear; the paper does not say"),
    ] = 1.0


class GearMaterial(Surface):
    """Material and finish of one gear."""

    roughness_um: Annotated[
        float,
        Input(
            "arithmetic mean roughness",
            "R_a",
            f"{XUE}, Eq. 28",
            ge=0.001,
            le=100,
            assumed="ground flanks; the paper gives none",
        ),
    ] = 0.4


class GearMaterials(Section):
    """Materials of the pair."""

    pinion: Annotated[GearMaterial, Input("of the pinion")] = GearMaterial()
    wheel: Annotated[GearMaterial, Input("of the wheel")] = GearMaterial()


class LoadDistributionModel(Section):
    """Choices where the paper leaves room."""

    tooth_stiffness: Annotated[
        Literal["ishikawa", "parabola"],
        Input("Ishikawa's tooth, or a parabola calibrated to the paper's load maxima", "k", f"{XUE}, Eqs. 5-7"),
    ] = "ishikawa"
    parabola_end_ratio: Annotated[
        float, Input("stiffness at the ends of the path over its maximum", "r", XUE, ge=0.01, le=1)
    ] = 0.757
    contact: Annotated[
        Literal["hertzian", "linear"],
        Input(
            "flattening of the contact: Weber's half-space, or the paper's linear term",
            "δ_PV",
            f"{XUE}, Eq. 6",
            assumed="with the paper's term the mesh is 15 to 31 % stiffer than ISO 6336-1",
        ),
    ] = "hertzian"
    section: Annotated[
        Literal["normal", "transverse"],
        Input(
            "where the tooth is cut for its compliance",
            assumed="the paper does not say; keeps the agreement with ISO 6336-1 at every helix angle",
        ),
    ] = "normal"
    load_convention: Annotated[
        Literal["exact", "paper"],
        Input("balance of the normal force, or of the tangential force as printed", "W_sum", f"{XUE}, Eq. 1"),
    ] = "exact"
    feature_points: Annotated[int, Input("points of the feature line", None, XUE, ge=2, le=1001)] = 51


class LoadDistributionRequest(Request):
    """A loaded, modified, misaligned gear pair."""

    gears: Annotated[ScuffingGears, Input("the gear pair")]
    load: Annotated[ScuffingLoad, Input("torque or power, and speed")]
    modifications: Annotated[FlankModifications, Input("modification and misalignment")] = FlankModifications()
    materials: Annotated[GearMaterials, Input("materials of the pair")] = GearMaterials()
    friction_coefficient: Annotated[float, Input("coefficient of friction", "f", f"{XUE}, Eq. 25", ge=0, le=1)] = 0.06
    model: Annotated[LoadDistributionModel, Input("choices where the paper leaves room")] = LoadDistributionModel()

    def resolved(self) -> Self:
        """Relief lengths follow from the path of contact, if there is one; the solver refuses the pair otherwise."""
        try:
            path = meshing_path(self._pair())
        except InvalidInput:
            return self
        form = gap(si.Modifications(**to_si(self.modifications)), path)
        lengths = {f"{relief}_length_mm": getattr(form, f"{relief}_length") * 1e3 for relief in RELIEFS}
        return self.model_copy(update={"modifications": self.modifications.model_copy(update=lengths)})

    def inputs(self) -> Any:
        """The solver's inputs."""
        return self.distribution()

    def distribution(self) -> si.LoadDistributionInputs:
        """The solver's inputs of the load distribution."""
        model = to_si(self.model)
        options = {name: model[name] for name in si.Model.__dataclass_fields__}
        return si.LoadDistributionInputs(
            gears=self._pair(),
            load=self.load.load(),
            modifications=si.Modifications(**to_si(self.modifications)),
            pinion_material=self.materials.pinion.solid(),
            wheel_material=self.materials.wheel.solid(),
            friction_coefficient=self.friction_coefficient,
            model=si.Model(**options),
            resolution=si.Resolution(feature_points=self.model.feature_points),
        )

    def options(self) -> dict[str, Any]:
        """The model section."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """Lengths and exponent of reliefs that are zero; roughness, which loads do not depend on."""
        amplitudes = {relief: getattr(self.modifications, f"{relief}_um") for relief in RELIEFS}
        unused = {f"modifications.{relief}_length_mm" for relief, value in amplitudes.items() if value == 0.0}
        if not any(amplitudes.values()):
            unused.add("modifications.relief_exponent")
        return frozenset(unused | {"materials.pinion.roughness_um", "materials.wheel.roughness_um"})

    def _pair(self) -> Any:
        return self.gears.pair(self.gears.rack_tip_radius)


class ScuffingTemperatures(Section):
    """Temperatures of teeth and oil."""

    bulk_c: Annotated[
        float, Input("bulk temperature of the teeth, at which the oil enters", "t_M", f"{XUE}, Eq. 16", ge=-70, le=500)
    ] = 86.85
    oil_c: Annotated[float, Input("oil temperature", "t_oil", f"{XUE}, Eq. 26", ge=-70, le=500)] = 60.0
    scuffing_c: Annotated[
        float | None,
        Input(
            "scuffing temperature of oil and material; null: no safety factor", "t_s", f"{XUE}, Eq. 26", ge=-70, le=1500
        ),
    ] = None


class ScuffingModel(LoadDistributionModel, FilmModel):
    """Choices where the paper leaves room, and physics and resolution of the film."""

    lubrication: Annotated[
        Literal["thermal_ehl", "closed_form"],
        Input("film and flash temperature by the thermal EHL solution, or by formulas alone", None, XUE),
    ] = "thermal_ehl"
    path_points: Annotated[int, Input("points of the check along the feature line", None, XUE, ge=2, le=500)] = 50


class ScuffingRequest(LoadDistributionRequest):
    """A loaded gear pair, its oil and temperatures."""

    lubricant: Annotated[Oil, Input("the oil")] = Oil()
    temperatures: Annotated[ScuffingTemperatures, Input("temperatures of teeth and oil")] = ScuffingTemperatures()
    model: Annotated[ScuffingModel, Input("choices where the paper leaves room")] = ScuffingModel()

    def inputs(self) -> si.ScuffingInputs:
        """The solver's inputs."""
        return si.ScuffingInputs(
            distribution=self.distribution(),
            lubricant=self.lubricant.lubricant(),
            temperatures=si.Temperatures(**to_si(self.temperatures)),
            lubrication=self.model.lubrication,
            film=self.model.film(),
            path_points=self.model.path_points,
        )

    def unused_defaults(self) -> frozenset[str]:
        """Lengths and exponent of reliefs that are zero, the film's model in closed form; roughness counts here."""
        unused = super().unused_defaults() - {"materials.pinion.roughness_um", "materials.wheel.roughness_um"}
        if self.model.lubrication == "closed_form":
            return unused | {"model.rheology", "model.eyring_stress_mpa"}
        return unused | self.model.unused_film_defaults("model")
