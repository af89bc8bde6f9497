"""Method B of ISO/TR 15144-1: the film at seven points of the path, for a pair without relief."""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import maximum_pressure, reduced_modulus
from solvers.gears.pair import PathOfContact, reduced_radius
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply
from solvers.scuffing.mesh_results import buttressing, spur_load_sharing
from solvers.scuffing.micropitting.film import Conditions, Contacts, Films, films
from solvers.scuffing.micropitting.mean_values import bulk_temperature, loss_factor, mean_friction
from solvers.scuffing.micropitting.results import PointName


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

    If the transverse contact ratio is not from 1 to 2, only A, C and E are returned; C only if it lies on the path.
    """
    length, pitch = path.length, path.plane.base_pitch
    inner, outer = length - pitch, pitch
    places: dict[PointName, float] = {"A": 0.0, "AB": inner / 2, "B": inner, "C": path.pitch_point - path.start}
    places |= {"D": outer, "DE": (outer + length) / 2, "E": length}
    left_out: set[str] = set() if has_single_contact(path) else {"AB", "B", "D", "DE"}
    if not 0.0 <= places["C"] <= length:
        left_out.add("C")
    return {name: place for name, place in places.items() if name not in left_out}


def has_single_contact(path: PathOfContact) -> bool:
    """Return True if the transverse contact ratio is from 1 to 2."""
    return 1.0 <= path.transverse_contact_ratio <= 2.0


def has_relief(given: LoadDistributionInputs) -> bool:
    """Return True if the pair has tip relief or root relief."""
    return given.modifications.tip_relief > 0.0 or given.modifications.root_relief > 0.0


def has_standard_film(given: LoadDistributionInputs, path: PathOfContact) -> bool:
    """Return True if method B can be used for the pair.

    Method B needs a pair without relief and with a transverse contact ratio from 1 to 2. No point of the path may be
    too near a base circle.
    """
    plane = path.plane
    ends = reduced_radius(plane, np.array([0.0, path.length]))
    return not has_relief(given) and has_single_contact(path) and bool(np.all(ends >= plane.least_radius))


def load_sharing(path: PathOfContact, x: FloatArray, quality_grade: int) -> FloatArray:
    """Load sharing factor X of unmodified gears at x [m] from A [-] (Eq. M16).

    Spur gears by the grade; X_but/eps_alpha from the overlap ratio 1 on, linear between, as public programs do.
    """
    overlap = min(path.overlap_ratio, 1.0)
    shared = buttressing(path, x, 1.0) / path.transverse_contact_ratio
    return (1.0 - overlap) * spur_load_sharing(path, x, quality_grade) + overlap * shared


def solve_standard(
    given: LoadDistributionInputs,
    path: PathOfContact,
    oil: OilSheet | Lubricant,
    oil_temperature: float,
    supply: OilSupply,
    quality_grade: int,
    torque: float,
    contact_torque: float | None = None,
) -> StandardFilms:
    """Compute the film of a pair without relief at the seven points of the path.

    `torque` is the pinion torque times all load factors [N m], `contact_torque` that of the pressure if it has others
    than the friction; the bulk temperature follows from the plain power.
    """
    friction = mean_friction(given, path, oil, oil_temperature, torque)
    bulk = bulk_temperature(given, path, oil_temperature, supply, friction)
    x = np.array([*characteristic_points(path).values()])
    sharing = load_sharing(path, x, quality_grade)
    contacts = contacts_under(given, path, x, sharing, torque if contact_torque is None else contact_torque)
    conditions = Conditions(oil, bulk, friction, given.pinion_material, given.wheel_material)
    return StandardFilms(friction, bulk, loss_factor(path), sharing, contacts, films(conditions, contacts))


def contacts_under(
    given: LoadDistributionInputs, path: PathOfContact, x: FloatArray, sharing: FloatArray, torque: float
) -> Contacts:
    """Return the contacts under given shares of the tooth force, which `torque` [N m] makes with all load factors.

    Eq. M13 of the chapter on micropitting; formulas 24 and 25 of ISO/TR 15144-1.
    """
    force = torque / (path.pair.pinion.base_radius * path.plane.cos_base_helix)
    load = sharing * force / given.gears.face_width
    radius = reduced_radius(path.plane, x)
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    return Contacts(maximum_pressure(load, radius, modulus), radius, *path.surface_speeds(x, given.load.pinion_speed))
