"""Rotor angles and weights for means over one tooth pitch, or one revolution where pitch errors break the symmetry."""

from dataclasses import dataclass
from functools import cache
from math import asin, pi

import numpy as np

from solvers.arrays import FloatArray
from solvers.coupling.friction_sums import FrictionSums, friction_sums
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.kinematics import MeshMotion, ToothPositions, positions_per_pitch, tooth_positions
from solvers.coupling.tooth_loads import mesh_loads

_PITCH_PARTS = 3
_PITCH_NODES = 8
_gauss_rule = cache(np.polynomial.legendre.leggauss)


@dataclass(frozen=True, slots=True)
class RotorSamples:
    """Quadrature over rotor angles: `weight` (rows) adds up to one, `teeth` are all tooth positions (rows, teeth)."""

    weight: FloatArray
    teeth: ToothPositions


@dataclass(frozen=True, slots=True)
class LoadedMesh:
    """One mesh over a pitch: its motion, where its teeth stand, their tangential forces (rows, teeth) [N], sums."""

    motion: MeshMotion
    weight: FloatArray
    teeth: ToothPositions
    tangential_force: FloatArray
    friction: FrictionSums

    def mean_sum(self, values: FloatArray) -> float:
        """Sum over the teeth of values (rows, teeth), averaged over rotor angles."""
        return float(self.weight @ values.sum(axis=1))


def friction_reversals(mesh: MeshMotion, axial_velocity: float) -> list[float]:
    """Tooth angles [rad] at which the sliding velocity equals 0 or + or - the axial velocity."""
    angles = [0.0, pi]
    if abs(axial_velocity) < abs(mesh.sliding):
        reversal = asin(axial_velocity / mesh.sliding)
        angles += [reversal, pi - reversal, -reversal, pi + reversal]
    return angles


def rotor_samples(coupling: Coupling, mesh: MeshMotion, axial_velocity: float) -> RotorSamples:
    """Gauss points between the rotor angles at which friction reverses at some tooth.

    Friction jumps where a tooth's relative velocity changes sign; breaking the pitch there leaves an integrand that
    is continuous, with kinks only where a tooth comes under load. Several hundred midpoints do no better.
    """
    pitch = 2.0 * pi / coupling.teeth
    breaks = [angle % pitch for angle in friction_reversals(mesh, axial_velocity)]
    if coupling.pitch_errors is None:
        breaks += [pitch * part / _PITCH_PARTS for part in range(_PITCH_PARTS)]
        nodes, weights = _gauss_rule(_PITCH_NODES)
        turns = 1
    else:
        nodes, weights = _gauss_rule(positions_per_pitch(coupling.teeth))
        turns = coupling.teeth
    edges = np.array(sorted({0.0, pitch, *breaks}))
    middle, half = (edges[1:] + edges[:-1]) / 2.0, (edges[1:] - edges[:-1]) / 2.0
    keep = half > 1e-12 * pitch
    one_pitch = (middle[keep, None] + half[keep, None] * nodes).ravel()
    weight = (half[keep, None] * weights).ravel() / (pitch * turns)
    angles = (one_pitch + pitch * np.arange(turns)[:, None]).ravel()
    return RotorSamples(weight=np.tile(weight, turns), teeth=tooth_positions(angles, coupling.teeth))


def loaded_mesh(inputs: CouplingInputs, mesh: MeshMotion) -> LoadedMesh:
    """Tooth loads of the single mesh over one tooth pitch, or one revolution with pitch errors."""
    samples = rotor_samples(inputs.coupling, mesh, inputs.operation.axial_velocity)
    floating = inputs.model.sleeve == "floating"
    loads = mesh_loads(inputs.coupling, mesh, samples.teeth, inputs.operation.torque, floating=floating)
    force, teeth, weight = loads.tangential_force, samples.teeth, samples.weight
    sums = friction_sums(force, teeth.sine, teeth.cosine, weight, mesh.sliding, inputs.operation.axial_velocity)
    return LoadedMesh(mesh, weight, teeth, force, sums)
