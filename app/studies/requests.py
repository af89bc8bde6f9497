"""The bodies of the studies: sweep, sensitivity, corners and design."""

import re
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

from app.schema.quantities import Input

MOST_FIELDS_TOGETHER = 50
LARGEST = 1e300
_PATH = re.compile(r"[A-Za-z0-9_]{1,60}(\.[A-Za-z0-9_]{1,60}){0,9}")


def _field_path(value: Any) -> str:
    if not isinstance(value, str) or not _PATH.fullmatch(value):
        raise PydanticCustomError("path_type", "Give the path of a field: names joined by dots")
    return value


def _field_paths(value: Any) -> str | list[str]:
    if not isinstance(value, list):
        return _field_path(value)
    if not 0 < len(value) <= MOST_FIELDS_TOGETHER:
        raise PydanticCustomError("path_type", "Give one path, or a list of up to fifty that move together")
    return [_field_path(each) for each in value]


def _scalar(value: Any) -> Any:
    finite = isinstance(value, int | float) and abs(value) <= LARGEST
    if not (value is None or isinstance(value, str) or finite):
        raise PydanticCustomError("scalar_type", "Give a finite number, a word, true, false or null")
    return value


def _scalars(value: Any) -> Any:
    return [_scalar(each) for each in value] if isinstance(value, list) else _scalar(value)


Scalar = bool | int | float | str | None
_PATH_SCHEMA: dict[str, Any] = {"type": "string", "pattern": f"^{_PATH.pattern}$"}
_PATHS_SCHEMA = {"type": "array", "items": _PATH_SCHEMA, "minItems": 1, "maxItems": MOST_FIELDS_TOGETHER}
_SCALAR_SCHEMA = {
    "anyOf": [
        {"type": "number", "minimum": -LARGEST, "maximum": LARGEST},
        {"type": "string"},
        {"type": "boolean"},
        {"type": "null"},
    ]
}

# One validator for each alternative, so that an error points at the value and not at one of its types.
FieldPath = Annotated[Any, AfterValidator(_field_path), WithJsonSchema(_PATH_SCHEMA)]
FieldPaths = Annotated[Any, AfterValidator(_field_paths), WithJsonSchema({"anyOf": [_PATH_SCHEMA, _PATHS_SCHEMA]})]
Value = Annotated[Any, AfterValidator(_scalar), WithJsonSchema(_SCALAR_SCHEMA)]
Values = Annotated[
    Any,
    AfterValidator(_scalars),
    WithJsonSchema({"anyOf": [*_SCALAR_SCHEMA["anyOf"], {"type": "array", "items": _SCALAR_SCHEMA}]}),
]
Overrides = dict[str, Scalar]


