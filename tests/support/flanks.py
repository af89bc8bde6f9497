"""Check what must hold for every loaded flank, on random flanks.

The tests and `benchmarks/search.py` run these checks. Every check in `SEARCHES` draws one case from a random generator.
If the check fails, it raises AssertionError with the case.
"""

from collections.abc import Callable
from math import radians

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path
from solvers.scuffing.contact_lines import contact_lengths, line_count
from solvers.scuffing.flank_results import face_loads
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Modifications, Resolution
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from tests.support.changes import changed

RESOLUTIONS = ("roll_positions", "slices", "profile_points", "face_points", "feature_points")
SCAN_STEPS = 24
ZOOM = 8
ZOOMS = 5

Check = Callable[[np.random.Generator], None]


def draw_gears(rng: np.random.Generator) -> GearPairInputs:
    """Draw a gear pair that can mesh. About one of four pairs is a spur pair."""
    while True:
        module = 10 ** rng.uniform(-3, -2)
        gears = GearPairInputs(
            GearTeeth(int(rng.integers(17, 60)), rng.uniform(-0.1, 0.5)),
            GearTeeth(int(rng.integers(20, 130)), rng.uniform(-0.3, 0.3)),
            module,
            module * rng.uniform(4, 35),
            pressure_angle=radians(rng.uniform(17, 25)),
            helix_angle=radians(rng.choice([0.0, rng.uniform(3, 32), rng.uniform(3, 32), rng.uniform(3, 32)])),
            rack_tip_radius=rng.uniform(0.1, 0.3),
        )
        try:
            contact_lengths(meshing_path(gears))
        except InvalidInput:
            continue
        return gears


def draw_flank(rng: np.random.Generator) -> LoadDistributionInputs:
    """Draw a flank under load, with modifications of up to a tenth of the normal module or without modifications."""
    # The highest load per size of the gear is about 3000 times the lowest.
    gears = draw_gears(rng)
    amplitude = gears.normal_module * 10 ** rng.uniform(-4, -1)
    names = ("profile_crowning", "lead_crowning", "tip_relief", "root_relief", "end_relief")
    shape = {name: amplitude * rng.uniform(0, 1) for name in names if rng.random() < 0.5}
    slopes = {name: amplitude * rng.uniform(-1, 1) for name in ("profile_slope", "helix_slope") if rng.random() < 0.4}
    stress = 10 ** rng.uniform(4.5, 8)
    radius = gears.pinion.teeth * gears.normal_module / 2
    return LoadDistributionInputs(
        gears,
        Load(stress * gears.face_width * gears.normal_module * radius, 200.0),
        Modifications(**shape, **slopes, relief_exponent=rng.choice([1.0, 1.5, 2.0, 3.0])),
        resolution=Resolution(profile_points=41, face_points=21),
    )


def summary(result: LoadDistribution) -> dict[str, tuple[float, float]]:
    """Return the summary numbers that depend on the resolution, each of them with the scale for its changes."""
    error, load, loss = result.transmission_error, result.load, result.friction_loss
    approach = float(np.mean(result.balance.transmission_error - result.balance.unloaded_error))
    lengths = {
        "peak_to_peak": error.peak_to_peak,
        "mean": error.mean,
        "min": error.min,
        "max": error.max,
        **{f"harmonic {order}": float(value) for order, value in enumerate(error.harmonics, 1)},
    }
    others = {
        "max_line_load": load.max_line_load,
        "face_load_factor": load.face_load_factor,
        "contact_fraction": load.contact_fraction,
        "max_pressure": result.pressure.max,
        "friction_power": loss.power,
        "mean_mesh_stiffness": result.stiffness.mean_mesh,
    }
    scale = max(approach, error.peak_to_peak)
    return {name: (value, scale) for name, value in lengths.items()} | {
        name: (value, abs(value)) for name, value in others.items() if value is not None
    }


