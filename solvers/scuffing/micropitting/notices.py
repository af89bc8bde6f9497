"""Warnings of the check against micropitting."""

from collections.abc import Iterator
from math import degrees

import numpy as np

from solvers.gears.pair import PathOfContact
from solvers.notices import Notice
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.micropitting.film import flash_temperature
from solvers.scuffing.micropitting.local import FlankFilm, contacts_of
from solvers.scuffing.micropitting.results import StandardFilm
from solvers.scuffing.micropitting.standard import has_relief, has_single_contact
from solvers.scuffing.thermal.flank import contact_at_points
from solvers.scuffing.thermal.practice import pitch_line_velocity
from solvers.scuffing.thermal.temperatures import HOTTEST_OIL

MODULES = (3.0, 11.0)  # mm, range of the method
SPEEDS = (8.0, 60.0)  # m/s, range of the method
LARGEST_ANGLE = 25.0  # degrees
ROUNDING = 1e-9


def range_notices(given: LoadDistributionInputs, path: PathOfContact) -> Iterator[Notice]:
    """Warn if values of the pair lie outside the ranges for which the method is known to hold."""
    pressure, helix = degrees(path.pair.working_pressure_angle), degrees(given.gears.helix_angle)
    highest = f"angles up to {LARGEST_ANGLE:g}°"
    for value, (low, high), text, allowed, field in (
        (
            given.gears.normal_module * 1e3,
            MODULES,
            "a normal module of {:.4g} mm",
            "normal modules from 3 to 11 mm",
            "module",
        ),
        (
            pitch_line_velocity(given, path),
            SPEEDS,
            "a pitch-line velocity of {:.4g} m/s",
            "pitch-line velocities from 8 to 60 m/s",
            "pinion_speed",
        ),
        (
            pressure,
            (0.0, LARGEST_ANGLE),
            "a working pressure angle of {:.4g}°",
            f"working pressure {highest}",
            "pressure_angle",
        ),
        (helix, (0.0, LARGEST_ANGLE), "a helix angle of {:.4g}°", f"helix {highest}", "helix_angle"),
    ):
        if not low - ROUNDING <= value <= high + ROUNDING:
            message = f"the method against micropitting is known to hold only for {allowed}, but the pair has "
            yield Notice("micropitting_range", message + text.format(value), field)


def standard_notices(
    given: LoadDistributionInputs, path: PathOfContact, standard: StandardFilm | None
) -> Iterator[Notice]:
    """Yield a note that says why method B gives no film; yield nothing if method B gives a film."""
    if standard is not None:
        return
    reasons = {
        "the load sharing factors of gears with tip or root relief are not known": has_relief(given),
        "method B is defined only for transverse contact ratios from 1 to 2": not has_single_contact(path),
    }
    reason = next((text for text, holds in reasons.items() if holds), None)
    if reason is not None:
        yield Notice(
            "no_standard_film", f"the film by method B cannot be computed: {reason}", "micropitting", rank="note"
        )


def hot_film_notices(film: FlankFilm, least: Peak) -> Iterator[Notice]:
    """Warn if the contact with the thinnest film is too hot for the laws of the oil."""
    points = contact_at_points(film.inputs.distribution, film.distribution, np.array([least.x]), np.array([least.y]))
    bulk = film.conditions.bulk if film.bulk is None else film.bulk(np.array([least.y]))
    contact = float(np.max(bulk + flash_temperature(film.conditions, contacts_of(points, film.conditions.modulus))))
    if contact > HOTTEST_OIL:
        message = (
            f"the contact with the thinnest film reaches {contact - 273.15:.4g} °C; above {HOTTEST_OIL - 273.15:.4g} "
            "°C the viscosity and the pressure-viscosity coefficient of the oil are extrapolated"
        )
        yield Notice("micropitting_temperature", message, "temperatures")
