"""Scuffing over the whole flank: with the load at one end the hottest point lies in a corner, off the feature line."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import reduced_modulus
from solvers.drive_train.gap.thermal_lead import ThermalLead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import FlashPlaces, TrainSafety
from solvers.notices import Notice
from solvers.scuffing.flank_results import contact_points
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.results import ContactPoints, LoadDistribution, Place
from solvers.scuffing.safety import SURVEY_POINTS, safety_factor
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.thermal_path import thermal_path
from solvers.scuffing.thermal.verdict import unknown_points


@dataclass(frozen=True, slots=True)
class FlankHeat:
    """Blok's contact temperature over the flank [profile, face] [K], and what follows from its maxima."""

    temperature: FloatArray
    flash: FlashPlaces
    safety: TrainSafety | None
    unsolved_points: int
    warnings: tuple[Notice, ...]


def contact_of(inputs: DriveTrainInputs) -> ScuffingInputs:
    """The mesh with its bulk temperature: where it is given and no number, the mean of the tooth temperatures."""
    temperatures = inputs.mesh.temperatures
    if temperatures.bulk is not None or temperatures.bulk_method == "estimated":
        return inputs.mesh
    mean = (inputs.heat.pinion_bulk + inputs.heat.wheel_bulk) / 2
    return replace(inputs.mesh, temperatures=replace(temperatures, bulk=mean))


def flank_heat(inputs: DriveTrainInputs, mesh: LoadDistribution, thermal: ThermalLead) -> FlankHeat:
    """Flash temperature on the feature line and over the flank, thermal EHL on the two lines that matter (Eq. D15).

    Loaded next to a base circle neither has a largest value; without an oil there is no contact temperature.
    """
    plane = mesh.path_of_contact.plane
    x, y = np.meshgrid(
        mesh.flank.profile_fraction * plane.path_length, mesh.flank.face_fraction * plane.face_width, indexing="ij"
    )
    psi = _feature_points(inputs, mesh, thermal)
    along, across = psi * plane.path_length, psi * plane.face_width
    feature = _points(inputs, mesh, along, line_loads(mesh.balance, along, across))
    flank = _points(inputs, mesh, x, mesh.flank.line_load)
    on_feature, on_flank = (blok_flash(inputs.mesh.distribution, points) for points in (feature, flank))
    warm_feature = on_feature + _bulk(inputs, thermal, across)
    warm_flank = on_flank + _bulk(inputs, thermal, y)
    defined = not np.any(mesh.balance.survey.undefined > 0.0)
    known = inputs.mesh.temperatures.bulk is not None
    worst = np.unravel_index(int(np.argmax(warm_flank if known else on_flank)), warm_flank.shape)
    hottest = [_largest(warm) if defined else None for warm in (warm_feature, warm_flank)]
    unsolved, warnings = 0, list[Notice]()
    for line, where in _thermal_lines(inputs, mesh, feature, across, (float(x[worst]), float(y[worst]))):
        found, missing, notices = _thermal(inputs, line, _bulk(inputs, thermal, where))
        hottest.append(found if defined else None)
        unsolved += missing
        warnings += notices
    place = _place(mesh, flank, worst) if defined and (_largest(on_flank) or 0.0) > 0.0 else None
    return FlankHeat(
        temperature=warm_flank,
        flash=FlashPlaces(
            feature=_largest(on_feature) if defined else None,
            flank=_largest(on_flank) if defined else None,
            flank_at=place,
            contact_max=max((contact for contact in hottest[:2] if contact is not None), default=None),
            friction_coefficient=inputs.mesh.distribution.friction_coefficient,
        ),
        safety=_safety(inputs, hottest, place),
        unsolved_points=unsolved,
        warnings=tuple({notice.code: notice for notice in warnings}.values()),
    )


