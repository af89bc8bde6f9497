"""The check against micropitting: permissible film ratio, film by method A, film by method B and warnings."""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.notices import Notice
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.inputs import MicropittingCheck, ScuffingInputs, grade_in_force
from solvers.scuffing.load_balance import BESIDE
from solvers.scuffing.load_factors.method_b import factors_of
from solvers.scuffing.micropitting.local import FlankFilm, find_least, flank_film
from solvers.scuffing.micropitting.notices import hot_film_notices, range_notices, standard_notices
from solvers.scuffing.micropitting.oil_test import film_of_test, permissible_ratio
from solvers.scuffing.micropitting.results import (
    LocalFilm,
    LocalPoint,
    Micropitting,
    StandardFilm,
    StandardPoint,
    Verdict,
)
from solvers.scuffing.micropitting.standard import characteristic_points, has_standard_film, solve_standard
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.thermal.flank import FaceFunction, FlashMap

LIKELY_BELOW, UNLIKELY_ABOVE = 1.0, 2.0  # limits of the safety factor, from common practice


@dataclass(frozen=True, slots=True)
class CheckedFlank:
    """Results of a check of the flank.

    `answer` contains the results for the user. `film` computes the film ratio at any point of the flank. `ratio` is the
    film ratio at the points of the flank's maps. Unknown values are None.
    """

    answer: Micropitting | None = None
    film: FlankFilm | None = None
    ratio: FloatArray | None = None
    warnings: tuple[Notice, ...] = ()


def check_micropitting(
    inputs: ScuffingInputs,
    distribution: LoadDistribution,
    grid: FlashMap,
    thermal_film: float | None,
    bulk: FaceFunction | None = None,
) -> CheckedFlank:
    """Compare the film ratio over the flank with the permissible film ratio.

    `thermal_film`: thinnest film by thermal EHL [m]; None if this film is unknown; `bulk`: function that returns the
    bulk temperature [K] along the face; None if the bulk temperature is constant. Returns answer, film and warnings. If
    the check is not requested, or if the oil or the bulk temperature is unknown, all values are None and there are no
    warnings.
    """
    check, oil = inputs.micropitting, inputs.known_oil
    if check is None or oil is None or inputs.temperatures.bulk is None:
        return CheckedFlank()
    test = None if check.failure_load_stage is None else film_of_test(oil, check.failure_load_stage)
    permissible = permissible_ratio(check, test)
    film = flank_film(inputs, distribution, bulk)
    ratio = None if film is None else film.over(grid)
    least = None if film is None or ratio is None else find_least(film, grid, ratio)
    standard = _standard(inputs, check, distribution, permissible)
    given, path = inputs.distribution, distribution.path_of_contact
    warnings = [*range_notices(given, path), *standard_notices(given, path, standard)]
    if film is not None and least is not None:
        warnings += hot_film_notices(film, least)
    return CheckedFlank(
        answer=Micropitting(permissible, test, _local(distribution, film, least, permissible, thermal_film), standard),
        film=film,
        ratio=None if ratio is None else ratio[grid.mapped],
        warnings=tuple(warnings),
    )


def _local(
    distribution: LoadDistribution,
    film: FlankFilm | None,
    least: Peak | None,
    permissible: float | None,
    thermal_film: float | None,
) -> LocalFilm:
    safety = None if least is None else _safety(least.value, permissible)
    roughness = None if film is None else film.conditions.roughness
    return LocalFilm(
        safety=safety,
        least_ratio=None if least is None else least.value,
        at_psi=None if least is None else least.x / distribution.path_of_contact.length,
        at_face=None if least is None else least.y,
        verdict=None if safety is None else verdict(safety),
        friction_coefficient=None if film is None else film.conditions.friction,
        thermal_ehl_ratio=None if roughness is None or thermal_film is None else thermal_film / roughness,
        points=tuple(_local_points(distribution, film, permissible)),
    )


def _local_points(
    distribution: LoadDistribution, film: FlankFilm | None, permissible: float | None
) -> list[LocalPoint]:
    """Return the film at the characteristic points A, B, C and so on of the feature line.

    The load of a spur pair jumps at B and D. Both belong to single contact there, as in method B.
    """
    path = distribution.path_of_contact
    places = {name: x / path.length for name, x in characteristic_points(path).items()}
    psi = np.array([*places.values()])
    ratio = np.full(psi.size, np.nan)
    if film is not None:
        spur = path.plane.tan_base_helix == 0.0
        beside = np.array([BESIDE * {"B": spur, "D": -spur}.get(name, 0) for name in places])
        ratio = film.at((psi + beside) * path.length, psi * path.plane.face_width)
    finite = [None if np.isnan(value) else float(value) for value in ratio]
    return [
        LocalPoint(name, place, value, _safety(value, permissible))
        for (name, place), value in zip(places.items(), finite, strict=True)
    ]


def _standard(
    inputs: ScuffingInputs, check: MicropittingCheck, distribution: LoadDistribution, permissible: float | None
) -> StandardFilm | None:
    given, path, oil = inputs.distribution, distribution.path_of_contact, inputs.known_oil
    moving = distribution.balance.force > 0.0 and given.load.pinion_speed > 0.0
    if oil is None or not moving or not has_standard_film(given, path):
        return None
    temperatures = inputs.temperatures
    factors, load = factors_of(inputs, distribution), given.load
    torque = load.helix_torque * load.application_factor * load.mesh_load_factor * factors.product
    grade = grade_in_force(check.quality_grade, given.gears)
    standard = solve_standard(given, path, oil, temperatures.oil, temperatures.oil_supply, grade, torque)
    values = zip(standard.force_ratio, standard.contacts.pressure, *standard.films, strict=True)
    points = tuple(
        StandardPoint(
            name, float(share), float(pressure), float(flash), float(film), float(ratio), _safety(ratio, permissible)
        )
        for name, (share, pressure, flash, film, ratio) in zip(characteristic_points(path), values, strict=True)
    )
    least = min(point.ratio for point in points)
    return StandardFilm(
        standard.friction, standard.bulk, standard.loss_factor, least, _safety(least, permissible), points, factors
    )


def _safety(ratio: float | None, permissible: float | None) -> float | None:
    """Compute the safety factor S_lambda = lambda / lambda_GFP (Eq. M7); None if one of the two ratios is unknown."""
    return None if ratio is None or permissible is None else ratio / permissible


def verdict(safety: float) -> Verdict:
    """Return the verdict that common practice gives for a safety factor."""
    if safety < LIKELY_BELOW:
        return "micropitting is likely"
    return "micropitting is unlikely" if safety > UNLIKELY_ABOVE else "limited margin"
