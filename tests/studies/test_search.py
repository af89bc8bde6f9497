"""A search finds every answer that brute force finds, follows turns between its points, and tells jumps and gaps."""

from collections.abc import Callable
from itertools import pairwise
from math import exp, sin

import numpy as np
import pytest

from app.schema.precision import NOISE
from app.studies.search import PLACE_WITHIN, Crossing, Extreme, Search, found, next_step
from tests.support.properties import seeds

Curve = Callable[[float], float | None]
SCAN = tuple(np.linspace(0.0, 1.0, 21).tolist())


def searched(
    curve: Curve,
    wanted: float | None = None,
    extreme: Extreme | None = None,
    scan: tuple[float, ...] = SCAN,
    **more: bool,
) -> Search:
    search = Search(scan, wanted, extreme, **more)
    while (step := next_step(search)).places:
        assert len(search.told) < 250
        for place in step.places:
            assert place not in search.told
            search.tell(place, curve(place), step.asked)
    return search


def places(search: Search) -> list[float]:
    return [answer.place for answer in found(search)[0]]


def waves(rng: np.random.Generator) -> Callable[[float], float]:
    """Return a smooth curve whose turns are farther apart than two steps of the scan."""
    slope, height, length, shift = rng.uniform(-2, 2), rng.uniform(0.1, 2), rng.uniform(0.25, 2), rng.uniform(0, 6)
    return lambda place: slope * place + height * sin(shift + 2 * np.pi * place / length)


@seeds(200, 2000)
def test_all_answers_of_brute_force(rng: np.random.Generator) -> None:
    curve = waves(rng)
    fine = np.linspace(0.0, 1.0, 20001)
    outputs = np.array([curve(place) for place in fine])
    wanted = float(rng.uniform(outputs.min() - 0.2, outputs.max() + 0.2))
    beyond = outputs - wanted
    expected = [float(fine[at]) for at in np.flatnonzero(beyond[:-1] * beyond[1:] < 0.0)]
    search = searched(curve, wanted)
    assert places(search) == pytest.approx(expected, abs=6e-5)
    assert found(search)[1] == []
    assert all(answer.output == pytest.approx(wanted, abs=3e-6 * np.ptp(outputs)) for answer in found(search)[0])


@seeds(100, 1000)
def test_the_extreme_of_brute_force(rng: np.random.Generator) -> None:
    curve, sign = waves(rng), int(rng.choice([-1, 1]))
    outputs = sign * np.array([curve(place) for place in np.linspace(0.0, 1.0, 4001)])
    nearest = searched(curve, extreme="least" if sign > 0 else "greatest").nearest
    assert nearest is not None
    assert sign * nearest[1] == pytest.approx(outputs.min(), abs=1e-5 * np.ptp(outputs))


@pytest.mark.parametrize("wanted", [0.5, 2.0, 1000.0, -1.5])
def test_a_curve_over_decades_has_its_answer_where_it_is(wanted: float) -> None:
    """The far end of the curve is 1e6: a tolerance of this size would take every point for the answer."""
    low, high = 1e-6, 10.0
    search = searched(lambda place: float(np.copysign(1.0, wanted)) / (low + place * (high - low)), wanted)
    (answer,) = found(search)[0]
    assert answer.place * (high - low) + low == pytest.approx(1.0 / abs(wanted), abs=2 * PLACE_WITHIN * high)
    assert answer.until - answer.place <= PLACE_WITHIN


def test_two_answers_between_two_points_of_the_scan() -> None:
    search = searched(lambda place: exp(-(((place - 0.52) / 0.03) ** 2)), 0.95)
    low, high = places(search)
    assert 0.50 < low < 0.52 < high < 0.54
    assert [(each.before, each.after) for each in found(search)[0]] == [(-1, 1), (1, -1)]


def test_two_answers_beside_a_kink() -> None:
    assert places(searched(lambda place: 1.0 + abs(place - 0.33), 1.001)) == pytest.approx([0.329, 0.331], abs=2e-6)


def test_a_jump_is_no_answer() -> None:
    answers, (jump,) = found(searched(lambda place: 1.0 if place < 0.377 else 2.0, 1.5))
    assert answers == []
    assert (jump.kind, jump.outputs) == ("jump", (1.0, 2.0))
    assert jump.places[0] < 0.377 <= jump.places[1] < jump.places[0] + 2 * PLACE_WITHIN


def test_a_steep_curve_is_no_jump() -> None:
    answers, crossings = found(searched(lambda place: float(np.tanh(2000.0 * (place - 0.377))), 0.5))
    assert [answer.output for answer in answers] == pytest.approx([0.5], abs=1e-2)
    assert crossings == []


def test_a_gap_is_told_and_its_ends_are_narrowed() -> None:
    search = searched(lambda place: None if 0.312 < place < 0.5 else place, 0.4)
    ((kind, (low, high), _),) = found(search)[1]
    assert kind == "gap"
    assert 0.312 - 0.05 / 16 <= low <= 0.312
    assert high == 0.5


def test_many_gaps_are_not_all_narrowed() -> None:
    search = searched(lambda place: None if round(20 * place) % 2 else place, 0.45)
    assert len(search.told) < 80
    assert [each.kind for each in found(search)[1]] == ["gap"]


def test_an_answer_beside_a_gap_is_found() -> None:
    search = searched(lambda place: None if place > 0.5333 else place, 0.53)
    assert places(search) == pytest.approx([0.53], abs=1e-5)


def test_a_range_of_answers() -> None:
    (answer,) = found(searched(lambda place: min(place, 0.6), 0.6))[0]
    assert (answer.place, answer.until) == pytest.approx((0.6, 1.0))


def test_a_constant_output_needs_no_search() -> None:
    search = searched(lambda place: 3.0 + 0.1 * NOISE * place, 2.0)
    assert search.is_constant
    assert len(search.told) == len(SCAN)


def test_no_answer_has_a_nearest_place() -> None:
    assert searched(lambda place: 3.0 * place, 20.0).nearest == (1.0, 3.0)
    inside = searched(lambda place: 1.0 - (place - 0.512) ** 2, 2.0).nearest
    assert inside is not None
    assert inside == pytest.approx((0.512, 1.0), abs=1e-3)


@pytest.mark.parametrize("wanted", [50.0, 49.0])
def test_a_list_has_answers_between_neighbours(wanted: float) -> None:
    answers, crossings = found(searched(lambda place: place**2, wanted, scan=tuple(map(float, range(14))), whole=True))
    if wanted == 49.0:
        assert ([answer.place for answer in answers], crossings) == ([7.0], [])
    else:
        assert (answers, crossings) == ([], [Crossing("between", (7.0, 8.0), (49.0, 64.0))])


@seeds(50, 500)
def test_whole_numbers_by_brute_force(rng: np.random.Generator) -> None:
    curve, last = waves(rng), int(rng.integers(60, 400))
    scan = tuple(np.unique(np.linspace(0, last, 21).round()).tolist())
    outputs = [curve(place / last) for place in range(last + 1)]
    wanted = float(rng.uniform(min(outputs), max(outputs)))
    search = searched(lambda place: outputs[round(place)], wanted, scan=scan, whole=True)
    sides = [search.side(output) for output in outputs]
    expected = [(low, low + 1) for low, pair in enumerate(pairwise(sides)) if pair[0] * pair[1] < 0]
    assert [tuple(map(round, each.places)) for each in found(search)[1]] == expected
    best = searched(lambda place: outputs[round(place)], extreme="least", scan=scan, whole=True).nearest
    assert best is not None
    assert best[1] == min(outputs)
