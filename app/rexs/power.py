"""Speeds and torques of all shafts, which follow from the values in the file. Losses of the meshes are neglected.

Shafts joined by a coupling turn as one. In a cylindrical stage, n_1 z_1 = -n_2 z_2. The mesh loads both gears with
torques of the same sign in the ratio z_1 : z_2. The torques on a shaft add up to zero. In a unit without power
splitting these equations can be solved one after another, because at each step there is an equation with a single
unknown.
"""

from collections import defaultdict
from dataclasses import dataclass, field
from math import isfinite, nan
from typing import NamedTuple

from app.rexs.model import Component, LoadCase
from app.rexs.reading import Reading
from app.rexs.table import REVOLUTION_PER_MINUTE

MOST_SHAFTS = 200  # chosen: far more than any gear unit has
BALANCE = 0.02  # tolerated relative unbalance of torques, because the torques in some files include efficiencies


class Pair(NamedTuple):
    """A stage: two external gears and their shafts, in the order of the file."""

    stage: Component
    gears: tuple[Component, Component]
    shafts: tuple[Component, Component]
    teeth: tuple[int, int]


@dataclass
class Flow:
    """Speeds of shafts and torques of meshes, as far as the file determines these values.

    `reading` reads the model or the load case that states the load. `speed` maps each shaft to its speed [1/min] about
    its own u axis. `mesh_torque` maps each stage to the torques [N m] of the mesh on gear 1 and gear 2, about the u
    axis of the shaft of each gear.
    """

    reading: Reading
    speed: dict[int, float] = field(default_factory=dict)
    mesh_torque: dict[int, tuple[float, float]] = field(default_factory=dict)

    def knows(self, pair: Pair) -> bool:
        """Return True if torque and speed of a stage are known."""
        return pair.stage.id in self.mesh_torque and pair.shafts[0].id in self.speed

    def driver(self, pair: Pair) -> int | None:
        """Return the place (0 or 1) of the driving gear in the pair, or None if the driving gear is not known."""
        for place, torque in enumerate(self.mesh_torque.get(pair.stage.id, ())):
            speed = self.speed.get(pair.shafts[place].id)
            if speed and torque:
                return place if torque * speed < 0.0 else 1 - place
        return None


class Train:
    """The shafts of a unit in groups that turn as one, and the meshes between the groups."""

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
        self._group = self._groups()
        self._elsewhere = self._not_modelled()
        self._at: dict[int, list[tuple[Pair, int]]] = defaultdict(list)  # meshes of each group, and place of the gear
        for pair in self._pairs:
            for place, shaft in enumerate(pair.shafts):
                self._at[self._group[shaft.id]].append((pair, place))

    def flow(self, case: LoadCase | None = None) -> Flow:
        """Return speeds and torques of the base model or of a load case."""
        reading = self._reading.in_case(case)
        speeds = self._speeds(reading)
        flow = Flow(reading)
        for shaft in self._shafts:
            speed = speeds.get(self._group[shaft.id], nan)
            if isfinite(speed):
                flow.speed[shaft.id] = speed * self._reading.sense(shaft)
        forces = self._forces(speeds, reading)
        for pair in self._pairs:
            force = forces.get(pair.stage.id, nan)
            first, second = (pair.teeth[place] * force * self._reading.sense(pair.shafts[place]) for place in (0, 1))
            if isfinite(first) and isfinite(second):
                flow.mesh_torque[pair.stage.id] = first, second
        return flow

    def _groups(self) -> dict[int, int]:
        """Map each shaft to the representative of the shafts that turn with it."""
        model = self._reading.model
        group = {shaft.id: shaft.id for shaft in self._shafts}
        for relation in model.relations if group else ():
            coupling = model.part(relation, "assembly")
            if relation.type == "side" and coupling is not None and coupling.type in {"coupling", "fixed_coupling"}:
                ends = [relation.part(role) for role in ("inner_part", "outer_part")]
                joined = [group[end] for end in ends if end in group]
                if len(joined) == len(ends) and joined[0] != joined[1]:
                    group = {shaft: joined[0] if own == joined[1] else own for shaft, own in group.items()}
        return group

    def _speeds(self, reading: Reading) -> dict[int, float]:
        """Return the speeds of the groups [1/min] about the unit's axis."""
        speeds: dict[int, float] = {}
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
        """Set the speed of a group, and then the speeds of all groups that are connected to it by meshes."""
        speeds[group] = speed
        for pair, place in self._at[group]:
            other = self._group[pair.shafts[1 - place].id]
            if other not in speeds:
                self._spread(other, -speed * pair.teeth[place] / pair.teeth[1 - place], speeds)

    def _forces(self, speeds: dict[int, float], reading: Reading) -> dict[int, float]:
        """Return the mesh torque per tooth [N m] of each stage in which the file's torques determine this torque."""
        torques, opened = self._loads(speeds, reading)
        forces: dict[int, float] = {}
        waiting = list(self._at) if torques else []
        while waiting:
            group = waiting.pop()
            unknown = [(pair, place) for pair, place in self._at[group] if pair.stage.id not in forces]
            if len(unknown) != 1 or group in opened:
                continue
            here = ((pair.stage.id, pair.teeth[place]) for pair, place in self._at[group])
            carried = sum(forces[stage] * teeth for stage, teeth in here if stage in forces)
            pair, place = unknown[0]
            forces[pair.stage.id] = -(torques.get(group, 0.0) + carried) / pair.teeth[place]
            waiting.append(self._group[pair.shafts[1 - place].id])
        return forces

    def _loads(self, speeds: dict[int, float], reading: Reading) -> tuple[dict[int, float], set[int]]:
        """Return the stated torques by group [N m], and the groups at which an unstated torque enters or leaves."""
        torques: dict[int, float] = defaultdict(float)
        opened, leaving = set(self._elsewhere), set()
        for shaft in self._shafts:
            group = self._group[shaft.id]
            for load in reading.model.parts_of(shaft.id):
                if load.type != "external_load":
                    continue
                transmits = reading.flag(load, "transmits_torque")
                torque = self._stated_torque(load, shaft, speeds.get(group), reading)
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

    def _not_modelled(self) -> set[int]:
        """Return the groups that have gears in stages without a model. The torques of these stages are not known."""
        model, modelled = self._reading.model, {pair.stage.id for pair in self._pairs}
        stages = (relation for relation in model.relations if relation.type == "stage")
        others = (relation for relation in stages if relation.part("stage") not in modelled)
        parts = (part for relation in others for role, part in relation.parts if role != "stage")
        shafts = (model.whole_of(part, "shaft") for part in parts)
        return {self._group[shaft.id] for shaft in shafts if shaft is not None and shaft.id in self._group}

    def _stated_torque(self, load: Component, shaft: Component, speed: float | None, reading: Reading) -> float | None:
        """Return the torque of a load on a shaft about the unit's axis [N m], or None if the torque is not stated.

        If a load case states a power but no torque, the torque is computed from this power, even if the model states a
        torque.
        """
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
        return torque * reading.sense(shaft)  # a load is stated about the u axis of its shaft
