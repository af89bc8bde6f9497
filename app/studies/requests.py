"""The bodies of the studies: sweep, sensitivity, spectrum, corners and design."""

import json
import re
from importlib.resources import files
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

from app.examples import examples
from app.schema.quantities import Input

MOST_FIELDS_TOGETHER = 50  # that one axis moves, chosen
LARGEST = 1e300  # of any number given: its square may overflow, itself not
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
_NUMBER_SCHEMA = {"type": "number", "minimum": -LARGEST, "maximum": LARGEST}
_SCALAR_SCHEMA = {"anyOf": [_NUMBER_SCHEMA, {"type": "string"}, {"type": "boolean"}, {"type": "null"}]}
_SCALARS_SCHEMA = {"anyOf": [*_SCALAR_SCHEMA["anyOf"], {"type": "array", "items": _SCALAR_SCHEMA}]}

# One validator for each alternative, so that an error points at the value and not at one of its types.
FieldPath = Annotated[Any, AfterValidator(_field_path), WithJsonSchema(_PATH_SCHEMA)]
FieldPaths = Annotated[Any, AfterValidator(_field_paths), WithJsonSchema({"anyOf": [_PATH_SCHEMA, _PATHS_SCHEMA]})]
Value = Annotated[Any, AfterValidator(_scalar), WithJsonSchema(_SCALAR_SCHEMA)]
Values = Annotated[Any, AfterValidator(_scalars), WithJsonSchema(_SCALARS_SCHEMA)]
Overrides = dict[str, Scalar]
Cases = Annotated[list[dict[str, Value]] | None, Field(min_length=1)]


class Part(BaseModel):
    """A part of a study: unknown fields are refused, numbers are finite, and one of `exactly_one` is given."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    exactly_one: ClassVar[tuple[str, ...]] = ()

    @model_validator(mode="after")
    def one_is_given(self) -> Self:
        """Refuse none and several of the fields that exclude each other."""
        if self.exactly_one and sum(getattr(self, name) is not None for name in self.exactly_one) != 1:
            *names, last = self.exactly_one
            known = ", ".join(names)
            raise PydanticCustomError(f"{'_'.join(names)}_or_{last}", f"Give exactly one of {known} and {last}")
        return self


class FieldsTogether(Part):
    """Fields that are varied together."""

    path: FieldPaths

    @property
    def paths(self) -> list[str]:
        """The fields."""
        return self.path if isinstance(self.path, list) else [self.path]


class Axis(FieldsTogether):
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


class Spread(Part):
    """The distribution of one field."""

    path: Annotated[FieldPath, Input("field that scatters", text="dotted path of the field")]


class Range(Spread):
    """A uniform distribution between two ends."""

    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]


KIND = Input("distribution", source="scipy.stats", text="name of the distribution")


class Uniform(Range):
    """A uniform distribution between two ends."""

    distribution: Annotated[Literal["uniform"], KIND]


class Triangular(Range):
    """A triangular distribution: its density rises linearly from both ends to the most frequent value."""

    distribution: Annotated[Literal["triangular"], KIND]
    mode: Annotated[float, Input("most frequent value")]


class Normal(Spread):
    """Normally distributed, cut at four deviations and at the field's own range."""

    distribution: Annotated[Literal["normal"], KIND]
    mean: Annotated[float, Input("mean")]
    deviation: Annotated[float, Input("standard deviation", gt=0.0, le=LARGEST)]


class Lognormal(Spread):
    """Its logarithm is normally distributed; cut at four deviations and at the field's own range."""

    distribution: Annotated[Literal["lognormal"], KIND]
    median: Annotated[float, Input("median", gt=0.0)]
    factor: Annotated[
        float, Input("factor", text="one standard deviation: the median times or by this factor", gt=1.0, le=1e6)
    ]


Scatter = Normal | Lognormal | Uniform | Triangular
Inputs = Annotated[list[Annotated[Scatter, Field(discriminator="distribution")]], Field(min_length=1, max_length=50)]
Method = Literal["latin_hypercube", "sobol"]
Seed = Annotated[int, Input("seed", text="equal seeds give equal points", ge=0, le=2**32 - 1)]
METHOD = Input("method of sampling", source="scipy.stats.qmc", text="how the points are spread over the ranges")
COUNT = Input("number of points", text="how many points; a power of two for Sobol", ge=1, le=1_000_000)


class Sample(Part):
    """Points at random: evenly over ranges, or by distributions."""

    exactly_one = ("ranges", "inputs")
    method: Annotated[Method, METHOD] = "latin_hypercube"
    count: Annotated[int, COUNT]
    seed: Seed = 1
    ranges: Annotated[
        list[Range] | None, Field(min_length=1, max_length=50), Input("ranges", text="the fields and their ranges")
    ] = None
    inputs: Annotated[Inputs | None, Input("distributions", text="the fields and their distributions")] = None


class Bound(Part):
    """A limit on one output."""

    output: Annotated[FieldPath, Input("limited output", text="dotted path of one of the outputs")]
    min: Annotated[float | None, Input("least permissible value")] = None
    max: Annotated[float | None, Input("largest permissible value")] = None


class Best(Part):
    """Which point is the best one."""

    exactly_one = ("minimise", "maximise")
    minimise: Annotated[FieldPath | None, Input("output to minimise")] = None
    maximise: Annotated[FieldPath | None, Input("output to maximise")] = None
    where: Annotated[list[Bound], Field(max_length=20), Input("limits", text="limits that the best point keeps")] = []

    @property
    def output(self) -> str:
        """The output that decides."""
        return str(self.minimise or self.maximise)


