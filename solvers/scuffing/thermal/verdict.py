"""Largest flash temperature and thinnest film of the lines and of the flank, and warnings about missing values.

An unsolved point might be hotter, or might have a thinner film, than all solved points. If there is such a point, the
largest flash temperature and the thinnest film by thermal EHL are not stated. At some unsolved points, bounds of flash
temperature and film are known. These bounds may show that the point cannot be the hottest point and cannot have the
thinnest film.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.film import thickness_ratio, thickness_regime
from solvers.notices import Notice
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import (
    ContactTemperature,
    Film,
    Flash,
    PointStatus,
    Safety,
    ScuffingPath,
    ThermalPath,
)


class CheckedLine(NamedTuple):
    """Results along a line of the flank, and the distance of every point from the end that meshes first [m]."""

    path: ScuffingPath
    face: FloatArray


class SolvedContacts(NamedTuple):
    """The contacts from which the extremes by thermal EHL are taken.

    These are the decisive places of the flank, or the points of the feature line if only this line is checked.
    """

    psi: FloatArray  # fraction of the path from A
    face: FloatArray  # distance from the end that meshes first [m]
    path: ThermalPath


def unknown_points(path: ThermalPath, bulk: FloatArray) -> int:
    """Count the unsolved points that may be hotter, or may have a thinner film, than every solved point.

    `bulk` has the bulk temperatures [K] at the points, either in one row for both gears or in two rows for pinion and
    wheel.
    """
    missing = np.isin(path.status, ("no_solution", "refused"))
    if not _any_number(path.minimum_film):
        return int(missing.sum())
    flank, flash_bound = hotter_surface(path, bulk), path.flash_bound + np.max(np.atleast_2d(bulk), axis=0)
    harmless = (flash_bound <= np.nanmax(flank)) & (path.film_bound >= np.nanmin(path.minimum_film))
    return int((missing & ~harmless).sum())


def hotter_surface(path: ThermalPath, bulk: FloatArray) -> FloatArray:
    """Return the temperature of the hotter surface at each point [K].

    `bulk` [K] has either one row for both gears, or two rows for pinion and wheel.
    """
    pinion, wheel = np.broadcast_to(bulk, (2, path.pinion_flash.size))
    hotter: FloatArray = np.fmax(path.pinion_flash + pinion, path.wheel_flash + wheel)
    return hotter


def largest_flash(
    feature: CheckedLine, hottest: Peak | None, solved: SolvedContacts | None, path_length: float
) -> Flash:
    """Return the largest flash temperature by Blok, and the largest flash temperature by thermal EHL.

    At each point, the thermal EHL solution gives two flash temperatures: one for the pinion and one for the wheel. The
    larger of the two is used. `hottest`: largest flash temperature by Blok over the flank [K]; None if the flank was
    not checked; `solved`: the contacts from which the extremes by thermal EHL are taken; None in closed form.
    """
    path, face = feature
    if not _any_number(path.blok_flash):
        return Flash(None, None)
    place = int(np.nanargmax(path.blok_flash))
    largest, psi = float(path.blok_flash[place]), float(path.psi[place])
    flash = Flash(largest, psi, largest, psi, float(face[place])) if largest > 0.0 else Flash(largest, None, largest)
    if hottest is not None and hottest.value > largest:
        at_profile = hottest.x / path_length
        flash = replace(flash, blok_max=hottest.value, blok_at_profile=at_profile, blok_at_face=hottest.y)
    if solved is None or path.thermal is None:
        return flash
    hotter = np.fmax(solved.path.pinion_flash, solved.path.wheel_flash)
    if not _any_number(hotter):
        return flash
    top = int(np.nanargmax(hotter))
    return replace(
        flash,
        thermal_ehl_max=float(hotter[top]),
        thermal_ehl_at_psi=_place_on(path, np.fmax(path.thermal.pinion_flash, path.thermal.wheel_flash), largest=True),
        thermal_ehl_at_profile=float(solved.psi[top]),
        thermal_ehl_at_face=float(solved.face[top]),
    )


def thinnest_film(
    feature: CheckedLine,
    thinnest: Peak | None,
    solved: SolvedContacts | None,
    path_length: float,
    given: LoadDistributionInputs,
) -> Film:
    """Return the thinnest film and its ratio to the roughness.

    If the thermal EHL contact is solved, the ratio is computed with the film by thermal EHL. Otherwise the ratio is
    computed with the film by Dowson and Higginson. `thinnest`: thinnest film over the flank by Dowson and Higginson
    [m]; None if the flank was not checked; `solved`: the contacts from which the extremes by thermal EHL are taken;
    None in closed form.
    """
    path, curve = feature.path, feature.path.dowson_higginson
    judged = _least(curve, path.psi, feature.face)
    if thinnest is not None and (judged is None or thinnest.value < judged[0]):
        judged = thinnest.value, thinnest.x / path_length, thinnest.y
    if judged is None:
        return Film()
    film = Film(dowson_higginson_min=judged[0])
    if solved is not None and path.thermal is not None:
        curve = path.thermal.minimum_film
        judged = _least(solved.path.minimum_film, solved.psi, solved.face)
        if judged is None:
            return film
        film = replace(film, thermal_ehl_min=judged[0])
    ratio = thickness_ratio(judged[0], given.pinion_material.roughness, given.wheel_material.roughness)
    return replace(
        film,
        min_at_psi=_place_on(path, curve, largest=False),
        min_at_profile=judged[1],
        min_at_face=judged[2],
        thickness_ratio=ratio,
        thickness_regime=thickness_regime(ratio),
    )


def without_thermal(flash: Flash, film: Film) -> tuple[Flash, Film]:
    """Remove all values by thermal EHL; the values by Blok and by Dowson and Higginson remain."""
    by_formula = replace(
        flash, thermal_ehl_max=None, thermal_ehl_at_psi=None, thermal_ehl_at_profile=None, thermal_ehl_at_face=None
    )
    return by_formula, Film(dowson_higginson_min=film.dowson_higginson_min)


def _least(values: FloatArray, psi: FloatArray, face: FloatArray) -> tuple[float, float, float] | None:
    """Return the smallest value and its place: fraction of the path, and distance along the face [m].

    The result is None if all values are NaN.
    """
    if not _any_number(values):
        return None
    place = int(np.nanargmin(values))
    return float(values[place]), float(psi[place]), float(face[place])


def _place_on(path: ScuffingPath, values: FloatArray, *, largest: bool) -> float | None:
    """Return the fraction psi of the path at which the values are largest; None if all values are NaN.

    If `largest` is False, return the fraction at which the values are smallest.
    """
    if not _any_number(values):
        return None
    return float(path.psi[np.nanargmax(values) if largest else np.nanargmin(values)])


def _any_number(values: FloatArray) -> bool:
    return not bool(np.isnan(values).all())


def _what_leaves_no_film(distribution: LoadDistribution) -> str:
    """Return the name of the input that causes points without a film.

    If the teeth transmit no force, the cause is the torque. If the teeth transmit a force but do not move, the cause is
    the speed. In all other cases the modifications are the cause.
    """
    if distribution.balance.force == 0.0:
        return "pinion_torque"
    return "modifications" if np.any(distribution.feature_line.pinion_speed > 0.0) else "pinion_speed"


def path_notices(
    distribution: LoadDistribution,
    feature: ScuffingPath,
    status: Sequence[PointStatus],
    hottest: ContactTemperature | None,
    safety: Safety | None,
    unknown: int,
) -> tuple[Notice, ...]:
    """List warnings about points without a film, about unsolved points, and about a safety factor without meaning.

    `status` has the outcomes of all points: of the lines and of the places that decide. `unknown` is the number of
    unsolved points that may be the hottest, or may have the thinnest film. The list also contains the note that
    `_other_verdict` returns.
    """
    notices = []
    if "unloaded" in feature.status:
        message = "some points of the feature line have no load or no motion; at these points there is no film"
        notices.append(Notice("no_film", message, _what_leaves_no_film(distribution), rank="note"))
    if unknown:
        notices.append(
            Notice(
                "unsolved_points",
                f"{status.count('no_solution')} of {len(status)} points have no solution and {status.count('refused')} "
                f"are outside the range of the model. {unknown} of these points could have the highest flash "
                "temperature or the thinnest film, so these extremes and the safety are not stated",
                rank="invalid",
            )
        )
    if safety is not None and safety.blok_factor is None and hottest is not None and hottest.blok_max is not None:
        notices.append(
            Notice(
                "no_safety",
                "the teeth stay as cool as the oil; the safety factor therefore has no meaning",
                "temperatures",
                rank="note",
            )
        )
    return tuple(notices)
