"""What a REXS file holds: components with attributes, relations between them, load cases.

REXS (Reusable Engineering EXchange Standard, FVA, https://www.rexs.info) describes a gear unit as a graph. Versions 1.0
to 2.0 share this structure; the names of some components and attributes differ (see `table`).
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

ASSEMBLIES = ("ordered_assembly", "assembly")  # relations of a part to its whole


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
        """The id of the component in a role."""
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
    def by_type(self) -> defaultdict[str, list[Component]]:
        """The components of each type, in the order of the file."""
        found = defaultdict(list)
        for component in self.components.values():
            found[component.type].append(component)
        return found

    @cached_property
    def _by_part(self) -> dict[tuple[str, str, int], list[Relation]]:
        found = defaultdict(list)
        for relation in self.relations:
            for role, component in relation.parts:
                found[relation.type, role, component].append(relation)
        return found

    def first(self, type_: str) -> Component | None:
        """The only component of a type such as `gear_unit` or `gear_casing`; the first one where there are several."""
        return next(iter(self.by_type[type_]), None)

    def part(self, relation: Relation, role: str) -> Component | None:
        """The component in a role of a relation."""
        id_ = relation.part(role)
        return None if id_ is None else self.components.get(id_)

    def relations_of(self, type_: str, role: str, component: int) -> Sequence[Relation]:
        """The relations of a type in which the component has the role, by their order where they state one."""
        found = self._by_part.get((type_, role, component), ())
        return sorted(found, key=lambda each: (each.order is None, each.order or 0))

    def related(self, type_: str, role: str, component: int, other: str) -> Iterator[Component]:
        """The components in the role `other` of relations in which the component has the role `role`."""
        found = (self.part(relation, other) for relation in self.relations_of(type_, role, component))
        return (each for each in found if each is not None)

    def parts_of(self, assembly: int) -> Sequence[Component]:
        """The parts of an assembly, each once."""
        found = (each for kind in ASSEMBLIES for each in self.related(kind, "assembly", assembly, "part"))
        return list({part.id: part for part in found}.values())

    def whole_of(self, part: int, type_: str) -> Component | None:
        """The assembly of a type that the component is a part of."""
        wholes = (each for kind in ASSEMBLIES for each in self.related(kind, "part", part, "assembly"))
        return next((each for each in wholes if each.type == type_), None)

    def reference_of(self, origins: Iterable[Component | None], type_: str) -> Component | None:
        """The first component of a type that one of these refers to."""
        found = (each for origin in origins if origin is not None for each in self.references_of(origin.id, type_))
        return next(found, None)

    def references_of(self, origin: int, *types: str) -> Iterator[Component]:
        """What a component refers to (its lubricant, material, modifications, tools)."""
        for relation_type in ("reference", "ordered_reference"):
            for each in self.related(relation_type, "origin", origin, "referenced"):
                if each.type in types:
                    yield each
