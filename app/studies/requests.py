"""What a study is asked: the body of POST /v1/sweep and POST /v1/sensitivity."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from app.contract.quantities import Input

Scalar = bool | int | float | str | None
Overrides = dict[str, Scalar]


class _Part(BaseModel):
    """A part of a study: unknown fields are refused, numbers are finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Axis(_Part):
    """One axis of a grid: the values a field takes, listed or spread between two ends."""

    path: Annotated[str | list[str], Input("the field to vary, or several that move together")]
    values: Annotated[list[Scalar] | None, Field(min_length=1), Input("the values one by one")] = None
    start: Annotated[float | None, Input("first value of an even spread")] = None
    stop: Annotated[float | None, Input("last value of an even spread")] = None
    count: Annotated[int | None, Input("how many values from start to stop", ge=2, le=1_000_000)] = None
    scale: Annotated[Literal["linear", "log"], Input("even steps, or even ratios")] = "linear"

    @property
    def paths(self) -> list[str]:
        """The fields that take the values."""
        return self.path if isinstance(self.path, list) else [self.path]


class Range(_Part):
    """The range of one sampled field."""

    path: Annotated[str, Input("the field to sample")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]


class Sample(_Part):
    """Points spread at random over ranges."""

    method: Annotated[
        Literal["latin_hypercube", "sobol"], Input("how the points are spread", None, "scipy.stats.qmc")
    ] = "latin_hypercube"
    count: Annotated[int, Input("how many points; a power of two for Sobol", ge=1, le=1_000_000)]
    seed: Annotated[int, Input("seed of the random numbers: equal seeds give equal points", ge=0, le=2**32 - 1)] = 1
    ranges: Annotated[list[Range], Field(min_length=1, max_length=50), Input("the fields and their ranges")]


class Bound(_Part):
    """A limit on one output."""

    output: Annotated[str, Input("the output")]
    min: Annotated[float | None, Input("least value allowed")] = None
    max: Annotated[float | None, Input("largest value allowed")] = None


class Best(_Part):
    """Which point is the best one."""

    minimise: Annotated[str | None, Input("the output that should be small")] = None
    maximise: Annotated[str | None, Input("the output that should be large")] = None
    where: Annotated[list[Bound], Field(max_length=20), Input("limits on other outputs")] = []

    @model_validator(mode="after")
    def one_direction(self) -> Self:
        """Refuse both directions and neither."""
        if (self.minimise is None) == (self.maximise is None):
            raise PydanticCustomError("minimise_or_maximise", "give either minimise or maximise")
        return self


class StudyRequest(_Part):
    """What every study is about: one endpoint, one request."""

    endpoint: Annotated[str, Input("the endpoint, as in GET /v1/examples")]
    request: Annotated[dict[str, Any], Input("its request; a field that is varied may be left out")]
    outputs: Annotated[
        list[str] | None,
        Field(min_length=1, max_length=100),
        Input("dotted paths of the numbers wanted; null: the headline numbers"),
    ] = None


class SweepRequest(StudyRequest):
    """One request at many points: a grid, a list of cases or a random sample."""

    vary: Annotated[list[Axis] | None, Field(min_length=1, max_length=3), Input("axes of a grid")] = None
    cases: Annotated[list[Overrides] | None, Field(min_length=1), Input("a list of overrides")] = None
    sample: Annotated[Sample | None, Input("a random sample")] = None
    best: Annotated[Best | None, Input("the point to pick")] = None

    @model_validator(mode="after")
    def one_kind(self) -> Self:
        """Refuse none and several of grid, list and sample."""
        if sum(part is not None for part in (self.vary, self.cases, self.sample)) != 1:
            raise PydanticCustomError("vary_cases_or_sample", "give exactly one of vary, cases and sample")
        return self


class SensitivityRequest(StudyRequest):
    """How each output moves with each input."""

    inputs: Annotated[
        list[str] | None, Field(min_length=1, max_length=200), Input("the inputs to move; null: every number")
    ] = None
