"""Closed-form scuffing check along the feature line: flash temperature, film thickness, safety."""

from dataclasses import dataclass, field

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.film import Regime, dowson_higginson_minimum, thickness_ratio, thickness_regime
from solvers.contact.flash import blok_flash_temperature
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant
from solvers.notices import Notice
from solvers.scuffing.feature_line import feature_line
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.results import FeatureLine, LoadDistribution


@dataclass(frozen=True, slots=True)
class Temperatures:
    """Bulk temperature of the teeth and of the oil they draw in, oil temperature, scuffing temperature [K].

    The scuffing temperature is a property of oil and material that the paper does not give; without it, no safety.
    """

    bulk: float = 360.0
    oil: float = 333.15
    scuffing: float | None = None


@dataclass(frozen=True, slots=True)
class ScuffingInputs:
    """What the check needs beyond the load distribution; `points` along the feature line."""

    distribution: LoadDistributionInputs
    lubricant: Lubricant = field(default_factory=Lubricant)
    temperatures: Temperatures = field(default_factory=Temperatures)
    points: int = 50


@dataclass(frozen=True, slots=True)
class ScuffingPath:
    """Along the feature line: Blok's flash temperature [K], minimum film [m] and its ratio to roughness.

    Film and ratio are NaN where nothing is loaded or nothing moves; the flash temperature is 0 without load.
    """

    line: FeatureLine
    flash: FloatArray
    film: FloatArray
    thickness_ratio: FloatArray


@dataclass(frozen=True, slots=True)
class ScuffingCheck:
    """Largest flash and contact temperature [K], thinnest film [m], each with its psi, and what they mean.

    Film values are None where no point is loaded; safety (Eq. 26) is None without a scuffing temperature.
    """

    flash: float
    flash_at: float | None
    contact_temperature: float
    film: float | None
    film_at: float | None
    thickness_ratio: float | None
    thickness_regime: Regime | None
    safety: float | None
    path: ScuffingPath
    notices: tuple[Notice, ...]


def check_scuffing(inputs: ScuffingInputs, distribution: LoadDistribution) -> ScuffingCheck:
    """The closed-form check on top of a solved load distribution.

    Raises InvalidInput scuffing_temperature if the oil is no cooler than the scuffing temperature.
    """
    path = _scuffing_path(inputs, distribution)
    temperatures = inputs.temperatures
    hottest = int(np.argmax(path.flash))
    contact = temperatures.bulk + float(path.flash[hottest])
    loaded = bool(np.any(np.isfinite(path.film)))
    thinnest = int(np.nanargmin(path.film)) if loaded else 0
    ratio = float(path.thickness_ratio[thinnest])
    return ScuffingCheck(
        flash=float(path.flash[hottest]),
        flash_at=float(path.line.psi[hottest]) if path.flash[hottest] > 0.0 else None,
        contact_temperature=contact,
        film=float(path.film[thinnest]) if loaded else None,
        film_at=float(path.line.psi[thinnest]) if loaded else None,
        thickness_ratio=ratio if loaded else None,
        thickness_regime=thickness_regime(ratio) if loaded else None,
        safety=safety_factor(temperatures, contact),
        path=path,
        notices=_notices(temperatures, path, contact),
    )


def safety_factor(temperatures: Temperatures, contact_temperature: float) -> float | None:
    """S = (t_s - t_oil) / (max t_B - t_oil) (Eq. 26); None without t_s or where the teeth stay as cool as the oil."""
    if temperatures.scuffing is None:
        return None
    if temperatures.scuffing <= temperatures.oil:
        raise InvalidInput(
            "scuffing_temperature", "the scuffing temperature must lie above the oil temperature", "scuffing"
        )
    rise = contact_temperature - temperatures.oil
    return (temperatures.scuffing - temperatures.oil) / rise if rise > 0.0 else None


def _scuffing_path(inputs: ScuffingInputs, distribution: LoadDistribution) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line."""
    given, lubricant = inputs.distribution, inputs.lubricant
    pinion, wheel = given.pinion_material, given.wheel_material
    modulus = reduced_modulus(pinion, wheel)
    line = feature_line(
        distribution.path,
        distribution.balance,
        given.load.pinion_speed,
        distribution.load.tangential_force,
        modulus,
        inputs.points,
    )
    loaded = (line.line_load > 0.0) & (line.half_width > 0.0)
    flash, film = np.zeros(line.psi.size), np.full(line.psi.size, np.nan)
    speed_1, speed_2 = line.pinion_speed[loaded], line.wheel_speed[loaded]
    if given.load.pinion_speed > 0.0:
        flash[loaded] = blok_flash_temperature(
            friction=given.friction_coefficient,
            line_load=line.line_load[loaded],
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
            line_load=line.line_load[loaded],
            modulus=modulus,
        )
    ratio = thickness_ratio(film, pinion.roughness, wheel.roughness)
    return ScuffingPath(line, frozen(flash), frozen(film), frozen(ratio))


def _notices(temperatures: Temperatures, path: ScuffingPath, contact_temperature: float) -> tuple[Notice, ...]:
    """Points without a film, and safeties without a meaning."""
    notices = []
    if np.any(np.isnan(path.film)):
        notices.append(
            Notice(
                "no_film", "where nothing is loaded along the feature line there is no film thickness", "helix_slope"
            )
        )
    if temperatures.scuffing is not None and contact_temperature <= temperatures.oil:
        notices.append(
            Notice("no_safety", "the teeth stay as cool as the oil; the safety factor has no meaning", "bulk")
        )
    return tuple(notices)
