"""Compute one mesh of a gear coupling from its equations in plain numpy, without the code of the solver.

The tooth angle phi is measured from the pivot position. The tilt positions are at 90 and 270 degrees.
"""

from dataclasses import dataclass
from math import cos, pi, sin, tan

import numpy as np

from solvers.arrays import FloatArray
from solvers.coupling.inputs import CouplingInputs


@dataclass(frozen=True)
class PlainMesh:
    """This mesh has a centred sleeve.

    `side` is +1 if the hub drives the sleeve, and -1 if the sleeve drives the hub. `tilt` is +1 or -1, and multiplies
    the misalignment.
    """

    inputs: CouplingInputs
    side: int = 1
    tilt: int = 1

    @property
    def radius(self) -> float:
        return self.inputs.coupling.teeth * self.inputs.coupling.module / 2.0

    @property
    def delta(self) -> float:
        return self.tilt * self.inputs.operation.misalignment

    def angles(self, rotor: FloatArray) -> FloatArray:
        """Return the tooth angles [rad] in the shape (rotor angles, teeth)."""
        teeth = self.inputs.coupling.teeth
        angles: FloatArray = np.asarray(rotor)[:, None] + 2.0 * pi / teeth * np.arange(teeth)
        return angles

    def ahead(self, phi: FloatArray) -> FloatArray:
        """Return the lead of each tooth [m]: the sum of its tangential displacement and its pitch deviation."""
        coupling, alpha = self.inputs.coupling, self.inputs.coupling.pressure_angle
        ratio, scale = coupling.crowning_ratio, self.radius * self.delta**2 / 2.0
        if self.inputs.model.kinematics == "tangential":
            displacement = scale * ratio / tan(alpha) * np.sin(phi) ** 2
        else:
            turned = phi if self.side == 1 else pi - phi
            early = np.sin(turned - alpha)
            displacement = scale / cos(alpha) * early * (ratio * early / sin(alpha) + np.cos(turned))
        errors = np.zeros(coupling.teeth) if coupling.pitch_errors is None else np.array(coupling.pitch_errors)
        ahead: FloatArray = displacement + errors
        return ahead

    def normals(self, phi: FloatArray) -> FloatArray:
        """Return the lateral force of each tooth, divided by its tangential force. The first axis is x and y."""
        radial, side = tan(self.inputs.coupling.pressure_angle), self.side
        return np.stack((radial * np.cos(phi) - side * np.sin(phi), radial * np.sin(phi) + side * np.cos(phi)))

    def sliding(self, phi: FloatArray) -> FloatArray:
        """Return the axial velocity [m/s] that the tilt gives each tooth of the hub relative to the sleeve."""
        sliding: FloatArray = self.delta * self.inputs.operation.speed * self.radius * np.sin(phi)
        return sliding

    def forces(self, phi: FloatArray) -> FloatArray:
        """Return the tangential tooth forces [N], which together transmit the torque."""
        # The teeth with the largest lead carry the load. As many teeth carry as the torque requires.
        stiffness, ahead = self.inputs.coupling.tooth_stiffness, self.ahead(phi)
        needed = self.inputs.operation.torque / self.radius / stiffness
        first = np.sort(ahead, axis=1)[:, ::-1]
        count = np.arange(1, first.shape[1] + 1)
        rotation = (needed - np.cumsum(first, axis=1)) / count
        carrying = (rotation + first > 0.0).sum(axis=1)
        forces: FloatArray = stiffness * np.maximum(
            0.0, rotation[np.arange(len(rotation)), carrying - 1][:, None] + ahead
        )
        return forces

    def friction(self, rotor: FloatArray, coefficient: float) -> tuple[float, float, float]:
        """Return the axial force [N], the moment against the tilt [N m] and the power [W] of the friction.

        All three values are means over the rotor angles.
        """
        phi = self.angles(rotor)
        velocity = self.inputs.operation.axial_velocity + self.sliding(phi)
        held = coefficient / cos(self.inputs.coupling.pressure_angle) * self.forces(phi) / len(rotor)
        sense = np.sign(self.delta * self.inputs.operation.speed)
        moment = sense * self.radius * (held * np.sign(velocity) * np.sin(phi)).sum()
        return float((held * np.sign(velocity)).sum()), float(moment), float((held * np.abs(velocity)).sum())


def midpoints(rows: int, turn: float) -> FloatArray:
    """Divide the angle `turn` [rad] into `rows` equal parts, and return the midpoints of the parts."""
    return (np.arange(rows) + 0.5) / rows * turn
