"""Attributes read as numbers in the units of the requests, and the draft of a request that they fill.

Whatever happens on the way is recorded for the answer: what is wrong in the file, missing, assumed or not used.
"""

import re
from collections.abc import Collection, Iterable, Iterator
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite, sqrt
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel

from app.calculations import BY_PATH
from app.errors import InvalidBody
from app.rexs.model import Attribute, Component, LoadCase, Model
from app.rexs.table import APPLICATION_FACTOR, IGNORED, SCUFFING_FACTOR, Row, converted
from app.schema.quantities import Output
from app.schema.reading import validated

LARGEST = 1e30  # in any unit; keeps sums and products of a hostile file finite
DIGITS = 7
SCUFFING = "/v1/scuffing"
MESH = {"gears", "load", "materials", "modifications", "friction_coefficient"}
SECTIONS = {
    "/v1/scuffing/load-distribution": MESH,
    SCUFFING: MESH | {"temperatures", "lubricant"},
    "/v1/pumping": {"gears"},
}
"""What of a draft is in the requests for a single mesh."""
Vector = tuple[float, float, float]


class Axis(NamedTuple):
    """A shaft's axis in the unit: its origin [mm] and its direction."""

    origin: Vector
    direction: Vector

    def along(self, point: Vector) -> float:
        """Coordinate of a point along the axis [mm]."""
        return sum((a - b) * u for a, b, u in zip(point, self.origin, self.direction, strict=True))

    def apart(self, other: "Axis") -> float:
        """Distance of another axis' origin from this axis [mm]."""
        along = self.along(other.origin)
        across = (a - b - along * u for a, b, u in zip(other.origin, self.origin, self.direction, strict=True))
        return sqrt(sum(each * each for each in across))


class Number(NamedTuple):
    """A number of the file in the unit asked for, and its attribute."""

    value: float
    attribute: str


class Fault(BaseModel, frozen=True):
    """Something wrong in the file."""

    code: Annotated[str, Output("stable name, meant for programs")]
    component: Annotated[int | None, Output("component in the file")]
    attribute: Annotated[str | None, Output("attribute")]
    message: Annotated[str, Output("what is wrong, and what was done about it")]


class MissingValue(BaseModel):
    """A field that a calculation needs and the file does not contain."""

    field: Annotated[str, Output("dotted path of the field, or the endpoint that cannot be asked")]
    component: Annotated[int | None, Output("component in the file that could give it")]
    attribute: Annotated[str | None, Output("attribute that could give it")]
    message: Annotated[str, Output("what is missing")]


class AssumedValue(BaseModel):
    """What stands in place of something that the file does not give."""

    field: Annotated[str, Output("dotted path of the field")]
    value: Annotated[Any, Output("value used")]
    reason: Annotated[str, Output("why")]


class Unused(BaseModel):
    """What the file says and the models cannot use."""

    component: Annotated[int, Output("component in the file")]
    attribute: Annotated[str | None, Output("attribute, or the whole component")]
    reason: Annotated[str, Output("why")]
    case: Annotated[str | None, Output("load case that says it; null where the model does")] = None


