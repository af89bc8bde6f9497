"""Guards of a solver's inputs: values outside their declared range are refused, unusual ones are warned of.

A warning names the input and the likely mistake, often a wrong unit. Each solver adds those of its inputs and results
to its warnings (`guarded`).
"""

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache, wraps
from math import cos
from typing import Any, Concatenate, NamedTuple, ParamSpec, TypeVar, cast

import numpy as np

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.notices import Notice
from solvers.quantity import UNITS, Quantity, advice, allowed, quantities

I = TypeVar("I")
P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")
Notices = Iterator[Notice]

# Chosen limits, with what lies beyond them.
THIN_AIR = 20e3  # Pa; nearly a vacuum
LEAST_MODIFICATION = 0.5e-6  # m; less cannot be ground
WIDEST_FACE = 3.0  # pitch diameters of the pinion
NARROWEST_FACE = 0.5  # modules
TALLEST_TOOTH = 4.0  # modules, of a coupling
FASTEST = 250.0  # m/s at the pitch line
HIGHEST_PRESSURE = 2.5e9  # Pa; steel flows
HIGHEST_ROOT_LOAD = 400e6  # Pa, F_t/(b m_n); the stress in the root is four times it, beyond steel's strength
LEAST_LOAD = 1e3  # N/m
THICK_OIL = 1.0  # Pa s at operating temperature
HOTTEST = 403.15  # K, of oil and teeth; mineral oils age within days
COLDEST_OIL = 243.15  # K; below the pour point of most gear oils


def guarded(
    solve: Callable[Concatenate[I, P], R], unusual: Callable[[I, R], Notices]
) -> Callable[Concatenate[I, P], R]:
    """The solver as users call it: inputs outside their declared ranges are refused, unusual values warned of.

    Raises InvalidInput (out_of_range) with the dotted name of the field, beside what the solver raises.
    """

    @wraps(solve)
    def solved(inputs: I, /, *args: P.args, **kwargs: P.kwargs) -> R:
        result = solve(checked(inputs), *args, **kwargs)
        found = tuple(unusual(inputs, result))
        if not found:
            return result
        known: Any = result
        return cast("R", replace(known, warnings=(*known.warnings, *found)))

    return solved


def checked(inputs: T, prefix: str = "") -> T:
    """The inputs, a dataclass, with every declared number inside its range.

    For inputs built in Python; those that come by HTTP have been checked on arrival. Raises `InvalidInput` with the
    code `out_of_range` and the dotted name of the first field at fault.
    """
    kind: Any = type(inputs)
    for name, ends in _ranges(kind):
        value = getattr(inputs, name)
        if value is None:
            continue
        if isinstance(value, tuple):
            for place, item in enumerate(value):
                _check(item, ends, f"{prefix}{name}.{place}")
        else:
            _check(value, ends, prefix + name)
    return inputs


class _Ends(NamedTuple):
    """The least and the greatest value allowed in SI, and the declaration that says so."""

    least: float
    greatest: float
    declared: Quantity


@cache
def _ranges(kind: Any) -> tuple[tuple[str, _Ends | None], ...]:
    """The range of every field of a dataclass, None for those without one."""
    declared = quantities(kind)
    return tuple((each.name, _ends(declared[each.name]) if each.name in declared else None) for each in fields(kind))


def _ends(declared: Quantity) -> _Ends:
    inside = {end: declared.to_si(float(bound)) for end, bound in declared.bounds.items()}
    above, below = inside.get("gt", -np.inf), inside.get("lt", np.inf)
    return _Ends(
        inside.get("ge", np.nextafter(above, np.inf)), inside.get("le", np.nextafter(below, -np.inf)), declared
    )


def _check(value: Any, ends: _Ends | None, name: str) -> None:
    if isinstance(value, float | int):
        if ends is not None and not ends.least <= value <= ends.greatest:
            unit = f" {UNITS[ends.declared.unit].symbol}" if ends.declared.unit else ""
            shown = f"{ends.declared.from_si(float(value)):.12g}{unit}"
            message = f"{name} is {shown}; permissible {allowed(ends.declared) or 'are finite numbers'}{unit}"
            message += advice(ends.declared, ends.declared.from_si(float(value)))
            raise InvalidInput("out_of_range", message, name)
    elif is_dataclass(value):
        checked(value, f"{name}.")


def unusual_value(field: str, message: str) -> Notice:
    """The warning of an unusual value of an input."""
    return Notice("unusual_value", message, field)


def thick_oil(viscosity: float | None, field: str = "lubricant.viscosity") -> Notices:
    """A viscosity [Pa s] at operating temperature that few machines run with."""
    if viscosity is not None and viscosity > THICK_OIL:
        yield unusual_value(field, f"{viscosity:.4g} Pa s at operating temperature is very thick; was mPa s meant?")