def check_resolution(rng: np.random.Generator) -> None:
    check_resolution_of(draw_flank(rng))


def check_resolution_of(inputs: LoadDistributionInputs) -> None:
    """Check that no summary number changes by more than 1 % if one of the numbers of points is doubled."""
    plain = summary(solve_load_distribution(inputs))
    for name in RESOLUTIONS:
        finer = changed(inputs, {f"resolution.{name}": 2 * getattr(inputs.resolution, name)})
        fine = summary(solve_load_distribution(finer))
        for number, (value, scale) in plain.items():
            moved = abs(fine[number][0] - value)
            assert moved <= 0.01 * scale, f"{name} moves {number} by {moved / scale:.2%}: {inputs}"


def check_books(rng: np.random.Generator) -> None:
    check_books_of(draw_flank(rng))


def check_books_of(inputs: LoadDistributionInputs) -> None:
    """Check the force, the friction power and the maxima of a result against the line loads of the same result."""
    # The force and the friction power must agree with a quadrature of the line loads. The stated maxima of line load,
    # pressure and face load may not be noticeably smaller than the values at many points.
    result = solve_load_distribution(inputs)
    balance, plane = result.balance, result.path_of_contact.plane
    y = (np.arange(800) + 0.5) / 800 * plane.face_width
    x = (np.arange(400) + 0.5) / 400 * plane.path_length
    load = line_loads(balance, *np.meshgrid(x, y, indexing="ij"))
    cell = plane.path_length * plane.face_width / load.size
    sharing = load[load > 0.0].size / load.size
    tolerance = 0.01 + 0.03 * (1.0 - sharing)  # cells that the edge of the contact crosses
    mean_force = load.sum() * cell / plane.base_pitch / plane.cos_base_helix
    assert abs(mean_force / balance.force - 1.0) < tolerance, f"force {mean_force} for {balance.force}: {inputs}"
    arm = np.abs(x - plane.pitch_point + plane.start)[:, None]
    ratio = inputs.gears.pinion.teeth / inputs.gears.wheel.teeth
    moment = (load * arm).sum() * cell / plane.base_pitch / plane.cos_base_helix
    power = inputs.friction_coefficient * inputs.load.pinion_speed * (1 + ratio) * moment
    assert abs(power / result.friction_loss.power - 1.0) < 2 * tolerance, f"friction power {power}: {inputs}"
    shares = face_loads(balance, y)
    factor = shares.max() * plane.face_width / (balance.force * plane.cos_base_helix)
    assert factor <= result.load.face_load_factor * (1 + 1e-3), f"face load factor {factor}: {inputs}"
    peak = _loads_at_roll_positions(result, y[::8]).max()
    assert peak <= result.load.max_line_load * (1 + 5e-3), f"line load {peak}: {inputs}"
    if result.pressure.max is not None:
        assert np.nanmax(result.flank.pressure) <= result.pressure.max * (1 + 5e-3), f"pressure: {inputs}"


def _loads_at_roll_positions(result: LoadDistribution, y: FloatArray) -> FloatArray:
    """Return the line loads on the contact lines at the roll positions for which the loads were balanced.

    Between these roll positions, interpolated line loads of light contacts have errors of up to 2 %.
    """
    balance, plane = result.balance, result.path_of_contact.plane
    first = balance.rolls.phase[:, None] - y * plane.tan_base_helix
    lines = first + plane.base_pitch * np.arange(line_count(plane))[:, None, None]
    across = np.broadcast_to(y, lines.shape)
    inside = (lines > 0.0) & (lines < plane.path_length)
    return line_loads(balance, lines[inside], across[inside])


