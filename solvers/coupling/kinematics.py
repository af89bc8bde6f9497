"""Motion of the teeth of a tilted hub in the sleeve over one revolution.

In the frame used here, z is along the axis of the sleeve and y is the tilt axis. The tooth angle phi is measured from
x. A tooth is in a tilt position at 90 and 270 degrees, and in a pivot position at 0 and 180 degrees. To first order in
the misalignment every quantity is a harmonic of phi. A mesh is therefore described by the coefficients of sin(phi), of
cos(phi) and of their products. The two kinematic models, tangential and spatial, differ only in these coefficients.
"""

from dataclasses import dataclass
from functools import cache, lru_cache
from math import asin, atan2, ceil, hypot, pi, sin, tan

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.coupling.inputs import Coupling, KinematicModel, Operation
from solvers.coupling.results import Geometry, KinematicCurves, Kinematics

_LEAST_ROTOR_POSITIONS = 208  # rotor positions per revolution: 4 per pitch for the paper's 52 teeth
_CURVE_ANGLE = frozen(np.linspace(0.0, 2.0 * pi, 181))  # curves in steps of 2°
# Number of parts of a pitch; each part has a Gauss rule of _PITCH_NODES points. If the number of teeth is odd, half a
# turn shifts the teeth by half a pitch. An even number of parts is chosen, so that this shift maps parts onto parts.
_PITCH_PARTS = 4
_PITCH_NODES = 8  # chosen: 32 angles per pitch; the rule is exact for polynomials up to degree 15
_gauss_rule = cache(np.polynomial.legendre.leggauss)


def pitch_radius(coupling: Coupling) -> float:
    """Return the pitch radius r_o = m z/2 [m]."""
    return coupling.module * coupling.teeth / 2.0


def tooth_geometry(coupling: Coupling) -> Geometry:
    """Pitch, crowning and flank radii, and the drop of the crowning c_b = (b/2)^2/(2 R_t) [m] (Eq. C1, C33).

    The cutter centre moves on a circle of radius r_b: at the distance zeta from the middle it is fed by zeta^2/(2 r_b),
    so the flank radius is r_b/tan(alpha) in the tangential plane and r_b/sin(alpha), Pahl's R_e, in the plane of
    action.
    """
    radius = pitch_radius(coupling)
    crowning_radius = coupling.crowning_ratio * radius
    tangential = crowning_radius / tan(coupling.pressure_angle)
    return Geometry(
        pitch_radius=radius,
        crowning_radius=crowning_radius,
        crowning_drop=(coupling.face_width / 2.0) ** 2 / (2.0 * tangential),
        tangential_flank_radius=tangential,
        normal_flank_radius=crowning_radius / sin(coupling.pressure_angle),
    )


@dataclass(frozen=True, slots=True)
class ToothPositions:
    """Sine and cosine of tooth angles, usually with one row per rotor angle and one column per tooth."""

    sine: FloatArray
    cosine: FloatArray


@dataclass(frozen=True, slots=True)
class MeshMotion:
    """Motion of one mesh; `side` is +1 if the hub drives the sleeve, -1 if the sleeve drives the hub.

    Here s is sin(phi) and c is cos(phi). The sliding velocity is `sliding` s [m/s], the contact position on the hub
    flank is `travel_sin` s + `travel_cos` c [m], and the tangential displacement is `tilt` s^2 + `mixed` s c + `pivot`
    c^2 [m].
    """

    side: int
    pressure_angle: float
    speed: float
    sliding: float
    travel_sin: float
    travel_cos: float
    tilt: float
    mixed: float
    pivot: float


def positions_per_pitch(teeth: int) -> int:
    """Return the smallest number of rotor angles per tooth pitch that gives at least 208 angles per revolution."""
    return ceil(_LEAST_ROTOR_POSITIONS / teeth)


def revolution(teeth: int, refinement: int = 1) -> FloatArray:
    """Rotor angles [rad] of one revolution from zero; a pitch is a whole number of steps, times `refinement`."""
    return np.linspace(0.0, 2.0 * pi, refinement * positions_per_pitch(teeth) * teeth, endpoint=False)


