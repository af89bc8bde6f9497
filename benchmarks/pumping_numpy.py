"""The gas step of solvers.pumping in plain numpy: what the compiled kernel is measured against."""

from typing import Any

import numpy as np
from solvers.pumping.gas.cells import Cells

from solvers.arrays import FloatArray
from solvers.pumping.flow.duct import Duct
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.gas.riemann import reservoir_face

SWEEPS = 4  # of Newton's method for all cells at once
Stage = dict[str, Any]


def numpy_step(gas: Gas, duct: Duct, cells: Cells, dt: float) -> None:
    """Advance all cells by dt [s]; every slice is active."""
    g, w, area = gas.exponent, cells.state, cells.face_area[:, None]
    slope = slopes(w)
    cells.slope[:] = slope
    flux = [edge_flux(g, w - 0.5 * slope), edge_flux(g, w + 0.5 * slope)]
    content = cells.content - 0.5 * dt / duct.width * (area[1:] * flux[1] - area[:-1] * flux[0])
    content[:, 1] += 0.5 * dt / duct.width * w[:, 2] * (area[1:, 0] - area[:-1, 0])
    middle = implicit_stage(gas, walls(duct, cells, 0.5, dt), content, 0.5 * dt)
    half = np.column_stack(
        [
            middle["content"][:, 0] / middle["area"],
            middle["content"][:, 1] / middle["content"][:, 0],
            middle["pressure"],
        ]
    )
    faces = np.empty((w.shape[0] + 1, 3))
    faces[1:-1] = area[1:-1] * hllc(g, (half + 0.5 * slope)[:-1], (half - 0.5 * slope)[1:])
    faces[0], faces[-1] = end_flux(gas, (half - 0.5 * slope)[0], -1.0), end_flux(gas, (half + 0.5 * slope)[-1], 1.0)
    faces[[0, -1]] *= area[[0, -1]]
    rate = (faces[:-1] - faces[1:]) / duct.width
    rate[:, 1] += half[:, 2] * (area[1:, 0] - area[:-1, 0]) / duct.width
    h = (1 - np.sqrt(0.5)) * dt
    first = implicit_stage(gas, walls(duct, cells, h / dt, dt), cells.content + h * rate, h)
    start = cells.content + dt * rate - (dt - h) * first["loss"]
    last = implicit_stage(gas, walls(duct, cells, 1.0, dt), start, h)
    cells.next_content[:] = last["content"]
    mass, momentum, energy = last["content"].T
    cells.next_state[:, 0], cells.next_state[:, 1] = mass / last["area"], momentum / mass
    cells.next_state[:, 2] = (g - 1) * (energy - 0.5 * momentum**2 / mass) / last["area"]


def slopes(w: FloatArray) -> FloatArray:
    """Van Leer's slopes, parabolic at both ends."""
    d = np.diff(w, axis=0)
    back, ahead = d[:-1], d[1:]
    product, total = back * ahead, back + ahead
    slope = np.empty_like(w)
    slope[1:-1] = np.where(product > 0, 2 * product / np.where(product > 0, total, 1.0), 0.0)
    for end, near, far in ((0, d[0], d[1]), (-1, d[-1], d[-2])):
        steep = 1.5 * near - 0.5 * far
        steep = np.where(steep * near <= 0, 0.0, steep)
        slope[end] = np.where(np.abs(steep) < 2 * np.abs(near), steep, 2 * near)
    return slope


def edge_flux(g: float, w: FloatArray) -> FloatArray:
    """Exact flux of states (density, velocity, pressure)."""
    rho, u, p = w.T
    return np.column_stack([rho * u, rho * u * u + p, u * (g / (g - 1) * p + 0.5 * rho * u * u)])


def walls(duct: Duct, cells: Cells, fraction: float, dt: float) -> Stage:
    """Area, its growth, gap and transport of all cells."""
    now = cells.walls + fraction * (cells.next_walls - cells.walls)
    return {
        "area": now[:, 0],
        "growth": (cells.next_walls[:, 0] - cells.walls[:, 0]) / dt,
        "gap": duct.discharge * now[:, 1],
        "transport": (cells.next_walls[:, 2] - cells.walls[:, 2]) / dt,
    }


