"""The unit's frame of reference: where the mesh force acts on both shafts, and in which direction."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import Arrangement
from solvers.gears.pair import PathOfContact

Z_AXIS = np.array([0.0, 0.0, 1.0])  # along the shafts


@dataclass(frozen=True, slots=True)
class Frame:
    """Directions and lever arms in X, Y, Z.

    `rotation` is +1 if the pinion turns counter-clockwise about Z, else -1. The face coordinate y begins at the end
    that meshes first; `face_direction` is +1 if y runs along +Z, else -1. `radial` points from pinion to wheel.
    `transverse_force` points in the direction of the transverse force on the pinion. `force` is the vector of the total
    force on the pinion, divided by the transverse force. `arms` point from the axes of pinion and wheel to the pitch
    point [m]. `down` (X, Y) points in the direction of gravity.
    """

    rotation: float
    face_direction: float
    radial: FloatArray
    transverse_force: FloatArray
    force: FloatArray
    arms: tuple[FloatArray, FloatArray]
    down: FloatArray

    def shaft_rotation(self, shaft: int) -> float:
        """Return the sense of rotation of the shaft of the pinion (0) or the wheel (1)."""
        return self.rotation if shaft == 0 else -self.rotation

    def positions(self, face_start: float, face_width: float, y: FloatArray) -> FloatArray:
        """Return the positions Z [m] of points on the face at distances y [m] from the end that meshes first."""
        return face_start + y if self.face_direction > 0.0 else face_start + (face_width - y)


def frame(arrangement: Arrangement, path: PathOfContact) -> Frame:
    """Compute the frame of reference of a unit.

    Parameters
    ----------
    arrangement : Arrangement
        Position and rotation of the unit.
    path : PathOfContact
        Path of contact of the gear pair of the unit.

    Returns
    -------
    Frame
        Directions [-] and lever arms [m].

    Notes
    -----
    Eq. D1. sigma is the sense of rotation, and e_r points from pinion to wheel. e_t = sigma Z x e_r is the direction of
    the pinion's velocity at the pitch point C. The flank force on the pinion opposes this velocity:
    n_t = -(cos a_wt e_t + sin a_wt e_r). A helix adds the component -tan beta_b along y. The direction of y is
    -sigma h Z, where h is +1 for a right-hand pinion and -1 for a left-hand pinion. A spur pair meshes over the whole
    face at once; for a spur pair h is always +1.
    """
    pair = path.pair
    rotation = 1.0 if arrangement.rotation == "counterclockwise" else -1.0
    hand = -1.0 if arrangement.hand == "left" and path.plane.tan_base_helix > 0.0 else 1.0
    radial = np.array([cos(arrangement.wheel_angle), sin(arrangement.wheel_angle), 0.0])
    tangential = rotation * np.cross(Z_AXIS, radial)
    angle = pair.working_pressure_angle
    transverse_force = -(cos(angle) * tangential + sin(angle) * radial)
    face_direction = -rotation * hand
    return Frame(
        rotation=rotation,
        face_direction=face_direction,
        radial=radial,
        transverse_force=transverse_force,
        force=transverse_force - path.plane.tan_base_helix * face_direction * Z_AXIS,
        arms=(pair.pinion_working_radius * radial, -pair.wheel_working_radius * radial),
        down=np.array([cos(arrangement.gravity_angle), sin(arrangement.gravity_angle)]),
    )
