"""The unknowns of a contact, the work arrays of a solution, and the evaluation of one state."""

from typing import NamedTuple, cast

import numpy as np

from solvers.arrays import BoolArray, FloatArray, RecordArray, copy, floats, records
from solvers.compiled import inner_kernel
from solvers.contact.ehl.flow import PLACE, FlowCoefficients, evaluate_columns, flow_coefficients, linearise_columns
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.heat import Heat, balance_columns, face_edges, heat_arrays, linearise_balances
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import FaceFluxes, face_arrays, film_shape, mass_fluxes, pressure_gradients
from solvers.contact.ehl.rheology import limited_gradient
from solvers.contact.ehl.shear import Film, film_arrays

# Number of the column with which a pass begins: 0, or 1 for a pass that leaves out the first column. Both numbers have
# the type np.int64, because numba would compile the passes again for each literal.
FIRST, NEXT = cast("int", np.int64(0)), cast("int", np.int64(1))


class State(NamedTuple):
    """Unknowns at n nodes along the contact and k nodes across the film.

    `pressure` (n,) is P = p/p_H. `separation` (1,) is the rigid separation H0. `temperature` (n, k) is in K.
    `cavitated` (n,) marks the nodes at which the film is broken. `history` (1,) holds the number of iterations and the
    changes max|dP| and max|dT| [K] in the last iteration; the changes are NaN before the first iteration.
    """

    pressure: FloatArray
    separation: FloatArray
    temperature: FloatArray
    cavitated: BoolArray
    history: RecordArray


def no_steps() -> RecordArray:
    """Return the record `history` of a `State` before the first iteration."""
    history = records(1, floats("iterations", "pressure_change", "temperature_change"))
    history.pressure_change = history.temperature_change = np.nan
    return history


class Work(NamedTuple):
    """Work arrays for quantities that follow from a state.

    `height` is the film thickness H (n,), and `gradient` is dP/dX (n,). `at` (n,) holds pressure, h dp/dx and film
    thickness in SI units. The other fields hold flow coefficients, mass fluxes, shear and heat.
    """

    height: FloatArray
    gradient: FloatArray
    at: RecordArray
    coefficients: FlowCoefficients
    faces: FaceFluxes
    film: Film
    heat: Heat


def work_arrays(nodes: int, film_nodes: int) -> Work:
    """Return zeroed arrays for one evaluation."""
    return Work(
        np.zeros(nodes),
        np.zeros(nodes),
        records(nodes, PLACE),
        flow_coefficients(nodes),
        face_arrays(nodes),
        film_arrays(nodes, film_nodes),
        heat_arrays(nodes, film_nodes),
    )


@inner_kernel
def evaluate_flow(problem: Problem, grid: Grid, state: State, work: Work) -> bool:
    """Compute film thickness, stress and flow of all columns; return whether a pressure gradient had to be limited."""
    film_shape(grid, state.pressure, state.separation[0], work.height)
    pressure_gradients(grid.x, state.pressure, state.cavitated, work.gradient)
    slope, limited = problem.maximum_pressure / problem.half_width, False
    for i in range(grid.x.size):
        p, h = state.pressure[i] * problem.maximum_pressure, work.height[i] * problem.gap_scale
        g = h * work.gradient[i] * slope
        bounded = limited_gradient(problem, g)
        limited = limited or bounded != g
        work.at[i].p, work.at[i].g, work.at[i].h = p, bounded, h
    evaluate_columns(problem, state.temperature, FIRST, grid.x.size, work.at, work.film, work.coefficients)
    mass_fluxes(problem, grid.x, state.pressure, work.height, work.coefficients, work.faces)
    return limited


@inner_kernel
def fluid_fractions(problem: Problem, state: State, work: Work) -> float:
    """Compute the fraction of the gap that oil fills at each node, in place [kg/(m s)] (Eq. E8.2).

    Where the film is broken, oil fills only the fraction of the gap that is needed to carry the mass flux. The mass
    flux is taken at the largest pressure, where the flux hardly depends on the pressure gradient. `work`: flow of the
    columns; receives the fractions (n,) [-]. Returns mass flux per width [kg/(m s)].
    """
    flux = work.faces.flux[state.pressure.argmax()] * problem.flux_scale
    for i in range(state.pressure.size):
        drag = work.coefficients.b[i].value * work.at[i].h
        work.heat.fluid_fraction[i] = min(flux / drag, 1.0) if state.cavitated[i] else 1.0
    return float(flux)


@inner_kernel
def match_stream(problem: Problem, state: State, work: Work) -> None:
    """Stream functions with the same mass flux in all columns, in place, so that convection conserves mass (Eq. E8.1).

    In a full column the rest beside the drag of the surfaces has the profile of pressure flow; a broken column takes
    the stream function of the last full one.
    """
    flow, heat = work.film.flow, work.heat
    flux = fluid_fractions(problem, state, work)
    last = flow.stream.shape[1] - 1
    for i in range(state.pressure.size):
        if state.cavitated[i]:
            copy(flow.stream[i - 1], flow.stream[i], last + 1)
        else:
            defect = flux - flow.couette[i, last]
            for k in range(last + 1):
                flow.stream[i, k] = flow.couette[i, k] + defect * flow.poiseuille[i, k]
    face_edges(flow.stream, heat.convection.edges)


@inner_kernel
def evaluate_state(problem: Problem, grid: Grid, state: State, work: Work) -> bool:
    """Residuals of all columns and faces; return whether a pressure gradient had to be limited."""
    state.cavitated[-1] = state.cavitated[-2]
    limited = evaluate_flow(problem, grid, state, work)
    match_stream(problem, state, work)
    work.heat.surfaces.flux_1[0], work.heat.surfaces.flux_2[0] = 0.0, 0.0
    balance_columns(problem, grid, state.temperature, NEXT, grid.x.size, work.at, work.film, work.heat)
    return limited


@inner_kernel
def linearise_state(problem: Problem, state: State, work: Work, damping: float) -> None:
    """Derivatives of stress, flow and heat of an evaluated state at fixed stream function and fluid fraction."""
    n = work.at.size
    linearise_columns(problem, FIRST, n, work.at, work.film, work.coefficients)
    linearise_balances(problem, state.temperature, NEXT, n, work.at, damping, work.film, work.heat)
