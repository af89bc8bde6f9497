"""Reynolds' equation of a plain bearing of finite width, solved by finite volumes.

The axes are parallel, the viscosity is constant, and the bore has no groove. The pressure is nowhere below ambient, and
where the film ends its gradient is zero too (Reynolds' condition). Hence p >= 0, the equation holds where p > 0, and
where p = 0 the gap widens: a linear complementarity problem, which the active sets below solve exactly.

Lengths are in radii around the bore and in half widths along it, the film is in radial clearances c, and the pressure
is in eta omega (R/c)^2.
"""

from dataclasses import dataclass
from math import atan2, hypot, log1p, pi, sqrt

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import splu

from solvers.arrays import BoolArray, FloatArray

COARSEST = (32, 6)  # cells around the bore, and over half the width
GRADING = 0.35  # chosen: the grid around the bore is between uniform (0) and even in Sommerfeld's variable (0.5)
MOST_STEPS = 100  # chosen: from the film of the coarser grid the sets settle in fewer than ten steps


@dataclass(frozen=True, slots=True)
class FilmSolution:
    """Pressure of a film, and what follows from it."""

    angle: FloatArray  # (around,) rad, from the widest gap in the sense of rotation; the last is 2 pi
    across: FloatArray  # (across + 1,) from mid-width 0 to the edge 1
    pressure: FloatArray  # (around, across + 1)
    load: float  # in eta omega (R/c)^2 R L
    attitude: float  # rad, from the load to the displacement in the sense of rotation
    side_flow: float  # through both edges, in U L c


@dataclass(frozen=True, slots=True)
class _Grid:
    """Nodes around the bore, each with its cell between two faces, and nodes over half the width."""

    angle: FloatArray  # (n,)
    face: FloatArray  # (n + 1,) face i lies before node i
    across: FloatArray  # (m + 1,)
    size: FloatArray  # (m + 1,) cells over half the width; that of the edge has only its inner half


def solve_film(eccentricity: float, ratio: float, refinements: int = 3, *, groove: bool = False) -> FilmSolution:
    """Solve Reynolds' equation at an eccentricity ratio (0 < e < 1) and a ratio L/D of width to diameter (Eq. D17).

    The grid of 32 cells around and 6 cells over half the width is halved `refinements` times. With `groove`, an axial
    groove at ambient pressure lies at the widest gap, where Raimondi and Boyd let the film begin.
    """
    film = None
    for halvings in range(refinements + 1):
        grid = _grid(eccentricity, ratio, COARSEST[0] << halvings, COARSEST[1] << halvings)
        matrix, source = _equation(grid, eccentricity, ratio)
        fed = np.zeros((grid.angle.size, grid.across.size - 1), bool)
        fed[-1] = groove
        start = source > 0.0 if film is None else _on_finer_grid(film)
        inner = _complementary(matrix, source.ravel(), fed.ravel(), start.ravel()).reshape(fed.shape)
        film = inner > 0.0
    return _solution(grid, eccentricity, ratio, inner)


def _grid(eccentricity: float, ratio: float, around: int, across: int) -> _Grid:
    """Return a grid that is fine where the gap is narrow, and at the edges of a wide bearing."""
    stretch = ((1 + eccentricity) / (1 - eccentricity)) ** GRADING
    even = np.linspace(-pi, pi, 2 * around + 1)[1:-1]
    angle = np.append(2 * np.arctan(np.tan(even / 2) / stretch), pi) + pi
    layer = sqrt(1 - eccentricity**2) / ratio  # half widths over which the pressure falls to the edge
    steep = 0.5 * log1p(4 / layer)
    place = np.tanh(steep * np.linspace(0.0, 1.0, across + 1)) / np.tanh(steep)
    middle = (place[1:] + place[:-1]) / 2
    size = np.diff(np.concatenate([[0.0], middle, [1.0]]))
    return _Grid(angle[1::2], np.append(angle[::2], angle[0] + 2 * pi), place, size)


