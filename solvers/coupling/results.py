"""Results of the coupling model at one operating point, in SI units; arrays are read-only.

Lengths are in m, angles in rad, forces in N and moments in N m. A value that has no meaning is None, and a notice in
`warnings` says why.
"""

from typing import Self

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.notices import Notice
from solvers.quantity import quantity, record
from solvers.sources import PAHL


@record(equation="C1")
class Geometry:
    """Radii of the crowned tooth [m]."""

    pitch_radius: float = quantity("pitch radius", "r_o", PAHL, unit="mm", equation="coupling#geometry")
    crowning_radius: float = quantity(
        "crowning radius",
        "r_b",
        PAHL,
        unit="mm",
        text="radius of the cutter centre's path",
        equation="coupling#geometry",
    )
    crowning_drop: float = quantity(
        "drop of the crowning",
        "c_b",
        unit="um",
        text="of the flank at both ends of the face against its middle, in the tangential plane",
        equation="C33",
    )
    tangential_flank_radius: float = quantity("flank radius in the tangential plane", "R_t", unit="mm")
    normal_flank_radius: float = quantity("flank radius in the plane of action", "R_e", f"{PAHL}, Fig. 8", unit="mm")


@record
class KinematicCurves:
    """Motion of a tooth of the driving hub over one revolution; angles count from the pivot position."""

    angle: FloatArray = quantity("tooth angle", "φ", unit="deg", text="tooth angle from the pivot position")
    sliding_velocity: FloatArray = quantity(
        "axial sliding velocity",
        "v_G",
        f"{PAHL}, Fig. 6",
        unit="m_per_s",
        text="axial sliding velocity, signed",
        axis="angle",
    )
    hydrodynamic_velocity: FloatArray = quantity(
        "hydrodynamically effective velocity", "v_H", f"{PAHL}, Fig. 6", unit="m_per_s", axis="angle"
    )
    tangential_displacement: FloatArray = quantity(
        "tangential displacement", "f_t", f"{PAHL}, Fig. 6", unit="um", axis="angle"
    )
    contact_position: FloatArray = quantity(
        "contact position on the hub tooth", "s_1", f"{PAHL}, Fig. 7", unit="mm", axis="angle"
    )


@record(equation="C2")
class Kinematics:
    """Largest velocities [m/s] and displacements [m] of a tooth over a revolution, all positive."""

    max_sliding_velocity: float = quantity("largest sliding velocity", "v_G,max", f"{PAHL}, Fig. 6", unit="m_per_s")
    max_contact_travel: float = quantity(
        "largest contact travel",
        "s_1,max",
        f"{PAHL}, Fig. 7",
        unit="mm",
        text="largest travel from the tooth's middle",
        equation="C3",
    )
    max_hydrodynamic_velocity: float = quantity(
        "largest hydrodynamically effective velocity", "v_H,max", f"{PAHL}, Fig. 6", unit="m_per_s", equation="C6"
    )
    tangential_displacement_peak_to_peak: float = quantity(
        "peak-to-peak tangential displacement", "f_t,pp", f"{PAHL}, Fig. 6", unit="um", equation="C5"
    )
    curves: KinematicCurves = quantity("motion over one revolution", detail="curves")


@record
class LoadCurves:
    """Tooth forces at the requested rotor angle. The `angle` of tooth i is 2 pi i / teeth + rotor angle."""

    angle: FloatArray = quantity("angle of the tooth", "φ_i", unit="deg")
    tangential_force: FloatArray = quantity(
        "tangential force of the tooth", "F_t", f"{PAHL}, Fig. 3", unit="n", axis="angle"
    )


