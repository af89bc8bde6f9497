"""Declarations of quantities, written at the fields of dataclasses: title, symbol, source, unit and range.

    @record
    class Coupling:
        face_width: float = quantity("face width", "b", "ISO 21771", unit="mm", ge=0.1, le=2000, tolerance=0.1)

The value of the attribute is in SI units. The declaration states the range, the default and the tolerance in the unit
in which the quantity is shown (here mm).
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cache, partial
from inspect import cleandoc, formatannotation
from math import pi
from typing import Any, Literal, NamedTuple, TypeVar, dataclass_transform, get_args, get_type_hints, overload

import numpy as np

Detail = Literal["summary", "curves", "fields"]
T = TypeVar("T")
_KEY, _TEXT, _PLACE = "quantity", "text", "_equation"
_LEFT_OUT_OF_TYPES = re.compile(r"\b(?:[a-z_]\w*\.)+|(?<=ndarray)\[.*?\]\]|^'|'$")  # modules, element types, quotes


class Unit(NamedTuple):
    """A unit in which a quantity is shown: SI value = `scale` × shown + `offset`; `si` is None if both are one."""

    symbol: str
    scale: float
    offset: float = 0.0
    si: str | None = None

    def to_si(self, value: Any) -> Any:
        """Convert a number or an array from this unit to SI."""
        return value * self.scale + self.offset

    def from_si(self, value: Any) -> Any:
        """Convert a number or an array from SI to this unit."""
        return (value - self.offset) / self.scale


UNITS = {
    "mm": Unit("mm", 1e-3, si="m"),
    "mm2": Unit("mm²", 1e-6, si="m²"),
    "mm2_per_s": Unit("mm²/s", 1e-6, si="m²/s"),
    "m2": Unit("m²", 1.0),
    "l_per_min": Unit("l/min", 1e-3 / 60, si="m³/s"),
    "um": Unit("µm", 1e-6, si="m"),
    "um_per_million": Unit("µm per million turns", 1e-12, si="m per turn"),
    "mm3_per_n_m": Unit("mm³/(N m)", 1e-9, si="m³/(N m)"),
    "deg": Unit("°", pi / 180, si="rad"),
    "mrad": Unit("mrad", 1e-3, si="rad"),
    "s": Unit("s", 1.0),
    "rpm": Unit("1/min", pi / 30, si="rad/s"),
    "hz": Unit("Hz", 1.0),
    "m_per_s": Unit("m/s", 1.0),
    "mm_per_s": Unit("mm/s", 1e-3, si="m/s"),
    "kg": Unit("kg", 1.0),
    "g_per_s": Unit("g/s", 1e-3, si="kg/s"),
    "g_per_mol": Unit("g/mol", 1e-3, si="kg/mol"),
    "n": Unit("N", 1.0),
    "n_m": Unit("N m", 1.0),
    "n_per_mm": Unit("N/mm", 1e3, si="N/m"),
    "n_per_um": Unit("N/µm", 1e6, si="N/m"),
    "n_per_mm_um": Unit("N/(mm µm)", 1e9, si="N/m²"),
    "n_m_per_rad": Unit("N m/rad", 1.0),
    "mpa": Unit("MPa", 1e6, si="Pa"),
    "kpa": Unit("kPa", 1e3, si="Pa"),
    "gpa": Unit("GPa", 1e9, si="Pa"),
    "per_gpa": Unit("1/GPa", 1e-9, si="1/Pa"),
    "per_k": Unit("1/K", 1.0),
    "pa_s": Unit("Pa s", 1.0),
    "w": Unit("W", 1.0),
    "kw": Unit("kW", 1e3, si="W"),
    "j": Unit("J", 1.0),
    "w_per_mm": Unit("W/mm", 1e3, si="W/m"),
    "w_per_mm2": Unit("W/mm²", 1e6, si="W/m²"),
    "c": Unit("°C", 1.0, 273.15, si="K"),
    "k": Unit("K", 1.0),
    "kg_per_m3": Unit("kg/m³", 1.0),
    "j_per_kg_k": Unit("J/(kg K)", 1.0),
    "w_per_m_k": Unit("W/(m K)", 1.0),
    "w_per_m2_k": Unit("W/(m² K)", 1.0),
    "w_per_k": Unit("W/K", 1.0),
}
"""Units of shown values. A key is the suffix of a field name in the API, such as `mm` in `module_mm`."""


@dataclass(frozen=True)
class Quantity:
    """The declaration of one field.

    title                     label that needs no further text
    symbol, source            symbol, and the literature that uses it
    text                      description, if the title is not enough
    unit                      key of `UNITS`; None without a unit
    ge, gt, le, lt            range of an input, in the shown unit
    default                   of an input or option; `...` if there is none
    default_text              what a default None means, in words
    assumed                   reason for a default of our own; results that depend on it list the reason
    advanced                  whether it is an option of model or resolution
    folded                    whether a form shows it only on demand, because few users know it
    tolerance,                usual uncertainty in the shown unit, or as a share of the value; the larger counts. What
      relative_tolerance      may be zero needs a `tolerance`, so that a sensitivity analysis can vary it
    if_above, if_negative     advice on what to enter instead
    length                    least and largest number of values of a list
    detail                    lowest level of detail at which a result has the field
    axis                      field that is the abscissa of a curve, or both of a map; dotted from the whole result
    index                     meaning of the positions of a list ("X, Y"), if no other field states it
    gaps                      whether NaN in an array marks a point without a value
    left_out                  whether answers leave it out where it is None, because few cases have it
    equation                  place in the manual that says how it is computed: "D15", or "drive-train#shafts"; by
                              default that of the dataclass
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
    left_out: bool = False
    equation: str | None = None

    @property
    def bounds(self) -> dict[str, float]:
        """Ends of the range under the names `ge`, `gt`, `le` and `lt`; ends that are not given are left out."""
        return {name: end for name in ("ge", "gt", "le", "lt") if (end := getattr(self, name)) is not None}

    def tolerance_of(self, value: float) -> float | None:
        """Return the usual uncertainty of a value, both in the shown unit; None if none is declared."""
        relative = None if self.relative_tolerance is None else self.relative_tolerance * abs(value)
        return max((each for each in (self.tolerance, relative) if each is not None), default=None)

    def to_si(self, value: Any) -> Any:
        """Return a number or a list of numbers in SI; return any other value unchanged."""
        return converted(value, UNITS[self.unit].to_si) if self.unit else value

    def from_si(self, value: Any) -> Any:
        """Return a number or a list of numbers in the shown unit; return any other value unchanged."""
        return converted(value, UNITS[self.unit].from_si) if self.unit else value


