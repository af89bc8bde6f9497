"""Micropitting by method B of ISO/TR 15144-1, for two gear pairs: the gears of the oil test, and FZG C gears.

Some of the printed numbers for the FZG C gears are results of an FVA program.
"""

from collections.abc import Callable
from functools import cache, partial
from math import pi

from benchmarks.published.statement import Says, Statement
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.materials import Solid
from solvers.oils import OilSheet
from solvers.scuffing.inputs import Load, LoadDistributionInputs
from solvers.scuffing.micropitting import oil_test
from solvers.scuffing.micropitting.standard import StandardFilms, solve_standard

REPORT = "ISO/TR 15144-1:2014, secondary source"
FVA = "report of an FVA program"
DIAGRAM = "printed diagram of permissible ratios"
ZERO = 273.15  # K
PRINTED = 1e-3  # relative tolerance of printed numbers
POINTS = ("A", "AB", "B", "C", "D", "DE", "E")


def mineral(grade: float, thin: float, density_15: float | None = None) -> OilSheet:
    """Return a mineral oil. `grade` and `thin` are its kinematic viscosities at 40 and 100 C [mm^2/s]."""
    return OilSheet(grade * 1e-6, thin * 1e-6, density_15=density_15)


@cache
def gears_of_the_test() -> StandardFilms:
    """Return the films of the gears of the oil test (type C-GF) at load stage 8 with an oil of ISO VG 220."""
    load = Load(oil_test.STAGE_TORQUE[8], oil_test.SPEED)
    given = LoadDistributionInputs(oil_test.GEARS, load, pinion_material=oil_test.STEEL, wheel_material=oil_test.STEEL)
    return solve_standard(given, meshing_path(oil_test.GEARS), mineral(220, 19.0), 90 + ZERO, "dip", 7)


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
    return solve_standard(given, meshing_path(gears), mineral(90.02, 10.41, 884.1), 60 + ZERO, "dip", 7)


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


def asked_over_test() -> list[float]:
    """Return the permissible film ratios in `ASKED_FOR`, divided by the film ratios in the oil test.

    The film ratios in the oil test are computed by the solvers for the same oil and load stage.
    """
    return [
        ratio / oil_test.film_of_test(mineral(*oil), stage).ratio
        for oil, ratios in ASKED_FOR.items()
        for stage, ratio in enumerate(ratios, 5)
    ]


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
    *_of_case("test gears at stage 8", gears_of_the_test, 0.06110, 111.09, {"A": 0.1898, "C": 0.3533, "E": 0.3217}),
    *_of_case("FZG C gears", fzg_c, 0.05764, 72.36, {"A": 0.3498, "C": 0.6530, "E": 0.5922}),
    *(
        Says(REPORT, f"film over roughness of the oil test, VG {grade}, stage {stage}").equals(
            printed,
            "-",
            partial(lambda oil, at: oil_test.film_of_test(oil, at).ratio, mineral(grade, thin), stage),
            PRINTED,
        )
        for grade, thin, stage, printed in (
            (100, 11.2, 8, 0.1255),
            (100, 11.2, 10, 0.0891),
            (320, 24.1, 8, 0.2287),
            (320, 24.1, 10, 0.1581),
        )
    ),
    *(
        Says(FVA, f"Hertzian pressure at {point}, FZG C gears").equals(
            printed, "MPa", partial(_pressure, fzg_c, point), PRINTED
        )
        for point, printed in (("A", 1080.9), ("C", 1279.4), ("E", 771.6))
    ),
    Says(FVA, "loss factor, FZG C gears").equals(0.195, "-", lambda: fzg_c().loss_factor, 3e-3),
    Says(FVA, "bulk temperature, FZG C gears").equals(72.1, "°C", lambda: fzg_c().bulk - ZERO, 4e-3),
    Says(DIAGRAM, "permissible over tested film, mineral oils: least").between(
        1.0, 1.3, "-", lambda: min(asked_over_test())
    ),
    Says(DIAGRAM, "permissible over tested film, mineral oils: largest").between(
        1.0, 1.3, "-", lambda: max(asked_over_test())
    ),
)
