"""How often intervals of probabilities cover the truth: a machine whose output is the sum of normal tolerances."""

from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.stats import norm

from app.calculations import BY_PATH
from app.schema.fields import leaves
from app.studies.point_sets import drawn, unit_cube
from app.studies.requests import Method, Normal
from app.studies.statistics import Limit, of_case
from solvers.arrays import FloatArray

FRICTION = next(leaf for leaf in leaves(BY_PATH["/v1/coupling"].request) if leaf.path == "friction.coefficient")
DISTANCES = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
"""From the mean output to the limit, in deviations of both together: 31, 16, 6.7, 2.3, 0.62 and 0.13 %."""


class Coverage(NamedTuple):
    """The probability, the deviation of its estimates over itself, and the share of 90 % intervals that hold it."""

    truth: float
    error: float
    covered: float


@cache
def outputs_of(method: Method, tolerances: int, count: int, replicates: int, studies: int) -> list[FloatArray]:
    """The outputs of every replicate of studies with seeds from 0, in their deviations."""
    scatter = [Normal(path=str(each), distribution="normal", mean=1.0, deviation=0.1) for each in range(tolerances)]
    found = []
    for seed in range(studies):
        seeds = np.random.SeedSequence(seed).spawn(replicates)
        cubes = [unit_cube(method, count, tolerances, np.random.default_rng(each), "") for each in seeds]
        values = drawn(scatter, [FRICTION] * tolerances, np.concatenate(cubes))
        found.append((values - 1.0).sum(axis=1).reshape(replicates, count) / (0.1 * tolerances**0.5))
    return found


def coverage(
    method: Method, tolerances: int, deviation: float, *, count: int = 128, replicates: int = 8, studies: int = 400
) -> dict[float, Coverage]:
    """By distance of the limit, whose deviation is given in those of the output; zero is a fixed limit."""
    estimates: dict[float, list[float]] = {distance: [] for distance in DISTANCES}
    covered = dict.fromkeys(DISTANCES, 0)
    for outputs in outputs_of(method, tolerances, count, replicates, studies):
        for distance in DISTANCES:
            limit = Limit("above", distance * (1.0 + deviation**2) ** 0.5, deviation)
            found = of_case(outputs, limit)
            assert found.interval is not None
            estimates[distance].append(found.bounds[0])
            covered[distance] += found.interval[0] <= norm.sf(distance) <= found.interval[1]
    return {
        distance: Coverage(truth, float(np.std(estimates[distance])) / truth, covered[distance] / studies)
        for distance, truth in zip(DISTANCES, norm.sf(DISTANCES), strict=True)
    }
