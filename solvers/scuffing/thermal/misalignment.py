"""What a misalignment that nobody stated would do to a wide pair."""

from dataclasses import replace

from solvers.errors import InvalidInput, NoSolution
from solvers.notices import Notice
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.model import solve
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import Safety
from solvers.scuffing.thermal.flank import find_hottest
from solvers.scuffing.thermal.temperatures import in_force

WIDE = 1.0  # face width over reference diameter of the pinion, chosen
SLOPE = 25e-6  # m over the face, chosen: usual of wide gears in their bearings


def misalignment_left_out(
    asked: ScuffingInputs, distribution: LoadDistribution, safety: Safety | None
) -> tuple[Notice, ...]:
    """Warn that the flanks of a wide pair were taken as aligned, with the safety that a usual helix slope would leave.

    `asked` are the inputs as given, `distribution` and `safety` the results for aligned flanks.
    """
    given, pair = asked.distribution, distribution.path_of_contact.pair
    m, factor = given.modifications, distribution.load.face_load_factor
    states_one = m.helix_slope or m.in_plane_deviation or m.out_of_plane_deviation or any(m.lead_curve.gap)
    if states_one or factor is None or given.gears.toothed_width <= WIDE * 2 * pair.pinion.reference_radius:
        return ()
    tilted = replace(given, modifications=replace(m, helix_slope=SLOPE))
    try:
        effect = _effect(replace(asked, distribution=tilted), safety)
    except (InvalidInput, NoSolution):
        effect = "a helix slope is not computed here"
    message = f"face load factor {factor:.2f}: no misalignment given; {effect}"
    return (Notice("no_misalignment", message, "modifications.helix_slope", rank="note"),)


def _effect(tilted: ScuffingInputs, safety: Safety | None) -> str:
    """Say what a helix slope would make of the safety, or of the face load factor where no safety is known."""
    spread = solve(tilted.distribution)
    slope = f"{SLOPE * 1e6:g} µm of helix slope would make"
    if safety is not None and safety.blok_factor is not None:
        unbanded = replace(tilted, cooling=replace(tilted.cooling, band=False))
        inputs, spread, flash, *_ = in_force(unbanded, spread)
        hottest = find_hottest(inputs.distribution, spread, flash) if inputs.line == "flank" else None
        temperatures = inputs.temperatures
        if hottest is not None and temperatures.bulk is not None:
            rise = temperatures.bulk + hottest.value - temperatures.oil
            return f"{slope} S_B {(safety.scuffing - temperatures.oil) / rise:.3g} instead of {safety.blok_factor:.3g}"
    return f"{slope} it {spread.load.face_load_factor:.2f}"
