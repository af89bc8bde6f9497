"""Requests while they are put together: fields with their origin in the file, and what is missing or assumed."""

from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from app.calculations import BY_PATH
from app.rexs.model import Component, LoadCase
from app.rexs.reading import Assumed, Missing, Reading
from app.rexs.table import Row
from app.schema.reading import faults

Origin = tuple[Component, str | None]


@dataclass
class Draft:
    """Fields by their dotted path in the request of /v1/scuffing, and where in the file they come from."""

    reading: Reading
    fields: dict[str, Any] = field(default_factory=dict)
    origins: dict[str, Origin] = field(default_factory=dict)
    missing: dict[str, Missing] = field(default_factory=dict)
    assumed: dict[str, Assumed] = field(default_factory=dict)

    def put(self, path: str, value: Any, component: Component, attribute: str | None = None) -> None:
        """Set a field from the file."""
        self.fields[path] = value
        self.origins[path] = component, attribute

    def assume(self, path: str, value: Any, reason: str) -> None:
        """Set a field that the file does not give."""
        self.fields[path] = value
        self.assumed[path] = Assumed(path, value, reason)

    def note(self, path: str, value: Any, reason: str) -> None:
        """Say how the value of a field was chosen, where the file leaves a choice."""
        self.assumed[path] = Assumed(path, value, reason)

    def lacks(self, path: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Record that the file does not contain a field without a default."""
        self.missing.setdefault(path, Missing(path, component.id if component else None, attribute, message))

    def take(self, row: Row, component: Component, prefix: str = "", case: LoadCase | None = None) -> float | None:
        """Take a number over as it stands."""
        found = self.reading.number(component, row.attributes, row.unit, case=case)
        if found is not None:
            self.put(prefix + row.field, found, component, row.attributes[0])
        return found


def validated(endpoint: str, draft: Draft, paths: dict[str, str]) -> dict[str, Any]:
    """The request of an endpoint from the fields of the draft that it takes, without those that it refuses.

    `paths`: from the draft's path to the request's. What the endpoint refuses is a finding with its range where it
    comes from the file; what it needs and does not get is missing.
    """
    own = {ours: theirs for ours, theirs in paths.items() if ours in draft.fields}
    model = BY_PATH[endpoint].request
    while True:
        request = nested({theirs: draft.fields[ours] for ours, theirs in own.items()})
        try:
            model.model_validate(request)
        except ValidationError as error:
            found = faults(model, map(dict, error.errors()))
        else:
            return request
        refused = False
        for fault in found:
            at = fault.pointer.strip("/").replace("/", ".")
            if any(_within(field, at) or _within(at, field) for field in map(str, draft.missing)):
                continue  # known to be missing
            ours = next((each for each, theirs in own.items() if _within(at, theirs)), None)
            if ours is None:
                back = next((each for each, theirs in paths.items() if theirs == at), at)
                draft.lacks(back, None, None, fault.message)
                continue
            refused = True
            component, attribute = draft.origins.get(ours, (None, None))
            draft.reading.find("out_of_range", component, attribute, f"{ours}: {fault.message}; not used")
            draft.lacks(ours, component, attribute, f"the file's value is not possible: {fault.message}")
            del own[ours]
        if not refused:
            return request


def _within(path: str, section: str) -> bool:
    return path == section or path.startswith(section + ".")


def nested(fields: dict[str, Any]) -> dict[str, Any]:
    """Sections within sections, from dotted paths."""
    request: dict[str, Any] = {}
    for path, value in fields.items():
        *sections, name = path.split(".")
        here = request
        for section in sections:
            here = here.setdefault(section, {})
        here[name] = value
    return request
