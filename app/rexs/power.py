"""Speeds and torques of all shafts, computed from the values in the file. Losses of the meshes are neglected.

Shafts that are joined by a coupling turn as one shaft (see `links`). In a cylindrical stage, n_1 z_1 = -n_2 z_2, with
the speed n and the number of teeth z. The mesh loads both gears with torques of the same sign, in the ratio z_1 : z_2.
The torques on a shaft add up to zero. If the unit does not split the power, these equations can be solved one after
another, because at each step there is an equation with a single unknown.
"""

from collections import defaultdict
from dataclasses import dataclass, field
from math import isfinite, nan
from typing import NamedTuple

from app.rexs.links import Groups, SpeedLink, fastened, joints, links, members_of
from app.rexs.model import NO_CASE, Component, LoadCase
from app.rexs.reading import Reading
from app.rexs.table import REVOLUTION_PER_MINUTE

MOST_SHAFTS = 200  # largest number of shafts; chosen: far more than any gear unit has
BALANCE = 0.02  # tolerated relative unbalance of torques, because the torques in some files include efficiencies


class Pair(NamedTuple):
    """A stage with two external gears.

    `gears`, `shafts` and `teeth` (the numbers of teeth) have the order in which the file names the two gears.
    """

    stage: Component
    gears: tuple[Component, Component]
    shafts: tuple[Component, Component]
    teeth: tuple[int, int]
    twin: "Pair | None" = None  # of double-helical gears, the stage of the other helix, with the same order of shafts

    @property
    def turned(self) -> "Pair":
        """The stage with its two gears in the other order."""
        return self._replace(gears=self.gears[::-1], shafts=self.shafts[::-1], teeth=self.teeth[::-1])

    @property
    def stages(self) -> tuple[Component, ...]:
        """The stage, and that of the other helix."""
        return (self.stage,) if self.twin is None else (self.stage, self.twin.stage)


Mesh = Pair | SpeedLink


@dataclass
class PowerFlow:
    """Speeds of shafts and torques of meshes, as far as these values follow from the file.

    `reading` reads the part of the file that states the load: the model, or one of its load cases. `speed` maps each
    shaft to its speed [1/min]. `mesh_torque` maps each stage to the torques [N m] with which the mesh loads gear 1 and
    gear 2; both stages of double-helical gears have the torques of both. Speeds and torques are about the u axes of the
    shafts. `through` says through which stages of other kinds
    the load of a stage was followed. `hidden` has the stages whose load depends on a stage that is not modelled.
    """

    reading: Reading
    speed: dict[int, float] = field(default_factory=dict)
    mesh_torque: dict[int, tuple[float, float]] = field(default_factory=dict)
    through: dict[int, set[str]] = field(default_factory=dict)
    hidden: set[int] = field(default_factory=set)

    def knows(self, pair: Pair) -> bool:
        """Return True if torque and speed of a stage are known."""
        return pair.stage.id in self.mesh_torque and pair.shafts[0].id in self.speed

    def driver(self, pair: Pair) -> int | None:
        """Return the position (0 or 1) of the driving gear in the pair, or None if the driving gear is not known."""
        for place, torque in enumerate(self.mesh_torque.get(pair.stage.id, ())):
            speed = self.speed.get(pair.shafts[place].id)
            if speed and torque:
                return place if torque * speed < 0.0 else 1 - place
        return None

    def direction(self, pair: Pair) -> tuple[int, bool] | None:
        """Return the position of the driving gear, and True if the speed of the first gear is positive.

        Return None if the driving gear is not known.
        """
        driver = self.driver(pair)
        return None if driver is None else (driver, self.speed[pair.shafts[0].id] > 0.0)


class Train:
    """The shafts of a unit, and the meshes between the shafts."""

    def __init__(self, reading: Reading, pairs: list[Pair]) -> None:
        self._reading, self._pairs = reading, pairs
        self._shafts = reading.model.by_type["shaft"]
        if len(self._shafts) > MOST_SHAFTS:
            message = (
                f"speeds and torques are not computed, because the unit has {len(self._shafts)} shafts; at most "
                f"{MOST_SHAFTS} shafts are allowed"
            )
            reading.find("too_many_shafts", None, None, message)
            self._shafts, self._pairs = [], []
        self._parts = fastened(reading, self._shafts)
        self._joints = list(joints(reading)) if self._shafts else []

    def flow(self, case: LoadCase = NO_CASE) -> PowerFlow:
        """Return the speeds and torques in a load case, or in the model itself."""
        reading = self._reading.in_case(case)
        return _TrainState(reading, self._shafts, self._pairs, Groups(reading, self._parts, self._joints)).flow()


