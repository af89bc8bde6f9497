"""Shafts and couplings of a gear unit, and what its request left open: parts of the answer of /v1/drive-train."""

from typing import Annotated

from app.responses.gear_mesh import Values
from app.responses.load_distribution import MeshDerived
from app.schema.base import Group
from app.schema.quantities import Output

XY = "X, Y"
HUBS = "the unit's hub, the machine's"
OCVIRK = "DuBois and Ocvirk, NACA 1157"
API_613 = "API 613, 5th ed."


class BearingLoad(Group):
    """A bearing; what only a plain one has is null of others."""

    reaction_n: Annotated[Values, Output("bearing reaction", "F_B", text="on the shaft", index=XY)]
    displacement_um: Annotated[
        Values, Output("displacement in the bearing", "u_B", text="of the shaft, without the bore's offset", index=XY)
    ]
    eccentricity_ratio: Annotated[float | None, Output("eccentricity ratio", "ε", OCVIRK)]
    attitude_deg: Annotated[float | None, Output("attitude angle", "φ_B", OCVIRK, text="of displacement against load")]
    min_film_um: Annotated[float | None, Output("thinnest film of the bearing", "h_min,B", OCVIRK)]
    specific_pressure_mpa: Annotated[
        float | None, Output("specific bearing pressure", "p_B", text="load over the projected area")
    ]
    friction_power_w: Annotated[float, Output("friction power of the bearing", "P_B")]


class ShaftThrust(Group):
    """Axial load, positive towards +Z; of a coupling's friction only the limit is known."""

    mesh_n: Annotated[float, Output("axial force of the mesh", "F_a")]
    coupling_n: Annotated[
        float,
        Output("thrust of the couplings", "τ F_max", text="the stated share of the friction limit of all couplings"),
    ]
    coupling_limit_n: Annotated[
        float, Output("limit of the coupling's thrust", "F_max", text="of all couplings of the shaft")
    ]
    collar_n: Annotated[
        float | None,
        Output("force of the thrust collar", "F_k", text="holds mesh and couplings of the pinion; null without one"),
    ]
    lower_n: Annotated[
        float | None, Output("least bearing thrust", "F_ax,min", API_613, text="null where a collar holds the shaft")
    ]
    upper_n: Annotated[
        float | None, Output("largest bearing thrust", "F_ax,max", API_613, text="null where a collar holds the shaft")
    ]
    reverses: Annotated[
        bool, Output("thrust reversal", text="whether the coupling's friction can turn the bearing's load round")
    ]
    use: Annotated[
        float | None,
        Output(
            "use of the thrust bearing",
            "F/(0.5 F_ult)",
            API_613,
            text="largest load over half the ultimate one; null without one",
            limit=1.0,
        ),
    ]
    customary_n: Annotated[
        float | None,
        Output("customary thrust of a coupling", "0.25 T/D", "from memory", text="null without a coupling"),
    ]


class ShaftLine(Group):
    """Displaced axis of a shaft."""

    z_mm: Annotated[Values, Output("position along the shaft", "Z")]
    x_um: Annotated[Values, Output("displacement along X", "u", axis="z_mm")]
    y_um: Annotated[Values, Output("displacement along Y", "v", axis="z_mm")]
    twist_mrad: Annotated[Values, Output("twist of the shaft", "ϑ_Z", axis="z_mm")]


class ShaftSummary(Group):
    """A shaft."""

    bearings: Annotated[list[BearingLoad], Output("bearings", text="in the order of the request")]
    thrust: Annotated[ShaftThrust, Output("thrust")]


class ShaftState(ShaftSummary):
    """A shaft with its displaced axis."""

    curves: Annotated[ShaftLine | None, Output("displaced axis", detail="curves")] = None


class UnitCouplingState(Group):
    """A coupling as its shaft meets it."""

    tilt_mrad: Annotated[Values, Output("tilt of the hubs", "δ", text="of hub against sleeve", index=HUBS)]
    stuck: Annotated[list[bool], Output("sticking hubs", text="whether no tooth of a hub slides", index=HUBS)]
    moment_n_m: Annotated[Values, Output("moment on the unit's hub", "M_H", index=XY)]
    force_n: Annotated[Values, Output("force on the unit's hub", "F_H", text="with half the sleeve's weight", index=XY)]
    friction_share: Annotated[
        Values,
        Output(
            "share of full sliding", "M_H/M_f", text="friction moment of a hub over that of full sliding", index=HUBS
        ),
    ]
    friction_coefficient: Annotated[
        float, Output("coefficient of friction of the coupling", "μ", text="the smaller of both hubs")
    ]
    thrust_n: Annotated[
        float, Output("thrust of the coupling on its shaft", "τ F_max", text="the stated share of the limit, along +Z")
    ]
    thrust_limit_n: Annotated[float, Output("limit of the axial friction", "F_max")]
    friction_power_w: Annotated[float, Output("friction power of the coupling", "P_C", text="of both hubs")]


class BearingInForce(Group):
    """A plain bearing's defaults; null of others."""

    radial_clearance_um: Annotated[float | None, Output("radial clearance used", "c")]
    viscosity_pa_s: Annotated[float | None, Output("oil viscosity used in the bearing", "η_B")]


class ShaftInForce(Group):
    """A shaft's defaults."""

    torque_position_mm: Annotated[float, Output("place of the torque used", "z_T")]
    bearings: Annotated[list[BearingInForce], Output("bearings used")]


class ProportionsInForce(Group):
    """A coupling's proportions."""

    face_width_mm: Annotated[float, Output("hub tooth face width used", "b_C")]
    tooth_height_mm: Annotated[float, Output("load-carrying tooth height used", "h_trag")]


class CouplingInForce(Group):
    """A coupling's defaults."""

    coupling: Annotated[ProportionsInForce, Output("proportions used")]
    axial_tooth_stiffness_n_per_um: Annotated[float, Output("axial tooth stiffness used", "c_a")]


class HeatInForce(Group):
    """Wall responses."""

    wall_response: Annotated[float, Output("wall response used", "κ_1")]
    wall_response_wheel: Annotated[float, Output("wall response of the wheel used", "κ_2")]


class TemperaturesInForce(Group):
    """Bulk and scuffing temperature."""

    bulk_c: Annotated[
        float | None,
        Output("bulk temperature used", "θ_M", text="given, the teeth's mean, or estimated; null without an oil"),
    ]
    scuffing_c: Annotated[
        float | None,
        Output("scuffing temperature used", "θ_S", text="given or by a test; null with neither"),
    ]


class StateDerived(Group):
    """What the request left open, as a state of the unit has it."""

    temperatures: Annotated[TemperaturesInForce, Output("temperatures used")]


class DriveTrainDerived(MeshDerived):
    """What the request left open, in groups named as its sections are."""

    contact_load_factor: Annotated[
        float, Output("load factor of the contacts", "K", text="K_A K_v K_γ, on the load of the contacts only")
    ]
    pinion_shaft: Annotated[ShaftInForce, Output("pinion shaft used")]
    wheel_shaft: Annotated[ShaftInForce, Output("wheel shaft used")]
    couplings: Annotated[list[CouplingInForce], Output("couplings used")]
    thermal: Annotated[HeatInForce, Output("heat used")]
    temperatures: Annotated[TemperaturesInForce, Output("temperatures used")]
