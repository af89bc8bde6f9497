"""Declarations of request and response fields, from which pydantic takes the checks and the JSON schema.

Names of fields contain the unit: `face_width_mm` is the face width in millimetres.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar, Literal, Self

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

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
        """Add the checks of the field.

        Numbers must be finite and in range, and must not be text or booleans. The length of a list must be permissible.
        """
        return self._strict(handler(source))

    def _strict(self, schema: CoreSchema) -> CoreSchema:
        bounds: Any = self.bounds
        match schema["type"]:
            case "float":  # strict: text and booleans are not numbers
                return core_schema.float_schema(strict=True, allow_inf_nan=False, **bounds)
            case "int":
                # A strict int would refuse 3.0. Three checks follow one another instead. The first checks that the
                # value is a number. The second checks that its magnitude is at most 2^53, because whole floats are
                # exact up to this limit. The third checks that the number is whole and in range.
                number = core_schema.custom_error_schema(core_schema.float_schema(strict=True), "int_type")
                exact = core_schema.float_schema(allow_inf_nan=False, ge=-(2.0**53), le=2.0**53)
                whole = core_schema.chain_schema([number, exact, core_schema.int_schema(**bounds)])
                return core_schema.json_or_python_schema(core_schema.int_schema(strict=True, **bounds), whole)
            case "bool":
                return core_schema.bool_schema(strict=True)
            case "union":  # a choice is a schema, or a pair of a schema and a name
                kinds = (choice[0] if isinstance(choice, tuple) else choice for choice in schema["choices"])
                return core_schema.union_schema([self._strict(kind) for kind in kinds])
            case "list" if self.length:
                least, most = self.length
                return core_schema.list_schema(
                    self._strict(schema["items_schema"]), min_length=least or None, max_length=most
                )
            case _:
                within = ("items_schema", "schema", "json_schema_input_schema")
                return {**schema, **{name: self._strict(part) for name in within if (part := schema.get(name))}}


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
