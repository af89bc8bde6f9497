"""Inputs of a gear coupling: the coupling, its operation and the options of the model.

Attributes are in SI units. A declaration gives the range and the default in the unit in which the quantity is shown.
"""

from dataclasses import field
from itertools import pairwise
from math import atan, inf, isfinite, radians
from typing import Literal

from solvers.errors import InvalidInput
from solvers.quantity import described, quantity, record
from solvers.sources import PAHL

Arrangement = Literal["single", "parallel_offset", "angular"]
KinematicModel = Literal["tangential", "spatial"]
SleeveSupport = Literal["centred", "floating"]
InletModel = Literal["face", "travel", "infinite"]

MAX_MISALIGNMENT = radians(6.0)  # chosen: the error of first-order theory, of order delta^2, is 1 % here
LEAST_TORQUE = 1e-6  # N m, chosen: a smaller torque is not accepted as a load
STEEL = 206e9  # Pa, Young's modulus for which ISO 6336-1 states the tooth stiffness
STEEL_TOOTH_STIFFNESS = 280e6  # N/m, of a pair of steel teeth


@record(equation="coupling#geometry")
class Coupling:
    """A gear coupling: a hub with crowned teeth in a sleeve with straight internal teeth.

    If face width, tooth height or tooth pair stiffness is given as None, the new coupling has the default value
    instead.
    """

    teeth: int = quantity("number of teeth", "z", PAHL, ge=6, le=400)
    module: float = quantity("module", "m", PAHL, unit="mm", ge=0.1, le=100)
    pressure_angle: float = quantity(
        "pressure angle", "α", unit="deg", default=20.0, ge=1, lt=45, assumed="the usual rack; the paper gives none"
    )
    face_width: float = quantity(
        "hub tooth face width",
        "b",
        unit="mm",
        default=None,
        ge=0.1,
        le=2000,
        tolerance=0.1,
        default_text="8 modules",
        assumed="8 times the module; the paper gives no face width",
    )
    tooth_height: float = quantity(
        "load-carrying tooth height",
        "h_trag",
        f"{PAHL}, Fig. 8",
        unit="mm",
        default=None,
        ge=0.05,
        le=200,
        tolerance=0.05,
        text="load-carrying tooth height, the length of the contact line",
        default_text="2 modules",
        assumed="2 modules; the paper gives none",
    )
    crowning_ratio: float = quantity(
        "crowning ratio",
        "ε",
        PAHL,
        default=1.0,
        ge=0.2,
        le=1e3,
        text="crowning radius over pitch radius; 1 is heavily crowned, 10 slightly",
    )
    hub_distance: float = quantity(
        "distance of the tooth planes",
        "l_H",
        f"{PAHL}, Fig. 13",
        unit="mm",
        default=200.0,
        ge=1,
        le=20000,
        tolerance=0.5,
        text="distance of the two tooth planes",
        assumed="typical value; give that of your coupling",
    )
    tooth_stiffness: float = quantity(
        "tooth pair stiffness",
        "c_t",
        unit="n_per_um",
        default=None,
        ge=0.1,
        le=1e5,
        text="tangential stiffness of one tooth pair",
        default_text="280 N/µm times E/206 GPa",
        assumed="about 14 N/(mm µm) by ISO 6336-1 over 20 mm of effective width, times E/206 GPa",
        equation="C7",
    )
    sleeve_mass: float = quantity(
        "sleeve mass per mesh",
        "m_s",
        unit="kg",
        default=4.0,
        ge=1e-3,
        le=1e4,
        text="mass carried by one mesh, half the sleeve",
        assumed="typical value; give that of your coupling",
    )
    pitch_errors: tuple[float, ...] | None = quantity(
        "pitch deviations",
        "p_i",
        f"{PAHL}, Fig. 4",
        unit="um",
        default=None,
        ge=-1e4,
        le=1e4,
        length=(1, 1000),
        text="pitch deviations, one per tooth, positive = early, carries more",
        default_text="none",
        tolerance=1,
    )
    youngs_modulus: float = quantity(
        "Young's modulus of the teeth", "E", unit="gpa", default=206.0, ge=1, le=2000, assumed="steel"
    )
    poisson_ratio: float = quantity(
        "Poisson's ratio of the teeth", "ν", default=0.3, ge=0, lt=0.5, assumed="steel", tolerance=0.01
    )

    def __post_init__(self) -> None:
        """Replace None in face width, tooth height and tooth stiffness by the default values."""
        defaults = {
            "face_width": 8 * self.module,
            "tooth_height": 2 * self.module,
            "tooth_stiffness": STEEL_TOOTH_STIFFNESS * self.youngs_modulus / STEEL,
        }
        for name, default in defaults.items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, default)