FromIndex = Annotated[
    int,
    Input(
        "index of the first point",
        text="where to continue a study whose connection was lost; the lines of its points are the same from there "
        "on, and the last line summarises these points alone",
        ge=0,
        le=1_000_000,
    ),
]

Outputs = Annotated[
    list[FieldPath] | None,
    Field(min_length=1, max_length=100),
    Input("outputs", text="dotted paths of the single values wanted", default_text="the headline numbers"),
]


class StudyRequest(Part):
    """The endpoint and the request of a study."""

    endpoint: Annotated[str, Input("endpoint", text="the endpoint that is asked, as in GET /v1/examples")]
    request: Annotated[
        dict[str, Any], Input("request", text="the endpoint's request; a field that is varied may be left out")
    ]
    outputs: Outputs = None


class SweepRequest(StudyRequest):
    """One request at many points: a grid, a list of cases or a random sample."""

    exactly_one = ("vary", "cases", "sample")
    vary: Annotated[list[Axis] | None, Field(min_length=1, max_length=3), Input("axes of a grid")] = None
    cases: Annotated[Cases, Input("cases", text="what each case changes")] = None
    sample: Annotated[Sample | None, Input("random sample")] = None
    best: Annotated[Best | None, Input("best point", text="which point to pick at the end")] = None
    from_index: FromIndex = 0


class LoadCase(Part):
    """A part of the operating time, and what it changes in the request."""

    name: Annotated[str | None, Field(max_length=100), Input("name", default_text="its number")] = None
    share: Annotated[
        float | None, Input("share", text="of the operating time", ge=0.0, le=1.01, default_text="equal shares")
    ] = None
    set: Annotated[dict[str, Value], Input("what the case changes", text="values by their dotted paths")] = {}


class Tolerances(Part):
    """The distributions of the fields of a machine, and how many machines are drawn."""

    method: Annotated[Method, METHOD] = "sobol"
    count: Annotated[int, COUNT] = 128
    replicates: Annotated[
        int, Input("replicates", text="independent samples; the scatter of their means is the error", ge=1, le=1000)
    ] = 8
    seed: Seed = 1
    inputs: Annotated[Inputs, Input("distributions", text="the fields and their distributions")]


class Threshold(Part):
    """A number, or normally distributed: a property of oil and material, one value for all cases of a machine."""

    value: Annotated[float | None, Input("fixed limit", ge=-LARGEST, le=LARGEST)] = None
    mean: Annotated[float | None, Input("mean of the limit", ge=-LARGEST, le=LARGEST)] = None
    deviation: Annotated[float | None, Input("standard deviation of the limit", gt=0.0, le=LARGEST)] = None

    @model_validator(mode="after")
    def one_kind(self) -> Self:
        """Refuse a limit that is neither fixed nor distributed."""
        if (self.mean is None) != (self.deviation is None) or (self.value is None) == (self.mean is None):
            raise PydanticCustomError("value_or_mean", "Give either value, or mean and deviation")
        return self


class SpectrumLimit(Part):
    """A limit on one output of every case."""

    exactly_one = ("above", "below")
    output: Annotated[FieldPath, Input("limited output", text="dotted path of a single number of the answer")]
    above: Annotated[Threshold | None, Input("upper limit", text="values above it exceed the limit")] = None
    below: Annotated[Threshold | None, Input("lower limit", text="values below it exceed the limit")] = None


class SpectrumRequest(StudyRequest):
    """A machine with its tolerances over the cases of its load spectrum."""

    cases: Annotated[
        list[LoadCase],
        Field(min_length=1, max_length=100),
        Input("cases", text="what each case changes, and its share"),
    ]
    tolerances: Annotated[Tolerances | None, Input("tolerances", default_text="the nominal machine alone")] = None
    limits: Annotated[
        list[SpectrumLimit] | None,
        Field(max_length=20),
        Input(
            "limits",
            text="values that an output must not exceed",
            default_text="the scuffing temperature, where there is one",
        ),
    ] = None
    hours_per_year: Annotated[
        float | None,
        Input("hours per year", text="operating time, to turn mean powers into energies", gt=0.0, le=8784.0),
    ] = None
    points: Annotated[bool, Input("points", text="whether every solved point is a line of the answer")] = False


class SensitivityRequest(StudyRequest):
    """How each output moves with each input."""

    inputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=200),
        Input("inputs", text="dotted paths of the numbers to move", default_text="every number of the case"),
    ] = None


DRIVE_TRAIN = "/v1/drive-train"
Ranges = Annotated[list[Axis] | None, Field(max_length=20)]
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

    sample: ClassVar[None] = None
    best: ClassVar[None] = None

    ranges: Annotated[Ranges, Input("ranges", text=_RANGES, default_text=USUAL_RANGES)] = None
    outputs: Outputs = None
    from_index: FromIndex = 0


class Variable(FieldsTogether):
    """A number that the search varies, and its range."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]
    step: Annotated[
        float | None,
        Input("step", text="to what the best value is rounded, which is then judged once more", gt=0, le=1e6),
    ] = None


class DesignRequest(DriveTrainStudy):
    """The flank correction whose worst corner is best."""

    variables: Annotated[list[Variable], Field(min_length=1, max_length=10), Input("variables")]
    corners: Annotated[Ranges, Input("corners", text=_RANGES, default_text="the request's own")] = None
    collective: Annotated[
        Cases, Input("collective", text="operating points, as what each changes", default_text="the request's own")
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


EXAMPLES: dict[str, dict[str, Any]] = json.loads(files("app.studies").joinpath("examples.json").read_text("utf-8"))
"""Bodies to start from, by the path of the study, each as OpenAPI has it: a `summary` and a `value`."""

for _bodies in EXAMPLES.values():
    for _each in _bodies.values():
        _each["value"]["request"] = examples()[_each["value"]["request"]].request
