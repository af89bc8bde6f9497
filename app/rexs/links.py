"""Connections that carry speed and torque through a unit: joints between shafts and gears, and stages of other kinds.

A bevel stage, and a planetary stage with one held member, are not calculated themselves. But they pass speed and torque
on, without losses, to the cylindrical stages behind them.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from app.rexs import table
from app.rexs.model import Component
from app.rexs.reading import Reading

APEX = 1e-3  # a bevel gear nearer to the apex than this share of its distance from the other shaft says nothing


class SpeedLink(NamedTuple):
    """Two shafts whose speeds are in a fixed ratio: n_1 z_1 = -n_2 z_2, about the axis of the unit.

    The numbers z are signed. They are numbers of teeth, or a sum of numbers of teeth at a planet carrier. `reason`
    says what was assumed.
    """

    stage: Component
    shafts: tuple[Component, Component]
    teeth: tuple[int, int]
    reason: str


class Joint(NamedTuple):
    """A connection between two shafts, or between a shaft and a gear or the casing."""

    component: Component
    inner: Component
    outer: Component


def fastened(reading: Reading, shafts: Iterable[Component]) -> dict[int, int]:
    """Map every shaft to itself, and every gear that is a part of a shaft to this shaft."""
    gears = {
        part.id: shaft.id for shaft in shafts for part in reading.model.parts_of(shaft.id) if part.type in table.GEARS
    }
    return gears | {shaft.id: shaft.id for shaft in shafts}


def joints(reading: Reading) -> Iterator[Joint]:
    """Yield the connections of a unit except its bearings. Kinds that are not known are findings."""
    model = reading.model
    for relation in (relation for relation in model.relations if relation.type == "side"):
        joint, inner, outer = (model.part(relation, role) for role in ("assembly", "inner_part", "outer_part"))
        if joint is None or inner is None or outer is None or not {inner.type, outer.type} <= table.JOINED:
            continue
        if joint.type in table.JOINTS:
            yield Joint(joint, inner, outer)
        elif "bearing" not in joint.type:
            message = f"a connection of the type {joint.type[:40]} is not known; torque is not followed through it"
            reading.find("connection_not_modelled", joint, None, message)


class Groups:
    """The shafts and gears of a unit; those that turn as one form a group, which is named after one of its parts."""

    def __init__(self, reading: Reading, parts: dict[int, int], joints: Iterable[Joint]) -> None:
        self._reading, self._root = reading, dict(parts)
        held = set[int]()
        for joint in joints:
            ends = joint.inner, joint.outer
            if joint.component.type == table.SWITCHABLE and not self._is_engaged(joint.component):
                continue
            if table.CASING in {end.type for end in ends}:
                held.update(end.id for end in ends if end.type != table.CASING)
            else:
                self._root[self.of(joint.outer.id)] = self.of(joint.inner.id)
        self.held = {self.of(end) for end in held}  # the groups that are fastened to the casing

    def of(self, component: int) -> int:
        """Return the group of a shaft or gear; what is fastened to nothing is a group of its own."""
        root = component
        while self._root.get(root, root) != root:
            root = self._root[root]
        return root

    def _is_engaged(self, coupling: Component) -> bool:
        """Return whether a coupling is engaged: at the shift position of the unit, if the file states several."""
        engaged = self._reading.flags(coupling, "is_engaged")
        unit = self._reading.model.first("gear_unit")
        gear = self._reading.number(unit, "gear_shift_index") if len(set(engaged)) > 1 else 1.0
        if gear is not None and gear == int(gear) and 1 <= gear <= len(engaged):
            return engaged[int(gear) - 1]
        message = "the file does not say whether the coupling is engaged; it is taken as open"
        self._reading.find("coupling_state", coupling, "is_engaged", message)
        return False


def links(reading: Reading, groups: Groups) -> Iterator[SpeedLink]:
    """Yield the stages of other kinds through which speed and torque can be followed."""
    for stage in reading.model.by_type["bevel_stage"]:
        if (link := _bevel(reading, stage)) is not None:
            yield link
    for stage in reading.model.by_type["planetary_stage"]:
        if (link := _planetary(reading, stage, groups)) is not None:
            yield link


def shaft_of(reading: Reading, gear: Component) -> Component | None:
    """Return the shaft that has the gear as a part, or else the shaft to which a coupling fastens the gear."""
    partners = (
        partner
        for role, other in (("outer_part", "inner_part"), ("inner_part", "outer_part"))
        for partner in reading.model.related("side", role, gear.id, other)
    )
    return reading.model.whole_of(gear.id, "shaft") or next((part for part in partners if part.type == "shaft"), None)


def members_of(reading: Reading, stage: Component) -> Iterator[tuple[str, Component]]:
    """Yield the shafts of a planetary stage that turn about its middle axis, each with the kind of its relation."""
    for kind in ("central_shaft", "planet_carrier_shaft"):
        for shaft in reading.model.related(kind, "planetary_stage", stage.id, "shaft"):
            yield kind, shaft


def _teeth(reading: Reading, gear: Component) -> int | None:
    number = reading.number(gear, "number_of_teeth")
    return int(abs(number)) if number is not None and number == int(number) and 1 <= abs(number) <= 10_000 else None


def _bevel(reading: Reading, stage: Component) -> SpeedLink | None:
    relation = next(iter(reading.model.relations_of("stage", "stage", stage.id)), None)
    gears = [reading.model.part(relation, role) if relation else None for role in ("gear_1", "gear_2")]
    first, second = gears
    if first is None or second is None:
        return None
    teeth = _teeth(reading, first), _teeth(reading, second)
    shafts = shaft_of(reading, first), shaft_of(reading, second)
    if teeth[0] is None or teeth[1] is None or shafts[0] is None or shafts[1] is None or shafts[0].id == shafts[1].id:
        return None
    sense = _bevel_sense(reading, (first, second), (shafts[0], shafts[1]))
    reason = f"followed through the teeth of the bevel stage {stage.id}; its losses are neglected"
    if sense is None:
        reason += ", and its sense of rotation is assumed, because the file does not say where its gears sit"
    return SpeedLink(stage, (shafts[0], shafts[1]), (teeth[0], teeth[1] * (sense or 1)), reason)


def _bevel_sense(
    reading: Reading, gears: tuple[Component, Component], shafts: tuple[Component, Component]
) -> int | None:
    """Return +1 if the shafts of a bevel stage turn in opposite senses about the axis of the unit, else -1.

    Seen from the apex, where the axes cross, both gears turn in opposite senses. None: the positions are not known.
    """
    sense = 1.0
    axes = [reading.axis(shaft) for shaft in shafts]
    for place, (gear, shaft) in enumerate(zip(gears, shafts, strict=True)):
        own, other = axes[place], axes[1 - place]
        if own is None or other is None:
            return None
        cosine = sum(a * b for a, b in zip(own.direction, other.direction, strict=True))
        if abs(cosine) > 0.999:
            return None
        apart = own.along(other.origin)
        apex = (apart - cosine * -other.along(own.origin)) / (1.0 - cosine**2)
        along = reading.number(gear, table.POSITION)
        if along is None and (origin := reading.vector(gear, "support_vector")) is not None:
            along = own.along(origin)
        if along is None or abs(along - apex) <= APEX * max(1.0, abs(apex)):
            return None
        sense *= (1.0 if along > apex else -1.0) * reading.sense(shaft)
    return int(sense)


def _planetary(reading: Reading, stage: Component, groups: Groups) -> SpeedLink | None:
    """Return the link of a simple planetary stage of which one member is held."""
    model = reading.model
    gears = {
        gear.id: gear
        for mesh in model.parts_of(stage.id)
        for role in ("gear_1", "gear_2")
        for gear in model.related("stage", "stage", mesh.id, role)
    }
    rings = [gear for gear in gears.values() if gear.type == "ring_gear"]
    shafts: dict[str, Component] = {}
    suns = list[Component]()
    for kind, shaft in members_of(reading, stage):
        own = [gear for gear in gears.values() if groups.of(gear.id) == groups.of(shaft.id)]
        name = "carrier" if kind == "planet_carrier_shaft" else "ring" if own == rings else "sun"
        shafts.setdefault(name, shaft)
        suns += own if name == "sun" else []
    planets = {_teeth(reading, gear) for gear in gears.values() if gear not in (*rings, *suns)}
    if len(suns) != 1 or len(rings) != 1 or len(planets) != 1:
        return None  # stepped planets, several rings, or no sun
    sun, ring, held = _teeth(reading, suns[0]), _teeth(reading, rings[0]), _held(reading, shafts, rings[0], groups)
    if sun is None or ring is None or held is None:
        return None
    free = {"sun": sun, "ring": ring, "carrier": -(sun + ring)}
    names = [name for name in free if name != held]
    if not shafts.keys() >= {*names}:
        return None
    reason = f"followed through the planetary stage {stage.id}, whose {held} is held; its losses are neglected"
    return SpeedLink(stage, (shafts[names[0]], shafts[names[1]]), (free[names[0]], free[names[1]]), reason)


def _held(reading: Reading, shafts: dict[str, Component], ring: Component, groups: Groups) -> str | None:
    """Return the member of a planetary stage that the file states as held; None if there is none, or several."""
    held = {name for name, shaft in shafts.items() if groups.of(shaft.id) in groups.held}
    held |= {name for name, shaft in shafts.items() if reading.number(shaft, "rotational_speed") == 0.0}
    if reading.model.whole_of(ring.id, table.CASING) is not None or groups.of(ring.id) in groups.held:
        held.add("ring")
    return next(iter(held)) if len(held) == 1 else None