@record
class Operation:
    """Operating point: torque, speed, tilt and arrangement.

    The `arrangement` is `single` for one mesh, `parallel_offset` (Z) for two hubs that tilt in the same direction
    against the sleeve, or `angular` (M) for two hubs that tilt in opposite directions.
    """

    torque: float = quantity(
        "transmitted torque", "T", PAHL, unit="n_m", ge=0, le=1e8, tolerance=1, relative_tolerance=0.05
    )
    speed: float = quantity(
        "speed",
        "n",
        PAHL,
        unit="rpm",
        ge=-1e5,
        le=1e5,
        text="speed; the sign is the sense of rotation",
        tolerance=1,
        relative_tolerance=0.01,
    )
    axial_velocity: float = quantity(
        "axial velocity",
        "v_ax",
        PAHL,
        unit="mm_per_s",
        default=0.0,
        ge=-1e4,
        le=1e4,
        text="axial speed of hub against sleeve at each mesh; positive: the shafts move apart",
        tolerance=0.1,
    )
    arrangement: Arrangement = quantity(
        "arrangement",
        None,
        f"{PAHL}, Fig. 13",
        default="single",
        text="one mesh; two with parallel offset (Z); two with an angle (M)",
    )
    shaft_diameter: float | None = quantity(
        "shaft diameter",
        "D",
        "API 671/617 practice, quoted, not verified against the standard",
        unit="mm",
        default=None,
        ge=1,
        le=2000,
        text="for the customary thrust 0.25 T/D",
        default_text="no customary thrust",
    )
    misalignment: float = quantity(
        "misalignment",
        "δ_HS",
        PAHL,
        unit="deg",
        kw_only=True,
        ge=-6,
        le=6,
        tolerance=0.005,
        text="tilt of hub against sleeve at one mesh",
    )


def tilt_of_offset(parallel_offset: float, hub_distance: float) -> float:
    """Compute the tilt of the hubs of two shafts with a parallel offset.

    Parameters
    ----------
    parallel_offset : float
        Offset of the shafts [m].
    hub_distance : float
        Distance between the tooth planes [m].

    Returns
    -------
    float
        Tilt of the hub against the sleeve at each mesh [rad].

    Examples
    --------
    >>> round(tilt_of_offset(0.3e-3, 0.3), 6)
    0.001
    """
    return atan(parallel_offset / hub_distance)


@record
class Lubricant:
    """Oil at the teeth; the default is the viscosity of ISO VG 46 near 50 C."""

    viscosity: float = quantity(
        "oil viscosity at the teeth", "η", f"{PAHL}, Fig. 8", unit="pa_s", default=0.025, ge=1e-5, le=100
    )
    reference_film: float = quantity(
        "reference film thickness",
        "h_0",
        f"{PAHL}, Fig. 8",
        unit="um",
        default=1.0,
        ge=1e-3,
        le=1000,
        text="film thickness at which the load capacity is stated",
    )
    viscosity_index: float | None = described(
        "Viscosity index of an oil by grade or data sheet; reported, not used [-].", default=None
    )
    temperature: float | None = quantity(
        "oil temperature at the teeth",
        "θ_oil",
        unit="c",
        default=None,
        ge=-50,
        le=300,
        tolerance=5,
        text="temperature of an oil given by grade or data sheet; for the report only",
    )


