"""Scuffing of a loaded pair over the whole flank: contact temperature and film thickness, compared with limits.

The closed forms are Blok's flash temperature (Eq. 25) and Dowson and Higginson's film (Eq. 27). The thermal EHL
solution is computed at the places that decide, along the paper's feature line, and along the profile line through the
hottest place.
"""

from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.film import thickness_ratio
from solvers.errors import InvalidInput
from solvers.heat_balance import Heat, cooling_in_force
from solvers.lubricants import OilInUse, oil_in_use
from solvers.oils import OilSheet
from solvers.scuffing.contact_slices import Peak, reaches_base_circle
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs, ScuffingTest, Temperatures
from solvers.scuffing.load_factors.method_b import film_grade, standard_grade
from solvers.scuffing.micropitting.check import CheckedFlank, check_micropitting
from solvers.scuffing.micropitting.wear import wear_asked_for
from solvers.scuffing.model import solve
from solvers.scuffing.results import ContactPoints, Derived, LoadDistribution
from solvers.scuffing.safety_results import (
    BulkInForce,
    ContactTemperature,
    Film,
    Flash,
    Safety,
    Scuffing,
    ScuffingDerived,
    ScuffingPath,
    ThermalPath,
)
from solvers.scuffing.standard.check import check_by_standard, standard_notices
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.bulk import BulkRule
from solvers.scuffing.thermal.flank import (
    SURVEY_POINTS,
    ContactFunction,
    contact_at_points,
    find_hottest,
    find_thinnest,
    formula_film,
)
from solvers.scuffing.thermal.misalignment import misalignment_left_out
from solvers.scuffing.thermal.places import Places, solve_places
from solvers.scuffing.thermal.practice import scuffing_risk
from solvers.scuffing.thermal.temperatures import in_force, oil_notices
from solvers.scuffing.thermal.thermal_path import SolvedLine, solve_line, solver_notices
from solvers.scuffing.thermal.verdict import (
    CheckedLine,
    SolvedContacts,
    hotter_surface,
    largest_flash,
    path_notices,
    thinnest_film,
    unknown_points,
    without_thermal,
)