def scans(inputs: LoadDistributionInputs) -> dict[str, tuple[float, float]]:
    """Return a range of values for each continuous input. The keys are the dotted names of the inputs."""
    gears, module = inputs.gears, inputs.gears.normal_module
    helix = gears.helix_angle or radians(10)  # a spur gear is another gear: tests/solvers names that jump
    amplitudes = ("profile_crowning", "lead_crowning", "profile_slope", "helix_slope")
    reliefs = ("tip_relief", "root_relief", "end_relief")
    free = meshing_path(gears).pair.backlash_free_centre_distance
    return {
        "gears.helix_angle": (0.8 * helix, 1.2 * helix),
        "gears.face_width": (0.7 * gears.face_width, 1.4 * gears.face_width),
        "gears.centre_distance": (free, free + 0.05 * module),
        "gears.pressure_angle": (radians(19.0), radians(21.0)),
        "gears.pinion.profile_shift": (gears.pinion.profile_shift, gears.pinion.profile_shift + 0.1),
        "gears.pinion.addendum": (0.9, 1.05),
        "load.pinion_torque": (0.1 * inputs.load.pinion_torque, 2 * inputs.load.pinion_torque),
        "modifications.relief_exponent": (1.0, 3.0),
        **{f"modifications.{name}": (-0.01 * module, 0.01 * module) for name in amplitudes},
        **{f"modifications.{name}": (0.0, 0.01 * module) for name in reliefs},
        **{f"modifications.{name}_length": (0.3 * module, 6 * module) for name in reliefs},
    }


def check_no_jump(rng: np.random.Generator) -> None:
    """Check that no summary number jumps while one input is changed in small steps."""
    # A change that stands out must shrink to at most 1 % if the step becomes smaller.
    inputs = draw_flank(rng)
    ranges = scans(inputs)
    name = str(rng.choice(list(ranges)))

    def numbers(value: float) -> dict[str, tuple[float, float]] | None:
        try:
            return summary(solve_load_distribution(changed(inputs, {name: value})))
        except InvalidInput:
            return None

    values = np.linspace(*ranges[name], SCAN_STEPS + 1)
    suspects = _steps_out_of_line([numbers(value) for value in values])
    for number, step in suspects.items():
        jump = _jump(numbers, number, values[step], values[step + 1])
        assert jump <= 0.01, f"{number} jumps by {jump:.2%} at {name} {values[step]}..{values[step + 1]}: {inputs}"


def _steps_out_of_line(found: list[dict[str, tuple[float, float]] | None]) -> dict[str, int]:
    """Return, for each suspicious number, the index of the largest step in its series of values."""
    # A number is suspicious if this step is more than 1 %, and more than ten times the median of the neighbouring
    # steps.
    suspects = {}
    answers = [one or {} for one in found]
    for number in {name for one in answers for name in one}:
        series = np.array([one[number][0] if number in one else np.nan for one in answers])
        scale = np.nanmean([one[number][1] for one in answers if number in one])
        steps = np.abs(np.diff(series)) / scale
        if not np.isfinite(steps).any():
            continue
        top = int(np.nanargmax(steps))
        around = np.delete(steps[max(top - 3, 0) : top + 4], min(top, 3))
        if steps[top] > max(0.01, 10 * np.nanmedian(around)):
            suspects[number] = top
    return suspects


def _jump(
    numbers: Callable[[float], dict[str, tuple[float, float]] | None], number: str, low: float, high: float
) -> float:
    """Zoom into the interval, and return the change of the number that is left, divided by the scale of the number.

    Each zoom keeps the eighth of the interval with the largest change. Return 0 if the number cannot be computed at a
    point of the interval.
    """
    step = np.inf
    for _ in range(ZOOMS):
        values = np.linspace(low, high, ZOOM + 1)
        found = [numbers(value) for value in values]
        if any(one is None or number not in one for one in found):
            return 0.0
        series = np.array([one[number] for one in found if one is not None])
        steps = np.abs(np.diff(series[:, 0])) / series[:, 1].mean()
        top = int(np.argmax(steps))
        low, high, step = values[top], values[top + 1], float(steps[top])
    return step


SEARCHES: tuple[Check, ...] = (check_resolution, check_books, check_no_jump)
