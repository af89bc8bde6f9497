"""Declarations of quantities (title, symbol, source, unit, range) on the dataclass fields that hold them.

    @record
    class Coupling:
        face_width: float = quantity("face width", "b", "ISO 21771", unit="mm", ge=0.1, le=2000, tolerance=0.1)

The attribute is in SI; range, default and tolerance of the declaration are in the unit in which the quantity is shown.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cache, partial
from math import pi
from typing import Any, Literal, NamedTuple, TypeVar, dataclass_transform, get_type_hints, overload

import numpy as np

Detail = Literal["summary", "curves", "fields"]
T = TypeVar("T")
_KEY = "quantity"


class Unit(NamedTuple):
    """A unit in which a quantity is shown: SI value = scale × value + offset; `symbol` is how it is written."""

    symbol: str
    scale: float
    offset: float = 0.0

    def to_si(self, value: Any) -> Any:
        """A number or an array in SI."""
        return value * self.scale + self.offset

    def from_si(self, value: Any) -> Any:
        """A number or an array of SI in this unit."""
        return (value - self.offset) / self.scale


UNITS = {
    "mm": Unit("mm", 1e-3),
    "mm2": Unit("mm²", 1e-6),
    "mm2_per_s": Unit("mm²/s", 1e-6),
    "m2": Unit("m²", 1.0),
    "l_per_min": Unit("l/min", 1e-3 / 60),
    "um": Unit("µm", 1e-6),
    "um_per_million": Unit("µm per million turns", 1e-12),
    "mm3_per_n_m": Unit("mm³/(N m)", 1e-9),
    "deg": Unit("°", pi / 180),
    "mrad": Unit("mrad", 1e-3),
    "s": Unit("s", 1.0),
    "rpm": Unit("1/min", pi / 30),
    "hz": Unit("Hz", 1.0),
    "m_per_s": Unit("m/s", 1.0),
    "mm_per_s": Unit("mm/s", 1e-3),
    "kg": Unit("kg", 1.0),
    "g_per_s": Unit("g/s", 1e-3),
    "g_per_mol": Unit("g/mol", 1e-3),
    "n": Unit("N", 1.0),
    "n_m": Unit("N m", 1.0),
    "n_per_mm": Unit("N/mm", 1e3),
    "n_per_um": Unit("N/µm", 1e6),
    "n_per_mm_um": Unit("N/(mm µm)", 1e9),
    "n_m_per_rad": Unit("N m/rad", 1.0),
    "mpa": Unit("MPa", 1e6),
    "kpa": Unit("kPa", 1e3),
    "gpa": Unit("GPa", 1e9),
    "per_gpa": Unit("1/GPa", 1e-9),
    "per_k": Unit("1/K", 1.0),
    "pa_s": Unit("Pa s", 1.0),
    "w": Unit("W", 1.0),
    "kw": Unit("kW", 1e3),
    "j": Unit("J", 1.0),
    "w_per_mm": Unit("W/mm", 1e3),
    "w_per_mm2": Unit("W/mm²", 1e6),
    "c": Unit("°C", 1.0, 273.15),
    "k": Unit("K", 1.0),
    "kg_per_m3": Unit("kg/m³", 1.0),
    "j_per_kg_k": Unit("J/(kg K)", 1.0),
    "w_per_m_k": Unit("W/(m K)", 1.0),
    "w_per_m2_k": Unit("W/(m² K)", 1.0),
    "w_per_k": Unit("W/K", 1.0),
}
"""By the suffix that names of the HTTP interface carry."""


@dataclass(frozen=True)
class Quantity:
    """The declaration of one field.

    Parameters
    ----------
    title
        Label that stands alone.
    symbol, source
        Of the field's literature.
    text
        Description, where the title does not suffice.
    unit
        Key of `UNITS`; None for what has no unit.
    ge, gt, le, lt
        Range of an input.
    default
        Of an input or of an option; `...` where there is none.
    default_text
        What None stands for.
    assumed
        Reason behind a default that is ours and not the paper's; a result that rests on the default lists it.
    advanced
        An option of model or resolution.
    folded
        An input that few users know: a form shows it on demand.
    tolerance, relative_tolerance
        What manufacture or measurement usually leaves open, in the shown unit; and as a share of the value where that
        is more. Every input that may be zero has a tolerance, by which a sensitivity moves it.
    if_above, if_negative
        What to give instead of a value above the range, or of text; and instead of a negative one.
    length
        Least and largest number of values of a list.
    detail
        Least level of detail at which a result holds the field.
    axis
        Field over which a curve runs, or the two of a map; a dotted name starts at the whole result.
    index
        What the places of a list mean where no field says it.
    gaps
        NaN inside an array marks a point without a value.

    """

    title: str
    symbol: str | None = None
    source: str | None = None
    text: str | None = None
    unit: str | None = None
    ge: float | None = None
    gt: float | None = None
    le: float | None = None
    lt: float | None = None
    default: Any = ...
    default_text: str | None = None
    assumed: str | None = None
    advanced: bool = False
    folded: bool = False
    tolerance: float | None = None
    relative_tolerance: float | None = None
    if_above: str | None = None
    if_negative: str | None = None
    length: tuple[int, int] | None = None
    detail: Detail = "summary"
    axis: str | tuple[str, str] | None = None
    index: str | None = None
    gaps: bool = False

    @property
    def bounds(self) -> dict[str, float]:
        """The ends of the range by name, those there are."""
        return {name: end for name in ("ge", "gt", "le", "lt") if (end := getattr(self, name)) is not None}

    def to_si(self, value: Any) -> Any:
        """A number, or a list of them, in SI; what is no number passes unchanged."""
        return converted(value, UNITS[self.unit].to_si) if self.unit else value

    def from_si(self, value: Any) -> Any:
        """A number, or a list of them, in the shown unit."""
        return converted(value, UNITS[self.unit].from_si) if self.unit else value


def quantity(
    title: str,
    symbol: str | None = None,
    source: str | None = None,
    *,
    default: Any = ...,
    default_factory: Callable[[], Any] | None = None,
    kw_only: bool = False,
    **known: Any,
) -> Any:
    """A dataclass field with its `Quantity`; the default is given in the shown unit and held in SI."""
    declared = Quantity(title, symbol, source, default=default, **known)
    options: dict[str, Any] = {"metadata": {_KEY: declared}}
    if kw_only:
        options["kw_only"] = True
    if default_factory is not None:
        options["default_factory"] = default_factory
    elif default is not ...:
        options["default"] = declared.to_si(default)
    made: Any = field(**options)
    return made


def computed(title: str, symbol: str | None = None, source: str | None = None, **known: Any) -> Callable[[T], T]:
    """Declare a value that a dataclass computes when asked: stands between `property` or `cached_property` and it."""

    def declare(function: T) -> T:
        setattr(function, _KEY, Quantity(title, symbol, source, **known))
        return function

    return declare


@overload
def record(cls: type[T], /) -> type[T]: ...
@overload
def record(*, kw_only: bool = False, slots: bool = True) -> Callable[[type[T]], type[T]]: ...
@dataclass_transform(frozen_default=True, field_specifiers=(quantity, field))
def record(cls: Any = None, /, *, kw_only: bool = False, slots: bool = True) -> Any:
    """Make a frozen dataclass, whose fields may be declared by `quantity` and print with their units.

    Without slots it can keep what it computes (`cached_property`).
    """

    def made(kind: Any) -> Any:
        if "__repr__" not in vars(kind):
            kind.__repr__ = _summary
        return dataclass(frozen=True, slots=slots, kw_only=kw_only, repr=False)(kind)

    return made if cls is None else made(cls)


@cache
def quantities(kind: Any) -> dict[str, Quantity]:
    """The declarations of a dataclass by name: of its fields in their order, then of what it computes."""
    found = {each.name: each.metadata[_KEY] for each in fields(kind) if _KEY in each.metadata}
    for base in reversed(kind.__mro__):
        for name, member in vars(base).items():
            function = _function_of(member)
            if hasattr(function, _KEY):
                found[name] = getattr(function, _KEY)
    return found


def type_of(kind: Any, name: str) -> Any:
    """The type of a declared field or computed value."""
    function = _function_of(getattr(kind, name, None))
    return _hints(kind)[name] if function is None else get_type_hints(function)["return"]


def _function_of(member: Any) -> Callable[[Any], Any] | None:
    """What computes a property; None of another member."""
    return member.fget if isinstance(member, property) else getattr(member, "func", None)


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)


def allowed(declared: Quantity) -> str:
    """The range in words, in the shown unit but without it."""
    ends = declared.bounds
    if {"ge", "le"} <= set(ends):
        return f"{ends['ge']:.12g} to {ends['le']:.12g}"
    words = {"gt": "above", "ge": "at least", "lt": "below", "le": "at most"}
    return " and ".join(f"{word} {ends[end]:.12g}" for end, word in words.items() if end in ends)


def advice(declared: Quantity, value: Any) -> str:
    """Say what to give instead of text or a value outside the range, in the shown unit; empty if nothing is known."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and value < 0:
        said = declared.if_negative
    elif is_number:
        most = declared.bounds.get("le", declared.bounds.get("lt"))
        said = declared.if_above if most is not None and value > most else None
    else:
        said = declared.if_above if isinstance(value, str) else None
    return f"; {said}" if said else ""


