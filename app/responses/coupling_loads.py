"""How the teeth of a gear coupling move and share the load."""

from typing import Annotated

from app.contract.quantities import Output
from app.responses.common import Group

PAHL = "Pahl 1978"
FIG_3 = "Pahl 1978, Fig. 3"
FIG_6 = "Pahl 1978, Fig. 6"
FIG_7 = "Pahl 1978, Fig. 7"


class CouplingGeometry(Group):
    """Radii of the crowned tooth."""

    pitch_radius_mm: Annotated[float, Output("pitch radius", "r_o", PAHL)]
    crowning_radius_mm: Annotated[
        float, Output("crowning radius", "r_b", PAHL, text="radius of the cutter centre's path")
    ]
    tangential_flank_radius_mm: Annotated[float, Output("flank radius in the tangential plane", "R_t")]
    normal_flank_radius_mm: Annotated[float, Output("flank radius in the plane of action", "R_e", "Pahl 1978, Fig. 8")]


class CouplingKinematicCurves(Group):
    """Motion over one revolution of a tooth; 90° and 270° are the tilt positions."""

    angle_deg: Annotated[list[float], Output("tooth angle", "φ", text="tooth angle from the pivot position")]
    sliding_velocity_m_per_s: Annotated[
        list[float],
        Output("axial sliding velocity", "v_G", FIG_6, text="axial sliding velocity, signed", axis="angle_deg"),
    ]
    hydrodynamic_velocity_m_per_s: Annotated[
        list[float], Output("hydrodynamically effective velocity", "v_H", FIG_6, axis="angle_deg")
    ]
    tangential_displacement_um: Annotated[
        list[float], Output("tangential displacement", "f_t", FIG_6, axis="angle_deg")
    ]
    contact_position_mm: Annotated[
        list[float], Output("contact position on the hub tooth", "s_1", FIG_7, axis="angle_deg")
    ]


class CouplingKinematics(Group):
    """Largest values of the tooth's motion over a revolution."""

    max_sliding_velocity_m_per_s: Annotated[
        float,
        Output(
            "largest sliding velocity",
            "v_G,max",
            FIG_6,
            headline=3,
            limit="limits.sliding_velocity_limit_m_per_s",
            bound="upper",
        ),
    ]
    max_contact_travel_mm: Annotated[
        float,
        Output("largest contact travel", "s_1,max", FIG_7, text="largest travel from the tooth's middle"),
    ]
    max_hydrodynamic_velocity_m_per_s: Annotated[
        float, Output("largest hydrodynamically effective velocity", "v_H,max", FIG_6)
    ]
    tangential_displacement_peak_to_peak_um: Annotated[
        float, Output("peak-to-peak tangential displacement", "f_t,pp", FIG_6)
    ]
    curves: Annotated[CouplingKinematicCurves | None, Output("motion over one revolution", detail="curves")] = None


class CouplingLoadCurves(Group):
    """Tooth forces."""

    angle_deg: Annotated[list[float], Output("angle of the tooth", "φ_i")]
    tangential_force_n: Annotated[list[float], Output("tangential force of the tooth", "F_t", FIG_3, axis="angle_deg")]


class CouplingLoadDistribution(Group):
    """Load over the teeth of one mesh, the one where the hub drives the sleeve, at the rotor angle asked for."""

    mean_tangential_force_n: Annotated[float, Output("mean tangential force", "F_m", text="of a tooth")]
    max_tangential_force_n: Annotated[float, Output("largest tangential force", "F_max", FIG_3)]
    min_tangential_force_n: Annotated[float, Output("smallest tangential force", "F_min")]
    max_normal_force_n: Annotated[
        float, Output("largest normal force over the teeth", "F_n,max", PAHL, text="at the rotor angle asked for")
    ]
    load_concentration: Annotated[
        float | None, Output("load concentration", "F_max/F_m", text="largest over mean force; null without torque")
    ]
    loaded_teeth: Annotated[int, Output("loaded teeth", "z_L", text="teeth that carry")]
    rotation_um: Annotated[
        float, Output("rotation of hub against sleeve", "ψ", text="rotation, an arc at the pitch radius")
    ]
    unloading_misalignment_deg: Annotated[
        float, Output("unloading misalignment", "δ_L", text="misalignment beyond which some tooth is free")
    ]
    sleeve_displacement_um: Annotated[
        list[float], Output("sleeve displacement", "e", text="displacement (x, y) of the sleeve", index="x, y")
    ]
    iterations: Annotated[
        int, Output("iterations of the sleeve's balance", text="of a floating sleeve; 0 for a centred one")
    ]
    curves: Annotated[CouplingLoadCurves | None, Output("load tooth by tooth", detail="curves")] = None
