"""Method A of ISO/TR 15144-1: the film over the whole flank under the computed load distribution."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import maximum_pressure
from solvers.scuffing.contact_slices import Peak, reaches_base_circle
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.micropitting.film import Conditions, Contacts, films
from solvers.scuffing.micropitting.mean_values import mean_friction
from solvers.scuffing.results import ContactPoints, LoadDistribution
from solvers.scuffing.thermal.flank import (
    FaceFunction,
    FlashMap,
    contact_at_points,
    contacts_under_load,
    find_largest,
    on_diagonals,
)

LEAST = 1e-9  # film ratio; smaller film ratios are treated as equal to this value


@dataclass(frozen=True, slots=True)
class FlankFilm:
    """Values from which the film ratio at any point of the flank is computed.

    `bulk` is a function that returns the bulk temperature along the face. If `bulk` is None, the bulk temperature of
    `conditions` is used everywhere. The oil enters the contact at the bulk temperature.
    """

    inputs: ScuffingInputs
    distribution: LoadDistribution
    conditions: Conditions
    bulk: FaceFunction | None

    def ratio(self, points: ContactPoints, y: FloatArray) -> FloatArray:
        """Compute the film ratio at points of the flank; NaN at points where the flanks do not touch."""
        touching = points.in_contact
        conditions = self.conditions
        if self.bulk is not None:
            conditions = replace(conditions, bulk=self.bulk(np.broadcast_to(y, touching.shape)[touching]))
        ratio = np.full(touching.shape, np.nan)
        ratio[touching] = films(conditions, contacts_of(points, conditions.modulus)).ratio
        return ratio

    def at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Compute the film ratio at points x, y [m] of the flank; x and y are arrays of one shape."""
        return self.ratio(contact_at_points(self.inputs.distribution, self.distribution, x, y), y)

    def over(self, grid: FlashMap) -> FloatArray:
        """Compute the film ratio at the points of the grid."""
        x = np.broadcast_to(grid.x[:, None], grid.load.shape)
        return self.ratio(contacts_under_load(self.inputs.distribution, self.distribution, x, grid.load), grid.y)


def contacts_of(points: ContactPoints, modulus: float) -> Contacts:
    """Return the contacts at the points where the flanks touch; `modulus` is the reduced modulus E' [Pa]."""
    touching = points.in_contact
    load, radius, pinion_speed, wheel_speed = (
        values[touching] for values in (points.line_load, points.radius, points.pinion_speed, points.wheel_speed)
    )
    return Contacts(maximum_pressure(load, radius, modulus), radius, pinion_speed, wheel_speed)


def flank_film(
    inputs: ScuffingInputs, distribution: LoadDistribution, bulk: FaceFunction | None = None
) -> FlankFilm | None:
    """Collect the values for the film of a flank; return None if oil, bulk temperature, load or speed is missing."""
    given, temperatures, oil = inputs.distribution, inputs.temperatures, inputs.known_oil
    if oil is None or temperatures.bulk is None or distribution.balance.force == 0.0 or given.load.pinion_speed == 0.0:
        return None
    friction = given.friction_coefficient
    if inputs.friction != "given" or friction is None:
        torque = (distribution.load.face_load_factor or 1.0) * given.load.contact_torque
        by_law = mean_friction(given, distribution.path_of_contact, oil, temperatures.oil, torque)
        friction = inputs.friction_factor * by_law
    conditions = Conditions(oil, temperatures.bulk, friction, given.pinion_material, given.wheel_material)
    return FlankFilm(inputs, distribution, conditions, bulk)


def find_least(flank: FlankFilm, grid: FlashMap, ratio: FloatArray) -> Peak | None:
    """Find the least film ratio over the flank.

    Returns least ratio and its place [m]; None if the flanks touch nowhere, or if the loaded path reaches a base
    circle.
    """
    if np.isnan(ratio).all() or reaches_base_circle(flank.distribution.balance.survey):
        return None

    def thinness(x: FloatArray, y: FloatArray) -> FloatArray:
        return _thinness(flank.at(x, y))

    peak = find_largest(grid, _thinness(ratio), thinness)
    peak = on_diagonals(flank.distribution, peak, thinness)
    return Peak(float(flank.at(np.array([peak.x]), np.array([peak.y]))[0]), peak.x, peak.y)


def _thinness(ratio: FloatArray) -> FloatArray:
    return np.where(np.isnan(ratio), 0.0, 1.0 / np.fmax(ratio, LEAST))
