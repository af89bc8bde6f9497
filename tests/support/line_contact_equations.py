"""Equations of the line contact in plain NumPy, in the discrete form that the compiled kernels solve.

The chapter on the line contact in the manual explains the equations.

This module is the specification of the compiled kernels, which solve `residual` = 0. The formulas of this module are
independent of the kernels, and are not written for speed. The tests compare the residual of the kernels with the
residual of this module. The tests also differentiate this module by complex steps, and compare the result with the
derivatives that the kernels compute. Therefore every function also accepts complex arrays. For the same reason, no
function uses the absolute value of an unknown, or the larger of two unknowns.

The mesh has n nodes along the contact and k nodes across the film. The nodes across the film bound m = k - 1 intervals
of equal height. The symbols are those of the chapter: P = p/p_H, X = x/b, H = h R/b^2, G = h dp/dx [Pa] and
zeta = z/h - 1/2. Here z is the height above surface 1, so that zeta is 0 half way across the film. The code writes `t`
for the temperature; the chapter writes theta. The code writes `vartheta` for the fraction of the gap that oil fills.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from solvers.arrays import BoolArray
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.rheology import NEWTONIAN
from solvers.lubricants import ROELANDS_POLE_TEMPERATURE, ROELANDS_PRESSURE, FluidLaws

Numbers = NDArray[Any]
"""An array of real or of complex numbers."""


class Columns(NamedTuple):
    """Shear and flow in the n columns of the film, with m intervals and k nodes across it."""

    density: Numbers  # (n, m) kg/m^3
    stress: Numbers  # (n, m) Pa
    rate: Numbers  # (n, m) 1/s
    mid_stress: Numbers  # (n,) Pa, half way across the film
    a: Numbers  # (n,) flow coefficient, s/m^2
    b: Numbers  # (n,) flow coefficient, kg/(m^2 s)
    couette: Numbers  # (n, k) stream function without pressure gradient, kg/(s m)
    poiseuille: Numbers  # (n, k) profile of the pressure flow, from 0 at surface 1 to 1 at surface 2


class Carried(NamedTuple):
    """Flow quantities of the heat balance that a Newton step holds and that are computed again after it."""

    psi: Numbers  # (n, k) stream function, kg/(s m)
    vartheta: Numbers  # (n,) fraction of the gap that oil fills
    density: Numbers  # (n, m) kg/m^3, for the heat of compression


class Residual(NamedTuple):
    """Residuals of mass, load and heat."""

    mass: Numbers  # (n,) over the flux scale; P = p/p_H where the pressure is prescribed as zero
    load: Any
    heat: Numbers  # (n, k) W/m^2; deviation [K] where the temperature is prescribed


def density(laws: FluidLaws, p: Numbers, t: Numbers) -> Numbers:
    """Return the density of the oil (Eq. 19) [kg/m^3]. `p`: pressure [Pa]; a negative pressure counts as zero."""
    p = np.where(p.real > 0.0, p, 0.0)
    compression = laws.pressure_density * p / (1.0 + 1.7e-9 * p)
    return np.asarray(laws.density * (1.0 + compression - laws.thermal_expansion * (t - laws.reference_temperature)))


def viscosity(laws: FluidLaws, p: Numbers, t: Numbers) -> Numbers:
    """Return the viscosity of the oil after Roelands or Barus (Eq. 20) [Pa s].

    `p`: pressure [Pa]; a negative pressure counts as zero.
    """
    p = np.where(p.real > 0.0, p, 0.0)
    if laws.roelands == 0:
        heating = t - laws.reference_temperature
        exponent = laws.pressure_viscosity * p - laws.temperature_viscosity * heating
    else:
        warmth = (t - ROELANDS_POLE_TEMPERATURE) / (laws.reference_temperature - ROELANDS_POLE_TEMPERATURE)
        pressed = (1.0 + ROELANDS_PRESSURE * p) ** laws.pressure_exponent
        exponent = laws.a1 * (pressed * warmth**-laws.temperature_exponent - 1.0)
    return np.asarray(np.exp(laws.log_viscosity + exponent))


def effective_fluidity(problem: Problem, tau: Numbers, eta: Numbers) -> Numbers:
    """Return the effective fluidity 1/eta*, which is the shear rate divided by the stress (Eqs. E4, E5)."""
    if problem.rheology == NEWTONIAN:
        return np.asarray(1.0 / eta)
    return np.asarray(_sinh_ratio(tau / problem.eyring_stress) / eta)


def mid_film_stress(problem: Problem, eta: Numbers, g: Numbers, h: Numbers) -> Numbers:
    """Return the shear stress half way across the film for the sliding speed u2 - u1 [Pa].

    Eq. E6. The integral of the shear rate across the film must equal the sliding speed. For a Newtonian oil this
    integral is linear in the stress.
    """
    zeta, dz = _intervals(eta.shape[1])
    slide = (problem.speed_2 - problem.speed_1) / h
    if problem.rheology == NEWTONIAN:
        return np.asarray((slide - g * (zeta / eta).sum(axis=1) * dz) / ((1.0 / eta).sum(axis=1) * dz))
    tau0 = problem.eyring_stress
    c_plus = (np.exp(g[:, None] * zeta / tau0) / eta).sum(axis=1) * dz
    c_minus = (np.exp(-g[:, None] * zeta / tau0) / eta).sum(axis=1) * dz
    d = slide / tau0
    root = np.sqrt(d * d + c_plus * c_minus)
    e_a = (d + root) / c_plus if problem.speed_2 >= problem.speed_1 else c_minus / (root - d)
    return np.asarray(tau0 * np.log(e_a))


def columns(problem: Problem, p: Numbers, g: Numbers, h: Numbers, t: Numbers) -> Columns:
    """Return the shear and the flow in the columns of the film. Every node along the contact has one column.

    Eq. E7.1. The integrals across the film use one value per interval, at the middle of the interval. The temperature
    there is the mean of the temperatures at both ends of the interval.
    """
    zeta, dz = _intervals(t.shape[1] - 1)
    t_mid = 0.5 * (t[:, 1:] + t[:, :-1])
    rho, eta = density(problem.laws, p[:, None], t_mid), viscosity(problem.laws, p[:, None], t_mid)
    tau_m = mid_film_stress(problem, eta, g, h)
    tau = tau_m[:, None] + g[:, None] * zeta
    phi = effective_fluidity(problem, tau, eta)
    f0, f1 = phi.sum(axis=1) * dz, (phi * zeta).sum(axis=1) * dz
    j0, j1 = _half_way(phi) * dz, _half_way(phi * zeta) * dz
    dragged = rho * (problem.speed_1 + (problem.speed_2 - problem.speed_1) * j0 / f0[:, None]) * dz
    pressed = rho * ((f1 / f0)[:, None] * j0 - j1) * dz
    a, b = pressed.sum(axis=1), dragged.sum(axis=1)
    return Columns(
        density=rho,
        stress=tau,
        rate=phi * tau,
        mid_stress=tau_m,
        a=a,
        b=b,
        couette=h[:, None] * _from_surface_1(dragged),
        poiseuille=_from_surface_1(pressed) / a[:, None],
    )


def uniform_columns(problem: Problem, p: Numbers, g: Numbers, h: Numbers) -> tuple[Numbers, Numbers]:
    """Return the flow coefficients of a film at the inlet temperature (Eq. E7.2).

    Returns `a`: flow coefficient A [s/m^2]; `b`: flow coefficient B [kg/(m^2 s)].
    """
    inlet = np.full(p.shape, problem.inlet)
    rho, eta = density(problem.laws, p, inlet), viscosity(problem.laws, p, inlet)
    b = rho * 0.5 * (problem.speed_1 + problem.speed_2)
    if problem.rheology == NEWTONIAN:
        return rho / (12.0 * eta), b
    tau0 = problem.eyring_stress
    s = g / (2.0 * tau0)
    near = np.abs(s) < 0.5
    far = np.where(near, 1.0, s)
    order = np.arange(1, 9)
    terms = 3.0 * (2.0 * order / np.cumprod(2.0 * order * (2.0 * order + 1.0)))
    series = (terms * s[..., None] ** (2 * order - 2)).sum(axis=-1)
    f = np.where(near, series, 3.0 * (far * np.cosh(far) - np.sinh(far)) / far**3)
    sinh_a = eta * (problem.speed_2 - problem.speed_1) / (tau0 * h) / _sinh_ratio(s)
    return rho / (12.0 * eta) * np.sqrt(1.0 + sinh_a**2) * f, b


def face_fluxes(grid: Grid, pressure: Numbers, film: Numbers, a: Numbers, b: Numbers, scale: float) -> Numbers:
    """Return the mass flux B H - A H^3 dP/dX through the faces between nodes (Eq. E13) [kg/(m^2 s)].

    `b`: flow coefficient B [kg/(m^2 s)]. Returns mass flux divided by b^2/R [kg/(m^2 s)].
    """
    dx, d = np.diff(grid.x), b * film
    ratio = np.concatenate([[-0.5], 0.5 * dx[1:] / dx[:-1]])
    upstream = np.concatenate([d[1:2], d[:-2]])
    couette = (1.0 + ratio) * d[:-1] - ratio * upstream
    height = 0.5 * (film[1:] + film[:-1])
    return np.asarray(couette - scale * _log_mean(a) * height**3 * np.diff(pressure) / dx)


def balance_of_mass(pressure: Numbers, cavitated: BoolArray, flux: Numbers) -> Numbers:
    """Return the residuals of the balance of mass at the nodes (Eq. E7) [-]."""
    # The residual is the outflow of a node minus the inflow. At both ends and in the broken film the pressure is
    # prescribed as zero; the residual of such a node is P.
    mass = pressure.astype(flux.dtype)
    inside = np.flatnonzero(~cavitated[1:-1]) + 1
    mass[inside] = flux[inside] - flux[inside - 1]
    return np.asarray(mass)


def film_thickness(grid: Grid, pressure: Numbers, separation: Any) -> Numbers:
    """Return the film thickness H = H0 + X^2/2 + K P (Eq. 21) [-]. K is the matrix `grid.deflection`."""
    return np.asarray(separation + 0.5 * grid.x**2 + grid.deflection @ pressure)


def pressure_gradient(grid: Grid, pressure: Numbers, cavitated: BoolArray) -> Numbers:
    """Return dP/dX at the nodes [-].

    Eq. E14: the difference is one-sided at the inlet and at the last node of the full film, zero in the broken film,
    and central at all other nodes.
    """
    n = grid.x.size
    node = np.arange(n)
    left, right = np.maximum(node - 1, 0), np.minimum(node + 1, n - 1)
    rupture = np.append(cavitated[1:], False)
    left[rupture] = node[rupture]
    slope = (pressure[right] - pressure[left]) / (grid.x[right] - grid.x[left])
    return np.asarray(np.where(cavitated, 0.0, slope))


def balance_of_load(grid: Grid, pressure: Numbers) -> Any:
    """Return the residual of the load: the integral of P, minus pi/2 (Eq. 22).

    If this residual is zero, the pressure carries the load.
    """
    return grid.weights @ pressure - 0.5 * np.pi


def carried_heat(
    problem: Problem, pressure: Numbers, film: Numbers, cavitated: BoolArray, flux: Numbers, at: Columns
) -> Carried:
    """Return the flow quantities in the heat balance (Eqs. E8.1, E8.2)."""
    # The mass flow is the same in all columns. It equals the flux at the largest pressure.
    m_dot = flux[pressure.argmax()]
    psi = at.couette + (m_dot - at.couette[:, -1:]) * at.poiseuille
    for i in np.flatnonzero(cavitated):
        psi[i] = psi[i - 1]
    vartheta = np.where(cavitated, np.minimum(m_dot / (at.b * film * problem.gap_scale), 1.0), 1.0)
    return Carried(psi, vartheta, at.density)


def balance_of_heat(
    problem: Problem, grid: Grid, g: Numbers, h: Numbers, t: Numbers, at: Columns, carried: Carried
) -> Numbers:
    """Return the heat that every cell loses minus the heat generated in the cell.

    Eqs. E8, E15. A cell reaches half way to the neighbouring nodes, along the contact and across the film. The cells at
    the surfaces are half cells; the residual of a half cell is the heat that comes out of the solid. Returns residual
    [W/m^2]; zero in the first column, whose temperatures are given.
    """
    n, k = t.shape
    m = k - 1
    edges = _edges(carried.psi)
    here, left, right = slice(1, n), np.arange(n - 1), np.minimum(np.arange(1, n) + 1, n - 1)
    ours, before = edges[1:], edges[:-1]
    capacity = (problem.specific_heat / (grid.weights[1:] * problem.half_width))[:, None]
    conduction = (carried.vartheta * problem.conductivity * m / h)[1:, None]
    own = t[here]
    lost = capacity * np.maximum(before[:, 1:] - before[:, :-1], 0.0) * (own - t[left])
    lost = lost + capacity * np.maximum(ours[:, :-1] - ours[:, 1:], 0.0) * (own - t[right])
    from_below = capacity * np.maximum(before[:, 1:k] - ours[:, 1:k], 0.0) + conduction
    from_above = capacity * np.maximum(ours[:, 1:k] - before[:, 1:k], 0.0) + conduction
    lost[:, 1:] += from_below * (own[:, 1:] - own[:, :-1])
    lost[:, :-1] += from_above * (own[:, :-1] - own[:, 1:])
    sheared = 0.5 * carried.vartheta[:, None] * h[:, None] / m * at.stress * at.rate
    made = _to_nodes(sheared)
    expansion = problem.laws.density * problem.laws.thermal_expansion
    rho = np.concatenate([carried.density[:, :1], carried.density, carried.density[:, -1:]], axis=1)
    rho = 0.5 * (rho[:, 1:] + rho[:, :-1])
    made = made + expansion * np.diff(_layers(carried.psi), axis=1) / (h[:, None] * rho**2) * g[:, None] * t
    return np.asarray(np.concatenate([np.zeros((1, k)), lost - made[here]]))


def surface_temperatures(problem: Problem, grid: Grid, q_1: Numbers, q_2: Numbers) -> tuple[Numbers, Numbers]:
    """Return the temperatures of both surfaces by the formula for moving line sources of heat (Eq. 24).

    Returns `surface_1`: temperature of surface 1 [K]; `surface_2`: temperature of surface 2 [K].
    """
    return (
        problem.bulk_1 + problem.surface_heating_1 * (grid.heat @ q_1),
        problem.bulk_2 + problem.surface_heating_2 * (grid.heat @ q_2),
    )


def inlet_temperatures(problem: Problem, h: float, t: Numbers, m_dot: float) -> Numbers:
    """Return the temperatures of the first column (Eq. E8.3) [K]."""
    zeta = np.linspace(0.0, 1.0, t.shape[1])
    mean = m_dot / (problem.laws.density * h)
    u = problem.speed_1 * (1.0 - zeta) + problem.speed_2 * zeta
    u = u + 6.0 * (mean - 0.5 * (problem.speed_1 + problem.speed_2)) * zeta * (1.0 - zeta)
    entering = np.where(u < 0.0, t[1], problem.inlet)
    entering[0], entering[-1] = problem.bulk_1, problem.bulk_2
    return np.asarray(entering)


def residual(
    problem: Problem,
    grid: Grid,
    cavitated: BoolArray,
    pressure: Numbers,
    separation: Any,
    t: Numbers,
    carried: Carried | None = None,
) -> Residual:
    """Return the residuals of a thermal contact; they are zero if P, H0 and the temperatures solve the equations."""
    film = film_thickness(grid, pressure, separation)
    h, p = film * problem.gap_scale, pressure * problem.maximum_pressure
    gradient = problem.maximum_pressure / problem.half_width
    g = h * pressure_gradient(grid, pressure, cavitated) * gradient
    at = columns(problem, p, g, h, t)
    flux = face_fluxes(grid, pressure, film, at.a, at.b, problem.gap_scale**2 * gradient) * problem.gap_scale
    if carried is None:
        carried = carried_heat(problem, pressure, film, cavitated, flux, at)
    heat = balance_of_heat(problem, grid, g, h, t, at, carried)
    surface_1, surface_2 = surface_temperatures(problem, grid, -heat[:, 0], -heat[:, -1])
    heat[:, 0], heat[:, -1] = t[:, 0] - surface_1, t[:, -1] - surface_2
    heat[0] = t[0] - inlet_temperatures(problem, film[0].real * problem.gap_scale, t, carried.psi[0, -1])
    mass = balance_of_mass(pressure, cavitated, flux / problem.flux_scale)
    return Residual(mass, balance_of_load(grid, pressure), heat)


def isothermal_residual(
    problem: Problem, grid: Grid, cavitated: BoolArray, pressure: Numbers, separation: Any
) -> tuple[Numbers, Any]:
    """Return the residuals of an isothermal contact; they are zero if P and H0 solve the equations.

    Returns `mass`: residual of mass, divided by the flux scale [-]; `load`: residual of the load [-].
    """
    film = film_thickness(grid, pressure, separation)
    h, p = film * problem.gap_scale, pressure * problem.maximum_pressure
    gradient = problem.maximum_pressure / problem.half_width
    g = h * pressure_gradient(grid, pressure, cavitated) * gradient
    a, b = uniform_columns(problem, p, g, h)
    flux = face_fluxes(grid, pressure, film, a, b, problem.gap_scale**2 * gradient) * problem.gap_scale
    return balance_of_mass(pressure, cavitated, flux / problem.flux_scale), balance_of_load(grid, pressure)


def _intervals(m: int) -> tuple[Numbers, float]:
    """Return zeta (m,) at the middle of every interval, and the height of an interval divided by h."""
    return (np.arange(m) + 0.5) / m - 0.5, 1.0 / m


def _half_way(layers: Numbers) -> Numbers:
    """Return, for every interval (n, m), the sum of the values from surface 1 to the middle of the interval.

    This sum contains half of the value of the interval itself.
    """
    return np.asarray(np.cumsum(layers, axis=1) - 0.5 * layers)


def _from_surface_1(layers: Numbers) -> Numbers:
    """Return, for every node (n, m + 1), the sum of the values of the intervals between surface 1 and the node."""
    return np.asarray(np.concatenate([np.zeros_like(layers[:, :1]), np.cumsum(layers, axis=1)], axis=1))


def _to_nodes(intervals: Numbers) -> Numbers:
    """Return, for every node (n, m + 1), the sum of the values of the intervals (n, m) on both sides of the node."""
    none = np.zeros_like(intervals[:, :1])
    return np.asarray(np.concatenate([intervals, none], axis=1) + np.concatenate([none, intervals], axis=1))


def _layers(psi: Numbers) -> Numbers:
    """Return the stream function (n, k + 1) at the edges of the cells across the film."""
    # The inner edges lie half way between two nodes. The outer edges lie on the surfaces.
    return np.asarray(np.concatenate([psi[:, :1], 0.5 * (psi[:, 1:] + psi[:, :-1]), psi[:, -1:]], axis=1))


def _edges(psi: Numbers) -> Numbers:
    """Return the stream function (n, k + 1) half way between every column and the next, at the edges of the cells."""
    # The last column has no next column. For the last column, the results are the values of this column itself.
    layers = _layers(psi)
    return np.asarray(0.5 * (layers + np.concatenate([layers[1:], layers[-1:]])))


def _log_mean(a: Numbers) -> Numbers:
    """Return the logarithmic means (n - 1,) of neighbouring values; they are exact if the values vary exponentially."""
    return np.asarray(np.sqrt(a[1:]) * np.sqrt(a[:-1]) * _sinh_ratio(0.5 * np.log(a[1:] / a[:-1])))


def _sinh_ratio(s: Numbers) -> Numbers:
    """Return sinh(s)/s, computed by a series if s is small."""
    near = np.abs(s) < 0.1
    far = np.where(near, 1.0, s)
    series = 1.0 + s**2 / 6.0 * (1.0 + s**2 / 20.0 * (1.0 + s**2 / 42.0 * (1.0 + s**2 / 72.0)))
    return np.asarray(np.where(near, series, np.sinh(far) / far))
