"""Accuracy of a solved contact: estimated error due to the mesh, and independent check of the temperatures.

The error due to the mesh is estimated from a solution on half as many nodes. The check of the temperatures calls none
of the functions that solve the contact. It uses reported values only: curves, field and inputs in SI units. The check
has three parts. The temperature of each surface must equal the bulk temperature of the surface plus the rise due to the
heat flux into the surface. Oil that enters must have the inlet temperature. The film may be colder than the lowest bulk
or inlet temperature, but only by the amount that the decompression of the oil explains.
"""

from dataclasses import dataclass, replace
from math import ceil, isfinite, log2, pi, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl import measures
from solvers.contact.ehl.continuation import TIGHT, Attempt, Budget, Resolution, interpolate, polish, price
from solvers.contact.ehl.grid import grid_for
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.notices import LARGEST_MESH_ERROR
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.results import ContactCurves, ContactField, MeshError
from solvers.materials import Solid

FINEST = 481  # largest number of nodes, chosen; the cost of the dense solution grows with the third power of the number
STEPS_ON_FINER = 20.0  # Newton steps that a refinement may take, chosen
STEPS_ON_COARSER = 12  # Newton steps of the comparison with half as many nodes, chosen
# Tolerances of P and of temperature [K] for the solution on half the nodes. After a Newton step within these tolerances
# the solution is accurate enough for the comparison.
NEAR = (0.12, 12.0)
# Remaining error as a share of the difference from the result on half as many nodes. The share is 1/3 if convergence is
# of second order. If the pressure falls steeply from one node to the next, both meshes place the fall between the same
# two nodes, wherever the fall should be. The two meshes then agree better with each other than with the exact solution.
# If the fall is p_H/2 or more, the whole difference counts as error.
SECOND_ORDER = 1 / 3
LEFT = {"friction": 1 / 2, "generated_heat": 1 / 2}  # results that depend on heat converge with an order below two
LEFT_BY_FALL = 2.0  # share of the difference that counts as error, divided by the fall of pressure [p_H]
AT_INLET = {"central_film", "centre_pressure"}  # the inlet decides these results; the outlet has no effect
BEFORE_SPIKES = 0.5  # half widths downstream of the centre; pressure spikes lie further downstream
SURFACES = {"surface_1_flash": 0, "surface_2_flash": -1}  # index of the surface among the nodes across the film
LEAST = {
    "friction": 1e-3,
    "surface_1_flash": 25.0,
    "surface_2_flash": 25.0,
}  # [-], [K]; the error of a smaller result is relative to this value


def departure(inputs: LineContactInputs, curves: ContactCurves, field: ContactField) -> float:
    """Largest amount [K] by which the reported temperatures violate the conditions at the top of this module."""
    contact, bulk = inputs.contact, inputs.temperatures
    t = field.temperature
    fluxes = (curves.surface_1_heat_flux, curves.surface_2_heat_flux)
    sides = zip(
        (inputs.surface_1, inputs.surface_2),
        (contact.speed_1, contact.speed_2),
        (bulk.surface_1, bulk.surface_2),
        fluxes,
        (t[:, 0], t[:, -1]),
        strict=True,
    )
    departures = [inlet_departure(inputs, t), undercooling(inputs, curves, t)]
    for solid, speed, at_bulk, flux, surface in sides:
        assert flux is not None
        departures.append(float(np.abs(surface - at_bulk - surface_heating(solid, speed, curves.x, flux)).max()))
    return max(departures)


def surface_heating(solid: Solid, speed: float, x: FloatArray, flux: FloatArray) -> FloatArray:
    """Temperature rise (n,) of a surface under a heat flux linear between positions: strip sources [K] (Eq. E12).

    (pi rho c lambda u)^-1/2 int q(s) (x - s)^-1/2 ds on a fast half-space (Carslaw and Jaeger).
    """
    effusivity_squared = solid.density * solid.specific_heat * solid.thermal_conductivity
    return strip_integral(x, flux) / sqrt(pi * effusivity_squared * speed)


@kernel
def strip_integral(x: FloatArray, flux: FloatArray) -> FloatArray:
    """Integral of q(s) (x - s)^-1/2 from x_0 to each x (n,), by parts 2 q_0 (x - x_0)^1/2 + int 2 q' (x - s)^1/2 ds."""
    n = x.size
    slope = np.empty(n)
    before = 0.0
    for j in range(n):
        after = (flux[j + 1] - flux[j]) / (x[j + 1] - x[j]) if j + 1 < n else 0.0
        slope[j] = (after - before) * 4.0 / 3.0
        before = after
    integral = np.empty(n)
    for i in range(n):
        total = 2.0 * flux[0] * np.sqrt(x[i] - x[0])
        for j in range(i):
            distance = x[i] - x[j]
            total += slope[j] * distance * np.sqrt(distance)
        integral[i] = total
    return integral