class _TrainState:
    """The train in one load case. Speeds and torques of groups are about the axis of the unit (`Reading.sense`)."""

    def __init__(self, reading: Reading, shafts: list[Component], pairs: list[Pair], groups: Groups) -> None:
        self._reading, self._shafts, self._pairs = reading, shafts, pairs
        self._group = {shaft.id: groups.of(shaft.id) for shaft in shafts}
        passing = list(links(reading, groups)) if shafts else []
        self._unknown = self._not_modelled(passing, groups)
        # For each group, its meshes and the position (0 or 1) of the group's gear in the pair or link of each mesh.
        self._at: dict[int, list[tuple[Mesh, int]]] = defaultdict(list)
        ends: list[tuple[Mesh, tuple[Component, Component]]] = [
            *((pair, pair.gears) for pair in pairs),
            *((link, link.shafts) for link in passing),
        ]
        for mesh, (first, second) in ends:
            for place, end in enumerate((first, second)):
                self._at[groups.of(end.id)].append((mesh, place))
        self._ends = {mesh.stage.id: (groups.of(first.id), groups.of(second.id)) for mesh, (first, second) in ends}
        self._through: dict[int, set[str]] = defaultdict(set)  # groups and stages behind links, with the reasons

    def flow(self) -> PowerFlow:
        reading, flow, speeds = self._reading, PowerFlow(self._reading), self._speeds()
        for shaft in self._shafts:
            speed = speeds.get(self._group[shaft.id], nan)
            if isfinite(speed):
                flow.speed[shaft.id] = speed * reading.sense(shaft)
        forces = self._forces(speeds)
        for pair in self._pairs:
            force = forces.get(pair.stage.id, nan)
            first, second = (pair.teeth[place] * force * reading.sense(pair.shafts[place]) for place in (0, 1))
            if isfinite(first) and isfinite(second):
                flow.mesh_torque |= {stage.id: (first, second) for stage in pair.stages}
            flow.through[pair.stage.id] = self._through[pair.stage.id].union(
                *(self._through[group] for group in self._ends[pair.stage.id])
            )
        flow.hidden = {stage for stage in self._hidden() if stage not in flow.mesh_torque}
        return flow

    def _hidden(self) -> set[int]:
        """Return the stages that are connected, through meshes, to a stage that is not modelled."""
        reached, waiting, stages = set(self._unknown), list(self._unknown), set[int]()
        while waiting:
            for mesh, place in self._at[waiting.pop()]:
                stages.add(mesh.stage.id)
                other = self._ends[mesh.stage.id][1 - place]
                if other not in reached:
                    reached.add(other)
                    waiting.append(other)
        return stages

    def _speeds(self) -> dict[int, float]:
        """Return the speeds [1/min] of the groups about the axis of the unit. Unknown speeds are left out."""
        reading, speeds = self._reading, dict[int, float]()
        stated = [(shaft, reading.number(shaft, "rotational_speed", "1/min")) for shaft in self._shafts]
        restated = {shaft.id for shaft, _ in stated if reading.says(shaft, "rotational_speed")}
        stated.sort(key=lambda pair: (pair[0].id not in restated, not reading.flag(pair[0], "defines_speed")))
        for shaft, own in stated:
            if own is None:
                continue
            speed, group = own * reading.sense(shaft), self._group[shaft.id]
            if group not in speeds:
                self._spread(group, speed, speeds)
            elif restated and shaft.id not in restated:
                continue  # the model states this speed, but the load case states other speeds
            elif abs(speeds[group] - speed) > BALANCE * max(abs(speed), abs(speeds[group])):
                message = (
                    f"the stated speed is {speed:.6g} 1/min, but according to the numbers of teeth the speed is "
                    f"{speeds[group]:.6g} 1/min; the stated speed is not used"
                )
                reading.find("speed_conflict", shaft, "rotational_speed", message)
        return speeds

    def _spread(self, group: int, speed: float, speeds: dict[int, float]) -> None:
        """Set the speed of a group, and the speeds of all groups that meshes connect to this group."""
        speeds[group] = speed
        for mesh, place in self._at[group]:
            other = self._ends[mesh.stage.id][1 - place]
            if other not in speeds:
                self._through[other] |= self._through[group] | ({mesh.reason} if isinstance(mesh, SpeedLink) else set())
                self._spread(other, -speed * mesh.teeth[place] / mesh.teeth[1 - place], speeds)

    def _forces(self, speeds: dict[int, float]) -> dict[int, float]:
        """Return, for each mesh or link, the torque on a gear divided by the gear's number of teeth [N m]."""
        torques, opened = self._loads(speeds)
        forces: dict[int, float] = {}
        waiting = list(self._at) if torques else []
        while waiting:
            group = waiting.pop()
            unknown = [(mesh, place) for mesh, place in self._at[group] if mesh.stage.id not in forces]
            if len(unknown) != 1 or group in opened:
                continue
            known = [(mesh, place) for mesh, place in self._at[group] if mesh.stage.id in forces]
            carried = sum(forces[mesh.stage.id] * mesh.teeth[place] for mesh, place in known)
            mesh, place = unknown[0]
            force = -(torques.get(group, 0.0) + carried) / mesh.teeth[place]
            if force == 0.0 and 0.0 not in torques.values():
                if isinstance(mesh, Pair):
                    message = "no torque passes through this stage by the loads of the file; it is taken as not known"
                    self._reading.find("zero_torque", mesh.stage, None, message)
                continue
            forces[mesh.stage.id] = force
            for other, _ in known:
                reasons = {other.reason} if isinstance(other, SpeedLink) else set()
                self._through[mesh.stage.id] |= self._through[other.stage.id] | reasons
            waiting.append(self._ends[mesh.stage.id][1 - place])
        return forces

    def _loads(self, speeds: dict[int, float]) -> tuple[dict[int, float], set[int]]:
        """Return the stated torque on each group [N m], and the set of the groups whose balance of torques is not used.

        The balance of a group is not used if the file does not state a torque that enters or leaves the unit there. If
        the file seems to state all torques, the balance is not used at groups with a single mesh and no stated torque.
        If there are no such groups either, the balance is not used where a stated torque takes power out of the unit.
        """
        torques: dict[int, float] = defaultdict(float)
        opened, leaving = set(self._unknown), set[int]()
        for shaft in self._shafts:
            group = self._group[shaft.id]
            for load in self._reading.model.parts_of(shaft.id):
                if load.type != "external_load":
                    continue
                transmits = self._reading.flag(load, "transmits_torque")
                torque = self._stated_torque(load, shaft, speeds.get(group))
                if torque is not None:
                    torques[group] += torque
                    if torque * speeds.get(group, 0.0) < 0.0:
                        leaving.add(group)
                elif transmits is not False:
                    opened.add(group)
        if torques and not opened:
            ends = {group for group, meshes in self._at.items() if len(meshes) == 1}
            opened = (ends - torques.keys()) or leaving
        return torques, opened

    def _not_modelled(self, passing: list[SpeedLink], groups: Groups) -> set[int]:
        """Return the groups that take part in stages that are not modelled. The torques of such stages are unknown."""
        model = self._reading.model
        followed = {stage.id for pair in self._pairs for stage in pair.stages} | {link.stage.id for link in passing}
        followed |= {part.id for link in passing for part in model.parts_of(link.stage.id)}
        others = [stage for type_, stages in model.by_type.items() if type_.endswith("_stage") for stage in stages
                  if stage.id not in followed]  # fmt: skip
        parts = [
            part
            for stage in others
            for relation in model.relations_of("stage", "stage", stage.id)
            for role, part in relation.parts
            if role != "stage"
        ]
        parts += [shaft.id for stage in others for _, shaft in members_of(self._reading, stage)]
        return {groups.of(part) for part in parts}

    def _stated_torque(self, load: Component, shaft: Component, speed: float | None) -> float | None:
        """Return the torque [N m] of an external load about the axis of the unit, or None if the torque is not known.

        `shaft` carries the load, and `speed` [1/min] is the speed of the shaft about the axis of the unit. If the load
        states only a power, the torque is computed from the power and the speed. If the load case states a power and
        no torque, this power takes precedence over the torque in the model. If `defines_torque` of the load is false,
        the result is None.
        """
        reading = self._reading
        if reading.flag(load, "defines_torque") is False:
            return None
        torque = reading.number(load, "torque_around_u_axis", "Nm")
        power = reading.number(load, "power", "W")
        names = "power", "torque_around_u_axis"
        power_alone, torque_alone = (
            reading.says(load, names[i]) and not reading.says(load, names[1 - i]) for i in (0, 1)
        )
        of_power = power / (speed * REVOLUTION_PER_MINUTE) if power is not None and speed else None
        if torque is None or (power_alone and of_power is not None):
            return of_power
        if (
            not torque_alone
            and of_power is not None
            and abs(abs(of_power) - abs(torque)) > BALANCE * max(abs(of_power), abs(torque))
        ):
            message = (
                f"the stated torque is {abs(torque):.6g} N m, but according to power and speed the torque is "
                f"{abs(of_power):.6g} N m; the stated torque is used"
            )
            reading.find("power_conflict", load, "power", message)
        return torque * reading.sense(shaft)  # the file states the torque of a load about the u axis of the shaft
