"""Declarations of request and response fields, from which pydantic takes the checks and the JSON schema.

Names of fields contain the unit: `face_width_mm` is the face width in millimetres.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from math import isfinite
from types import GenericAlias, UnionType
from typing import Annotated, Any, ClassVar, Literal, Self, Union, get_args, get_origin

from pydantic import BeforeValidator, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticKnownError

from solvers.quantity import UNITS, Quantity, Unit, quantities

Bound = Literal["upper", "lower"]


@dataclass(frozen=True)
class _Declaration(Quantity):
    """The title, unit and other properties of a field, which are written into the JSON schema.

    A declaration can be a copy from a solver's dataclass. `origin` then holds this dataclass and the name of the field
    in it; otherwise `origin` is None. `in_schema` lists further attributes that are written into the JSON schema. For
    example, `default_text` is written as `x-default-text`.
    """

    origin: tuple[type, str] | None = None
    in_schema: ClassVar[tuple[str, ...]]

    @classmethod
    def of(cls, record: type, name: str, **changes: Any) -> Self:
        """Copy the declaration of the field `name` from a solver's dataclass. `changes` replace attributes."""
        return cls(**vars(quantities(record)[name]) | {"origin": (record, name)} | changes)

    @property
    def description(self) -> str:
        """Description of the field in the JSON schema: text or title, then the meaning of null if it is declared."""
        text = self.text or self.title
        return f"{text}; null: {self.default_text}" if self.default_text else text

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Add title, description, unit and other attributes of the declaration to the JSON schema of the type."""
        document = {**handler(schema), "title": self.title, "description": self.description}
        for name in self.in_schema:
            value = getattr(self, name)
            if value is not None and value is not False:
                document[f"x-{name.replace('_', '-')}"] = list(value) if isinstance(value, tuple) else value
        return document | {"x-unit": UNITS[self.unit].symbol} if self.unit else document


@dataclass(frozen=True)
class Input(_Declaration):
    """The declaration of a field of a request."""

    in_schema = ("symbol", "source", "assumed", "default_text", "advanced", "folded", "tolerance", "relative_tolerance")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Check the field: numbers are finite and in range, neither text nor booleans are numbers, lists fit."""
        return handler(self._strict(source))

    def _strict(self, kind: Any) -> Any:
        """Return the type `kind` with the checks of the field on every number in it."""
        bounds: Any = self.bounds
        origin, arguments = get_origin(kind), get_args(kind)
        plain = {
            float: Annotated[float, Field(strict=True, allow_inf_nan=False, **bounds)],
            int: Annotated[
                int, Field(strict=True, **bounds), BeforeValidator(_whole)
            ],  # Field first: it keeps the range
            bool: Annotated[bool, Field(strict=True)],
        }
        if origin is Annotated:
            more = (
                replace(each, json_schema_input_type=self._strict(each.json_schema_input_type))
                if isinstance(each, BeforeValidator)
                else each
                for each in arguments[1:]
            )
            return Annotated[self._strict(arguments[0]), *more]
        if origin in {Union, UnionType}:
            return Union[tuple(self._strict(choice) for choice in arguments)]  # noqa: UP007
        if origin is list:
            least, most = self.length or (None, None)
            return Annotated[
                GenericAlias(list, self._strict(arguments[0])), Field(min_length=least or None, max_length=most)
            ]
        return plain.get(kind, kind)


def _whole(value: Any) -> Any:
    """Turn a whole float into an int, because JSON does not distinguish 3.0 from 3."""
    if not isinstance(value, float):
        return value
    if not isfinite(value):
        raise PydanticKnownError("finite_number")
    if not value.is_integer():
        raise PydanticKnownError("int_from_float")
    return int(value)


@dataclass(frozen=True)
class View:
    """How pages show and judge a result.

    `headline` is the rank of the result among the headline numbers, from 1 to 4. `limit` is a number, or the dotted
    name of the request or answer field that holds the number. If `bound` is "upper", results below the limit are safe.
    If `bound` is "lower", results above the limit are safe.

    `needs` names the request field without which there is no result. `verdict` names the answer field that judges the
    result: by a word, or by a boolean that is true if the result is bad. A name that begins with a dot refers to a
    field in the section of the result. `band` names the answer field with the two ends of the uncertainty band; pages
    judge the worse end. If `percent` is set, pages show the result in per cent.
    """

    headline: int | None = None
    limit: str | float | None = None
    bound: Bound | None = None
    needs: str | None = None
    verdict: str | None = None
    percent: bool = False
    band: str | None = None

    @property
    def greatest_is_best(self) -> bool:
        """True if the limit is a lower limit: greater values are then better."""
        return self.bound == "lower"


@dataclass(frozen=True)
class Output(View, _Declaration):
    """The declaration of a field of a response."""

    in_schema = ("symbol", "source", "axis", "index", "headline", "limit", "bound", "needs", "verdict", "band")

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the fields with the coordinates of the array's elements, one name per dimension of the array."""
        return (self.axis,) if isinstance(self.axis, str) else self.axis or ()


def meaning_of(metadata: Iterable[Any]) -> Input | Output | None:
    """Return the `Input` or `Output` in the metadata of a field's type, or None if the metadata have neither."""
    return next((item for item in metadata if isinstance(item, Input | Output)), None)


@cache
def split_unit(name: str) -> tuple[str, Unit | None]:
    """Split a field name into the name without unit and the unit.

    The unit is the longest suffix that names a unit. If no suffix names a unit, the unit is None.
    """
    words = name.split("_")
    for start in range(1, len(words)):
        unit = UNITS.get("_".join(words[start:]))
        if unit is not None:
            return "_".join(words[:start]), unit
    return name, None
