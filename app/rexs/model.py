"""The content of a REXS file: components with attributes, relations between components, and load cases.

REXS (Reusable Engineering EXchange Standard, FVA, https://www.rexs.info) describes a gear unit as a graph. Versions 1.0
to 2.0 share this structure; the names of some components and attributes differ (see `table`).
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

ASSEMBLIES = ("ordered_assembly", "assembly")  # types of the relations between a part and a whole


@dataclass(frozen=True, slots=True)
class Attribute:
    """A value and its unit in the file.

    `unit` is empty if the value has no unit. In XML, `value` is a text. In JSON, `value` is a number, a text or a
    boolean. In both formats, the value of an array is a list, and a missing value is None.
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
    """A relation between components.

    `parts` holds a pair for each component: the role of the component in the relation, and the id of the component. The
    pairs are in the order of the file.
    """

    type: str
    order: int | None
    parts: tuple[tuple[str, int], ...]

    def part(self, role: str) -> int | None:
        """Return the id of the component that has a role in this relation, or None if no component has the role."""
        return next((id_ for name, id_ in self.parts if name == role), None)


@dataclass(frozen=True, slots=True)
class LoadCase:
    """A case of the load spectrum.

    `attributes` holds attributes of components; the keys are the ids of the components. In this load case, these
    attributes replace the attributes of the model.
    """

    name: str
    attributes: dict[int, dict[str, Attribute]]


NO_CASE = LoadCase("", {})
"""The load case in which every attribute is that of the model."""


@dataclass(frozen=True)
class RexsUnit:
    """A gear unit as its file describes it."""

    version: str
    application: str
    components: dict[int, Component]
    relations: tuple[Relation, ...]
    load_cases: tuple[LoadCase, ...] = ()

    @cached_property
    def by_type(self) -> defaultdict[str, list[Component]]:
        """The components of each type, in the order of the file. The keys are the types."""
        components = defaultdict(list)
        for component in self.components.values():
            components[component.type].append(component)
        return components

    @cached_property
    def _by_part(self) -> dict[tuple[str, str, int], list[Relation]]:
        relations = defaultdict(list)
        for relation in self.relations:
            for role, component in relation.parts:
                relations[relation.type, role, component].append(relation)
        return relations

    def first(self, type_: str) -> Component | None:
        """Return the first component of a type. A file usually has only one `gear_unit` and only one `gear_casing`."""
        return next(iter(self.by_type[type_]), None)

    def part(self, relation: Relation, role: str) -> Component | None:
        """Return the component with the role `role` in a relation, or None if there is no such component."""
        id_ = relation.part(role)
        return None if id_ is None else self.components.get(id_)

    def relations_of(self, type_: str, role: str, component: int) -> Sequence[Relation]:
        """Return those relations of the type `type_` in which the component `component` has the role `role`."""
        relations = self._by_part.get((type_, role, component), ())
        return sorted(relations, key=lambda relation: (relation.order is None, relation.order or 0))

    def related(self, type_: str, role: str, component: int, other: str) -> Iterator[Component]:
        """Yield the components with the role `other` in those relations in which `component` has the role `role`."""
        partners = (self.part(relation, other) for relation in self.relations_of(type_, role, component))
        return (partner for partner in partners if partner is not None)

    def parts_of(self, assembly: int) -> Sequence[Component]:
        """Return the components that an assembly consists of. Each component is listed once."""
        parts = (part for kind in ASSEMBLIES for part in self.related(kind, "assembly", assembly, "part"))
        return list({part.id: part for part in parts}.values())

    def whole_of(self, part: int, type_: str) -> Component | None:
        """Return the assembly of type `type_` that contains the component `part`."""
        wholes = (whole for kind in ASSEMBLIES for whole in self.related(kind, "part", part, "assembly"))
        return next((whole for whole in wholes if whole.type == type_), None)

    def reference_of(self, origins: Iterable[Component | None], type_: str) -> Component | None:
        """Return the first component of type `type_` to which one of the components `origins` refers.

        The origins are searched in their order. Return None if no origin refers to such a component.
        """
        given = (origin for origin in origins if origin is not None)
        return next((reference for origin in given for reference in self.references_of(origin.id, type_)), None)

    def references_of(self, origin: int, *types: str) -> Iterator[Component]:
        """Yield the components of the types `types` to which the component `origin` refers."""
        for relation_type in ("reference", "ordered_reference"):
            for reference in self.related(relation_type, "origin", origin, "referenced"):
                if reference.type in types:
                    yield reference
