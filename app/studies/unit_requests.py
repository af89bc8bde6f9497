"""What studies of a gear unit are asked: the bodies of POST /v1/drive-train/corners and /v1/drive-train/design."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from app.schema.quantities import Input
from app.studies.requests import Axis, FieldPath, FieldPaths, Part, Value

ENDPOINT = "/v1/drive-train"

_RANGES = "what each uncertain field, or several together, may be; every combination is a corner"
USUAL_RANGES = (
    "wall response, clearances of a shaft's plain bearings against each other, friction, direction of the offset and "
    "thrust of the couplings"
)


class UnitStudy(Part):
    """A study of one gear unit."""

    endpoint: ClassVar[str] = ENDPOINT

    request: Annotated[dict[str, Any], Input("request", text="the request of /v1/drive-train")]


class CornersRequest(UnitStudy):
    """The unit at every corner of what nobody knows better."""

    ranges: Annotated[
        list[Axis] | None, Field(max_length=20), Input("ranges", text=_RANGES, default_text=USUAL_RANGES)
    ] = None
    outputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=100),
        Input("outputs", text="dotted paths of the single values wanted", default_text="the headline numbers"),
    ] = None


class Variable(Part):
    """A number that the search may choose."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]

    @property
    def paths(self) -> list[str]:
        """The fields that take the value."""
        return self.path if isinstance(self.path, list) else [self.path]


class DesignRequest(UnitStudy):
    """The correction that is best where it is worst."""

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
