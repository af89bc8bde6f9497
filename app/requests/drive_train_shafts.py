"""Shafts of a gear unit, their sections and bearings: sections of /v1/drive-train."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from app.schema.base import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.drive_train import inputs as si
from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet, lubricant_at

OCVIRK = "DuBois and Ocvirk, NACA 1157"
FILM_ABOVE_OIL = 15.0  # K

_SHAFT = si.Shaft(sections=(), bearings=())


def _isotropic(value: Any) -> Any:
    """A number stands for a bearing as stiff in every direction."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return [[value, 0.0], [0.0, value]]
    return value


Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Stiffness = Annotated[
    Annotated[list[Pair], Field(min_length=2, max_length=2)],
    BeforeValidator(_isotropic, json_schema_input_type=float | list[list[float]]),
]


class CylindricalSection(Section):
    """A cylinder of a shaft."""

    length_mm: Annotated[float, Input("section length", "l", ge=0.1, le=5000)]
    outer_diameter_mm: Annotated[
        float,
        Input(
            "section outer diameter",
            "d_o",
            text="under the teeth the reference diameter, as in ISO 6336-1, or the user's own",
            ge=5,
            le=3000,
        ),
    ]
    inner_diameter_mm: Annotated[float, Input("section bore", "d_i", ge=0, le=3000, tolerance=0.1)] = 0.0


class ShaftBearing(Section):
    """A radial bearing: a plain one, one by its stiffness, or a rigid one."""

    position_mm: Annotated[
        float, Input("bearing position", "z_B", text="along the unit's Z", ge=-20000, le=20000, tolerance=0.1)
    ]
    type: Annotated[
        Literal["journal", "linear", "rigid"],
        Input("bearing type", text="short plain bearing; stiffness given; rigid"),
    ] = "journal"
    offset_um: Annotated[
        Pair,
        Input("bore offset", "e_B", text="[X, Y] of the bore against the datum axis", ge=-5000, le=5000, tolerance=2),
    ] = Field(default_factory=lambda: [0.0, 0.0])
    diameter_mm: Annotated[
        float | None,
        Input("journal diameter", "D", OCVIRK, ge=5, le=3000, default_text="required of plain bearings"),
    ] = None
    width_mm: Annotated[
        float | None, Input("bearing width", "B", OCVIRK, ge=1, le=3000, default_text="required of plain bearings")
    ] = None
    radial_clearance_um: Annotated[
        float | None,
        Input(
            "radial clearance of the bearing",
            "c",
            OCVIRK,
            ge=5,
            le=1000,
            default_text="1.5e-3 of the journal's radius",
            assumed="1.5e-3 of the journal's radius, usual for high-speed plain bearings",
            tolerance=15,
        ),
    ] = None
    viscosity_pa_s: Annotated[
        float | None,
        Input(
            "oil viscosity in the bearing",
            "η_B",
            OCVIRK,
            ge=1e-5,
            le=100,
            default_text="the gears' oil at the film temperature",
            assumed=f"the gears' oil at the film temperature, which is {FILM_ABOVE_OIL:.0f} K above the oil's unless "
            "given",
        ),
    ] = None
    film_temperature_c: Annotated[
        float | None,
        Input(
            "film temperature of the bearing",
            "θ_B",
            text="temperature that tells the viscosity where none is given",
            ge=-50,
            le=300,
            default_text=f"oil temperature and {FILM_ABOVE_OIL:.0f} K",
            tolerance=5,
        ),
    ] = None
    stiffness_n_per_um: Annotated[
        Stiffness | None,
        Input(
            "bearing stiffness",
            "k_B",
            text="a number or [[xx, xy], [yx, yy]]",
            ge=-1e5,
            le=1e5,
            tolerance=1,
            relative_tolerance=0.1,
            default_text="required of linear bearings",
        ),
    ] = None

    @model_validator(mode="after")
    def complete(self) -> Self:
        """Refuse a bearing that lacks what its type is described by."""
        needed = {"journal": ("diameter_mm", "width_mm"), "linear": ("stiffness_n_per_um",), "rigid": ()}[self.type]
        for name in needed:
            if getattr(self, name) is None:
                raise PydanticCustomError(
                    "bearing_data", "A {type} bearing needs {name}", {"type": self.type, "name": name}
                )
        return self

    def bearing(self, place: str, oil: OilSheet | Lubricant | None, oil_temperature: float) -> si.Bearing:
        """The solver's bearing; where it has no viscosity of its own it runs in the gears' oil [K].

        Raises InvalidInput no_oil where there is none; `place` is the bearing's dotted name.
        """
        fields = to_si(self)
        at = {"position": fields["position"], "offset": fields["offset"]}
        if self.type == "rigid":
            return si.RigidBearing(**at)
        if self.type == "linear":
            return si.LinearBearing(stiffness=fields["stiffness"], **at)
        film, viscosity = fields["film_temperature"], fields["viscosity"]
        if viscosity is None:
            if oil is None:
                message = "without an oil of the gears a plain bearing needs its own viscosity; give it, or the oil"
                raise InvalidInput("no_oil", message, f"{place}.viscosity")
            film = oil_temperature + FILM_ABOVE_OIL if film is None else film
            viscosity = lubricant_at(oil, film).viscosity_at(0.0, film)
        return si.JournalBearing(
            diameter=fields["diameter"],
            width=fields["width"],
            viscosity=viscosity,
            radial_clearance=fields["radial_clearance"],
            **at,
        )


