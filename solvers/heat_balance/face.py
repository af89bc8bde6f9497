"""Temperatures along the face of a gear pair: flanks, middle of the teeth, and the body below them (Eq. W1 to W3).

The network of the heat balance knows one flank and one body per gear. Here both are functions of the position on the
face: the friction enters where the load is, heat flows along the teeth, into the body and its shaft, and from there to
the bearings. Oil, mist, bearings and losses are those of the network. Temperatures are rises over the supply of the oil
[K], at the nodes of the rim: three per ring, quadratic between them.
"""

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.heat_balance.convection import face_convection, recovery_rise, rim_convection
from solvers.heat_balance.fling_off import TOOTH_HEIGHT, fling_off
from solvers.heat_balance.losses import acceleration_power, impact_rise, jet_power
from solvers.heat_balance.network import MIST, CooledGear, Network
from solvers.heat_balance.rings import Exchange, Response, RotorGeometry, line_shape, response

LEAST_RINGS = 20  # over each face
LEAST_WIDTH = 0.05  # of a ring that is divided at a web, over that of the others
TOLERANCE = 1e-10  # K, of the last Newton step
MOST_STEPS = 30
DIFFERENCE = 1e-3  # K, for the slope of the oil's cooling over the temperature


@dataclass(frozen=True, slots=True)
class Rotor:
    """The body of a gear and its shaft, and the numbers of the bearings (None: none) at its low and high end.

    `shaft_radii` are those beside the low and the high end of the face [m].
    """

    geometry: RotorGeometry
    bearings: tuple[int | None, int | None]
    shaft_radii: tuple[float, float]


def face_lines(width: float, stations: int, webs: Collection[float] = ()) -> tuple[float, ...]:
    """Lines between the rings over a face, from 0 to its width [m]: at least 20 rings whose nodes include the stations.

    The edges of webs are lines too, unless a line is close.
    """
    nodes = 1 if webs else 2  # a ring that is divided at a web has its middle node elsewhere
    rings = next(rings for rings in range(LEAST_RINGS, 8 * stations) if nodes * rings % (stations - 1) == 0)
    lines = np.linspace(0.0, width, rings + 1).tolist()
    close = LEAST_WIDTH * width / rings
    return tuple(sorted(lines + [web for web in webs if min(abs(web - line) for line in lines) > close]))


@dataclass(frozen=True, slots=True)
class Along:
    """Temperatures along all faces: rises [K] of flanks and bodies (gears, nodes) and of the mist.

    `supplied` and `removed` is all heat [W].
    """

    flanks: FloatArray
    bodies: FloatArray
    mist: float
    mesh_power: float
    supplied: float
    removed: float

    @property
    def balance_error(self) -> float:
        """Heat supplied minus heat removed, over the heat supplied."""
        return (self.supplied - self.removed) / self.supplied if self.supplied else 0.0