def inlet_departure(inputs: LineContactInputs, t: FloatArray) -> float:
    """Largest error [K] across the film `t` (n, k) at the first node.

    Surfaces must have their bulk temperatures, inflow that of the inlet, backflow that of the next node.
    """
    bulk = inputs.temperatures
    walls = max(abs(t[0, 0] - bulk.surface_1), abs(t[0, -1] - bulk.surface_2))
    inside = t[0, 1:-1]
    entering, leaving = np.abs(inside - bulk.inlet), np.abs(inside - t[1, 1:-1])
    return max(float(walls), float(np.minimum(entering, leaving).max()))


def undercooling(inputs: LineContactInputs, curves: ContactCurves, t: FloatArray) -> float:
    """Return the part of the film's cooling that decompression does not explain [K], at least 0.

    The cooling is the lowest bulk or inlet temperature minus the lowest temperature in `t` (n, k). Decompression takes
    up the heat q = beta T u |dp/dx| h per area. Here beta is the thermal expansion of the oil, T is the largest
    temperature of the film, u is the speed of the faster surface, and h is the film thickness.

    Decompression explains two parts of the cooling. The surfaces cool by `surface_heating` for the flux q. Between the
    surfaces, the film cools by a further q h/(8 lambda), where lambda is the thermal conductivity of the oil.
    """
    bulk, contact, oil = inputs.temperatures, inputs.contact, inputs.lubricant
    missing = min(bulk.surface_1, bulk.surface_2, bulk.inlet) - float(t.min())
    if missing <= 0.0:
        return 0.0
    gradient = np.abs(np.gradient(curves.pressure, curves.x))
    faster = max(contact.speed_1, contact.speed_2)
    cooling = oil.laws.thermal_expansion * float(t.max()) * faster * gradient * curves.film
    film = float((cooling * curves.film).max()) / (8.0 * oil.thermal_conductivity)
    solids = ((inputs.surface_1, contact.speed_1), (inputs.surface_2, contact.speed_2))
    surfaces = max(float(surface_heating(solid, speed, curves.x, cooling).max()) for solid, speed in solids)
    return max(missing - film - surfaces, 0.0)


@dataclass(frozen=True, slots=True)
class Comparison:
    """Results of a contact (`fine`), and of the same contact on half as many nodes (`coarse`).

    The keys of `fine` and `coarse` are the names of the results in `MeshError`. A result is stored as a tuple of
    numbers that add up to the result. `fall` is the steepest fall of the pressure P = p/p_H from one node to the next.
    `kinks` holds the value of `_kink` for each surface [K].
    """

    fine: dict[str, tuple[float, ...]]
    coarse: dict[str, tuple[float, ...]]
    fall: float
    kinks: dict[str, float]

    def smooth_error(self) -> MeshError:
        """Error due to the fine mesh without spikes and kinks; falls quickly with the number of nodes."""
        return self._error(0.0, {})

    def error(self) -> MeshError:
        """Error due to the fine mesh with spikes and kinks, which even `FINEST` nodes do not resolve."""
        return self._error(min(LEFT_BY_FALL * self.fall, 1.0), self.kinks)

    def _error(self, left_at_spike: float, kinks: dict[str, float]) -> MeshError:
        errors = {}
        for name, parts in self.fine.items():
            moved = sum(abs(part - of_coarse) for part, of_coarse in zip(parts, self.coarse[name], strict=True))
            left = max(LEFT.get(name, SECOND_ORDER), 0.0 if name in AT_INLET else left_at_spike)
            missing = max(left * moved, kinks.get(name, 0.0))
            errors[name] = missing / max(abs(sum(parts)), LEAST.get(name, 0.0))
        # The oil that passes the centre also passes the thinnest place. The minimum film therefore has at least the
        # error of the central film.
        errors["minimum_film"] = max(errors["minimum_film"], errors["central_film"])
        return MeshError(**errors)


def refine(
    inputs: LineContactInputs, constants: Problem, resolution: Resolution, attempt: Attempt, budget: Budget
) -> tuple[Attempt, MeshError | None]:
    """Solve a contact on finer meshes until the mesh is fine enough; return the last converged solution.

    The refinement starts from the converged solution `attempt`. Also return the estimated error due to the last mesh,
    or None if this error is not known. The refinement also ends in three other cases: the mesh has the largest number
    of nodes; no refinement is requested; or a finer solution does not converge within the remaining steps.
    """
    comparison = compare(inputs, constants, resolution, attempt)
    while inputs.model.refine_mesh and not is_acceptable(comparison) and resolution.nodes < FINEST:
        resolution = replace(resolution, nodes=finer_nodes(resolution.nodes, comparison))
        grid = grid_for(resolution.gap, resolution.nodes)
        guess = interpolate(attempt.state, attempt.grid.x, grid.x)
        steps = budget.part(STEPS_ON_FINER * price(resolution, resolution.nodes))
        finer = polish(constants, resolution, grid, guess, TIGHT, steps)
        if not finer.converged:
            break
        attempt = finer
        comparison = compare(inputs, constants, resolution, attempt)
    return attempt, None if comparison is None else comparison.error()


