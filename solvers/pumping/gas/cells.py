"""The cells of a duct, as the compiled kernels of a gas step share them."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.flow.duct import AREA, CARRIED, CLEARANCE, Duct, Wall, stroke_share, wall_at

# Columns of contents and fluxes, of states, of losses, of ends; walls have those of a duct's table.
MASS, MOMENTUM, ENERGY = range(3)
DENSITY, VELOCITY, PRESSURE = range(3)
LEAKED, GIVEN, WORKED = range(3)
DEMAND, MACH, OUTWARD = range(3)
LATEST, HALFWAY, GROWTH = range(3)


class Cells(NamedTuple):
    """Arrays of a duct, each (cells, 3) or (faces, 3).

    `content` per metre (mass, momentum, energy), `state` (density, velocity, pressure); `walls` at the start of the
    step and `next_walls` at its end (area, clearance, carried gas); `slope` and `half` of the state; `loss` over the
    step (leaked mass, energy given to the walls, gauge work done by them; per metre); `face_area` and `flux` at the
    half step; `ends` (2, 3) of the low and the high end: Mach number asked for, Mach number, velocity outwards [m/s];
    `leak` the latest flux out through the gaps, that halfway through the step [kg/(s m)] and its growth over the last
    one [kg/(s^2 m)], first guesses for the next; `share` (cells,) of the step in which a cell's centre is in its
    stroke: outside it the walls stand still and nothing leaks.
    """

    content: FloatArray
    state: FloatArray
    next_content: FloatArray
    next_state: FloatArray
    walls: FloatArray
    next_walls: FloatArray
    slope: FloatArray
    half: FloatArray
    loss: FloatArray
    face_area: FloatArray
    flux: FloatArray
    ends: FloatArray
    leak: FloatArray
    share: FloatArray


def empty_cells(cells: int) -> Cells:
    """Arrays for a duct of so many cells."""
    wide, faces = (cells, 3), cells + 1
    return Cells(
        content=np.zeros(wide),
        state=np.zeros(wide),
        next_content=np.zeros(wide),
        next_state=np.zeros(wide),
        walls=np.zeros(wide),
        next_walls=np.zeros(wide),
        slope=np.zeros(wide),
        half=np.zeros(wide),
        loss=np.zeros(wide),
        face_area=np.zeros(faces),
        flux=np.zeros((faces, 3)),
        ends=np.zeros((2, 3)),
        leak=np.zeros(wide),
        share=np.zeros(cells),
    )


@kernel
def set_walls(duct: Duct, cells: Cells, low: int, high: int, angle: float, turn: float) -> None:
    """Walls of the active cells at the start and the end of a step, areas of their faces in its middle."""
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        share = stroke_share(duct, z, angle, turn)
        cells.share[i] = share
        _put(cells.walls, i, wall_at(duct, z, angle), share)
        _put(cells.next_walls, i, wall_at(duct, z, angle + turn), share)
    for i in range(low, high + 1):
        cells.face_area[i] = wall_at(duct, duct.start + i * duct.width, angle + 0.5 * turn).area


@kernel
def _put(walls: FloatArray, i: int, wall: Wall, share: float) -> None:
    """Walls of cell i, whose clearance is open for a share of the step."""
    walls[i, AREA], walls[i, CLEARANCE], walls[i, CARRIED] = wall.area, share * wall.clearance, wall.carried
