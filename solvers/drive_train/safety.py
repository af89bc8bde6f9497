"""Scuffing over the whole flank: a load at one end is hottest in a corner that the feature line never meets."""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import reduced_modulus
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import FlashPlaces, TrainSafety
from solvers.drive_train.thermal_lead import ThermalLead
from solvers.notices import Notice
from solvers.scuffing.feature_line import contact_points
from solvers.scuffing.results import ContactPoints, LoadDistribution, Place
from solvers.scuffing.safety import blok_flash, safety_factor
from solvers.scuffing.thermal_path import thermal_path


@dataclass(frozen=True, slots=True)
class FlankHeat:
    """Blok's contact temperature over the flank [profile, face] [K], and what follows from its maxima."""

    temperature: FloatArray
    flash: FlashPlaces
    safety: TrainSafety | None
    unsolved_points: int
    warnings: tuple[Notice, ...]


def flank_heat(inputs: DriveTrainInputs, mesh: LoadDistribution, thermal: ThermalLead) -> FlankHeat:
    """Flash temperature on the feature line and over the flank, thermal EHL on the two lines that matter."""
    plane = mesh.path_of_contact.plane
    x, y = np.meshgrid(
        mesh.flank.profile_fraction * plane.path_length, mesh.flank.face_fraction * plane.face_width, indexing="ij"
    )
    psi = np.linspace(0.0, 1.0, inputs.mesh.path_points)
    along, across = psi * plane.path_length, psi * plane.face_width
    feature, flank = _points(inputs, mesh, along, across), _points(inputs, mesh, x, y)
    on_feature, on_flank = (blok_flash(inputs.mesh.distribution, points) for points in (feature, flank))
    warm_feature = on_feature + _bulk(inputs, thermal, across)
    warm_flank = on_flank + _bulk(inputs, thermal, y)
    worst = np.unravel_index(int(np.argmax(warm_flank)), warm_flank.shape)
    place = Place(
        gamma=float(flank.gamma[worst]),
        profile_fraction=float(mesh.flank.profile_fraction[worst[0]]),
        face_fraction=float(mesh.flank.face_fraction[worst[1]]),
    )
    hottest: list[float | None] = [float(warm_feature.max()), float(warm_flank.max())]
    unsolved, warnings = 0, list[Notice]()
    if inputs.mesh.lubrication == "thermal_ehl":
        across_worst = np.full(psi.size, y[worst])
        for points, where in (
            (feature, across),
            (_points(inputs, mesh, along, across_worst), across_worst),
        ):
            found, missing, notices = _thermal(inputs, points, _bulk(inputs, thermal, where))
            hottest.append(found)
            unsolved += missing
            warnings += notices
    else:
        hottest += [None, None]
    return FlankHeat(
        temperature=warm_flank,
        flash=FlashPlaces(float(on_feature.max()), float(on_flank.max()), place if on_flank.max() > 0.0 else None),
        safety=_safety(inputs, hottest),
        unsolved_points=unsolved,
        warnings=tuple({notice.code: notice for notice in warnings}.values()),
    )


def _points(inputs: DriveTrainInputs, mesh: LoadDistribution, x: FloatArray, y: FloatArray) -> ContactPoints:
    given = inputs.mesh.distribution
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    return contact_points(mesh.path_of_contact, mesh.balance, x, y, given.load.pinion_speed, modulus)


def _bulk(inputs: DriveTrainInputs, thermal: ThermalLead, y: FloatArray) -> FloatArray:
    """Bulk temperature [K] of the contact at y: the given one, and with `local_bulk` the members' mean pumping heat."""
    bulk = np.full(y.shape, inputs.mesh.temperatures.bulk)
    if inputs.local_bulk:
        stations = np.linspace(0.0, inputs.mesh.distribution.gears.face_width, thermal.pinion_rise.size)
        bulk += np.interp(y, stations, (thermal.pinion_rise + thermal.wheel_rise) / 2)
    return bulk


def _thermal(
    inputs: DriveTrainInputs, points: ContactPoints, bulk: FloatArray
) -> tuple[float | None, int, tuple[Notice, ...]]:
    """Hottest flank surface [K] along a line by thermal EHL, None where a loaded point was not solved; how many."""
    if not np.any(points.in_contact):
        return None, 0, ()
    path = thermal_path(inputs.mesh, points, points.in_contact)
    unsolved = sum(status in {"no_solution", "refused"} for status in path.status)
    if unsolved:
        return None, unsolved, path.warnings
    return float(np.nanmax(np.fmax(path.pinion_flash, path.wheel_flash) + bulk)), 0, path.warnings


def _safety(inputs: DriveTrainInputs, hottest: list[float | None]) -> TrainSafety | None:
    temperatures = inputs.mesh.temperatures
    if temperatures.scuffing is None:
        return None
    limit, oil = temperatures.scuffing, temperatures.oil
    factors = [None if contact is None else safety_factor(limit, oil, contact) for contact in hottest]
    least = min((factor for factor in factors if factor is not None), default=None)
    return TrainSafety(factors[0], factors[1], factors[2], factors[3], least)
