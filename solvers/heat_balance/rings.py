"""A rotor as rings: steady conduction and free thermoelastic growth of a body of revolution, by finite elements.

The half section (z, r) is divided into quadrilaterals of 8 nodes with 3 x 3 Gauss points. Conduction and displacement
share the nodes. Everything that a gear asks of its body is linear in a few temperatures, the sources: those of the
rim's nodes, of the air at its faces and at the rim between two helices, and of the journals. It is computed once per
geometry.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from math import pi

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix, diags
from scipy.sparse.linalg import SuperLU, splu
from scipy.special import i0e, i1e

from solvers.arrays import FloatArray

IntArray = NDArray[np.int64]
POISSON_RATIO = 0.3  # of steel
RADIAL_RINGS = 8  # least number from the axis to the rim
RIM_CLUSTER = 1.6  # exponent of the radii: the rings are thinner towards the rim, where the heat enters
COARSER = 1.5  # growth of the rings' widths away from the face
CLOSE = 5e-4  # root radii; lines that are closer together are one
GAUSS = np.array([-(0.6**0.5), 0.0, 0.6**0.5])
GAUSS_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0))


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A hollow cylinder of the rotor: both ends and both radii [m]."""

    start: float
    end: float
    inner: float
    outer: float


@dataclass(frozen=True, slots=True)
class RotorGeometry:
    """The body of a gear with its shaft, as far as heat flows: lengths in [m].

    `faces` holds the lines between the rings of every toothed face, from end to end. `journals` says whether the low
    and the high end of the rotor is at the centre of a plain bearing, which holds the temperature there.
    """

    cylinders: tuple[Cylinder, ...]
    root_radius: float
    faces: tuple[tuple[float, ...], ...]
    journals: tuple[bool, bool] = (False, False)


@dataclass(frozen=True, slots=True)
class Exchange:
    """Conductivity of the rotor [W/(m K)], and heat transfer at the faces and between two helices [W/(m^2 K)]."""

    conductivity: float
    faces: float = 0.0
    between: float = 0.0


@dataclass(frozen=True, slots=True)
class Response:
    """What a rotor does per kelvin of each source: heat [W/K], and growth over the coefficient of expansion [m].

    `taken` (rim, sources) is the heat that the rim's nodes give to the body, `to_air` (sources,) what the faces and the
    rim between two helices give to the air, `to_journals` (2, sources) what flows into both journals. `radial` and
    `axial` (rim, sources) are the displacements of the rim's nodes.
    """

    taken: FloatArray
    to_air: FloatArray
    to_journals: FloatArray
    radial: FloatArray
    axial: FloatArray


@lru_cache(maxsize=64)
def response(geometry: RotorGeometry, exchange: Exchange | None) -> Response:
    """Respond to the sources; `exchange` None insulates the rotor everywhere but at the rim of its faces (Eq. W3)."""
    rings = rings_of(geometry)
    conductivity = 1.0 if exchange is None else exchange.conductivity
    matrix, loads = conductivity * rings.conduction, np.zeros((rings.z.size, 2))
    if exchange is not None:
        for column, (edges, along_r, transfer) in enumerate(
            ((rings.face_edges, True, exchange.faces), (rings.gap_edges, False, exchange.between))
        ):
            held, load = rings.transfer(edges, along_r=along_r)
            matrix, loads[:, column] = matrix + transfer * held, transfer * load
    rim, ends = rings.rim, rings.ends if exchange is not None else (np.zeros(0, np.int64), np.zeros(0, np.int64))
    sources = rim.size + 4
    temperatures = np.zeros((rings.z.size, sources))
    temperatures[rim, np.arange(rim.size)] = 1.0
    for k, nodes in enumerate(ends):
        temperatures[nodes, rim.size + 2 + k] = 1.0
    fixed = np.concatenate([rim, *ends])
    free = np.setdiff1d(np.arange(rings.z.size), fixed)
    entering = np.zeros_like(temperatures)
    entering[:, rim.size : rim.size + 2] = loads
    inner = splu(csc_matrix(matrix[free][:, free]))
    temperatures[free] = inner.solve((entering - matrix @ temperatures)[free])
    flows = matrix @ temperatures - entering  # what has to enter at the nodes whose temperature is given
    radial, axial = rings.growth(temperatures)
    air = loads.sum(axis=0)
    to_air = loads.sum(axis=1) @ temperatures
    to_air[rim.size : rim.size + 2] -= air
    return Response(
        taken=flows[rim],
        to_air=to_air,
        to_journals=-np.array([flows[nodes].sum(axis=0) for nodes in ends]),
        radial=radial[rim],
        axial=axial[rim],
    )


