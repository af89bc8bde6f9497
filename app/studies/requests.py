"""Common parts of the bodies of studies: paths and values of fields, axes, distributions, and the request to vary."""

import re
from itertools import accumulate
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from app.schema.quantities import Input

MOST_FIELDS_TOGETHER = 50  # largest number of fields that one axis moves, chosen
LARGEST = 1e300  # largest absolute value of a number in a study; chosen, below the largest finite float
_PATH = re.compile(r"[A-Za-z0-9_]{1,60}(\.[A-Za-z0-9_]{1,60}){0,9}")


def _field_path(value: Any) -> str:
    if not isinstance(value, str) or not _PATH.fullmatch(value):
        raise PydanticCustomError("path_type", "Give the path of a field, which consists of names joined by dots")
    return value


def _field_paths(value: Any) -> str | list[str]:
    if not isinstance(value, list):
        return _field_path(value)
    if not 0 < len(value) <= MOST_FIELDS_TOGETHER:
        raise PydanticCustomError(
            "path_type",
            "Give the path of one field, or a list of up to fifty paths; the fields of a list change together",
        )
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

# The types below are `Any` with one validator that tests all permitted types. With a union of types instead, pydantic
# would report one error per type, and would add the name of the type to the location of the error.
FieldPath = Annotated[Any, AfterValidator(_field_path), WithJsonSchema(_PATH_SCHEMA)]
FieldPaths = Annotated[Any, AfterValidator(_field_paths), WithJsonSchema({"anyOf": [_PATH_SCHEMA, _PATHS_SCHEMA]})]
Value = Annotated[Any, AfterValidator(_scalar), WithJsonSchema(_SCALAR_SCHEMA)]
Values = Annotated[Any, AfterValidator(_scalars), WithJsonSchema(_SCALARS_SCHEMA)]
Overrides = dict[str, Scalar]
Cases = Annotated[list[dict[str, Value]] | None, Field(min_length=1)]


class Part(BaseModel):
    """Base class of the parts of a study's body. Unknown fields and infinite numbers are refused.

    If `exactly_one` contains names of fields, exactly one of these fields must be given.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    exactly_one: ClassVar[tuple[str, ...]] = ()

    @model_validator(mode="after")
    def one_is_given(self) -> Self:
        """Raise an error unless exactly one of the fields in `exactly_one` is given, or `exactly_one` is empty."""
        if self.exactly_one and sum(getattr(self, name) is not None for name in self.exactly_one) != 1:
            *names, last = self.exactly_one
            known = ", ".join(names)
            raise PydanticCustomError(
                f"{'_'.join(names)}_or_{last}", f"Give exactly one of these fields: {known}, {last}"
            )
        return self


class FieldsTogether(Part):
    """Fields that are varied together."""

    path: FieldPaths

    @property
    def paths(self) -> list[str]:
        """The paths of the fields, as a list even if there is only one path."""
        return self.path if isinstance(self.path, list) else [self.path]


class Axis(FieldsTogether):
    """One axis of a grid: the values of one or more fields, either listed or spread evenly between two ends."""

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
    """A range of one field. The values are distributed uniformly between the two ends of the range."""

    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]


KIND = Input("distribution", source="scipy.stats", text="name of the distribution")


class Uniform(Range):
    """A uniform distribution between two ends."""

    distribution: Annotated[Literal["uniform"], KIND]


class Triangular(Range):
    """A triangular distribution. The density rises linearly from zero at both ends to the most frequent value."""

    distribution: Annotated[Literal["triangular"], KIND]
    mode: Annotated[float, Input("most frequent value")]


class Normal(Spread):
    """A normal distribution, cut off at four standard deviations and at the limits of the field's permissible range."""

    distribution: Annotated[Literal["normal"], KIND]
    mean: Annotated[float, Input("mean")]
    deviation: Annotated[float, Input("standard deviation", gt=0.0, le=LARGEST)]


class Lognormal(Spread):
    """A distribution in which the logarithm of the value is normally distributed.

    The distribution is cut off at four standard deviations of the logarithm, and at the limits of the field's
    permissible range.
    """

    distribution: Annotated[Literal["lognormal"], KIND]
    median: Annotated[float, Input("median", gt=0.0)]
    factor: Annotated[
        float,
        Input("factor", text="one standard deviation is the median times or divided by this factor", gt=1.0, le=1e6),
    ]


class Listed(Spread):
    """Values listed one by one, such as the load stages of a test, each with its weight."""

    distribution: Annotated[Literal["listed"], KIND]
    values: Annotated[list[float], Field(min_length=1, max_length=100), Input("values", text="the values one by one")]
    weights: Annotated[
        list[Annotated[float, Field(gt=0.0, le=LARGEST)]] | None,
        Input("weights", text="how often each value occurs, relative to the others", default_text="equal weights"),
    ] = None

    @field_validator("weights")
    @classmethod
    def one_weight_per_value(cls, weights: list[float] | None, info: ValidationInfo) -> list[float] | None:
        """Refuse weights whose number is not that of the values."""
        values = info.data.get("values")
        if weights is not None and values is not None and len(weights) != len(values):
            raise PydanticCustomError("weights", "Give one weight for each value, or no weights")
        return weights

    @property
    def ends(self) -> list[float]:
        """Cumulative share at each value; the last is 1."""
        weights = self.weights or [1.0] * len(self.values)
        largest = max(weights)
        sums = list(accumulate(weight / largest for weight in weights))
        return [each / sums[-1] for each in sums]


Scatter = Normal | Lognormal | Uniform | Triangular | Listed
Inputs = Annotated[list[Annotated[Scatter, Field(discriminator="distribution")]], Field(min_length=1, max_length=50)]
Method = Literal["latin_hypercube", "sobol"]
Seed = Annotated[int, Input("seed", text="equal seeds give equal points", ge=0, le=2**32 - 1)]
METHOD = Input("method of sampling", source="scipy.stats.qmc", text="how the points are spread over the ranges")
COUNT = Input("number of points", text="how many points; a power of two for Sobol", ge=1, le=1_000_000)

FromIndex = Annotated[
    int,
    Input(
        "index of the first point",
        text=(
            "first point to send, to continue an interrupted study; the last line summarises only the "
            "points from here on"
        ),
        ge=0,
        le=1_000_000,
    ),
]

Outputs = Annotated[
    list[FieldPath] | None,
    Field(min_length=1, max_length=100),
    Input("outputs", text="dotted paths of the single values wanted", default_text="the headline numbers"),
]


OilTests = Literal["by_stage", "held"]
OIL_TESTS = Input(
    "tests of the oil",
    text="if the oil varies: the load stages of its tests stay, or the limits that they prove for the case are held",
)


class StudyRequest(Part):
    """The endpoint of a study and the request that the study varies."""

    endpoint: Annotated[str, Input("endpoint", text="the endpoint that is asked, as in GET /v1/examples")]
    request: Annotated[
        dict[str, Any], Input("request", text="the endpoint's request; a field that is varied may be left out")
    ]
    outputs: Outputs = None


DRIVE_TRAIN = "/v1/drive-train"
Ranges = Annotated[list[Axis] | None, Field(max_length=20)]
RANGES = "what each uncertain field, or several together, may be; every combination is a corner"


class DriveTrainStudy(Part):
    """A study of a gear unit."""

    endpoint: ClassVar[str] = DRIVE_TRAIN

    request: Annotated[dict[str, Any], Input("request", text="the request of /v1/drive-train")]
