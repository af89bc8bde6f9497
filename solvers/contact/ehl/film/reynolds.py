"""Conservation of mass and load: the system for the pressures and the rigid separation, and steps in them."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.film.fluxes import FaceFluxes, film_shape
from solvers.contact.ehl.grid.mesh import Grid

PATIENCE = 10  # iterations before the rupture tolerance counts
RUPTURE_TOLERANCE = 5e-3  # of the flux
HALVINGS = 12


@kernel
def balance_of_mass(
    grid: Grid, pressure: FloatArray, cavitated: BoolArray, faces: FaceFluxes, residual: FloatArray
) -> None:
    """Residual (n + 1,) of d(flux)/dx = 0, of P = 0 where the film is broken, and of the load."""
    n = grid.x.size
    residual[n] = -0.5 * np.pi
    for i in range(n):
        if i == 0 or i == n - 1 or cavitated[i]:
            residual[i] = pressure[i]
        else:
            residual[i] = faces.flux[i] - faces.flux[i - 1]
        residual[n] += grid.weights[i] * pressure[i]


@kernel
def assemble_jacobian(grid: Grid, cavitated: BoolArray, faces: FaceFluxes, jacobian: FloatArray) -> None:
    """Derivatives of the residual of `balance_of_mass` by P_0..P_n-1, H0."""
    n = grid.x.size
    deflection, by_film, by_pressure = grid.deflection, faces.by_film, faces.by_pressure
    for i in range(n):
        if i == 0 or i == n - 1 or cavitated[i]:
            jacobian[i, :] = 0.0
            jacobian[i, i] = 1.0
            continue
        # The faces right and left of a node know the film at four nodes between them.
        far, left, here, right = max(i - 2, 0), i - 1, i, i + 1
        by_far, by_left = -by_film[i - 1, 0], by_film[i, 0] - by_film[i - 1, 1]
        by_here, by_right = by_film[i, 1] - by_film[i - 1, 2], by_film[i, 2]
        for j in range(n):
            jacobian[i, j] = (
                by_far * deflection[far, j]
                + by_left * deflection[left, j]
                + by_here * deflection[here, j]
                + by_right * deflection[right, j]
            )
        jacobian[i, n] = by_far + by_left + by_here + by_right
        for k in range(max(i - 2, 0), min(i + 3, n)):
            jacobian[i, k] += by_pressure[i, k - i + 2]
        for k in range(max(i - 3, 0), min(i + 2, n)):
            jacobian[i, k] -= by_pressure[i - 1, k - i + 3]
    jacobian[n, :n] = grid.weights
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
