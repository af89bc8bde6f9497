"""What lubricates the teeth of a gear coupling, what rubs, and what that costs."""

from typing import Annotated

from app.contract.quantities import Output
from app.responses.common import Group

PAHL = "Pahl 1978"
FIG_7 = "Pahl 1978, Fig. 7"
FIG_8 = "Pahl 1978, Fig. 8"
FIG_9 = "Pahl 1978, Fig. 9"
FIG_13 = "Pahl 1978, Fig. 13"
HANDBOOK = "Tribology Handbook B4.6"


class FrictionRegime(Group):
    """Area of the map of friction conditions; an open end of its friction band is null."""

    area: Annotated[str, Output("friction area", None, FIG_9, text="area of the map of friction conditions")]
    name: Annotated[str, Output("kind of lubrication", None, FIG_9, text="lubrication in this area")]
    friction_min: Annotated[float | None, Output("lower end of the friction band", "μ_min", FIG_9)]
    friction_max: Annotated[float | None, Output("upper end of the friction band", "μ_max", FIG_9)]
    distance_to_boundary: Annotated[
        float | None,
        Output(
            "distance to the next friction area",
            text="smallest |ln| of overlap and load capacity against the map's boundaries",
        ),
    ]


class CouplingLubrication(Group):
    """Contact and film of the highest loaded tooth in the tilt position."""

    max_normal_force_n: Annotated[
        float,
        Output(
            "normal force in the tilt position",
            "F_n",
            PAHL,
            text="normal force of a tooth where the displacement f_t peaks, or largest with pitch errors",
        ),
    ]
    hertz_half_width_mm: Annotated[float, Output("half width of the Hertzian contact", "a_HZ", FIG_7)]
    hertz_pressure_mpa: Annotated[float, Output("largest Hertzian pressure", "p_H", limit=2000.0, bound="upper")]
    contact_overlap: Annotated[float | None, Output("contact surface overlap", "Pu", FIG_7, limit=1.0, bound="upper")]
    inlet_ratio: Annotated[
        float | None, Output("inlet ratio", "B", FIG_8, text="inlet length over its scale; null: infinite")
    ]
    inlet_factor: Annotated[float, Output("inlet factor", "f(B)", FIG_8, text="effect of the shortened inlet")]
    hydrodynamic_capacity_n: Annotated[float, Output("hydrodynamic load capacity", "F_HD", FIG_8)]
    load_capacity_coefficient: Annotated[
        float | None, Output("load capacity coefficient", "Tr", PAHL, headline=2, limit=0.8, bound="lower")
    ]
    regime: Annotated[FrictionRegime, Output("friction regime")]
    friction_coefficient: Annotated[float, Output("friction coefficient in use", "μ")]


class SelfInducedThrust(Group):
    """Thrust without axial motion."""

    force_n: Annotated[
        float,
        Output(
            "self-induced thrust",
            "F_ax,0",
            "Pahl 1978, Fig. 17",
            text="force on one shaft, positive: pulled together",
        ),
    ]
    overturning_moment_n_m: Annotated[
        float, Output("overturning moment", "M_2", FIG_13, text="moment of friction on the sleeve")
    ]
    simple_model_force_n: Annotated[
        float,
        Output(
            "self-induced thrust of the one-pair model",
            "F_ax,1",
            FIG_13,
            text="one tooth pair per mesh; zero with an angle (M)",
        ),
    ]
    uniform_load_force_n: Annotated[
        float,
        Output(
            "self-induced thrust under uniform load",
            "F_ax,u",
            text="closed form, all teeth loaded alike; zero with an angle (M)",
        ),
    ]


class CouplingThrust(Group):
    """Axial thrust, mean over one tooth pitch (one revolution with pitch errors)."""

    force_n: Annotated[
        float,
        Output(
            "axial thrust",
            "F_ax",
            PAHL,
            text="thrust of one mesh, or with two meshes force on one shaft, positive: pulled together",
            headline=1,
            limit="axial_thrust.coaxial_limit_n",
            bound="upper",
        ),
    ]
    coaxial_limit_n: Annotated[
        float, Output("thrust limit of coaxial shafts", "F_ax,max", PAHL, text="thrust of sliding coaxial shafts")
    ]
    breakaway_force_n: Annotated[
        float, Output("breakaway thrust", "F_ax,s", PAHL, text="thrust at which coaxial shafts start to slide")
    ]
    design_force_n: Annotated[
        float,
        Output("thrust to be held", "F_ax,d", text="what a thrust bearing must hold: force or breakaway, the larger"),
    ]
    customary_force_n: Annotated[
        float | None,
        Output(
            "customary thrust",
            "0.25 T/D",
            "API 671/617 practice, from memory",
            text="0.25 T/D; null without a shaft diameter",
        ),
    ]
    fraction_of_limit: Annotated[
        float | None, Output("thrust over its limit", "F_ax/F_ax,max", text="force over coaxial limit", limit=1.0)
    ]
    uniform_load_force_n: Annotated[
        float, Output("thrust under uniform load", "F_ax,u", text="closed form of one mesh, all teeth loaded alike")
    ]
    lower_bound_n: Annotated[
        float,
        Output("lower bound of the thrust", "F_ax,lo", text="least thrust where friction at rest is indeterminate"),
    ]
    upper_bound_n: Annotated[
        float,
        Output("upper bound of the thrust", "F_ax,up", text="largest thrust where friction at rest is indeterminate"),
    ]
    indeterminate: Annotated[
        bool,
        Output("indeterminate friction", text="whether teeth stick, so that friction takes any value up to its limit"),
    ]
    self_induced: Annotated[
        SelfInducedThrust | None, Output("self-induced", text="with axial velocity zero; null for a single mesh")
    ]


class CouplingLosses(Group):
    """Friction losses and moments of one mesh, the one where the hub drives the sleeve."""

    friction_power_w: Annotated[float, Output("friction power", "P_f")]
    friction_moment_n_m: Annotated[float, Output("friction moment", "M_f")]
    contact_shift_moment_n_m: Annotated[
        float, Output("contact shift moment", "M_s", text="moment of the shifted contacts")
    ]
    hub_bending_moment_n_m: Annotated[
        float, Output("bending moment on the hub", "M_b", text="bending moment on the hub, resultant")
    ]


class CouplingLimits(Group):
    """Limits and stiffnesses."""

    sliding_velocity_limit_m_per_s: Annotated[
        float, Output("sliding velocity limit", "v_G,lim", HANDBOOK, text="largest lasting sliding velocity")
    ]
    allowable_misalignment_deg: Annotated[
        float | None,
        Output(
            "allowable misalignment",
            "δ_lim",
            HANDBOOK,
            text="misalignment at that sliding velocity; null where none reaches it",
        ),
    ]
    sleeve_centring_torque_n_m: Annotated[
        float, Output("sleeve centring torque", "T_c", text="torque that keeps a heavy sleeve centred")
    ]
    torsional_stiffness_n_m_per_rad: Annotated[
        float, Output("torsional stiffness", "c_φ", text="of one mesh, all teeth loaded")
    ]
    lateral_stiffness_n_per_um: Annotated[
        float, Output("lateral stiffness", "c_r", text="of one mesh, all teeth loaded")
    ]
