"""Largest flash temperature and thinnest film of a path, or the reason why they are not stated.

They are stated only if points without a solution cannot be hotter or thinner; bounds at these points show that.
"""

from dataclasses import replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.film import thickness_regime
from solvers.notices import Notice
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import ContactTemperature, Film, Flash, Safety, ScuffingPath, ThermalPath


def unknown_points(thermal: ThermalPath, bulk: float | FloatArray) -> int:
    """Number of unsolved points that may be the hottest or the thinnest by their bounds; bulk temperature [K]."""
    missing = np.isin(thermal.status, ("no_solution", "refused"))
    if not _any_number(thermal.minimum_film):
        return int(missing.sum())
    hottest = np.nanmax(np.fmax(thermal.pinion_flash, thermal.wheel_flash) + bulk)
    harmless = (thermal.flash_bound + bulk <= hottest) & (thermal.film_bound >= np.nanmin(thermal.minimum_film))
    return int((missing & ~harmless).sum())


def largest_flash(path: ScuffingPath) -> Flash:
    """Largest flash temperature of the points that have one, by Blok and by the thermal EHL solution (either flank)."""
    if not _any_number(path.blok_flash):
        return Flash(None, None)
    hottest = int(np.nanargmax(path.blok_flash))
    flash = Flash(
        blok_max=float(path.blok_flash[hottest]),
        blok_at_psi=float(path.psi[hottest]) if path.blok_flash[hottest] > 0.0 else None,
    )
    if path.thermal is None or not _any_number(path.thermal.pinion_flash):
        return flash
    either = np.fmax(path.thermal.pinion_flash, path.thermal.wheel_flash)
    hottest = int(np.nanargmax(either))
    return replace(flash, thermal_ehl_max=float(either[hottest]), thermal_ehl_at_psi=float(path.psi[hottest]))


def thinnest_film(path: ScuffingPath) -> Film:
    """The thinnest film of all points that have one, judged by the thermal EHL solution where there is one."""
    if not _any_number(path.dowson_higginson):
        return Film()
    formula = float(np.nanmin(path.dowson_higginson))
    judged = path.dowson_higginson if path.thermal is None else path.thermal.minimum_film
    if not _any_number(judged):
        return Film(dowson_higginson_min=formula)
    thinnest = int(np.nanargmin(judged))
    ratio = float(path.thickness_ratio[thinnest])
    return Film(
        dowson_higginson_min=formula,
        min_at_psi=float(path.psi[thinnest]),
        thickness_ratio=ratio,
        thickness_regime=thickness_regime(ratio),
        thermal_ehl_min=None if path.thermal is None else float(judged[thinnest]),
    )


def without_thermal(flash: Flash, film: Film) -> tuple[Flash, Film]:
    """The extremes by formula alone, for a path on which unsolved points may be the hottest or thinnest."""
    return Flash(flash.blok_max, flash.blok_at_psi), Film(dowson_higginson_min=film.dowson_higginson_min)


def _any_number(values: FloatArray) -> bool:
    return not bool(np.isnan(values).all())


def _what_leaves_no_film(distribution: LoadDistribution) -> str:
    """The input that leaves no film: load or speed where zero, else the modifications, which separate the flanks."""
    if distribution.balance.force == 0.0:
        return "pinion_torque"
    return "modifications" if np.any(distribution.feature_line.pinion_speed > 0.0) else "pinion_speed"


def path_notices(
    distribution: LoadDistribution,
    path: ScuffingPath,
    hottest: ContactTemperature | None,
    safety: Safety | None,
    unknown: int,
) -> tuple[Notice, ...]:
    """Warnings: points without a film, unsolved points that may decide, a safety factor without a meaning."""
    notices = []
    if "unloaded" in path.status:
        message = "there is no film where the feature line is not loaded or does not move"
        notices.append(Notice("no_film", message, _what_leaves_no_film(distribution), rank="note"))
    if unknown:
        notices.append(
            Notice(
                "unsolved_points",
                f"{path.status.count('no_solution')} of {len(path.status)} points have no solution and "
                f"{path.status.count('refused')} are outside the range of the model; {unknown} of them may decide: no "
                "largest flash temperature, thinnest film or safety is stated from the others",
                rank="invalid",
            )
        )
    if safety is not None and safety.blok_factor is None and hottest is not None and hottest.blok_max is not None:
        notices.append(
            Notice(
                "no_safety",
                "the teeth stay as cool as the oil; the safety factor has no meaning",
                "temperatures",
                rank="note",
            )
        )
    return tuple(notices)
