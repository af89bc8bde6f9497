"""Count how often the confidence interval of a probability contains the true probability.

The output of the simulated machine is the sum of its normally distributed tolerances.
"""

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
"""Each number is the distance from the mean output to the mean limit, in standard deviations of their difference.

The output is beyond a limit at these distances with probabilities of 31, 16, 6.7, 2.3, 0.62 and 0.13 %.
"""


class Coverage(NamedTuple):
    """`truth` is the true probability that the output is beyond the limit.

    `error` is the standard deviation of the estimated probabilities, divided by `truth`. `covered` is the share of
    90 % intervals that contain `truth`.
    """

    truth: float
    error: float
    covered: float


@cache
def outputs_of(method: Method, tolerances: int, count: int, replicates: int, studies: int) -> list[FloatArray]:
    """Return the outputs (replicates, draws) of each of the studies. The seeds of the studies count from 0."""
    # The outputs are deviations from the mean output, divided by the standard deviation of the output.
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
    """Return how often the interval contains the true probability, for each distance of the limit.

    `deviation` is the standard deviation of the limit, divided by the standard deviation of the output. If `deviation`
    is zero, the limit is fixed.
    """
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
