"""Speeds and torques of all shafts from those that the file states, carried through the meshes without losses.

Shafts joined by a coupling turn as one. Each cylindrical stage gives n_1 z_1 = -n_2 z_2 and torques of its mesh on the
two gears that stand as z_1 : z_2 and have the same sign; on each shaft the torques sum to zero. In a unit without
power splitting there is always an equation with one unknown left, until all is known.
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isfinite, nan
from typing import NamedTuple

from app.rexs.model import Component, LoadCase
from app.rexs.reading import Reading
from app.rexs.units import REVOLUTION_PER_MINUTE

MOST_SHAFTS = 200  # chosen: far beyond any gear unit
BALANCE = 0.02  # of the largest torque: what files with efficiencies leave unbalanced without being wrong


class Mesh(NamedTuple):
    """Two external gears in mesh, by the shafts they sit on."""

    stage: int
    shafts: tuple[int, int]
    teeth: tuple[int, int]


@dataclass
class Flow:
    """What is known of each shaft and mesh.

    `speed`: 1/min about the shaft's own u axis, by shaft. `mesh_torque`: N m on gear 1 and gear 2 of a stage about
    their shafts' own u axes.
    """

    speed: dict[int, float] = field(default_factory=dict)
    mesh_torque: dict[int, tuple[float, float]] = field(default_factory=dict)

    def driver(self, mesh: Mesh) -> int | None:
        """0 or 1: the gear that gives power to the other one; None where that is not known."""
        torques = self.mesh_torque.get(mesh.stage)
        if torques is None:
            return None
        for place in (0, 1):
            speed = self.speed.get(mesh.shafts[place])
            if speed and torques[place]:
                gives = torques[place] * speed < 0.0
                return place if gives else 1 - place
        return None


def power_flow(
    reading: Reading,
    meshes: list[Mesh],
    joined: list[tuple[int, int]],
    opened: set[int],
    senses: dict[int, float],
    case: LoadCase | None = None,
) -> Flow:
    """Speeds and torques of the base model or of a load case.

    `joined`: pairs of shafts that turn as one. `opened`: shafts from which power flows through stages that are not
    modelled. `senses`: +1 or -1, the sense of each shaft's u axis in the unit.
    """
    shafts = [each for each in reading.model.components.values() if each.type == "shaft"]
    if len(shafts) > MOST_SHAFTS:
        reading.find("too_many_shafts", None, None, f"speeds and torques of {len(shafts)} shafts are not looked for")
        return Flow()
    return _Solution(reading, shafts, meshes, joined, opened, senses, case).flow()


class _Solution:
    """One solution: groups of shafts that turn as one, their speeds, and the torques between them."""

    def __init__(
        self,
        reading: Reading,
        shafts: list[Component],
        meshes: list[Mesh],
        joined: list[tuple[int, int]],
        opened: set[int],
        senses: dict[int, float],
        case: LoadCase | None,
    ) -> None:
        self._reading, self._meshes, self._case, self._senses = reading, meshes, case, senses
        self._group = _groups((each.id for each in shafts), joined)
        self._shafts = shafts
        self._elsewhere = {self._group[shaft] for shaft in opened if shaft in self._group}
        self._at: dict[int, list[tuple[int, int]]] = defaultdict(list)
        for index, mesh in enumerate(meshes):
            for place in (0, 1):
                self._at[self._group[mesh.shafts[place]]].append((index, place))

    def flow(self) -> Flow:
        speeds = self._speeds()
        forces = self._forces(speeds)
        flow = Flow()
        for shaft in self._shafts:
            group = self._group[shaft.id]
            if isfinite(speeds.get(group, nan)):
                flow.speed[shaft.id] = speeds[group] * self._senses.get(shaft.id, 1.0)
        for index, force in forces.items():
            mesh = self._meshes[index]
            first, second = (mesh.teeth[place] * force * self._senses.get(mesh.shafts[place], 1.0) for place in (0, 1))
            if isfinite(first) and isfinite(second):
                flow.mesh_torque[mesh.stage] = first, second
        return flow

    def _speeds(self) -> dict[int, float]:
        """Speeds of the groups [1/min], seen along the unit's axis."""
        speeds: dict[int, float] = {}
        stated = [(each, self._stated_speed(each)) for each in self._shafts]
        stated.sort(key=lambda each: not self._reading.flag(each[0], "defines_speed"))
        for shaft, speed in stated:
            if speed is None:
                continue
            group = self._group[shaft.id]
            if group not in speeds:
                self._spread(group, speed, speeds)
            elif abs(speeds[group] - speed) > BALANCE * max(abs(speed), abs(speeds[group])):
                message = f"the shaft turns at {speed:.6g} 1/min, by the tooth numbers at {speeds[group]:.6g}; not used"
                self._reading.find("speed_conflict", shaft, "rotational_speed", message)
        return speeds

    def _stated_speed(self, shaft: Component) -> float | None:
        speed = self._reading.number(shaft, "rotational_speed", "1/min", case=self._case)
        return None if speed is None else speed * self._senses.get(shaft.id, 1.0)

    def _spread(self, start: int, speed: float, speeds: dict[int, float]) -> None:
        speeds[start] = speed
        waiting = [start]
        while waiting:
            group = waiting.pop()
            for index, place in self._at[group]:
                mesh = self._meshes[index]
                other = self._group[mesh.shafts[1 - place]]
                if other not in speeds:
                    speeds[other] = -speeds[group] * mesh.teeth[place] / mesh.teeth[1 - place]
                    waiting.append(other)

    def _forces(self, speeds: dict[int, float]) -> dict[int, float]:
        """Torque of each mesh per tooth [N m], where the torques that the file states determine it."""
        known, opened = self._loads(speeds)
        forces: dict[int, float] = {}
        if not known:
            return forces
        waiting = list(self._at)
        while waiting:
            group = waiting.pop()
            unknown = [(index, place) for index, place in self._at[group] if index not in forces]
            if len(unknown) != 1 or group in opened:
                continue
            carried = sum(forces[i] * self._meshes[i].teeth[p] for i, p in self._at[group] if i in forces)
            index, place = unknown[0]
            mesh = self._meshes[index]
            forces[index] = -(known.get(group, 0.0) + carried) / mesh.teeth[place]
            waiting.append(self._group[mesh.shafts[1 - place]])
        return forces

    def _loads(self, speeds: dict[int, float]) -> tuple[dict[int, float], set[int]]:
        """Stated torques by group [N m], and the groups at which a torque that is not stated enters or leaves."""
        known: dict[int, float] = defaultdict(float)
        opened, leaving = set(self._elsewhere), set()
        for group, load in self._external_loads():
            torque = self._stated_torque(load, group, speeds)
            if torque is None:
                if self._reading.flag(load, "transmits_torque") is not False:
                    opened.add(group)
                continue
            known[group] += torque
            if torque * speeds.get(group, 0.0) < 0.0:
                leaving.add(group)
        if not opened and known:
            ends = {group for group, meshes in self._at.items() if len(meshes) == 1 and group not in known}
            opened = ends or leaving or set()
        return known, opened

    def _external_loads(self) -> Iterator[tuple[int, Component]]:
        for shaft in self._shafts:
            for part in self._reading.model.parts_of(shaft.id):
                if part.type == "external_load":
                    yield self._group[shaft.id], part

    def _stated_torque(self, load: Component, group: int, speeds: dict[int, float]) -> float | None:
        """The torque of a load about the unit's axis [N m], where the load defines it."""
        if self._reading.flag(load, "defines_torque") is False:
            return None
        shaft = self._reading.model.whole_of(load.id, "shaft")
        sense = self._senses.get(shaft.id, 1.0) if shaft else 1.0
        torque = self._reading.number(load, "torque_around_u_axis", "Nm", case=self._case)
        if torque is not None:
            return torque * sense
        power, speed = self._reading.number(load, "power", "W", case=self._case), speeds.get(group)
        return power / (speed * REVOLUTION_PER_MINUTE) if power is not None and speed else None


def _groups(shafts: Iterator[int], joined: list[tuple[int, int]]) -> dict[int, int]:
    """For each shaft one shaft that stands for all that turn with it."""
    neighbours: dict[int, list[int]] = defaultdict(list)
    for one, other in joined:
        neighbours[one].append(other)
        neighbours[other].append(one)
    group: dict[int, int] = {}
    for start in shafts:
        if start in group:
            continue
        waiting = [start]
        while waiting:
            shaft = waiting.pop()
            if shaft not in group:
                group[shaft] = start
                waiting.extend(neighbours[shaft])
    return group
