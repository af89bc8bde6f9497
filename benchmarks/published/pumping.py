"""Pumping of the air-oil mist: Milian, Distretti, Leoni and Velex 2004."""

from dataclasses import replace
from math import log2

from benchmarks.published.milian import CASE_1, CASE_2, GROOVE, PRINTED, SPEED_1, SPEED_2, TABLE_1, TIP, pinion, run
from benchmarks.published.statement import Says, Statement
from solvers.pumping import Flow, Groove, PumpingModel, PumpingResult

MILIAN = "Milian 2004"
CASES = {1: (CASE_1, SPEED_1), 2: (CASE_2, SPEED_2)}


def case(
    number: int,
    speed: float | None = None,
    grooves: tuple[Groove, ...] = (),
    model: PumpingModel = PRINTED,
    face_width: float = 0.2,
) -> PumpingResult:
    """Solve case 1 or case 2 of the paper. `speed` is the speed of the pinion [rpm], by default the paper's speed."""
    gears, own = CASES[number]
    return run(replace(gears, face_width=face_width), own if speed is None else speed, model, grooves=grooves)


def table_1(flow: Flow = Flow.INCOMPRESSIBLE, discharge: float = 1.0, slices: int | None = None) -> PumpingResult:
    """Solve the spur gears of Table 1 at 1000 rpm; the calculation includes the tip gaps."""
    return run(TABLE_1, 1000.0, replace(TIP, flow=flow, discharge_coefficient=discharge), slices, 0.0)


def _rise(result: PumpingResult) -> float:
    return pinion(result).max_temperature_rise or 0.0


def _hottest(number: int) -> float:
    return (pinion(case(number)).hottest_position or 0.0) / 0.2


def _relief(number: int) -> float:
    """Return the fraction by which a groove reduces the temperature rise in case `number` of the paper."""
    return 1.0 - _rise(case(number, grooves=GROOVE)) / _rise(case(number))


def _end_slices_over_front() -> float:
    profile = pinion(case(1)).profile.temperature_rise
    assert profile is not None
    return float(profile[-1] / profile[0])


def _exponent() -> float:
    return log2(pinion(case(1, 2000.0)).pumping_power / pinion(case(1, 1000.0)).pumping_power)


def _wider(width: float) -> float:
    return pinion(case(1, face_width=width)).pumping_power / 1e3


def _closed_pocket() -> float:
    result = table_1(Flow.POCKET_CHAIN, 0.0, 1)
    stroke = pinion(result).stroke
    return float(pinion(result).peak_pressure_ratio / (stroke.max_area / stroke.min_area) ** 1.4)


STATEMENTS: tuple[Statement, ...] = (
    Says(
        f"{MILIAN}, Table 2", "round centre distance of case 1 without backlash: the module is the normal one"
    ).calculated(590.0, "mm", lambda: case(1).geometry.backlash_free_centre_distance * 1e3, 1e-4),
    Says(f"{MILIAN}, Table 3", "and of case 2").calculated(
        455.0, "mm", lambda: case(2).geometry.backlash_free_centre_distance * 1e3, 1e-4
    ),
    Says(f"{MILIAN}, Fig. 3", "space between the teeth at the start of its stroke").calculated(
        162.25, "mm²", lambda: pinion(table_1()).stroke.max_area * 1e6, 2e-4
    ),
    Says(f"{MILIAN}, Fig. 3", "and at its narrowest").calculated(
        12.158, "mm²", lambda: pinion(table_1()).stroke.min_area * 1e6, 2e-4
    ),
    Says(
        f"{MILIAN}, Eq. 1", "isentropic compression of a closed space: pressure ratio over (S_start/S_min)^1.4"
    ).calculated(1.0, "-", _closed_pocket, 1e-4),
    Says(f"{MILIAN}, after Rosen", "power of incompressible flow at 1000 rpm").calculated(
        1.9462, "W", lambda: table_1().total.pumping_power, 3e-3
    ),
    Says(f"{MILIAN}, discussion", "nearly no effect at low speed: rise at 1000 rpm").below(
        0.3, "K", lambda: _rise(case(1, 1000.0))
    ),
    Says("gas dynamics", "power grows as the cube of a low speed: exponent").calculated(3.0, "-", _exponent, 0.02),
    Says(
        f"{MILIAN}, Eq. 7", "at the test speed of case 1 the flow is sonic: pressure ratio above the critical one"
    ).above(1.8929, "-", lambda: pinion(case(1)).peak_pressure_ratio),
    Says(f"{MILIAN}, Eq. 7", "and in case 2").above(1.8929, "-", lambda: pinion(case(2)).peak_pressure_ratio),
    Says(f"{MILIAN}, Table 2", "peak pressure of case 1").calculated(
        2.7051, "-", lambda: pinion(case(1)).peak_pressure_ratio, 2e-3
    ),
    Says(f"{MILIAN}, Fig. 5", "overheating close to the trailing end: place of the maximum, case 1").between(
        0.7, 0.9, "of b", lambda: _hottest(1)
    ),
    Says(f"{MILIAN}, Fig. 6", "and in case 2").between(0.7, 0.9, "of b", lambda: _hottest(2)),
    Says(f"{MILIAN}, Fig. 5", "rear end hotter than the front end: ratio of the rises").above(
        1.0, "-", _end_slices_over_front
    ),
    Says(f"{MILIAN}, conclusion", "case 2 suffers more: rise over that of case 1").above(
        1.0, "-", lambda: _rise(case(2)) / _rise(case(1))
    ),
    Says(f"{MILIAN}, Fig. 5", "a groove in the middle reduces the heating, case 1").between(
        0.4, 0.6, "-", lambda: _relief(1)
    ),
    Says(f"{MILIAN}, Fig. 6", "and in case 2").between(0.4, 0.6, "-", lambda: _relief(2)),
    Says(f"{MILIAN}, introduction", "wide faces suffer: power at 400 mm over power at 100 mm").above(
        4.0, "-", lambda: _wider(0.4) / _wider(0.1)
    ),
    Says(f"{MILIAN}, Table 2", "axial meshing speed of case 1 over the speed of sound").calculated(
        2.0, "-", lambda: case(1).total.axial_meshing_mach or 0.0, 0.02
    ),
    Says(f"{MILIAN}, Eq. 3", "with the gaps as printed (tips) the flow stays subsonic: Mach number").below(
        1.0, "-", lambda: pinion(case(1, model=TIP)).peak_axial_mach
    ),
)