@record(equation="C7")
class LoadDistribution:
    """Load distribution of the mesh in which the hub drives the sleeve, at the requested rotor angle.

    `unloading_misalignment` holds for a centred sleeve with many teeth and no pitch deviations.
    """

    mean_tangential_force: float = quantity("mean tangential force", "F_m", unit="n", text="of a tooth", equation="C10")
    max_tangential_force: float = quantity("largest tangential force", "F_max", f"{PAHL}, Fig. 3", unit="n")
    min_tangential_force: float = quantity("smallest tangential force", "F_min", unit="n")
    max_normal_force: float = quantity(
        "largest normal force over the teeth", "F_n,max", PAHL, unit="n", text="at the rotor angle asked for"
    )
    load_concentration: float | None = quantity(
        "load concentration", "F_max/F_m", text="largest over mean force; null without torque"
    )
    loaded_teeth: int = quantity("loaded teeth", "z_L", text="teeth that carry")
    rotation: float = quantity(
        "rotation of hub against sleeve", "ψ", unit="um", text="rotation, an arc at the pitch radius", equation="C8"
    )
    unloading_misalignment: float = quantity(
        "unloading misalignment", "δ_L", unit="deg", text="misalignment beyond which some tooth is free", equation="C10"
    )
    sleeve_displacement: tuple[float, float] = quantity(
        "sleeve displacement", "e", unit="um", text="displacement (x, y) of the sleeve", index="x, y", equation="C9"
    )
    iterations: int = quantity(
        "iterations of the sleeve's balance", text="of a floating sleeve; 0 for a centred one", equation="C9"
    )
    curves: LoadCurves = quantity("load tooth by tooth", detail="curves")


@record(equation="coupling#friction")
class Regime:
    """An area of the friction map (Fig. 9) and its band of friction; None for an end that the paper leaves open."""

    area: str = quantity("friction area", None, f"{PAHL}, Fig. 9", text="area of the map of friction conditions")
    name: str = quantity("kind of lubrication", None, f"{PAHL}, Fig. 9", text="lubrication in this area")
    friction_min: float | None = quantity("lower end of the friction band", "μ_min", f"{PAHL}, Fig. 9")
    friction_max: float | None = quantity("upper end of the friction band", "μ_max", f"{PAHL}, Fig. 9")
    distance_to_boundary: float | None = quantity(
        "distance to the next friction area",
        text="smallest |ln| of overlap and load capacity over the limits of the neighbouring areas",
    )


@record(equation="C12")
class Lubrication:
    """Contact and film of the most loaded tooth with one tooth in the tilt position.

    With pitch deviations, of the most loaded tooth of a revolution. `contact_overlap` is None if the contact does not
    travel, `load_capacity_coefficient` without load.
    """

    max_normal_force: float = quantity(
        "normal force in the tilt position",
        "F_n",
        PAHL,
        unit="n",
        text=(
            "largest tooth force with a tooth in the tilt position; with pitch deviations, the largest of a revolution"
        ),
    )
    hertz_half_width: float = quantity("half width of the Hertzian contact", "a_HZ", f"{PAHL}, Fig. 7", unit="mm")
    hertz_pressure: float = quantity("largest Hertzian pressure", "p_H", unit="mpa")
    contact_overlap: float | None = quantity("contact surface overlap", "Pu", f"{PAHL}, Fig. 7", equation="C13")
    inlet_ratio: float | None = quantity(
        "inlet ratio", "B", f"{PAHL}, Fig. 8", text="inlet length over its scale; null: infinite", equation="C14"
    )
    inlet_factor: float = quantity(
        "inlet factor", "f(B)", f"{PAHL}, Fig. 8", text="effect of the shortened inlet", equation="C16"
    )
    hydrodynamic_capacity: float = quantity(
        "hydrodynamic load capacity", "F_HD", f"{PAHL}, Fig. 8", unit="n", equation="C14"
    )
    load_capacity_coefficient: float | None = quantity("load capacity coefficient", "Tr", PAHL, equation="C13")
    regime: Regime = quantity("friction regime")
    friction_coefficient: float = quantity("coefficient of friction in use", "μ", equation="C18")


@record(equation="C22")
class SelfInducedThrust:
    """Thrust that two meshes cause without axial motion, as a mean over one tooth pitch, with its closed forms."""

    force: float = quantity(
        "self-induced thrust",
        "F_ax,0",
        f"{PAHL}, Fig. 17",
        unit="n",
        text="force on one shaft; positive pulls the shafts together",
    )
    overturning_moment: float = quantity(
        "overturning moment", "M_2", f"{PAHL}, Fig. 13", unit="n_m", text="moment of friction on the sleeve"
    )
    simple_model_force: float = quantity(
        "self-induced thrust of the one-pair model",
        "F_ax,1",
        f"{PAHL}, Fig. 13",
        unit="n",
        text="one tooth pair per mesh; zero with an angle (M)",
        equation="C23",
    )
    uniform_load_force: float = quantity(
        "self-induced thrust under uniform load",
        "F_ax,u",
        unit="n",
        text="closed form, all teeth loaded alike; zero with an angle (M)",
        equation="C24",
    )