@record
class MixedFrictionCurve:
    """Our own law of mixed friction: the coefficient falls from `highest` at rest to `lowest` at `velocity` [m/s].

    The defaults of `highest` and `lowest` are the ends of the paper's friction band in area 1.1. The default of
    `velocity` is chosen so that the friction of the heavily crowned coupling in Fig. 11 is lowest at 0.4 degrees and
    200 rad/s. The paper does not state the speed of this coupling.
    """

    highest: float = quantity(
        "highest mixed friction",
        "μ_max",
        f"{PAHL}, Fig. 9",
        default=0.1,
        ge=1e-4,
        le=2,
        relative_tolerance=0.3,
        text="coefficient at rest, and the most at high velocity",
    )
    lowest: float = quantity(
        "lowest mixed friction",
        "μ_min",
        f"{PAHL}, Fig. 9",
        default=0.05,
        ge=1e-4,
        le=2,
        relative_tolerance=0.3,
        text="least coefficient",
    )
    velocity: float = quantity(
        "velocity of least friction",
        "v_G,min",
        f"{PAHL}, Fig. 10",
        unit="m_per_s",
        default=0.11,
        ge=1e-4,
        le=1000,
        text="largest sliding velocity at which the coefficient is least",
        assumed=(
            "calibrated so that the paper's heavily crowned coupling has least friction at 0.4° and 200 "
            "1/s; the paper prints neither the points of Fig. 10 nor the speed of Fig. 11"
        ),
    )


@record
class MixedFrictionTable:
    """Measured coefficients of mixed friction; the coefficient is constant outside the range of sliding velocities.

    A single point is sufficient.
    """

    sliding_velocity: tuple[float, ...] = quantity(
        "table of sliding velocities",
        "v_G",
        unit="m_per_s",
        ge=0,
        le=1000,
        length=(1, 1000),
        text="sliding velocities, rising",
        tolerance=0.01,
        relative_tolerance=0.01,
    )
    coefficient: tuple[float, ...] = quantity(
        "table of coefficients of friction",
        "μ",
        ge=1e-4,
        le=2,
        length=(1, 1000),
        relative_tolerance=0.3,
        text="coefficients of friction",
    )


@record
class Friction:
    """Friction between the teeth: either coefficients that the user gives, or the law of the friction regime."""

    coefficient: float | None = quantity(
        "coefficient of friction",
        "μ",
        f"{PAHL}, Fig. 9",
        default=None,
        ge=0,
        le=2,
        default_text="the law of the friction regime",
        assumed=(
            "from the friction regime; our law keeps the paper's bands except in area 1.2, where it rises "
            "steadily from mixed friction to the paper's 0.1 so that the thrust does not jump"
        ),
        tolerance=0.02,
        relative_tolerance=0.3,
    )
    static_coefficient: float | None = quantity(
        "coefficient of friction at rest",
        "μ_s",
        PAHL,
        default=None,
        ge=0,
        le=2,
        default_text="the given coefficient; without one, that of the law at rest without a film",
        assumed="0.16, the law of the friction regime at rest without a film",
        tolerance=0.02,
        relative_tolerance=0.3,
    )
    mixed_law: MixedFrictionTable | None = quantity(
        "table of mixed friction",
        None,
        f"{PAHL}, Fig. 10",
        default=None,
        text="table that replaces the curve of mixed friction",
    )
    mixed_curve: MixedFrictionCurve = quantity(
        "curve of mixed friction",
        None,
        f"{PAHL}, Fig. 10",
        default_factory=MixedFrictionCurve,
        text="mixed-lubrication branch of the law",
    )

    @property
    def law(self) -> MixedFrictionCurve | MixedFrictionTable:
        """The law of mixed friction in use: the table if there is one, otherwise the curve."""
        return self.mixed_curve if self.mixed_law is None else self.mixed_law


@record
class ModelOptions:
    """Options for parts of the model that the paper does not define clearly."""

    kinematics: KinematicModel = quantity(
        "kinematics of the teeth",
        None,
        PAHL,
        default="tangential",
        text="tangential: as the paper describes; spatial: exact to first order, with the pivot motion",
        advanced=True,
    )
    sleeve: SleeveSupport = quantity(
        "support of the sleeve",
        default="centred",
        text="sleeve of a single mesh: held on centre, or floating into its equilibrium",
        advanced=True,
    )
    inlet: InletModel = quantity(
        "limit of the oil inlet",
        "b_Ix",
        f"{PAHL}, Fig. 8",
        default="face",
        text="what limits the oil inlet: the face ahead of the contact, the travel of the contact, or nothing",
        assumed="the paper does not define the inlet length",
        advanced=True,
    )
    inlet_length: float | None = quantity(
        "inlet length",
        "b_Ix",
        unit="mm",
        default=None,
        ge=1e-3,
        le=2000,
        text="inlet length instead of the limit of the oil inlet",
        default_text="follows from the limit of the oil inlet",
        advanced=True,
    )
    film_angle: float | None = quantity(
        "tooth angle of the film",
        "φ",
        f"{PAHL}, Fig. 8",
        unit="deg",
        default=None,
        ge=-360,
        le=360,
        text="tooth angle whose hydrodynamic velocity builds the film, 90 at the tilt position",
        default_text="that of the largest hydrodynamic velocity",
        assumed="that of the largest hydrodynamic velocity of a revolution; the paper does not say which it takes",
        advanced=True,
        tolerance=1,
    )
    rotor_angle: float = quantity(
        "rotor angle of the tooth forces", "θ", unit="deg", default=0.0, ge=-360, le=360, advanced=True, tolerance=0.1
    )
    simple_thrust_factor: float = quantity(
        "share of the sleeve force in the one-pair model",
        "κ",
        f"{PAHL}, Fig. 13",
        default=1.0,
        ge=0,
        le=10,
        text="share of the sleeve force that the one-pair model of self-induced thrust turns into tooth forces",
        assumed="all of it; the paper does not state the share",
        advanced=True,
        tolerance=0.1,
    )


