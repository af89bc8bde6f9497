"""Conservation of mass and load: the system for the pressures and the rigid separation, and steps in them."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.film.fluxes import FaceFluxes, film_shape
from solvers.contact.ehl.grid.dense import add_scaled
from solvers.contact.ehl.grid.mesh import Grid

PATIENCE = 10  # iterations before the rupture tolerance counts
RUPTURE_TOLERANCE = 5e-3  # of the flux
HALVINGS = 12


@kernel
def assemble_system(
    grid: Grid,
    pressure: FloatArray,
    cavitated: BoolArray,
    faces: FaceFluxes,
    jacobian: FloatArray,
    residual: FloatArray,
) -> None:
    """Rows of d(flux)/dx = 0, of P = 0 where the film is broken, and of the load; unknowns P_0..P_n-1, H0."""
    n = grid.x.size
    deflection, weights = grid.deflection, grid.weights
    jacobian[:, :] = 0.0
    for i in range(n):
        if i == 0 or i == n - 1 or cavitated[i]:
            jacobian[i, i] = 1.0
            residual[i] = pressure[i]
            continue
        residual[i] = faces.flux[i] - faces.flux[i - 1]
        for side in range(2):
            face, sign = (i, 1.0) if side == 0 else (i - 1, -1.0)
            for k in range(3):
                node = face - 1 + k
                value = sign * faces.by_film[face, k]
                if value != 0.0:
                    add_scaled(value, deflection[node], jacobian[i, :n])
                    jacobian[i, n] += value
            for k in range(5):
                node = face - 2 + k
                if 0 <= node < n:
                    jacobian[i, node] += sign * faces.by_pressure[face, k]
    residual[n] = -0.5 * np.pi
    for j in range(n):
        jacobian[n, j] = weights[j]
        residual[n] += weights[j] * pressure[j]
    jacobian[n, n] = 0.0


@kernel
def release_cavitated(faces: FaceFluxes, cavitated: BoolArray, tolerance: float) -> bool:
    """Return broken nodes into which more flows than leaves to the full film; whether there were any.

    `tolerance` is the imbalance, relative to the flux, that a broken node may keep: without it one node at the
    rupture can change sides for ever.
    """
    changed = False
    for i in range(1, cavitated.size - 1):
        if cavitated[i] and faces.flux[i] - faces.flux[i - 1] < -tolerance * abs(faces.flux[i]):
            cavitated[i] = False
            changed = True
    return changed


@kernel
def apply_pressure_step(
    grid: Grid,
    pressure: FloatArray,
    separation: FloatArray,
    cavitated: BoolArray,
    step: FloatArray,
    scale: float,
) -> tuple[float, bool]:
    """Move (P, H0) by `scale` times the step (n + 1,), less where the film would close; returns what was taken.

    Nodes behind the centre whose pressure falls below zero join the broken film; whether any did is returned too. At
    both ends there is none, whatever another mesh left there.
    """
    n = grid.x.size
    trial, film = np.empty(n), np.empty(n)
    for _ in range(HALVINGS):
        for i in range(n):
            trial[i] = pressure[i] + scale * step[i]
            if grid.x[i] > 0.0 and trial[i] < 0.0:
                trial[i] = 0.0
        trial[0], trial[n - 1] = 0.0, 0.0
        film_shape(grid, trial, separation[0] + scale * step[n], film)
        if film.min() > 0.0:
            break
        scale *= 0.5
    joined = False
    for i in range(1, n - 1):
        if grid.x[i] > 0.0 and pressure[i] + scale * step[i] < 0.0 and not cavitated[i]:
            cavitated[i] = True
            joined = True
    pressure[:] = trial
    separation[0] += scale * step[n]
    return scale, joined
