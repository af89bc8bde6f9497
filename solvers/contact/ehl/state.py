"""The unknowns of a contact, the arrays a solution works in, and the evaluation of one state."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import BoolArray, FloatArray, RecordArray, floats, records
from solvers.compiled import kernel
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.heat import Heat, column_balance, face_edges, heat_arrays, surface_history
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import (
    FaceFluxes,
    FlowCoefficients,
    assemble_faces,
    evaluate_column,
    face_fluxes,
    film_shape,
    flow_coefficients,
    pressure_gradients,
)
from solvers.contact.ehl.shear import Film, film_arrays, limited_gradient


class State(NamedTuple):
    """Unknowns at n nodes along and k across: pressure/p_H (n,), rigid separation H0 (1,), temperature (n, k) [K].

    `cavitated` (n,) marks the nodes of broken film; `history` (1,) keeps the number of iterations and the last changes
    max|dP| and max|dT| [K] (NaN: none).
    """

    pressure: FloatArray
    separation: FloatArray
    temperature: FloatArray
    cavitated: BoolArray
    history: RecordArray


def no_steps() -> RecordArray:
    """The history of a state that no step has been taken from: no change is known."""
    history = records(1, floats("iterations", "pressure_change", "temperature_change"))
    history.pressure_change = history.temperature_change = np.nan
    return history


class Work(NamedTuple):
    """Quantities that follow from a state: film H and dP/dX (n,); flow, film and heat of every column."""

    height: FloatArray
    gradient: FloatArray
    coefficients: FlowCoefficients
    faces: FaceFluxes
    film: Film
    heat: Heat


def work_arrays(nodes: int, film_nodes: int) -> Work:
    """Room for one evaluation."""
    return Work(
        np.zeros(nodes),
        np.zeros(nodes),
        flow_coefficients(nodes),
        face_fluxes(nodes),
        film_arrays(nodes, film_nodes),
        heat_arrays(nodes, film_nodes),
    )


@kernel
def evaluate_flow(problem: Problem, grid: Grid, state: State, work: Work) -> bool:
    """Film, stress and flow of every column; whether the guard on the pressure gradient acted."""
    film_shape(grid, state.pressure, state.separation[0], work.height)
    pressure_gradients(grid.x, state.pressure, state.cavitated, work.gradient)
    slope = problem.maximum_pressure / problem.half_width
    limited = False
    for i in range(grid.x.size):
        h = work.height[i] * problem.gap_scale
        g = h * work.gradient[i] * slope
        bounded = limited_gradient(problem, g)
        limited = limited or bounded != g
        p = state.pressure[i] * problem.maximum_pressure
        evaluate_column(problem, i, state.temperature, p, bounded, h, work.film, work.coefficients)
    assemble_faces(
        problem, grid.x, state.pressure, work.height, work.gradient, state.cavitated, work.coefficients, work.faces
    )
    return limited


@kernel
def fluid_fractions(problem: Problem, state: State, work: Work) -> float:
    """Fill the gap with the share of fluid that the flux needs where the film is broken; returns the flux (Eq. E8.2).

    It is taken where the pressure is largest, since there it does not depend on the pressure gradient.
    """
    flux = work.faces.flux[state.pressure.argmax()] * problem.flux_scale
    for i in range(state.pressure.size):
        drag = work.coefficients.b.value[i] * work.height[i] * problem.gap_scale
        work.heat.fluid_fraction[i] = min(flux / drag, 1.0) if state.cavitated[i] else 1.0
    return float(flux)


@kernel
def match_stream(problem: Problem, state: State, work: Work) -> None:
    """Make every column carry the same mass (Eq. E8.1).

    A full column makes up for what the surfaces do not drag with the profile of pressure flow; a broken one keeps the
    profile of the last full one in a fraction of the gap. So convection conserves mass on the way to the solution,
    too.
    """
    flow, heat = work.film.flow, work.heat
    flux = fluid_fractions(problem, state, work)
    last = flow.stream.shape[1] - 1
    for i in range(state.pressure.size):
        if state.cavitated[i]:
            flow.stream[i] = flow.stream[i - 1]
        else:
            defect = flux - flow.couette[i, last]
            for k in range(last + 1):
                flow.stream[i, k] = flow.couette[i, k] + defect * flow.poiseuille[i, k]
    face_edges(flow.stream, heat.convection.edges)


@kernel
def balance_columns(problem: Problem, grid: Grid, state: State, work: Work, damping: float) -> None:
    """Heat balance of every column at the present temperatures; `damping` see column_balance."""
    surfaces = work.heat.surfaces
    slope = problem.maximum_pressure / problem.half_width
    surfaces.flux_1[0], surfaces.flux_2[0] = 0.0, 0.0
    for i in range(1, grid.x.size):
        h = work.height[i] * problem.gap_scale
        g = limited_gradient(problem, h * work.gradient[i] * slope)
        width = grid.weights[i] * problem.half_width
        surface_history(problem, i, grid.heat, surfaces)
        column_balance(problem, i, width, state.temperature, g, h, damping, work.film, work.heat)


@kernel
def evaluate_state(problem: Problem, grid: Grid, state: State, work: Work, damping: float) -> bool:
    """All of the above; whether the guard on the pressure gradient acted. Film that is broken reaches the end."""
    state.cavitated[-1] = state.cavitated[-2]
    limited = evaluate_flow(problem, grid, state, work)
    match_stream(problem, state, work)
    balance_columns(problem, grid, state, work, damping)
    return limited
