"""Orbit of the floating sleeve under its own inertia over one revolution (Fig. 5)."""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.coupling.checks import check_inputs
from solvers.coupling.geometry import tooth_geometry
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.kinematics import mesh_motion, revolution, tooth_positions
from solvers.coupling.results import Geometry, InertiaForce, Orbit, OrbitResult
from solvers.coupling.tooth_loads import ToothLoads, floating_loads
from solvers.errors import InvalidInput, NoSolution

MAX_SWEEPS = 50
REPEAT_TOLERANCE = 1e-12
HIGHEST_ORDER = 12


@dataclass(frozen=True, slots=True)
class _SettledPath:
    """Path (rows, 2) [m], its inertia force (rows, 2) [N], the sweeps it took and the change [m] in the last one."""

    path: FloatArray
    force: FloatArray
    sweeps: int
    change: float


def solve_orbit(inputs: CouplingInputs) -> OrbitResult:
    """Path and inertia force of the sleeve of one mesh; no weight acts.

    m_s omega^2 d2e/dtheta2 = sum F_n n: each sweep balances the sleeve at every rotor angle under the inertia force of
    the sweep before, derived in Fourier space with orders up to 12, until the path repeats to 1e-12 m. Contracts while
    m_s (k omega)^2 stays well below the lateral stiffness.

    Raises InvalidInput as `solve` and torque_too_low (the tooth forces cannot hold the sleeve), NoSolution
    `sleeve_orbit` if the path does not repeat within 50 sweeps, or some position is left without balance.
    """
    check_inputs(inputs)
    coupling, operation = inputs.coupling, inputs.operation
    if operation.torque == 0.0:
        raise InvalidInput("torque_too_low", "without torque nothing centres the sleeve", "torque")
    geometry = tooth_geometry(coupling)
    mesh = mesh_motion(coupling, geometry, operation, inputs.model.kinematics)
    angles = revolution(coupling.teeth)
    teeth = tooth_positions(angles, coupling.teeth)
    holding_force = operation.torque / (geometry.pitch_radius * cos(coupling.pressure_angle))
    # A lateral force that the teeth hold at every rotor angle, whatever the sweeps ask for on their way.
    safe_force = 0.999 * cos(pi / coupling.teeth) * holding_force

    def balanced(force: FloatArray) -> ToothLoads:
        return floating_loads(coupling, mesh, teeth, operation.torque, _limited(force, safe_force))

    settled = _settled_path(balanced, np.zeros((angles.size, 2)), coupling.sleeve_mass * operation.speed**2)
    _check_holding(settled.force, safe_force)
    return _result(angles, settled, geometry)


def _settled_path(balanced: Callable[[FloatArray], ToothLoads], force: FloatArray, inertia: float) -> _SettledPath:
    """Sweep from an inertia force (rows, 2) [N] until the path repeats; `inertia` is m_s omega^2 [N/m].

    The change from sweep to sweep may grow for a dozen of them, while teeth come under load, and still die out.
    """
    path = np.zeros_like(force)
    for sweep in range(1, MAX_SWEEPS + 1):
        previous = path
        loads = balanced(force)
        path = loads.displacement
        force = -inertia * _second_derivative(path)
        change = float(np.abs(path - previous).max())
        if loads.iterations.min() < 0:
            break
        if change < REPEAT_TOLERANCE:
            return _SettledPath(path, force, sweep, change)
    raise NoSolution(
        "sleeve_orbit",
        "the orbit does not settle: the sleeve's inertia is no longer small against the mesh stiffness; "
        "lower the speed or the sleeve mass, or raise the torque",
        {"change": change, "sweeps": float(sweep)},
    )


def _second_derivative(path: FloatArray) -> FloatArray:
    """d2e/dtheta2 of a path (rows, 2) over one revolution, orders up to 12."""
    spectrum = np.fft.rfft(path, axis=0)
    order = np.arange(spectrum.shape[0])
    factor = np.where(order <= HIGHEST_ORDER, -(order.astype(float) ** 2), 0.0)
    return np.fft.irfft(spectrum * factor[:, None], n=path.shape[0], axis=0)


def _limited(force: FloatArray, limit: float) -> FloatArray:
    """Forces (rows, 2) shortened to at most `limit`."""
    size = np.hypot(force[:, 0], force[:, 1])
    return force * (limit / np.maximum(size, limit))[:, None]


def _check_holding(force: FloatArray, limit: float) -> None:
    """Raise InvalidInput unless the torque's tooth forces can hold the inertia force at every rotor angle."""
    needed = float(np.hypot(force[:, 0], force[:, 1]).max())
    if needed > limit:
        raise InvalidInput(
            "torque_too_low",
            f"torque too low to centre the sleeve: inertia asks for {needed:.4g} N, the teeth hold {limit:.4g} N",
            "torque",
        )


def _harmonics(force: FloatArray) -> FloatArray:
    """Amplitudes 2 |c_k| of orders 0 to 12; order 0 is |mean|."""
    amplitude = 2.0 * np.abs(np.fft.rfft(force)) / force.size
    amplitude[0] /= 2.0
    return amplitude[: HIGHEST_ORDER + 1]


def _result(angles: FloatArray, settled: _SettledPath, geometry: Geometry) -> OrbitResult:
    """The converged orbit."""
    path, x, y = settled.path, settled.force[:, 0], settled.force[:, 1]
    return OrbitResult(
        orbit=Orbit(rotor_angle=frozen(angles), x=frozen(path[:, 0]), y=frozen(path[:, 1])),
        inertia_force=InertiaForce(
            x=frozen(x), y=frozen(y), harmonics_x=frozen(_harmonics(x)), harmonics_y=frozen(_harmonics(y))
        ),
        max_displacement=float(np.hypot(path[:, 0], path[:, 1]).max()),
        sweeps=settled.sweeps,
        change=settled.change,
        derived=geometry,
        warnings=(),
    )
