"""Checks of the inputs and results of the coupling model."""

from itertools import pairwise
from math import inf, isfinite, pi, radians

from solvers.coupling.inputs import CouplingInputs, MixedFrictionCurve, MixedFrictionTable
from solvers.coupling.lubrication import FilmState
from solvers.coupling.results import Geometry
from solvers.errors import InvalidInput

MAX_MISALIGNMENT = radians(6.0)
LEAST_TORQUE = 1e-6  # N m, chosen: counts as none
MAX_CONTACT_PRESSURE = 2e9  # Pa, chosen: the model is elastic, hardened steel yields near it
MAX_CONTACT_WIDTH = 0.1
"""Half contact width over flank radius beyond which a cylinder is no half space."""

# field, lower bound, whether the bound itself is allowed, upper bound (excluded)
_Range = tuple[str, float, bool, float]
_COUPLING_RANGES: tuple[_Range, ...] = (
    ("teeth", 6, True, inf),
    ("module", 0.0, False, inf),
    ("face_width", 0.0, False, inf),
    ("tooth_height", 0.0, False, inf),
    ("pressure_angle", 0.0, False, pi / 4),
    ("crowning_ratio", 0.2, True, inf),
    ("hub_distance", 0.0, False, inf),
    ("tooth_stiffness", 0.0, False, inf),
    ("sleeve_mass", 0.0, False, inf),
    ("youngs_modulus", 0.0, False, inf),
    ("poisson_ratio", 0.0, True, 0.5),
)
_OPERATION_RANGES: tuple[_Range, ...] = (
    ("torque", 0.0, True, inf),
    ("speed", -inf, False, inf),
    ("axial_velocity", -inf, False, inf),
    ("shaft_diameter", 0.0, False, inf),
)
_LUBRICANT_RANGES: tuple[_Range, ...] = (("viscosity", 0.0, False, inf), ("reference_film", 0.0, False, inf))
_FRICTION_RANGES: tuple[_Range, ...] = (("coefficient", 0.0, True, inf), ("static_coefficient", 0.0, True, inf))
_CURVE_RANGES: tuple[_Range, ...] = (
    ("highest", 0.0, False, inf),
    ("lowest", 0.0, False, inf),
    ("velocity", 0.0, False, inf),
)
_MODEL_RANGES: tuple[_Range, ...] = (
    ("inlet_length", 0.0, False, inf),
    ("film_angle", -inf, False, inf),
    ("rotor_angle", -inf, False, inf),
    ("simple_thrust_factor", 0.0, True, inf),
)


def check_inputs(inputs: CouplingInputs) -> None:
    """Raise InvalidInput for what cannot be computed: out_of_range, pitch_errors_length, mixed_law, mixed_curve."""
    _check_ranges(inputs.coupling, _COUPLING_RANGES)
    _check_ranges(inputs.operation, _OPERATION_RANGES)
    _check_ranges(inputs.lubricant, _LUBRICANT_RANGES)
    _check_ranges(inputs.friction, _FRICTION_RANGES)
    _check_ranges(inputs.model, _MODEL_RANGES)
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


def _check_ranges(group: object, ranges: tuple[_Range, ...]) -> None:
    """Raise InvalidInput out_of_range for a number that is not finite or outside its range; None passes."""
    for name, low, inclusive, high in ranges:
        value = getattr(group, name)
        if value is None:
            continue
        if not (isfinite(value) and (low <= value if inclusive else low < value) and value < high):
            bound = f"at least {low:g}" if inclusive else f"above {low:g}"
            below = f" and below {high:g}" if high < inf else ""
            raise InvalidInput("out_of_range", f"{name} must be finite, {bound}{below} in SI units", name)


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
    _check_ranges(law, _CURVE_RANGES)
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
