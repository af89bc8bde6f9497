"""Gear couplings: responses of /v1/coupling and its two companions."""

from typing import Annotated

from app.contract.quantities import Output
from app.responses.common import Derived, Group, Response
from app.responses.coupling_friction import CouplingLimits, CouplingLosses, CouplingLubrication, CouplingThrust
from app.responses.coupling_loads import CouplingGeometry, CouplingKinematics, CouplingLoadDistribution

PAHL = "Pahl 1978"
FIG_5 = "Pahl 1978, Fig. 5"


class CouplingDerived(Derived):
    """Proportions of the tooth, where the request left them open."""

    face_width_mm: Annotated[float, Output("face width used", "b")]
    tooth_height_mm: Annotated[float, Output("tooth height used", "h_trag")]


class CouplingResponse(Response):
    """A gear coupling at one operating point; sections are missing where there is no solution."""

    geometry: Annotated[CouplingGeometry | None, Output("geometry", text="radii")] = None
    kinematics: Annotated[CouplingKinematics | None, Output("motion of the teeth")] = None
    load_distribution: Annotated[CouplingLoadDistribution | None, Output("load over the teeth")] = None
    lubrication: Annotated[CouplingLubrication | None, Output("lubrication", text="overlap, load capacity, regime")] = (
        None
    )
    axial_thrust: Annotated[CouplingThrust | None, Output("thrust", text="axial thrust")] = None
    losses: Annotated[CouplingLosses | None, Output("losses", text="friction losses and moments")] = None
    limits: Annotated[CouplingLimits | None, Output("limits and stiffnesses")] = None
    derived: Annotated[CouplingDerived | None, Output("proportions used")] = None


class SleeveOrbitDerived(Derived):
    """The circle on which the teeth stand."""

    pitch_radius_mm: Annotated[float, Output("pitch radius", "r_o", PAHL)]


class SleeveOrbit(Group):
    """Path of the sleeve centre."""

    rotor_angle_deg: Annotated[list[float], Output("rotor angle", "θ")]
    x_um: Annotated[list[float], Output("sleeve displacement in the pivot direction", "e_x", axis="rotor_angle_deg")]
    y_um: Annotated[list[float], Output("sleeve displacement along the tilt axis", "e_y", axis="rotor_angle_deg")]


class SleeveInertia(Group):
    """Inertia force of the sleeve mass of one mesh."""

    x_n: Annotated[
        list[float] | None,
        Output("inertia force in the pivot direction", "F_x", FIG_5, detail="curves", axis="orbit.rotor_angle_deg"),
    ] = None
    y_n: Annotated[
        list[float] | None,
        Output("inertia force along the tilt axis", "F_y", FIG_5, detail="curves", axis="orbit.rotor_angle_deg"),
    ] = None
    harmonics_x_n: Annotated[
        list[float],
        Output(
            "harmonics of the force in the pivot direction",
            "F_x,k",
            FIG_5,
            text="amplitudes from order 0 up",
            index="order from 0",
        ),
    ]
    harmonics_y_n: Annotated[
        list[float],
        Output(
            "harmonics of the force along the tilt axis",
            "F_y,k",
            FIG_5,
            text="amplitudes from order 0 up",
            index="order from 0",
        ),
    ]


class SleeveOrbitResponse(Response):
    """One revolution of a floating sleeve under its own inertia."""

    orbit: Annotated[SleeveOrbit | None, Output("path of the sleeve centre", detail="curves")] = None
    inertia_force: Annotated[SleeveInertia | None, Output("inertia force")] = None
    max_displacement_um: Annotated[float | None, Output("largest displacement", "e_max", headline=1)] = None
    displacement_uncertainty_um: Annotated[
        float | None,
        Output(
            "uncertainty of the displacement",
            "Δe_max",
            text="change of the largest displacement with more rotor angles and orders",
        ),
    ] = None
    harmonics_uncertainty_n: Annotated[
        float | None,
        Output(
            "uncertainty of the harmonics",
            "ΔF_k",
            text="largest change of a harmonic with more rotor angles and orders",
        ),
    ] = None
    sweeps: Annotated[int | None, Output("sweeps", text="sweeps over the revolution until it repeated")] = None
    change_um: Annotated[
        float | None, Output("change in the last sweep", "Δe", text="how far the last sweep still moved the path")
    ] = None
    derived: Annotated[SleeveOrbitDerived | None, Output("radius used")] = None


class RecommendedPoint(Group):
    """The recommended coupling at one end of the range."""

    contact_overlap: Annotated[float, Output("contact surface overlap", "Pu", PAHL, limit=1.0, bound="upper")]
    load_capacity_coefficient: Annotated[
        float, Output("load capacity coefficient", "Tr", PAHL, limit=0.8, bound="lower")
    ]
    friction_coefficient: Annotated[float, Output("friction coefficient in use", "μ")]
    axial_thrust_n: Annotated[float, Output("axial thrust", "F_ax", text="axial thrust at the axial velocity given")]
    sliding_velocity_m_per_s: Annotated[float, Output("largest sliding velocity", "v_G,max")]


class CrowningScan(Group):
    """How crowning trades off."""

    crowning_ratio: Annotated[list[float], Output("crowning ratio scanned", "ε")]
    min_load_capacity_coefficient: Annotated[
        list[float | None], Output("smallest load capacity coefficient", "Tr", axis="crowning_ratio")
    ]
    max_contact_overlap: Annotated[
        list[float | None], Output("largest contact surface overlap", "Pu", axis="crowning_ratio", limit=1.0)
    ]
    feasible: Annotated[list[bool], Output("feasible", text="whether every constraint is met", axis="crowning_ratio")]


class RecommendationResponse(Response):
    """The crowning ratio with the largest load capacity over a range of misalignment."""

    feasible: Annotated[
        bool | None,
        Output("feasible crowning", text="whether any crowning ratio meets every constraint", headline=2),
    ] = None
    crowning_ratio: Annotated[float | None, Output("best crowning ratio", "ε", headline=1)] = None
    min_load_capacity_coefficient: Annotated[
        float | None, Output("least load capacity coefficient", "Tr_min", text="smallest over the range", headline=3)
    ] = None
    failed_constraint: Annotated[
        str | None, Output("failed constraint", text="the constraint that leaves no crowning ratio")
    ] = None
    at_min: Annotated[RecommendedPoint | None, Output("at the smallest misalignment")] = None
    at_max: Annotated[RecommendedPoint | None, Output("at the largest misalignment")] = None
    scan: Annotated[CrowningScan | None, Output("scan", text="how crowning trades off", detail="curves")] = None
    derived: Annotated[CouplingDerived | None, Output("proportions used")] = None
