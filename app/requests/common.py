"""What every request has in common."""

from abc import abstractmethod
from typing import Annotated, Any, TypeVar

from pydantic import ConfigDict, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from app.schema.conversion import built
from app.schema.model import Documented
from app.schema.quantities import Input
from solvers.quantity import Detail

T = TypeVar("T")


class Section(Documented):
    """A part of a request: unknown fields are refused, numbers are numbers, finite and in range."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def si(self, kind: type[T]) -> T:
        """The solver's dataclass that these fields fill, in SI."""
        return built(self, kind)

    def stands_for_null(self, _name: str) -> Any:
        """What a field that was left null stands for, where the section itself knows it."""
        return None


class Request(Section):
    """The body of a calculation."""

    detail: Annotated[
        Detail,
        Input("level of detail", text="what to return: scalars, scalars and curves, or also two-dimensional fields"),
    ] = "curves"

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema as the docs page shows it best: what is required first, the level of detail last."""
        document = super().__get_pydantic_json_schema__(schema, handler)
        definition = handler.resolve_ref_schema(document)
        required = definition.get("required", ())
        rank = {name: (name not in required, name == "detail") for name in definition["properties"]}
        definition["properties"] = {name: definition["properties"][name] for name in sorted(rank, key=rank.__getitem__)}
        return document

    @abstractmethod
    def inputs(self) -> Any:
        """The solver's inputs, SI."""

    @abstractmethod
    def options(self) -> dict[str, Any]:
        """The options in force, by their names in the contract."""

    def unused_defaults(self) -> frozenset[str]:
        """Dotted names of fields or sections that the chosen options leave out of the result."""
        return frozenset()

    def assumed_by_the_model(self) -> dict[str, str]:
        """What the options in force take for granted whatever else is given: reasons by dotted names of options."""
        return {}
