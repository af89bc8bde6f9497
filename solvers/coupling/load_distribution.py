"""The tooth forces of one mesh at the rotor angle asked for."""

from math import cos, pi

import numpy as np

from solvers.arrays import frozen
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.losses import ROUNDING
from solvers.coupling.results import Geometry, LoadCurves, LoadDistribution
from solvers.coupling.teeth.kinematics import MeshMotion, tooth_positions
from solvers.coupling.teeth.loads import mesh_loads, unloading_misalignment

LOADED = 1e-6
"""Tooth force over the mean one from which a tooth counts as loaded."""


def load_distribution(inputs: CouplingInputs, geometry: Geometry, mesh: MeshMotion) -> LoadDistribution:
    """Share of each tooth in the torque, and the place the sleeve takes."""
    coupling, torque, rotor_angle = inputs.coupling, inputs.operation.torque, inputs.model.rotor_angle
    positions = tooth_positions(np.array([rotor_angle]), coupling.teeth)
    loads = mesh_loads(coupling, mesh, positions, torque, floating=inputs.model.sleeve == "floating")
    mean, largest = torque / (geometry.pitch_radius * coupling.teeth), float(loads.tangential_force.max())
    force = np.where(loads.tangential_force[0] < ROUNDING * largest, 0.0, loads.tangential_force[0])
    return LoadDistribution(
        mean_tangential_force=mean,
        max_tangential_force=largest,
        min_tangential_force=float(force.min()),
        max_normal_force=largest / cos(coupling.pressure_angle),
        load_concentration=largest / mean if mean > 0.0 else None,
        loaded_teeth=int(np.count_nonzero(force > LOADED * mean)),
        rotation=float(loads.rotation[0]),
        unloading_misalignment=unloading_misalignment(inputs, geometry),
        sleeve_displacement=(float(loads.displacement[0, 0]), float(loads.displacement[0, 1])),
        iterations=int(loads.iterations[0]),
        curves=LoadCurves(
            angle=frozen(rotor_angle + 2.0 * pi / coupling.teeth * np.arange(coupling.teeth)),
            tangential_force=frozen(force),
        ),
    )
