"""Shafts, bearings and couplings as one elastic system.

Under given loads it yields the gap over the face and the motion of the coupling hubs. Its ports are the hubs and the
stations along the face (of double-helical gears: along both faces, one after the other). A force at a station loads
both shafts with a force, a tilting moment and a torque. With the coefficients A of these loads, the flexibility C of
the shafts and the forces Q at the stations, the elastic gap is A^T C A Q. The matrix A^T C A is symmetric and positive
semidefinite, and Q^T A^T C A Q is twice the strain energy. Under loads q at the ports the bearings carry L q; bearings
displaced by u move the ports by L^T u.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import BearingFilm, DriveTrainInputs, Shaft
from solvers.drive_train.shafts.axial import AxialSplit, axial_split
from solvers.drive_train.shafts.bearings import BearingState, bearing_state
from solvers.drive_train.shafts.coupling_loads import LOADS, CouplingPort, coupling_port
from solvers.drive_train.shafts.frame import Frame, frame
from solvers.drive_train.shafts.shaft import GRAVITY, ShaftModel, shaft_model
from solvers.drive_train.shafts.thrust_budget import mesh_thrust
from solvers.gears.pair import PathOfContact


@dataclass(frozen=True, slots=True)
class ShaftPorts:
    """A shaft with N nodes, and the loads on these nodes."""

    model: ShaftModel
    shaft: Shaft
    speed: float
    rotation: float
    loads: FloatArray  # (2 planes, 2N, ports) on the nodes per unit load at a port
    mesh_loads: FloatArray  # (2 planes, 2N, stations), of the transverse forces alone
    torques: FloatArray  # (N, ports)
    weight: FloatArray  # (2 planes, 2N), of the shaft and of the part of each sleeve that it carries
    collar: FloatArray  # (2 planes, 2N), moment of the thrust collar under the axial force of the mesh

    @property
    def fixed(self) -> FloatArray:
        """Sum of the constant loads."""
        return self.weight + self.collar

    def motion(self, loads: FloatArray) -> FloatArray:
        """Return the elastic motion (2 planes, 2N) of the nodes under nodal loads while the bearings are at rest."""
        return np.asarray(loads @ self.model.flexibility)

    def reading(self, motion: FloatArray) -> FloatArray:
        """Convert a motion of the nodes (2 planes, 2N) into the motion of the ports."""
        return np.asarray(np.einsum("dnp,dn->p", self.loads, motion))


@dataclass(frozen=True, slots=True)
class Unit:
    """The elastic system of a unit. Its ports are the stations of all faces, and five motions per coupling.

    The five motions are those of the shaft at the hub: the displacements U and V along X and Y, both slopes, and the
    displacement along Z. The last follows from the slopes at the thrust collar: it is 0 without a collar, and always at
    a coupling of the wheel. Under loads q at the ports the bearings carry `bearing_loads` @ q + `bearing_rest` [N]: X
    and Y at the pinion's first bearing, X and Y at its second, then the same for the wheel.
    """

    frame: Frame
    stations: FloatArray  # positions y on a face, the same on every face, m
    shafts: tuple[ShaftPorts, ShaftPorts]
    bearing_film: BearingFilm
    couplings: tuple[CouplingPort, ...]
    elastic: FloatArray  # (ports, ports) m/N, ...; flexibility with the bearings at rest
    rest: FloatArray  # motion of the ports under the constant loads
    bearing_loads: FloatArray
    bearing_rest: FloatArray
    offsets: FloatArray  # of the bores, in the order of the bearing loads, m
    split: AxialSplit | None  # None for a single helix

    @property
    def count(self) -> int:
        """Number of stations of all faces."""
        return len(self.frame.faces) * self.stations.size

    def on_face(self, face: int) -> slice:
        """Return where the stations of a face stand among the ports."""
        return slice(face * self.stations.size, (face + 1) * self.stations.size)

    def bearings(self, loads: FloatArray) -> list[BearingState]:
        """Return load, displacement and other results of the four bearings under given loads of the ports."""
        carried = self.bearing_loads @ loads + self.bearing_rest
        return [
            bearing_state(
                bearing, carried[4 * i + 2 * k : 4 * i + 2 * k + 2], side.speed, side.rotation, self.bearing_film
            )
            for i, side in enumerate(self.shafts)
            for k, bearing in enumerate(side.shaft.bearings)
        ]

    def motion(self, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the motion of the ports under given loads, and its derivative (ports, ports) with respect to them."""
        states = self.bearings(loads)
        displacement = np.concatenate([state.displacement for state in states]) + self.offsets
        yielding = np.zeros((8, 8))
        for i, state in enumerate(states):
            yielding[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = state.flexibility
        motion = self.elastic @ loads + self.rest + self.bearing_loads.T @ displacement
        return motion, self.elastic + self.bearing_loads.T @ yielding @ self.bearing_loads


def unit(inputs: DriveTrainInputs, path: PathOfContact) -> Unit:
    """Assemble shafts, bearings and couplings of a unit into one elastic system (Eq. D3)."""
    directions, plane = frame(inputs.arrangement, path, inputs.face_start), path.plane
    stations = np.linspace(0.0, plane.face_width, inputs.face_stations)
    load = inputs.mesh.distribution.load
    ratio = path.pair.pinion.teeth / path.pair.wheel.teeth
    torques, speeds = (load.torque, load.torque / ratio), (load.pinion_speed, load.pinion_speed * ratio)
    couplings = []
    for k, coupling in enumerate(inputs.acting_couplings):
        i = 0 if coupling.shaft == "pinion" else 1
        couplings.append(
            coupling_port(
                coupling,
                k,
                inputs.coupling_friction,
                torques[i],
                speeds[i],
                directions.shaft_rotation(i),
                directions.down,
                GRAVITY * inputs.arrangement.gravity_factor,
            )
        )
    sides = [_shaft_ports(inputs, path, directions, stations, tuple(couplings), speeds[i], i) for i in range(2)]
    elastic = sum(_elastic(side) for side in sides)
    shares = [np.einsum("bn,dnp->bdp", side.model.bearing_share, side.loads) for side in sides]
    rests = [np.einsum("bn,dn->bd", side.model.bearing_share, side.fixed) for side in sides]
    offsets = [np.array([bearing.offset for bearing in side.shaft.bearings]) for side in sides]
    return Unit(
        frame=directions,
        stations=stations,
        shafts=(sides[0], sides[1]),
        bearing_film=inputs.bearing_film,
        couplings=tuple(couplings),
        elastic=np.asarray(elastic),
        rest=np.asarray(sum(side.reading(side.motion(side.fixed)) for side in sides)),
        bearing_loads=np.concatenate([share.reshape(4, -1) for share in shares]),
        bearing_rest=np.concatenate([rest.ravel() for rest in rests]),
        offsets=np.concatenate([offset.ravel() for offset in offsets]),
        split=axial_split(inputs, directions, tuple(couplings)),
    )


def _elastic(side: ShaftPorts) -> FloatArray:
    """Return the flexibility (ports, ports) of one shaft, for bending in both planes and for torsion."""
    bending = sum(plane.T @ side.model.flexibility @ plane for plane in side.loads)
    return np.asarray(bending + side.torques.T @ side.model.torsion @ side.torques)


def torque_position(inputs: DriveTrainInputs, index: int) -> float:
    """Return the position at which torque enters a shaft [m]. By default this is the position of the coupling."""
    given = inputs.shafts[index].torque_position
    if given is not None:
        return given
    name = ("pinion", "wheel")[index]
    return next(coupling.position for coupling in inputs.couplings if coupling.shaft == name)


def _shaft_ports(
    inputs: DriveTrainInputs,
    path: PathOfContact,
    directions: Frame,
    stations: FloatArray,
    couplings: tuple[CouplingPort, ...],
    speed: float,
    index: int,
) -> ShaftPorts:
    """Return the shaft of the pinion (0) or of the wheel (1), and the loads on its nodes per unit load at the ports."""
    shaft, name, sign = inputs.shafts[index], ("pinion", "wheel")[index], (1.0, -1.0)[index]
    on_faces = [(face, float(z)) for face in directions.faces for z in face.positions(stations)]
    z = np.array([position for _, position in on_faces])
    hubs = [port.inputs.position for port in couplings if port.inputs.shaft == name]
    model = shaft_model(shaft, torque_position(inputs, index), np.concatenate([z, hubs]))
    nodes, count = model.z.size, z.size + LOADS * len(couplings)
    loads, torques = np.zeros((2, 2 * nodes, count)), np.zeros((nodes, count))
    mesh_loads = np.zeros((2, 2 * nodes, z.size))
    arm = directions.arms[index]
    lever = float(directions.transverse_force @ np.cross([0.0, 0.0, 1.0], arm))
    weight = inputs.arrangement.gravity_factor * np.multiply.outer(directions.down, model.weight)
    for k, (face, position) in enumerate(on_faces):
        node = model.node(position)
        mesh_loads[:, node, k] = sign * face.force[:2]
        loads[:, nodes + node, k] = -sign * face.force[2] * arm[:2]
        torques[node, k] = sign * lever
    loads[:, :, : z.size] += mesh_loads
    collar = _collar_loads(inputs, path, directions, model, z[-1], index)
    for k, port in enumerate(couplings):
        first = z.size + LOADS * k
        if port.inputs.shaft == "pinion":
            loads[:, :, first + 4] = -collar
        if port.inputs.shaft == name:
            node = model.node(port.inputs.position)
            loads[0, node, first] = loads[1, node, first + 1] = 1.0
            loads[0, nodes + node, first + 2] = loads[1, nodes + node, first + 3] = 1.0
            weight[:, node] += port.sleeve_weight
    return ShaftPorts(
        model=model,
        shaft=shaft,
        speed=speed,
        rotation=directions.shaft_rotation(index),
        loads=loads,
        mesh_loads=mesh_loads,
        torques=torques,
        weight=weight,
        collar=-mesh_thrust(inputs, path, directions) * collar,
    )


def _collar_loads(
    inputs: DriveTrainInputs,
    path: PathOfContact,
    directions: Frame,
    model: ShaftModel,
    position: float,
    index: int,
) -> FloatArray:
    """Nodal loads of an axial force of 1 N at the thrust collar, towards +Z on the pinion; 0 without a collar.

    At the radius of the collar the force is a tilting moment, which acts at the end y = b of the face.
    """
    loads = np.zeros((2, 2 * model.z.size))
    if inputs.collar_radius is not None:
        radius = inputs.collar_radius - (0.0 if index == 0 else path.pair.centre_distance)
        sign = 1.0 if index == 0 else -1.0
        loads[:, model.z.size + model.node(position)] = -sign * radius * directions.radial[:2]
    return loads
