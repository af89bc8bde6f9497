"""Modification, line load and pressure over the flank."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact import hertz
from solvers.gears.path_of_contact import reduced_radius
from solvers.scuffing.balance.load_balance import LoadBalance, line_loads
from solvers.scuffing.flank.modification import gaps_at
from solvers.scuffing.results import Flank


def flank(balance: LoadBalance, modulus: float, profile_points: int, face_points: int) -> Flank:
    """Maps [profile, face] from A to E and from the end that meshes first; modulus E' [Pa]."""
    plane = balance.mesh.plane
    profile, face = np.linspace(0.0, 1.0, profile_points), np.linspace(0.0, 1.0, face_points)
    x, y = np.meshgrid(profile * plane.path_length, face * plane.face_width, indexing="ij")
    gap = gaps_at(balance.mesh.gap, x, y)
    load = line_loads(balance, x, y, gap)
    return Flank(
        profile_fraction=frozen(profile),
        face_fraction=frozen(face),
        modification=frozen(gap),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(balance, x, load, modulus)),
    )


def contact_pressure(balance: LoadBalance, x: FloatArray, load: FloatArray, modulus: float) -> FloatArray:
    """Hertz pressure p_H [Pa] at x [m] under w [N/m].

    0 without load; NaN near a base circle, towards which the reduced radius vanishes and pressure has no limit.
    Eq. 14 prints pi/4 of it, the mean pressure, and calls it the maximum.
    """
    radius = reduced_radius(balance.mesh.plane, x)
    defined = radius >= balance.mesh.plane.least_radius
    pressure = hertz.maximum_pressure(load, np.where(defined, radius, 1.0), modulus)
    return np.where(defined, pressure, np.nan)