@dataclass
class Reading:
    """The model, read once: every attribute asked for is noted, and every fault becomes a finding.

    `case`: the load case whose attributes take the place of the model's. `used`: what was asked for of the model, and
    `used_of_case` of the load case.
    """

    model: Model
    case: LoadCase | None = None
    findings: dict[Fault, None] = field(default_factory=dict)
    used: set[tuple[int, str]] = field(default_factory=set)
    used_of_case: set[tuple[int, str]] = field(default_factory=set)

    def in_case(self, case: LoadCase | None) -> "Reading":
        """Return a reading of the model with the values of a load case in place of its own."""
        found = copy(self)  # with what is known of its shafts
        found.case, found.used_of_case = case, set()
        return found

    def says(self, component: Component, name: str) -> bool:
        """Whether the load case itself states an attribute."""
        return self.case is not None and name in self.case.attributes.get(component.id, {})

    def find(self, code: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Note a fault, once."""
        id_ = component.id if component else None
        if (
            component is not None
            and attribute is not None
            and self.case is not None
            and self.says(component, attribute)
        ):
            message = f"load case {self.case.name[:40]}: {message}"
        self.findings[Fault(code=code, component=id_, attribute=attribute, message=message)] = None

    def number(self, component: Component | None, wanted: Row | str, unit: str = "") -> float | None:
        """The first of the attributes of a row that is there, in its unit, or an attribute in `unit`; else None.

        A value that is no number or has a unit of another quantity is a finding and not used.
        """
        names, unit = (wanted.attributes, wanted.unit) if isinstance(wanted, Row) else ((wanted,), unit)
        found = self.first_of(component, names, unit)
        return None if found is None else found.value

    def first_of(self, component: Component | None, names: Iterable[str], unit: str) -> "Number | None":
        """The first of these attributes that is a number of this quantity, and its name."""
        if component is None:
            return None
        for name in names:
            attribute = self._attribute(component, name)
            value = None if attribute is None else self._in_unit(component, attribute, unit)
            if value is not None:
                return Number(value, name)
        return None

    def text(self, component: Component, name: str) -> str:
        """A text in lower case; empty where the attribute is not there."""
        attribute = self._attribute(component, name)
        return str(attribute.value).lower() if attribute is not None and isinstance(attribute.value, str) else ""

    def flag(self, component: Component, name: str) -> bool | None:
        """A yes or no, or None."""
        attribute = self._attribute(component, name)
        said = "" if attribute is None else str(attribute.value).lower()
        return {"true": True, "1": True, "false": False, "0": False}.get(said)

    def vector(self, component: Component, name: str) -> Vector | None:
        """Three numbers (lengths in mm where the attribute is a length), or None."""
        attribute = self._attribute(component, name)
        if attribute is None or not isinstance(attribute.value, list) or len(attribute.value) != 3:
            return None
        try:
            x, y, z = (float("true" if isinstance(each, bool) else each) for each in attribute.value)
        except (TypeError, ValueError, OverflowError):
            self.find("not_a_number", component, name, "the vector is not three numbers")
            return None
        if not all(abs(each) <= LARGEST for each in (x, y, z)):
            self.find("not_a_number", component, name, "the vector is not three finite numbers")
            return None
        scale = converted(1.0, attribute.unit, "mm") or 1.0
        return x * scale, y * scale, z * scale

    def axis(self, shaft: Component) -> Axis | None:
        """Where a shaft lies, if the file says so."""
        origin, direction = self.vector(shaft, "support_vector"), self.vector(shaft, "u_axis_vector")
        if origin is None:
            return None
        x, y, z = direction or (1.0, 0.0, 0.0)
        size = sqrt(x * x + y * y + z * z)
        if not size > 0.0:
            self.find("axis", shaft, "u_axis_vector", "the axis has no direction")
            return None
        return Axis(origin, (x / size, y / size, z / size))

    def sense(self, shaft: Component) -> float:
        """+1 where the u axis of a shaft points as that of the first shaft that has one, or is not known; else -1."""
        return self._senses.get(shaft.id, 1.0)

    @cached_property
    def _senses(self) -> dict[int, float]:
        axes = {shaft.id: axis.direction for shaft in self.model.by_type["shaft"] if (axis := self.axis(shaft))}
        base = next(iter(axes.values()), (0.0, 0.0, 0.0))
        cosines = {id_: sum(a * b for a, b in zip(axis, base, strict=True)) for id_, axis in axes.items()}
        return {id_: 1.0 if cosine >= 0.0 else -1.0 for id_, cosine in cosines.items()}

    def ignored(self, components: Iterable[Component]) -> Iterator[Unused]:
        """What these components say that was not asked for."""
        for component in components:
            for name in component.attributes:
                if (component.id, name) not in self.used:
                    yield Unused(component=component.id, attribute=name, reason=why_unused(component.type, name))

    def ignored_of_case(self, elsewhere: Collection[int]) -> Iterator[Unused]:
        """What the load case says that was not asked for, but for what it says of the components `elsewhere`."""
        if (case := self.case) is None:
            return
        for id_, attributes in case.attributes.items():
            type_ = self.model.components[id_].type if id_ in self.model.components else ""
            for name in attributes if id_ not in elsewhere else ():
                if (id_, name) not in self.used_of_case:
                    yield Unused(component=id_, attribute=name, reason=why_unused(type_, name), case=case.name)

    def _attribute(self, component: Component, name: str) -> Attribute | None:
        if self.case is not None and (found := self.case.attributes.get(component.id, {}).get(name)) is not None:
            self.used_of_case.add((component.id, name))
            return found
        found = component.attributes.get(name)
        if found is not None:
            self.used.add((component.id, name))
        return found

    def _in_unit(self, component: Component, attribute: Attribute, unit: str) -> float | None:
        code, name = "not_a_number", attribute.name
        try:
            value = float("true" if isinstance(attribute.value, bool) else attribute.value)
        except (TypeError, ValueError, OverflowError):
            self.find(code, component, name, f"{name} is not a number; not used")
            return None
        found = converted(value, attribute.unit, unit)
        if not isfinite(value):
            fault = "is not finite"
        elif found is None:
            code, stated = "unit", attribute.unit[:20] or "no unit"
            fault = f"is in {stated}, which is not a unit of its quantity ({unit})"
        elif abs(found) > LARGEST:
            fault = "is beyond any machine"
        else:
            return found
        self.find(code, component, name, f"{name} {fault}; not used")
        return None


@dataclass
class Draft:
    """Fields by their dotted path in the request of /v1/scuffing, and where in the file they come from."""

    reading: Reading
    fields: dict[str, Any] = field(default_factory=dict)
    origins: dict[str, tuple[Component, str | None]] = field(default_factory=dict)
    missing: dict[str, MissingValue] = field(default_factory=dict)
    assumed: dict[str, AssumedValue] = field(default_factory=dict)

    def put(self, path: str, value: Any, component: Component, attribute: str | None = None) -> None:
        """Set a field from the file."""
        self.fields[path] = value
        self.origins[path] = component, attribute

    def assume(self, path: str, value: Any, reason: str) -> None:
        """Set a field that the file does not give."""
        self.fields[path] = value
        self.note(path, value, reason)

    def note(self, path: str, value: Any, reason: str) -> None:
        """Say how the value of a field was chosen, where the file leaves a choice."""
        self.assumed[path] = AssumedValue(field=path, value=value, reason=reason)

    def lacks(self, path: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Record that the file does not contain a field without a default."""
        id_ = component.id if component else None
        self.missing.setdefault(path, MissingValue(field=path, component=id_, attribute=attribute, message=message))

    def take(self, row: Row, component: Component | None, prefix: str = "") -> float | None:
        """Take a number over as it stands."""
        found = self.reading.first_of(component, row.attributes, row.unit)
        if component is None or found is None:
            return None
        self.put(prefix + row.field, found.value, component, found.attribute)
        return found.value

    def request(self, endpoint: str, paths: Iterable[str]) -> dict[str, Any]:
        """The request of an endpoint from these fields, without those that it does not know or refuses.

        What the endpoint refuses is a finding with its range where it comes from the file; what it needs and does not
        get is missing.
        """
        replaced = endpoint == SCUFFING and SCUFFING_FACTOR in self.fields
        known = {
            ours: theirs
            for ours in paths
            if (theirs := path_in(endpoint, ours)) is not None and not (replaced and ours == APPLICATION_FACTOR)
        }
        own = {ours: theirs for ours, theirs in known.items() if ours in self.fields}
        model = BY_PATH[endpoint].request
        while True:
            request = _nested({theirs: rounded(self.fields[ours]) for ours, theirs in own.items()})
            try:
                validated(model, request)
            except InvalidBody as error:
                found = error.faults
            else:
                return request
            accepted = len(own)
            for fault in found:
                at = fault.pointer.strip("/").replace("/", ".")
                if any(_within(path, at) or _within(at, path) for path in self.missing):
                    continue  # known to be missing
                ours = next((each for each, theirs in own.items() if _within(at, theirs)), None)
                if ours is None:
                    back = next((each for each, theirs in known.items() if theirs == at), at)
                    self.lacks(back, None, None, fault.message)
                    continue
                component, attribute = self.origins.get(ours, (None, None))
                self.reading.find("out_of_range", component, attribute, f"{ours}: {fault.message}; not used")
                self.lacks(ours, component, attribute, f"the file's value is not possible: {fault.message}")
                del own[ours]
            if len(own) == accepted:
                return request


def path_in(endpoint: str, path: str) -> str | None:
    """Where a field of the draft is in the request of an endpoint; None where the endpoint has no such field."""
    if path == SCUFFING_FACTOR:
        return APPLICATION_FACTOR if endpoint == SCUFFING else None
    if endpoint == "/v1/drive-train" or (endpoint, path) == ("/v1/pumping", "load.pinion_speed_rpm"):
        return path.replace("load.", "operation.", 1)
    unknown = {"gears.hand"} if endpoint == "/v1/pumping" else {"gears.hand", "gears.normal_backlash_mm"}
    return path if path.partition(".")[0] in SECTIONS[endpoint] and path not in unknown else None


def rounded(value: Any) -> Any:
    """A value with its numbers at the seven digits that a page shows."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [rounded(each) for each in value]
    if isinstance(value, dict):
        return {name: rounded(each) for name, each in value.items()}
    return value


def why_unused(type_: str, name: str) -> str:
    """Return the reason why an attribute of a component type is not used."""
    return next(why for types, names, why in IGNORED if re.fullmatch(types, type_) and re.search(names, name))


def _within(path: str, section: str) -> bool:
    return path == section or path.startswith(section + ".")


def _nested(fields: dict[str, Any]) -> dict[str, Any]:
    """Sections within sections, from dotted paths."""
    request: dict[str, Any] = {}
    for path, value in fields.items():
        *sections, name = path.split(".")
        here = request
        for section in sections:
            here = here.setdefault(section, {})
        here[name] = value
    return request
