"""Flow through the film: fluxes of one column, mass flux between columns, conservation of mass and load."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import inlined_kernel, kernel
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.linear_algebra import multiply
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.shear import Film, Shear, shear_eyring, shear_newtonian, stress_response, viscosities

PATIENCE = 10  # iterations before the rupture tolerance counts
RUPTURE_TOLERANCE = 5e-3  # of the flux
HALVINGS = 12  # a step of 1/4096 of Newton's no longer helps


class Coefficient(NamedTuple):
    """A coefficient at each node (n,) with its derivatives by p, by G = h dp/dx and by h."""

    value: FloatArray
    by_p: FloatArray
    by_g: FloatArray
    by_h: FloatArray


class FlowCoefficients(NamedTuple):
    """Of the mass flux m = B h - A h^3 dp/dx at each node: ln A and B.

    Derivatives are total ones: where temperature is unknown they include its response.
    """

    log_a: Coefficient
    b: Coefficient


class FaceFluxes(NamedTuple):
    """Mass flux (divided by flux_scale) through the face right of each node, and its derivatives.

    Shapes: flux (n,); by_pressure (n, 5): nodes i-2..i+2; by_film (n, 3): nodes i-1..i+1; by_b (n, 2): B of the node
    and of its neighbour upstream (at the first face: downstream); by_log_a (n, 2): ln A of nodes i, i+1.
    """

    flux: FloatArray
    by_b: FloatArray
    by_log_a: FloatArray
    by_pressure: FloatArray
    by_film: FloatArray


def flow_coefficients(nodes: int) -> FlowCoefficients:
    """Room for the coefficients of `nodes` nodes."""
    return FlowCoefficients(Coefficient(*np.zeros((4, nodes))), Coefficient(*np.zeros((4, nodes))))


def face_fluxes(nodes: int) -> FaceFluxes:
    """Room for the faces of `nodes` nodes."""
    return FaceFluxes(
        np.zeros(nodes), np.zeros((nodes, 2)), np.zeros((nodes, 2)), np.zeros((nodes, 5)), np.zeros((nodes, 3))
    )


@kernel
def film_shape(grid: Grid, pressure: FloatArray, separation: float, film: FloatArray) -> None:
    """H = H0 + X^2/2 + K P into `film` (Eq. 21)."""
    multiply(grid.deflection, pressure, film)
    for i in range(film.size):
        film[i] += separation + 0.5 * grid.x[i] ** 2


@kernel
def gradient_stencil(x: FloatArray, i: int, cavitated: BoolArray) -> tuple[int, int, float]:
    """The two nodes whose pressure difference makes dP/dX at node i, and its factor."""
    n = x.size
    left, right = max(i - 1, 0), min(i + 1, n - 1)
    if cavitated[i]:
        return left, right, 0.0
    if i + 1 < n and cavitated[i + 1]:
        left = i
    return left, right, 1.0 / (x[right] - x[left])


@kernel
def pressure_gradients(x: FloatArray, pressure: FloatArray, cavitated: BoolArray, gradient: FloatArray) -> None:
    """dP/dX at the nodes: central, one-sided at the inlet, zero where the film is broken (Eq. E14).

    The last node before the rupture looks forward, so that its gradient vanishes with its pressure: a node can join
    the broken film without a jump.
    """
    for i in range(x.size):
        left, right, factor = gradient_stencil(x, i, cavitated)
        gradient[i] = factor * (pressure[right] - pressure[left])


@kernel
def _log_mean(a: float, b: float) -> tuple[float, float]:
    """Logarithmic mean of e^a and e^b and its logarithmic derivative by a; exact for an exponential between nodes."""
    half = 0.5 * (a - b)
    middle = np.exp(0.5 * (a + b))
    if abs(half) < 1e-2:
        square = half * half
        return middle * (1.0 + square / 6.0 * (1.0 + square / 20.0)), 0.5 + half / 6.0 * (1.0 - square / 15.0)
    rise = np.exp(half)
    fall = 1.0 / rise
    return middle * (rise - fall) / (a - b), 0.5 + 0.5 * ((rise + fall) / (rise - fall) - 1.0 / half)


@kernel
def assemble_faces(
    problem: Problem,
    x: FloatArray,
    pressure: FloatArray,
    film: FloatArray,
    gradient: FloatArray,
    cavitated: BoolArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
) -> None:
    """Fluxes m = B H - A H^3 dP/dX through the faces between nodes, with their derivatives (Eqs. E7, E13).

    The Couette part is extrapolated from the two nodes upstream (second order; first order upwinding thickens the
    film by 12 per cent), the Poiseuille part uses the logarithmic mean of A.
    """
    n = x.size
    p_scale, h_scale = problem.maximum_pressure, problem.gap_scale
    couette_scale = h_scale / problem.flux_scale
    slope = p_scale / problem.half_width
    poiseuille_scale = h_scale**3 * slope / problem.flux_scale
    log_a, b = coefficients.log_a, coefficients.b
    for i in range(n - 1):
        faces.by_pressure[i, :] = 0.0
        faces.by_film[i, :] = 0.0
        flux = 0.0
        ratio = 0.5 * (x[i + 1] - x[i]) / (x[i] - x[i - 1]) if i > 0 else -0.5
        other = i - 1 if i > 0 else 1
        for side in range(2):
            node, weight = (i, 1.0 + ratio) if side == 0 else (other, -ratio)
            scale = weight * couette_scale
            flux += scale * b.value[node] * film[node]
            faces.by_b[i, side] = scale * film[node]
            by_g = scale * film[node] * b.by_g[node] * slope
            left, right, factor = gradient_stencil(x, node, cavitated)
            h = film[node] * h_scale
            faces.by_pressure[i, node - i + 2] += scale * film[node] * b.by_p[node] * p_scale
            faces.by_pressure[i, right - i + 2] += by_g * h * factor
            faces.by_pressure[i, left - i + 2] -= by_g * h * factor
            faces.by_film[i, node - i + 1] += scale * (
                b.value[node] + film[node] * h_scale * (b.by_h[node] + b.by_g[node] * slope * gradient[node])
            )
        mean, share = _log_mean(log_a.value[i], log_a.value[i + 1])
        height = 0.5 * (film[i] + film[i + 1])
        conductance = poiseuille_scale * mean * height**3 / (x[i + 1] - x[i])
        poiseuille = conductance * (pressure[i + 1] - pressure[i])
        flux -= poiseuille
        faces.by_pressure[i, 3] -= conductance
        faces.by_pressure[i, 2] += conductance
        for side in range(2):
            node, weight = (i, share) if side == 0 else (i + 1, 1.0 - share)
            scale = -poiseuille * weight
            faces.by_log_a[i, side] = scale
            left, right, factor = gradient_stencil(x, node, cavitated)
            h = film[node] * h_scale
            faces.by_pressure[i, node - i + 2] += scale * log_a.by_p[node] * p_scale
            if right - i + 2 < 5:
                faces.by_pressure[i, right - i + 2] += scale * log_a.by_g[node] * slope * h * factor
            faces.by_pressure[i, left - i + 2] -= scale * log_a.by_g[node] * slope * h * factor
            by_h = log_a.by_h[node] + log_a.by_g[node] * slope * gradient[node]
            faces.by_film[i, node - i + 1] += scale * h_scale * by_h - 1.5 * poiseuille / height
        faces.flux[i] = flux


@kernel
def add_flux_changes(
    faces: FaceFluxes, cavitated: BoolArray, log_a: FloatArray, b: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` (n + 1,) what changes of ln A and B at the nodes (n,) do to the balance of mass."""
    before = 0.0
    for i in range(cavitated.size - 1):
        other = i - 1 if i > 0 else 1
        change = faces.by_b[i, 0] * b[i] + faces.by_b[i, 1] * b[other]
        change += faces.by_log_a[i, 0] * log_a[i] + faces.by_log_a[i, 1] * log_a[i + 1]
        if i > 0 and not cavitated[i]:
            residual[i] += change - before
        before = change


