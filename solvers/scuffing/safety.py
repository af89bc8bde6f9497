"""Scuffing of a loaded pair along the feature line: contact temperature and film thickness against their limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27); the thermal EHL
solution of every point stands beside them where it is asked for.
"""

from dataclasses import fields, replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.scuffing.feature_line import feature_line
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs, Temperatures
from solvers.scuffing.model import solve
from solvers.scuffing.results import ContactPoints, FeatureLine, LoadDistribution
from solvers.scuffing.safety_results import ContactTemperature, Safety, Scuffing, ScuffingPath
from solvers.scuffing.thermal_path import CURVES, ThermalPath, thermal_path
from solvers.scuffing.verdict import largest_flash, path_notices, thinnest_film, unknown_points, without_verdict

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
    path = _closed_form_path(inputs, line, distribution.path_of_contact.plane.least_radius)
    thermal: ThermalPath | None = None
    warnings = distribution.warnings
    if inputs.lubrication == "thermal_ehl":
        thermal = thermal_path(inputs, line, np.isin(path.status, "ok"))
        path = _with_thermal(inputs, path, thermal)
        warnings += thermal.warnings
    unknown = unknown_points(path, thermal)
    flash, film = largest_flash(path), thinnest_film(path)
    if unknown:
        flash, film = without_verdict(path, flash, film)
    contact_temperature = ContactTemperature(
        blok_max=None if flash.blok_max is None else temperatures.bulk + flash.blok_max,
        thermal_ehl_max=None if flash.thermal_ehl_max is None else temperatures.bulk + flash.thermal_ehl_max,
    )
    safety = _safety(temperatures, contact_temperature)
    found = {item.name: getattr(distribution, item.name) for item in fields(distribution)}
    found["warnings"] = warnings + path_notices(path, safety, unknown)
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

    least_radius = distribution.path_of_contact.plane.least_radius
    survey = _closed_form_path(inputs, line_at(np.linspace(0.0, 1.0, SURVEY_POINTS)), least_radius)
    psi = [*np.linspace(0.0, 1.0, inputs.path_points)]
    if "ok" in survey.status:
        psi += [survey.psi[np.nanargmax(survey.blok_flash)], survey.psi[np.nanargmin(survey.dowson_higginson)]]
    if "refused" in survey.status:
        psi.append(survey.psi[survey.status.index("refused")])
    return line_at(np.unique(psi))


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


def blok_flash(given: LoadDistributionInputs, points: ContactPoints) -> FloatArray:
    """Blok's flash temperature [K] (Eq. 25) at the points; 0 where nothing touches or moves."""
    flash, touching = np.zeros(points.line_load.shape), points.in_contact
    flash[touching] = blok_flash_temperature(
        friction=given.friction_coefficient,
        line_load=points.line_load[touching],
        speed_1=points.pinion_speed[touching],
        speed_2=points.wheel_speed[touching],
        half_width=points.half_width[touching],
        solid_1=given.pinion_material,
        solid_2=given.wheel_material,
    )
    return flash


def _closed_form_path(inputs: ScuffingInputs, line: FeatureLine, least_radius: float) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line.

    A loaded point has neither if its reduced radius is below the least that has a meaning: it is "refused".
    """
    given, lubricant = inputs.distribution, inputs.lubricant
    pinion, wheel = given.pinion_material, given.wheel_material
    undefined = (line.line_load > 0.0) & (line.radius < least_radius)
    defined = line.in_contact & ~undefined
    film = np.full(line.psi.size, np.nan)
    speed_1, speed_2, load = line.pinion_speed[defined], line.wheel_speed[defined], line.line_load[defined]
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
        status=tuple(np.where(defined, "ok", np.where(undefined, "refused", "unloaded")).tolist()),
        blok_flash=frozen(np.where(undefined, np.nan, blok_flash(given, line))),
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
