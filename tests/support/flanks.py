"""Random loaded flanks and what holds for each of them: shared by the tests and by the long random search.

Every `check_...` draws one case from the generator and raises AssertionError, with the case, where it fails.
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
    """A pair that meshes, spur in one case of four."""
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
    """A flank from unmodified to peaked, under loads from a thousandth to full."""
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
    """Every summary number of a loaded mesh that its resolution may touch, with the size to judge changes by."""
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
    """Doubling any number of points moves no summary number by more than 1 %."""
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
    """Forces, friction power, the face load factor and all maxima by quadrature of the answer's own line loads."""
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
    """Line loads where the balance was found: between roll positions light contacts interpolate to 2 %."""
    balance, plane = result.balance, result.path_of_contact.plane
    first = balance.rolls.phase[:, None] - y * plane.tan_base_helix
    lines = first + plane.base_pitch * np.arange(line_count(plane))[:, None, None]
    across = np.broadcast_to(y, lines.shape)
    inside = (lines > 0.0) & (lines < plane.path_length)
    return line_loads(balance, lines[inside], across[inside])


def scans(inputs: LoadDistributionInputs) -> dict[str, tuple[float, float]]:
    """By the name of each continuous input: a range about the case to scan it over."""
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
    """No summary number jumps while one input goes through its range: a step's change shrinks with the step."""
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
    """By number: the largest step, where it is ten times its neighbours or more and more than 1 %."""
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
    """What is left of the largest step within low..high after zooming into it, relative to the number's size."""
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