def _equation(grid: _Grid, eccentricity: float, ratio: float) -> tuple[csr_array, FloatArray]:
    """Return matrix and right side (around, across) of the equation for the pressures of all nodes but the edge's."""
    around, across = grid.angle.size, grid.across.size - 1
    faces, length = 1 + eccentricity * np.cos(grid.face[:-1]), np.diff(grid.angle, prepend=grid.angle[-1] - 2 * pi)
    before = np.outer(faces**3 / length, grid.size[:-1])
    beside = np.outer(_axial(grid, eccentricity, ratio), 1 / np.diff(grid.across))
    diagonal = before + np.roll(before, -1, axis=0) + beside
    diagonal[:, 1:] += beside[:, :-1]
    number = np.arange(around * across).reshape(around, across)
    pairs = [(number, np.roll(number, 1, axis=0), before), (number[:, :-1], number[:, 1:], beside[:, :-1])]
    row = np.concatenate([number.ravel(), *(np.concatenate([a.ravel(), b.ravel()]) for a, b, _ in pairs)])
    column = np.concatenate([number.ravel(), *(np.concatenate([b.ravel(), a.ravel()]) for a, b, _ in pairs)])
    entry = np.concatenate([diagonal.ravel(), *(-np.tile(value.ravel(), 2) for _, _, value in pairs)])
    matrix = csr_array(coo_array((entry, (row, column)), shape=(number.size, number.size)))
    return matrix, np.outer(_narrowing(grid, eccentricity), grid.size[:-1])


def _axial(grid: _Grid, eccentricity: float, ratio: float) -> FloatArray:
    return (1 + eccentricity * np.cos(grid.angle)) ** 3 * np.diff(grid.face) / ratio**2


def _narrowing(grid: _Grid, eccentricity: float) -> FloatArray:
    """Return the oil that the narrowing gap displaces from each cell around the bore."""
    return np.asarray(-6 * eccentricity * np.diff(np.cos(grid.face)))


def _on_finer_grid(film: BoolArray) -> BoolArray:
    """Return the nodes of the next finer grid that lie on a node with pressure or beside one."""
    around = np.repeat(film, 2, axis=0)
    around[::2] |= np.roll(film, 1, axis=0)
    both = np.repeat(around, 2, axis=1)
    both[:, 1:-1:2] |= around[:, 1:]
    return both


def _complementary(matrix: csr_array, source: FloatArray, fed: BoolArray, film: BoolArray) -> FloatArray:
    """Solve p >= 0, A p - b >= 0, p (A p - b) = 0 by active sets; p = 0 where the bore is `fed`.

    A is an M-matrix, so the sets settle from any start (Hintermueller, Ito, Kunisch 2002), and the solution is exact.
    """
    for _ in range(MOST_STEPS):
        inside = np.flatnonzero(film & ~fed)
        pressure = np.zeros(source.size)
        block = matrix[inside][:, inside].tocsc()
        pressure[inside] = splu(block, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(
            source[inside]
        )
        following = np.where(film, pressure > 0.0, matrix @ pressure < source) & ~fed
        if np.array_equal(following, film & ~fed):
            return pressure
        film = following
    raise AssertionError("the film of a plain bearing does not settle")


def _solution(grid: _Grid, eccentricity: float, ratio: float, inner: FloatArray) -> FilmSolution:
    """Integrate the pressure for load and attitude angle, and the flow through the edges."""
    mean = inner @ grid.size[:-1] * np.diff(grid.face)
    radial, tangential = -float(mean @ np.cos(grid.angle)), float(mean @ np.sin(grid.angle))
    step = grid.across[-1] - grid.across[-2]
    displaced = np.where(inner[:, -1] > 0.0, _narrowing(grid, eccentricity), 0.0)  # by the half cell at the edge
    flow = _axial(grid, eccentricity, ratio) * inner[:, -1] / step + displaced * grid.size[-1]
    return FilmSolution(
        angle=grid.angle,
        across=grid.across,
        pressure=np.column_stack([inner, np.zeros(grid.angle.size)]),
        load=hypot(radial, tangential),
        attitude=atan2(tangential, radial),
        side_flow=float(flow.sum()) / 12,
    )
