"""Orbit of the floating sleeve under its own inertia over one revolution (Fig. 5)."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.coupling.inputs import CouplingInputs, check_inputs
from solvers.coupling.kinematics import (
    MeshMotion,
    mesh_motion,
    pitch_radius,
    revolution,
    tooth_geometry,
    tooth_positions,
)
from solvers.coupling.notices import orbit_notices
from solvers.coupling.results import Geometry, InertiaForce, Orbit, OrbitResult
from solvers.coupling.tooth_loads import LOADED, floating_loads, largest_value
from solvers.errors import InvalidInput, NoSolution

MAX_SWEEPS = 50  # limit; a path that has not settled after this number of sweeps does not settle at all
REPEAT_TOLERANCE = 1e-12  # m, chosen: one ten-millionth of a path of about ten micrometres
HIGHEST_ORDER = 12  # highest Fourier order of the path; the paths for the uncertainty have twice as many orders
REFINEMENTS = (2, 3)  # factors on the number of rotor angles, for the uncertainty of an orbit


@dataclass(frozen=True, slots=True)
class _SettledPath:
    """Path of the sleeve that no longer changes from sweep to sweep.

    `path` (rows, 2) [m] is the displacement of the sleeve, `force` (rows, 2) [N] is the inertia force on this path, and
    `farthest` [m] is the largest displacement. `sweeps` is the number of sweeps. `change` [m] is the change of the path
    in the last sweep. `fewest` is the smallest number of loaded teeth at any rotor angle.
    """

    path: FloatArray
    force: FloatArray
    farthest: float
    sweeps: int
    change: float
    fewest: int

    @property
    def harmonics(self) -> FloatArray:
        """Amplitudes of the inertia force in x and y (2, orders 0 to 12) [N]."""
        return np.stack([_harmonics(self.force[:, axis]) for axis in (0, 1)])


def solve_orbit(inputs: CouplingInputs) -> OrbitResult:
    """Compute the path and the inertia force of the sleeve of one mesh.

    Parameters
    ----------
    inputs : CouplingInputs
        Coupling, operating point and model.

    Returns
    -------
    OrbitResult
        Path [m] and inertia force [N] over one revolution, with their uncertainties.

    Raises
    ------
    InvalidInput
        The codes of `check_inputs`; also `torque_too_low` if the tooth forces cannot hold the sleeve.
    NoSolution
        `sleeve_orbit` if the path does not repeat within 50 sweeps, or if the sleeve has no balance at some rotor
        angle.

    Notes
    -----
    Eq. C11: m_s omega^2 d2e/dtheta2 = sum F_n n. The weight of the sleeve is neglected. Each sweep balances the sleeve
    at every rotor angle under the inertia force of the previous sweep. The sweeps end when the path changes by less
    than 1e-12 m. The inertia force follows from the path by differentiation in Fourier space, with orders k up to 12.
    The sweeps converge as long as m_s (k omega)^2 is well below the lateral stiffness.

    The uncertainty follows from two further paths. Both further paths have twice as many orders and start from the
    settled path. One path has twice as many rotor angles as the settled path, the other path has three times as many.
    One further path would not be enough, because the errors at two resolutions may happen to agree if teeth alternately
    carry load and lift off.

    Examples
    --------
    >>> from math import radians
    >>> from solvers import coupling
    >>> design = coupling.Coupling(teeth=52, module=3e-3)
    >>> tilted = coupling.Operation(3000.0, 200.0, misalignment=radians(0.05))
    >>> orbit = coupling.solve_orbit(coupling.CouplingInputs(design, tilted))
    >>> orbit.max_displacement < 1e-6
    True
    """
    check_inputs(inputs)
    if inputs.operation.torque == 0.0:
        raise InvalidInput("torque_too_low", "without torque nothing centres the sleeve; give a torque", "torque")
    angles = revolution(inputs.coupling.teeth)
    settled = _settled_path(inputs, angles, np.zeros((angles.size, 2)), HIGHEST_ORDER, MAX_SWEEPS)
    _check_holding(settled.force, _safe_force(inputs))
    return _result(angles, settled, _finer_paths(inputs, settled), tooth_geometry(inputs.coupling))


def _finer_paths(inputs: CouplingInputs, settled: _SettledPath) -> list[_SettledPath]:
    """Compute paths with more rotor angles and twice as many orders; return an empty list if a path does not settle."""
    finer = []
    for refinement in REFINEMENTS:
        angles = revolution(inputs.coupling.teeth, refinement)
        force = refinement * np.fft.irfft(np.fft.rfft(settled.force, axis=0), n=angles.size, axis=0)
        try:
            finer.append(_settled_path(inputs, angles, force, 2 * HIGHEST_ORDER, MAX_SWEEPS // 2))
        except NoSolution:
            return []
    return finer


def _safe_force(inputs: CouplingInputs) -> float:
    """Lateral force [N] that the teeth can hold at every rotor angle; the sweeps limit the inertia force to it."""
    coupling = inputs.coupling
    holding_force = inputs.operation.torque / (pitch_radius(coupling) * cos(coupling.pressure_angle))
    return 0.999 * cos(pi / coupling.teeth) * holding_force


def _settled_path(
    inputs: CouplingInputs, angles: FloatArray, force: FloatArray, highest_order: int, max_sweeps: int
) -> _SettledPath:
    """Sweep over the rotor angles until the path of the sleeve repeats, from a guess `force` (rows, 2) [N].

    The change may grow for about a dozen sweeps, while further teeth come under load.
    """
    coupling, operation = inputs.coupling, inputs.operation
    mesh = mesh_motion(coupling, tooth_geometry(coupling), operation, inputs.model.kinematics)
    teeth = tooth_positions(angles, coupling.teeth)
    inertia, limit = coupling.sleeve_mass * operation.speed**2, _safe_force(inputs)
    path = np.zeros_like(force)
    for sweep in range(1, max_sweeps + 1):
        previous = path
        loads = floating_loads(coupling, mesh, teeth, operation.torque, _limited(force, limit))
        path = loads.displacement
        force = -inertia * _second_derivative(path, highest_order)
        change = float(np.abs(path - previous).max())
        if loads.iterations.min() < 0:
            break
        if change < REPEAT_TOLERANCE:
            loaded = loads.tangential_force > LOADED * loads.tangential_force.mean()
            farthest = _farthest(inputs, mesh, angles, force, highest_order)
            return _SettledPath(path, force, farthest, sweep, change, int(loaded.sum(axis=1).min()))
    raise NoSolution(
        "sleeve_orbit",
        "the orbit of the sleeve does not settle, because the inertia of the sleeve is too large for the stiffness of "
        "the mesh; lower the speed or the sleeve mass, or raise the torque",
        {"change": change, "sweeps": float(sweep)},
    )


def _farthest(
    inputs: CouplingInputs, mesh: MeshMotion, angles: FloatArray, force: FloatArray, highest_order: int
) -> float:
    """Largest displacement [m] of the sleeve under a settled inertia force (rows, 2) [N], also between the angles.

    A peak may last only a fraction of a pitch; the force there follows from its Fourier terms.
    """
    coupling, limit = inputs.coupling, _safe_force(inputs)
    order = np.arange(highest_order + 1)
    amplitude = np.fft.rfft(force, axis=0)[order] / angles.size * np.where(order == 0, 1.0, 2.0)[:, None]

    def displacement(at: FloatArray) -> FloatArray:
        inertia_force = (np.exp(1j * np.outer(at, order)) @ amplitude).real
        teeth = tooth_positions(at, coupling.teeth)
        loads = floating_loads(coupling, mesh, teeth, inputs.operation.torque, _limited(inertia_force, limit))
        unbalanced = int(np.count_nonzero(loads.iterations < 0))
        if unbalanced:
            message = "no equilibrium of the sleeve was found at some rotor angles of the orbit; raise the torque"
            raise NoSolution("sleeve_orbit", message, {"unbalanced_angles": float(unbalanced)})
        return np.hypot(loads.displacement[:, 0], loads.displacement[:, 1])

    return largest_value(angles, displacement)


def _second_derivative(path: FloatArray, highest_order: int) -> FloatArray:
    """Compute d2e/dtheta2 of a path (rows, 2) over one revolution, with Fourier orders up to `highest_order`."""
    spectrum = np.fft.rfft(path, axis=0)
    order = np.arange(spectrum.shape[0])
    factor = np.where(order <= highest_order, -(order.astype(float) ** 2), 0.0)
    return np.fft.irfft(spectrum * factor[:, None], n=path.shape[0], axis=0)


def _limited(force: FloatArray, limit: float) -> FloatArray:
    """Limit the magnitude of forces (rows, 2) to `limit`, and keep the directions."""
    size = np.hypot(force[:, 0], force[:, 1])
    return force * (limit / np.maximum(size, limit))[:, None]


def _check_holding(force: FloatArray, limit: float) -> None:
    """Raise InvalidInput if the inertia force exceeds `limit`, the force that the teeth hold at every rotor angle."""
    needed = float(np.hypot(force[:, 0], force[:, 1]).max())
    if needed > limit:
        raise InvalidInput(
            "torque_too_low",
            f"the torque is too low to centre the sleeve: the inertia force is {needed:.4g} N, but the teeth can hold "
            f"only {limit:.4g} N; raise the torque",
            "torque",
        )


def _harmonics(force: FloatArray) -> FloatArray:
    """Compute the amplitudes of orders 0 to 12: the magnitude |c_0| of the mean, then 2 |c_k| for k = 1 to 12."""
    amplitude = 2.0 * np.abs(np.fft.rfft(force)) / force.size
    amplitude[0] /= 2.0
    return amplitude[: HIGHEST_ORDER + 1]


def _result(
    angles: FloatArray, settled: _SettledPath, finer: Sequence[_SettledPath], geometry: Geometry
) -> OrbitResult:
    """Results of the settled path; uncertainties are the largest differences from the finer paths."""
    harmonics = settled.harmonics
    displacement_uncertainty = max((abs(path.farthest - settled.farthest) for path in finer), default=None)
    harmonics_uncertainty = max((float(np.abs(path.harmonics - harmonics).max()) for path in finer), default=None)
    return OrbitResult(
        orbit=Orbit(rotor_angle=frozen(angles), x=frozen(settled.path[:, 0]), y=frozen(settled.path[:, 1])),
        inertia_force=InertiaForce(
            x=frozen(settled.force[:, 0]),
            y=frozen(settled.force[:, 1]),
            harmonics_x=frozen(harmonics[0]),
            harmonics_y=frozen(harmonics[1]),
        ),
        max_displacement=settled.farthest,
        displacement_uncertainty=displacement_uncertainty,
        harmonics_uncertainty=harmonics_uncertainty,
        sweeps=settled.sweeps,
        change=settled.change,
        derived=geometry,
        warnings=tuple(
            orbit_notices(
                fewest_teeth=settled.fewest,
                displacement=settled.farthest,
                displacement_uncertainty=displacement_uncertainty,
                harmonic=float(harmonics.max()),
                harmonic_uncertainty=harmonics_uncertainty,
            )
        ),
    )