@record(equation="C19")
class AxialThrust:
    """Mean axial thrust over a tooth pitch or, with pitch deviations, over a revolution.

    `single`: thrust of the mesh, positive along the axial velocity; otherwise force on one shaft, positive if the
    shafts are pulled together. If nothing slides, `indeterminate` is True and the thrust lies between the bounds, which
    else equal it.
    """

    force: float = quantity(
        "axial thrust",
        "F_ax",
        PAHL,
        unit="n",
        text=(
            "one mesh: thrust between hub and sleeve; two meshes: force on one shaft; positive pulls "
            "the shafts together"
        ),
    )
    coaxial_limit: float = quantity(
        "thrust limit of coaxial shafts",
        "F_ax,max",
        PAHL,
        unit="n",
        text="thrust of sliding coaxial shafts",
        equation="C20",
    )
    breakaway_force: float = quantity(
        "breakaway thrust",
        "F_ax,s",
        PAHL,
        unit="n",
        text="thrust at which coaxial shafts start to slide",
        equation="C20",
    )
    design_force: float = quantity(
        "thrust to be held",
        "F_ax,d",
        unit="n",
        text="what a thrust bearing must hold: the larger of thrust and breakaway thrust",
        equation="C20",
    )
    customary_force: float | None = quantity(
        "customary thrust",
        "0.25 T/D",
        "API 671/617 practice, quoted, not verified against the standard",
        unit="n",
        text="0.25 T/D; null without a shaft diameter",
        equation="C20",
    )
    fraction_of_limit: float | None = quantity(
        "thrust over its limit", "F_ax/F_ax,max", text="force over coaxial limit", equation="C20"
    )
    uniform_load_force: float = quantity(
        "thrust under uniform load",
        "F_ax,u",
        unit="n",
        text="closed form of one mesh, all teeth loaded alike",
        equation="C21",
    )
    lower_bound: float = quantity(
        "lower bound of the thrust", "F_ax,lo", unit="n", text="least possible thrust while teeth stick"
    )
    upper_bound: float = quantity(
        "upper bound of the thrust", "F_ax,up", unit="n", text="largest possible thrust while teeth stick"
    )
    indeterminate: bool = quantity(
        "indeterminate friction", text="whether teeth stick; friction then takes any value up to its limit"
    )
    self_induced: SelfInducedThrust | None = quantity(
        "self-induced", text="with axial velocity zero; null for a single mesh"
    )


@record(equation="C25")
class Losses:
    """Friction power and moments of one mesh, means over a tooth pitch or, with pitch deviations, over a revolution.

    The power is friction moment times tilting speed plus thrust times axial velocity; if nothing slides, the
    undetermined moment is reported as zero.
    """

    friction_power: float = quantity("friction power", "P_f", unit="w")
    friction_moment: float = quantity("friction moment", "M_f", unit="n_m")
    contact_shift_moment: float = quantity(
        "contact shift moment", "M_s", unit="n_m", text="moment of the shifted contacts", equation="C27"
    )
    hub_bending_moment: float = quantity(
        "bending moment on the hub", "M_b", unit="n_m", text="bending moment on the hub, resultant", equation="C28"
    )


@record(equation="C31")
class Limits:
    """Design limits of a coupling, and its linear stiffness with every tooth loaded.

    `allowable_misalignment` is None if the coupling is too slow to reach the sliding velocity limit.
    """

    sliding_velocity_limit: float = quantity(
        "sliding velocity limit",
        "v_G,lim",
        "Tribology Handbook B4.6",
        unit="m_per_s",
        text="largest lasting sliding velocity",
        equation="C29",
    )
    allowable_misalignment: float | None = quantity(
        "permissible misalignment",
        "δ_lim",
        "Tribology Handbook B4.6",
        unit="deg",
        text="misalignment at the sliding velocity limit; null if none reaches it",
        equation="C29",
    )
    sleeve_centring_torque: float = quantity(
        "sleeve centring torque", "T_c", unit="n_m", text="torque that keeps a heavy sleeve centred", equation="C30"
    )
    torsional_stiffness: float = quantity(
        "torsional stiffness", "c_φ", unit="n_m_per_rad", text="of one mesh, all teeth loaded"
    )
    lateral_stiffness: float = quantity(
        "lateral stiffness", "c_r", unit="n_per_um", text="of one mesh, all teeth loaded"
    )