def quantity(
    title: str,
    symbol: str | None = None,
    source: str | None = None,
    *,
    default: Any = ...,
    default_factory: Callable[[], Any] | None = None,
    kw_only: bool = False,
    **details: Any,
) -> Any:
    """Return a dataclass field with its `Quantity`; `default` is given in the shown unit and stored in SI units."""
    declared = Quantity(title, symbol, source, default=default, **details)
    options: dict[str, Any] = {"metadata": {_KEY: declared}}
    if kw_only:
        options["kw_only"] = True
    if default_factory is not None:
        options["default_factory"] = default_factory
    elif default is not ...:
        options["default"] = declared.to_si(default)
    declared_field: Any = field(**options)
    return declared_field


def described(text: str, **options: Any) -> Any:
    """Return a dataclass field without a `Quantity`; `text` becomes its entry in the docstring of the dataclass."""
    return field(metadata={_TEXT: text}, **options)


def computed(title: str, symbol: str | None = None, source: str | None = None, **details: Any) -> Callable[[T], T]:
    """Declare a value that a dataclass computes; write the decorator above the function and below `property`."""

    def declare(function: T) -> T:
        setattr(function, _KEY, Quantity(title, symbol, source, **details))
        return function

    return declare


@overload
def record(cls: type[T], /) -> type[T]: ...
@overload
def record(
    *, kw_only: bool = False, slots: bool = True, equation: str | None = None
) -> Callable[[type[T]], type[T]]: ...
@dataclass_transform(frozen_default=True, field_specifiers=(quantity, described, field))
def record(cls: Any = None, /, *, kw_only: bool = False, slots: bool = True, equation: str | None = None) -> Any:
    """Make a frozen dataclass whose fields may be declared by `quantity`.

    Its `repr` shows units, its docstring gets numpydoc's sections on the fields. With `cached_property` it needs
    `slots=False`. `equation` is the place in the manual of all quantities that name none.
    """

    def make(kind: Any) -> Any:
        if "__repr__" not in vars(kind):
            kind.__repr__ = _summary
        if equation:
            setattr(kind, _PLACE, equation)
        data: Any = dataclass(frozen=True, slots=slots, kw_only=kw_only, repr=False)(kind)
        data.__doc__ = _Docstring(data.__doc__)
        return data

    return make if cls is None else make(cls)