def tooth_positions(rotor_angles: FloatArray, teeth: int) -> ToothPositions:
    """Compute sine and cosine of phi_i = 2 pi i / teeth + rotor angle, both in the shape (rotor angles, teeth)."""
    pitch_angles = 2.0 * np.pi / teeth * np.arange(teeth)
    sin_pitch, cos_pitch = np.sin(pitch_angles), np.cos(pitch_angles)
    sin_rotor, cos_rotor = np.sin(rotor_angles)[:, None], np.cos(rotor_angles)[:, None]
    sine, cosine = sin_rotor * cos_pitch, cos_rotor * cos_pitch
    sine += cos_rotor * sin_pitch
    cosine -= sin_rotor * sin_pitch
    return ToothPositions(sine, cosine)


def mesh_motion(
    coupling: Coupling, geometry: Geometry, operation: Operation, model: KinematicModel, *, side: int = 1, tilt: int = 1
) -> MeshMotion:
    """Harmonic coefficients of one mesh; `side` is +1 if the hub drives the sleeve, -1 otherwise (Eqs. C3, C5).

    `spatial`: s_1 = R_e delta n_x and f_t = r_o delta^2/(2 cos alpha) sin(phi - alpha) [eps sin(phi - alpha)/sin alpha
    + cos phi], with pi - phi for phi if the sleeve drives; exact to leading order in delta, confirmed with exact
    involutes. `tangential`, the paper's words: tilt alone, s_1 = -side R_t delta sin phi and f_t = R_t delta^2/2 sin^2
    phi.
    """
    delta = tilt * operation.misalignment
    alpha, ratio, radius = coupling.pressure_angle, coupling.crowning_ratio, geometry.pitch_radius
    pivoting = model == "spatial"
    pivot_scale = radius * delta**2 / 2.0 * pivoting
    return MeshMotion(
        side=side,
        pressure_angle=alpha,
        speed=operation.speed,
        sliding=delta * operation.speed * radius,
        travel_sin=-side * geometry.tangential_flank_radius * delta,
        travel_cos=geometry.crowning_radius * delta * pivoting,
        tilt=geometry.tangential_flank_radius * delta**2 / 2.0,
        mixed=side * pivot_scale * (1.0 - 2.0 * ratio),
        pivot=pivot_scale * (ratio - 1.0) * tan(alpha),
    )


