"""Method B of ISO/TR 15144-1: the film at seven points of the path, for a spur pair without relief.

The load is uniform over the face.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import maximum_pressure, reduced_modulus
from solvers.gears.pair import PathOfContact, reduced_radius
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply
from solvers.scuffing.micropitting.film import Conditions, Contacts, Films, films
from solvers.scuffing.micropitting.mean_values import bulk_temperature, loss_factor, mean_friction
from solvers.scuffing.micropitting.results import PointName

BEST_GRADE = 7  # better quality grades have the load sharing of this grade


@dataclass(frozen=True, slots=True)
class StandardFilms:
    """Results of method B: values of the whole pair, and values at the points of the path.

    The coefficient of friction, the bulk temperature `bulk` [K] and the loss factor belong to the whole pair. The load
    sharing factors X (`force_ratio`), the contacts and the films belong to the points.
    """

    friction: float
    bulk: float
    loss_factor: float
    force_ratio: FloatArray
    contacts: Contacts
    films: Films


def characteristic_points(path: PathOfContact) -> dict[PointName, float]:
    """Return the distances [m] from A of the points A, AB, B, C, D, DE and E of the path.

    If the transverse contact ratio is not from 1 to 2, only A, C and E are returned.
    """
    length, pitch = path.length, path.plane.base_pitch
    at_pitch = path.pitch_point - path.start
    if not has_single_contact(path):
        return {"A": 0.0, "C": at_pitch, "E": length}
    inner, outer = length - pitch, pitch
    return {"A": 0.0, "AB": inner / 2, "B": inner, "C": at_pitch, "D": outer, "DE": (outer + length) / 2, "E": length}


def has_single_contact(path: PathOfContact) -> bool:
    """Return True if the transverse contact ratio is from 1 to 2."""
    return 1.0 <= path.transverse_contact_ratio <= 2.0


def has_relief(given: LoadDistributionInputs) -> bool:
    """Return True if the pair has tip relief or root relief."""
    return given.modifications.tip_relief > 0.0 or given.modifications.root_relief > 0.0


def has_standard_film(given: LoadDistributionInputs, path: PathOfContact) -> bool:
    """Return True if method B can be used for the pair.

    Method B needs a spur pair without relief and with a transverse contact ratio from 1 to 2. No point of the path may
    be too near a base circle.
    """
    plane = path.plane
    ends = reduced_radius(plane, np.array([0.0, path.length]))
    unmodified_spur = plane.tan_base_helix == 0.0 and not has_relief(given)
    return unmodified_spur and has_single_contact(path) and bool(np.all(ends >= plane.least_radius))


def load_sharing(path: PathOfContact, x: FloatArray, quality_grade: int) -> FloatArray:
    """Compute the load sharing factor of unmodified spur gears [-].

    Eq. M12 of the chapter on micropitting; formulas 46 to 48 of ISO/TR 15144-1.
    """
    inner, outer = path.length - path.plane.base_pitch, path.plane.base_pitch
    outside = np.maximum(inner - x, x - outer)  # distance outside the stretch with one pair in contact; negative inside
    if inner <= 0.0:
        return np.ones(x.shape)
    base = (max(quality_grade, BEST_GRADE) - 2) / 15
    return np.where(outside > 0.0, base + (inner - outside) / (3 * inner), 1.0)


def solve_standard(
    given: LoadDistributionInputs,
    path: PathOfContact,
    oil: OilSheet | Lubricant,
    oil_temperature: float,
    supply: OilSupply,
    quality_grade: int,
) -> StandardFilms:
    """Compute the film of a spur pair without relief at the seven points of the path."""
    friction = mean_friction(given, path, oil, oil_temperature, 1.0)
    bulk = bulk_temperature(given, path, oil_temperature, supply, friction)
    x = np.array([*characteristic_points(path).values()])
    sharing = load_sharing(path, x, quality_grade)
    contacts = contacts_under(given, path, x, sharing)
    conditions = Conditions(oil, bulk, friction, given.pinion_material, given.wheel_material)
    return StandardFilms(friction, bulk, loss_factor(path), sharing, contacts, films(conditions, contacts))


def contacts_under(given: LoadDistributionInputs, path: PathOfContact, x: FloatArray, sharing: FloatArray) -> Contacts:
    """Return the contacts of a spur pair under given shares of the tooth force.

    Eq. M13 of the chapter on micropitting; formulas 24 and 25 of ISO/TR 15144-1.
    """
    load = sharing * given.load.contact_torque / (path.pair.pinion.base_radius * given.gears.face_width)
    radius = reduced_radius(path.plane, x)
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    return Contacts(maximum_pressure(load, radius, modulus), radius, *path.surface_speeds(x, given.load.pinion_speed))