@cache
def quantities(kind: Any) -> dict[str, Quantity]:
    """Return the declarations of a dataclass by name: first the fields in their order, then the computed values."""
    place = getattr(kind, _PLACE, None)
    declared = {item.name: item.metadata[_KEY] for item in fields(kind) if _KEY in item.metadata}
    for base in reversed(kind.__mro__):
        for name, member in vars(base).items():
            function = _function_of(member)
            if hasattr(function, _KEY):
                declared[name] = getattr(function, _KEY)
    if place is None:
        return declared
    return {name: own if own.equation else replace(own, equation=place) for name, own in declared.items()}


def type_of(kind: Any, name: str) -> Any:
    """Return the type of a declared field or computed value."""
    function = _function_of(getattr(kind, name, None))
    return _hints(kind)[name] if function is None else get_type_hints(function)["return"]


def _function_of(member: Any) -> Callable[[Any], Any] | None:
    """Return the function of a property or cached property; return None for any other member of a class."""
    return member.fget if isinstance(member, property) else getattr(member, "func", None)


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)


def allowed(declared: Quantity) -> str:
    """Return the range in words, with numbers in the shown unit but without the symbol of the unit."""
    ends = declared.bounds
    if {"ge", "le"} <= set(ends):
        return f"{ends['ge']:.12g} to {ends['le']:.12g}"
    words = {"gt": "above", "ge": "at least", "lt": "below", "le": "at most"}
    return " and ".join(f"{word} {ends[end]:.12g}" for end, word in words.items() if end in ends)


