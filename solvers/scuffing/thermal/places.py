"""Thermal EHL at the places of the flank that decide: chosen by the formulas, refined by the solutions themselves.

At one distance x along the path all contacts have the same radius and speeds and differ in their load only. A heavier
contact is hotter and has a thinner film. At every x the worst contact is therefore the one under the largest load over
the face, and the search for the worst contact of the flank is a search along x.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import ThermalPath
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.flank import (
    ContactFunction,
    FaceFunction,
    FlankFunction,
    FlashMap,
    contact_at_points,
    refined,
    thinness,
    thinness_map,
)
from solvers.scuffing.thermal.thermal_path import SolvedLine, joined, solve_line
from solvers.scuffing.thermal.verdict import hotter_surface

MOST_PEAKS = 3  # peaks of a formula at which the film is solved
STEP = 0.04  # of the path: distance to the first neighbours of a peak, chosen; loads and speeds change little over it
MOVES = 0.003  # share by which the extreme may still move when the refinement ends
MOST_STEPS = 12  # steps uphill from a peak of a formula, and as many refinements at the top; chosen, rarely more than 3
# Refinements of the face position of the largest load, and their places in spacings of the places before. The load may
# have a kink there, so that its error is as large as that of the place; the last places are 1e-9 of the face apart.
ZOOMS = 6
ZOOM = np.linspace(-1.0, 1.0, 33)

SurfaceFunction = Callable[[FloatArray], FloatArray]
"""A function that returns the bulk temperatures of pinion and wheel (2, n) [K] at distances y [m] along the face."""


class Places(NamedTuple):
    """Solved places of the flank: distances x from A and y from the end that meshes first [m], and their solutions."""

    x: FloatArray
    y: FloatArray
    solved: SolvedLine
    surfaces: FloatArray  # bulk temperatures of pinion and wheel (2, n) [K]

    def hottest(self) -> Peak | None:
        """Return the place with the hottest surface [K]; None if nothing is solved."""
        temperature = hotter_surface(self.solved.path, self.surfaces)
        if np.isnan(temperature).all():
            return None
        top = int(np.nanargmax(temperature))
        return Peak(float(temperature[top]), float(self.x[top]), float(self.y[top]))


def solve_places(
    inputs: ScuffingInputs,
    distribution: LoadDistribution,
    flash: FlashMap,
    film_at: ContactFunction,
    formulas: tuple[Peak | None, Peak],
    surfaces: SurfaceFunction,
    rise: FaceFunction | None = None,
) -> Places:
    """Solve thermal EHL at the highest peaks of Blok's formula and at the thinnest places of the film formula.

    `formulas` are the hottest place by formula, if it is known, and the thinnest. `rise` [K] is the bulk temperature
    along the face less its mean. Each place is refined along the path until the extreme moves by less than 0.3 %. Every
    contact is solved alone, so that neither the order nor the direction of the search matters.
    """
    given = inputs.distribution
    hottest, thinnest = formulas
    pitch = distribution.path_of_contact.plane.pitch_point - distribution.path_of_contact.plane.start

    def load(x: FloatArray, y: FloatArray) -> FloatArray:
        return line_loads(distribution.balance, x, y)

    def temperature(x: FloatArray, y: FloatArray) -> FloatArray:
        value = blok_flash(given, contact_at_points(given, distribution, x, y))
        return value if rise is None else value + rise(y)

    def reciprocal_film(x: FloatArray, y: FloatArray) -> FloatArray:
        return thinness(film_at, contact_at_points(given, distribution, x, y))

    hot: list[Peak] = []
    if hottest is not None:
        on_grid = flash.flash if rise is None else flash.flash + rise(flash.y)
        hot = _peaks(flash, on_grid, temperature, hottest, pitch)
    thinnest = Peak(1.0 / thinnest.value, thinnest.x, thinnest.y)
    thin = _peaks(flash, thinness_map(flash, film_at), reciprocal_film, thinnest, pitch)
    tried = [peak.y for peak in (*hot, *thin)]
    # The load finds the place of the thinnest film too, more exactly than the film, which hardly depends on the load.
    heaviest = largest_over_face(flash.y, tried, load)
    warmest = heaviest if rise is None else largest_over_face(flash.y, tried, temperature)
    search = _Search(inputs, distribution, surfaces)
    search.follow([peak.x for peak in hot], warmest, search.warmth)
    search.follow([peak.x for peak in thin], heaviest, _reciprocal_film)
    return search.places()


class _Search:
    """Solutions of single contacts of a flank; no contact is solved twice."""

    def __init__(self, inputs: ScuffingInputs, distribution: LoadDistribution, surfaces: SurfaceFunction) -> None:
        self._inputs, self._distribution, self._surfaces = inputs, distribution, surfaces
        self._solved: dict[tuple[float, float], SolvedLine] = {}

    def follow(
        self, starts: Sequence[float], across: Callable[[float], float], value: Callable[[ThermalPath, float], float]
    ) -> None:
        """Solve contacts from every start uphill to the next peak of `value`, at the worst face position of each x."""
        length = self._distribution.path_of_contact.plane.path_length

        @cache
        def at(x: float) -> float:
            y = across(x)
            return value(self._solution(x, y).path, y)

        for start in starts:
            _climb(at, start, length)

    def warmth(self, path: ThermalPath, y: float) -> float:
        """Return how much the hotter surface is hotter than the mean bulk temperature of its gear [K]."""
        surfaces, mean = self._surfaces(np.array([y])), self._inputs.temperatures.bulk
        assert mean is not None
        hotter = float(hotter_surface(path, surfaces)[0]) - mean
        return 0.0 if np.isnan(hotter) else hotter

    def _solution(self, x: float, y: float) -> SolvedLine:
        if (x, y) not in self._solved:
            points = contact_at_points(self._inputs.distribution, self._distribution, np.array([x]), np.array([y]))
            self._solved[x, y] = solve_line(self._inputs, points)
        return self._solved[x, y]

    def places(self) -> Places:
        """Return all solved places in the order of the path."""
        ordered = sorted(self._solved)
        x, y = np.array(ordered).reshape(-1, 2).T
        lines = [self._solved[place] for place in ordered]
        solved = SolvedLine(
            joined([line.path for line in lines]),
            [result for line in lines for result in line.results],
            [refusal for line in lines for refusal in line.refusals],
        )
        return Places(x, y, solved, self._surfaces(y))


def _reciprocal_film(path: ThermalPath, _: float) -> float:
    film = float(path.minimum_film[0])
    return 0.0 if np.isnan(film) else 1.0 / film


def _peaks(grid: FlashMap, values: FloatArray, function: FlankFunction, largest: Peak, pitch: float) -> list[Peak]:
    """Return the highest peaks along the path of the largest value over the face.

    There are at most `MOST_PEAKS`, and at least one on each side of the pitch point where there is one. `largest` is
    the largest value of the flank.
    """
    ridge = values.max(axis=1)
    edged = np.concatenate([[-np.inf], ridge, [-np.inf]])
    local = np.flatnonzero((ridge >= edged[:-2]) & (ridge >= edged[2:]) & (ridge > 0.0))
    sides = [[row for row in local.tolist() if (grid.x[row] > pitch) == behind] for behind in (False, True)]
    highest = [row for side in sides for row in sorted(side, key=lambda row: -ridge[row])[:MOST_PEAKS]]
    found = [largest, *(refined(grid, values, function, highest) if highest else [])]
    apart: list[Peak] = []
    for peak in sorted(found, key=lambda peak: -peak.value):
        if all(abs(peak.x - other.x) > grid.x[-1] / grid.x.size for other in apart):
            apart.append(peak)
    first = [next((peak for peak in apart if (peak.x > pitch) == behind), None) for behind in (False, True)]
    chosen = [peak for peak in first if peak is not None]
    return chosen + [peak for peak in apart if peak not in chosen][: MOST_PEAKS - len(chosen)]


def largest_over_face(face: FloatArray, tried: Sequence[float], function: FlankFunction) -> Callable[[float], float]:
    """Return a function of x that finds the face position [m] with the largest value of `function`.

    The positions `face` and `tried` are searched. Around the best of them the search is refined.
    """

    def position(x: float) -> float:
        def best(y: FloatArray) -> float:
            return float(y[np.argmax(function(np.full(y.size, x), y))])

        top, spacing = best(np.array([*face, *tried])), float(np.diff(face).max())
        for _ in range(ZOOMS):
            top = best(np.clip(top + spacing * ZOOM, 0.0, face[-1]))
            spacing *= ZOOM[1] - ZOOM[0]
        return top

    return position


def _climb(value: Callable[[float], float], start: float, length: float) -> None:
    """Call `value` at places from `start` uphill on a path of `length`, until the peak moves by less than `MOVES`."""
    step, x = STEP * length, start
    if value(x) <= 0.0:  # unsolved or unloaded
        return
    for _ in range(MOST_STEPS):
        low, high = max(x - step, 0.0), min(x + step, length)
        uphill = max((low, high), key=value)
        if value(uphill) <= value(x):
            break
        x = uphill
    for _ in range(MOST_STEPS):
        between = _vertex(value, low, x, high)
        if between is None:
            return
        gain = value(between) / value(x) - 1.0
        if gain > 0.0:
            low, x, high = (x, between, high) if between > x else (low, between, x)
        if gain < MOVES:
            return


def _vertex(value: Callable[[float], float], low: float, x: float, high: float) -> float | None:
    """Return the place between `low` and `high` where the peak at `x` may rise by `MOVES` or more; None if nowhere.

    It is the vertex of the parabola through the three values. At an end of the path, where there are only two values,
    it is the middle between both if they are nearly equal.
    """
    top, below = value(x), min(value(low), value(high))
    if x in (low, high):
        return (low + high) / 2 if top - below < 4 * MOVES * top else None
    rises = (top - value(low)) / (x - low), (value(high) - top) / (high - x)
    curvature = 2 * (rises[1] - rises[0]) / (high - low)
    if curvature >= 0.0:
        return None
    slope = (rises[0] * (high - x) + rises[1] * (x - low)) / (high - low)
    if slope**2 / (-2 * curvature) < MOVES * top:
        return None
    return x - slope / curvature
