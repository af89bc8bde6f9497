"""Scuffing of a loaded pair along the feature line: contact temperature and film thickness against their limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27); the thermal EHL
solution of every point stands beside them where it is asked for.
"""

from dataclasses import fields, replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio, thickness_regime
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.scuffing.feature_line import feature_line
from solvers.scuffing.inputs import ScuffingInputs, Temperatures
from solvers.scuffing.model import solve
from solvers.scuffing.results import FeatureLine, LoadDistribution
from solvers.scuffing.safety_results import ContactTemperature, Film, Flash, Safety, Scuffing, ScuffingPath
from solvers.scuffing.thermal_path import CURVES, ThermalPath, thermal_path

SURVEY_POINTS = 4001  # of the formulas along the feature line, to find where they are largest and smallest


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Load distribution and scuffing check.

    Raises what `model.solve` raises; InvalidInput scuffing_temperature if the oil is not cooler than that, and what
    the thermal EHL solver raises if it refuses every point.
    """
    given, temperatures = inputs.distribution, inputs.temperatures
    _check_temperatures(temperatures)
    distribution = solve(given)
    line = _checked_line(inputs, distribution)
    path = _closed_form_path(inputs, line)
    thermal: ThermalPath | None = None
    warnings = distribution.warnings
    if inputs.lubrication == "thermal_ehl":
        thermal = thermal_path(inputs, line, np.isin(path.status, "ok"))
        path = _with_thermal(inputs, path, thermal)
        warnings += thermal.warnings
    unknown = _unknown_points(path, thermal)
    flash, film = _largest_flash(path), _thinnest_film(path)
    if unknown:
        flash, film = _without_verdict(path, flash, film)
    contact_temperature = ContactTemperature(
        blok_max=None if flash.blok_max is None else temperatures.bulk + flash.blok_max,
        thermal_ehl_max=None if flash.thermal_ehl_max is None else temperatures.bulk + flash.thermal_ehl_max,
    )
    safety = _safety(temperatures, contact_temperature)
    found = {item.name: getattr(distribution, item.name) for item in fields(distribution)}
    found["warnings"] = warnings + _notices(path, safety, unknown)
    return Scuffing(
        **found,
        flash=flash,
        contact_temperature=contact_temperature,
        film=film,
        safety=safety,
        path=path,
        unsolved_points=path.status.count("no_solution") + path.status.count("refused"),
    )


def _checked_line(inputs: ScuffingInputs, distribution: LoadDistribution) -> FeatureLine:
    """The feature line at equidistant points and where the formulas are largest and smallest.

    Without the latter, a maximum would depend on the number of points.
    """
    given = inputs.distribution
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)

    def line_at(psi: FloatArray) -> FeatureLine:
        return feature_line(
            distribution.path_of_contact,
            distribution.balance,
            given.load.pinion_speed,
            distribution.load.tangential_force,
            modulus,
            psi,
        )

    survey = _closed_form_path(inputs, line_at(np.linspace(0.0, 1.0, SURVEY_POINTS)))
    extremes = [
        survey.psi[find(values)]
        for find, values in ((np.nanargmax, survey.blok_flash), (np.nanargmin, survey.dowson_higginson))
        if "ok" in survey.status
    ]
    return line_at(np.unique([*np.linspace(0.0, 1.0, inputs.path_points), *extremes]))


def safety_factor(scuffing: float, oil: float, contact: float) -> float | None:
    """S = (t_s - t_oil) / (max t_B - t_oil) (Eq. 26), temperatures in one unit; None where the rise is not positive."""
    return (scuffing - oil) / (contact - oil) if contact > oil else None


def _check_temperatures(temperatures: Temperatures) -> None:
    if temperatures.scuffing is not None and temperatures.scuffing <= temperatures.oil:
        raise InvalidInput(
            "scuffing_temperature",
            "the scuffing temperature must lie above the oil temperature",
            "temperatures.scuffing",
        )


def _safety(temperatures: Temperatures, contact: ContactTemperature) -> Safety | None:
    if temperatures.scuffing is None:
        return None
    limit, oil = temperatures.scuffing, temperatures.oil
    blok, thermal = (
        None if hottest is None else safety_factor(limit, oil, hottest)
        for hottest in (contact.blok_max, contact.thermal_ehl_max)
    )
    return Safety(blok_factor=blok, thermal_ehl_factor=thermal)


def _closed_form_path(inputs: ScuffingInputs, line: FeatureLine) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line.

    A loaded point where the reduced radius vanishes has none: it is "refused".
    """
    given, lubricant = inputs.distribution, inputs.lubricant
    pinion, wheel = given.pinion_material, given.wheel_material
    loaded = (line.line_load > 0.0) & (line.pinion_speed + line.wheel_speed > 0.0)
    defined = loaded & (line.half_width > 0.0)
    flash, film = np.where(loaded & ~defined, np.nan, 0.0), np.full(line.psi.size, np.nan)
    speed_1, speed_2, load = line.pinion_speed[defined], line.wheel_speed[defined], line.line_load[defined]
    flash[defined] = blok_flash_temperature(
        friction=given.friction_coefficient,
        line_load=load,
        speed_1=speed_1,
        speed_2=speed_2,
        half_width=line.half_width[defined],
        solid_1=pinion,
        solid_2=wheel,
    )
    film[defined] = dowson_higginson_minimum(
        viscosity=lubricant.viscosity_at(0.0, inputs.temperatures.bulk),
        pressure_viscosity=lubricant.pressure_viscosity,
        mean_speed=(speed_1 + speed_2) / 2,
        radius=line.radius[defined],
        line_load=load,
        modulus=reduced_modulus(pinion, wheel),
    )
    return ScuffingPath(
        psi=line.psi,
        status=tuple(np.where(defined, "ok", np.where(loaded, "refused", "unloaded")).tolist()),
        blok_flash=frozen(flash),
        dowson_higginson=frozen(film),
        thickness_ratio=frozen(thickness_ratio(film, pinion.roughness, wheel.roughness)),
    )


