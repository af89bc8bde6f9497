"""Moments and forces of a gear coupling on a shaft of the unit, as functions of the tilts of both hubs.

Hub A sits on the unit's shaft, hub B on the machine's shaft. The distance between the hubs is l. `towards` is +1 if the
machine lies towards +Z, else -1. The slope of the sleeve is (c_B - c_A) / (towards l), where c_A and c_B are the
positions of the hubs in X and Y. The tilt of a hub is the slope of the hub minus the slope of the sleeve. This tilt is
a vector d = delta e with the size delta and the direction e.

T is the torque, and s is the sense of rotation. s_d is +1 if the hub drives the sleeve, else -1. M_l is the loss moment
of friction. The straightening moment M_s and the elastic moment M_e act against the tilt; their sum is a = M_s + M_e.
Moments m are conjugate to slopes: m = -Z x M for a moment vector M. The loads are
    moment on hub A               m = -a e + s (M_l - s_d T delta / 2) Z x e
    force on the unit's shaft     f = towards [-a e + s (M_l + s_d T delta / 2) Z x e] / l     summed over both hubs
The force on the unit's shaft results from the moments on the sleeve. The sign of T delta / 2 differs between hub and
sleeve, because the axis of the torque bisects the angle between the axes of hub and sleeve. Along Z the coupling pushes
the shaft with the share tau of the friction limit. This limit is the smaller of the limits of both hubs.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import acos, asin, cos, hypot, pi, sin, sqrt

import numpy as np

from solvers.arrays import FloatArray
from solvers.coupling import model as gear_coupling
from solvers.coupling.friction import loaded_mesh, losses
from solvers.coupling.inputs import CouplingInputs, Operation, check_inputs
from solvers.coupling.kinematics import mesh_motion, pitch_radius, tooth_geometry
from solvers.coupling.lubrication import check_contact, film_state, friction_coefficient
from solvers.coupling.tooth_loads import coaxial_limit
from solvers.drive_train.inputs import CouplingFriction, UnitCoupling
from solvers.errors import InvalidInput
from solvers.notices import Notice

LOADS = 5  # number of loads of a coupling on its shaft: F_X, F_Y, m_X, m_Y, F_Z
TILTS = 4  # number of tilts of a coupling: hub A and hub B in both planes
STEP = 1e-4  # relative step of the tilt, for finite differences
LEAST_TILT = 1e-12  # rad; below this tilt the moments are proportional to the tilt


@dataclass(frozen=True, slots=True)
class HubMoments:
    """Moments of one hub [N m], and the largest axial thrust of the hub [N].

    `straightening` is the whole moment against the tilt, M_s + M_e. `loss` is the loss moment of friction, M_l. The hub
    `sticks` if none of its teeth slides. `share` is the root of M_l^2 + M_e^2, divided by the friction moment of full
    sliding.
    """

    straightening: float
    loss: float
    friction_coefficient: float
    thrust_limit: float
    sticks: bool
    share: float


@dataclass(frozen=True, slots=True)
class CouplingPort:
    """A coupling, and the torque [N m], speed [rad/s] and rotation of the unit's shaft on which the coupling sits.

    The tilts of both hubs are `rest` + `lever` @ v. The vector v is the motion of the shaft at the hub: displacements U
    and V along X and Y, both slopes, and the displacement along Z. `sleeve_weight` (X, Y) [N] is the part of the
    sleeve's weight that the shaft carries.
    """

    inputs: UnitCoupling
    index: int
    law: CouplingFriction
    torque: float
    speed: float
    rotation: float
    rest: FloatArray
    lever: FloatArray
    sleeve_weight: FloatArray

    @property
    def length(self) -> float:
        """Hub distance, negative if the machine lies towards -Z [m]."""
        distance = self.inputs.coupling.hub_distance
        return distance if self.inputs.machine_side == "plus" else -distance

    @property
    def driving(self) -> tuple[float, float]:
        """Signs s_d of hubs A and B: +1 for a hub that drives the sleeve, else -1.

        The machine on the pinion's shaft drives the unit. The unit drives the machine on the wheel's shaft.
        """
        return (-1.0, 1.0) if self.inputs.shaft == "pinion" else (1.0, -1.0)


def coupling_port(
    inputs: UnitCoupling,
    index: int,
    law: CouplingFriction,
    torque: float,
    speed: float,
    rotation: float,
    down: FloatArray,
    gravity: float,
) -> CouplingPort:
    """Return the coupling with the torque, speed and rotation of its shaft.

    `down` (X, Y) is the unit vector in the direction of gravity, and `gravity` is the acceleration of gravity [m/s^2].
    If the supports are warm, the shaft of the machine rises in the direction opposite to `down`.
    """
    offset = np.array(inputs.offset) - (0.0 if inputs.alignment is None else inputs.alignment.growth) * down
    distance = inputs.coupling.hub_distance if inputs.machine_side == "plus" else -inputs.coupling.hub_distance
    one, none, axial = np.eye(2), np.zeros((2, 2)), np.zeros((2, 1))
    return CouplingPort(
        inputs=inputs,
        index=index,
        law=law,
        torque=torque,
        speed=speed,
        rotation=rotation,
        rest=np.concatenate([-offset / distance, np.array(inputs.slope) - offset / distance]),
        lever=np.block([[one / distance, one, axial], [one / distance, none, axial]]),
        sleeve_weight=gravity * inputs.coupling.sleeve_mass * down,
    )


def sliding_tilt(port: CouplingPort, friction: float) -> float:
    """Compute the tilt of a hub at which the teeth begin to slide; below this tilt the teeth only yield elastically.

    Parameters
    ----------
    port : CouplingPort
        The coupling and its shaft.
    friction : float
        Coefficient of friction mu [-].

    Returns
    -------
    float
        Tilt delta_0 = kt mu T / (z r_o^2 cos alpha c_a) [rad].

    Notes
    -----
    Eq. D8. kt is the result of `axial_share`, T is the torque, z is the number of teeth, r_o is the pitch radius, alpha
    is the pressure angle, and c_a is the axial stiffness of a tooth.
    """
    return axial_share(port) * _yielding_tilt(port, friction)


def _yielding_tilt(port: CouplingPort, friction: float) -> float:
    """Tilt at which the teeth begin to slide while nothing acts along the shaft, mu T/(z r_o^2 cos alpha c_a) [rad]."""
    coupling = port.inputs.coupling
    stiffness = port.inputs.axial_tooth_stiffness or coupling.tooth_stiffness
    elastic = coupling.teeth * pitch_radius(coupling) ** 2 * cos(coupling.pressure_angle) * stiffness
    return friction * port.torque / elastic


def held_thrust(port: CouplingPort, friction: float, tilt: float) -> float:
    """Share of the friction limit that a hub can hold along the shaft, max(0, 1 - delta/delta_0) (Eq. D21).

    A hub that slides in tilt cannot hold a steady axial force: it creeps until the force is gone.
    """
    limit = _yielding_tilt(port, friction)
    return max(0.0, 1.0 - tilt / limit) if limit > 0.0 else 0.0


def runout_thrust(port: CouplingPort, runout: float, tilts: tuple[float, float]) -> float:
    """Share of the friction limit by an axial motion of amplitude `runout` [m] over sliding hubs (Eq. D21).

    Both hubs are in series, so that they share the motion in proportion to their tilts: (2/pi) asin(e/(r_o sum delta)).
    """
    reach = pitch_radius(port.inputs.coupling) * sum(tilts)
    return 2 / pi * asin(runout / reach) if runout < reach else 1.0


def axial_share(port: CouplingPort) -> float:
    """Compute the share of a coupling's friction that can resist tilting while the axial thrust acts.

    Parameters
    ----------
    port : CouplingPort
        The coupling and its shaft.

    Returns
    -------
    float
        Share kt = cos(pi tau / 2) [-].

    Notes
    -----
    Eq. D7. tau is the axial thrust of the coupling divided by the friction limit.
    """
    return cos(pi * min(abs(port.inputs.thrust_fraction), 1.0) / 2)


def elastic_plastic(ratio: float) -> tuple[float, float]:
    """Compute loss moment and elastic moment of a hub whose teeth yield before they slide.

    Parameters
    ----------
    ratio : float
        Ratio beta of the tilt to the tilt at which sliding begins [-].

    Returns
    -------
    tuple of float
        Loss moment and elastic moment, both divided by the friction moment of full sliding [-].

    Notes
    -----
    Eq. D9. The teeth act like springs that slide above a limit force. Such springs pass through a hysteresis loop in
    one revolution. The moments are the first harmonic of this loop.
    """
    if ratio <= 1.0:
        return 0.0, pi * ratio / 4
    angle = acos(1 - 2 / ratio)
    return 1 - 1 / ratio, ratio / 4 * (angle - sin(2 * angle) / 2)


def regularised(ratio: float) -> tuple[float, float]:
    """Return loss moment and elastic moment of a hub, both divided by the friction moment of full sliding.

    In this friction law the teeth slide at any tilt. The loss moment rises smoothly with the tilt, and the elastic
    moment is 0. The law is for comparison only.
    """
    return ratio / sqrt(ratio**2 + 1), 0.0


def hub_moments(port: CouplingPort, tilt: float) -> HubMoments:
    """Compute the moments of one hub at a tilt.

    Parameters
    ----------
    port : CouplingPort
        The coupling and its shaft.
    tilt : float
        Tilt of the hub, greater than 0 [rad].

    Returns
    -------
    HubMoments
        The moments [N m] and the limit of thrust [N].

    Raises
    ------
    InvalidInput
        The errors of `coupling.solve`, with field names that begin with the path of the coupling in the unit.
    NoSolution
        The errors of `coupling.solve`.

    Notes
    -----
    Eq. D7. To save time, only the needed parts of the coupling's model are evaluated.
    """
    given = _operating_point(port, tilt)
    geometry = tooth_geometry(given.coupling)
    with _prefixed(port):
        check_inputs(given)
        mesh = mesh_motion(given.coupling, geometry, given.operation, given.model.kinematics)
        film = film_state(given, geometry, mesh)
        check_contact(film, geometry)
        friction = friction_coefficient(given.friction, film.overlap, film.load_capacity_coefficient, abs(mesh.sliding))
        sliding = losses(given, geometry, loaded_mesh(given, mesh), friction)
    limit, full = sliding_tilt(port, friction), axial_share(port) * sliding.friction_moment
    loss, elastic, ratio = 0.0, 0.0, np.inf
    if limit > 0.0:
        ratio = tilt / limit
        loss, elastic = elastic_plastic(ratio) if port.law == "elastic_plastic" else regularised(ratio)
    return HubMoments(
        straightening=sliding.contact_shift_moment + full * elastic,
        loss=full * loss,
        friction_coefficient=friction,
        thrust_limit=coaxial_limit(given.coupling, port.torque, friction),
        sticks=ratio < 1.0,
        share=sqrt(loss**2 + elastic**2),
    )


def hub_warnings(port: CouplingPort, tilt: float) -> tuple[Notice, ...]:
    """Return the warnings of the coupling model for a hub at a tilt [rad]."""
    with _prefixed(port):
        return gear_coupling.solve(_operating_point(port, tilt)).warnings


def _operating_point(port: CouplingPort, tilt: float) -> CouplingInputs:
    unit = port.inputs
    return CouplingInputs(
        unit.coupling, Operation(port.torque, port.speed, misalignment=tilt), unit.lubricant, unit.friction, unit.model
    )


@contextmanager
def _prefixed(port: CouplingPort) -> Iterator[None]:
    """Prefix the field names in errors of the coupling model with the path of the coupling in the unit."""
    try:
        yield
    except InvalidInput as error:
        field = f"couplings.{port.index}" + ("" if error.field is None else f".{error.field}")
        raise InvalidInput(error.code, error.message, field) from error


def coupling_loads(port: CouplingPort, tilts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Compute the loads of a coupling on the unit's shaft, and the derivative of these loads with respect to the tilts.

    Parameters
    ----------
    port : CouplingPort
        The coupling and its shaft.
    tilts : FloatArray of shape (4,)
        Tilts of hub A and hub B in both planes [rad].

    Returns
    -------
    loads : FloatArray of shape (5,)
        F_X, F_Y [N], m_X, m_Y [N m], F_Z [N].
    derivative : FloatArray of shape (5, 4)
        Derivative of the loads with respect to the tilts [N/rad, N m/rad].

    Notes
    -----
    Eq. D6.
    """
    loads, derivative = np.zeros(LOADS), np.zeros((LOADS, TILTS))
    least = np.inf
    for hub, driving in enumerate(port.driving):
        part = slice(2 * hub, 2 * hub + 2)
        tilt = tilts[part]
        size = max(hypot(*tilt), LEAST_TILT)
        now, further = _moments_and_limit(port, size), _moments_and_limit(port, size * (1 + STEP))
        slopes = (further - now) / (size * STEP)
        sleeve, by_sleeve = _polar(tilt, now, slopes, port.rotation * driving * port.torque / 2)
        loads[:2] += sleeve / port.length
        derivative[:2, part] += by_sleeve / port.length
        if hub == 0:
            loads[2:4], derivative[2:4, part] = _polar(tilt, now, slopes, -port.rotation * driving * port.torque / 2)
        if now[2] < least:
            least = now[2]
            loads[4], derivative[4] = port.inputs.thrust_fraction * least, 0.0
            derivative[4, part] = port.inputs.thrust_fraction * slopes[2] * tilt / size
    return loads, derivative