@record(equation="R3")
class Derived:
    """Values used in the calculation, including those for omitted inputs."""

    coupling: Coupling
    viscosity: float = quantity("oil viscosity used", "η", unit="pa_s", text="at the teeth")
    viscosity_index: float | None = quantity(
        "viscosity index used", "VI", "ASTM D2270", text="null without grade or data sheet", equation="R2"
    )

    @classmethod
    def of(cls, inputs: CouplingInputs) -> Self:
        """Return the values used in a calculation with these inputs."""
        return cls(inputs.coupling, inputs.lubricant.viscosity, inputs.lubricant.viscosity_index)


@record
class CouplingResult:
    """All results at one operating point. `derived` contains the values used for omitted inputs."""

    geometry: Geometry = quantity("geometry", text="radii")
    kinematics: Kinematics = quantity("motion of the teeth")
    load_distribution: LoadDistribution = quantity("load over the teeth")
    lubrication: Lubrication = quantity("lubrication", text="overlap, load capacity, regime")
    axial_thrust: AxialThrust = quantity("thrust", text="axial thrust")
    losses: Losses = quantity("losses", text="friction losses and moments")
    limits: Limits = quantity("limits and stiffnesses")
    derived: Derived = quantity("proportions and oil used")
    warnings: tuple[Notice, ...]


@record
class Orbit:
    """Path of the sleeve centre relative to the hub over one revolution."""

    rotor_angle: FloatArray = quantity("rotor angle", "θ", unit="deg")
    x: FloatArray = quantity("sleeve displacement in the pivot direction", "e_x", unit="um", axis="rotor_angle")
    y: FloatArray = quantity("sleeve displacement along the tilt axis", "e_y", unit="um", axis="rotor_angle")


@record(equation="C11")
class InertiaForce:
    """Inertia force of the sleeve mass of one mesh; harmonics are amplitudes 2 |c_k|, order 0 the mean."""

    x: FloatArray = quantity(
        "inertia force in the pivot direction",
        "F_x",
        f"{PAHL}, Fig. 5",
        unit="n",
        detail="curves",
        axis="orbit.rotor_angle_deg",
    )
    y: FloatArray = quantity(
        "inertia force along the tilt axis",
        "F_y",
        f"{PAHL}, Fig. 5",
        unit="n",
        detail="curves",
        axis="orbit.rotor_angle_deg",
    )
    harmonics_x: FloatArray = quantity(
        "harmonics of the force in the pivot direction",
        "F_x,k",
        f"{PAHL}, Fig. 5",
        unit="n",
        text="amplitudes from order 0 up",
        index="order from 0",
    )
    harmonics_y: FloatArray = quantity(
        "harmonics of the force along the tilt axis",
        "F_y,k",
        f"{PAHL}, Fig. 5",
        unit="n",
        text="amplitudes from order 0 up",
        index="order from 0",
    )


@record(equation="C11")
class OrbitResult:
    """Results for one revolution of a floating sleeve under its own inertia.

    The path of the sleeve is computed in repeated sweeps over the revolution, until the path settles. `sweeps` is the
    number of sweeps, and `change` [m] is the change of the path in the last sweep.

    The uncertainties come from two further paths, which are computed with more rotor angles and more orders. Compared
    with the settled path, the largest displacement differs by at most `displacement_uncertainty` [m], and the harmonics
    of the force differ by at most `harmonics_uncertainty` [N]. Both uncertainties are None if one of the further paths
    does not settle.

    `derived` contains the radii of the teeth.
    """

    orbit: Orbit = quantity("path of the sleeve centre", detail="curves")
    inertia_force: InertiaForce = quantity("inertia force")
    max_displacement: float = quantity("largest displacement", "e_max", unit="um")
    displacement_uncertainty: float | None = quantity(
        "uncertainty of the displacement",
        "Δe_max",
        unit="um",
        text="change of the largest displacement with more rotor angles and orders",
    )
    harmonics_uncertainty: float | None = quantity(
        "uncertainty of the harmonics",
        "ΔF_k",
        unit="n",
        text="largest change of a harmonic with more rotor angles and orders",
    )
    sweeps: int = quantity("sweeps", text="sweeps over the revolution until the path repeated")
    change: float = quantity(
        "change in the last sweep",
        "Δe",
        unit="um",
        text="how far the path still moved in the last sweep; small once it repeats",
    )
    derived: Geometry = quantity("radius used")
    warnings: tuple[Notice, ...]
