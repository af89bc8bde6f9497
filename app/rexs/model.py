"""What a REXS file holds: components with attributes, relations between them, load cases.

REXS (Reusable Engineering EXchange Standard, FVA, https://www.rexs.info) describes a gear unit as a graph. Versions 1.0
to 2.0 share this structure; the names of some components and attributes differ (see `table`).
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any


@dataclass(frozen=True, slots=True)
class Attribute:
    """A value and the unit that the file states for it ("" where it states none).

    `value` is what the file says: text (XML), a number, text or boolean (JSON), a list for an array, or None.
    """

    name: str
    unit: str
    value: Any


@dataclass(frozen=True, slots=True)
class Component:
    """A part of the gear unit."""

    id: int
    type: str
    name: str
    attributes: dict[str, Attribute]


@dataclass(frozen=True, slots=True)
class Relation:
    """Which components belong together, and as what: (role, component id) in the order of the file."""

    type: str
    order: int | None
    parts: tuple[tuple[str, int], ...]

    def part(self, role: str) -> int | None:
        """The component in a role."""
        return next((each for name, each in self.parts if name == role), None)


@dataclass(frozen=True, slots=True)
class LoadCase:
    """A case of the load spectrum: the attributes that differ from the model's, by component."""

    name: str
    attributes: dict[int, dict[str, Attribute]]


@dataclass(frozen=True)
class Model:
    """A gear unit as its file describes it."""

    version: str
    application: str
    components: dict[int, Component]
    relations: tuple[Relation, ...]
    load_cases: tuple[LoadCase, ...] = ()

    @cached_property
    def _by_part(self) -> dict[tuple[str, str, int], list[Relation]]:
        found = defaultdict(list)
        for relation in self.relations:
            for role, component in relation.parts:
                found[relation.type, role, component].append(relation)
        return found

    @cached_property
    def casing(self) -> Component | None:
        """The casing of the unit."""
        return next((each for each in self.components.values() if each.type == "gear_casing"), None)

    def relations_of(self, type_: str, role: str, component: int) -> tuple[Relation, ...]:
        """The relations of a type in which the component has the role, by their order where they state one."""
        found = self._by_part.get((type_, role, component), ())
        return tuple(sorted(found, key=lambda each: (each.order is None, each.order or 0)))

    def related(self, type_: str, role: str, component: int, other: str) -> Iterator[Component]:
        """The components in the role `other` of relations in which the component has the role `role`."""
        for relation in self.relations_of(type_, role, component):
            found = relation.part(other)
            if found in self.components:
                yield self.components[found]

    def parts_of(self, assembly: int) -> Iterator[Component]:
        """The parts of an assembly (ordered or not), each once."""
        seen = set()
        for type_ in ("ordered_assembly", "assembly"):
            for part in self.related(type_, "assembly", assembly, "part"):
                if part.id not in seen:
                    seen.add(part.id)
                    yield part

    def whole_of(self, part: int, *types: str) -> Component | None:
        """The assembly of one of the types that the component is a part of."""
        wholes = self.related("assembly", "part", part, "assembly")
        return next((each for each in wholes if each.type in types), None)

    def references_of(self, origin: int, *types: str) -> Iterator[Component]:
        """What a component refers to (its lubricant, material, modifications, tools)."""
        for relation_type in ("reference", "ordered_reference"):
            for each in self.related(relation_type, "origin", origin, "referenced"):
                if each.type in types:
                    yield each