def implicit_stage(gas: Gas, wall: Stage, content: FloatArray, h: float) -> Stage:
    """Leakage, flank gas and wall work of all cells over an implicit stage."""
    g, heat, area = gas.exponent, gas.heat_capacity * gas.temperature, wall["area"]
    mass, momentum, energy = content.T
    into, carried = np.maximum(-wall["transport"], 0) * gas.density, np.maximum(wall["transport"], 0) / area
    filled = mass + h * into
    inner = energy + h * into * heat - 0.5 * momentum**2 / filled
    stiffness = area / (g - 1) + h * wall["growth"] + h * carried * area * g / (g - 1)
    out = inner > stiffness * gas.pressure
    flow = np.zeros_like(mass)
    for _ in range(SWEEPS):
        kept = (filled + np.where(out, -h * flow, h * flow)) / np.where(out, 1 + h * carried, 1.0)
        enthalpy = g / (g - 1) * area / kept
        p_out = inner / (stiffness + h * flow * enthalpy)
        p_in = (energy + h * (into + flow) * heat - 0.5 * momentum**2 / kept) / stiffness
        up = np.where(out, p_out, gas.pressure)
        down = np.where(out, gas.pressure, p_in)
        temperature = np.where(out, p_out * area / (kept * gas.constant), gas.temperature)
        squared, by_up, by_down = flux_squared(gas, up, temperature, down)
        shrink = h / (kept * (1 + h * carried))
        p_slope = -p_out * p_out / inner * h * enthalpy * (1 + flow * shrink)
        out_slope = by_up * p_slope - squared * (p_slope / p_out + shrink)
        in_slope = by_down * h * (heat + 0.5 * (momentum / kept) ** 2) / stiffness
        slope = wall["gap"] ** 2 * np.where(out, out_slope, in_slope)
        constant = np.maximum(wall["gap"] ** 2 * squared - slope * flow, 0.0)
        root = -0.5 * slope + np.sqrt(0.25 * slope**2 + constant)
        flow = np.where(constant > 0, constant / np.where(root > 0, root, 1.0), 0.0)
    outflow, inflow = np.where(out, flow, 0.0), into + np.where(out, 0.0, flow)
    filled = mass + h * inflow
    velocity = momentum / filled
    new_mass = (filled - h * outflow) / (1 + h * carried)
    outflow = outflow + carried * new_mass
    enthalpy = g / (g - 1) * area / new_mass
    inner = energy + h * inflow * heat - 0.5 * momentum * velocity
    pressure = inner / (area / (g - 1) + h * wall["growth"] + h * outflow * enthalpy)
    loss = pressure * wall["growth"] + outflow * (enthalpy * pressure + 0.5 * velocity**2) - inflow * heat
    return {
        "content": np.column_stack([new_mass, new_mass * velocity, energy - h * loss]),
        "pressure": pressure,
        "area": area,
        "loss": np.column_stack([outflow - inflow, outflow * velocity, loss]),
    }


def flux_squared(
    gas: Gas, up: FloatArray, temperature: FloatArray, down: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Square of the nozzle's mass flux and its derivatives, for all cells."""
    g = gas.exponent
    drop = (up - down) / up
    scale = 2 * g / ((g - 1) * gas.constant * temperature) * up
    limited = np.clip(drop, 0.0, 1 - gas.critical_ratio)
    grown = np.expm1(np.log1p(-limited) / g)
    y, x = 1 + grown, 1 - limited
    squared = scale * up * y * (grown + limited)
    choked = drop >= 1 - gas.critical_ratio
    by_up = np.where(choked, 2 * squared / up, scale * (1 - 1 / g) * y * (2 * y - x))
    by_down = np.where(choked, 0.0, scale * y / x * (2 * y / g - (1 + 1 / g) * x))
    slope = 2 * up / (gas.constant * temperature)
    linear = drop <= 0
    return (
        np.where(linear, slope * (up - down), squared),
        np.where(linear, slope, by_up),
        np.where(linear, -slope, by_down),
    )


def hllc(g: float, left: FloatArray, right: FloatArray) -> FloatArray:
    """HLLC flux of all faces."""
    (rho_l, u_l, p_l), (rho_r, u_r, p_r) = left.T, right.T
    c_l, c_r, w_l, w_r = np.sqrt(g * p_l / rho_l), np.sqrt(g * p_r / rho_r), np.sqrt(rho_l), np.sqrt(rho_r)
    mean_u = (w_l * u_l + w_r * u_r) / (w_l + w_r)
    spread = 0.5 * w_l * w_r / (w_l + w_r) ** 2 * (u_r - u_l) ** 2
    mean_c = np.sqrt((w_l * c_l**2 + w_r * c_r**2) / (w_l + w_r) + spread)
    s_l, s_r = np.minimum(u_l - c_l, mean_u - mean_c), np.maximum(u_r + c_r, mean_u + mean_c)
    m_l, m_r = rho_l * (s_l - u_l), rho_r * (s_r - u_r)
    s_m = (p_r - p_l + u_l * m_l - u_r * m_r) / (m_l - m_r)
    upwind = (s_m >= 0)[:, None]
    w, s = np.where(upwind, left, right), np.where(upwind[:, 0], s_l, s_r)
    rho, u, p = w.T
    energy = p / (g - 1) + 0.5 * rho * u * u
    star = rho * (s - u) / (s - s_m)
    star_energy = star * (energy / rho + (s_m - u) * (s_m + p / (rho * (s - u))))
    jump = np.column_stack([star - rho, star * s_m - rho * u, star_energy - energy])
    inside = ((s_l < 0) & (s_r > 0))[:, None]
    plain = edge_flux(g, np.where((s_l >= 0)[:, None], left, right))
    return np.where(inside, edge_flux(g, w) + s[:, None] * jump, plain)


def end_flux(gas: Gas, w: FloatArray, outward: float) -> FloatArray:
    """Flux through an end of the duct, from the same reservoir face."""
    rho, v, p, _ = reservoir_face(gas, w[0], outward * w[1], w[2])
    enthalpy = gas.exponent / (gas.exponent - 1) * p + 0.5 * rho * v * v
    return np.array([outward * rho * v, rho * v * v + p, outward * v * enthalpy])