@record
class CouplingInputs:
    """One coupling at one operating point."""

    coupling: Coupling
    operation: Operation
    lubricant: Lubricant = field(default_factory=Lubricant)
    friction: Friction = field(default_factory=Friction)
    model: ModelOptions = field(default_factory=ModelOptions)


@record
class RecommendationInputs:
    """Inputs of the search for the best crowning ratio over a range of misalignment.

    The smallest misalignment must be above zero, and must not exceed the largest. `design` contains all other inputs.
    The search ignores the crowning ratio and the misalignment of `design`.
    """

    design: CouplingInputs
    min_misalignment: float = described("Least misalignment of the range [rad].")
    max_misalignment: float = described("Largest misalignment of the range [rad].")


def check_inputs(inputs: CouplingInputs) -> None:
    """Raise InvalidInput (`out_of_range`, `pitch_errors_length`, `mixed_law`, `mixed_curve`)."""
    if not abs(inputs.operation.misalignment) <= MAX_MISALIGNMENT:
        raise InvalidInput(
            "out_of_range",
            "the theory holds for small angles only; give a misalignment within 6 degrees",
            "misalignment",
        )
    if 0.0 < inputs.operation.torque < LEAST_TORQUE:
        raise InvalidInput(
            "out_of_range",
            f"a torque below {LEAST_TORQUE:g} N m is too small to be a load; give either 0 or at least "
            f"{LEAST_TORQUE:g} N m",
            "torque",
        )
    _check_pitch_errors(inputs)
    if isinstance(inputs.friction.law, MixedFrictionTable):
        _check_mixed_table(inputs.friction.law)
    else:
        _check_mixed_curve(inputs.friction.law)


def _check_pitch_errors(inputs: CouplingInputs) -> None:
    """Check that there is one finite pitch deviation per tooth."""
    errors = inputs.coupling.pitch_errors
    if errors is None:
        return
    if len(errors) != inputs.coupling.teeth:
        raise InvalidInput(
            "pitch_errors_length",
            f"give one pitch deviation for each tooth, {inputs.coupling.teeth} values in total",
            "pitch_errors",
        )
    if not all(isfinite(error) for error in errors):
        raise InvalidInput("out_of_range", "all pitch deviations must be finite numbers", "pitch_errors")


def _check_mixed_curve(law: MixedFrictionCurve) -> None:
    """Check that the lowest coefficient does not exceed the highest coefficient."""
    if law.lowest > law.highest:
        raise InvalidInput(
            "mixed_curve",
            "the lowest coefficient of friction must not exceed the highest coefficient of friction",
            "lowest",
        )


def _check_mixed_table(law: MixedFrictionTable) -> None:
    """Check that the velocities are not negative and rise, and that there is one positive coefficient per velocity."""
    velocities, coefficients = law.sliding_velocity, law.coefficient
    rising = all(a < b for a, b in pairwise(velocities))
    if len(velocities) != len(coefficients) or not velocities or not rising or not velocities[0] >= 0.0:
        raise InvalidInput(
            "mixed_law",
            "give velocities of at least 0 in rising order, and one coefficient of friction for each velocity",
            "mixed_law",
        )
    if not isfinite(velocities[-1]) or not all(0.0 < coefficient < inf for coefficient in coefficients):
        raise InvalidInput(
            "mixed_law",
            "the velocities must be finite, and the coefficients of friction must be positive and finite",
            "mixed_law",
        )