def converted(
    value: Any,
    number: Callable[[Any], Any],
    inside: Callable[[Any], Any] | None = None,
    listed: Callable[[Iterable[Any]], Any] = tuple,
) -> Any:
    """Apply a conversion to every number in a value: the one way between SI and the units shown, in both directions.

    Parameters
    ----------
    value
        A number, an array, a dataclass or a section of a request, or lists of them; None, booleans and text stay.
    number
        Converts a number or an array.
    inside
        Converts what has fields of its own; None leaves it.
    listed
        Makes a list of its converted items.

    Returns
    -------
    Any
        The converted value.

    """
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, tuple | list):
        return listed(converted(item, number, inside, listed) for item in value)
    if isinstance(value, int | float | np.ndarray | np.generic):
        return number(value)
    return value if inside is None else inside(value)


def as_json(value: Any) -> Any:
    """An array as lists, in which None stands for NaN, a point without a value; a number stays."""
    if not isinstance(value, np.ndarray):
        return value
    if value.dtype.kind == "f" and np.isnan(value).any():
        missing, value = np.isnan(value), value.astype(object)
        value[missing] = None
    return value.tolist()


def to_dict(data: Any) -> dict[str, Any]:
    """The declared values of a dataclass in the units shown, named as in the interface: `module` as `module_mm`.

    Arrays become lists, dataclasses inside it dictionaries; NaN, which marks a point without a value, becomes None.
    """
    return _named(data, None)