def _with_thermal(inputs: ScuffingInputs, path: ScuffingPath, thermal: ThermalPath) -> ScuffingPath:
    """The path with everything the thermal EHL solution knows, its film judged instead of the formula's."""
    given = inputs.distribution
    ratio = thickness_ratio(thermal.minimum_film, given.pinion_material.roughness, given.wheel_material.roughness)
    status = tuple(
        formula if formula == "refused" else solved for formula, solved in zip(path.status, thermal.status, strict=True)
    )
    curves = {name: getattr(thermal, name) for name in CURVES}
    return replace(path, status=status, thickness_ratio=frozen(ratio), **curves)


def _unknown_points(path: ScuffingPath, thermal: ThermalPath | None) -> int:
    """Loaded points without numbers, unless bounds show that the largest and smallest values are elsewhere."""
    missing = np.isin(path.status, ("no_solution", "refused"))
    if thermal is None or missing.all() or not _any_number(thermal.minimum_film):
        return int(missing.sum())
    hottest = np.nanmax(np.fmax(thermal.pinion_flash, thermal.wheel_flash))
    harmless = (thermal.flash_bound <= hottest) & (thermal.film_bound >= np.nanmin(thermal.minimum_film))
    return int((missing & ~harmless).sum())


def _largest_flash(path: ScuffingPath) -> Flash:
    """Largest flash temperature of the points that have one, by Blok and by the thermal EHL solution (either flank)."""
    if not _any_number(path.blok_flash):
        return Flash(None, None)
    hottest = int(np.nanargmax(path.blok_flash))
    flash = Flash(
        blok_max=float(path.blok_flash[hottest]),
        blok_at_psi=float(path.psi[hottest]) if path.blok_flash[hottest] > 0.0 else None,
    )
    if path.pinion_flash is None or path.wheel_flash is None or not _any_number(path.pinion_flash):
        return flash
    either = np.fmax(path.pinion_flash, path.wheel_flash)
    hottest = int(np.nanargmax(either))
    return replace(flash, thermal_ehl_max=float(either[hottest]), thermal_ehl_at_psi=float(path.psi[hottest]))


def _thinnest_film(path: ScuffingPath) -> Film:
    """The thinnest film of all points that have one, judged by the thermal EHL solution where there is one."""
    if not _any_number(path.dowson_higginson):
        return Film()
    formula = float(np.nanmin(path.dowson_higginson))
    judged = path.dowson_higginson if path.minimum_film is None else path.minimum_film
    if not _any_number(judged):
        return Film(dowson_higginson_min=formula)
    thinnest = int(np.nanargmin(judged))
    ratio = float(path.thickness_ratio[thinnest])
    return Film(
        dowson_higginson_min=formula,
        min_at_psi=float(path.psi[thinnest]),
        thickness_ratio=ratio,
        thickness_regime=thickness_regime(ratio),
        thermal_ehl_min=None if path.minimum_film is None else float(judged[thinnest]),
    )


def _without_verdict(path: ScuffingPath, flash: Flash, film: Film) -> tuple[Flash, Film]:
    """What is left of extremes over a path that has loaded points without numbers: those that every point has."""
    complete = not np.isnan(path.blok_flash).any()
    return (
        Flash(flash.blok_max, flash.blok_at_psi) if complete else Flash(None, None),
        Film(dowson_higginson_min=film.dowson_higginson_min) if complete else Film(),
    )


def _any_number(values: FloatArray) -> bool:
    return not bool(np.isnan(values).all())


def _notices(path: ScuffingPath, safety: Safety | None, unknown: int) -> tuple[Notice, ...]:
    """Points without a film, a path without a verdict, and a safety without a meaning."""
    notices = []
    if "unloaded" in path.status:
        cause = "modifications" if _any_number(path.dowson_higginson) else "pinion_torque"
        message = "there is no film where the feature line is not loaded or does not move"
        notices.append(Notice("no_film", message, cause))
    if unknown:
        notices.append(
            Notice(
                "unsolved_points",
                f"{path.status.count('no_solution')} of {len(path.status)} points have no solution and "
                f"{path.status.count('refused')} are outside the range of the model; {unknown} of them may decide: no "
                "largest flash temperature, thinnest film or safety is stated from the others",
            )
        )
    if safety is not None and safety.blok_factor is None and not np.isnan(path.blok_flash).any():
        notices.append(
            Notice("no_safety", "the teeth stay as cool as the oil; the safety factor has no meaning", "temperatures")
        )
    return tuple(notices)