SAME = 1e-9  # fractions of the path that differ by less are one; mirror images differ by rounding


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Compute the load distribution of a pair, of two helices that of one, and check it against scuffing (Eq. 16).

    Raises InvalidInput `exclusive` if a bulk temperature is given although `bulk_method` is "estimated"; the errors of
    `model.solve` and of `in_force`; the error of the thermal EHL solver if this solver refuses every point.
    """
    if inputs.temperatures.bulk_method == "estimated" and inputs.temperatures.bulk is not None:
        message = (
            "a bulk temperature is given, but bulk_method is 'estimated'; set bulk_method to 'given', or leave the "
            "bulk temperature out"
        )
        raise InvalidInput("exclusive", message, "temperatures.bulk_method")
    asked = inputs
    inputs, distribution, flash_map, heat, rule, ran = in_force(inputs, solve(inputs.distribution))
    given, bulk = inputs.distribution, inputs.temperatures.bulk
    whole = inputs.line == "flank"
    hottest = find_hottest(given, distribution, flash_map) if whole else None
    film_at = formula_film(inputs)
    thinnest = find_thinnest(given, distribution, flash_map, film_at) if whole else None
    warnings = (*distribution.warnings, *oil_notices(inputs, distribution.path_of_contact, ran))
    places: Places | None = None
    solved: list[SolvedLine] = []
    thermal = inputs.lubrication == "thermal_ehl" and inputs.lubricant is not None
    if thermal and thinnest is not None:
        surfaces = partial(_surfaces, inputs.temperatures)
        places = solve_places(inputs, distribution, flash_map, film_at, (hottest, thinnest), surfaces)
    lines = _lines(inputs, distribution, (places and places.hottest()) or hottest, film_at)
    paths = [_closed_form_path(inputs, line) for line in lines]
    if thermal:
        solved = [solve_line(inputs, line.points) for line in lines]
        paths = [_with_thermal(inputs, path, line.path) for path, line in zip(paths, solved, strict=True)]
        warnings += solver_notices(solved if places is None else [places.solved, *solved])
    length = distribution.path_of_contact.length
    deciding = None
    if places is not None:
        deciding = SolvedContacts(places.x / length, places.y, places.solved.path)
    elif solved:
        deciding = SolvedContacts(lines[0].psi, lines[0].face, solved[0].path)
    unknown = 0 if deciding is None else unknown_points(deciding.path, _surfaces(inputs.temperatures, deciding.face))
    feature = CheckedLine(paths[0], lines[0].face)
    flash = largest_flash(feature, hottest, deciding, length)
    film = thinnest_film(feature, thinnest, deciding, length, given)
    if reaches_base_circle(distribution.balance.survey):
        flash, film = Flash(None, None), Film()
    elif unknown:
        flash, film = without_thermal(flash, film)
    if given.friction_coefficient is None and np.isnan(flash_map.flash).any():
        flash = Flash(None, None)  # otherwise the flash temperature of a line without contact would be 0
    status = [outcome for path in paths for outcome in path.status] + list(places.solved.path.status if places else ())
    flash = replace(flash, friction_coefficient=inputs.distribution.friction_coefficient)
    micropitting = check_micropitting(inputs, distribution, flash_map, film.thermal_ehl_min)
    paths = [_with_film_ratio(micropitting, *both) for both in zip(paths, lines, strict=True)]
    contact = None if bulk is None else _contact_temperature(inputs.temperatures, bulk, flash, deciding)
    safety = _safety(inputs, distribution, asked.temperatures.scuffing_test, contact, flash)
    if heat is not None:
        heat, safety = _with_band(inputs.temperatures, rule, heat, flash, safety)
    return Scuffing(
        distribution=distribution,
        flash=flash,
        contact_temperature=contact,
        film=None if inputs.lubricant is None else film,
        safety=safety,
        path=paths[0],
        hottest_path=paths[1] if len(paths) > 1 else None,
        micropitting=micropitting.answer,
        wear=wear_asked_for(inputs.micropitting, distribution),
        heat=heat,
        flank_flash=frozen(flash_map.flash[flash_map.mapped]),
        flank_film_ratio=None if micropitting.ratio is None else frozen(micropitting.ratio),
        derived=_derived(inputs, distribution.derived, heat, ran),
        warnings=warnings
        + misalignment_left_out(asked, distribution, safety)
        + (() if heat is None else heat.warnings)
        + micropitting.warnings
        + tuple(standard_notices(given, None if safety is None else safety.standard))
        + path_notices(distribution, paths[0], status, contact, safety, unknown),
        unsolved_points=status.count("no_solution") + status.count("refused"),
    )


class _Line(NamedTuple):
    """Points of a line over the flank, with Blok's flash temperature [K] and Dowson and Higginson's film [m].

    `psi` is the fraction of the path from A, and `face` is the distance from the end that meshes first [m].
    """

    psi: FloatArray
    face: FloatArray
    points: ContactPoints
    flash: FloatArray
    film: FloatArray


def _line_at(
    given: LoadDistributionInputs,
    distribution: LoadDistribution,
    film_at: ContactFunction,
    psi: FloatArray,
    face: float | None = None,
) -> _Line:
    """Return the profile line at the face position `face` [m], or the feature line if `face` is None."""
    plane = distribution.path_of_contact.plane
    across = psi * plane.face_width if face is None else np.full(psi.size, face)
    points = contact_at_points(given, distribution, psi * plane.path_length, across)
    return _Line(frozen(psi), frozen(across), points, blok_flash(given, points), film_at(points))


def _lines(
    inputs: ScuffingInputs, distribution: LoadDistribution, hottest: Peak | None, film_at: ContactFunction
) -> list[_Line]:
    """Return the feature line and, if there is a hottest place, the profile line through it.

    Points are added to the equidistant points of a line, so that the extremes do not depend on the number of points. On
    the profile line, the hottest place is added. On the feature line, up to three points are added: the hottest point,
    the point with the thinnest film (Dowson and Higginson), and a loaded point that is too near a base circle.
    """
    line_at = partial(_line_at, inputs.distribution, distribution, film_at)
    even = np.linspace(0.0, 1.0, inputs.path_points)
    survey = line_at(np.linspace(0.0, 1.0, SURVEY_POINTS))
    added = [
        survey.psi[extreme(curve)]
        for curve, extreme in ((survey.flash, np.nanargmax), (survey.film, np.nanargmin))
        if np.isfinite(curve[survey.points.in_contact]).any()
    ]
    if survey.points.undefined.any():
        added.append(survey.psi[np.argmax(survey.points.undefined)])
    feature = line_at(_joined(even, added))
    if hottest is None or hottest.value == 0.0:
        return [feature]
    psi = hottest.x / distribution.path_of_contact.length
    return [feature, line_at(_joined(even, [psi]), hottest.y)]


def _joined(even: FloatArray, added: list[float]) -> FloatArray:
    """Return both kinds of points in order; an added point replaces one that differs from it by rounding only."""
    apart = [place for place in even if all(abs(place - other) > SAME for other in added)]
    return np.unique([*apart, *added])


def _surfaces(temperatures: Temperatures, face: FloatArray) -> FloatArray:
    """Return the bulk temperatures [K] at points of the face; row 0 is the pinion, and row 1 is the wheel."""
    return np.broadcast_to(np.array(temperatures.surfaces)[:, None], (2, face.size))


def _contact_temperature(
    temperatures: Temperatures, bulk: float, flash: Flash, deciding: SolvedContacts | None
) -> ContactTemperature:
    """Return the largest contact temperatures [K], which are sums of bulk and flash temperature.

    Blok's flash temperature is added to the mean bulk temperature `bulk`. The thermal EHL solution has one flash
    temperature for the pinion and one for the wheel. Each of these two flash temperatures is added to the bulk
    temperature of the same gear.
    """
    thermal = None
    if deciding is not None and flash.thermal_ehl_max is not None:
        thermal = float(np.nanmax(hotter_surface(deciding.path, _surfaces(temperatures, deciding.face))))
    return ContactTemperature(
        bulk=bulk, blok_max=None if flash.blok_max is None else bulk + flash.blok_max, thermal_ehl_max=thermal
    )


def _with_band(
    temperatures: Temperatures, rule: BulkRule, heat: Heat, flash: Flash, safety: Safety | None
) -> tuple[Heat, Safety | None]:
    """Add the ranges of bulk temperature and safety factor to `heat.band`; base the verdict on the lower end."""
    bulks = [bulk for flanks in heat.flank_cases if (bulk := rule.bulk(flanks)) is not None]
    if heat.band is None or not bulks:
        return heat, safety
    band = replace(heat.band, bulk=(min(bulks), max(bulks)))
    if safety is None or safety.blok_factor is None or flash.blok_max is None:
        return replace(heat, band=band), safety
    least, greatest = (
        safety_factor(safety.scuffing, temperatures.oil, bulk + flash.blok_max) for bulk in (max(bulks), min(bulks))
    )
    if least is None:
        return replace(heat, band=band), safety
    if greatest is not None:  # else the contact may be as cool as the oil, and the range has no upper end
        band = replace(band, safety=(least, greatest))
    return replace(heat, band=band), replace(safety, verdict=scuffing_risk(least))


def _derived(inputs: ScuffingInputs, mesh: Derived, heat: Heat | None, ran: BulkInForce) -> ScuffingDerived:
    """Return the values of mesh, oil and cooling that follow from the inputs."""
    sheet = inputs.oil if isinstance(inputs.oil, OilSheet) else None
    return ScuffingDerived(
        mesh=mesh,
        oil=None if inputs.lubricant is None else OilInUse(**oil_in_use(inputs.lubricant)),
        kinematic_viscosity_100=None if sheet is None else sheet.kinematic_viscosity_100,
        density_15=None if sheet is None else sheet.reference_density,
        lubricant_factor=inputs.temperatures.lubricant_factor,
        bulk=ran,
        standard=standard_grade(inputs),
        cooling=None if heat is None else cooling_in_force(inputs.cooling, heat),
        micropitting=film_grade(inputs),
    )


def safety_factor(scuffing: float, oil: float, contact: float) -> float | None:
    """Compute the safety factor against scuffing.

    S = (t_s - t_oil) / (max t_B - t_oil) (Eq. 26). Returns safety factor S [-]; None if the contact is not hotter than
    the oil.
    """
    return (scuffing - oil) / (contact - oil) if contact > oil else None


def _safety(
    inputs: ScuffingInputs,
    distribution: LoadDistribution,
    test: ScuffingTest | None,
    contact: ContactTemperature | None,
    flash: Flash,
) -> Safety | None:
    """Return the safety factors by Blok, by thermal EHL and by the standard; None without a temperature to compare.

    The factor by Blok is computed twice: for the whole flank, and for the feature line alone. `test` is the scuffing
    test as asked: the standard has its own X_L.
    """
    limit, oil = inputs.temperatures.scuffing, inputs.temperatures.oil
    if limit is None or contact is None:
        return None
    on_line = None if flash.feature_line_max is None else contact.bulk + flash.feature_line_max
    blok, feature, thermal = (
        None if hottest is None else safety_factor(limit, oil, hottest)
        for hottest in (contact.blok_max, on_line, contact.thermal_ehl_max)
    )
    return Safety(
        scuffing=limit,
        blok_factor=blok,
        feature_line_factor=feature,
        thermal_ehl_factor=thermal,
        verdict=None if blok is None else scuffing_risk(blok),
        standard=check_by_standard(inputs, distribution, test),
    )


def _closed_form_path(inputs: ScuffingInputs, line: _Line) -> ScuffingPath:
    """Return flash temperature (Eq. 25) and film (Eqs. 27, 28) along a line.

    If a loaded point is too near a base circle, it has no flash temperature and no film, and its status is "refused".
    If no oil is given, no point has a film.
    """
    pinion, wheel, points = inputs.distribution.pinion_material, inputs.distribution.wheel_material, line.points
    return ScuffingPath(
        psi=line.psi,
        status=tuple(np.where(points.in_contact, "ok", np.where(points.undefined, "refused", "unloaded")).tolist()),
        blok_flash=frozen(line.flash),
        dowson_higginson=frozen(line.film),
        thickness_ratio=frozen(thickness_ratio(line.film, pinion.roughness, wheel.roughness)),
    )


def _with_thermal(inputs: ScuffingInputs, path: ScuffingPath, thermal: ThermalPath) -> ScuffingPath:
    """Add the thermal EHL solution to a path, and recompute the thickness ratio with the film by thermal EHL."""
    given = inputs.distribution
    ratio = thickness_ratio(thermal.minimum_film, given.pinion_material.roughness, given.wheel_material.roughness)
    status = tuple(
        formula if formula == "refused" else thermal_status
        for formula, thermal_status in zip(path.status, thermal.status, strict=True)
    )
    return replace(path, status=status, thickness_ratio=frozen(ratio), thermal=thermal)


def _with_film_ratio(flank: CheckedFlank, path: ScuffingPath, line: _Line) -> ScuffingPath:
    """Add the film ratio of the micropitting check to a path, if this check has computed a film."""
    if flank.film is None:
        return path
    return replace(path, micropitting_ratio=frozen(flank.film.ratio(line.points, line.face)))
