"""Gear couplings: requests of /v1/coupling and its two companions."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field

from app.conversion import to_si
from app.quantities import Input
from app.requests.common import Request, Section
from solvers.coupling import inputs as si

PAHL = "Pahl 1978"


class CouplingDesign(Section):
    """The coupling without its crowning."""

    teeth: Annotated[int, Input("number of teeth", "z", PAHL, ge=6, le=400)]
    module_mm: Annotated[float, Input("module", "m", PAHL, ge=0.1, le=100)]
    pressure_angle_deg: Annotated[
        float, Input("pressure angle", "α", ge=1, lt=45, assumed="the usual rack; the paper gives none")
    ] = 20.0
    face_width_mm: Annotated[
        float | None,
        Input("hub tooth face width; null: 8 modules", "b", ge=0.1, le=2000, assumed="8 modules; the paper gives none"),
    ] = None
    tooth_height_mm: Annotated[
        float | None,
        Input(
            "load-carrying tooth height, the length of the contact line; null: 2 modules",
            "h_trag",
            "Pahl 1978, Fig. 8",
            ge=0.05,
            le=200,
            assumed="2 modules; the paper gives none",
        ),
    ] = None
    hub_distance_mm: Annotated[
        float,
        Input(
            "distance of the two tooth planes",
            "l_H",
            "Pahl 1978, Fig. 13",
            ge=1,
            le=20000,
            assumed="order of magnitude",
        ),
    ] = 200.0
    tooth_stiffness_n_per_um: Annotated[
        float,
        Input(
            "tangential stiffness of one tooth pair",
            "c_t",
            ge=0.1,
            le=1e5,
            assumed="order of magnitude of ISO 6336-1: 14 N/(mm µm) over 20 mm of effective width",
        ),
    ] = 280.0
    sleeve_mass_kg: Annotated[
        float,
        Input("mass carried by one mesh, half the sleeve", "m_s", ge=1e-3, le=1e4, assumed="order of magnitude"),
    ] = 4.0
    pitch_errors_um: Annotated[
        list[float] | None,
        Field(min_length=1, max_length=1000),
        Input(
            "pitch errors, one per tooth, positive = early, carries more", "p_i", "Pahl 1978, Fig. 4", ge=-1e4, le=1e4
        ),
    ] = None
    youngs_modulus_gpa: Annotated[float, Input("Young's modulus of the teeth", "E", ge=1, le=2000, assumed="steel")] = (
        206.0
    )
    poisson_ratio: Annotated[float, Input("Poisson's ratio of the teeth", "ν", ge=0, lt=0.5, assumed="steel")] = 0.3

    def resolved(self) -> Self:
        """Face width and tooth height follow from the module where they are not given."""
        return self.model_copy(
            update={
                "face_width_mm": 8 * self.module_mm if self.face_width_mm is None else self.face_width_mm,
                "tooth_height_mm": 2 * self.module_mm if self.tooth_height_mm is None else self.tooth_height_mm,
            }
        )


class CrownedCoupling(CouplingDesign):
    """The coupling."""

    crowning_ratio: Annotated[
        float, Input("crowning radius over pitch radius; 1: heavily crowned", "ε", PAHL, ge=0.2, le=1000)
    ] = 1.0


class CouplingLoad(Section):
    """Torque, speed and arrangement."""

    torque_n_m: Annotated[float, Input("transmitted torque", "T", PAHL, ge=0, le=1e8)]
    speed_rpm: Annotated[float, Input("speed; the sign is the sense of rotation", "n", PAHL, ge=-1e5, le=1e5)]
    axial_velocity_mm_per_s: Annotated[
        float,
        Input(
            "axial speed hub against sleeve at each mesh; positive: shafts move apart", "v_ax", PAHL, ge=-1e4, le=1e4
        ),
    ] = 0.0
    arrangement: Annotated[
        Literal["single", "parallel_offset", "angular"],
        Input(
            "one mesh; two meshes with parallel offset (Z); two meshes with an angle (M)", None, "Pahl 1978, Fig. 13"
        ),
    ] = "single"


class CouplingOperation(CouplingLoad):
    """Operating point."""

    misalignment_deg: Annotated[float, Input("tilt of hub against sleeve at one mesh", "δ_HS", PAHL, ge=-6, le=6)]


class CouplingOperationRange(CouplingLoad):
    """Operating point with a range of misalignment."""

    misalignment_range_deg: Annotated[
        list[float],
        Field(min_length=2, max_length=2),
        Input("smallest and largest tilt of hub against sleeve", "δ_HS", PAHL, ge=1e-4, le=6),
    ]


class CouplingLubricant(Section):
    """Oil at the teeth."""

    viscosity_pa_s: Annotated[
        float,
        Input("viscosity at the teeth", "η", "Pahl 1978, Fig. 8", ge=1e-5, le=100, assumed="ISO VG 46 near 50 °C"),
    ] = 0.025
    reference_film_um: Annotated[
        float, Input("film thickness of the load capacity", "h_0", "Pahl 1978, Fig. 8", ge=1e-3, le=1000)
    ] = 1.0


class MixedFrictionTable(Section):
    """Measured mixed friction against sliding velocity, held constant outside; a single point is a constant."""

    sliding_velocity_m_per_s: Annotated[
        list[float], Field(min_length=1, max_length=1000), Input("sliding velocities, rising", "v_G", ge=0, le=1000)
    ]
    coefficient: Annotated[
        list[float], Field(min_length=1, max_length=1000), Input("friction coefficients", "μ", ge=1e-4, le=2)
    ]


class MixedFrictionCurve(Section):
    """Our law of mixed friction: it falls to its lowest value at one sliding velocity and rises again beyond."""

    highest: Annotated[
        float, Input("coefficient at rest, and the most at high velocity", "μ", "Pahl 1978, Fig. 9", ge=1e-4, le=2)
    ] = 0.1
    lowest: Annotated[float, Input("least coefficient", "μ", "Pahl 1978, Fig. 9", ge=1e-4, le=2)] = 0.05
    velocity_m_per_s: Annotated[
        float,
        Input(
            "largest sliding velocity at which the coefficient is least",
            "v_G",
            "Pahl 1978, Fig. 10",
            ge=1e-4,
            le=1000,
            assumed="a calibration: it puts the friction minimum of the paper's heavily crowned coupling at 0.4° and "
            "200 1/s; the points of Fig. 10 and the speed of Fig. 11 are not in the text",
        ),
    ] = 0.11


class CouplingFriction(Section):
    """Friction between the teeth."""

    coefficient: Annotated[
        float | None,
        Input(
            "coefficient of friction; null: the law of the friction regime",
            "μ",
            "Pahl 1978, Fig. 9",
            ge=0,
            le=2,
            assumed="no coefficient given: the law of the friction regime, ours inside the paper's bands",
        ),
    ] = None
    static_coefficient: Annotated[
        float | None,
        Input(
            "coefficient at rest; null: `coefficient`, without one that of the friction regime at rest without film",
            "μ_s",
            PAHL,
            ge=0,
            le=2,
            assumed="0.16, the law of the friction regime at rest without film",
        ),
    ] = None
    mixed_law: Annotated[
        MixedFrictionTable | None,
        Input("table that replaces the mixed-lubrication branch of the law, `mixed_curve`", None, "Pahl 1978, Fig. 10"),
    ] = None
    mixed_curve: Annotated[
        MixedFrictionCurve, Input("mixed-lubrication branch of the law", None, "Pahl 1978, Fig. 10")
    ] = MixedFrictionCurve()


class CouplingModel(Section):
    """Choices where the paper leaves room."""

    kinematics: Annotated[
        Literal["tangential", "spatial"],
        Input("tangential: as the paper describes; spatial: exact to first order, with the pivot motion", None, PAHL),
    ] = "tangential"
    sleeve: Annotated[
        Literal["centred", "floating"], Input("whether the sleeve of the single mesh is centred or finds its place")
    ] = "centred"
    inlet: Annotated[
        Literal["face", "travel", "infinite"],
        Input(
            "what limits the oil inlet: the face left ahead of the contact, the contact's travel, nothing",
            "b_Ix",
            "Pahl 1978, Fig. 8",
            assumed="the paper does not define the inlet length",
        ),
    ] = "face"
    inlet_length_mm: Annotated[float | None, Input("inlet length instead of `inlet`", "b_Ix", ge=1e-3, le=2000)] = None
    film_angle_deg: Annotated[
        float | None,
        Input(
            "tooth angle whose hydrodynamic velocity builds the film, 90 at the tilt position; null: the largest",
            "φ",
            "Pahl 1978, Fig. 8",
            ge=-360,
            le=360,
            assumed="the largest hydrodynamic velocity of a revolution; the paper does not say which it takes",
        ),
    ] = None
    rotor_angle_deg: Annotated[float, Input("rotor angle of the tooth forces", "θ", ge=-360, le=360)] = 0.0
    simple_thrust_factor: Annotated[
        float,
        Input(
            "share of the sleeve force that the one-pair model of self-induced thrust turns into tooth forces",
            "κ",
            "Pahl 1978, Fig. 13",
            ge=0,
            le=10,
            assumed="all of it; the paper does not state the share",
        ),
    ] = 1.0


class _CouplingRequest(Request):
    """What the three coupling calculations have in common."""

    coupling: Annotated[CouplingDesign, Input("the coupling")]
    operation: Annotated[CouplingLoad, Input("operating point")]
    lubricant: Annotated[CouplingLubricant, Input("oil at the teeth")] = CouplingLubricant()
    friction: Annotated[CouplingFriction, Input("friction between the teeth")] = CouplingFriction()
    model: Annotated[CouplingModel, Input("choices where the paper leaves room")] = CouplingModel()

    def options(self) -> dict[str, Any]:
        """The model section."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """What given values replace, and what the arrangement does without."""
        unused = set()
        if self.model.inlet_length_mm is not None:
            unused.add("model.inlet")
        if self.friction.coefficient is not None or self.friction.mixed_law is not None:
            unused.add("friction.mixed_curve")
        if self.friction.coefficient is not None:
            unused.add("friction.static_coefficient")
        if self.operation.arrangement == "single":
            unused.add("coupling.hub_distance_mm")
        if self.operation.arrangement != "parallel_offset":
            unused.add("model.simple_thrust_factor")
        return frozenset(unused)

    def _design(self, operation: dict[str, Any]) -> si.CouplingInputs:
        friction, table = to_si(self.friction), self.friction.mixed_law
        friction["mixed_law"] = (
            si.MixedFrictionCurve(**to_si(self.friction.mixed_curve))
            if table is None
            else si.MixedFrictionTable(**to_si(table))
        )
        return si.CouplingInputs(
            coupling=si.Coupling(**to_si(self.coupling)),
            operation=si.Operation(**operation),
            lubricant=si.Lubricant(**to_si(self.lubricant)),
            friction=si.Friction(**friction),
            model=si.ModelOptions(**to_si(self.model)),
        )


class CouplingRequest(_CouplingRequest):
    """A gear coupling at one operating point."""

    coupling: Annotated[CrownedCoupling, Input("the coupling")]
    operation: Annotated[CouplingOperation, Input("operating point")]

    def inputs(self) -> si.CouplingInputs:
        """The solver's inputs."""
        return self._design(to_si(self.operation))


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

    coupling: Annotated[CouplingDesign, Input("the coupling without its crowning")]
    operation: Annotated[CouplingOperationRange, Input("operating point and range of misalignment")]

    def unused_defaults(self) -> frozenset[str]:
        """Also what only a result at one operating point shows: the one-pair model of thrust, breakaway."""
        return super().unused_defaults() | {"model.simple_thrust_factor", "friction.static_coefficient"}

    def inputs(self) -> si.RecommendationInputs:
        """The solver's inputs."""
        operation = to_si(self.operation)
        smallest, largest = operation.pop("misalignment_range")
        design = self._design({**operation, "misalignment": smallest})
        return si.RecommendationInputs(design, min_misalignment=smallest, max_misalignment=largest)
