"""Micropitting by method B of ISO/TR 15144-1: FZG C gears, the gears of the oil test, a wind turbine stage.

Some of the printed numbers for the FZG C gears are results of an FVA program; those of the test gears and of the
turbine stage stand in the report of another program.
"""

from collections.abc import Callable
from functools import cache, partial
from math import copysign, pi

import numpy as np

from benchmarks.published import standard
from benchmarks.published.standard import TURBINE
from benchmarks.published.statement import Says, Statement
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.scuffing.inputs import Load, LoadDistributionInputs
from solvers.scuffing.micropitting import oil_test
from solvers.scuffing.micropitting.film import Conditions, films
from solvers.scuffing.micropitting.mean_values import bulk_temperature, loss_factor, mean_friction
from solvers.scuffing.micropitting.standard import (
    StandardFilms,
    characteristic_points,
    contacts_under,
    load_sharing,
    solve_standard,
)
from solvers.scuffing.thermal.practice import OIL_SUPPLY_FACTOR

REPORT = "ISO/TR 15144-1:2014, secondary source"
FVA = "report of an FVA program"
DIAGRAM = "printed diagram of permissible ratios"
READING = 0.003  # accuracy of what was read from the diagram
ZERO = 273.15  # K
PRINTED = 1e-3  # relative tolerance of printed numbers
POINTS = ("A", "AB", "B", "C", "D", "DE", "E")


def mineral(grade: float, thin: float, density_15: float | None = None) -> OilSheet:
    """Return a mineral oil. `grade` and `thin` are its kinematic viscosities at 40 and 100 C [mm^2/s]."""
    return OilSheet(grade * 1e-6, thin * 1e-6, density_15=density_15)


@cache
def fzg_c() -> StandardFilms:
    """Return the films of FZG C gears under a load with K_v = 1.03 and K_Hbeta = 1.32."""
    pinion, wheel = (
        GearTeeth(z, x, (tip - 4.5 * z) / 9 - x) for z, tip, x in ((16, 82.45, 0.1817), (24, 118.35, 0.1715))
    )
    gears = GearPairInputs(
        pinion, wheel, module=4.5e-3, face_width=14e-3, centre_distance=91.5e-3, rack_tip_radius=GROUND_FILLET
    )
    steel = Solid(210e9, 0.3, 7800.0, 440.0, 45.0, 0.3e-6)
    load = Load(3611.1 * 0.036, 1500 * pi / 30, dynamic_factor=1.03, mesh_load_factor=1.32)
    given = LoadDistributionInputs(gears, load, pinion_material=steel, wheel_material=steel)
    oil = mineral(90.02, 10.41, 884.1)
    return solve_standard(given, meshing_path(gears), oil, 60 + ZERO, "dip", 7, given.load.contact_torque)


ASKED_FOR = {
    (32, 5.4): (0.134, 0.113, 0.094, 0.078, 0.066, 0.055),
    (100, 11.2): (0.254, 0.213, 0.175, 0.146, 0.121, 0.101),
    (220, 19.0): (0.398, 0.331, 0.271, 0.224, 0.185, 0.153),
    (460, 30.6): (0.567, 0.464, 0.375, 0.304, 0.245, 0.201),
}
"""Permissible film ratios at the load stages 5 to 10, read with an accuracy of 0.003 from `DIAGRAM`.

A film ratio is film thickness divided by roughness. The keys are the kinematic viscosities of a mineral oil at 40 and
100 C [mm^2/s].
"""


def permissible_over_asked() -> list[float]:
    """Return the permissible film ratios of case-hardened flanks over those in `ASKED_FOR`.

    The reading accuracy of 0.003 is taken off the difference.
    """
    return [
        1.0 + _beyond(oil_test.PERMISSIBLE_SHARE * oil_test.film_of_test(mineral(*oil), stage).ratio - ratio) / ratio
        for oil, ratios in ASKED_FOR.items()
        for stage, ratio in enumerate(ratios, 5)
    ]


def _beyond(difference: float) -> float:
    return copysign(max(abs(difference) - READING, 0.0), difference)


def of_the_test() -> StandardFilms:
    """Return the films of the test gears at stage 10 with the oil VG 220 of the turbine stage."""
    return oil_test.films_of_test(mineral(220, 19.0, 890.0), 10)


def _load_at_a() -> float:
    """Line load of the test gears at A [N/mm]."""
    films, path = of_the_test(), meshing_path(oil_test.GEARS)
    torque = oil_test.LINE_LOAD_FACTOR * oil_test.STAGE_TORQUE[10]
    return float(films.force_ratio[0]) * torque / path.pair.pinion.base_radius / oil_test.GEARS.face_width * 1e-3


