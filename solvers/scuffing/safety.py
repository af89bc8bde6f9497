"""Scuffing of a loaded pair along the feature line: contact temperature and film thickness against their limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27); the thermal EHL
solution of every point stands beside them where it is asked for.
"""

from dataclasses import fields, replace

import numpy as np

from solvers.arrays import BoolArray, FloatArray, frozen
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio, thickness_regime
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.scuffing.feature_line import feature_line
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs, Temperatures
from solvers.scuffing.model import solve
from solvers.scuffing.results import ContactPoints, FeatureLine
from solvers.scuffing.safety_results import ContactTemperature, Film, Flash, Safety, Scuffing, ScuffingPath
from solvers.scuffing.thermal_path import ThermalPath, thermal_path


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Load distribution and scuffing check.

    Raises what `model.solve` raises; InvalidInput scuffing_temperature if the oil is not cooler than that, and what
    the thermal EHL solver raises if it refuses every point.
    """
    given, temperatures = inputs.distribution, inputs.temperatures
    _check_temperatures(temperatures)
    distribution = solve(given)
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    line = feature_line(
        distribution.path_of_contact,
        distribution.balance,
        given.load.pinion_speed,
        distribution.load.tangential_force,
        modulus,
        inputs.path_points,
    )
    loaded = line.in_contact
    path = _closed_form_path(inputs, line, loaded, modulus)
    warnings = distribution.warnings
    if inputs.lubrication == "thermal_ehl":
        thermal = thermal_path(inputs, line, loaded)
        path = _with_thermal(inputs, path, thermal)
        warnings += thermal.warnings
    flash = _largest_flash(path)
    contact_temperature = ContactTemperature(
        blok_max=temperatures.bulk + flash.blok_max,
        thermal_ehl_max=None if flash.thermal_ehl_max is None else temperatures.bulk + flash.thermal_ehl_max,
    )
    safety = _safety(temperatures, contact_temperature)
    found = {item.name: getattr(distribution, item.name) for item in fields(distribution)}
    found["warnings"] = warnings + _notices(path, safety)
    return Scuffing(
        **found,
        flash=flash,
        contact_temperature=contact_temperature,
        film=_thinnest_film(path),
        safety=safety,
        path=path,
        unsolved_points=path.status.count("no_solution"),
    )


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
    return Safety(
        blok_factor=safety_factor(limit, oil, contact.blok_max),
        thermal_ehl_factor=(
            None if contact.thermal_ehl_max is None else safety_factor(limit, oil, contact.thermal_ehl_max)
        ),
    )


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


def _closed_form_path(inputs: ScuffingInputs, line: FeatureLine, loaded: BoolArray, modulus: float) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line."""
    given, lubricant = inputs.distribution, inputs.lubricant
    pinion, wheel = given.pinion_material, given.wheel_material
    film = np.full(line.psi.size, np.nan)
    speed_1, speed_2, load = line.pinion_speed[loaded], line.wheel_speed[loaded], line.line_load[loaded]
    film[loaded] = dowson_higginson_minimum(
        viscosity=lubricant.viscosity_at(0.0, inputs.temperatures.bulk),
        pressure_viscosity=lubricant.pressure_viscosity,
        mean_speed=(speed_1 + speed_2) / 2,
        radius=line.radius[loaded],
        line_load=load,
        modulus=modulus,
    )
    return ScuffingPath(
        psi=line.psi,
        status=tuple("ok" if point else "unloaded" for point in loaded),
        blok_flash=frozen(blok_flash(given, line)),
        dowson_higginson=frozen(film),
        thickness_ratio=frozen(thickness_ratio(film, pinion.roughness, wheel.roughness)),
    )


def _with_thermal(inputs: ScuffingInputs, path: ScuffingPath, thermal: ThermalPath) -> ScuffingPath:
    """The path with everything the thermal EHL solution knows, its film judged instead of the formula's."""
    given = inputs.distribution
    ratio = thickness_ratio(thermal.minimum_film, given.pinion_material.roughness, given.wheel_material.roughness)
    return replace(
        path,
        status=thermal.status,
        thickness_ratio=frozen(ratio),
        pinion_flash=thermal.pinion_flash,
        wheel_flash=thermal.wheel_flash,
        minimum_film=thermal.minimum_film,
        central_film=thermal.central_film,
        max_pressure=thermal.max_pressure,
        friction_coefficient=thermal.friction_coefficient,
        film_max_temperature=thermal.film_max_temperature,
    )


def _largest_flash(path: ScuffingPath) -> Flash:
    """Largest flash temperature by Blok, and by the thermal EHL solution on either flank."""
    hottest = int(np.argmax(path.blok_flash))
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
    """The thinnest film, judged by the thermal EHL solution where there is one."""
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


def _any_number(values: FloatArray) -> bool:
    return not bool(np.isnan(values).all())


def _notices(path: ScuffingPath, safety: Safety | None) -> tuple[Notice, ...]:
    """Points without a film, and a safety without a meaning."""
    notices = []
    if np.any(np.isnan(path.dowson_higginson)):
        cause = "modifications" if _any_number(path.dowson_higginson) else "pinion_torque"
        message = "there is no film where the feature line is not loaded or does not move"
        notices.append(Notice("no_film", message, cause))
    if safety is not None and safety.blok_factor is None:
        notices.append(
            Notice("no_safety", "the teeth stay as cool as the oil; the safety factor has no meaning", "temperatures")
        )
    return tuple(notices)
