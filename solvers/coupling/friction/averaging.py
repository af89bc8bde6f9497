"""Rotor angles and weights for means over one tooth pitch, or one revolution where pitch errors break the symmetry."""

from dataclasses import dataclass
from functools import cache, lru_cache
from math import asin, pi

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.coupling.friction.sums import ToothSums, tooth_sums
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.teeth.kinematics import MeshMotion, ToothPositions, positions_per_pitch, tooth_positions
from solvers.coupling.teeth.loads import mesh_loads

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
    """One mesh over a pitch: its motion, and what loads and friction of its teeth add up to."""

    motion: MeshMotion
    sums: ToothSums


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
    uneven = coupling.pitch_errors is not None
    return _samples(coupling.teeth, uneven, tuple(friction_reversals(mesh, axial_velocity)))


@lru_cache(maxsize=4)
def _samples(teeth: int, uneven: bool, reversals: tuple[float, ...]) -> RotorSamples:
    """The same points at any misalignment while nothing moves along the axis."""
    pitch = 2.0 * pi / teeth
    breaks = [angle % pitch for angle in reversals]
    if uneven:
        nodes, weights = _gauss_rule(positions_per_pitch(teeth))
        turns = teeth
    else:
        breaks += [pitch * part / _PITCH_PARTS for part in range(_PITCH_PARTS)]
        nodes, weights = _gauss_rule(_PITCH_NODES)
        turns = 1
    edges = np.array(sorted({0.0, pitch, *breaks}))
    middle, half = (edges[1:] + edges[:-1]) / 2.0, (edges[1:] - edges[:-1]) / 2.0
    keep = half > 1e-12 * pitch
    one_pitch = (middle[keep, None] + half[keep, None] * nodes).ravel()
    weight = (half[keep, None] * weights).ravel() / (pitch * turns)
    angles = (one_pitch + pitch * np.arange(turns)[:, None]).ravel()
    found = tooth_positions(angles, teeth)
    return RotorSamples(frozen(np.tile(weight, turns)), ToothPositions(frozen(found.sine), frozen(found.cosine)))


def loaded_mesh(inputs: CouplingInputs, mesh: MeshMotion) -> LoadedMesh:
    """Tooth loads of the single mesh over one tooth pitch, or one revolution with pitch errors."""
    samples = rotor_samples(inputs.coupling, mesh, inputs.operation.axial_velocity)
    floating = inputs.model.sleeve == "floating"
    loads = mesh_loads(inputs.coupling, mesh, samples.teeth, inputs.operation.torque, floating=floating)
    sums = tooth_sums(
        loads.tangential_force,
        samples.teeth.sine,
        samples.teeth.cosine,
        samples.weight,
        mesh.sliding,
        inputs.operation.axial_velocity,
    )
    return LoadedMesh(mesh, sums)
