"""What a field of a request or response means, as pydantic takes it: its checks and its part of the JSON schema.

Units stand in field names: `face_width_mm` is the face width in millimetres.
"""

from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.fields import FieldInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from solvers.quantity import UNITS, Quantity, Unit

Bound = Literal["upper", "lower"]


@dataclass(frozen=True)
class _Declaration(Quantity):
    """A declaration that documents its field in the JSON schema."""

    @property
    def description(self) -> str:
        """The text, else the title."""
        return self.text or self.title

    @property
    def extras(self) -> dict[str, Any]:
        """What the schema says beside title and description."""
        return {"x-symbol": self.symbol, "x-source": self.source}

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The type's own JSON schema and what the field means."""
        extras = {key: value for key, value in self.extras.items() if value is not None}
        return {**handler(schema), "title": self.title, "description": self.description, **extras}


@dataclass(frozen=True)
class Input(_Declaration):
    """The declaration of a field of a request; the unit is in the field's name.

    `origin` is the dataclass and its field that it was taken from, if it was.
    """

    origin: tuple[type, str] | None = None

    @property
    def description(self) -> str:
        """The text, and what a null means."""
        text = super().description
        return f"{text}; null: {self.default_text}" if self.default_text else text

    @property
    def extras(self) -> dict[str, Any]:
        """What the schema says beside title and description."""
        return super().extras | {
            "x-assumed": self.assumed,
            "x-default-text": self.default_text,
            "x-advanced": self.advanced or None,
            "x-tolerance": self.tolerance,
            "x-relative-tolerance": self.relative_tolerance,
        }

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The type's own schema; its numbers are finite and in range, and neither text nor booleans."""
        return self._strict(handler(source))

    def _strict(self, schema: CoreSchema) -> CoreSchema:
        match schema["type"]:
            case "float" | "int" as kind:
                bounds: Any = self.bounds
                if kind == "float":  # strict: text and booleans are no numbers
                    return core_schema.float_schema(strict=True, allow_inf_nan=False, **bounds)
                # A strict int would refuse 3.0. So: a number, of at most 2^53, up to which floats hold whole numbers
                # exactly, then a whole one in its range.
                number = core_schema.custom_error_schema(core_schema.float_schema(strict=True), "int_type")
                exact = core_schema.float_schema(allow_inf_nan=False, ge=-(2.0**53), le=2.0**53)
                whole = core_schema.chain_schema([number, exact, core_schema.int_schema(**bounds)])
                return core_schema.json_or_python_schema(core_schema.int_schema(strict=True, **bounds), whole)
            case "bool":
                return core_schema.bool_schema(strict=True)
            case "union":
                return core_schema.union_schema([self._strict(choice) for choice in _kinds(schema["choices"])])
            case _:
                within = ("items_schema", "schema", "json_schema_input_schema")
                parts = {name: self._strict(part) for name in within if (part := schema.get(name))}
                return {**schema, **parts}


@dataclass(frozen=True)
class View:
    """How a result is judged: rank among the headline numbers, 1 to 3, and what bounds it.

    `limit` is the number, or the dotted field of request or answer, that bounds the value; `bound` says on which side a
    verdict finds the value safe: below an upper limit, above a lower one. `needs` is the request field without which
    there is no value, `verdict` the field of the answer that judges it in words, or as a truth that is bad; beside the
    value where it begins with a dot. `percent` values are shares that pages show in per cent.
    """

    headline: int | None = None
    limit: str | float | None = None
    bound: Bound | None = None
    needs: str | None = None
    verdict: str | None = None
    percent: bool = False

    @property
    def greatest_is_best(self) -> bool:
        """Whether the value has to stay above something; of several values the least is then the worst."""
        return self.bound == "lower"


@dataclass(frozen=True)
class Output(View, _Declaration):
    """The declaration of a field of a response."""

    @property
    def axes(self) -> tuple[str, ...]:
        """The fields it runs over, in the order of its dimensions."""
        return (self.axis,) if isinstance(self.axis, str) else self.axis or ()

    @property
    def extras(self) -> dict[str, Any]:
        """What the schema says beside title and description."""
        return super().extras | {
            "x-axis": list(self.axis) if isinstance(self.axis, tuple) else self.axis,
            "x-index": self.index,
            "x-headline": self.headline,
            "x-limit": self.limit,
            "x-bound": self.bound,
            "x-needs": self.needs,
            "x-verdict": self.verdict,
        }


def meaning_of(field: FieldInfo) -> Input | Output | None:
    """The declaration of a model's field, if it has one."""
    return next((each for each in field.metadata if isinstance(each, Input | Output)), None)


@cache
def split_unit(name: str) -> tuple[str, Unit | None]:
    """A field name without its unit, and the unit; the longest suffix that is a unit counts."""
    words = name.split("_")
    for start in range(1, len(words)):
        unit = UNITS.get("_".join(words[start:]))
        if unit is not None:
            return "_".join(words[:start]), unit
    return name, None


def _kinds(choices: list[Any]) -> list[CoreSchema]:
    """The kinds of a union, without the names that may stand beside them."""
    return [choice[0] if isinstance(choice, tuple) else choice for choice in choices]
