"""Checks of the inputs and results of the coupling model."""

from itertools import pairwise
from math import inf, isfinite, radians

from solvers.coupling.inputs import CouplingInputs, MixedFrictionCurve, MixedFrictionTable
from solvers.coupling.lubrication import FilmState
from solvers.coupling.results import Geometry
from solvers.errors import InvalidInput

MAX_MISALIGNMENT = radians(6.0)
LEAST_TORQUE = 1e-6  # N m, chosen: counts as none
MAX_CONTACT_PRESSURE = 2e9  # Pa, chosen: the model is elastic, hardened steel yields near it
MAX_CONTACT_WIDTH = 0.1
"""Half contact width over flank radius beyond which a cylinder is no half space."""


def check_inputs(inputs: CouplingInputs) -> None:
    """Raise InvalidInput for what cannot be computed: out_of_range, pitch_errors_length, mixed_law, mixed_curve."""
    if not abs(inputs.operation.misalignment) <= MAX_MISALIGNMENT:
        raise InvalidInput(
            "out_of_range", "the theory is one of small angles; keep the misalignment within 6 degrees", "misalignment"
        )
    if 0.0 < inputs.operation.torque < LEAST_TORQUE:
        raise InvalidInput("out_of_range", f"a torque below {LEAST_TORQUE:g} N m is none; give 0 or more", "torque")
    _check_pitch_errors(inputs)
    if isinstance(inputs.friction.law, MixedFrictionTable):
        _check_mixed_table(inputs.friction.law)
    else:
        _check_mixed_curve(inputs.friction.law)


def _check_pitch_errors(inputs: CouplingInputs) -> None:
    """One finite pitch error a tooth."""
    errors = inputs.coupling.pitch_errors
    if errors is None:
        return
    if len(errors) != inputs.coupling.teeth:
        raise InvalidInput(
            "pitch_errors_length", f"give one pitch error a tooth: {inputs.coupling.teeth}", "pitch_errors"
        )
    if not all(isfinite(error) for error in errors):
        raise InvalidInput("out_of_range", "pitch errors must be finite", "pitch_errors")


def _check_mixed_curve(law: MixedFrictionCurve) -> None:
    """Positive numbers, the lowest coefficient not above the highest."""
    if law.lowest > law.highest:
        raise InvalidInput("mixed_curve", "the lowest coefficient must not exceed the highest", "lowest")


def _check_mixed_table(law: MixedFrictionTable) -> None:
    """Positive coefficients over rising velocities >= 0; one point is a constant."""
    velocities, coefficients = law.sliding_velocity, law.coefficient
    rising = all(a < b for a, b in pairwise(velocities))
    if len(velocities) != len(coefficients) or not velocities or not rising or not velocities[0] >= 0.0:
        raise InvalidInput(
            "mixed_law", "the table needs rising velocities from 0 up and one coefficient each", "mixed_law"
        )
    if not isfinite(velocities[-1]) or not all(0.0 < coefficient < inf for coefficient in coefficients):
        raise InvalidInput("mixed_law", "velocities must be finite, coefficients positive and finite", "mixed_law")


def check_contact(film: FilmState, geometry: Geometry) -> None:
    """Raise InvalidInput hertz_pressure (> 2 GPa) or contact_width (a_HZ > 0.1 R_e)."""
    if film.contact_pressure > MAX_CONTACT_PRESSURE:
        raise InvalidInput(
            "hertz_pressure",
            f"the Hertz pressure of {film.contact_pressure / 1e9:.3g} GPa exceeds 2 GPa; lower the torque",
            "torque",
        )
    if film.contact_half_width > MAX_CONTACT_WIDTH * geometry.normal_flank_radius:
        raise InvalidInput(
            "contact_width",
            "the contact is wider than a tenth of the flank radius; raise the crowning ratio",
            "crowning_ratio",
        )