class ThrustBearing(Section):
    """What holds a shaft axially."""

    ultimate_load_n: Annotated[
        float | None,
        Input(
            "ultimate load of the thrust bearing",
            "F_ult",
            "API 613",
            ge=1,
            le=1e8,
            default_text="the use of the bearing is not told",
        ),
    ] = None


class UnitShaft(Section):
    """A shaft in two bearings."""

    start_mm: Annotated[
        float, Input("start of the shaft", "z_0", text="its end of lowest Z", ge=-20000, le=20000, tolerance=0.1)
    ] = 0.0
    sections: Annotated[
        list[CylindricalSection], Field(min_length=1, max_length=40), Input("sections", text="cylinders in order of Z")
    ]
    torque_position_mm: Annotated[
        float | None,
        Input(
            "place where torque enters or leaves",
            "z_T",
            ge=-20000,
            le=20000,
            tolerance=0.1,
            default_text="the coupling's position; required without one",
        ),
    ] = None
    bearings: Annotated[list[ShaftBearing], Field(max_length=40), Input("bearings", text="exactly two")]
    youngs_modulus_gpa: Annotated[float, Input("Young's modulus", "E", ge=1, le=2000)] = 206.0
    poisson_ratio: Annotated[float, Input("Poisson's ratio", "ν", ge=0, lt=0.5, tolerance=0.01)] = _SHAFT.poisson_ratio
    density_kg_per_m3: Annotated[float, Input("density", "ρ", ge=100, le=30000)] = _SHAFT.density
    thrust_bearing: Annotated[ThrustBearing, Input("thrust bearing")] = ThrustBearing()

    def shaft(self, name: str, oil: OilSheet | Lubricant | None, oil_temperature: float) -> si.Shaft:
        """The solver's shaft, of this name; plain bearings without viscosity run in the gears' oil [K].

        Raises InvalidInput no_oil where there is none.
        """
        return si.Shaft(
            sections=tuple(si.ShaftSection(**to_si(section)) for section in self.sections),
            bearings=tuple(
                bearing.bearing(f"{name}.bearings.{index}", oil, oil_temperature)
                for index, bearing in enumerate(self.bearings)
            ),
            ultimate_thrust=to_si(self.thrust_bearing)["ultimate_load"],
            **to_si(self),
        )

    def unused_shaft_defaults(self, section: str) -> frozenset[str]:
        """Clearance and oil belong to plain bearings."""
        return frozenset(
            f"{section}.bearings.{index}.{name}"
            for index, bearing in enumerate(self.bearings)
            if bearing.type != "journal"
            for name in ("radial_clearance_um", "viscosity_pa_s")
        )
