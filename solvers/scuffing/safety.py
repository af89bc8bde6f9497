"""Scuffing of a loaded pair along the feature line: contact temperature and film thickness against their limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27); the thermal EHL
solution of every point stands beside them where it is asked for.
"""

from dataclasses import replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio
from solvers.contact.hertz import reduced_modulus
from solvers.lubricants import OilInUse, oil_in_use
from solvers.oils import OilSheet
from solvers.scuffing.contact_slices import reaches_base_circle
from solvers.scuffing.flank_results import feature_line
from solvers.scuffing.inputs import ScuffingInputs, Temperatures
from solvers.scuffing.model import solve
from solvers.scuffing.results import Derived, FeatureLine, LoadDistribution
from solvers.scuffing.safety_results import (
    ContactTemperature,
    Film,
    Flash,
    Safety,
    Scuffing,
    ScuffingDerived,
    ScuffingPath,
    ThermalPath,
)
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.practice import scuffing_risk
from solvers.scuffing.thermal.temperatures import in_force, oil_notices
from solvers.scuffing.thermal.thermal_path import thermal_path
from solvers.scuffing.thermal.verdict import largest_flash, path_notices, thinnest_film, unknown_points, without_thermal

SURVEY_POINTS = 4001  # of the formulas along the feature line, to find where they are largest and smallest


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Load distribution and scuffing check (Eq. 16).

    Without an oil or a bulk temperature there are neither film nor contact temperature nor safety. Raises what
    `model.solve` and `in_force` raise, and what the thermal EHL solver raises if it refuses every point.
    """
    inputs, distribution = in_force(inputs, solve(inputs.distribution))
    bulk = inputs.temperatures.bulk
    line = _checked_line(inputs, distribution)
    path = _closed_form_path(inputs, line)
    thermal: ThermalPath | None = None
    warnings = (*distribution.warnings, *oil_notices(inputs, distribution.path_of_contact))
    if inputs.lubrication == "thermal_ehl" and bulk is not None:
        thermal = thermal_path(inputs, line, np.isin(path.status, "ok"))
        path = _with_thermal(inputs, path, thermal)
        warnings += thermal.warnings
    unknown = 0 if thermal is None or bulk is None else unknown_points(thermal, bulk)
    flash, film = largest_flash(path), thinnest_film(path)
    if reaches_base_circle(distribution.balance.survey):
        flash, film = Flash(None, None), Film()
    elif unknown:
        flash, film = without_thermal(flash, film)
    flash = replace(flash, friction_coefficient=inputs.distribution.friction_coefficient)
    hottest = None if bulk is None else _contact_temperature(bulk, flash)
    safety = None if hottest is None else _safety(inputs.temperatures, hottest)
    return Scuffing(
        distribution=distribution,
        flash=flash,
        contact_temperature=hottest,
        film=None if bulk is None else film,
        safety=safety,
        path=path,
        derived=_derived(inputs, distribution.derived),
        warnings=warnings + path_notices(distribution, path, hottest, safety, unknown),
        unsolved_points=path.status.count("no_solution") + path.status.count("refused"),
    )


def _contact_temperature(bulk: float, flash: Flash) -> ContactTemperature:
    """Bulk [K] and flash."""
    return ContactTemperature(
        bulk=bulk,
        blok_max=None if flash.blok_max is None else bulk + flash.blok_max,
        thermal_ehl_max=None if flash.thermal_ehl_max is None else bulk + flash.thermal_ehl_max,
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

    survey = line_at(np.linspace(0.0, 1.0, SURVEY_POINTS))
    psi = [*np.linspace(0.0, 1.0, inputs.path_points)]
    for curve, extreme in ((blok_flash(given, survey), np.nanargmax), (_film(inputs, survey), np.nanargmin)):
        if np.isfinite(curve[survey.in_contact]).any():
            psi.append(survey.psi[extreme(curve)])
    if survey.undefined.any():
        psi.append(survey.psi[np.argmax(survey.undefined)])
    return line_at(np.unique(psi))


def _derived(inputs: ScuffingInputs, mesh: Derived) -> ScuffingDerived:
    """What follows from the inputs for mesh and oil."""
    sheet = inputs.oil if isinstance(inputs.oil, OilSheet) else None
    return ScuffingDerived(
        mesh=mesh,
        oil=None if inputs.lubricant is None else OilInUse(**oil_in_use(inputs.lubricant)),
        kinematic_viscosity_100=None if sheet is None else sheet.kinematic_viscosity_100,
        density_15=None if sheet is None else sheet.reference_density,
        lubricant_factor=inputs.temperatures.lubricant_factor,
    )


def safety_factor(scuffing: float, oil: float, contact: float) -> float | None:
    """S = (t_s - t_oil) / (max t_B - t_oil) (Eq. 26), temperatures in one unit; None where the rise is not positive."""
    return (scuffing - oil) / (contact - oil) if contact > oil else None


def _safety(temperatures: Temperatures, contact: ContactTemperature) -> Safety | None:
    if temperatures.scuffing is None:
        return None
    limit, oil = temperatures.scuffing, temperatures.oil
    blok, thermal = (
        None if hottest is None else safety_factor(limit, oil, hottest)
        for hottest in (contact.blok_max, contact.thermal_ehl_max)
    )
    verdict = None if blok is None else scuffing_risk(blok)
    return Safety(scuffing=limit, blok_factor=blok, thermal_ehl_factor=thermal, verdict=verdict)


def _closed_form_path(inputs: ScuffingInputs, line: FeatureLine) -> ScuffingPath:
    """Flash temperature (Eq. 25) and film (Eqs. 27, 28) along the feature line.

    A loaded point too near a base circle has neither: it is "refused". Without an oil there is no film.
    """
    pinion, wheel = inputs.distribution.pinion_material, inputs.distribution.wheel_material
    film = _film(inputs, line)
    return ScuffingPath(
        psi=line.psi,
        status=tuple(np.where(line.in_contact, "ok", np.where(line.undefined, "refused", "unloaded")).tolist()),
        blok_flash=frozen(blok_flash(inputs.distribution, line)),
        dowson_higginson=frozen(film),
        thickness_ratio=frozen(thickness_ratio(film, pinion.roughness, wheel.roughness)),
    )


def _film(inputs: ScuffingInputs, line: FeatureLine) -> FloatArray:
    """Minimum film [m] along the feature line (Eq. 27); NaN without an oil and where nothing is in contact."""
    given, lubricant, bulk = inputs.distribution, inputs.lubricant, inputs.temperatures.bulk
    film = np.full(line.psi.size, np.nan)
    if lubricant is not None and bulk is not None:
        defined = line.in_contact
        film[defined] = dowson_higginson_minimum(
            viscosity=lubricant.viscosity_at(0.0, bulk),
            pressure_viscosity=lubricant.pressure_viscosity,
            mean_speed=(line.pinion_speed[defined] + line.wheel_speed[defined]) / 2,
            radius=line.radius[defined],
            line_load=line.line_load[defined],
            modulus=reduced_modulus(given.pinion_material, given.wheel_material),
        )
    return film


def _with_thermal(inputs: ScuffingInputs, path: ScuffingPath, thermal: ThermalPath) -> ScuffingPath:
    """The path with everything the thermal EHL solution knows, its film judged instead of the formula's."""
    given = inputs.distribution
    ratio = thickness_ratio(thermal.minimum_film, given.pinion_material.roughness, given.wheel_material.roughness)
    status = tuple(
        formula if formula == "refused" else solved for formula, solved in zip(path.status, thermal.status, strict=True)
    )
    return replace(path, status=status, thickness_ratio=frozen(ratio), thermal=thermal)
