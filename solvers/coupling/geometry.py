"""The crowned hub tooth: radii of its flank."""

from math import sin, tan

from solvers.coupling.inputs import Coupling
from solvers.coupling.results import Geometry


def tooth_geometry(coupling: Coupling) -> Geometry:
    """Pitch, crowning and flank radii [m].

    A cutter centre moving on the crowning radius r_b feeds radially by zeta^2/(2 r_b) at the axial distance zeta.
    The flank recedes by that times tan(alpha) tangentially and times sin(alpha) along its normal, hence the flank
    radii r_b/tan(alpha) in the tangential plane and r_b/sin(alpha) in the plane of action, Pahl's "pressure line
    radius" R_e.
    """
    pitch_radius = coupling.module * coupling.teeth / 2.0
    crowning_radius = coupling.crowning_ratio * pitch_radius
    return Geometry(
        pitch_radius=pitch_radius,
        crowning_radius=crowning_radius,
        tangential_flank_radius=crowning_radius / tan(coupling.pressure_angle),
        normal_flank_radius=crowning_radius / sin(coupling.pressure_angle),
    )
