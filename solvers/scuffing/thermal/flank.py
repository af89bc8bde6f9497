"""Flash temperature (Blok) and film (Dowson and Higginson) over the flank; search for hottest point and thinnest film.

Xue, Zhang and Wang (2020) consider only the feature line, which is a diagonal of the flank. If the load is carried at
one end of the face, the feature line misses the hot corner of the flank. If the flank is crowned, the feature line
crosses the loaded middle of the face only near the pitch point, where the flanks do not slide. The search therefore
covers the whole flank. First, the largest value over the face is taken at every place along the path. Then the search
continues on finer grids around the places at which these values are highest.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solvers.arrays import BoolArray, FloatArray, IntArray
from solvers.contact.film import dowson_higginson_minimum
from solvers.contact.hertz import reduced_modulus
from solvers.scuffing.contact_lines import line_count
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.flank_results import TOPS, contact_points, tops
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs
from solvers.scuffing.load_balance import BESIDE, LoadBalance, line_loads
from solvers.scuffing.results import ContactPoints, LoadDistribution
from solvers.scuffing.thermal.blok import blok_flash

SURVEY_POINTS = 4001  # points of the feature line at which the formulas are evaluated to find extreme values
# Steps of the previous grid that a zoom covers on each side. The steps shrink by 2 and then 4 times by 4:
# where the load is flat over the face, a coarser place depends on the hand of the pair.
REACHES = (2, 1, 1, 1, 1)
ZOOM_POINTS = 9  # number of points of a zoom, both along the path and across the face
ZOOM_FRACTIONS = np.linspace(0.0, 1.0, ZOOM_POINTS)

FlankFunction = Callable[[FloatArray, FloatArray], FloatArray]
"""A function that returns values at points x, y [m] of the flank; all arrays have one shape."""

FaceFunction = Callable[[FloatArray], FloatArray]
"""A function that returns values at distances y [m] from the end that meshes first."""

ContactFunction = Callable[[ContactPoints], FloatArray]
"""A function that returns values at contacts."""


@dataclass(frozen=True, slots=True)
class FlashMap:
    """Blok's flash temperature over a grid of the flank.

    The grid has the coordinates x (n,) along the path and y (m,) along the face [m]. The line load `load` [N/m] and the
    flash temperature `flash` [K] have the shape (n, m). `flash` is NaN at points without a finite flash temperature.
    `heaviest` contains, for every x, the contact with the largest load.

    At every x at which the load jumps, the grid has two additional rows: one just before and one just behind the jump.
    The flank's maps do not contain these rows, so `mapped` is False for them.
    """

    x: FloatArray
    y: FloatArray
    load: FloatArray
    heaviest: ContactPoints
    flash: FloatArray
    mapped: BoolArray


def contact_at_points(
    given: LoadDistributionInputs, distribution: LoadDistribution, x: FloatArray, y: FloatArray
) -> ContactPoints:
    """Return the contacts at points x, y [m] of the flank; x and y are arrays of one shape."""
    return contacts_under_load(given, distribution, x, line_loads(distribution.balance, x, y))


def contacts_under_load(
    given: LoadDistributionInputs, distribution: LoadDistribution, x: FloatArray, load: FloatArray
) -> ContactPoints:
    """Return the contacts at distances x [m] from A under line loads [N/m]; x and load are arrays of one shape."""
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    return contact_points(distribution.path_of_contact, x, load, given.load.pinion_speed, modulus)


def map_flash(given: LoadDistributionInputs, distribution: LoadDistribution) -> FlashMap:
    """Compute Blok's flash temperature at the points of the flank's maps, and on both sides of every load jump.

    Blok's formula is evaluated only once for every position along the path, with the largest load over the face. At the
    other points of the face, the flash temperature follows from the load: it is proportional to the load to the power
    3/4.
    """
    plane, flank = distribution.path_of_contact.plane, distribution.flank
    x, y = flank.profile_fraction * plane.path_length, flank.face_fraction * plane.face_width
    load, mapped, jumps = flank.line_load, np.full(x.size, True), _jumps(distribution.balance)
    if jumps.size:
        rows = np.searchsorted(x, jumps)
        beside = line_loads(distribution.balance, *np.meshgrid(jumps, y, indexing="ij"))
        x, load, mapped = (
            np.insert(x, rows, jumps),
            np.insert(load, rows, beside, axis=0),
            np.insert(mapped, rows, False),
        )
    heaviest = contacts_under_load(given, distribution, x, load.max(axis=1))
    share = load / np.where(heaviest.line_load > 0.0, heaviest.line_load, 1.0)[:, None]
    largest = blok_flash(given, heaviest)
    with np.errstate(invalid="ignore"):  # NaN appears at points where the flash temperature has no limit
        flash = np.where(share > 0.0, largest[:, None] * np.sqrt(share * np.sqrt(share)), 0.0)
    return FlashMap(x, y, load, heaviest, flash, mapped)


def _jumps(balance: LoadBalance) -> FloatArray:
    """Return x [m] just before and just behind every load jump of a spur gear, in ascending order.

    At a jump another pair of teeth comes into contact or leaves contact, over the whole face at once.
    """
    plane, phase = balance.mesh.plane, balance.rolls.phase
    if plane.tan_base_helix > 0.0:
        return np.empty(0)
    phases = np.append(phase[1:][np.diff(phase) == 0.0], 0.0)
    places = np.add.outer(phases, plane.base_pitch * np.arange(line_count(plane) + 1)).ravel()
    width = BESIDE * plane.path_length
    inner = places[(places > 2 * width) & (places < plane.path_length - 2 * width)]
    return np.unique(np.concatenate([inner - width, inner + width]))


def mean_flash(flash: FlashMap) -> float | None:
    """Return the mean flash temperature over the flank [K]; return None if the flash temperature of a point is NaN."""
    if np.isnan(flash.flash).any():
        return None
    over_face = np.trapezoid(flash.flash, flash.y, axis=1) / flash.y[-1]
    return float(np.trapezoid(over_face, flash.x) / flash.x[-1])


def find_hottest(
    given: LoadDistributionInputs,
    distribution: LoadDistribution,
    flash: FlashMap,
    bulk: FaceFunction | None = None,
) -> Peak | None:
    """Find the largest flash temperature over the flank, or the largest sum of bulk and flash temperature.

    `bulk`: function that returns the bulk temperature [K] at distances y [m] from the end that meshes first. If `bulk`
    is given, the result is the largest sum of bulk and flash temperature. If `bulk` is None, the result is the largest
    flash temperature. Returns largest value [K] and its place [m]; None if the flash temperature of a point is NaN.
    """
    if np.isnan(flash.flash).any():
        return None

    def value(x: FloatArray, y: FloatArray) -> FloatArray:
        temperature = blok_flash(given, contact_at_points(given, distribution, x, y))
        return temperature if bulk is None else temperature + bulk(y)

    peak = find_largest(flash, flash.flash if bulk is None else flash.flash + bulk(flash.y), value)
    return _or_beside(distribution, peak, value)


def find_thinnest(
    given: LoadDistributionInputs, distribution: LoadDistribution, flash: FlashMap, film_at: ContactFunction
) -> Peak | None:
    """Find the thinnest film over the flank by the formula of Dowson and Higginson.

    Returns thinnest film [m] and its place [m]; None if no point has a film.
    """

    def value(x: FloatArray, y: FloatArray) -> FloatArray:
        return thinness(film_at, contact_at_points(given, distribution, x, y))

    on_grid = thinness_map(flash, film_at)
    if not on_grid.any():
        return None
    peak = _or_beside(distribution, find_largest(flash, on_grid, value), value)
    return Peak(1.0 / peak.value, peak.x, peak.y)


def thinness(film_at: ContactFunction, points: ContactPoints) -> FloatArray:
    """Return the reciprocal of the film [1/m]; 0 where there is no film."""
    film = film_at(points)
    return np.divide(1.0, film, out=np.zeros(film.shape), where=~np.isnan(film))


def thinness_map(flash: FlashMap, film_at: ContactFunction) -> FloatArray:
    """Return the reciprocal of the film [1/m] on the grid at the heaviest contact of every x, and 0 elsewhere."""
    on_grid = np.zeros(flash.load.shape)
    on_grid[np.arange(flash.x.size), np.argmax(flash.load, axis=1)] = thinness(film_at, flash.heaviest)
    return on_grid


def formula_film(inputs: ScuffingInputs) -> ContactFunction:
    """Return a function that computes the minimum film [m] of contacts by the formula of Dowson and Higginson.

    The film is NaN at points that are not in contact. If the oil or the bulk temperature is unknown, the film is NaN at
    all points.
    """
    lubricant, bulk = inputs.lubricant, inputs.temperatures.bulk
    if lubricant is None or bulk is None:
        return lambda points: np.full(points.line_load.shape, np.nan)
    viscosity, pressure_viscosity = lubricant.viscosity_at(0.0, bulk), lubricant.pressure_viscosity
    modulus = reduced_modulus(inputs.distribution.pinion_material, inputs.distribution.wheel_material)

    def film_at(points: ContactPoints) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):  # division by zero at points that are not in contact
            film = dowson_higginson_minimum(
                viscosity=viscosity,
                pressure_viscosity=pressure_viscosity,
                mean_speed=(points.pinion_speed + points.wheel_speed) / 2,
                radius=points.radius,
                line_load=points.line_load,
                modulus=modulus,
            )
        return np.where(points.in_contact, film, np.nan)

    return film_at


def on_diagonals(distribution: LoadDistribution, peak: Peak, function: FlankFunction) -> Peak:
    """Return the highest of `peak`, the peak on the feature line, and the peaks that `_or_beside` adds.

    The feature line is the diagonal of the flank that runs from A at y = 0 to E at the other end of the face.
    """
    along_feature_line = _peak_along(distribution, function, mirrored=False)
    return _or_beside(distribution, max(peak, along_feature_line, key=_height), function)


def _or_beside(distribution: LoadDistribution, peak: Peak, function: FlankFunction) -> Peak:
    """Return `peak`, or a higher peak on the profile line through `peak` or, for spur pairs, on a diagonal.

    The diagonal is the mirror image of the feature line. If a spur pair is mirrored, the feature line and this
    diagonal change places, so the largest value of both diagonals stays the same.
    """
    peak = max(peak, _peak_at_kinks(distribution, function, peak), key=_height)
    if distribution.path_of_contact.plane.tan_base_helix > 0.0:
        return peak
    return max(peak, _peak_along(distribution, function, mirrored=True), key=_height)


def _peak_at_kinks(distribution: LoadDistribution, function: FlankFunction, peak: Peak) -> Peak:
    """Find the largest value on the profile line through `peak`, at the roll positions of the load balance.

    Where another pair of teeth begins to carry load, the load has a sharp maximum, always at a roll position. A search
    over the grid can miss this maximum, because the roll positions may be closer together than the points of the grid.
    """
    plane, rolls = distribution.path_of_contact.plane, distribution.balance.rolls
    # At the other roll positions the load of a spur gear jumps; the map contains both sides of these jumps.
    phase = rolls.phase[rolls.side == 0.0]
    lines = np.add.outer(plane.base_pitch * np.arange(line_count(plane)), phase).ravel()
    x = np.unique(np.clip(lines - peak.y * plane.tan_base_helix, 0.0, plane.path_length))
    values = function(x, np.full(x.size, peak.y))
    top = int(np.argmax(np.where(np.isnan(values), -np.inf, values)))
    return Peak(float(values[top]), float(x[top]), peak.y)


def _peak_along(distribution: LoadDistribution, function: FlankFunction, *, mirrored: bool) -> Peak:
    """Find the largest value of a function along the feature line, or along the other diagonal of the flank."""
    plane = distribution.path_of_contact.plane
    ends = (plane.face_width, 0.0) if mirrored else (0.0, plane.face_width)
    x, y = np.linspace(0.0, plane.path_length, SURVEY_POINTS), np.linspace(*ends, SURVEY_POINTS)
    values = function(x, y)
    top = int(np.argmax(values))
    return Peak(float(values[top]), float(x[top]), float(y[top]))


def _height(peak: Peak) -> float:
    return peak.value


def find_largest(grid: FlashMap, values: FloatArray, function: FlankFunction) -> Peak:
    """Find the largest value of a function over the flank.

    `values` (n, m) are the values of the function on the grid. The search takes the largest value over the face at
    every x, and refines where these values have their highest peaks along the path.
    """
    return max(refined(grid, values, function, tops(values.max(axis=1))[-TOPS:]), key=_height)


def refined(grid: FlashMap, values: FloatArray, function: FlankFunction, rows: Sequence[int]) -> list[Peak]:
    """Find the largest value of a function near its largest value in each of the `rows` of the grid.

    The function is evaluated on finer and finer grids; `values` (n, m) are its values on the first.
    """
    highest, across = np.array(rows), np.argmax(values, axis=1)
    top, (i, k) = np.arange(highest.size), (highest, across[highest])
    x, y = np.tile(grid.x, (highest.size, 1)), np.tile(grid.y, (highest.size, 1))
    peaks = values[i, k], x[top, i], y[top, k]
    for reach in REACHES:
        x, y = _around(x, i, reach), _around(y, k, reach)
        near = function(np.repeat(x[:, :, None], y.shape[1], axis=2), np.repeat(y[:, None, :], x.shape[1], axis=1))
        i, k = np.divmod(np.argmax(near.reshape(highest.size, -1), axis=1), y.shape[1])
        peaks = near[top, i, k], x[top, i], y[top, k]
    return [Peak(*place) for place in zip(*(numbers.tolist() for numbers in peaks), strict=True)]


def _around(places: FloatArray, top: IntArray, reach: int) -> FloatArray:
    """Return, for every row of `places`, a new, finer row of places around the place with the index in `top`.

    The new row extends over `reach` steps of the old row to both sides of this place, but not beyond the ends of the
    old row. The new row always contains this place.
    """
    row, last = np.arange(top.size), places.shape[1] - 1
    centre = places[row, top]
    low, high = places[row, np.maximum(top - reach, 0)], places[row, np.minimum(top + reach, last)]
    near: FloatArray = low[:, None] + (high - low)[:, None] * ZOOM_FRACTIONS
    near[row, np.argmin(np.abs(near - centre[:, None]), axis=1)] = centre
    return near