def advice(declared: Quantity, value: Any) -> str:
    """Advice on what to enter instead of a value (in the shown unit) out of range or not a number; may be empty."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and value < 0:
        text = declared.if_negative
    elif is_number:
        most = declared.bounds.get("le", declared.bounds.get("lt"))
        text = declared.if_above if most is not None and value > most else None
    else:
        text = declared.if_above if isinstance(value, str) else None
    return f"; {text}" if text else ""


def converted(
    value: Any,
    number: Callable[[Any], Any],
    inside: Callable[[Any], Any] | None = None,
    listed: Callable[[Iterable[Any]], Any] = tuple,
) -> Any:
    """Apply a conversion to every number in a value: the one way between SI and shown units.

    `number` converts a number or an array, `inside` a value with fields of its own (None: unchanged), `listed` makes a
    list. None, booleans and text stay as they are.
    """
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, tuple | list):
        return listed(converted(item, number, inside, listed) for item in value)
    if isinstance(value, int | float | np.ndarray | np.generic):
        return number(value)
    return value if inside is None else inside(value)


def as_json(value: Any) -> Any:
    """An array as nested lists with None for NaN; anything else unchanged."""
    if not isinstance(value, np.ndarray):
        return value
    if value.dtype.kind == "f" and np.isnan(value).any():
        missing, value = np.isnan(value), value.astype(object)
        value[missing] = None
    return value.tolist()


def to_dict(data: Any) -> dict[str, Any]:
    """Declared values of a dataclass in shown units, named as in the API (`module_mm` for `module`).

    Arrays become lists, inner dataclasses dictionaries, NaN None.
    """
    return _named(data, None)


def _named(data: Any, outer: Quantity | None) -> dict[str, Any]:
    """Declared values of `data` under their API names; a value without unit has that of `outer`, its field."""
    kind: Any = type(data)
    named = {}
    for name, declared in quantities(kind).items():
        counting = outer if outer and declared.unit is None else declared
        own = f"{name}_{declared.unit}" if declared.unit else name
        number, inside = partial(_shown, counting), partial(_named, outer=counting)
        named[own] = converted(getattr(data, name), number, inside, list)
    return named


def _shown(declared: Quantity, value: Any) -> Any:
    """Convert a number or an array into the shown unit, and into a form that JSON can hold."""
    return None if isinstance(value, float) and np.isnan(value) else as_json(declared.from_si(value))


class _Docstring:
    """Docstring of a dataclass; sections on the fields are added when it is read, because at import they cost time."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __get__(self, data: Any, kind: Any) -> str:
        """Return the docstring with numpydoc's sections on the fields and the computed values of `kind`."""
        declared = quantities(kind)
        given = [item.name for item in sorted(fields(kind), key=lambda item: bool(item.kw_only)) if item.init]
        names = {
            "Parameters": given,
            "Attributes": [name for name in declared if name not in kind.__dataclass_fields__],
        }
        sections = [
            "\n".join([title, "-" * len(title), *(_entry(kind, name, declared.get(name)) for name in names[title])])
            for title in names
            if names[title]
        ]
        return "\n\n".join([cleandoc(self.text), *sections])


def _entry(kind: Any, name: str, declared: Quantity | None) -> str:
    """Entry of numpydoc on one field: type, description with the SI unit, symbol, source, range and default."""
    item = kind.__dataclass_fields__.get(name)
    annotation = item.type if item else _function_of(getattr(kind, name)).__annotations__["return"]
    head = f"{name} : {_LEFT_OUT_OF_TYPES.sub('', formatannotation(annotation))}"
    if declared is None:
        texts = (str(part.__doc__) for part in (annotation, *get_args(annotation)) if is_dataclass(part))
        text = item.metadata.get(_TEXT) or next(texts, "").partition("\n")[0]
        return f"{head}\n    {text}"
    title, text = declared.title, declared.text or declared.title
    text = text if title in text else f"{title}: {text}"
    si, shown = "", ""
    if declared.unit:
        unit = UNITS[declared.unit]
        si, shown = f" [{unit.si or unit.symbol}]", f" {unit.symbol}"
    default = None if declared.default in {None, ...} else f"{_brief(declared.default)}{shown}"
    facts = {
        "symbol": declared.symbol,
        "source": declared.source,
        "range": declared.bounds and f"{allowed(declared)}{shown}",
        "default": default or declared.default_text,
    }
    rest = "; ".join(f"{word} {fact}" for word, fact in facts.items() if fact)
    sentences = (f"{words[0].upper()}{words[1:].removesuffix('.')}." for words in (f"{text}{si}", rest) if words)
    return "\n    ".join([head, *sentences])


def _summary(data: Any) -> str:
    """Return one line with the values of a dataclass, as its `repr` shows them."""
    kind: Any = type(data)
    declared = quantities(kind)
    parts = []
    for name in dict.fromkeys([*(item.name for item in fields(data) if item.repr), *declared]):
        own, value = declared.get(name), getattr(data, name)
        shown = own.from_si(value) if own and not is_dataclass(value) else value
        parts.append(f"{name}={_brief(shown)}{_symbol(own, value)}")
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
