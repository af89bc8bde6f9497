"""Check what must hold for every pumping set-up, on random set-ups like those of users.

A check draws one case from a numpy generator. If the draw is not a possible gear pair, the check draws again. If the
check fails, it raises AssertionError with the case. A function whose name ends in `_of` checks a given case.
"""

from collections.abc import Iterator
from dataclasses import asdict, replace
from math import radians

import numpy as np
from numpy.random import Generator

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair
from solvers.pumping import Ambient, Flow, Gap, Groove, PumpingInputs, PumpingModel, PumpingResult, PumpingSetup
from solvers.pumping.model import solve_on_slices
from solvers.pumping.results import SpacesResult
from solvers.pumping.spaces import prepare
from tests.support.changes import changed, value_at
from tests.support.outcomes import codes

BOOKS = 1e-10
PITCH_LINE_SPEEDS = (15.0, 200.0)  # m/s


def random_gears(draw: Generator) -> GearPairInputs:
    """Draw a gear pair like those of turbo and industrial gear units."""
    # The profile shift and the addendum of each gear are random. One of five pairs is a spur pair.
    module = draw.choice([1.5, 2.0, 3.0, 4.0, 5.0, 6.8, 7.0, 8.0, 10.0]) * 1e-3
    pinion = int(draw.integers(18, 60))
    wheel = int(draw.integers(pinion, 6 * pinion))
    helix = 0.0 if draw.random() < 0.2 else radians(draw.uniform(5.0, 30.0))
    return GearPairInputs(
        _teeth(draw, pinion),
        _teeth(draw, wheel),
        module,
        face_width=module * draw.uniform(6.0, 35.0),
        pressure_angle=radians(draw.choice([17.5, 20.0, 22.5, 25.0])),
        helix_angle=helix,
        rack_tip_radius=draw.uniform(0.2, 0.3),
    )


def _teeth(draw: Generator, count: int) -> GearTeeth:
    addendum = draw.uniform(0.9, 1.05)
    return GearTeeth(count, draw.uniform(-0.1, 0.4), addendum, addendum + draw.uniform(0.2, 0.4))


def rough_gears(draw: Generator) -> GearPairInputs:
    """Draw a gear pair that may be impossible."""
    # The teeth may be undercut, reach into fillets or lack clearance, and the centre distance may be too short.
    gears = replace(
        random_gears(draw),
        pinion=_rough_teeth(draw, 6, 30),
        wheel=_rough_teeth(draw, 12, 90),
        rack_tip_radius=draw.uniform(0.1, 0.38),
    )
    if draw.random() < 0.5:
        return gears
    try:
        apart = gear_pair(gears).backlash_free_centre_distance
    except InvalidInput:
        return gears
    return replace(gears, centre_distance=apart + gears.normal_module * draw.uniform(-0.02, 0.05))


def _rough_teeth(draw: Generator, low: int, high: int) -> GearTeeth:
    addendum = draw.uniform(0.8, 1.25)
    return GearTeeth(
        int(draw.integers(low, high)), draw.uniform(-0.4, 0.5), addendum, addendum + draw.uniform(0.2, 0.4)
    )


def random_setup(draw: Generator, model: PumpingModel | None = None) -> PumpingSetup:
    """Draw a set-up whose gears and tooth spaces are possible."""
    # The centre distance is up to 0.03 normal modules larger than the centre distance without backlash.
    while True:
        gears = random_gears(draw)
        try:
            apart = gear_pair(gears).backlash_free_centre_distance + gears.normal_module * draw.uniform(0.0, 0.03)
            setup = PumpingSetup(
                replace(gears, centre_distance=apart),
                normal_backlash=gears.normal_module * draw.uniform(0.01, 0.06),
                grooves=_grooves(draw, gears.face_width),
                ambient=Ambient(temperature=draw.uniform(293.0, 373.0)),
                model=model or PumpingModel(gap=Gap(draw.choice(list(Gap)))),
            )
            prepare(setup)
        except InvalidInput:
            continue
        return setup


def _grooves(draw: Generator, face_width: float) -> tuple[Groove, ...]:
    if draw.random() < 0.7:
        return ()
    return (Groove(face_width * draw.uniform(0.3, 0.7), face_width * draw.uniform(0.03, 0.15)),)


