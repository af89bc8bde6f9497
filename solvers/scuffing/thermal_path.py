"""The thermal EHL solution along a line of the flank: film, flash temperatures and friction under the local load."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import BoolArray, FloatArray, frozen
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.results import ContactPoints
from solvers.scuffing.safety_results import PointStatus

# What a contact is given, by the name of the scuffing input that decides it; other names are the same.
FIELDS = {
    "line_load": "power",
    "speed_1": "pinion_speed",
    "speed_2": "pinion_speed",
    "temperatures": "temperatures.bulk",
}


@dataclass(frozen=True, slots=True)
class ThermalPath:
    """Point by point: status, flash temperatures of both flanks [K], films [m], pressure [Pa], friction, film [K].

    What was not solved is NaN.
    """

    status: tuple[PointStatus, ...]
    warnings: tuple[Notice, ...]
    pinion_flash: FloatArray
    wheel_flash: FloatArray
    minimum_film: FloatArray
    central_film: FloatArray
    max_pressure: FloatArray
    friction_coefficient: FloatArray
    film_max_temperature: FloatArray


def thermal_path(inputs: ScuffingInputs, points: ContactPoints, loaded: BoolArray) -> ThermalPath:
    """Solve every loaded point of a line, each from its neighbour; oil enters at bulk temperature.

    A point outside the range of the solver is "refused", one without convergence "no_solution"; neither stops the
    others. Raises the solver's InvalidInput where it refuses every point.
    """
    contacts = {point: _contact(inputs, points, point) for point in np.flatnonzero(loaded).tolist()}
    refusals = {point: refusal for point, contact in contacts.items() if (refusal := _refusal(contact)) is not None}
    if refusals and len(refusals) == len(contacts):
        first = next(iter(refusals.values()))
        raise InvalidInput(first.code, first.message, _field(first.field))
    solvable = [point for point in contacts if point not in refusals]
    results = dict(zip(solvable, ehl.solve_path([contacts[point] for point in solvable]), strict=True))
    status: list[PointStatus] = ["unloaded"] * loaded.size
    values = np.full((7, loaded.size), np.nan)
    for point in refusals:
        status[point] = "refused"
    for point, result in results.items():
        status[point] = result.status
        if result.status != "no_solution":
            values[:, point] = _values(result)
    warnings = _notices(list(results.values()), list(refusals.values()))
    return ThermalPath(tuple(status), warnings, *(frozen(row) for row in values))


def _contact(inputs: ScuffingInputs, points: ContactPoints, point: int) -> ehl.LineContactInputs:
    given, bulk = inputs.distribution, inputs.temperatures.bulk
    return ehl.LineContactInputs(
        contact=ehl.Contact(
            line_load=float(points.line_load[point]),
            radius=float(points.radius[point]),
            speed_1=float(points.pinion_speed[point]),
            speed_2=float(points.wheel_speed[point]),
        ),
        surface_1=given.pinion_material,
        surface_2=given.wheel_material,
        lubricant=inputs.lubricant,
        temperatures=ehl.Temperatures(surface_1=bulk, surface_2=bulk, inlet=bulk),
        model=inputs.film,
    )


def _refusal(contact: ehl.LineContactInputs) -> InvalidInput | None:
    """Why the solver will not take a contact, if it will not."""
    try:
        ehl.check(contact)
    except InvalidInput as refusal:
        return refusal
    return None


def _values(result: ehl.LineContactResult) -> tuple[float | None, ...]:
    """The rows of a path, in the order of `ThermalPath`."""
    assert result.temperature is not None
    assert result.pressure is not None
    assert result.friction is not None
    return (
        result.temperature.surface_1_flash,
        result.temperature.surface_2_flash,
        result.film.minimum,
        result.film.central,
        result.pressure.maximum,
        result.friction.coefficient,
        result.temperature.film_max,
    )


def _notices(results: Sequence[ehl.LineContactResult], refusals: Sequence[InvalidInput]) -> tuple[Notice, ...]:
    """Every limit of validity once, with the number of points it concerns."""
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
    """The scuffing input behind an input of the contact."""
    return None if of_contact is None else FIELDS.get(of_contact, of_contact)
