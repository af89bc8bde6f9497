"""Modification, line load and pressure over the flank."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.contact import hertz
from solvers.gears.path_of_contact import reduced_radius
from solvers.scuffing.balance.contact_slices import Mesh
from solvers.scuffing.balance.load_balance import LoadBalance, error_at
from solvers.scuffing.flank.modification import lead_gaps, profile_gap
from solvers.scuffing.results import Flank
from solvers.scuffing.teeth.stiffness import compliance_at, line_load


def flank(balance: LoadBalance, modulus: float, profile_points: int, face_points: int) -> Flank:
    """Maps [profile, face] from A to E and from the end that meshes first; modulus E' [Pa]."""
    plane = balance.mesh.plane
    profile, face = np.linspace(0.0, 1.0, profile_points), np.linspace(0.0, 1.0, face_points)
    x, y = profile * plane.path_length, face * plane.face_width
    gap, load = _maps(balance.mesh, balance.rolls.phase, balance.transmission_error, balance.force > 0.0, x, y)
    return Flank(
        profile_fraction=frozen(profile),
        face_fraction=frozen(face),
        modification=frozen(gap),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(balance, x[:, None], load, modulus)),
    )


@kernel
def _maps(
    mesh: Mesh, phase: FloatArray, error: FloatArray, loaded: bool, x: FloatArray, y: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gap Delta [m] and line load w [N/m] over a grid.

    A point's load starts from that in the row before, which waits for no neighbour.
    """
    plane, compliance, form = mesh.plane, mesh.compliance, mesh.gap
    gaps, loads = np.empty((x.size, y.size)), np.zeros((x.size, y.size))
    across = lead_gaps(form, y)
    log_load, index = np.zeros(y.size), 0
    for i in range(x.size):
        along = profile_gap(form, x[i])
        constant, limit = compliance_at(compliance, x[i])
        for k in range(y.size):
            gaps[i, k] = along + across[k]
            if loaded:
                reached, index = error_at(plane, phase, error, x[i], y[k], index)
                loads[i, k], _, log_load[k] = line_load(
                    reached - gaps[i, k], constant, compliance.logarithmic, limit, log_load[k]
                )
    return gaps, loads


def contact_pressure(balance: LoadBalance, x: FloatArray, load: FloatArray, modulus: float) -> FloatArray:
    """Hertz pressure p_H [Pa] at x [m] under w [N/m].

    0 without load; NaN near a base circle, towards which the reduced radius vanishes and pressure has no limit.
    Eq. 14 prints pi/4 of it, the mean pressure, and calls it the maximum.
    """
    radius = reduced_radius(balance.mesh.plane, x)
    defined = radius >= balance.mesh.plane.least_radius
    pressure = hertz.maximum_pressure(load, np.where(defined, radius, 1.0), modulus)
    return np.where(defined, pressure, np.nan)
