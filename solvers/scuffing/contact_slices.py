"""Slices of all contact lines at one roll position, as the compiled kernels share them."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.gears.path_of_contact import ContactPlane
from solvers.scuffing.contact_lines import line_count, line_ends
from solvers.scuffing.modification import Gap, gap_at
from solvers.scuffing.tables import tabulated
from solvers.scuffing.tooth_stiffness import PairCompliance, line_load

# Rows of the slice table
X, Y, LENGTH, GAP, CONSTANT, LIMIT, OMEGA, LOAD, LINE = range(9)
ROWS = 9


class Mesh(NamedTuple):
    """Unloaded mesh: the plane of action, a pair's compliance, the gap."""

    plane: ContactPlane
    compliance: PairCompliance
    gap: Gap


@kernel
def gather(mesh: Mesh, phase: float, side: float, slices: int, table: FloatArray) -> tuple[int, float]:
    """Fill the columns of the slice table, one a slice (their middles); the number of slices and the least gap [m].

    The least gap counts the lines' ends too.
    """
    plane = mesh.plane
    count, least = 0, np.inf
    for j in range(line_count(plane)):
        line = phase + j * plane.base_pitch
        low, high = line_ends(plane, line, side)
        if high <= low:
            continue
        step = (high - low) / slices
        for i in range(slices):
            y = low + (i + 0.5) * step
            x = line - y * plane.tan_base_helix
            table[X, count], table[Y, count], table[LINE, count] = x, y, j
            table[LENGTH, count] = step / plane.cos_base_helix
            table[GAP, count] = gap_at(mesh.gap, x, y)
            table[CONSTANT, count] = tabulated(mesh.compliance.constant, mesh.compliance.points_per_metre, x)
            table[LIMIT, count] = tabulated(mesh.compliance.limit, mesh.compliance.points_per_metre, x)
            least = min(least, table[GAP, count])
            count += 1
        for y in (low, high):
            least = min(least, gap_at(mesh.gap, line - y * plane.tan_base_helix, y))
    return count, least


@kernel
def load_at(mesh: Mesh, error: float, x: float, y: float, omega: float) -> tuple[float, float]:
    """Line load w [N/m] at one point of the plane under the approach `error` [m], and omega, guessed by `omega`."""
    points_per_metre = mesh.compliance.points_per_metre
    load, _, omega = line_load(
        error - gap_at(mesh.gap, x, y),
        tabulated(mesh.compliance.constant, points_per_metre, x),
        mesh.compliance.logarithmic,
        tabulated(mesh.compliance.limit, points_per_metre, x),
        omega,
    )
    return load, omega