@cache
def turbine() -> StandardFilms:
    """Return the films of the turbine stage with K_A 1.25 and the load factors that make its printed friction.

    The bulk temperature has the tip relief factor X_Ca of relieved flanks of class 6 (formula 100), although the load
    sharing has none: 1.053 is printed, and X_Ca = 1 makes 0.988.
    """
    mesh = standard.turbine()
    given, grade = mesh.given, mesh.grade
    torque = 1.25 * mesh.factors.product * given.load.torque
    path, oil, warm = meshing_path(given.gears), mineral(220, 19.0, 890.0), 80 + ZERO
    friction = mean_friction(given, path, oil, warm, torque)
    rise = bulk_temperature(given, path, warm, "spray", friction) - warm
    longer = max(path.end - path.pitch_point, path.pitch_point - path.start) / path.plane.base_pitch
    bulk = warm + rise / (1.0 + 0.24 * longer + 0.71 * longer**2)
    x = np.array([*characteristic_points(path).values()])
    sharing = load_sharing(path, x, grade)
    contacts = contacts_under(given, path, x, sharing, torque)
    conditions = Conditions(oil, bulk, friction, given.pinion_material, given.wheel_material)
    return StandardFilms(friction, bulk, loss_factor(path), sharing, contacts, films(conditions, contacts))


def _pressure(solve: Callable[[], StandardFilms], point: str) -> float:
    return float(solve().contacts.pressure[POINTS.index(point)]) * 1e-6


def _ratio(solve: Callable[[], StandardFilms], point: str) -> float:
    return float(solve().films.ratio[POINTS.index(point)])


def _of_case(
    words: str, solve: Callable[[], StandardFilms], friction: float, bulk: float, ratios: dict[str, float]
) -> tuple[Statement, ...]:
    """Return the statements in `REPORT` about the films that `solve` computes.

    `words` is the name of the case in the statements. `friction` [-], `bulk` [°C] and `ratios` [-] are the numbers that
    the report prints: coefficient of friction, bulk temperature, and film ratios at points of the path.
    """
    return (
        Says(REPORT, f"mean coefficient of friction, {words}").equals(friction, "-", lambda: solve().friction, PRINTED),
        Says(REPORT, f"bulk temperature, {words}").equals(bulk, "°C", lambda: solve().bulk - ZERO, PRINTED),
        *(
            Says(REPORT, f"film over roughness at {point}, {words}").equals(
                printed, "-", partial(_ratio, solve, point), PRINTED
            )
            for point, printed in ratios.items()
        ),
    )


STATEMENTS: tuple[Statement, ...] = (
    *_of_case("FZG C gears", fzg_c, 0.05764, 72.36, {"A": 0.3498, "C": 0.6530, "E": 0.5922}),
    *(
        Says(FVA, f"Hertzian pressure at {point}, FZG C gears").equals(
            printed, "MPa", partial(_pressure, fzg_c, point), PRINTED
        )
        for point, printed in (("A", 1080.9), ("C", 1279.4), ("E", 771.6))
    ),
    Says(FVA, "loss factor, FZG C gears").equals(0.195, "-", lambda: fzg_c().loss_factor, 3e-3),
    Says(FVA, "bulk temperature, FZG C gears").equals(72.1, "°C", lambda: fzg_c().bulk - ZERO, 4e-3),
    Says(TURBINE, "torque of the test gears at stage 10").prints("265.1", "N m", lambda: oil_test.STAGE_TORQUE[10]),
    Says(TURBINE, "line load of the test gears at A, stage 10").prints("236.3", "N/mm", _load_at_a),
    Says(TURBINE, "lubrication system factor of the test gears").prints(
        "1.2", "-", lambda: OIL_SUPPLY_FACTOR[oil_test.SUPPLY]
    ),
    Says(TURBINE, "bulk temperature of the test gears, VG 220, stage 10").prints(
        "127.7", "°C", lambda: of_the_test().bulk - ZERO
    ),
    Says(TURBINE, "contact temperature of the test gears at A, VG 220, stage 10").prints(
        "251.7", "°C", lambda: of_the_test().bulk + float(of_the_test().films.flash[0]) - ZERO
    ),
    Says(TURBINE, "film of the test gears at A, VG 220, stage 10").prints(
        "0.051", "µm", lambda: float(of_the_test().films.film[0]) * 1e6
    ),
    Says(TURBINE, "film over roughness of the test gears, VG 220, stage 10").prints(
        "0.102", "-", lambda: float(of_the_test().films.ratio.min())
    ),
    Says(TURBINE, "permissible film ratio, VG 220, stage 10").prints(
        "0.143", "-", lambda: oil_test.PERMISSIBLE_SHARE * float(of_the_test().films.ratio.min())
    ),
    Says(TURBINE, "transverse contact ratio of the stage").prints(
        "1.463", "-", lambda: meshing_path(standard.TURBINE_STAGE).transverse_contact_ratio
    ),
    Says(TURBINE, "load sharing factor at A of the stage").prints(
        "0.889", "-", lambda: float(turbine().force_ratio[0])
    ),
    # The K_Halpha K_Hbeta of the printed friction is known to 0.6 %, which is 0.2 % of the film.
    Says(TURBINE, "thinnest film ratio of the stage").equals(
        1.053, "-", lambda: float(turbine().films.ratio.min()), 5e-3
    ),
    Says(TURBINE, "safety factor of the printed film ratio").equals(
        7.36, "-", lambda: 1.053 / (oil_test.PERMISSIBLE_SHARE * float(of_the_test().films.ratio.min())), 5e-3
    ),
    Says(DIAGRAM, "permissible film ratio over the diagram's, mineral oils: least").between(
        0.93, 1.07, "-", lambda: min(permissible_over_asked())
    ),
    Says(DIAGRAM, "permissible film ratio over the diagram's, mineral oils: largest").between(
        0.93, 1.07, "-", lambda: max(permissible_over_asked())
    ),
)