@inlined_kernel
def flow_moments(i: int, total: float, shear: Shear) -> tuple[float, float, float, float]:
    """F0, F1, N0, N1 of `flow`; `total` is the density across the film."""
    m = shear.stress.shape[1]
    height = 1.0 / m
    below, f0, f1, n0, n1 = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta, phi, layer = (j + 0.5) * height - 0.5, shear.effective[i, j] * height, shear.density[i, j] * height
        above = total - below - 0.5 * layer
        below += layer
        f0 += phi
        f1 += phi * zeta
        n0 += phi * above
        n1 += phi * zeta * above
    return f0, f1, n0, n1


@inlined_kernel
def flow(
    problem: Problem, i: int, h: float, total: float, density_slope: float, film: Film, coefficients: FlowCoefficients
) -> None:
    """Flow coefficients A and B of a column, their derivatives at fixed temperature, and its stream functions.

    With phi = rate/stress, F0 = int phi, F1 = int phi (zeta - 1/2), R(zeta) the density above zeta, N0 = int phi R,
    N1 = int phi (zeta - 1/2) R: A = F1 N0/F0 - N1 and B = u1 R(0) + du N0/F0 (Eqs. 17, E7.1, density varying across
    the film as well). `total` is R(0).
    """
    shear, flows, mid, m = film.shear, film.flow, film.mid, film.shear.stress.shape[1]
    f0, f1, n0, n1 = flow_moments(i, total, shear)
    lean, mass, drag = f1 / f0, n0 / f0, (problem.speed_2 - problem.speed_1) / f0
    a = f1 * mass - n1
    height, per_a, expansion = 1.0 / m, 1.0 / (m * a), problem.laws.density * problem.laws.thermal_expansion
    a_by_p, a_by_g, a_by_stress, b_by_p, b_by_g, b_by_stress = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    couette, poiseuille, half_a, half_b, below, j0, j1 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta, rho, slope = (j + 0.5) * height - 0.5, shear.density[i, j], shear.effective_slope[i, j]
        effective = shear.effective[i, j]
        phi, above = effective * height, total - below - 0.5 * rho * height
        below += rho * height
        by_density_a = (lean * (j0 + 0.5 * phi) - (j1 + 0.5 * phi * zeta)) * per_a
        by_density_b = (problem.speed_1 + drag * (j0 + 0.5 * phi)) * height
        j0 += phi
        j1 += phi * zeta
        by_phi_a = (zeta * (mass - above) + lean * (above - mass)) * per_a
        by_phi_b = drag * (above - mass) * height
        a_by_stress += by_phi_a * slope
        b_by_stress += by_phi_b * slope
        pressed = effective * shear.by_pressure[i, j]
        a_by_p += by_phi_a * pressed + density_slope * by_density_a
        b_by_p += by_phi_b * pressed + density_slope * by_density_b
        a_by_g += by_phi_a * slope * zeta
        b_by_g += by_phi_b * slope * zeta
        flows.couette[i, j], flows.poiseuille[i, j] = couette, poiseuille
        couette += h * rho * by_density_b
        poiseuille += rho * by_density_a
        warm, before_a, before_b = effective * shear.by_temperature[i, j], half_a, half_b
        half_a = 0.5 * (by_phi_a * warm - expansion * by_density_a)
        half_b = 0.5 * (by_phi_b * warm - expansion * by_density_b)
        flows.log_a_by_temperature[i, j] = before_a + half_a
        flows.b_by_temperature[i, j] = before_b + half_b
    flows.couette[i, m], flows.poiseuille[i, m] = couette, poiseuille
    flows.log_a_by_temperature[i, m], flows.b_by_temperature[i, m] = half_a, half_b
    for k in range(m + 1):
        flows.log_a_by_temperature[i, k] += a_by_stress * mid.by_temperature[i, k]
        flows.b_by_temperature[i, k] += b_by_stress * mid.by_temperature[i, k]
    log_a, b = coefficients.log_a, coefficients.b
    log_a.value[i], b.value[i] = np.log(a), problem.speed_1 * total + (problem.speed_2 - problem.speed_1) * mass
    log_a.by_p[i], b.by_p[i] = a_by_p + a_by_stress * mid.by_p[i], b_by_p + b_by_stress * mid.by_p[i]
    log_a.by_g[i], b.by_g[i] = a_by_g + a_by_stress * mid.by_g[i], b_by_g + b_by_stress * mid.by_g[i]
    log_a.by_h[i], b.by_h[i] = a_by_stress * mid.by_h[i], b_by_stress * mid.by_h[i]


@inlined_kernel
def evaluate_column(
    problem: Problem,
    i: int,
    temperature: FloatArray,
    p: float,
    g: float,
    h: float,
    film: Film,
    coefficients: FlowCoefficients,
) -> None:
    """Everything above for column i: nodal temperatures (n, m + 1) [K], p [Pa], G = h dp/dx [Pa], h [m]."""
    total, density_slope = viscosities(problem, i, temperature, p, film.shear)
    if problem.newtonian == 1:
        shear_newtonian(problem, i, g, h, film)
    else:
        shear_eyring(problem, i, g, h, film)
    stress_response(problem, i, h, film)
    flow(problem, i, h, total, density_slope, film, coefficients)


@kernel
def balance_of_mass(
    grid: Grid, pressure: FloatArray, cavitated: BoolArray, faces: FaceFluxes, residual: FloatArray
) -> None:
    """Residual (n + 1,) of d(flux)/dx = 0, of P = 0 where the film is broken, and of the load (Eqs. E7, 22)."""
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
