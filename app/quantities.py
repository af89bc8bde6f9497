"""What a field means: description, unit, symbol, source and range, carried into the schema and the docs page."""

from dataclasses import dataclass
from typing import Any, Literal

from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from app.units import split_unit

Detail = Literal["summary", "curves", "fields"]


@dataclass(frozen=True, slots=True)
class Input:
    """A field of a request.

    The range bounds the number as sent; its unit is in the field's name. `assumed` is the reason
    behind a default that is ours and not the paper's; a result that rests on the default lists it. `si` is the
    solver's name of the field where it is not the field's own name without its unit.
    """

    description: str
    symbol: str | None = None
    source: str | None = None
    ge: float | None = None
    gt: float | None = None
    le: float | None = None
    lt: float | None = None
    assumed: str | None = None
    si: str | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The type's own schema, its numbers finite, in range and really numbers."""
        return self._strict(handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The type's own JSON schema and what the field means."""
        return _documented(handler(schema), self)

    def _strict(self, schema: CoreSchema) -> CoreSchema:
        match schema["type"]:
            case "float" | "int":
                bounds = {name: getattr(self, name) for name in ("ge", "gt", "le", "lt")}
                number: Any = {**schema, **{name: bound for name, bound in bounds.items() if bound is not None}}
                if schema["type"] == "float":
                    number["allow_inf_nan"] = False
                return core_schema.no_info_before_validator_function(_number, number)
            case "bool":
                return core_schema.bool_schema(strict=True)
            case "nullable":
                return core_schema.nullable_schema(self._strict(schema["schema"]))
            case "list":
                items: Any = {**schema, "items_schema": self._strict(schema["items_schema"])}
                return items  # type: ignore[no-any-return]
            case _:
                return schema


@dataclass(frozen=True, slots=True)
class Output:
    """A field of a response; `detail` is the least level of detail at which it is sent."""

    description: str
    symbol: str | None = None
    source: str | None = None
    detail: Detail = "summary"
    si: str | None = None

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The type's own JSON schema and what the field means."""
        return _documented(handler(schema), self)


def _number(value: object) -> object:
    """Let numbers pass; text and booleans are none, whatever Python thinks."""
    if isinstance(value, (bool, str)):
        raise PydanticCustomError("number_type", "Input should be a number")
    return value


def _documented(schema: JsonSchemaValue, meaning: Input | Output) -> JsonSchemaValue:
    """The schema with description, symbol and source."""
    described = {**schema, "description": meaning.description}
    if meaning.symbol:
        described["x-symbol"] = meaning.symbol
    if meaning.source:
        described["x-source"] = meaning.source
    return described


class Documented(BaseModel):
    """A model whose JSON schema states the unit of every field whose name carries one."""

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema with `x-unit` added field by field."""
        document = handler(schema)
        for name, field in handler.resolve_ref_schema(document).get("properties", {}).items():
            _, unit = split_unit(name)
            if unit is not None:
                field["x-unit"] = unit.symbol
        return document