def is_acceptable(comparison: Comparison | None) -> bool:
    """Whether the mesh error is known and within the limit, without spikes and kinks, which nodes do not remove."""
    return comparison is not None and comparison.smooth_error().largest <= LARGEST_MESH_ERROR


def finer_nodes(nodes: int, comparison: Comparison | None) -> int:
    """Number of nodes of the next finer mesh, at most `FINEST`.

    The error is of second order: intervals grow by the root of its ratio to the limit, at most 16 (unknown: 4), rounded
    up to a power of sqrt(2) so that contacts share meshes.
    """
    excess = 4.0 if comparison is None else min(comparison.smooth_error().largest / LARGEST_MESH_ERROR, 16.0)
    half_octaves = max(ceil(log2(excess)), 1)
    return min(round((nodes - 1) * sqrt(2.0) ** half_octaves) + 1, FINEST)


def compare(
    inputs: LineContactInputs, constants: Problem, resolution: Resolution, attempt: Attempt
) -> Comparison | None:
    """Compare a solved contact with half as many nodes (Richardson); None if the coarse solution fails.

    One Newton step from the fine solution is usually enough; sharp peaks need more.
    """
    grid = grid_for(resolution.gap, resolution.nodes // 2 + 1)
    state = interpolate(attempt.state, attempt.grid.x, grid.x)
    steps = Budget(STEPS_ON_COARSER * price(resolution, grid.x.size))
    coarse = polish(constants, resolution, grid, state, NEAR, steps)
    if not coarse.converged:
        return None
    fine, other = (_parts(inputs, constants, state) for state in (attempt, coarse))
    if not all(isfinite(sum(parts)) for values in (fine, other) for parts in values.values()):
        return None
    kinks = {name: _kink(attempt, surface) for name, surface in SURFACES.items()} if inputs.model.thermal else {}
    return Comparison(fine, other, _steepest_fall(attempt), kinks)


def _steepest_fall(attempt: Attempt) -> float:
    """Return the largest fall of the pressure P = p/p_H from one node to the next, downstream of the centre."""
    return float(-np.diff(attempt.state.pressure[attempt.grid.x > 0.0]).min())


def _kink(attempt: Attempt, surface: int) -> float:
    """Largest excess [K] of a surface temperature downstream of the centre over the mean of its neighbours.

    A spike that heats one node heats it by its distance; on another mesh the node could be hotter by about this excess.
    """
    t = attempt.state.temperature[attempt.grid.x > 0.0, surface]
    return float((t[1:-1] - 0.5 * (t[:-2] + t[2:])).max())


def _parts(inputs: LineContactInputs, constants: Problem, attempt: Attempt) -> dict[str, tuple[float, ...]]:
    """Results by which the error of the mesh is estimated, by the names of `MeshError`; no local maxima.

    Friction, heat and flash have two parts, up- and downstream of where spikes begin: a finer mesh has a thicker film
    and less heat upstream, a sharper spike and more heat downstream, which may cancel in the sum.
    """
    heights = measures.film_heights(constants, attempt)
    parts: dict[str, tuple[float, ...]] = {
        "central_film": (measures.at_place(attempt, heights),),
        "minimum_film": (float(heights.min()),),
        "centre_pressure": (measures.at_place(attempt, attempt.state.pressure),),
        "friction": _before_and_behind(attempt, measures.friction_by_node(constants, attempt, inputs)),
    }
    if inputs.model.thermal:
        parts["generated_heat"] = _before_and_behind(attempt, measures.heat_by_node(constants, attempt))
        for name, surface in SURFACES.items():
            t = attempt.state.temperature[:, surface]
            before = measures.at_place(attempt, t, BEFORE_SPIKES)
            bulk = (constants.bulk_1, constants.bulk_2)[surface]
            parts[name] = (before - bulk, float(t.max()) - before)
    return parts


def _before_and_behind(attempt: Attempt, by_node: FloatArray) -> tuple[float, float]:
    """Return the sum of `by_node` (n,) upstream of the place where pressure spikes begin, and the sum downstream."""
    before = attempt.grid.x <= BEFORE_SPIKES
    return float(by_node[before].sum()), float(by_node[~before].sum())
