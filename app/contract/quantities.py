"""What a field means: title, unit, symbol, source and range, carried into the schema and every view of it."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from app.contract.units import Unit, split_unit

Detail = Literal["summary", "curves", "fields"]
Bound = Literal["upper", "lower"]


@dataclass(frozen=True, slots=True)
class Input:
    """A field of a request.

    `title` is a label that stands alone, `text` says more. The range bounds the number as sent; its unit is in the
    field's name. `assumed` is the reason behind a default that is ours and not the paper's; a result that rests on
    the default lists it. `default_text` says what a null stands for. `advanced` marks options of model and
    resolution, `tolerance` is what manufacture or measurement usually leaves open, in the field's unit, and
    `relative_tolerance` the same as a share of the value where that is more. Every field that may be zero has a
    tolerance, by which a sensitivity moves it.
    """

    title: str
    symbol: str | None = None
    source: str | None = None
    text: str | None = None
    ge: float | None = None
    gt: float | None = None
    le: float | None = None
    lt: float | None = None
    assumed: str | None = None
    default_text: str | None = None
    advanced: bool = False
    tolerance: float | None = None
    relative_tolerance: float | None = None

    @property
    def description(self) -> str:
        """The text, and what a null means."""
        text = self.text or self.title
        return f"{text}; null: {self.default_text}" if self.default_text else text

    @property
    def extras(self) -> dict[str, Any]:
        """What the schema says beside title and description."""
        return {
            "x-symbol": self.symbol,
            "x-source": self.source,
            "x-assumed": self.assumed,
            "x-default-text": self.default_text,
            "x-advanced": self.advanced or None,
            "x-tolerance": self.tolerance,
            "x-relative-tolerance": self.relative_tolerance,
        }

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
            case "union":
                return core_schema.union_schema([self._strict(choice) for choice in _kinds(schema["choices"])])
            case _:
                within = ("items_schema", "schema", "json_schema_input_schema")
                parts = {name: self._strict(part) for name in within if (part := schema.get(name))}
                return {**schema, **parts}


@dataclass(frozen=True, slots=True)
class Output:
    """A field of a response; `detail` is the least level of detail at which it is sent.

    `axis` names the sibling field over which a curve runs, or the two of a map; `index` says what the places of a list
    mean where no field does. `headline` ranks the numbers that decide, 1 to 3. `limit` is the number, or the dotted
    field of request or answer, that bounds the value; `bound` says on which side a verdict about it finds the value
    safe: below an upper limit, above a lower one. `needs` is the request field without which there is no value,
    `verdict` the field of the answer that judges it in words. `of` is the member of the solver's result that holds the
    value, where it is not the result itself.
    """

    title: str
    symbol: str | None = None
    source: str | None = None
    text: str | None = None
    detail: Detail = "summary"
    axis: str | tuple[str, str] | None = None
    index: str | None = None
    headline: int | None = None
    limit: str | float | None = None
    bound: Bound | None = None
    needs: str | None = None
    verdict: str | None = None
    of: str | None = None

    @property
    def axes(self) -> tuple[str, ...]:
        """The fields it runs over, in the order of its dimensions."""
        return (self.axis,) if isinstance(self.axis, str) else self.axis or ()

    @property
    def description(self) -> str:
        """The text, else the title."""
        return self.text or self.title

    @property
    def extras(self) -> dict[str, Any]:
        """What the schema says beside title and description."""
        return {
            "x-symbol": self.symbol,
            "x-source": self.source,
            "x-axis": list(self.axis) if isinstance(self.axis, tuple) else self.axis,
            "x-index": self.index,
            "x-headline": self.headline,
            "x-limit": self.limit,
            "x-bound": self.bound,
            "x-needs": self.needs,
            "x-verdict": self.verdict,
        }

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The type's own JSON schema and what the field means."""
        return _documented(handler(schema), self)


def _kinds(choices: list[Any]) -> list[CoreSchema]:
    """The kinds of a union, without the names that may stand beside them."""
    return [choice[0] if isinstance(choice, tuple) else choice for choice in choices]


def _number(value: object) -> object:
    """Let numbers pass; text and booleans are none, whatever Python thinks."""
    if isinstance(value, (bool, str)):
        raise PydanticCustomError("number_type", "Input should be a number")
    return value


def _documented(schema: JsonSchemaValue, meaning: Input | Output) -> JsonSchemaValue:
    """The schema with title, description and all that the field says of itself."""
    extras = {key: value for key, value in meaning.extras.items() if value is not None}
    return {**schema, "title": meaning.title, "description": meaning.description, **extras}


class Documented(BaseModel):
    """A model whose JSON schema states the unit of every field that has one.

    `exclusive` lists groups of fields of which at most one is given. `member_unit` is the unit of the fields whose own
    names carry none: a group `mass_flow_g_per_s` says it once for its members.
    `solver_names` are the parts of dotted names that the solver spells otherwise, with the fields' spelling. `held`
    are the members of the solver's result that hold what the models extended here show.
    """

    exclusive: ClassVar[tuple[tuple[str, ...], ...]] = ()
    member_unit: ClassVar[Unit | None] = None
    solver_names: ClassVar[dict[str, str]] = {}
    held: ClassVar[dict[type, str]] = {}

    @classmethod
    def unit_of(cls, name: str) -> Unit | None:
        """The unit of a field."""
        return split_unit(name)[1] or cls.member_unit

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema with `x-unit` added field by field, and `x-exclusive`."""
        document = handler(schema)
        definition = handler.resolve_ref_schema(document)
        for name, field in definition.get("properties", {}).items():
            unit = cls.unit_of(name) or getattr(cls.model_fields[name].annotation, "member_unit", None)
            if unit is not None:
                field["x-unit"] = unit.symbol
        if cls.exclusive:
            definition["x-exclusive"] = [list(group) for group in cls.exclusive]
        return document