@lru_cache(maxsize=64)
def rings_of(geometry: RotorGeometry) -> "Rings":
    """Divide the half section of a rotor into rings."""
    return Rings.on(geometry, *_lines(geometry))


@dataclass(frozen=True)
class Rings:
    """Nodes at (z, r) [m], and the nodes of every ring and of the edges that exchange heat.

    `rim` are the nodes at the root circle of every face in the order of Z, `ends` those at the centre of the plain
    bearing at the low and the high end of the rotor.
    """

    z: FloatArray
    r: FloatArray
    elements: IntArray  # (rings, 8)
    rim: IntArray
    ends: tuple[IntArray, IntArray]
    face_edges: IntArray  # (edges, 3): end, middle, end
    gap_edges: IntArray

    @classmethod
    def on(cls, geometry: RotorGeometry, z_lines: FloatArray, r_lines: FloatArray) -> "Rings":
        """Divide the cylinders of a rotor along lines of constant z and r."""
        z, r = _with_middles(z_lines), _with_middles(r_lines)
        cells = _cells(geometry, z_lines, r_lines)
        number = np.arange(z.size * r.size).reshape(z.size, r.size)
        corners = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        i, j = np.nonzero(cells)
        used, elements = np.unique(
            np.stack([number[2 * i + a, 2 * j + b] for a, b in corners], axis=1), return_inverse=True
        )
        compact = np.full(number.size, -1)
        compact[used] = np.arange(used.size)
        place = compact[number]
        root = int(np.argmin(np.abs(r - geometry.root_radius)))

        def at(position: float) -> int:
            return int(np.argmin(np.abs(z - position)))

        rim = np.concatenate([place[at(face[0]) : at(face[-1]) + 1, root] for face in geometry.faces])
        sides = (geometry.faces[0][0], -1), (geometry.faces[-1][-1], 0)
        gaps = [
            place[k : k + 3, root]
            for one, other in pairwise(geometry.faces)
            for k in range(at(one[-1]), at(other[0]), 2)
        ]
        low, high = (
            (row[row >= 0] if held else np.zeros(0, np.int64))
            for row, held in zip((place[0], place[-1]), geometry.journals, strict=True)
        )
        return cls(
            z=np.repeat(z, r.size)[used],
            r=np.tile(r, z.size)[used],
            elements=elements.reshape(-1, 8),
            rim=rim,
            ends=(low, high),
            face_edges=np.array([edge for side in sides for edge in _exposed(cells, place, at(side[0]) // 2, side[1])]),
            gap_edges=np.array(gaps, dtype=np.int64).reshape(-1, 3),
        )

    @cached_property
    def conduction(self) -> csc_matrix:
        """Conductances between the nodes over the conductivity [m]."""
        blocks = np.zeros((len(self.elements), 8, 8))
        for shape, slopes, area in self._points():
            weight = area * 2 * pi * (self.r[self.elements] @ shape)
            blocks += np.einsum("e,eik,eil->ekl", weight, slopes, slopes)
        return _assembled(blocks, self.elements, self.elements, (self.z.size, self.z.size))

    def transfer(self, edges: IntArray, *, along_r: bool) -> tuple[csc_matrix, FloatArray]:
        """Conductances and loads of the surface at edges of rings, over the heat transfer coefficient [m^2]."""
        size = self.z.size
        if not edges.size:
            return csc_matrix((size, size)), np.zeros(size)
        r, along = self.r[edges], (self.r if along_r else self.z)[edges]
        half = (along[:, 2] - along[:, 0]) / 2
        blocks = np.zeros((len(edges), 3, 3))
        for s, weight in zip(GAUSS, GAUSS_WEIGHTS, strict=True):
            shape = line_shape(s)
            blocks += np.einsum("e,i,j->eij", weight * half * 2 * pi * (r @ shape), shape, shape)
        matrix = _assembled(blocks, edges, edges, (size, size))
        return matrix, np.asarray(matrix @ np.ones(size))

    def growth(self, rises: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Displacements (radial, axial) of all nodes by temperature rises of the nodes, over the expansion [m].

        The body is free; its position along the axis is arbitrary.
        """
        factor, loads = self._elastic
        moved = factor.solve(loads @ rises)
        return moved[1::2], moved[0::2]

    @cached_property
    def _elastic(self) -> tuple[SuperLU, csc_matrix]:
        """Factorised stiffness over Young's modulus, and the forces by temperature rises over modulus and expansion."""
        nu, count, size = POISSON_RATIO, len(self.elements), self.z.size
        scale = 1.0 / ((1 + nu) * (1 - 2 * nu))
        law = np.zeros((4, 4))  # of the strains along z, r, around the axis, and of the shear
        law[:3, :3] = scale * (nu + (1 - 2 * nu) * np.eye(3))
        law[3, 3] = scale * (1 - 2 * nu) / 2
        stress = law @ np.array([1.0, 1.0, 1.0, 0.0])
        stiffness, heat = np.zeros((count, 16, 16)), np.zeros((count, 16, 8))
        for shape, slopes, area in self._points():
            radius = self.r[self.elements] @ shape
            strain = np.zeros((count, 4, 16))
            strain[:, 0, 0::2], strain[:, 1, 1::2] = slopes[:, 0], slopes[:, 1]
            strain[:, 2, 1::2] = shape / radius[:, None]
            strain[:, 3, 0::2], strain[:, 3, 1::2] = slopes[:, 1], slopes[:, 0]
            volume = (area * 2 * pi * radius)[:, None, None]
            stiffness += volume * (strain.transpose(0, 2, 1) @ law @ strain)
            heat += volume * ((strain.transpose(0, 2, 1) @ stress)[:, :, None] * shape)
        degrees = np.stack([2 * self.elements, 2 * self.elements + 1], axis=2).reshape(count, -1)
        matrix = _assembled(stiffness, degrees, degrees, (2 * size, 2 * size))
        held = diags(np.where(np.arange(2 * size) == 0, float(matrix.diagonal().max()), 0.0))
        return splu(csc_matrix(matrix + held)), _assembled(heat, degrees, self.elements, (2 * size, size))

    def _points(self) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
        """Yield, per Gauss point, shape functions (8,), their slopes (rings, 2, 8) in z and r, and areas (rings,)."""
        z, r = self.z[self.elements], self.r[self.elements]
        width, height = (z[:, 1] - z[:, 0]) / 2, (r[:, 2] - r[:, 1]) / 2  # the rings are rectangles
        for s, by_s in zip(GAUSS, GAUSS_WEIGHTS, strict=True):
            for t, by_t in zip(GAUSS, GAUSS_WEIGHTS, strict=True):
                shape, slopes = _shapes(float(s), float(t))
                scaled = np.stack([slopes[0] / width[:, None], slopes[1] / height[:, None]], axis=1)
                yield shape, scaled, by_s * by_t * width * height


def cylinder_growth(slenderness: float) -> float:
    """Growth Phi of an endless cylinder whose surface has T = cos(k z), over that of free slices, at k R.

    (1 + nu) x q (1 - q^2)/(x^2 (1 - q^2) - 2 (1 - nu) q^2) with x = k R and q = I_1(x)/I_0(x): Goodier's potential and
    two solutions of the free elastic cylinder that free its surface.
    """
    x, q = slenderness, float(i1e(slenderness) / i0e(slenderness))
    rest = 1 - q**2
    return (1 + POISSON_RATIO) * x * q * rest / (x**2 * rest - 2 * (1 - POISSON_RATIO) * q**2)


def line_shape(s: float) -> FloatArray:
    """Quadratic shape functions of a line of three nodes at its local coordinate s from -1 to 1."""
    return np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2])


def _shapes(s: float, t: float) -> tuple[FloatArray, FloatArray]:
    """Shape functions (8,) of a ring at its local coordinates s along z and t along r, and their slopes (2, 8)."""
    shape, slopes = np.empty(8), np.empty((2, 8))
    for k, (a, b) in enumerate(CORNERS):
        if a and b:
            shape[k] = (1 + a * s) * (1 + b * t) * (a * s + b * t - 1) / 4
            slopes[:, k] = a * (1 + b * t) * (2 * a * s + b * t) / 4, b * (1 + a * s) * (a * s + 2 * b * t) / 4
        elif b:
            shape[k] = (1 - s * s) * (1 + b * t) / 2
            slopes[:, k] = -s * (1 + b * t), b * (1 - s * s) / 2
        else:
            shape[k] = (1 + a * s) * (1 - t * t) / 2
            slopes[:, k] = a * (1 - t * t) / 2, -t * (1 + a * s)
    return shape, slopes


def _assembled(blocks: FloatArray, rows: IntArray, columns: IntArray, shape: tuple[int, int]) -> csc_matrix:
    """Sum the blocks (elements, rows, columns) of all elements into a sparse matrix."""
    at = np.repeat(rows, columns.shape[1], axis=1).ravel(), np.tile(columns, (1, rows.shape[1])).ravel()
    return csc_matrix(coo_matrix((blocks.ravel(), at), shape=shape))


def _with_middles(lines: FloatArray) -> FloatArray:
    return np.sort(np.concatenate([lines, (lines[1:] + lines[:-1]) / 2]))


def _cells(geometry: RotorGeometry, z_lines: FloatArray, r_lines: FloatArray) -> NDArray[np.bool_]:
    """Say which cells between the lines belong to the rotor."""
    z, r = (z_lines[1:] + z_lines[:-1])[:, None] / 2, (r_lines[1:] + r_lines[:-1]) / 2
    inside = np.zeros((z.size, r.size), bool)
    for part in geometry.cylinders:
        inside |= (part.start < z) & (z < part.end) & (part.inner < r) & (r < part.outer)
    return inside


def _exposed(cells: NDArray[np.bool_], place: IntArray, line: int, outside: int) -> Iterator[IntArray]:
    """Yield the edges on a line of constant z that have a ring on one side only; `outside` is -1 below, 0 above."""
    inner = cells[line - 1 - outside]
    beyond = line + outside
    outer = cells[beyond] if 0 <= beyond < len(cells) else np.zeros_like(inner)
    for j in np.nonzero(inner & ~outer)[0]:
        yield place[2 * line, 2 * j : 2 * j + 3]


def _lines(geometry: RotorGeometry) -> tuple[FloatArray, FloatArray]:
    """Lines of constant z and r: at every step of the rotor, evenly over the faces, wider away from them."""
    first = geometry.faces[0]
    low, high, ring = first[0], geometry.faces[-1][-1], (first[-1] - first[0]) / (len(first) - 1)
    steps = {part.start for part in geometry.cylinders} | {part.end for part in geometry.cylinders}
    close = CLOSE * geometry.root_radius
    z = [line for face in geometry.faces for line in face]
    for one, other in pairwise(geometry.faces):
        start, end = one[-1], other[0]
        between = [step for step in steps if start + close < step < end - close]
        even = np.linspace(start, end, max(2, round((end - start) / ring)) + 1)[1:-1]
        z += between + [line for line in even if all(abs(line - step) > close for step in between)]
    z += _graded(sorted(step for step in steps if step > high), high, ring, close)
    z += [-step for step in _graded(sorted(-step for step in steps if step < low), -low, ring, close)]
    radii = {part.inner for part in geometry.cylinders} | {part.outer for part in geometry.cylinders}
    inner, outer = min(radii), geometry.root_radius
    even = inner + (outer - inner) * (1 - np.linspace(1, 0, RADIAL_RINGS + 1) ** RIM_CLUSTER)
    return np.unique(z), _merged(_apart(radii, close), even)


def _graded(steps: list[float], start: float, ring: float, close: float) -> list[float]:
    """Lines from `start` over all steps above it, at distances that grow from the width of a ring on."""
    lines, at, wide = list[float](), start, ring
    for k, step in enumerate(steps):
        if step - at < close and k < len(steps) - 1:
            continue
        count, length = 1, wide
        while length < step - at:
            count, length = count + 1, length + wide * COARSER**count
        shares = np.cumsum(COARSER ** np.arange(count))
        lines += list(at + (step - at) * shares / shares[-1])
        at, wide = step, max((step - at) * (shares[-1] - shares[-2]) / shares[-1] if count > 1 else step - at, ring)
    return lines


def _apart(radii: set[float], close: float) -> list[float]:
    """The radii in order, from the largest down, without those that are too close to one before."""
    kept = list[float]()
    for radius in sorted(radii, reverse=True):
        if not kept or kept[-1] - radius > close:
            kept.append(radius)
    return kept[::-1]


def _merged(kept: list[float], even: FloatArray) -> FloatArray:
    """All steps, and of the even lines those that are not too close to a step."""
    spacing = np.diff(even).mean() / 3
    lines = list(kept)
    lines += [line for line in even if min(abs(line - step) for step in kept) > spacing]
    return np.array(sorted(lines))
