"""Shafts in two bearings: displacements of the nodes under nodal loads, by statics and strain energy.

A shaft in two bearings is statically determinate, that is, shear force V and bending moment M of every element follow
from the loads alone. Between nodes V is constant and M is linear. The strain energy of Timoshenko's beam is
int [M^2 / (2 E I) + V^2 / (2 kappa G A)] dz. The flexibility is the second derivative of this energy with respect to
the nodal loads. The flexibility is exact for stepped cylinders under nodal loads. The flexibility is symmetric and
positive semidefinite by construction, even if elements are very short.
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import COINCIDENT, Shaft, ShaftSection

GRAVITY = 9.80665  # m/s^2, standard gravity (CGPM 1901)


@dataclass(frozen=True, slots=True)
class ShaftModel:
    """A shaft with N nodes at the positions z [m].

    A motion in one plane is a vector (2N,) of the deflections [m] and the slopes [rad] of all nodes. The nodal loads
    are the vector (2N,) of the conjugate forces [N] and moments [N m]. `flexibility` (2N, 2N), times the nodal loads,
    gives the motion if both bearings are at rest. `bearing_share` (2, 2N), times the nodal loads, gives the loads on
    the bearings. The transpose of `bearing_share`, times displacements of the bearings, gives the motion that these
    displacements cause. `torsion` (N, N) is the twist of the nodes per nodal torque [rad/(N m)]. `weight` (2N,) holds
    the nodal loads that are due to the weight of the shaft.
    """

    z: FloatArray
    flexibility: FloatArray
    bearing_share: FloatArray
    torsion: FloatArray
    weight: FloatArray

    def node(self, position: float) -> int:
        """Return the number of the node nearest to a position [m]."""
        return int(np.argmin(np.abs(self.z - position)))


def shear_coefficient(poisson_ratio: float, bore_ratio: float) -> float:
    """Compute the shear coefficient of a hollow circular cross-section [-]. Eq. D2; Cowper (1966)."""
    square = bore_ratio**2
    plain = (7 + 6 * poisson_ratio) * (1 + square) ** 2
    return 6 * (1 + poisson_ratio) * (1 + square) ** 2 / (plain + (20 + 12 * poisson_ratio) * square)


def shaft_model(shaft: Shaft, torque_position: float, positions: FloatArray) -> ShaftModel:
    """Compute the flexibility of a shaft at its nodes (Eq. D2)."""
    ends = shaft.start + np.cumsum([0.0, *(section.length for section in shaft.sections)])
    bearings = [bearing.position for bearing in shaft.bearings]
    places = np.sort(np.concatenate([ends, bearings, [torque_position], positions]))
    z = places[np.append(True, np.diff(places) > COINCIDENT)]
    middles = (z[1:] + z[:-1]) / 2
    index = np.clip(np.searchsorted(ends, middles) - 1, 0, len(shaft.sections) - 1)
    elements = [shaft.sections[i] for i in index]
    share = _bearing_share(z, bearings[0], bearings[1])
    return ShaftModel(
        z=z,
        flexibility=_flexibility(shaft, z, elements, share, bearings),
        bearing_share=share,
        torsion=_torsion(shaft, z, elements, torque_position),
        weight=_weight(shaft, z, elements),
    )


def area(section: ShaftSection) -> float:
    """Return the area of the cross-section [m^2]."""
    return pi / 4 * (section.outer_diameter**2 - section.inner_diameter**2)


def second_moment(section: ShaftSection) -> float:
    """Return the second moment of area I [m^4]; the polar moment is 2 I."""
    return pi / 64 * (section.outer_diameter**4 - section.inner_diameter**4)


def _bearing_share(z: FloatArray, first: float, second: float) -> FloatArray:
    """Return the loads on the bearings under unit nodal forces and moments, by statics."""
    lever, turn = (z - first) / (second - first), np.full(z.size, 1.0 / (second - first))
    return np.array([np.concatenate([1.0 - lever, -turn]), np.concatenate([lever, turn])])


def _flexibility(
    shaft: Shaft, z: FloatArray, elements: list[ShaftSection], share: FloatArray, bearings: list[float]
) -> FloatArray:
    """Return the flexibility as the product G^T G.

    Three rows of G belong to each element: one for the strain energy of the mean bending moment, one for the strain
    energy of the slope of the bending moment, and one for the strain energy of the shear force.
    """
    nodes = z.size
    forces = np.hstack([np.eye(nodes), np.zeros((nodes, nodes))])
    for bearing, load in zip(bearings, share, strict=True):
        forces[int(np.argmin(np.abs(z - bearing)))] -= load
    moments = np.hstack([np.zeros((nodes, nodes)), np.eye(nodes)])
    lengths = np.diff(z)[:, None]
    shear = np.cumsum(forces, axis=0)[:-1]
    rise = shear * lengths
    middle = np.cumsum(rise, axis=0) - rise / 2 - np.cumsum(moments, axis=0)[:-1]
    bending = shaft.youngs_modulus * np.array([second_moment(part) for part in elements])[:, None]
    modulus = shaft.youngs_modulus / (2 * (1 + shaft.poisson_ratio))
    shearing = [
        modulus * area(part) * shear_coefficient(shaft.poisson_ratio, part.inner_diameter / part.outer_diameter)
        for part in elements
    ]
    per_moment = np.sqrt(lengths / bending)
    root = np.vstack(
        [
            per_moment * middle,
            per_moment * rise / sqrt(12.0),
            np.sqrt(lengths / np.array(shearing)[:, None]) * shear,
        ]
    )
    return np.asarray(root.T @ root)


def _torsion(shaft: Shaft, z: FloatArray, elements: list[ShaftSection], torque_position: float) -> FloatArray:
    """Return the matrix (N, N) of the twist at node i per torque at node j.

    If both nodes lie on the same side of the torque input, the element (i, j) is the twist of the shaft between the
    torque input and the nearer node. If the nodes lie on different sides, the element is 0.
    """
    modulus = shaft.youngs_modulus / (2 * (1 + shaft.poisson_ratio))
    twist = np.diff(z) / (2 * modulus * np.array([second_moment(part) for part in elements]))
    path = np.append(0.0, np.cumsum(twist))
    path -= path[int(np.argmin(np.abs(z - torque_position)))]
    shared = np.minimum(np.abs(path[:, None]), np.abs(path[None, :]))
    return np.where(path[:, None] * path[None, :] > 0.0, shared, 0.0)


def _weight(shaft: Shaft, z: FloatArray, elements: list[ShaftSection]) -> FloatArray:
    """Return the consistent nodal loads of the weight.

    An element of length L has the weight q per unit length. The force q L / 2 acts at both ends of the element. The
    moment is q L^2 / 12 at the start of the element and -q L^2 / 12 at the end.
    """
    lengths = np.diff(z)
    load = GRAVITY * shaft.density * np.array([area(part) for part in elements]) * lengths
    forces, moments = np.zeros(z.size), np.zeros(z.size)
    for start, sign in ((0, 1.0), (1, -1.0)):
        forces[start : start + lengths.size] += load / 2
        moments[start : start + lengths.size] += sign * load * lengths / 12
    return np.concatenate([forces, moments])
