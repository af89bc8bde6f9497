"""Two gear pairs from standards: FZG type A (ISO 14635-1), and example 1 of ISO/TR 6336-30."""

from math import radians

from solvers.contact import hertz
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import meshing_path, reduced_radius
from solvers.materials import Solid
from solvers.scuffing.mesh_results import standard_stiffness

# The tip diameters of ISO 14635-1 are 88.8 and 112.5 mm.
FZG_A = GearPairInputs(
    GearTeeth(16, 0.8532, addendum=88.8 / 9 - 8 - 0.8532),
    GearTeeth(24, -0.5, addendum=112.5 / 9 - 12 + 0.5),
    4.5e-3,
    20e-3,
    rack_tip_radius=0.38,
)
# ISO/TR 6336-30, example 1, with rack A of ISO 53
EXAMPLE_1 = GearPairInputs(
    GearTeeth(17, 0.145, dedendum=1.4),
    GearTeeth(103, 0.0, dedendum=1.4),
    8e-3,
    0.1,
    helix_angle=radians(15.8),
    centre_distance=0.5,
    rack_tip_radius=0.38,
)


def fzg_pressure(torque: float) -> float:
    """Return the Hertzian pressure [MPa] at the pitch point of FZG type A gears. `torque` is the pinion torque [N m].

    At the pitch point, one tooth pair carries the whole load.
    """
    path = meshing_path(FZG_A)
    return _pitch_pressure(FZG_A, torque / path.pair.pinion.base_radius / path.plane.cos_base_helix / 20e-3)


def example_stress() -> float:
    """Return the nominal contact stress [MPa] of example 1, divided by the helix factor.

    The torque is 9 kN m. The line load is the load per face width, divided by the transverse contact ratio.
    """
    path = meshing_path(EXAMPLE_1)
    return _pitch_pressure(EXAMPLE_1, 9000 / path.pair.pinion.base_radius / (0.1 * path.transverse_contact_ratio))


def example_stiffness() -> float:
    """Return the theoretical single stiffness [N/(mm um)] of the gears in example 1."""
    return standard_stiffness(meshing_path(EXAMPLE_1)).theoretical * 1e-9


def _pitch_pressure(gears: GearPairInputs, line_load: float) -> float:
    path = meshing_path(gears)
    radius = float(reduced_radius(path.plane, path.pitch_point - path.start))
    return float(hertz.maximum_pressure(line_load, radius, hertz.reduced_modulus(Solid(), Solid()))) * 1e-6
