"""What describes a gear pair."""

from dataclasses import dataclass
from math import atan, cos, radians, tan


@dataclass(frozen=True, slots=True)
class GearTeeth:
    """One gear's teeth; every coefficient counts normal modules."""

    teeth: int
    profile_shift: float = 0.0
    addendum: float = 1.0
    dedendum: float = 1.25


@dataclass(frozen=True, slots=True)
class GearPairInputs:
    """An external parallel-axis pair; the pinion drives.

    Units: normal_module, face_width, centre_distance [m]; normal_pressure_angle and helix_angle [rad] at the
    reference circle; rack_tip_radius counts normal modules. centre_distance None is the backlash-free value.
    """

    pinion: GearTeeth
    wheel: GearTeeth
    normal_module: float
    face_width: float
    normal_pressure_angle: float = radians(20.0)
    helix_angle: float = 0.0
    centre_distance: float | None = None
    rack_tip_radius: float = 0.25


def normal_section(
    transverse_module: float, transverse_pressure_angle: float, helix_angle: float
) -> tuple[float, float]:
    """Normal module [m] and normal pressure angle [rad] of a rack given in its transverse plane."""
    return transverse_module * cos(helix_angle), atan(tan(transverse_pressure_angle) * cos(helix_angle))
