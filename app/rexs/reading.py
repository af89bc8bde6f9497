"""Numbers from the attributes of a REXS file in the units of the requests, and the draft of a request.

`Reading` records the faults of the file and the attributes that have been read. `Draft` records the missing and the
assumed values.
"""

import re
from collections.abc import Collection, Iterable, Iterator
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite, sqrt
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel

from app.calculations import BY_PATH, CALCULATIONS
from app.errors import InvalidBody
from app.rexs.model import NO_CASE, Attribute, Component, LoadCase, RexsUnit
from app.rexs.table import APPLICATION_FACTOR, EXTERNAL, IGNORED, SCUFFING_FACTOR, Row, convert
from app.schema.fields import is_below, nested
from app.schema.quantities import Output
from app.schema.reading import validated

LARGEST = 1e30  # largest absolute value of an accepted number; sums and products of such numbers stay finite
DIGITS = 7
PARALLEL = 0.9  # axes of shafts with a larger cosine between them count as parallel; chosen
SCUFFING, TRAIN = "/v1/scuffing", "/v1/drive-train"
_FROM_FILES = {each.path: each.words.from_file for each in CALCULATIONS if each.words.from_file}
READABLE = dict(sorted(_FROM_FILES.items(), key=lambda item: "load" not in (item[1].sections or ())))
"""What the endpoints take of a draft whose requests are made from files; those that take the load come first."""
Vector = tuple[float, float, float]


class ShaftAxis(NamedTuple):
    """A shaft's axis in the unit: its origin [mm] and its direction."""

    origin: Vector
    direction: Vector

    def along(self, point: Vector) -> float:
        """Return the coordinate of a point along the axis, measured from the origin of the axis [mm]."""
        return sum((a - b) * u for a, b, u in zip(point, self.origin, self.direction, strict=True))

    def apart(self, other: "ShaftAxis") -> float:
        """Return the distance [mm] between this axis and the origin of the other axis."""
        along = self.along(other.origin)
        across = (a - b - along * u for a, b, u in zip(other.origin, self.origin, self.direction, strict=True))
        return sqrt(sum(part * part for part in across))


class Fault(BaseModel, frozen=True):
    """A fault in the file."""

    code: Annotated[str, Output("stable name, meant for programs")]
    component: Annotated[int | None, Output("component in the file")]
    attribute: Annotated[str | None, Output("attribute")]
    message: Annotated[str, Output("what is wrong, and what is used instead")]


class MissingValue(BaseModel):
    """A field that has no value, because the value does not follow from the file. A calculation needs this value."""

    field: Annotated[str, Output("dotted path of the field, or the endpoint that cannot be asked")]
    component: Annotated[int | None, Output("component in the file that could give it")]
    attribute: Annotated[str | None, Output("attribute that could give it")]
    message: Annotated[str, Output("what is missing")]


class AssumedValue(BaseModel):
    """A value used for a field that the file does not give."""

    field: Annotated[str, Output("dotted path of the field")]
    value: Annotated[Any, Output("value used")]
    reason: Annotated[str, Output("why")]


class Unused(BaseModel):
    """An attribute or component of the file that the models do not use."""

    component: Annotated[int, Output("component in the file")]
    attribute: Annotated[str | None, Output("attribute, or the whole component")]
    reason: Annotated[str, Output("why")]
    case: Annotated[str | None, Output("load case with the attribute; null if it is the model's")] = None


