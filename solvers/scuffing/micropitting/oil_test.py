"""Film ratio of the test gears C-GF in the micropitting test of an oil, at the failure load stage."""

from functools import cache
from math import pi

import numpy as np

from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.scuffing.inputs import (
    FlankSurface,
    Load,
    LoadDistributionInputs,
    MicropittingCheck,
    OilSupply,
    StandardFactors,
)
from solvers.scuffing.load_factors.method_b import load_factors
from solvers.scuffing.micropitting.results import FilmOfTest
from solvers.scuffing.micropitting.standard import StandardFilms, characteristic_points, solve_standard

STAGE_TORQUE = {5: 70.0, 6: 98.9, 7: 132.5, 8: 171.6, 9: 215.6, 10: 265.1}  # N m, pinion torque of each load stage
SPEED = 2250.0 * pi / 30  # rad/s
OIL_TEMPERATURE = 363.15  # K
SUPPLY: OilSupply = "spray"
QUALITY_GRADE = 7
LINE_LOAD_FACTOR = 1.2665
"""Line load at A over X F_bt/b: a program prints 236.3 N/mm, not 186.6, at stage 10.

It is the load sharing at A: 0.42 instead of X = 1/3, the same at all stages; our load distribution has 0.41 there.
"""
FACE_LOAD_FACTOR = 1.11
"""K_Hbeta of the mean coefficient of friction: makes the bulk temperature of 127.7 C that the program prints.

K_v of method B, 1.045 at stage 10, raises pressure and friction: the contact temperature is then the printed 251.7 C.
"""
STEEL = Solid(
    youngs_modulus=206e9,
    poisson_ratio=0.3,
    density=7800.0,
    specific_heat=440.0,
    thermal_conductivity=45.0,
    roughness=0.5e-6,
)
PERMISSIBLE_SHARE = 1.4  # permissible film ratio divided by the film ratio in the test, if the material factor is 1
SURFACE_FACTOR: dict[FlankSurface, float] = {
    "case_hardened": 1.0,
    "case_hardened_retained_austenite": 0.95,
    "nitrided": 1.5,
    "induction_hardened": 0.65,
    "through_hardened": 0.5,
}
"""Material factor W_W of each surface."""


def _teeth(count: int, tip_diameter: float, profile_shift: float) -> GearTeeth:
    """Return the teeth of a test gear with a given tip diameter [mm]; the module is 4.5 mm."""
    return GearTeeth(count, profile_shift, (tip_diameter - 4.5 * count) / 9.0 - profile_shift)


GEARS = GearPairInputs(
    _teeth(16, 82.46, 0.1817),
    _teeth(24, 118.36, 0.1715),
    module=4.5e-3,
    face_width=14e-3,
    centre_distance=91.5e-3,
    rack_tip_radius=GROUND_FILLET,
)


@cache
def films_of_test(oil: OilSheet | Lubricant, stage: int) -> StandardFilms:
    """Compute the films at the points of the path of the test gears, for an oil and a load stage."""
    given = LoadDistributionInputs(GEARS, Load(STAGE_TORQUE[stage], SPEED), pinion_material=STEEL, wheel_material=STEEL)
    path = meshing_path(GEARS)
    dynamic = load_factors(given, path, StandardFactors(quality_grade=QUALITY_GRADE), FACE_LOAD_FACTOR).dynamic_factor
    torque = dynamic * STAGE_TORQUE[stage]
    return solve_standard(
        given, path, oil, OIL_TEMPERATURE, SUPPLY, QUALITY_GRADE, FACE_LOAD_FACTOR * torque, LINE_LOAD_FACTOR * torque
    )


def film_of_test(oil: OilSheet | Lubricant, stage: int) -> FilmOfTest:
    """Return the thinnest film between the test gears, for an oil and the load stage at which this oil fails."""
    standard = films_of_test(oil, stage)
    place = int(np.argmin(standard.films.ratio))
    return FilmOfTest(
        ratio=float(standard.films.ratio[place]),
        bulk=standard.bulk,
        friction_coefficient=standard.friction,
        torque=STAGE_TORQUE[stage],
        at_point=[*characteristic_points(meshing_path(GEARS))][place],
    )


def permissible_ratio(check: MicropittingCheck, test: FilmOfTest | None) -> float | None:
    """Return the permissible film ratio of the flanks.

    Eq. M14 of the chapter on micropitting; formula 3 of ISO/TR 15144-1. `test`: film in the test of the oil; None if no
    failure load stage is given. Returns permissible film ratio [-]. If `test` is given, the ratio follows from the film
    in the test. Otherwise the ratio is the permissible ratio in `check`, which may be None.
    """
    if test is None:
        return check.permissible_ratio
    factor = check.material_factor
    if factor is None:
        factor = min(SURFACE_FACTOR[check.surface.pinion], SURFACE_FACTOR[check.surface.wheel])
    return PERMISSIBLE_SHARE * factor * test.ratio
