"""The crowned hub tooth: its pitch radius and the radii of its flank."""

from math import sin, tan

from solvers.coupling.inputs import Coupling
from solvers.coupling.results import Geometry


def pitch_radius(coupling: Coupling) -> float:
    """r_o = m z/2 [m]."""
    return coupling.module * coupling.teeth / 2.0


def tooth_geometry(coupling: Coupling) -> Geometry:
    """Pitch, crowning and flank radii [m] (Eq. C1).

    A cutter centre moving on the crowning radius r_b feeds radially by zeta^2/(2 r_b) at the axial distance zeta.
    The flank recedes by that times tan(alpha) tangentially and times sin(alpha) along its normal, hence the flank
    radii r_b/tan(alpha) in the tangential plane and r_b/sin(alpha) in the plane of action, Pahl's "pressure line
    radius" R_e.
    """
    radius = pitch_radius(coupling)
    crowning_radius = coupling.crowning_ratio * radius
    return Geometry(
        pitch_radius=radius,
        crowning_radius=crowning_radius,
        tangential_flank_radius=crowning_radius / tan(coupling.pressure_angle),
        normal_flank_radius=crowning_radius / sin(coupling.pressure_angle),
    )