def random_speed(draw: Generator, setup: PumpingSetup) -> float:
    """Draw a pinion speed [rad/s] at which the pitch-line velocity is 15 to 200 m/s."""
    return draw.uniform(*PITCH_LINE_SPEEDS) / gear_pair(setup.gears).pinion_working_radius


def spaces_of(result: PumpingResult) -> Iterator[SpacesResult]:
    """Return the results of the gears whose tooth spaces were requested."""
    return (spaces for spaces in (result.pinion_spaces, result.wheel_spaces) if spaces is not None)


def check_books(draw: Generator) -> None:
    """Check the balances of mass and energy, the net mass flows and the pumping power."""
    # Each net flow at an end is the outflow minus the inflow, and all net flows add up to 0. The pumping power is the
    # work per space times the meshing frequency.
    flow = Flow(draw.choice([Flow.GAS_DYNAMICS, Flow.POCKET_CHAIN]))
    setup = random_setup(draw, PumpingModel(flow=flow, slices=40 if flow is Flow.GAS_DYNAMICS else 8))
    case = PumpingInputs(setup, random_speed(draw, setup))
    result = solve_on_slices(case)
    for spaces in spaces_of(result):
        flow_rate, balance = spaces.mass_flow, spaces.balance
        gross = flow_rate.front_out + flow_rate.rear_out + abs(flow_rate.radial) + abs(flow_rate.reset)
        net = flow_rate.front + flow_rate.rear + flow_rate.radial + flow_rate.grooves + flow_rate.reset
        assert balance.mass_error < BOOKS, case
        assert balance.energy_error < BOOKS, case
        assert abs(net) < BOOKS * gross, case
        assert abs(flow_rate.front_out - flow_rate.front_in - flow_rate.front) < BOOKS * gross, case
        assert abs(flow_rate.rear_out - flow_rate.rear_in - flow_rate.rear) < BOOKS * gross, case
        power = result.total.meshing_frequency * spaces.work_per_space
        assert abs(spaces.pumping_power - power) <= 1e-12 * abs(power), case
    total = sum(spaces.pumping_power for spaces in spaces_of(result))
    assert abs(result.total.pumping_power - total) <= 1e-12 * total, case


def numbers(spaces: SpacesResult) -> dict[str, float]:
    """Return the summary numbers of one gear's spaces that depend on the resolution.

    Pressures are magnitudes of gauge pressures, divided by the ambient pressure.
    """
    assert spaces.max_temperature_rise is not None
    flow = spaces.mass_flow
    return {
        "peak_pressure": spaces.peak_pressure_ratio - 1.0,
        "min_pressure": 1.0 - spaces.min_pressure_ratio,
        "axial_mach": spaces.peak_axial_mach,
        "pumping_power": spaces.pumping_power,
        "temperature_rise": spaces.max_temperature_rise,
        "front_out": flow.front_out,
        "rear_out": flow.rear_out,
        "radial_flow": flow.radial,
    }


def uncertain(result: PumpingResult, spaces: SpacesResult, name: str, value: float) -> float:
    """Return the uncertainty of a number of a gear's spaces, as the result states it."""
    if name == "radial_flow":
        return spaces.mass_flow.radial_uncertainty
    stated = asdict(result.resolution)
    return stated[name if name in stated else "gross_flow"] * abs(value)


def check_resolution(draw: Generator) -> None:
    setup = random_setup(draw)
    check_resolution_of(PumpingInputs(setup, random_speed(draw, setup)))


def check_resolution_of(case: PumpingInputs) -> None:
    """Check that twice the slices change a number by at most 1 % or its stated uncertainty, whichever is larger."""
    here, there = solve_on_slices(case), solve_on_slices(changed(case, {"setup.model.slices": 200}))
    for coarse, fine in zip(spaces_of(here), spaces_of(there), strict=True):
        flow, after = coarse.mass_flow, numbers(fine)
        for name, value in numbers(coarse).items():
            allowed = max(0.01 * abs(value), uncertain(here, coarse, name, value))
            assert abs(value - after[name]) <= allowed, (name, value, after[name], here.resolution, case)
        for end in ("front", "rear"):
            net = getattr(flow, end)
            change = abs(net - getattr(fine.mass_flow, end))
            assert change <= max(0.01 * abs(net), flow.net_uncertainty), (end, change, flow, case)


