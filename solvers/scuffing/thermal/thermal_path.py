"""The thermal EHL solution along lines of the flank: film, flash temperatures and friction under the local load."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import NamedTuple

import numpy as np

from solvers.arrays import frozen
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.results import ContactPoints
from solvers.scuffing.safety_results import PointStatus, ThermalPath

# Maps an input of the line contact to the scuffing input that determines its value. The inputs that are not listed have
# the same name in the line contact and in the scuffing check.
FIELDS = {
    "line_load": "power",
    "speed_1": "pinion_speed",
    "speed_2": "pinion_speed",
    "temperatures": "temperatures.bulk",
}

CURVES = tuple(item.name for item in fields(ThermalPath) if item.name != "status")


class SolvedLine(NamedTuple):
    """The solution along a line, the results of all points solved under their own load, and what refused the others."""

    path: ThermalPath
    results: list[ehl.LineContactResult]
    refusals: list[InvalidInput]


def solve_line(inputs: ScuffingInputs, points: ContactPoints) -> SolvedLine:
    """Solve the thermal EHL contact at those points of a line at which the flanks are in contact.

    The oil enters the contact at the bulk temperature. If a heat balance gives pinion and wheel different bulk
    temperatures, each surface has the bulk temperature of its gear. A point outside the range of the solver gets the
    status "refused", and a point without convergence gets the status "no_solution". If the load at a point is too light
    for the solver, the point is solved under the lightest load that the solver accepts; this solution gives bounds for
    flash temperature and film.
    """
    contacts = {point: contact_at(inputs, points, point) for point in np.flatnonzero(points.in_contact).tolist()}
    refusals = {point: refusal for point, contact in contacts.items() if (refusal := _refusal(contact)) is not None}
    light = {point: ehl.lightest(contacts[point]) for point, why in refusals.items() if why.code == "load_range"}
    solvable = {
        point: contact for point, contact in (contacts | light).items() if point in light or point not in refusals
    }
    results = dict(zip(solvable, ehl.solve_path(list(solvable.values())), strict=True))
    status: list[PointStatus] = ["unloaded"] * points.line_load.size
    curves = {name: np.full(points.line_load.size, np.nan) for name in CURVES}
    for point, result in results.items():
        status[point] = result.status
        if result.status != "no_solution":
            for name, value in (_bounds(result) if point in light else _values(result)).items():
                curves[name][point] = value
    for point in refusals:
        status[point] = "refused"
    path = ThermalPath(tuple(status), **{name: frozen(values) for name, values in curves.items()})
    own = [result for point, result in results.items() if point not in light]
    return SolvedLine(path, own, list(refusals.values()))


def joined(paths: Sequence[ThermalPath]) -> ThermalPath:
    """Return the points of several paths, one after the other, as one path."""
    status = tuple(outcome for path in paths for outcome in path.status)
    return ThermalPath(
        status, **{name: frozen(np.concatenate([getattr(path, name) for path in paths])) for name in CURVES}
    )


def solver_notices(lines: Sequence[SolvedLine]) -> tuple[Notice, ...]:
    """Return every warning of the solver once, with the number of points to which it applies.

    Raises InvalidInput: the error of the solver if the solver refuses every point.
    """
    results = [result for line in lines for result in line.results]
    refusals = [refusal for line in lines for refusal in line.refusals]
    if refusals and not results:
        raise InvalidInput(refusals[0].code, refusals[0].message, _field(refusals[0].field))
    return _notices(results, refusals)


def contact_at(inputs: ScuffingInputs, points: ContactPoints, point: int) -> ehl.LineContactInputs:
    """Return the inputs of the line contact at the point with the index `point`.

    The oil and the bulk temperature must be known.
    """
    given, temperatures, lubricant = inputs.distribution, inputs.temperatures, inputs.lubricant
    assert temperatures.bulk is not None
    assert temperatures.surfaces is not None
    assert lubricant is not None
    surface_1, surface_2 = temperatures.surfaces
    return ehl.LineContactInputs(
        contact=ehl.Contact(
            line_load=float(points.line_load[point]),
            radius=float(points.radius[point]),
            speed_1=float(points.pinion_speed[point]),
            speed_2=float(points.wheel_speed[point]),
        ),
        surface_1=given.pinion_material,
        surface_2=given.wheel_material,
        lubricant=lubricant,
        temperatures=ehl.Temperatures(surface_1=surface_1, surface_2=surface_2, inlet=temperatures.bulk),
        model=inputs.film,
    )


def _refusal(contact: ehl.LineContactInputs) -> InvalidInput | None:
    """Return the error with which the solver refuses a contact; None if the solver accepts the contact."""
    try:
        ehl.check(contact)
    except InvalidInput as refusal:
        return refusal
    return None


def _values(result: ehl.LineContactResult) -> dict[str, float | None]:
    """Return the values of a solved point, by the names of the curves in `ThermalPath`."""
    assert result.temperature is not None
    assert result.pressure is not None
    assert result.friction is not None
    return {
        "pinion_flash": result.temperature.surface_1_flash,
        "wheel_flash": result.temperature.surface_2_flash,
        "minimum_film": result.film.minimum,
        "central_film": result.film.central,
        "max_pressure": result.pressure.maximum,
        "friction_coefficient": result.friction.coefficient,
        "film_max_temperature": result.temperature.film_max,
    }


def _bounds(result: ehl.LineContactResult) -> dict[str, float | None]:
    """Return bounds of flash temperature and film for a point whose load is too light for the solver.

    `result` is the solution at this point under the lightest load that the solver accepts.
    """
    assert result.temperature is not None
    flash = max(result.temperature.surface_1_flash, result.temperature.surface_2_flash)
    return {"flash_bound": flash, "film_bound": result.film.minimum}


def _notices(results: Sequence[ehl.LineContactResult], refusals: Sequence[InvalidInput]) -> tuple[Notice, ...]:
    """Return every warning once, with the number of points to which the warning applies."""
    points: dict[str, int] = {}
    first: dict[str, Notice] = {}
    notices = [notice for result in results for notice in result.warnings]
    notices += [Notice(refusal.code, refusal.message, refusal.field) for refusal in refusals]
    for notice in notices:
        points[notice.code] = points.get(notice.code, 0) + 1
        first.setdefault(notice.code, notice)
    count = len(results) + len(refusals)
    return tuple(
        replace(notice, message=f"at {points[code]} of {count} points: {notice.message}", field=_field(notice.field))
        for code, notice in first.items()
    )


def _field(of_contact: str | None) -> str | None:
    """Convert the name of an input of the line contact into the name of the scuffing input from which it follows."""
    return None if of_contact is None else FIELDS.get(of_contact, of_contact)
