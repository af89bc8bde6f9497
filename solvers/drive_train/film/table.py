"""Solutions of Reynolds' equation over eccentricity ratio and width, kept in `table.csv`.

A row holds eccentricity ratio, L/D, and three ratios that change little over the table: the load over
`load_estimate`, the cotangent of the attitude angle and the side flow over those of the short bearing. At L/D = 0 all
three are 1. `python -m solvers.drive_train.film` solves the equation anew (two minutes on two cores).
"""

from functools import cache
from math import pi, sqrt, tan
from multiprocessing import Pool
from pathlib import Path

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.drive_train.film.reynolds import solve_film

FILE = Path(__file__).with_name("table.csv")
LARGEST_ECCENTRICITY = 0.999  # chosen: the film is then a thousandth of the clearance, thinner than any roughness
LEAST_ECCENTRICITY = 0.005  # chosen: so light a load has the three ratios of no load to 1e-5
PLACES = np.linspace(1 - sqrt(1 - LEAST_ECCENTRICITY), 1 - sqrt(1 - LARGEST_ECCENTRICITY), 31)
"""Values of 1 - sqrt(1 - e) of the rows, equidistant: the pressure is as long as the square root of the film."""
RATIOS = (0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.25, 1.5, 2.0)
"""Values of L/D of the rows; L/D = 0 is the short bearing, and is not in the file."""


@kernel
def short_load(eccentricity: float) -> float:
    """Load of a short bearing in eta omega (D/2) L^3/(4 c^2) (Eq. D4); its film ends where the gap is narrowest."""
    rest = 1 - eccentricity**2
    return eccentricity / rest**2 * sqrt(pi**2 * rest + 16 * eccentricity**2)


@kernel
def width_effect(eccentricity: float) -> float:
    """Load of the short bearing of L/D = 1 over that of a long one with half its film (Eq. D18)."""
    square = eccentricity**2
    rest = 1 - square
    return (2 + square) * sqrt((pi**2 * rest + 16 * square) / (pi**2 * rest + 4 * square)) / (6 * rest)


def ratios(eccentricity: float, width_ratio: float, refinements: int = 3) -> tuple[float, float, float]:
    """Solve the equation, and return the three ratios of the table: of load, cotangent of the attitude, side flow."""
    film = solve_film(eccentricity, width_ratio, refinements)
    estimate = short_load(eccentricity) / (1 / width_ratio**2 + width_effect(eccentricity))
    short = 4 * eccentricity / (pi * sqrt(1 - eccentricity**2))
    return film.load / estimate, 1 / (tan(film.attitude) * short), film.side_flow / eccentricity


@cache
def table() -> FloatArray:
    """Return the table (L/D, place, 3); the first row is L/D = 0."""
    rows = np.loadtxt(FILE, delimiter=",", skiprows=1)[:, 2:].reshape(len(RATIOS), PLACES.size, 3)
    return frozen(np.concatenate([np.ones((1, PLACES.size, 3)), rows]))


def nodes() -> list[tuple[float, float]]:
    """Return eccentricity ratio and L/D of all rows of the file."""
    return [(float(1 - (1 - place) ** 2), ratio) for ratio in RATIOS for place in PLACES]


def write_table() -> None:
    """Solve the equation at all nodes, and write the file."""
    with Pool() as pool:
        solved = pool.starmap(ratios, nodes(), chunksize=8)
    rows = [(*node, *values) for node, values in zip(nodes(), solved, strict=True)]
    head = "eccentricity,width_ratio,load,cotangent,side_flow"
    np.savetxt(FILE, np.array(rows), fmt="%.6f", delimiter=",", header=head, comments="")