# every continuous input, and by how much of itself it is changed over its scan, if by a factor
SCANS = {
    "speed": ("pinion_speed", 0.1),
    "backlash": ("setup.normal_backlash", 1.0),
    "centre_distance": ("setup.gears.centre_distance", None),
    "face_width": ("setup.gears.face_width", 0.1),
    "helix_angle": ("setup.gears.helix_angle", 0.05),
    "profile_shift": ("setup.gears.pinion.profile_shift", None),
    "groove_position": ("setup.grooves", None),
    "groove_width": ("setup.grooves", None),
    "temperature": ("setup.ambient.temperature", 0.1),
    "pressure": ("setup.ambient.pressure", 0.5),
    "molar_mass": ("setup.ambient.molar_mass", 0.2),
    "isentropic_exponent": ("setup.ambient.isentropic_exponent", 0.03),
}


def scanned(case: PumpingInputs, scan: str, by: float) -> PumpingInputs:
    """Change one input of the case. As `by` goes from 0 to 1, the input goes through the range of its scan."""
    (name, share), gears = SCANS[scan], case.setup.gears
    before = value_at(case, name)
    if share is not None:
        after = before * (1 + share * by)
    elif scan == "centre_distance":
        after = before + 0.05 * by * gears.normal_module
    elif scan == "profile_shift":
        after = before + 0.02 * by
    else:
        position, width = (0.4 + 0.2 * by, 0.08) if scan == "groove_position" else (0.5, 0.04 + 0.08 * by)
        after = (Groove(gears.face_width * position, gears.face_width * width),)
    values = {name: after}
    if scan in {"helix_angle", "profile_shift"}:
        values["setup.gears.centre_distance"] = None
    return changed(case, values)


POINTS = 41
NOISE = 3e-3  # of a number: what a grid of 40 slices leaves in a scan
JUMP = 10.0  # times the local change
LITTLE = 0.1  # of a number on 40 slices


def scan(cases: list[PumpingInputs]) -> dict[str, list[float]]:
    """Solve the cases of a scan, and return the values of each number of the first gear's spaces."""
    rows = [numbers(next(spaces_of(solve_on_slices(case)))) for case in cases]
    return {name: [row[name] for row in rows] for name in rows[0]}


def jumps(values: list[float]) -> list[int]:
    """Return the indices of the steps of a scan that are suspiciously large.

    Such a step is more than ten times the median of the steps around it, and exceeds the noise of the grid.
    """
    steps = np.abs(np.diff(values))
    local = np.array([np.median(np.delete(steps[max(k - 4, 0) : k + 5], min(k, 4))) for k in range(steps.size)])
    return list(np.flatnonzero((steps > JUMP * local) & (steps > NOISE * np.abs(values).max())))


def check_no_jump(draw: Generator, name: str | None = None) -> None:
    """Draw a case, and check that a scan of the input `name` has no jump. If `name` is None, draw the input."""
    setup = random_setup(draw, PumpingModel(slices=40, gap=Gap(draw.choice(list(Gap)))))
    case = PumpingInputs(setup, random_speed(draw, setup))
    check_no_jump_of(case, name or str(draw.choice(list(SCANS))))


def check_no_jump_of(case: PumpingInputs, name: str) -> None:
    """Check that a fine scan of one input has no jump."""
    # A number may change suddenly if the stroke has one time step more or less, or a land between grooves has one slice
    # more or less. Such a change must not exceed the sum of the uncertainties of the results before and after the
    # change. The change must also be at most a tenth of the largest value of the number. The radial flow is a small
    # difference of large flows. Its tenth is therefore taken of the sum of its largest value and the flows out of both
    # ends. If both results have the notice `area_jump`, only the uncertainties count.
    cases = [scanned(case, name, k / (POINTS - 1)) for k in range(POINTS)]
    try:
        found = scan(cases)
    except InvalidInput:
        return  # a scan that leaves what meshes
    for number, values in found.items():
        for k in jumps(values):
            told = (name, number, k, values, case)
            step = abs(values[k + 1] - values[k])
            passing = sum(found[end][k] for end in ("front_out", "rear_out")) if number == "radial_flow" else 0.0
            sides = [(solve_on_slices(cases[place]), values[place]) for place in (k, k + 1)]
            named = all("area_jump" in codes(side) for side, _ in sides)
            assert named or step <= LITTLE * (max(map(abs, values)) + passing), told
            assert step <= sum(uncertain(side, next(spaces_of(side)), number, value) for side, value in sides), told
