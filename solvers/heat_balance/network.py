"""The network of a gear pair or gear unit: its nodes, and all heat flows between them.

The nodes are the flank and the body of each gear, the mist, the oil that leaves each plain bearing, and the casing if
there is one. Each heat flow is entered once, with an origin and a target. All heat that leaves the origin therefore
arrives at the target. Temperatures are rises over the supply temperature of the oil [K].
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.heat_balance.bearings import Journal
from solvers.heat_balance.conduction import tooth_conductance
from solvers.heat_balance.convection import RECOVERY, face_convection, recovery_rise, rim_convection
from solvers.heat_balance.fling_off import FlingOff, TurningTeeth, fling_off
from solvers.heat_balance.losses import MeshHeat, acceleration_power, impact_rise, jet_power
from solvers.heat_balance.oil import CoolingOil

FLANKS, BODIES, MIST = (0, 2), (1, 3), 4
GEAR_NODES = ("pinion_flank", "pinion_body", "wheel_flank", "wheel_body", "mist")


@dataclass(frozen=True)
class CooledGear:
    """A gear in the network; lengths in [m], conductivity in [W/(m K)].

    `flanks` describes the flanks that the oil cools. `face_area` is the area of both faces of the gear without the
    cross-sections of the shaft [m^2]. `pumping` is the heat that this gear produces by pumping gas [W].
    """

    teeth: int
    face_width: float
    module: float
    tip_radius: float
    flanks: TurningTeeth
    face_area: float
    conductivity: float = 46.0
    pumping: float = 0.0
    gap_width: float = 0.0

    @cached_property
    def to_body(self) -> float:
        """Conductance from the loaded flanks to the middle of the teeth [W/K]."""
        return tooth_conductance(self.teeth, self.face_width, self.module, self.flanks.height, self.conductivity)

    @cached_property
    def rim(self) -> float:
        """Conductance from the rim to air [W/K]; half of this conductance leads to the flanks, and half to the body."""
        area = 2 * pi * self.tip_radius * (self.face_width + self.gap_width)
        return area * rim_convection(self.flanks.speed, self.tip_radius)

    @cached_property
    def faces(self) -> float:
        """Conductance from both faces to air [W/K]."""
        return self.face_area * face_convection(self.flanks.speed, self.tip_radius)


@dataclass(frozen=True, slots=True)
class Spray:
    """Oil of the jets: flow [m^3/s], velocities [m/s], shares, and factor of the fling-off cooling.

    `velocity` is the pitch-line velocity; `jet` is positive into the mesh, negative against the teeth that leave it.
    """

    flow: float
    velocity: float
    jet: float
    flow_to_pinion: float = 0.5
    wetting_share: float = 0.5
    rewetting_share: float = 0.0
    fling_off_factor: float = 1.0

    def wetting(self, gear: int) -> float:
        """Return the oil flow that hits the teeth of gear 0 (pinion) or 1 (wheel) [m^3/s]."""
        share = self.flow_to_pinion if gear == 0 else 1 - self.flow_to_pinion
        return self.wetting_share * self.flow * share


@dataclass(frozen=True, slots=True)
class CasingWalls:
    """Walls of the casing: area [m^2], heat transfer inside and outside [W/(m^2 K)], ambient temperature [K]."""

    area: float
    inside: float
    outside: float
    ambient: float


class Flow(NamedTuple):
    """Heat flow [W] between places (indices, see `Network.places`), with the name of its carrier."""

    origin: int
    target: int
    power: float
    carrier: str


@dataclass(frozen=True)
class Network:
    """The network of a gear pair or unit with its losses [W]; `windage` (both gears) and `other` heat the mist."""

    oil: CoolingOil
    gears: tuple[CooledGear, CooledGear]
    mesh: MeshHeat
    spray: Spray
    windage: float = 0.0
    other: float = 0.0
    pumping_to_teeth: float = 0.1
    mist_convection_factor: float = 3.0
    journals: tuple[Journal, ...] = ()
    bearing_film_share: float = 0.8
    casing: CasingWalls | None = None
    recovery: float = RECOVERY

    @cached_property
    def nodes(self) -> tuple[str, ...]:
        """Names of the nodes, in the order of the temperatures."""
        bearings = [f"bearing_{number}" for number in range(1, len(self.journals) + 1)]
        return (*GEAR_NODES, *bearings, *(["casing"] if self.casing else []))

    @cached_property
    def places(self) -> tuple[str, ...]:
        """Names of all places between which heat flows: nodes, leaving oil, surroundings and source of the losses."""
        return (*self.nodes, "oil", "ambient", "source")

    @property
    def size(self) -> int:
        """Number of nodes."""
        return len(self.nodes)

    @property
    def coldest(self) -> float:
        """Temperature of the coldest oil that enters, or of the surroundings of the casing if they are colder [K]."""
        entering = (self.oil.inlet + feed for feed in (0.0, *self._feeds))
        return min((*entering, self.casing.ambient) if self.casing else entering)

    @cached_property
    def _feeds(self) -> tuple[float, ...]:
        """Rise of the oil that enters each bearing over the supply of the gears [K]."""
        return tuple(0.0 if journal.feed is None else journal.feed - self.oil.inlet for journal in self.journals)

    @cached_property
    def _coolings(self) -> dict[tuple[int, float], FlingOff]:
        """Cache of the fling-off cooling: a Jacobian asks many times at few flank temperatures."""
        return {}

    def cooling(self, gear: int, rises: FloatArray) -> FlingOff:
        """Return the cooling of gear 0 (pinion) or 1 (wheel) by oil that the gear flings off."""
        flank = self.oil.inlet + float(rises[FLANKS[gear]])
        cooling = self._coolings.get((gear, flank))
        if cooling is None:
            wetting, factor = self.spray.wetting(gear), self.spray.fling_off_factor
            cooling = fling_off(self.oil, self.gears[gear].flanks, wetting, factor, flank)
            self._coolings[gear, flank] = cooling
        return cooling

    @cached_property
    def _operations(self) -> dict[tuple[int, float], tuple[float, float]]:
        """Cache of the friction power and the oil flow of the bearings."""
        return {}

    def operation(self, number: int, outlet: float) -> tuple[float, float]:
        """Friction power [W] and oil flow [m^3/s] of a bearing at the rise `outlet` [K] of its oil."""
        operation = self._operations.get((number, outlet))
        if operation is None:
            viscosity = self.oil.viscosity(self.film_temperature(number, outlet))
            operation = self._operations[number, outlet] = self.journals[number].loss_and_flow(viscosity)
        return operation

    def flows(self, rises: FloatArray) -> list[Flow]:
        """List every heat flow in the network (Eq. H17)."""
        mist, oil, source = float(rises[MIST]), self.size, self.size + 2
        flows = [
            Flow(source, MIST, self.windage, "windage"),
            Flow(source, MIST, self.other, "other losses"),
            Flow(source, MIST, jet_power(self.oil, self.spray.flow, self.spray.jet), "oil jets"),
            Flow(MIST, oil, self.oil.heat_capacity * self.spray.flow * mist, "drain"),
        ]
        for gear in (0, 1):
            flows.extend(self._sources(gear, rises))
            flows.extend(self._oil_cooling(gear, rises))
            flows.extend(self._mist_convection(gear, rises))
        for number in range(len(self.journals)):
            flows.extend(self._bearing(number, rises))
        if self.casing:
            flows.extend(self._casing(self.casing, rises))
        return flows

    def residual(self, rises: FloatArray) -> FloatArray:
        """Return the heat that each node gains [W]; zero in equilibrium."""
        return self.gains(self.flows(rises))[: self.size]

    def gains(self, flows: list[Flow]) -> FloatArray:
        """Return the heat that each place of the network gains [W]; the sum over all places is zero."""
        powers, places = [flow.power for flow in flows], len(self.places)
        incoming = np.bincount([flow.target for flow in flows], powers, places)
        return np.asarray(incoming - np.bincount([flow.origin for flow in flows], powers, places))

    def _sources(self, gear: int, rises: FloatArray) -> Iterator[Flow]:
        """Heat flows that one gear produces: mesh friction, pumping of gas, acceleration of oil.

        The teeth's share of the pumping heat goes half to the flank and half to the body, the rest to the mist.
        """
        source, flank, body = self.size + 2, FLANKS[gear], BODIES[gear]
        flanks = self.oil.inlet + float(rises[FLANKS[0]] + rises[FLANKS[1]]) / 2
        share = self.mesh.share_to_pinion if gear == 0 else 1 - self.mesh.share_to_pinion
        pumping, to_teeth = self.gears[gear].pumping, self.pumping_to_teeth / 2
        thrown = acceleration_power(self.oil, self.spray.wetting(gear), self.spray.velocity, self.spray.jet)
        yield Flow(source, flank, share * self.mesh.at(self.oil, flanks), "friction of the mesh")
        yield Flow(source, flank, to_teeth * pumping, "pumped gas")
        yield Flow(source, body, to_teeth * pumping, "pumped gas")
        yield Flow(source, MIST, (1 - 2 * to_teeth) * pumping, "pumped gas")
        yield Flow(source, MIST, thrown, "oil brought to speed")

    def _oil_cooling(self, gear: int, rises: FloatArray) -> Iterator[Flow]:
        """Heat flows from flank and body to the oil of jets and mist, and from the flank to the body."""
        flank, body, mist = float(rises[FLANKS[gear]]), float(rises[BODIES[gear]]), float(rises[MIST])
        cooling, tooth = self.cooling(gear, rises), self.gears[gear].to_body
        side = cooling.conductance / 2
        after_impact = impact_rise(self.oil, self.spray.velocity, self.spray.jet)
        rewetting = self.spray.rewetting_share * (cooling.flooded - cooling.conductance) / 2
        through_tooth = side * tooth / (side + tooth)
        yield Flow(FLANKS[gear], MIST, side * (flank - after_impact), "oil on the flanks")
        yield Flow(BODIES[gear], MIST, through_tooth * (body - after_impact), "oil on the unloaded flanks")
        yield Flow(FLANKS[gear], BODIES[gear], tooth * (flank - body), "conduction in the teeth")
        yield Flow(FLANKS[gear], MIST, rewetting * (flank - mist), "oil out of the mist")
        yield Flow(BODIES[gear], MIST, rewetting * (body - mist), "oil out of the mist")

    def _mist_convection(self, gear: int, rises: FloatArray) -> Iterator[Flow]:
        """Heat flows from the mist, which tip friction warms near the gear, to its rim and faces."""
        flank, body, mist = float(rises[FLANKS[gear]]), float(rises[BODIES[gear]]), float(rises[MIST])
        wheel = self.gears[gear]
        rise = recovery_rise(wheel.flanks.speed, wheel.tip_radius, self.recovery)
        rim, faces = self.mist_convection_factor * wheel.rim / 2, self.mist_convection_factor * wheel.faces
        yield Flow(MIST, FLANKS[gear], rim * (mist + rise - flank), "mist on the rim")
        yield Flow(MIST, BODIES[gear], rim * (mist + rise - body), "mist on the rim")
        yield Flow(MIST, BODIES[gear], faces * (mist + rise / 2 - body), "mist on the faces")

    def _bearing(self, number: int, rises: FloatArray) -> Iterator[Flow]:
        """Yield the heat flows of a bearing: friction, oil from feed to outlet, and conduction along the shaft."""
        journal, node = self.journals[number], MIST + 1 + number
        outlet, body = float(rises[node]), BODIES[journal.gear]
        warmed = outlet - self._feeds[number]
        power, flow = self.operation(number, outlet)
        yield Flow(self.size + 2, node, power, "friction of the bearing")
        yield Flow(node, self.size, self.oil.heat_capacity * flow * warmed, "oil of the bearing")
        yield Flow(body, node, journal.shaft_conductance * (float(rises[body]) - outlet), "shaft")

    def film_temperature(self, number: int, outlet: float) -> float:
        """Film temperature of a bearing [K], between feed and outlet; `outlet` is a rise over the gears' supply."""
        feed = self._feeds[number]
        return self.oil.inlet + feed + self.bearing_film_share * (outlet - feed)

    def _casing(self, walls: CasingWalls, rises: FloatArray) -> Iterator[Flow]:
        """Yield the heat flows from the mist to the casing and from the casing to the surroundings."""
        node, ambient = self.size - 1, walls.ambient - self.oil.inlet
        wall = float(rises[node])
        yield Flow(MIST, node, walls.area * walls.inside * (float(rises[MIST]) - wall), "mist on the casing")
        yield Flow(node, self.size + 1, walls.area * walls.outside * (wall - ambient), "surroundings")