def oil_temperature(temperature: float, field: str = "temperatures.oil") -> Notices:
    """An oil [K] that is hotter or colder than gear oils are."""
    yield from tooth_temperature(temperature, field)
    if temperature < COLDEST_OIL:
        shown = f"{temperature - 273.15:g} °C"
        yield unusual_value(field, f"{shown} is colder than oils are in service; is the sign right?")


def tooth_temperature(temperature: float | None, field: str = "temperatures.bulk") -> Notices:
    """Teeth [K] that are hotter than those of gears in service, or an oil."""
    if temperature is not None and temperature > HOTTEST:
        shown = f"{temperature - 273.15:g} °C"
        yield unusual_value(field, f"{shown} is hotter than gears are in service; were degrees Fahrenheit meant?")


def hot_oil(oil: float, bulk: float | None) -> Notices:
    """Oil [K] that is hotter than the teeth [K]."""
    if bulk is not None and oil > bulk:
        message = f"the oil at {oil - 273.15:g} °C is hotter than the teeth at {bulk - 273.15:g} °C"
        message += "; are they exchanged?"
        yield unusual_value("temperatures.oil", message)


def thin_air(pressure: float) -> Notices:
    """An ambient pressure [Pa] that is nearly none."""
    if pressure < THIN_AIR:
        yield unusual_value("ambient.pressure", f"{pressure / 1e3:g} kPa is nearly a vacuum; was bar meant?")


def tall_tooth(height: float, module: float, section: str = "coupling") -> Notices:
    """A coupling's tooth [m]."""
    if height > TALLEST_TOOTH * module:
        message = f"{height * 1e3:g} mm is beyond {TALLEST_TOOTH:g} modules; is it a diameter?"
        yield unusual_value(f"{section}.tooth_height", message)


def gears(pair: GearPairInputs, pinion_speed: float | None = None) -> Notices:
    """Face width, and pitch-line velocity at a speed of the pinion [rad/s]."""
    diameter, width = pitch_diameter(pair), pair.face_width
    if width > WIDEST_FACE * diameter:
        message = f"{width * 1e3:g} mm is beyond {WIDEST_FACE:g} pitch diameters of the pinion; was cm meant?"
        yield unusual_value("gears.face_width", message)
    if width < NARROWEST_FACE * pair.module:
        yield unusual_value("gears.face_width", f"{width * 1e3:g} mm is below half a module; were cm or inches meant?")
    if pinion_speed is not None and (velocity := pinion_speed * diameter / 2) > FASTEST:
        message = f"the pitch-line velocity is {velocity:.4g} m/s, beyond {FASTEST:g}"
        message += "; is it the speed of another shaft?"
        yield unusual_value("pinion_speed", message)


def modifications(depths: dict[str, float], curve: tuple[float, ...] = ()) -> Notices:
    """Depths of modifications by name, and gaps of a lead curve [m]."""
    for name, value in depths.items():
        if 0.0 < abs(value) < LEAST_MODIFICATION:
            message = f"{value * 1e6:g} µm is less than can be ground; was mm meant?"
            yield unusual_value(f"modifications.{name}", message)
    highest = max(map(abs, curve), default=0.0)
    if 0.0 < highest < LEAST_MODIFICATION:
        message = f"{highest * 1e6:g} µm is less than can be ground; was mm meant?"
        yield unusual_value("modifications.lead_curve.gap", message)


def high_pressure(pressure: float | None, field: str = "pinion_torque") -> Notices:
    """A Hertzian pressure [Pa]."""
    if pressure is not None and pressure > HIGHEST_PRESSURE:
        message = (
            f"the Hertzian pressure of {pressure / 1e6:.4g} MPa is beyond what steel carries; is the load too high?"
        )
        yield unusual_value(field, message)


def tooth_load(pair: GearPairInputs, torque: float, line_load: float) -> Notices:
    """The transmitted torque of the pinion [N m] and the largest line load [N/m]."""
    root = 2 * torque / pitch_diameter(pair) / (pair.face_width * pair.module)
    if root > HIGHEST_ROOT_LOAD:
        message = f"the tooth force of {root / 1e6:.4g} N per mm of face and module breaks a tooth of steel"
        message += "; were W or N mm meant?"
        yield unusual_value("pinion_torque", message)
    if 0.0 < line_load < LEAST_LOAD:
        message = f"the line load is {line_load / 1e3:.3g} N/mm at most; were kW or kN m meant?"
        yield unusual_value("pinion_torque", message)


def pitch_diameter(pair: GearPairInputs) -> float:
    """Reference diameter of the pinion [m]."""
    transverse = 1.0 if pair.module_plane == "transverse" else cos(pair.helix_angle)
    return pair.module / transverse * pair.pinion.teeth
