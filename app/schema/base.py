"""What requests and answers have in common."""

from abc import abstractmethod
from importlib.metadata import version
from typing import Annotated, Any, ClassVar, Literal, LiteralString, Self, TypeVar

from pydantic import ConfigDict, GetJsonSchemaHandler, PrivateAttr, model_validator
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from app.schema.model import Documented, built
from app.schema.quantities import Input, Output
from solvers.notices import Rank
from solvers.quantity import Detail

T = TypeVar("T")
MODEL_VERSION = version("tribodrive")


class Section(Documented):
    """A part of a request: unknown fields are refused, numbers are numbers, finite and in range.

    `choice_code` is the code of an error where two fields that exclude each other are given, `choice_missing` that
    where none is, if one is required.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    choice_code: ClassVar[LiteralString] = "exclusive"
    choice_missing: ClassVar[LiteralString | None] = None

    @model_validator(mode="after")
    def one_of_each_choice(self) -> Self:
        """Refuse two fields that exclude each other, and none of them where one is required."""
        for group in self.exclusive:
            given = [name for name in group if getattr(self, name) is not None]
            if len(given) > 1:
                raise PydanticCustomError(
                    self.choice_code, "{names} are both given; keep one", {"names": " and ".join(given[:2])}
                )
            if self.choice_missing and not given:
                raise PydanticCustomError(self.choice_missing, "give {names}", {"names": " or ".join(group)})
        return self

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


class Group(Documented):
    """A part of a response; nothing in it is NaN or infinite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    _declares: ClassVar = Output


class Notice(Group):
    """A value outside its range of validity, or without meaning."""

    rank: Annotated[
        Rank,
        Output(
            "rank of the warning",
            text="invalid: a result is missing or the theory does not hold; doubtful: a limit is left; note: left out, "
            "assumed or without meaning; the gravest first",
        ),
    ]
    code: Annotated[str, Output("code of the warning", text="stable name, meant for programs")]
    message: Annotated[str, Output("message of the warning", text="what is out of which range, and what follows")]
    field: Annotated[
        str | None, Output("field of the warning", text="dotted name of the request field it is about")
    ] = None


class Assumption(Group):
    """A default that this result used and that is ours, not the paper's."""

    field: Annotated[str, Output("assumed field", text="dotted name of the request field")]
    value: Annotated[Any, Output("assumed value", text="the value used")]
    reason: Annotated[str, Output("reason of the assumption", text="why this value")]


class Derived(Group):
    """What follows from the request before any physics."""


class Response(Group):
    """What every result says about itself; each adds its results."""

    _optional: ClassVar = True

    status: Annotated[
        Literal["ok", "ok_with_warnings", "no_solution"],
        Output("status", text="whether the calculation succeeded; with no_solution, `residuals` says how far it came"),
    ]
    warnings: Annotated[list[Notice], Output("warnings", text="limits of validity that this result touches")]
    residuals: Annotated[
        dict[str, float] | None, Output("residuals", text="how far an iteration without a solution came")
    ] = None
    assumptions: Annotated[
        list[Assumption], Output("assumptions", text="defaults used that are ours and not the paper's")
    ]
    model_version: Annotated[str, Output("model version", text="version of the model that computed this result")]
    sources: Annotated[
        str,
        Output("sources of the solvers", text="SHA-256 of the solvers' syntax trees; equal for equal calculations"),
    ]
    model: Annotated[dict[str, Any], Output("options in force")]
    derived: Annotated[Derived | None, Output("derived", text="what follows from the request before any physics")] = (
        None
    )
    inputs: Annotated[
        dict[str, Any],
        Output("inputs", text="the request with its defaults, to be posted"),
    ]
    case: Annotated[
        str,
        Output("case", text="SHA-256 of endpoint, inputs and sources; equal cases have equal results"),
    ]

    _result: Any = PrivateAttr(default=None)

    @property
    def result(self) -> Any:
        """The solver's result that the response was read from, in SI; None where there is none."""
        return self._result

    def read_from(self, result: Any) -> Self:
        """The response with the solver's result kept beside it, for its figures."""
        self._result = result
        return self

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Results stand before what they rest on."""
        for name in ("assumptions", "model_version", "sources", "model", "derived", "inputs", "case"):
            cls.model_fields[name] = cls.model_fields.pop(name)
        cls.model_rebuild(force=True)
