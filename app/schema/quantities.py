"""Declarations of the fields of requests and responses for pydantic: their checks and their part of the JSON schema.

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
    """A declaration that documents its field in the JSON schema.

    `origin` holds the solver's dataclass from which the declaration was taken, and the name of the field there. It is
    None if the declaration was not taken from a dataclass. `in_schema` lists the attributes that the JSON schema
    states, for example `default_text` as `x-default-text`.
    """

    origin: tuple[type, str] | None = None
    in_schema: ClassVar[tuple[str, ...]]

    @classmethod
    def of(cls, record: type, name: str, **changes: Any) -> Self:
        """Return the declaration of a field of the solver's dataclass, with `changes` to its attributes."""
        return cls(**vars(quantities(record)[name]) | {"origin": (record, name)} | changes)

    @property
    def description(self) -> str:
        """The text, or the title if there is no text, followed by the meaning of null if a meaning is declared."""
        text = self.text or self.title
        return f"{text}; null: {self.default_text}" if self.default_text else text

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Add the meaning of the field to the JSON schema of its type."""
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

        Numbers must be finite and in range, and must not be text or booleans. Lists must have a permissible length.
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
            case "union":  # the choices of a union are schemas, alone or paired with a name
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
    """The way in which a result is judged.

    `headline` is the rank of the result among the headline numbers, from 1 to 4. `limit` is the number that bounds the
    value, or the dotted field of the request or answer that holds this number. `bound` says on which side the value is
    safe: below an upper limit, or above a lower limit. `needs` is the request field without which there is no value.
    `verdict` is the field of the answer that judges the value in words, or as a boolean that is true if the value is
    bad; a name that begins with a dot is a field in the same section as the value. `band` is the field of the answer
    that holds the two ends of the value's range of uncertainty; the worse end is judged. If `percent` is set, the value
    is a share that pages show in per cent.
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
        """Whether the limit is a lower limit, so that the least of several values is the worst."""
        return self.bound == "lower"


@dataclass(frozen=True)
class Output(View, _Declaration):
    """The declaration of a field of a response."""

    in_schema = ("symbol", "source", "axis", "index", "headline", "limit", "bound", "needs", "verdict", "band")

    @property
    def axes(self) -> tuple[str, ...]:
        """The fields that hold the axes, in the order of the dimensions."""
        return (self.axis,) if isinstance(self.axis, str) else self.axis or ()


def meaning_of(metadata: Iterable[Any]) -> Input | Output | None:
    """Return the declaration among the metadata of a field's type, or None."""
    return next((item for item in metadata if isinstance(item, Input | Output)), None)


@cache
def split_unit(name: str) -> tuple[str, Unit | None]:
    """Split a field name into the name without unit and the unit.

    The unit is the longest suffix that names a unit.
    """
    words = name.split("_")
    for start in range(1, len(words)):
        unit = UNITS.get("_".join(words[start:]))
        if unit is not None:
            return "_".join(words[:start]), unit
    return name, None
