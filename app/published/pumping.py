"""Pumping of the air-oil mist: Milian, Distretti, Leoni and Velex 2004.

The tables give no face width, backlash, groove or ambient: 200 mm, 0.3 mm, 16 mm, 101325 Pa and 50 C are assumed.
"""

from dataclasses import replace
from functools import cache
from math import log2, pi, radians

from app.published.statement import Statement, above, below, between, equals
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.pumping import (
    Flow,
    Gap,
    Groove,
    PumpingInputs,
    PumpingModel,
    PumpingResult,
    PumpingSetup,
    Spaces,
    solve,
)
from solvers.pumping.results import SpacesResult

MILIAN = "Milian 2004"
INDEPENDENT = "the paper shows a curve; the number is an independent calculation's"

TABLE_1 = GearPairInputs(
    GearTeeth(47, 0.291, 1.0, 1.475), GearTeeth(103, 0.322, 1.0, 1.474), 6.8e-3, 0.2, radians(22.5)
)
CASE_1 = GearPairInputs(
    GearTeeth(47, 0.16, 0.9919, 1.47921),
    GearTeeth(117, 0.05, 0.9925, 1.47885),
    7e-3,
    0.2,
    radians(20),
    radians(12.75),
    0.590,
)
CASE_2 = GearPairInputs(
    GearTeeth(52, 0.198, 0.9891, 1.47469),
    GearTeeth(79, 0.21, 0.9894, 1.47507),
    6.8e-3,
    0.2,
    radians(22.5),
    radians(10),
    0.455,
)
SPEEDS = {1: 9267.0, 2: 8962.0}  # rpm of the pinion
CONTACT = PumpingModel(wall_transport=False, spaces=Spaces.PINION)
TIP = replace(CONTACT, gap=Gap.TIP)
GROOVE = (Groove(0.1, 0.016),)


@cache
def case(
    number: int,
    speed: float | None = None,
    grooves: tuple[Groove, ...] = (),
    model: PumpingModel = CONTACT,
    face_width: float = 0.2,
) -> PumpingResult:
    """One of the paper's two cases at a speed [rpm], its own where none is given."""
    gears = replace(CASE_1 if number == 1 else CASE_2, face_width=face_width)
    setup = PumpingSetup(gears, 0.3e-3, grooves, model=model)
    return solve(PumpingInputs(setup, (SPEEDS[number] if speed is None else speed) * pi / 30))


@cache
def table_1(flow: Flow = Flow.INCOMPRESSIBLE, discharge: float = 1.0, slices: int | None = None) -> PumpingResult:
    """The spur gears of Table 1 with tip gaps at 1000 rpm."""
    model = replace(TIP, flow=flow, discharge_coefficient=discharge, slices=slices)
    return solve(PumpingInputs(PumpingSetup(TABLE_1, 0.0, model=model), 1000.0 * pi / 30))


def pinion(result: PumpingResult) -> SpacesResult:
    """The pinion's spaces, which are the paper's."""
    assert result.pinion_spaces is not None
    return result.pinion_spaces


def _rise(result: PumpingResult) -> float:
    return pinion(result).max_temperature_rise or 0.0


def _hottest(number: int) -> float:
    return (pinion(case(number)).hottest_position or 0.0) / 0.2


def _relief(number: int) -> float:
    """How much of the heating a groove takes away."""
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
    equals(
        "round centre distance of case 1 without backlash: the module is the normal one",
        f"{MILIAN}, Table 2",
        590.0,
        "mm",
        lambda: case(1).geometry.backlash_free_centre_distance * 1e3,
        1e-4,
    ),
    equals(
        "and of case 2",
        f"{MILIAN}, Table 3",
        455.0,
        "mm",
        lambda: case(2).geometry.backlash_free_centre_distance * 1e3,
        1e-4,
    ),
    equals(
        "space between the teeth at the begin of its stroke",
        f"{MILIAN}, Fig. 3",
        162.25,
        "mm²",
        lambda: pinion(table_1()).stroke.max_area * 1e6,
        2e-4,
        INDEPENDENT,
    ),
    equals(
        "and at its narrowest",
        f"{MILIAN}, Fig. 3",
        12.158,
        "mm²",
        lambda: pinion(table_1()).stroke.min_area * 1e6,
        2e-4,
        INDEPENDENT,
    ),
    equals(
        "isentropic compression of a closed space: pressure ratio over (S_start/S_min)^1.4",
        f"{MILIAN}, Eq. 1",
        1.0,
        "-",
        _closed_pocket,
        1e-4,
    ),
    equals(
        "power of incompressible flow at 1000 rpm",
        f"{MILIAN}, after Rosen",
        1.9462,
        "W",
        lambda: table_1().total.pumping_power,
        3e-3,
        INDEPENDENT,
    ),
    below(
        "nearly no effect at low speed: rise at 1000 rpm",
        f"{MILIAN}, discussion",
        0.3,
        "K",
        lambda: _rise(case(1, 1000.0)),
    ),
    equals("power grows as the cube of a low speed: exponent", "gas dynamics", 3.0, "-", _exponent, 0.02),
    above(
        "at the test speed of case 1 the flow is sonic: pressure ratio above the critical one",
        f"{MILIAN}, Eq. 7",
        1.8929,
        "-",
        lambda: pinion(case(1)).peak_pressure_ratio,
    ),
    above(
        "and in case 2",
        f"{MILIAN}, Eq. 7",
        1.8929,
        "-",
        lambda: pinion(case(2)).peak_pressure_ratio,
    ),
    equals(
        "peak pressure of case 1",
        f"{MILIAN}, Table 2",
        2.7051,
        "-",
        lambda: pinion(case(1)).peak_pressure_ratio,
        2e-3,
        INDEPENDENT,
    ),
    between(
        "overheating close to the trailing end: place of the maximum, case 1",
        f"{MILIAN}, Fig. 5",
        0.7,
        0.9,
        "of b",
        lambda: _hottest(1),
    ),
    between("and in case 2", f"{MILIAN}, Fig. 6", 0.7, 0.9, "of b", lambda: _hottest(2)),
    above(
        "rear end hotter than the front end: ratio of the rises", f"{MILIAN}, Fig. 5", 1.0, "-", _end_slices_over_front
    ),
    above(
        "case 2 suffers more: rise over that of case 1",
        f"{MILIAN}, conclusion",
        1.0,
        "-",
        lambda: _rise(case(2)) / _rise(case(1)),
    ),
    between(
        "a groove in the middle reduces the heating, case 1", f"{MILIAN}, Fig. 5", 0.4, 0.6, "-", lambda: _relief(1)
    ),
    between("and in case 2", f"{MILIAN}, Fig. 6", 0.4, 0.6, "-", lambda: _relief(2)),
    above(
        "wide faces suffer: power at 400 mm over power at 100 mm",
        f"{MILIAN}, introduction",
        4.0,
        "-",
        lambda: _wider(0.4) / _wider(0.1),
    ),
    equals(
        "axial meshing speed of case 1 over the speed of sound",
        f"{MILIAN}, Table 2",
        2.0,
        "-",
        lambda: case(1).total.axial_meshing_mach or 0.0,
        0.02,
        INDEPENDENT,
    ),
    below(
        "with the gaps as printed (tips) the flow stays subsonic: Mach number",
        f"{MILIAN}, Eq. 3",
        1.0,
        "-",
        lambda: pinion(case(1, model=TIP)).peak_axial_mach,
    ),
)
