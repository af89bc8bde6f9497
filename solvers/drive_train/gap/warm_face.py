"""The warm face: the loaded end of the face heats itself, grows and carries more, while elastic rotors hold it.

The temperatures along the face follow the line load (Eq. W1 to W3), the growth of the rotors follows the temperatures
(W4), and the line load follows the growth (W7, D11). The unknown of the iteration is the relative line load w at the
stations of all faces. The loop matrix L = -C P E says how much of a change of w comes back: E is the growth per load, P
removes the mean over each face, C is the load per gap with mesh and shafts responding.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, sin

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import simpson
from scipy.optimize import least_squares

from solvers.arrays import FloatArray
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.gap.rotors import rotors_of, web_edges
from solvers.drive_train.gap.thermal_lead import EXPANSION, ThermalLead
from solvers.drive_train.inputs import NAMES_OF_SHAFTS, DriveTrainInputs
from solvers.drive_train.prepared import Prepared, settle
from solvers.errors import NoSolution
from solvers.heat_balance.calibration import LEAST_WETTING, MOST_WETTING, wetted
from solvers.heat_balance.face import Along, Faces, face_lines
from solvers.heat_balance.inputs import FaceReading
from solvers.heat_balance.network import Network
from solvers.heat_balance.rings import Response, response
from solvers.heat_balance.solution import equilibrium as balance

TOLERANCE = 1e-9  # of the relative line load
MOST_STEPS = 25
LARGEST_STEP = 0.5  # of the relative line load, chosen
HELD_ABOVE, NEAR = (
    0.8,
    0.02,
)  # largest eigenvalue from which steps are held back; change of the load below which none is
MOST_SKEW = 0.9


@dataclass(frozen=True, slots=True)
class Amplification:
    """How the loop multiplies misalignment: one gain and two amplifications per face; None if it is unstable (W9)."""

    gain: tuple[float | None, ...]
    skew: tuple[float | None, ...]
    end: tuple[float | None, ...]
    largest_eigenvalue: float


@dataclass(frozen=True, slots=True)
class WarmFace:
    """A unit whose flanks have the temperatures of their own load.

    `prepared` holds its gaps by heat, `leads` (faces, stations) the part of them that follows the own heat [m].
    `flanks` and `bodies` (gears, faces, stations) [K].
    """

    prepared: Prepared
    equilibrium: Equilibrium
    along: Along
    flanks: FloatArray
    bodies: FloatArray
    leads: FloatArray
    amplification: Amplification


@dataclass(frozen=True)
class WarmFaces:
    """The loop of load, temperatures and growth in a unit with a heat balance.

    `rises` are those of the nodes of `network` [K]; `prepared` is the unit with the gaps by heat of uniform flanks and
    bodies. The oil flow of the jets is `skew` larger at the end that meshes last than in the mean.
    """

    inputs: DriveTrainInputs
    prepared: Prepared
    network: Network
    rises: FloatArray
    skew: float = 0.0

    def solve(self, start: Equilibrium) -> WarmFace:
        """Find the load at which flanks and load are in balance, by Newton's iteration (Eq. W10).

        Raises NoSolution: `heat_balance` if it does not converge; the errors of `settle` and of the temperatures.
        """
        equilibrium, along = start, None
        load = self.relative_load(equilibrium)
        for _ in range(MOST_STEPS):
            along = self.faces.solve(self.at_nodes(load), along)
            prepared = self.heated(along)
            equilibrium = settle(self.inputs, prepared, equilibrium.gap)
            change = self.relative_load(equilibrium) - load
            largest = float(np.abs(change).max())
            if largest < TOLERANCE:
                return WarmFace(
                    prepared,
                    equilibrium,
                    along,
                    self._absolute(along.flanks),
                    self._absolute(along.bodies),
                    self._at_stations(self._own_leads(along)),
                    self.amplification(equilibrium, along),
                )
            loop = self.loop(equilibrium, along)
            # Far from the solution a loop whose gain is near or above 1 must not turn the step round.
            held = max(0.0, float(np.linalg.eigvals(loop).real.max()) - HELD_ABOVE) * min(1.0, largest / NEAR)
            step = np.linalg.solve((1.0 + held) * np.eye(load.size) - loop, change.ravel())
            shortened = min(1.0, LARGEST_STEP / float(np.abs(step).max()))
            load = np.maximum(load + shortened * step.reshape(load.shape), 0.0)
        message = (
            "load and temperatures along the face do not settle: one end takes the load and heats itself further. Give "
            "more oil on the flanks, a stiffer wheel, or less friction"
        )
        raise NoSolution("heat_balance", message, {"change_of_load": largest})

    def even(self, start: Equilibrium) -> tuple[Prepared, Equilibrium, FloatArray]:
        """The unit whose flanks are heated as by an even load: what the loop adds is the difference from it.

        Also return its flank temperatures (gears, faces, stations) [K].
        """
        prepared = self.heated(self._even)
        return prepared, settle(self.inputs, prepared, start.gap), self._absolute(self._even.flanks)

    def relative_load(self, equilibrium: Equilibrium) -> FloatArray:
        """Line load at the stations over the mean of all faces (faces, stations); 1 without load."""
        faces, count = len(self.prepared.meshes), self.prepared.unit.stations.size
        force = equilibrium.loads[: faces * count].reshape(faces, count)
        total = float(force.sum())
        weights = np.full(count, 1.0 / (count - 1))
        weights[[0, -1]] /= 2
        return np.ones_like(force) if total <= 0.0 else force * faces / (weights * total)

    @cached_property
    def _even(self) -> Along:
        return self.faces.solve(np.ones(self.faces.nodes))

    @cached_property
    def faces(self) -> Faces:
        """The faces with their rotors."""
        frame, unit, path = self.prepared.unit.frame, self.prepared.unit, self.prepared.path
        width, webs = path.plane.face_width, web_edges(self.inputs)
        on_face = [[web - face.start for web in webs if 0.0 < web - face.start < width] for face in frame.faces]
        lines = [np.array(face_lines(width, unit.stations.size, own)) for own in on_face]
        position = []
        for face, own in zip(frame.faces, lines, strict=True):
            nodes = np.sort(np.concatenate([own, (own[1:] + own[:-1]) / 2]))
            position.append(nodes if face.direction > 0.0 else width - nodes)
        return Faces(
            network=self.network,
            rises=self.rises,
            rotors=rotors_of(
                self.inputs,
                path.pair,
                tuple(tuple(face.start + own) for face, own in zip(frame.faces, lines, strict=True)),
            ),
            normal_module=path.pair.inputs.normal_module,
            position=np.array(position),
            jets=np.concatenate([self._jets(own) for own in position]),
        )

    def _jets(self, position: FloatArray) -> FloatArray:
        """Oil flow over its mean at positions of a face [m]."""
        given, width = self.inputs.mesh.cooling.jet_distribution, self.prepared.path.plane.face_width
        jets = np.interp(position, given.position, given.weight) if given.position else np.ones_like(position)
        return np.asarray(
            jets * width / abs(simpson(jets, x=position)) * (1.0 + self.skew * (2 * position / width - 1.0))
        )

    @cached_property
    def _stations(self) -> NDArray[np.int64]:
        """Indices of the stations among the nodes of every face (faces, stations), from the ends that mesh first."""
        stations = self.prepared.unit.stations
        nodes = self.ordered(self.faces.position.ravel())
        return np.array([[int(np.argmin(np.abs(own - station))) for station in stations] for own in nodes])

    def _at_stations(self, values: FloatArray) -> FloatArray:
        """Pick the values at the stations (..., faces, stations) of values at the nodes (..., faces, nodes)."""
        return np.take_along_axis(
            values, np.broadcast_to(self._stations, (*values.shape[:-1], self._stations.shape[1])), -1
        )

    def ordered(self, values: FloatArray) -> FloatArray:
        """Values at the nodes (..., nodes of all faces) as (..., faces, nodes) from the ends that mesh first."""
        rows = values.reshape(*values.shape[:-1], *self.faces.position.shape)
        turned = [face.direction < 0.0 for face in self.prepared.unit.frame.faces]
        return np.stack([rows[..., k, ::-1] if back else rows[..., k, :] for k, back in enumerate(turned)], axis=-2)

    def at_nodes(self, load: FloatArray) -> FloatArray:
        """Return values that are linear between the stations (faces, stations) at the nodes in the order of Z."""
        stations = self.prepared.unit.stations
        rows = zip(self.faces.position, load, strict=True)
        return np.concatenate([np.interp(position, stations, own) for position, own in rows])

    def _absolute(self, rises: FloatArray) -> FloatArray:
        """Temperatures at the stations (gears, faces, stations) [K]."""
        return self.network.oil.inlet + self._at_stations(self.ordered(rises))

    @cached_property
    def levers(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """sin(alpha') and s - r_f sin(alpha') of pinion and wheel [1, m]."""
        path = self.prepared.path
        pair, arms = path.pair, (path.pitch_point, path.pair.line_of_action - path.pitch_point)
        radii = (pair.pinion_working_radius, pair.wheel_working_radius)
        pinion, wheel = (
            (slope, arm - gear.root_radius * slope)
            for arm, radius, gear in zip(arms, radii, (pair.pinion, pair.wheel), strict=True)
            for slope in [sin(pair.working_pressure_angle - pi * pair.transverse_module / (4 * radius))]
        )
        return pinion, wheel

    def growth(self, gear: int, teeth: FloatArray, body: Response, sources: FloatArray) -> FloatArray:
        """Growth e towards the mating flank at the nodes [m] (Eq. W4).

        `teeth` (nodes, ...) is the mean temperature of flank and middle, `sources` those of the rotor, both as
        differences from the temperature of the drawing [K].
        """
        slope, length = self.levers[gear]
        directions = np.array([face.direction for face in self.prepared.unit.frame.faces])
        along = np.repeat(directions, self.faces.position.shape[1])
        tilt = (1.0 if gear == 0 else -1.0) * self.prepared.path.plane.tan_base_helix
        axial = (body.axial @ sources).T * along
        expansion = EXPANSION if self.inputs.effects.thermal else 0.0
        return np.asarray(expansion * (slope * (body.radial @ sources) + length * teeth + tilt * axial.T))

    def _own_leads(self, along: Along) -> FloatArray:
        """Gaps by the own heat of the teeth (faces, nodes) [m], from the ends that mesh first."""
        shift = self.network.oil.inlet - self.inputs.heat.reference
        growth = sum(
            self.growth(
                gear,
                (along.flanks[gear] + along.bodies[gear]) / 2 + shift,
                self.faces.responses[gear],
                self.faces.sources(gear, along.bodies[gear], along.mist) + shift,
            )
            for gear in (0, 1)
        )
        return self.gaps(np.asarray(growth))

    @cached_property
    def gas_leads(self) -> FloatArray:
        """Gaps by the profile of the pumped gas (faces, nodes) [m], from the ends that mesh first (Eq. W6)."""
        thermal, growth = self.prepared.thermals[0], np.zeros(self.faces.nodes)
        points = np.linspace(0.0, self.prepared.unit.stations[-1], thermal.pinion_rise.size)
        for gear, rise in enumerate((thermal.pinion_rise, thermal.wheel_rise)):
            own = np.interp(self.faces.position, points, rise).ravel()
            if own.any():
                insulated = response(self.faces.rotors[gear].geometry, None)
                growth += self.growth(gear, own, insulated, np.append(own, np.zeros(4)))
        return self.gaps(growth)

    def gaps(self, growth: FloatArray) -> FloatArray:
        """Gaps (faces, nodes) [m] by the growth at the nodes, less the mean over each face (Eq. W5)."""
        position = self.ordered(self.faces.position.ravel())
        pairs = zip(self.ordered(growth), position, strict=True)
        return np.array([np.trapezoid(own, y) / np.ptp(y) - own for own, y in pairs])

    def heated(self, along: Along) -> Prepared:
        """Return the unit with the gaps and the flanks of these temperatures (Eq. W7)."""
        before, own, even = self.prepared, self._own_leads(along), self._own_leads(self._even)
        flanks = self._absolute(along.flanks)
        points = np.linspace(0.0, before.unit.stations[-1], before.thermals[0].lead.size)
        nodes = self.ordered(self.faces.position.ravel())
        thermals, meshes = list[ThermalLead](), []
        for face, (mesh, thermal) in enumerate(zip(before.meshes, before.thermals, strict=True)):
            lead, at_even = (np.interp(points, nodes[face], each[face] + self.gas_leads[face]) for each in (own, even))
            thermals.append(replace(thermal, lead=lead, even_lead=at_even, flanks=flanks[:, face]))
            meshes.append(replace(mesh, fixed=mesh.fixed - thermal.lead + lead))
        return replace(before, meshes=tuple(meshes), thermals=tuple(thermals))

    def by_gap(self, equilibrium: Equilibrium) -> FloatArray:
        """C: relative line load per gap at the stations of all faces [1/m]."""
        force = float(equilibrium.loads[: self.prepared.unit.count].sum())
        faces, count = len(self.prepared.meshes), self.prepared.unit.stations.size
        weights = np.full(count, 1.0 / (count - 1))
        weights[[0, -1]] /= 2
        if force <= 0.0:
            return np.zeros_like(equilibrium.by_gap)
        return np.asarray(equilibrium.by_gap * faces / (force * np.tile(weights, faces))[:, None])

    def loop(self, equilibrium: Equilibrium, along: Along) -> FloatArray:
        """L = -C P E: what comes back of a change of the relative line load (Eq. W8)."""
        faces, count = len(self.prepared.meshes), self.prepared.unit.stations.size
        units = np.eye(faces * count).reshape(-1, faces, count)
        hats = np.array([self.at_nodes(unit) for unit in units]).T
        flanks, bodies = self.faces.by_load(along, hats)
        growth = np.zeros((self.faces.nodes, hats.shape[1]))
        for gear in (0, 1):
            sources = np.concatenate([bodies[gear], np.zeros((4, hats.shape[1]))])
            growth += self.growth(gear, (flanks[gear] + bodies[gear]) / 2, self.faces.responses[gear], sources)
        ordered = self._at_stations(self.ordered(growth.T))  # (hats, faces, stations)
        without_mean = ordered - np.asarray(np.trapezoid(ordered, axis=-1) / (count - 1))[..., None]
        return -self.by_gap(equilibrium) @ without_mean.reshape(hats.shape[1], -1).T

    def fit(self, readings: tuple[FaceReading, ...], equilibrium: Equilibrium) -> tuple[float, float]:
        """Wetting share and skew of the jets that come closest to the readings, at the load that is there."""
        load = self.relative_load(equilibrium)
        skewed = len({reading.position for reading in readings}) > 1

        def deviations(values: FloatArray) -> FloatArray:
            network = wetted(self.network, float(values[0]))
            rises = balance(network, self.rises).rises
            there = replace(self, network=network, rises=rises, skew=float(values[1]) if skewed else 0.0)
            return there.deviations(readings, load)

        bounds = ([LEAST_WETTING, -MOST_SKEW], [MOST_WETTING, MOST_SKEW])
        found = least_squares(
            deviations, [self.network.spray.wetting_share, self.skew], bounds=bounds, x_scale=[0.1, 0.1], xtol=1e-9
        )
        return float(found.x[0]), float(found.x[1]) if skewed else 0.0

    def deviations(self, readings: tuple[FaceReading, ...], load: FloatArray) -> FloatArray:
        """Temperatures at the places of the readings under a relative line load, minus the readings [K]."""
        along, stations = self.faces.solve(self.at_nodes(load)), self.prepared.unit.stations
        rows = {"flank": self._absolute(along.flanks), "body": self._absolute(along.bodies)}
        return np.array(
            [
                np.interp(
                    one.position,
                    stations,
                    rows[one.place][NAMES_OF_SHAFTS.index(one.gear), one.helix - 1],
                )
                - one.temperature
                for one in readings
            ]
        )

    def amplified(self, equilibrium: Equilibrium, load: FloatArray) -> Amplification:
        """How the loop of this network multiplies misalignment at a load that is given."""
        return self.amplification(equilibrium, self.faces.solve(self.at_nodes(load)))

    def amplification(self, equilibrium: Equilibrium, along: Along) -> Amplification:
        """How the loop multiplies a skew of the gap of every face at a load."""
        return amplification(self.loop(equilibrium, along), self.by_gap(equilibrium), len(self.prepared.meshes))


def amplification(loop: FloatArray, by_gap: FloatArray, faces: int) -> Amplification:
    """How a loop multiplies the load by a skewed gap of each face, by the stations of all faces (Eq. W9)."""
    count = len(loop) // faces
    largest = float(np.linalg.eigvals(loop).real.max())
    skew = np.linspace(-0.5, 0.5, count)
    pairs = list[tuple[float | None, float | None]]()
    for face in range(faces):
        here = slice(face * count, (face + 1) * count)
        alone = by_gap[:, here] @ skew
        both = np.linalg.solve(np.eye(len(loop)) - loop, alone)
        first, amplified = (float(np.trapezoid(skew * load[here])) for load in (alone, both))
        if largest >= 1.0 or first == 0.0:
            pairs.append((None, None))
        else:
            pairs.append((amplified / first, float(np.abs(both[here]).max() / np.abs(alone[here]).max())))
    return Amplification(
        gain=tuple(None if skewed is None else 1 - 1 / skewed for skewed, _ in pairs),
        skew=tuple(skewed for skewed, _ in pairs),
        end=tuple(end for _, end in pairs),
        largest_eigenvalue=largest,
    )