def _named(data: Any, outer: Quantity | None) -> dict[str, Any]:
    """The declared values by name; `outer` declares those that have no unit of their own."""
    kind: Any = type(data)
    named = {}
    for name, declared in quantities(kind).items():
        known = outer if outer and declared.unit is None else declared
        own = f"{name}_{declared.unit}" if declared.unit else name
        named[own] = converted(getattr(data, name), partial(_shown, known), partial(_named, outer=known), list)
    return named


def _shown(declared: Quantity, value: Any) -> Any:
    """A number or an array in its unit as JSON can hold it."""
    return None if isinstance(value, float) and np.isnan(value) else as_json(declared.from_si(value))


def _summary(data: Any) -> str:
    """One line: numbers with their units, lists and arrays by their shape, dataclasses by their class."""
    kind: Any = type(data)
    declared = quantities(kind)
    parts = []
    for name in dict.fromkeys([*(each.name for each in fields(data) if each.repr), *declared]):
        known = declared.get(name)
        value = getattr(data, name)
        shown = known.from_si(value) if known and not is_dataclass(value) else value
        parts.append(f"{name}={_brief(shown)}{_symbol(known, value)}")
    return f"{type(data).__name__}({', '.join(parts)})"


def _symbol(declared: Quantity | None, value: Any) -> str:
    if declared is None or declared.unit is None or value is None or is_dataclass(value):
        return ""
    return f" {UNITS[declared.unit].symbol}"


def _brief(value: Any) -> str:
    match value:
        case bool() | str() | None:
            return repr(value)
        case float():
            return f"{value:.6g}"
        case np.ndarray():
            return f"array{value.shape}"
        case tuple() | list():
            return f"<{len(value)} values>"
        case _ if is_dataclass(value):
            return f"{type(value).__name__}(...)"
        case _:
            return str(value)
