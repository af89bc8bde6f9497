"""Attributes read as numbers in the units that the requests use, with account of what was wrong and what was used."""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from math import isfinite
from typing import Any

from app.rexs.model import Attribute, Component, LoadCase, Model
from app.rexs.units import converted

LARGEST = 1e30  # in any unit; keeps sums and products of a hostile file finite
Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong in the file."""

    code: str
    component: int | None
    attribute: str | None
    message: str


@dataclass(frozen=True, slots=True)
class Missing:
    """A field of a request that the file does not give: the calculation needs it."""

    field: str
    component: int | None
    attribute: str | None
    message: str


@dataclass(frozen=True, slots=True)
class Assumed:
    """A field of a request that the file does not give, and what was put there."""

    field: str
    value: Any
    reason: str


@dataclass(frozen=True, slots=True)
class Ignored:
    """What the file says and the models cannot use."""

    component: int
    attribute: str | None
    reason: str


@dataclass
class Reading:
    """The model, read once: every attribute asked for is noted, and every fault becomes a finding."""

    model: Model
    findings: dict[Finding, None] = field(default_factory=dict)
    used: set[tuple[int, str]] = field(default_factory=set)

    def find(self, code: str, component: Component | None, attribute: str | None, message: str) -> None:
        """Note a fault, once."""
        self.findings[Finding(code, component.id if component else None, attribute, message)] = None

    def number(
        self,
        component: Component,
        names: str | Sequence[str],
        unit: str = "",
        case: LoadCase | None = None,
    ) -> float | None:
        """The first of the attributes that is there, in `unit`, or None.

        A value that is no number or has a unit of another quantity is a finding and not used. `case` may override
        it.
        """
        for name in (names,) if isinstance(names, str) else names:
            attribute = self._attribute(component, name, case)
            if attribute is not None:
                found = self._in_unit(component, attribute, unit)
                if found is not None:
                    return found
        return None

    def text(self, component: Component, names: str | Sequence[str]) -> str | None:
        """The first of the attributes that is there, as text in lower case."""
        for name in (names,) if isinstance(names, str) else names:
            attribute = self._attribute(component, name)
            if attribute is not None and isinstance(attribute.value, str) and attribute.value:
                return attribute.value.lower()
        return None

    def flag(self, component: Component, name: str) -> bool | None:
        """A yes or no, or None."""
        attribute = self._attribute(component, name)
        if attribute is None:
            return None
        return {"true": True, "1": True, "false": False, "0": False}.get(str(attribute.value).lower())

    def vector(self, component: Component, name: str) -> Vector | None:
        """Three numbers (lengths in mm where the attribute is a length), or None."""
        attribute = self._attribute(component, name)
        if attribute is None or not isinstance(attribute.value, list) or len(attribute.value) != 3:
            return None
        try:
            x, y, z = (float(each) for each in attribute.value)
        except (TypeError, ValueError):
            self.find("not_a_number", component, name, "the vector is not three numbers")
            return None
        if not max(abs(x), abs(y), abs(z)) <= LARGEST:
            self.find("not_a_number", component, name, "the vector is not three finite numbers")
            return None
        scale = converted(1.0, attribute.unit, "mm") or 1.0
        return x * scale, y * scale, z * scale

    def ignored(self, components: Iterable[Component], reasons: dict[str, str]) -> list[Ignored]:
        """What these components say that was not asked for; `reasons` by the attribute's name or its beginning."""
        found = []
        for component in components:
            for name in component.attributes:
                if (component.id, name) not in self.used:
                    reason = next((why for start, why in reasons.items() if name.startswith(start)), reasons[""])
                    found.append(Ignored(component.id, name, reason))
        return found

    def _attribute(self, component: Component, name: str, case: LoadCase | None = None) -> Attribute | None:
        if case is not None and (found := case.attributes.get(component.id, {}).get(name)) is not None:
            return found
        found = component.attributes.get(name)
        if found is not None:
            self.used.add((component.id, name))
        return found

    def _in_unit(self, component: Component, attribute: Attribute, unit: str) -> float | None:
        try:
            value = float(attribute.value)
        except (TypeError, ValueError, OverflowError):
            self.find("not_a_number", component, attribute.name, f"{attribute.name} is not a number; not used")
            return None
        if not isfinite(value):
            self.find("not_a_number", component, attribute.name, f"{attribute.name} is not finite; not used")
            return None
        found = converted(value, attribute.unit, unit)
        if found is None:
            stated = attribute.unit[:20] or "no unit"
            message = f"{attribute.name} is in {stated}, which is not a unit of its quantity ({unit}); not used"
            self.find("unit", component, attribute.name, message)
        elif abs(found) > LARGEST:
            self.find("not_a_number", component, attribute.name, f"{attribute.name} is beyond any machine; not used")
            return None
        return found


def rows(found: Iterable[Any]) -> list[dict[str, Any]]:
    """Findings, missing, assumed or ignored values as JSON objects."""
    return [asdict(each) for each in found]