def _polar(tilt: FloatArray, moments: FloatArray, slopes: FloatArray, torque: float) -> tuple[FloatArray, FloatArray]:
    """Return the vector v = -a e + (b + torque delta) Z x e, and the derivative of v with respect to the tilt.

    The tilt has the size delta and the direction e; Z is the unit vector along the shaft. `moments` begins with a and
    b, and `slopes` begins with their derivatives with respect to delta. Below `LEAST_TILT`, a and b are proportional to
    delta.
    """
    size = hypot(*tilt)
    direction = tilt / size if size > 0.0 else np.array([1.0, 0.0])
    across = np.array([-direction[1], direction[0]])
    a, b = moments[:2] / max(size, LEAST_TILT)
    along = -slopes[0] * direction + (slopes[1] + torque) * across
    turning = -a * across - (b + torque) * direction
    loads = size * (-a * direction + (b + torque) * across)
    return loads, np.outer(along, direction) + np.outer(turning, across)


def _moments_and_limit(port: CouplingPort, tilt: float) -> FloatArray:
    """Return straightening moment and loss moment [N m] and thrust limit [N] of a hub.

    The loss moment has the sign of the rotation.
    """
    hub = hub_moments(port, tilt)
    return np.array([hub.straightening, port.rotation * hub.loss, hub.thrust_limit])
