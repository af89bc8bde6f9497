"""Scuffing of a loaded pair along the feature line: contact temperature and film thickness against their limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27).
"""

from dataclasses import fields

import numpy as np

from solvers.arrays import frozen
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio, thickness_regime
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.scuffing.feature_line import feature_line
from solvers.scuffing.inputs import ScuffingInputs, Temperatures
from solvers.scuffing.model import solve
from solvers.scuffing.results import FeatureLine
from solvers.scuffing.safety_results import ContactTemperature, Film, Flash, PointStatus, Safety, Scuffing, ScuffingPath


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Load distribution and closed-form scuffing check.

    Raises what `model.solve` raises, and InvalidInput scuffing_temperature if the oil is not cooler than that.
    """
    given, temperatures = inputs.distribution, inputs.temperatures
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
    path = _scuffing_path(inputs, line, modulus)
    hottest = int(np.argmax(path.blok_flash))
    flash = Flash(
        blok_max=float(path.blok_flash[hottest]),
        blok_at_psi=float(path.psi[hottest]) if path.blok_flash[hottest] > 0.0 else None,
    )
    contact_temperature = ContactTemperature(blok_max=temperatures.bulk + flash.blok_max)
    safety = _safety(temperatures, contact_temperature)
    found = {item.name: getattr(distribution, item.name) for item in fields(distribution)}
    found["warnings"] += _notices(path, safety)
    return Scuffing(
        **found,
        flash=flash,
        contact_temperature=contact_temperature,
        film=_thinnest_film(path),
        safety=safety,
        path=path,
    )


def safety_factor(scuffing: float, oil: float, contact: float) -> float | None:
    """S = (t_s - t_oil) / (max t_B - t_oil) (Eq. 26), temperatures in one unit; None where the rise is not positive."""
    return (scuffing - oil) / (contact - oil) if contact > oil else None


def _safety(temperatures: Temperatures, contact_temperature: ContactTemperature) -> Safety | None:
    if temperatures.scuffing is None:
        return None
    if temperatures.scuffing <= temperatures.oil:
        raise InvalidInput(
            "scuffing_temperature",
            "the scuffing temperature must lie above the oil temperature",
            "temperatures.scuffing",
        )
    return Safety(safety_factor(temperatures.scuffing, temperatures.oil, contact_temperature.blok_max))


def _scuffing_path(inputs: ScuffingInputs, line: FeatureLine, modulus: float) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line."""
    given, lubricant = inputs.distribution, inputs.lubricant
    pinion, wheel = given.pinion_material, given.wheel_material
    loaded = (line.line_load > 0.0) & (line.half_width > 0.0) & (line.pinion_speed + line.wheel_speed > 0.0)
    flash, film = np.zeros(line.psi.size), np.full(line.psi.size, np.nan)
    speed_1, speed_2, load = line.pinion_speed[loaded], line.wheel_speed[loaded], line.line_load[loaded]
    flash[loaded] = blok_flash_temperature(
        friction=given.friction_coefficient,
        line_load=load,
        speed_1=speed_1,
        speed_2=speed_2,
        half_width=line.half_width[loaded],
        solid_1=pinion,
        solid_2=wheel,
    )
    film[loaded] = dowson_higginson_minimum(
        viscosity=lubricant.viscosity_at(0.0, inputs.temperatures.bulk),
        pressure_viscosity=lubricant.pressure_viscosity,
        mean_speed=(speed_1 + speed_2) / 2,
        radius=line.radius[loaded],
        line_load=load,
        modulus=modulus,
    )
    ratio = thickness_ratio(film, pinion.roughness, wheel.roughness)
    status: tuple[PointStatus, ...] = tuple("ok" if point else "unloaded" for point in loaded)
    return ScuffingPath(line.psi, status, frozen(flash), frozen(film), frozen(ratio))


def _thinnest_film(path: ScuffingPath) -> Film:
    if np.all(np.isnan(path.dowson_higginson)):
        return Film()
    thinnest = int(np.nanargmin(path.dowson_higginson))
    ratio = float(path.thickness_ratio[thinnest])
    return Film(
        dowson_higginson_min=float(path.dowson_higginson[thinnest]),
        min_at_psi=float(path.psi[thinnest]),
        thickness_ratio=ratio,
        thickness_regime=thickness_regime(ratio),
    )


def _notices(path: ScuffingPath, safety: Safety | None) -> tuple[Notice, ...]:
    """Points without a film, and a safety without a meaning."""
    notices = []
    if np.any(np.isnan(path.dowson_higginson)):
        notices.append(
            Notice("no_film", "where the feature line is not loaded or does not move there is no film", "modifications")
        )
    if safety is not None and safety.blok_factor is None:
        notices.append(
            Notice("no_safety", "the teeth stay as cool as the oil; the safety factor has no meaning", "temperatures")
        )
    return tuple(notices)
