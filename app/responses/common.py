"""What every response has in common."""

from importlib.metadata import version
from typing import Annotated, Any, ClassVar, Literal

from pydantic import ConfigDict

from app.schema.model import Documented
from app.schema.quantities import Output

MODEL_VERSION = version("tribodrive")


class Group(Documented):
    """A part of a response; nothing in it is NaN or infinite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    _declares: ClassVar = Output


class Notice(Group):
    """A value outside its range of validity, or without meaning."""

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

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Results stand before what they rest on."""
        for name in ("assumptions", "model_version", "sources", "model", "derived", "inputs", "case"):
            cls.model_fields[name] = cls.model_fields.pop(name)
        cls.model_rebuild(force=True)
