"""python -m benchmarks.coverage: errors of the probabilities of load spectra, and what their intervals cover.

Two tables of the manual: what 90 % intervals cover, and how many machines a probability needs. Some minutes.
"""

from itertools import product
from typing import get_args

from app.studies.requests import Method
from tests.support.coverage import DISTANCES, Coverage, coverage

DEVIATIONS = (1.0, 0.5, 0.0)
TOLERANCES = (1, 2, 6)
COUNTS = (32, 128, 512, 2048)


def row(name: str, found: dict[float, Coverage]) -> str:
    """A line of the table: error of the estimates and coverage, in per cent, at each probability."""
    cells = [f"{100 * each.error:.2g} ({100 * each.covered:.0f})" for each in found.values()]
    return " | ".join([name, *cells])


def main() -> None:
    """Print error and coverage by probability."""
    print("limits at", DISTANCES, "deviations")
    for method, tolerances, deviation in product(get_args(Method), TOLERANCES, DEVIATIONS):
        print(row(f"{method} | {tolerances} | {deviation}", coverage(method, tolerances, deviation)), flush=True)
    for deviation, count in product(DEVIATIONS, COUNTS):
        print(row(f"8 x {count} | {deviation}", coverage("sobol", 6, deviation, count=count)), flush=True)


if __name__ == "__main__":
    main()
