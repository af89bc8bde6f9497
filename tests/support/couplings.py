"""Draw pitch deviations and random couplings like those of users, and compute the loads on a floating sleeve."""

from math import pi, radians

import numpy as np
from numpy.random import Generator

from benchmarks.published.pahl import TEETH
from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling, CouplingInputs, Friction, Lubricant, ModelOptions, Operation
from solvers.coupling.kinematics import flank_normals, mesh_motion, tooth_geometry, tooth_positions
from solvers.coupling.tooth_loads import ToothLoads, floating_loads


def random_pitch_errors(seed: int, rms: float = 2e-6) -> tuple[float, ...]:
    """Draw normally distributed pitch deviations [m] with the mean zero and exactly the root mean square `rms`.

    There is one deviation for each of the teeth of the coupling in Pahl's figures.
    """
    errors = np.random.default_rng(seed).normal(size=TEETH)
    errors -= errors.mean()
    return tuple(errors * rms / np.sqrt(np.mean(errors**2)))


def floating(
    inputs: CouplingInputs, angles: float | FloatArray, force: tuple[float, float] | FloatArray
) -> tuple[ToothLoads, FloatArray]:
    """Return the tooth loads with a floating sleeve, and the lateral force of the teeth on the sleeve (angles, 2) [N].

    The tooth loads belong to the rotor angles [rad]. `force` is the external force (x, y) on the sleeve [N].
    """
    coupling, angles = inputs.coupling, np.atleast_1d(angles)
    mesh = mesh_motion(coupling, tooth_geometry(coupling), inputs.operation, inputs.model.kinematics)
    teeth = tooth_positions(angles, coupling.teeth)
    forces = np.array(np.broadcast_to(force, (angles.size, 2)))
    loads = floating_loads(coupling, mesh, teeth, inputs.operation.torque, forces)
    return loads, (loads.tangential_force[:, None] * flank_normals(mesh, teeth)).sum(axis=2)


def spread(random: Generator, low: float, high: float) -> float:
    """Draw a number between two bounds. The logarithm of the number is uniformly distributed."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def random_coupling(random: Generator, *, errors: bool | None = None) -> Coupling:
    """Draw a gear coupling with usual proportions.

    `errors` says whether the coupling has pitch deviations. If `errors` is None, two of five couplings have them.
    """
    teeth, module = int(random.integers(20, 90)), float(random.choice([1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0]) * 1e-3)
    pitch_errors = None
    if random.random() < 0.4 if errors is None else errors:
        pitch_errors = tuple(spread(random, 0.2e-6, 10e-6) * random.normal(size=teeth))
    return Coupling(
        teeth=teeth,
        module=module,
        face_width=module * random.uniform(5.0, 12.0),
        tooth_height=module * random.uniform(1.6, 2.2),
        pressure_angle=radians(random.choice([14.5, 20.0, 20.0, 25.0, 30.0])),
        crowning_ratio=spread(random, 0.5, 20.0),
        hub_distance=teeth * module * spread(random, 0.7, 5.0),
        tooth_stiffness=14e9 * module * random.uniform(5.0, 12.0),
        sleeve_mass=1e6 * (teeth * module) ** 2 * module * random.uniform(0.02, 0.08),
        pitch_errors=pitch_errors,
    )


def random_inputs(random: Generator, *, errors: bool | None = None, single: bool = False) -> CouplingInputs:
    """Draw a gear coupling and an operating point."""
    # The mean tooth pressure is 0.5 to 30 N/mm2, and the speed at the pitch circle is 1 to 150 m/s.
    coupling = random_coupling(random, errors=errors)
    radius = coupling.module * coupling.teeth / 2.0
    mean_force = spread(random, 0.5e6, 30e6) * coupling.tooth_height * coupling.face_width
    operation = Operation(
        torque=mean_force * coupling.teeth * radius,
        speed=float(random.choice([-1.0, 1.0])) * spread(random, 1.0, 150.0) / radius,
        misalignment=float(random.choice([-1.0, 1.0])) * radians(spread(random, 0.005, 1.5)),
        axial_velocity=float(random.choice([0.0, -1.0, 1.0])) * spread(random, 1e-4, 3e-2),
        arrangement="single" if single else str(random.choice(["single", "parallel_offset", "angular"])),
    )
    model = ModelOptions(
        kinematics=str(random.choice(["tangential", "spatial"])),
        sleeve=str(random.choice(["centred", "floating"])),
        inlet=str(random.choice(["face", "face", "travel", "infinite"])),
        rotor_angle=random.uniform(0.0, 2.0 * pi),
    )
    lubricant = Lubricant(viscosity=spread(random, 5e-3, 0.3), reference_film=spread(random, 0.3e-6, 2e-6))
    friction = Friction(None if random.random() < 0.5 else random.uniform(0.02, 0.25))
    return CouplingInputs(coupling, operation, lubricant, friction, model)