@dataclass(frozen=True)
class Faces:
    """The toothed faces of a unit in its heat balance.

    `rises` are those of the nodes of the network [K]. `position` (faces, nodes) is the distance from the end of the
    face that meshes first [m] in the order of Z. `jets` is the oil at the nodes over the mean.
    """

    network: Network
    rises: FloatArray
    rotors: tuple[Rotor, Rotor]
    normal_module: float
    position: FloatArray
    jets: FloatArray

    @cached_property
    def responses(self) -> tuple[Response, Response]:
        """How the bodies of pinion and wheel respond to the temperatures of their rims."""
        pinion, wheel = (
            response(
                rotor.geometry,
                Exchange(gear.conductivity, self._disc(gear), self._rim(gear) if rotor.geometry.faces[1:] else 0.0),
            )
            for rotor, gear in zip(self.rotors, self.network.gears, strict=True)
        )
        return pinion, wheel

    def _disc(self, gear: CooledGear) -> float:
        return self.network.mist_convection_factor * face_convection(gear.flanks.speed, gear.tip_radius)

    def _rim(self, gear: CooledGear) -> float:
        return self.network.mist_convection_factor * rim_convection(gear.flanks.speed, gear.tip_radius)

    @cached_property
    def nodes(self) -> int:
        """Number of nodes of all faces."""
        return self.position.size

    @cached_property
    def _elements(self) -> NDArray[np.int64]:
        count = self.position.shape[1]
        first = np.concatenate([np.arange(0, count - 1, 2) + face * count for face in range(len(self.position))])
        return first[:, None] + np.arange(3)

    @cached_property
    def _halves(self) -> FloatArray:
        """Half the width of every ring [m]."""
        ends = self.position.ravel()[self._elements[:, [0, 2]]]
        return np.asarray(np.abs(ends[:, 1] - ends[:, 0]) / 2)

    def _assembled(self, block: FloatArray, factors: FloatArray) -> FloatArray:
        matrix = np.zeros((self.nodes, self.nodes))
        for nodes, factor in zip(self._elements, factors, strict=True):
            matrix[np.ix_(nodes, nodes)] += factor * block
        return matrix

    @cached_property
    def mass(self) -> FloatArray:
        """Integrals of products of two shape functions [m]: a heat per length at the nodes becomes heat [W]."""
        points, weights = leggauss(3)
        shapes = np.array([line_shape(s) for s in points])
        return self._assembled(np.einsum("g,gi,gj->ij", weights, shapes, shapes), self._halves)

    @cached_property
    def spread(self) -> FloatArray:
        """Integrals of shape functions with values that are linear between the nodes [m]."""
        points, weights = leggauss(2)
        block = np.zeros((3, 3))
        for low in (0, 1):  # the middle node divides the ring
            for t, weight in zip((points + 1) / 2, weights / 2, strict=True):
                hats = np.zeros(3)
                hats[low], hats[low + 1] = 1 - t, t
                block += weight * np.outer(line_shape(low - 1 + t), hats)
        return self._assembled(block, self._halves)

    @cached_property
    def conduction(self) -> FloatArray:
        """Integrals of products of two slopes of shape functions [1/m]."""
        points, weights = leggauss(2)
        slopes = np.array([[s - 0.5, -2 * s, s + 0.5] for s in points])
        return self._assembled(np.einsum("g,gi,gj->ij", weights, slopes, slopes), 1.0 / self._halves)

    def mean(self, values: FloatArray) -> float:
        """Mean over all faces of values at the nodes."""
        return float(self.mass.sum(axis=0) @ values / self.mass.sum())

    def tooth_area(self, gear: CooledGear) -> float:
        """Cross-section of all teeth for conduction along the face, z 2.25 m_n pi m_n/(2 cos beta) [m^2]."""
        transverse = 2 * gear.flanks.radius / gear.teeth  # m_n/cos(beta)
        return gear.teeth * TOOTH_HEIGHT * self.normal_module * pi * transverse / 2

    def solve(self, load: FloatArray, start: Along | None = None) -> Along:
        """Solve the temperatures under a relative line load at the nodes, by Newton's method (Eq. W1, W2).

        Raises NoSolution `heat_balance` if it does not converge.
        """
        values = self._first_guess() if start is None else _joined(start)
        for _ in range(MOST_STEPS):
            residual, slopes = self._linearised(values, load)
            step = np.linalg.solve(slopes, -residual)
            values = values + step
            if float(np.abs(step).max()) < TOLERANCE:
                return self._along(values)
        message = "the temperatures along the face do not converge. Reduce the losses or give more oil"
        raise NoSolution("heat_balance", message, {"residual_w": float(np.abs(residual).max())})

    def by_load(self, along: Along, hats: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Flanks and bodies (gears, nodes, hats) [K] per relative line load `hats` (nodes, hats).

        Mist and friction power stay as they are; the cooling by oil follows the temperature.
        """
        moved = []
        for gear in (0, 1):
            heat = self._friction(gear, along.mesh_power) * (self.spread @ hats)
            slopes = self._gear(gear, along.flanks[gear], along.bodies[gear], along.mist).slopes
            moved.append(np.linalg.solve(slopes, np.concatenate([heat, np.zeros_like(heat)])))
        both = np.array(moved)
        return both[:, : self.nodes], both[:, self.nodes :]

    def _first_guess(self) -> FloatArray:
        """Return the temperatures of the network at all nodes."""
        return np.append(np.repeat(self.rises[:MIST], self.nodes), self.rises[MIST])

    def _friction(self, gear: int, power: float) -> float:
        """Frictional heat of a gear per length of face [W/m]."""
        share = self.network.mesh.share_to_pinion
        return (share if gear == 0 else 1 - share) * power / self._width

    @cached_property
    def _width(self) -> float:
        """Width of all faces [m]."""
        return float(self.mass.sum())

    def _mesh_power(self, flanks: FloatArray) -> float:
        """Friction of the mesh [W] at the mean of both flanks."""
        mean = (self.mean(flanks[0]) + self.mean(flanks[1])) / 2
        return self.network.mesh.at(self.network.oil, self.network.oil.inlet + mean)

    def _linearised(self, values: FloatArray, load: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Residual of W1 to W3 and of the mist [W], and its derivative by all temperatures [W/K]."""
        count, mist = self.nodes, values[-1]
        flanks, bodies = _apart(values)
        power = self._mesh_power(flanks)
        by_mean = (self._mesh_power(flanks + DIFFERENCE) - power) / DIFFERENCE
        heat = self.spread @ load
        weights = self.mass.sum(axis=0) / self._width / 2
        residual, slopes = np.empty(values.size), np.zeros((values.size, values.size))
        given, by_mist = self._into_mist()
        residual[-1], slopes[-1, -1] = by_mist * mist - given, by_mist
        for gear in (0, 1):
            own = slice(2 * gear * count, 2 * (gear + 1) * count)
            flank = slice(own.start, own.start + count)
            state = self._gear(gear, flanks[gear], bodies[gear], mist)
            residual[own], slopes[own, own], slopes[own, -1] = state.residual, state.slopes, state.by_mist
            residual[flank] -= self._friction(gear, power) * heat
            for other in (0, 1):
                slopes[flank, 2 * other * count : (2 * other + 1) * count] -= np.outer(
                    self._friction(gear, by_mean) * heat, weights
                )
            residual[-1] -= state.to_mist
            slopes[-1, own] -= state.to_mist_slopes
            slopes[-1, -1] -= state.to_mist_by_mist
        return residual, slopes

    def _into_mist(self) -> tuple[float, float]:
        """Heat that reaches the mist beside that of both gears [W], and what it gives away per kelvin [W/K]."""
        network, spray, oil = self.network, self.network.spray, self.network.oil
        pumped = (1 - network.pumping_to_teeth) * sum(gear.pumping for gear in network.gears)
        thrown = sum(acceleration_power(oil, spray.wetting(gear), spray.velocity, spray.jet) for gear in (0, 1))
        given = thrown + pumped + network.windage + network.other + jet_power(oil, spray.flow, spray.jet)
        walls, through = network.casing, 0.0
        if walls is not None:
            through = walls.area * walls.inside * walls.outside / (walls.inside + walls.outside)
            given += through * (walls.ambient - oil.inlet)
        return given, oil.heat_capacity * spray.flow + through

    def _cooling(self, gear: int, flanks: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Conductance of the oil on one flank and of oil out of the mist, per length of face (2, nodes) [W/(m K)].

        Also their slopes over the rise of the flank. The oil flow is that of the network times the jets' distribution.
        """
        network, spray = self.network, self.network.spray
        inlet, teeth = network.oil.inlet, network.gears[gear].flanks

        def at(shift: float) -> FloatArray:
            coolings = (
                fling_off(network.oil, teeth, share * spray.wetting(gear), spray.fling_off_factor, inlet + rise + shift)
                for share, rise in zip(self.jets.tolist(), flanks.tolist(), strict=True)
            )
            rows = [(one.conductance, spray.rewetting_share * (one.flooded - one.conductance)) for one in coolings]
            return np.array(rows).T / (2 * self._width)

        here = at(0.0)
        return here, (at(DIFFERENCE) - here) / DIFFERENCE

    def _gear(self, gear: int, flanks: FloatArray, bodies: FloatArray, mist: float) -> "_Gear":
        """Residual of W1 and W2 of a gear without its friction, and its derivatives."""
        network, spray, wheel, count = self.network, self.network.spray, self.network.gears[gear], self.nodes
        rise = recovery_rise(wheel.flanks.speed, wheel.tip_radius, network.recovery)
        impact = impact_rise(network.oil, spray.velocity, spray.jet)
        tooth, air = wheel.to_body / self._width, self._rim(wheel) * pi * wheel.tip_radius
        (side, wet), (side_slope, wet_slope) = self._cooling(gear, flanks)
        through = side * tooth / (side + tooth)
        through_slope = side_slope * (tooth / (side + tooth)) ** 2
        pumped = network.pumping_to_teeth * wheel.pumping / (2 * self._width)
        # Heat per length of face that leaves flanks and bodies for the mist, and how it follows their temperatures.
        of_flanks = side * (flanks - impact) + air * (flanks - mist - rise) + wet * (flanks - mist)
        of_bodies = through * (bodies - impact) + air * (bodies - mist - rise) + wet * (bodies - mist)
        flank_slopes = side + air + wet + side_slope * (flanks - impact) + wet_slope * (flanks - mist)
        body_slopes = through + air + wet
        body_by_flank = through_slope * (bodies - impact) + wet_slope * (bodies - mist)
        mass, along = self.mass, wheel.conductivity * self.tooth_area(wheel) / 2 * self.conduction
        body = self.responses[gear]
        sources = self.sources(gear, bodies, mist)
        ends, ring = [0, count - 1], self._rings(gear)
        ring_heat = ring * (bodies[ends] - mist - rise / 2)
        residual = np.concatenate(
            [
                along @ flanks + mass @ (of_flanks + tooth * (flanks - bodies) - pumped),
                along @ bodies + mass @ (of_bodies - tooth * (flanks - bodies) - pumped) + body.taken @ sources,
            ]
        )
        np.add.at(residual, [count + end for end in ends], ring_heat)
        slopes = np.block(
            [
                [along + mass * (flank_slopes + tooth), -mass * tooth],
                [mass * (body_by_flank - tooth), along + mass * (body_slopes + tooth) + body.taken[:, :count]],
            ]
        )
        slopes[[count, 2 * count - 1], [count, 2 * count - 1]] += ring
        of_mist = body.taken[:, count] + body.taken[:, count + 1]
        by_mist = np.concatenate([-mass @ (air + wet), -mass @ (air + wet) + of_mist])
        by_mist[[count, 2 * count - 1]] -= ring
        weights = mass.sum(axis=0)
        to_mist_slopes = np.concatenate(
            [weights * (flank_slopes + body_by_flank), weights * body_slopes + body.to_air[:count]]
        )
        to_mist_slopes[[count, 2 * count - 1]] += ring
        return _Gear(
            residual=residual,
            slopes=slopes,
            by_mist=by_mist,
            to_mist=float(weights @ (of_flanks + of_bodies) + body.to_air @ sources + ring_heat.sum()),
            to_mist_slopes=to_mist_slopes,
            to_mist_by_mist=float(
                -2 * weights @ (air + wet) + body.to_air[count] + body.to_air[count + 1] - ring.sum()
            ),
            to_journals=float(body.to_journals.sum(axis=0) @ sources) if body.to_journals.size else 0.0,
        )

    def sources(self, gear: int, bodies: FloatArray, mist: float) -> FloatArray:
        """Temperatures to which the rotor of a gear responds: rim, air at its faces and between helices, bearings."""
        wheel = self.network.gears[gear]
        rise = recovery_rise(wheel.flanks.speed, wheel.tip_radius, self.network.recovery)
        ends = [0.0 if k is None else float(self.rises[MIST + 1 + k]) for k in self.rotors[gear].bearings]
        return np.array([*bodies, mist + rise / 2, mist + rise, *ends])

    def _rings(self, gear: int) -> FloatArray:
        """Conductances from the ends of the teeth to the mist at the low and the high end of the unit [W/K]."""
        wheel, rotor = self.network.gears[gear], self.rotors[gear]
        inner = np.maximum(rotor.shaft_radii, rotor.geometry.root_radius)
        return self._disc(wheel) * pi * np.maximum(wheel.tip_radius**2 - inner**2, 0.0)

    def _along(self, values: FloatArray) -> Along:
        """Return the temperatures with the balance of all heat."""
        flanks, bodies = _apart(values)
        power, mist = self._mesh_power(flanks), float(values[-1])
        given, by_mist = self._into_mist()
        states = [self._gear(gear, flanks[gear], bodies[gear], mist) for gear in (0, 1)]
        teeth = self.network.pumping_to_teeth * sum(gear.pumping for gear in self.network.gears)
        return Along(
            flanks=flanks,
            bodies=bodies,
            mist=mist,
            mesh_power=power,
            supplied=power + teeth + given,
            removed=by_mist * mist + sum(state.to_journals for state in states),
        )


@dataclass(frozen=True, slots=True)
class _Gear:
    """Residual [W] of the equations of a gear, its derivatives [W/K], and the heat that leaves the gear [W]."""

    residual: FloatArray
    slopes: FloatArray
    by_mist: FloatArray
    to_mist: float
    to_mist_slopes: FloatArray
    to_mist_by_mist: float
    to_journals: float


def _joined(along: Along) -> FloatArray:
    pairs = zip(along.flanks, along.bodies, strict=True)
    return np.concatenate([*(part for pair in pairs for part in pair), [along.mist]])


def _apart(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return flanks and bodies (gears, nodes)."""
    parts = values[:-1].reshape(2, 2, -1)
    return parts[:, 0], parts[:, 1]