def sliding_velocity(mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Compute the axial sliding velocity of the hub relative to the sleeve [m/s]. Fig. 12; Eq. C2."""
    return mesh.sliding * teeth.sine


def relative_velocity(mesh: MeshMotion, teeth: ToothPositions, axial_velocity: float) -> FloatArray:
    """Return v_r = v_ax + v_G [m/s]; the sign of this velocity is the direction of friction (Fig. 14)."""
    return axial_velocity + sliding_velocity(mesh, teeth)


def contact_position(mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Compute the axial position of the contact on the hub flank [m] (Eq. C3)."""
    return mesh.travel_sin * teeth.sine + mesh.travel_cos * teeth.cosine


def hydrodynamic_velocity(mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Hydrodynamic velocity at each tooth [m/s] (Eq. C6).

    The contact moves with s_1' on the hub flank and s_1' + v_G on the sleeve flank; the constant 2.447 of the load
    capacity takes the sum of both, not their mean.
    """
    contact_velocity = mesh.speed * (mesh.travel_sin * teeth.cosine - mesh.travel_cos * teeth.sine)
    return np.abs(2.0 * contact_velocity + mesh.sliding * teeth.sine)


def tangential_displacement(mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Compute the tangential displacement of the hub tooth against the sleeve tooth [m] (Eq. C5)."""
    s, c = teeth.sine, teeth.cosine
    if mesh.mixed == 0.0 and mesh.pivot == 0.0:
        return mesh.tilt * (s * s)
    return mesh.tilt * (s * s) + mesh.mixed * (s * c) + mesh.pivot * (c * c)


def max_contact_travel(mesh: MeshMotion) -> float:
    """Largest contact travel s_1max [m]: R_t |delta| with tangential kinematics, R_e |delta| with spatial."""
    return hypot(mesh.travel_sin, mesh.travel_cos)


def max_hydrodynamic_velocity(mesh: MeshMotion) -> float:
    """Largest hydrodynamic velocity v_Hmax of a revolution, the amplitude of its one harmonic [m/s] (Eq. C6)."""
    return hypot(2.0 * mesh.speed * mesh.travel_sin, mesh.sliding - 2.0 * mesh.speed * mesh.travel_cos)


def displacement_peak_to_peak(mesh: MeshMotion) -> float:
    """Return the difference between the largest and the smallest displacement f_t [m]."""
    return hypot(mesh.tilt - mesh.pivot, mesh.mixed)


def displacement_peak(mesh: MeshMotion) -> float:
    """Tooth angle of the largest displacement f_t [rad]: 90 degrees with tangential kinematics, not with spatial."""
    return pi / 2.0 + 0.5 * atan2(-mesh.mixed, mesh.tilt - mesh.pivot)


def kinematics(mesh: MeshMotion) -> Kinematics:
    """Compute the motion of a tooth over one revolution: largest values, and curves over the tooth angle (Fig. 6)."""
    teeth = ToothPositions(sine=np.sin(_CURVE_ANGLE), cosine=np.cos(_CURVE_ANGLE))
    return Kinematics(
        max_sliding_velocity=abs(mesh.sliding),
        max_contact_travel=max_contact_travel(mesh),
        max_hydrodynamic_velocity=max_hydrodynamic_velocity(mesh),
        tangential_displacement_peak_to_peak=displacement_peak_to_peak(mesh),
        curves=KinematicCurves(
            angle=_CURVE_ANGLE,
            sliding_velocity=frozen(sliding_velocity(mesh, teeth)),
            hydrodynamic_velocity=frozen(hydrodynamic_velocity(mesh, teeth)),
            tangential_displacement=frozen(tangential_displacement(mesh, teeth)),
            contact_position=frozen(contact_position(mesh, teeth)),
        ),
    )


def flank_normals(mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Normals of the loaded flanks over cos(alpha): n = side cos(alpha) e_t + sin(alpha) e_r [-] (Eq. C4).

    The tangential tooth force times n/cos(alpha) is the tooth's lateral force on the sleeve; its radial part points
    out.
    """
    radial = tan(mesh.pressure_angle)
    return np.stack(
        (radial * teeth.cosine - mesh.side * teeth.sine, radial * teeth.sine + mesh.side * teeth.cosine), axis=1
    )


@dataclass(frozen=True, slots=True)
class RotorSamples:
    """Tooth positions `teeth` (rotor angles, teeth) for means over the rotor angle, and weights whose sum is one."""

    weight: FloatArray
    teeth: ToothPositions


def friction_reversals(mesh: MeshMotion, axial_velocity: float) -> list[float]:
    """Return the tooth angles [rad] at which the sliding velocity is 0, v or -v, where v is the axial velocity."""
    angles = [0.0, pi]
    if abs(axial_velocity) < abs(mesh.sliding):
        reversal = asin(axial_velocity / mesh.sliding)
        angles += [reversal, pi - reversal, -reversal, pi + reversal]
    return angles


def rotor_samples(coupling: Coupling, mesh: MeshMotion, axial_velocity: float) -> RotorSamples:
    """Gauss points and weights for means over the rotor angle, between the jumps of friction.

    As accurate as a midpoint rule with several hundred points.
    """
    uneven = coupling.pitch_errors is not None
    return _samples(coupling.teeth, uneven, tuple(friction_reversals(mesh, axial_velocity)))


@lru_cache(maxsize=4)
def _samples(teeth: int, uneven: bool, reversals: tuple[float, ...]) -> RotorSamples:
    """Gauss points and weights of `rotor_samples`, cached; friction changes direction at `reversals`."""
    pitch = 2.0 * pi / teeth
    breaks = [angle % pitch for angle in reversals]
    if uneven:
        nodes, weights = _gauss_rule(positions_per_pitch(teeth))
        turns = teeth
    else:
        breaks += [pitch * part / _PITCH_PARTS for part in range(_PITCH_PARTS)]
        nodes, weights = _gauss_rule(_PITCH_NODES)
        turns = 1
    edges = np.array(sorted({0.0, pitch, *breaks}))
    middle, half = (edges[1:] + edges[:-1]) / 2.0, (edges[1:] - edges[:-1]) / 2.0
    keep = half > 1e-12 * pitch
    one_pitch = (middle[keep, None] + half[keep, None] * nodes).ravel()
    weight = (half[keep, None] * weights).ravel() / (pitch * turns)
    angles = (one_pitch + pitch * np.arange(turns)[:, None]).ravel()
    positions = tooth_positions(angles, teeth)
    return RotorSamples(
        frozen(np.tile(weight, turns)), ToothPositions(frozen(positions.sine), frozen(positions.cosine))
    )
