"""Mean coefficient of friction, loss factor and bulk temperature of a mesh."""

from math import cos, pi, sqrt

from solvers.gears.pair import PathOfContact, reduced_radius
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply
from solvers.scuffing.micropitting.oil import viscosity
from solvers.scuffing.thermal.practice import OIL_KIND_FACTOR, OIL_SUPPLY_FACTOR

MM = 1e-3  # m


def helical_load_factor(total_contact_ratio: float) -> float:
    """Helical load factor on the line load of the mean coefficient of friction [-] (Eq. M8).

    Formulas 88 to 90 of ISO/TR 15144-1.
    """
    if total_contact_ratio <= 2.0:
        return 1.0
    if total_contact_ratio >= 3.5:
        return 1.3
    return 1.0 + 0.2 * sqrt((total_contact_ratio - 2.0) * (5.0 - total_contact_ratio))


def mean_friction(
    given: LoadDistributionInputs,
    path: PathOfContact,
    oil: OilSheet | Lubricant,
    oil_temperature: float,
    torque: float,
) -> float:
    """Compute the mean coefficient of friction of a mesh [-]. Eq. M9 of the chapter on micropitting.

    `torque` [N m] is the pinion torque times all load factors.
    """
    at_pitch = path.pitch_point - path.start
    radius = reduced_radius(path.plane, at_pitch) / MM
    speed = sum(path.surface_speeds(at_pitch, given.load.pinion_speed))
    force = torque / path.pair.pinion.base_radius  # F_bt times the load factors
    line_load = force * helical_load_factor(path.total_contact_ratio) * MM / given.gears.face_width
    rough = (given.pinion_material.roughness + given.wheel_material.roughness) / 2 * 1e6
    roughness_factor = 2.2 * (rough / radius) ** 0.25
    thickness = (1e3 * viscosity(oil, oil_temperature)) ** -0.05
    factors = roughness_factor * OIL_KIND_FACTOR[oil.kind]
    return float(0.045 * (line_load / (speed * radius)) ** 0.2 * thickness * factors)


def loss_factor(path: PathOfContact) -> float:
    """Compute the loss factor of a mesh [-]. Eq. M10 of the chapter on micropitting; formula 91 of ISO/TR 15144-1."""
    pair, pitch = path.pair, path.plane.base_pitch
    approach, recess = (path.pitch_point - path.start) / pitch, (path.end - path.pitch_point) / pitch
    sliding = approach**2 + recess**2 + 1.0 - path.transverse_contact_ratio
    return sliding * (1 / pair.pinion.teeth + 1 / pair.wheel.teeth) * pi / cos(pair.base_helix_angle)


def bulk_temperature(
    given: LoadDistributionInputs, path: PathOfContact, oil_temperature: float, supply: OilSupply, friction: float
) -> float:
    """Compute the bulk temperature from the friction loss of the mesh, for a pair without tip relief [K].

    Eq. M11 of the chapter on micropitting; formula 84 of ISO/TR 15144-1. `given`: the pair and its load; only the
    transmitted power is used.
    """
    power = given.load.helix_share * given.load.transmitted_power * 1e-3
    area = path.pair.centre_distance * given.gears.face_width / MM**2
    rise = 7400.0 * (power * friction * loss_factor(path) / area) ** 0.72
    return float(oil_temperature + rise * OIL_SUPPLY_FACTOR[supply] / 1.2)