@dataclass
class Reading:
    """Reader of the attributes in a model. The reader also records faults of the file as findings.

    The attributes of the load case `case` replace the attributes of the model. `used` and `used_of_case` record which
    attributes of the model and of the load case have been read, as pairs of component id and attribute name.
    """

    model: RexsUnit
    case: LoadCase = NO_CASE
    findings: dict[Fault, None] = field(default_factory=dict)
    used: set[tuple[int, str]] = field(default_factory=set)
    used_of_case: set[tuple[int, str]] = field(default_factory=set)

    def in_case(self, case: LoadCase) -> "Reading":
        """Return a reader in which the values of a load case replace the values of the model."""
        reading = copy(self)  # the copy keeps the cached directions of the shafts
        reading.case, reading.used_of_case = case, set()
        return reading

    def says(self, component: Component, name: str) -> bool:
        """Return True if the load case states an attribute, False if the attribute can only come from the model."""
        return name in self.case.attributes.get(component.id, {})

    def find(self, code: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Record a fault as a finding. A fault that is already recorded is not recorded again."""
        id_ = component.id if component else None
        if component is not None and attribute is not None and self.says(component, attribute):
            message = f"load case {self.case.name[:40]}: {message}"
        self.findings[Fault(code=code, component=id_, attribute=attribute, message=message)] = None

    def number(self, component: Component | None, wanted: Row | str, unit: str = "") -> float | None:
        """Return the number in an attribute of a component, or None if the file has no usable number."""
        names, unit = (wanted.attributes, wanted.unit) if isinstance(wanted, Row) else ((wanted,), unit)
        return self.first_of(component, names, unit)[0]

    def first_of(
        self, component: Component | None, names: Iterable[str], unit: str
    ) -> tuple[float, str] | tuple[None, None]:
        """Return the first number among the attributes `names` of a component, converted to `unit`, and its attribute.

        Values that are not numbers or cannot be converted are skipped.
        """
        if component is None:
            return None, None
        for name in names:
            attribute = self._attribute(component, name)
            value = None if attribute is None else self._in_unit(component, attribute, unit)
            if value is not None:
                return value, name
        return None, None

    def text(self, component: Component, name: str) -> str:
        """Return the text of an attribute in lower case; empty if the file has no such attribute."""
        attribute = self._attribute(component, name)
        return str(attribute.value).lower() if attribute is not None and isinstance(attribute.value, str) else ""

    def flag(self, component: Component, name: str) -> bool | None:
        """Return the boolean value of an attribute, or None if the file has no such attribute."""
        attribute = self._attribute(component, name)
        text = "" if attribute is None else str(attribute.value).lower()
        return {"true": True, "1": True, "false": False, "0": False}.get(text)

    def is_elsewhere(self, component: Component | None) -> bool:
        """Return whether a component refers to data in another file (REXS 1.5 and later)."""
        return component is not None and any(
            (attribute := component.attributes.get(name)) is not None and attribute.value not in (None, "")
            for name in EXTERNAL
        )

    def flags(self, component: Component, name: str) -> list[bool]:
        """Return the boolean values of an attribute, which may be a single value; empty if there are none."""
        attribute = self._attribute(component, name)
        values = (
            [] if attribute is None else attribute.value if isinstance(attribute.value, list) else [attribute.value]
        )
        return [str(value).lower() in {"true", "1"} for value in values]

    def vector(self, component: Component, name: str) -> Vector | None:
        """Return the vector in an attribute, or None if the file has no such vector. Lengths are converted to mm."""
        attribute = self._attribute(component, name)
        if attribute is None or not isinstance(attribute.value, list) or len(attribute.value) != 3:
            return None
        try:
            x, y, z = (float("true" if isinstance(number, bool) else number) for number in attribute.value)
        except (TypeError, ValueError, OverflowError):
            self.find("not_a_number", component, name, "the vector is not three numbers")
            return None
        if not all(abs(number) <= LARGEST for number in (x, y, z)):
            self.find("not_a_number", component, name, "the vector is not three finite numbers")
            return None
        scale = convert(1.0, attribute.unit, "mm") or 1.0
        return x * scale, y * scale, z * scale

    def axis(self, shaft: Component) -> ShaftAxis | None:
        """Return the axis of a shaft, or None if the file does not state the position of the shaft."""
        origin, direction = self.vector(shaft, "support_vector"), self.vector(shaft, "u_axis_vector")
        if origin is None:
            return None
        x, y, z = direction or (1.0, 0.0, 0.0)
        size = sqrt(x * x + y * y + z * z)
        if not size > 0.0:
            self.find("axis", shaft, "u_axis_vector", "the axis has no direction")
            return None
        return ShaftAxis(origin, (x / size, y / size, z / size))

    def sense(self, shaft: Component) -> float:
        """Return the direction of a shaft's u axis: +1 along the axis of the unit, -1 against the axis of the unit."""
        return self._senses.get(shaft.id, 1.0)

    @cached_property
    def _senses(self) -> dict[int, float]:
        axes = {shaft.id: axis.direction for shaft in self.model.by_type["shaft"] if (axis := self.axis(shaft))}
        bases, senses = list[Vector](), dict[int, float]()
        for id_, direction in axes.items():
            cosines = (sum(a * b for a, b in zip(direction, base, strict=True)) for base in bases)
            cosine = next((cosine for cosine in cosines if abs(cosine) > PARALLEL), None)
            if cosine is None:
                bases.append(direction)
            senses[id_] = -1.0 if cosine is not None and cosine < 0.0 else 1.0
        return senses

    def ignored(self, components: Iterable[Component]) -> Iterator[Unused]:
        """Yield the attributes of `components` that have not been read, each with the reason why it is not used."""
        for component in components:
            for name in component.attributes:
                if (component.id, name) not in self.used:
                    yield Unused(component=component.id, attribute=name, reason=why_unused(component.type, name))

    def ignored_of_case(self, elsewhere: Collection[int]) -> Iterator[Unused]:
        """Yield the attributes of the load case that have not been read."""
        for id_, attributes in self.case.attributes.items():
            type_ = self.model.components[id_].type if id_ in self.model.components else ""
            for name in attributes if id_ not in elsewhere else ():
                if (id_, name) not in self.used_of_case:
                    yield Unused(component=id_, attribute=name, reason=why_unused(type_, name), case=self.case.name)

    def _attribute(self, component: Component, name: str) -> Attribute | None:
        if (attribute := self.case.attributes.get(component.id, {}).get(name)) is not None:
            self.used_of_case.add((component.id, name))
            return attribute
        attribute = component.attributes.get(name)
        if attribute is not None:
            self.used.add((component.id, name))
        return attribute

    def _in_unit(self, component: Component, attribute: Attribute, unit: str) -> float | None:
        code, name = "not_a_number", attribute.name
        try:
            value = float("true" if isinstance(attribute.value, bool) else attribute.value)
        except (TypeError, ValueError, OverflowError):
            self.find(code, component, name, f"{name} is not a number; the value is not used")
            return None
        result = convert(value, attribute.unit, unit)
        if not isfinite(value):
            fault = "is not finite"
        elif result is None:
            code, stated = "unit", attribute.unit[:20] or "no unit"
            fault = f"is in {stated}, which is not a unit of its quantity ({unit})"
        elif abs(result) > LARGEST:
            fault = "is too large"
        else:
            return result
        self.find(code, component, name, f"{name} {fault}; the value is not used")
        return None


@dataclass
class Draft:
    """Draft of a request: values of fields, and the components and attributes of the file from which they come.

    All dictionaries of the draft have dotted paths in the request of /v1/scuffing as keys. The draft also records
    missing and assumed values.
    """

    reading: Reading
    fields: dict[str, Any] = field(default_factory=dict)
    origins: dict[str, tuple[Component, str | None]] = field(default_factory=dict)
    missing: dict[str, MissingValue] = field(default_factory=dict)
    assumed: dict[str, AssumedValue] = field(default_factory=dict)

    def put(self, path: str, value: Any, component: Component, attribute: str | None = None) -> None:
        """Set a field to a value from the file, and record the component and the attribute that contain the value."""
        self.fields[path] = value
        self.origins[path] = component, attribute

    def assume(self, path: str, value: Any, reason: str) -> None:
        """Assume a value for a field that the file does not give, and record the reason for this value."""
        self.fields[path] = value
        self.note(path, value, reason)

    def note(self, path: str, value: Any, reason: str) -> None:
        """Record a field, its value and the reason for this value among the assumed values."""
        self.assumed[path] = AssumedValue(field=path, value=value, reason=reason)

    def lacks(self, path: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Record that a field has no value, although a calculation needs the value."""
        id_ = component.id if component else None
        self.missing.setdefault(path, MissingValue(field=path, component=id_, attribute=attribute, message=message))

    def take(self, row: Row, component: Component | None, prefix: str = "") -> float | None:
        """Copy a number from the file into a field of the draft.

        `row` contains the path of the field, and the names of the attributes of `component` that may contain the
        number. `prefix` is put before the path of the field. Return the number, or None if there is no usable number.
        """
        value, attribute = self.reading.first_of(component, row.attributes, row.unit)
        if component is not None and value is not None:
            self.put(prefix + row.field, value, component, attribute)
        return value

    def request(self, endpoint: str, paths: Iterable[str]) -> dict[str, Any]:
        """Return a request for an endpoint, made from those fields of the draft that are in `paths`.

        Fields that the endpoint does not have are left out. Fields whose values the endpoint rejects are also left out;
        a finding gives the reason. Rejected fields and required fields without a value are recorded as missing.
        """
        replaced = READABLE[endpoint].path(SCUFFING_FACTOR) is not None and SCUFFING_FACTOR in self.fields
        places = {
            ours: theirs
            for ours in paths
            if (theirs := READABLE[endpoint].path(ours)) is not None and not (replaced and ours == APPLICATION_FACTOR)
        }
        own = {ours: theirs for ours, theirs in places.items() if ours in self.fields}
        model = BY_PATH[endpoint].request
        while True:
            request = nested({theirs: rounded(self.fields[ours]) for ours, theirs in own.items()})
            try:
                validated(model, request)
            except InvalidBody as error:
                faults = error.faults
            else:
                return request
            accepted = len(own)
            for fault in faults:
                at = fault.pointer.strip("/").replace("/", ".")
                if any(is_below(path, at) or is_below(at, path) for path in self.missing):
                    continue  # already recorded as missing
                ours = next((path for path, theirs in own.items() if is_below(at, theirs)), None)
                if ours is None:
                    back = next((path for path, theirs in places.items() if theirs == at), at)
                    self.lacks(back, None, None, fault.message)
                    continue
                component, attribute = self.origins.get(ours, (None, None))
                self.reading.find(
                    "out_of_range", component, attribute, f"{ours}: {fault.message}; the value in the file is not used"
                )
                self.lacks(ours, component, attribute, f"the value in the file is not permissible: {fault.message}")
                del own[ours]
            if len(own) == accepted:
                return request


def rounded(value: Any) -> Any:
    """Round all numbers in a value to seven significant digits, the number of digits that a page shows."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [rounded(item) for item in value]
    if isinstance(value, dict):
        return {name: rounded(item) for name, item in value.items()}
    return value


def why_unused(type_: str, name: str) -> str:
    """Return the reason why an attribute of a component type is not used."""
    return next(why for types, names, why in IGNORED if re.fullmatch(types, type_) and re.search(names, name))