def _feature_points(inputs: DriveTrainInputs, mesh: LoadDistribution, thermal: ThermalLead) -> FloatArray:
    """Psi of the feature line's points: equidistant, and where flash and contact temperature by Blok are largest.

    Without the latter, the maxima would depend on the number of points.
    """
    plane, psi = mesh.path_of_contact.plane, np.linspace(0.0, 1.0, SURVEY_POINTS)
    along, across = psi * plane.path_length, psi * plane.face_width
    line = _points(inputs, mesh, along, line_loads(mesh.balance, along, across))
    flash = blok_flash(inputs.mesh.distribution, line)
    hottest = [int(np.argmax(flash)), int(np.argmax(flash + _bulk(inputs, thermal, across)))]
    return np.unique([*np.linspace(0.0, 1.0, inputs.mesh.path_points), *psi[hottest]])


def _largest(values: FloatArray) -> float | None:
    """The largest of all; None if one is not known."""
    return None if np.isnan(values).any() else float(values.max())


def _place(mesh: LoadDistribution, flank: ContactPoints, index: tuple[np.intp, ...]) -> Place:
    return Place(
        gamma=float(flank.gamma[index]),
        profile_fraction=float(mesh.flank.profile_fraction[index[0]]),
        face_fraction=float(mesh.flank.face_fraction[index[1]]),
    )


def _thermal_lines(
    inputs: DriveTrainInputs,
    mesh: LoadDistribution,
    feature: ContactPoints,
    across: FloatArray,
    worst: tuple[float, float],
) -> list[tuple[ContactPoints, FloatArray]]:
    """Lines for the thermal film and their y [m]: the feature line, and the profile through the flank's worst point.

    `worst` holds that point's x and y [m].
    """
    if inputs.mesh.lubrication == "closed_form" or inputs.mesh.temperatures.bulk is None:
        return []
    even = np.linspace(0.0, mesh.path_of_contact.plane.path_length, inputs.mesh.path_points)
    profile = np.unique([*even, worst[0]])
    there = np.full(profile.size, worst[1])
    return [(feature, across), (_points(inputs, mesh, profile, line_loads(mesh.balance, profile, there)), there)]


def _points(inputs: DriveTrainInputs, mesh: LoadDistribution, x: FloatArray, load: FloatArray) -> ContactPoints:
    given = inputs.mesh.distribution
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    return contact_points(mesh.path_of_contact, mesh.balance, x, load, given.load.pinion_speed, modulus)


def _bulk(inputs: DriveTrainInputs, thermal: ThermalLead, y: FloatArray) -> FloatArray:
    """Bulk temperature [K] of the contact at y or NaN; with `local_bulk` the members' mean pumping heat is added."""
    temperature = inputs.mesh.temperatures.bulk
    bulk = np.full(y.shape, np.nan if temperature is None else temperature)
    if inputs.local_bulk:
        stations = np.linspace(0.0, inputs.mesh.distribution.gears.face_width, thermal.pinion_rise.size)
        bulk += np.interp(y, stations, (thermal.pinion_rise + thermal.wheel_rise) / 2)
    return bulk


def _thermal(
    inputs: DriveTrainInputs, points: ContactPoints, bulk: FloatArray
) -> tuple[float | None, int, tuple[Notice, ...]]:
    """Hottest flank surface [K] along a line by thermal EHL, None where points not solved may decide; how many are."""
    if not np.any(points.in_contact):
        return None, 0, ()
    path = thermal_path(inputs.mesh, points, points.in_contact)
    unsolved = sum(status in {"no_solution", "refused"} for status in path.status)
    if unknown_points(path, bulk):
        return None, unsolved, path.warnings
    return float(np.nanmax(np.fmax(path.pinion_flash, path.wheel_flash) + bulk)), unsolved, path.warnings


def _safety(inputs: DriveTrainInputs, hottest: list[float | None], worst: Place | None) -> TrainSafety | None:
    temperatures = inputs.mesh.temperatures
    if temperatures.scuffing is None or temperatures.bulk is None:
        return None
    limit, oil = temperatures.scuffing, temperatures.oil
    factors = [None if contact is None else safety_factor(limit, oil, contact) for contact in hottest]
    known = [factor for factor in factors if factor is not None]
    feature, profile = factors[2:] if len(factors) > 2 else (None, None)
    least = min(known) if len(known) == len(factors) else None
    return TrainSafety(factors[0], factors[1], worst, feature, profile, least)
