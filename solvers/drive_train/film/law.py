"""Load, attitude angle and side flow of a plain bearing over its eccentricity ratio, from the table of solutions.

Cubic splines over L/D and over 1 - sqrt(1 - e) interpolate the table, so that all derivatives are continuous and
belong to the values: Newton's method for the gap keeps its steps. The short bearing is the same law at L/D = 0.
"""

from functools import lru_cache
from math import atan2, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.drive_train.film.table import LARGEST_ECCENTRICITY, PLACES, RATIOS, short_load, table, width_effect

WIDEST = RATIOS[-1]
"""Largest L/D of the table; a wider bearing carries per width what this one carries."""
KEPT = 64  # chosen: number of widths whose splines are kept in memory; a unit has at most four


class FilmLaw(NamedTuple):
    """The film of bearings of one L/D."""

    ratio: float  # L/D of the film: 0 for the short bearing, at most that of the table
    spline: FloatArray  # (interval, 4, 3) coefficients in the place, highest power first
    eccentricity: FloatArray  # (interval + 1,) ends of the intervals, from 0
    load: FloatArray  # (interval + 1,) load number at these ends


class FilmPoint(NamedTuple):
    """The film at an eccentricity ratio."""

    load: float  # in eta omega (D/2) L^3/(4 c^2)
    load_slope: float  # derivative with respect to the eccentricity ratio
    attitude: float  # rad, from the load to the displacement in the sense of rotation
    attitude_slope: float  # rad
    side_flow: float  # in U L c


@lru_cache(KEPT)
def film_law(ratio: float) -> FilmLaw:
    """Return the film of bearings of an L/D; 0 for the short bearing."""
    own = min(ratio, WIDEST)
    values = CubicSpline((0.0, *RATIOS), table())(own)
    spline = CubicSpline(PLACES, values).c.transpose(1, 0, 2)
    ends = frozen([0.0, *(1 - (1 - PLACES[1:-1]) ** 2), LARGEST_ECCENTRICITY])
    law = FilmLaw(own, frozen(np.ascontiguousarray(spline)), ends, frozen(np.zeros(0)))
    loads = np.array([film_at(law, eccentricity).load for eccentricity in ends])
    return law._replace(load=frozen(loads))


@kernel
def film_at(law: FilmLaw, eccentricity: float) -> FilmPoint:
    """Return load, attitude angle and side flow of a film, with derivatives (Eq. D18 and D19)."""
    e, rest = eccentricity, 1 - eccentricity**2
    root = sqrt(1 - e)
    first, step = PLACES[0], PLACES[1] - PLACES[0]
    interval = max(min(int((1 - root - first) / step), law.spline.shape[0] - 1), 0)
    place, coefficients = 1 - root - first - interval * step, law.spline[interval]
    ratio = ((coefficients[0] * place + coefficients[1]) * place + coefficients[2]) * place + coefficients[3]
    slope = ((3 * coefficients[0] * place + 2 * coefficients[1]) * place + coefficients[2]) / (2 * root)
    width = law.ratio**2 * width_effect(e)
    long_root, short_root = pi**2 * rest + 4 * e**2, pi**2 * rest + 16 * e**2
    width_slope = width * (
        2 * e / (2 + e**2) + e * (16 - pi**2) / short_root - e * (4 - pi**2) / long_root + 2 * e / rest
    )
    factor, root = ratio[0] / (1 + width), sqrt(short_root)
    load = short_load(e)
    load_slope = root / rest**2 + 4 * e**2 * root / rest**3 + e**2 * (16 - pi**2) / (rest**2 * root)
    across, along = pi * sqrt(rest), 4 * e * ratio[1]  # components of the displacement to the load
    across_slope, along_slope = -pi * e / sqrt(rest), 4 * (ratio[1] + e * slope[1])
    return FilmPoint(
        load * factor,
        load_slope * factor + load * (slope[0] - factor * width_slope) / (1 + width),
        atan2(across, along),
        (across_slope * along - across * along_slope) / (across**2 + along**2),
        e * ratio[2],
    )


@kernel
def eccentricity_at(law: FilmLaw, load: float) -> float:
    """Return the eccentricity ratio at a load number, which must not exceed that of the largest eccentricity ratio.

    Newton's iteration in the interval of the spline that holds the load; a step out of the bracket halves it.
    """
    interval = min(max(int(np.searchsorted(law.load, load)), 1), law.load.size - 1)
    low, high = float(law.eccentricity[interval - 1]), float(law.eccentricity[interval])
    eccentricity, before = (low + high) / 2, high
    while eccentricity != before:
        before = eccentricity
        point = film_at(law, eccentricity)
        if point.load > load:
            high = eccentricity
        else:
            low = eccentricity
        eccentricity -= (point.load - load) / point.load_slope
        if not low < eccentricity < high:
            eccentricity = (low + high) / 2
    return eccentricity