class Part(BaseModel):
    """A part of a study: unknown fields are refused, numbers are finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Axis(Part):
    """One axis of a grid: the values a field takes, listed or spread between two ends."""

    path: Annotated[FieldPaths, Input("varied field", text="dotted path of the field, or several that move together")]
    values: Annotated[
        list[Values] | None,
        Field(min_length=1),
        Input("values", text="the values one by one; a list gives each of several fields its own"),
    ] = None
    start: Annotated[float | None, Input("first value", text="first value of an even spread")] = None
    stop: Annotated[float | None, Input("last value", text="last value of an even spread")] = None
    count: Annotated[
        int | None, Input("number of values", text="how many values from start to stop", ge=2, le=1_000_000)
    ] = None
    scale: Annotated[Literal["linear", "log"], Input("scale", text="even steps or even ratios from start to stop")] = (
        "linear"
    )

    @property
    def paths(self) -> list[str]:
        """The fields that take the values."""
        return self.path if isinstance(self.path, list) else [self.path]


class Range(Part):
    """The range of one sampled field."""

    path: Annotated[FieldPath, Input("sampled field", text="dotted path of the field")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]


class Sample(Part):
    """Points spread at random over ranges."""

    method: Annotated[
        Literal["latin_hypercube", "sobol"],
        Input("method of sampling", source="scipy.stats.qmc", text="how the points are spread over the ranges"),
    ] = "latin_hypercube"
    count: Annotated[
        int, Input("number of points", text="how many points; a power of two for Sobol", ge=1, le=1_000_000)
    ]
    seed: Annotated[int, Input("seed", text="equal seeds give equal points", ge=0, le=2**32 - 1)] = 1
    ranges: Annotated[
        list[Range], Field(min_length=1, max_length=50), Input("ranges", text="the fields and their ranges")
    ]


class Bound(Part):
    """A limit on one output."""

    output: Annotated[FieldPath, Input("limited output", text="dotted path of one of the outputs")]
    min: Annotated[float | None, Input("least value allowed")] = None
    max: Annotated[float | None, Input("largest value allowed")] = None


class Best(Part):
    """Which point is the best one."""

    minimise: Annotated[FieldPath | None, Input("output to minimise")] = None
    maximise: Annotated[FieldPath | None, Input("output to maximise")] = None
    where: Annotated[list[Bound], Field(max_length=20), Input("limits", text="limits that the best point keeps")] = []

    @model_validator(mode="after")
    def one_direction(self) -> Self:
        """Refuse both directions and neither."""
        if (self.minimise is None) == (self.maximise is None):
            raise PydanticCustomError("minimise_or_maximise", "Give either minimise or maximise")
        return self

    @property
    def output(self) -> str:
        """The output that decides."""
        return str(self.minimise or self.maximise)


class StudyRequest(Part):
    """What every study is about: one endpoint, one request."""

    endpoint: Annotated[str, Input("endpoint", text="the endpoint that is asked, as in GET /v1/examples")]
    request: Annotated[
        dict[str, Any], Input("request", text="the endpoint's request; a field that is varied may be left out")
    ]
    outputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=100),
        Input("outputs", text="dotted paths of the single values wanted", default_text="the headline numbers"),
    ] = None


class SweepRequest(StudyRequest):
    """One request at many points: a grid, a list of cases or a random sample."""

    vary: Annotated[list[Axis] | None, Field(min_length=1, max_length=3), Input("axes of a grid")] = None
    cases: Annotated[
        list[dict[str, Value]] | None, Field(min_length=1), Input("cases", text="what each case changes")
    ] = None
    sample: Annotated[Sample | None, Input("random sample")] = None
    best: Annotated[Best | None, Input("best point", text="which point to pick at the end")] = None

    @model_validator(mode="after")
    def one_kind(self) -> Self:
        """Refuse none and several of grid, list and sample."""
        if sum(part is not None for part in (self.vary, self.cases, self.sample)) != 1:
            raise PydanticCustomError("vary_cases_or_sample", "Give exactly one of vary, cases and sample")
        return self


class SensitivityRequest(StudyRequest):
    """How each output moves with each input."""

    inputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=200),
        Input("inputs", text="dotted paths of the numbers to move", default_text="every number of the case"),
    ] = None


DRIVE_TRAIN = "/v1/drive-train"
_RANGES = "what each uncertain field, or several together, may be; every combination is a corner"
USUAL_RANGES = (
    "wall response, clearances of a shaft's plain bearings against each other, friction, direction of the offset and "
    "thrust of the couplings"
)


class DriveTrainStudy(Part):
    """A study of a gear unit."""

    endpoint: ClassVar[str] = DRIVE_TRAIN

    request: Annotated[dict[str, Any], Input("request", text="the request of /v1/drive-train")]


class CornersRequest(DriveTrainStudy):
    """A gear unit at every combination of its uncertain inputs."""

    ranges: Annotated[
        list[Axis] | None, Field(max_length=20), Input("ranges", text=_RANGES, default_text=USUAL_RANGES)
    ] = None
    outputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=100),
        Input("outputs", text="dotted paths of the single values wanted", default_text="the headline numbers"),
    ] = None


class Variable(Part):
    """A number that the search varies, and its range."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]

    @property
    def paths(self) -> list[str]:
        """The fields that take the value."""
        return self.path if isinstance(self.path, list) else [self.path]


class DesignRequest(DriveTrainStudy):
    """The flank correction whose worst corner is best."""

    variables: Annotated[list[Variable], Field(min_length=1, max_length=10), Input("variables")]
    corners: Annotated[
        list[Axis] | None, Field(max_length=20), Input("corners", text=_RANGES, default_text="the request's own")
    ] = None
    collective: Annotated[
        list[dict[str, Value]] | None,
        Field(min_length=1),
        Input("collective", text="operating points, as what each changes", default_text="the request's own"),
    ] = None
    objective: Annotated[
        FieldPath, Input("objective", text="dotted path of the output that its worst corner judges")
    ] = "safety.minimum"
    direction: Annotated[
        Literal["maximise", "minimise"] | None,
        Input("direction", text="whether the objective shall be large or small", default_text="towards its safe side"),
    ] = None
    evaluations: Annotated[
        int, Input("evaluations", text="how many corrections may be tried at every corner", ge=1, le=1000)
    ] = 60
