"""The unit's frame of reference: where the mesh force acts on both shafts, and in which direction."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import Arrangement
from solvers.gears.pair import PathOfContact

Z_AXIS = np.array([0.0, 0.0, 1.0])  # along the shafts


@dataclass(frozen=True, slots=True)
class Face:
    """The common face of a single-helical pair, or of one helix of a double-helical pair."""

    start: float  # Z of its lower end, m
    width: float  # m
    direction: float  # +1 if y, which begins at the end that meshes first, runs along +Z; else -1
    hand: float  # of the pinion's helix: +1 right, -1 left
    force: FloatArray  # total force on the pinion over the transverse force (X, Y, Z)

    def positions(self, y: FloatArray) -> FloatArray:
        """Return the positions Z [m] of points at distances y [m] from the end that meshes first."""
        return self.start + y if self.direction > 0.0 else self.start + (self.width - y)


@dataclass(frozen=True, slots=True)
class Frame:
    """Directions and lever arms in X, Y, Z, and the faces in the order of Z."""

    rotation: float  # +1 if the pinion turns counter-clockwise about Z, else -1
    faces: tuple[Face, ...]
    radial: FloatArray  # from pinion to wheel
    transverse_force: FloatArray  # direction of the transverse force on the pinion
    arms: tuple[FloatArray, FloatArray]  # from the axes of pinion and wheel to the pitch point, m
    down: FloatArray  # direction of gravity (X, Y)

    def shaft_rotation(self, shaft: int) -> float:
        """Return the sense of rotation of the shaft of the pinion (0) or the wheel (1)."""
        return self.rotation if shaft == 0 else -self.rotation


def frame(arrangement: Arrangement, path: PathOfContact, face_start: float) -> Frame:
    """Frame of reference of a unit whose face, or first helix, begins at Z = `face_start` [m] (Eq. D1).

    sigma is the sense of rotation, e_r points from pinion to wheel, and e_t = sigma Z x e_r is the direction of the
    pinion's velocity at the pitch point C. The flank force on the pinion opposes it:
    n_t = -(cos a_wt e_t + sin a_wt e_r). A helix adds -tan beta_b along y, which points along -sigma h Z; h is +1 for a
    right-hand pinion and for a spur pair, which meshes over the whole face at once, else -1. The second helix of a
    double-helical pair has the other hand.
    """
    pair = path.pair
    rotation = 1.0 if arrangement.rotation == "counterclockwise" else -1.0
    hand = -1.0 if arrangement.hand == "left" and path.plane.tan_base_helix > 0.0 else 1.0
    radial = np.array([cos(arrangement.wheel_angle), sin(arrangement.wheel_angle), 0.0])
    tangential = rotation * np.cross(Z_AXIS, radial)
    angle = pair.working_pressure_angle
    transverse_force = -(cos(angle) * tangential + sin(angle) * radial)
    width = path.plane.face_width
    faces = []
    for helix in range(pair.inputs.helices):
        own = hand if helix == 0 else -hand
        direction = -rotation * own
        faces.append(
            Face(
                start=face_start + helix * (width + (pair.inputs.gap_width or 0.0)),
                width=width,
                direction=direction,
                hand=own,
                force=transverse_force - path.plane.tan_base_helix * direction * Z_AXIS,
            )
        )
    return Frame(
        rotation=rotation,
        faces=tuple(faces),
        radial=radial,
        transverse_force=transverse_force,
        arms=(pair.pinion_working_radius * radial, -pair.wheel_working_radius * radial),
        down=np.array([cos(arrangement.gravity_angle), sin(arrangement.gravity_angle)]),
    )
