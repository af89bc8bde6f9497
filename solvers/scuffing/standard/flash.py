"""Flash temperature method of ISO/TS 6336-20 (ISO/TR 13989-1)."""

from math import cos, sin

import numpy as np

from solvers.arrays import FloatArray
from solvers.gears.pair import PathOfContact
from solvers.scuffing.inputs import ScuffingTest, StandardEdition
from solvers.scuffing.load_factors.method_b import MM, STIFFNESS, UM, nominal_line_load, stiffness_of
from solvers.scuffing.mesh_results import iso_load_sharing
from solvers.scuffing.micropitting.standard import characteristic_points, has_relief
from solvers.scuffing.standard.mesh import StandardMesh
from solvers.scuffing.standard.results import FlashMethod, FlashPoint
from solvers.scuffing.thermal.practice import (
    FASTEST_PITCH_LINE,
    FLASH_SHARE,
    LEAST_LINE_LOAD,
    lubricant_factor,
    scuffing_temperature,
)

ROUGHNESS_EXPONENT: dict[StandardEdition, float] = {"2017": 0.25, "2000": 0.5}
STRETCH_POINTS = 101  # points of each stretch of the path, chosen; the mean is exact to 1e-4
ROUNDING = 1e-12
BESIDE = 1e-9  # share of the path by which a point is moved into the stretch with one pair in contact


def solve_flash(mesh: StandardMesh, edition: StandardEdition, test: ScuffingTest | None) -> FlashMethod | None:
    """Flash temperature method; None with relief, without a load sharing factor and next to a base circle."""
    path = mesh.path
    x = _stretches(path)
    places = characteristic_points(path)
    at = _inside(path, np.array([*places.values()]))
    shares, along = (iso_load_sharing(path, each, mesh.grade) for each in (at, x))
    ends = mesh.reduced_radius(np.array([0.0, path.length])) * MM
    if shares is None or along is None or has_relief(mesh.given) or np.any(ends < path.plane.least_radius):
        return None
    roughness = mesh.roughness ** ROUGHNESS_EXPONENT[edition]
    oil_factor = lubricant_factor(mesh.oil.viscosity * 1e-3, mesh.oil.kind)
    friction = mean_friction(mesh, oil_factor * roughness)
    relief = optimal_relief(mesh)
    approach = approach_factor(mesh, at, relief)
    at_points = flash_temperature(mesh, at, friction, shares, approach)
    on_path = flash_temperature(mesh, x, friction, along, approach_factor(mesh, x, relief))
    largest = float(max(on_path.max(), at_points.max()))
    mean = float(np.trapezoid(on_path, x) / path.length)
    oil = mesh.temperatures.oil
    bulk = oil + FLASH_SHARE * mesh.supply_factor * mean
    limit = mesh.temperatures.scuffing
    if test is not None:
        own = test.lubricant_factor
        limit = scuffing_temperature(test.fzg_stage, test.structure_factor, oil_factor if own is None else own)
    contact = bulk + largest
    return FlashMethod(
        friction_coefficient=friction,
        lubricant_factor=oil_factor,
        roughness_factor=roughness,
        thermo_elastic_factor=float(mesh.thermo_elastic_factor(mesh.pitch)),
        optimal_relief=relief * UM,
        mean_flash=mean,
        max_flash=largest,
        bulk=bulk,
        contact=contact,
        scuffing=limit,
        safety=None if limit is None or contact <= oil else (limit - oil) / (contact - oil),
        points=tuple(
            FlashPoint(name, float(path.profile_parameter(place)), *map(float, values))
            for (name, place), values in zip(places.items(), zip(shares, approach, at_points, strict=True), strict=True)
        ),
    )


def _inside(path: PathOfContact, x: FloatArray) -> FloatArray:
    """Return the points with B and D moved into single contact, to which they belong."""
    inner, outer, step = path.length - path.plane.base_pitch, path.plane.base_pitch, BESIDE * path.length
    return np.where(x == inner, x + step, np.where(x == outer, x - step, x)) if inner > 0.0 else x


def _stretches(path: PathOfContact) -> FloatArray:
    """Points of the path [m]; both sides of B and D, where the load of the standard jumps."""
    inner, outer, step = path.length - path.plane.base_pitch, path.plane.base_pitch, BESIDE * path.length
    bounds = [0.0, path.length]
    if 0.0 < inner < outer:
        bounds = [0.0, inner - step, inner + step, outer - step, outer + step, path.length]
    pieces = [np.linspace(*ends, STRETCH_POINTS) for ends in zip(bounds[::2], bounds[1::2], strict=True)]
    return np.concatenate(pieces)


def mean_friction(mesh: StandardMesh, factors: float) -> float:
    """Mean coefficient of friction 0.060 [w_Bt/(v_SigmaC rho_relC)]^0.2 X_L X_R (Eq. T6); `factors` is X_L X_R.

    w_Bt counts as at least 150 N/mm, the pitch-line velocity as at most 50 m/s.
    """
    speeds = 2 * min(mesh.velocity, FASTEST_PITCH_LINE) * sin(mesh.path.pair.working_pressure_angle)
    load = max(mesh.line_load, LEAST_LINE_LOAD)
    return float(0.060 * (load / (speeds * mesh.pitch_radius)) ** 0.2 * factors)


def optimal_relief(mesh: StandardMesh) -> float:
    """Optimal tip relief C_eff = K_A K_gamma F_t/(b cos alpha_t c_gamma) [um] (Eq. T7)."""
    stiffness = stiffness_of(mesh.given, mesh.path).mesh / STIFFNESS
    return nominal_line_load(mesh.given, mesh.path) / (cos(mesh.path.pair.transverse_pressure_angle) * stiffness)


def approach_factor(mesh: StandardMesh, x: FloatArray, optimal: float) -> FloatArray:
    """Approach factor of unmodified profiles, 1 + C_eff/50 [(x_C - x)/g_alpha]^3 before the pitch point (Eq. T8)."""
    before = np.maximum(mesh.pitch - x, 0.0) / mesh.path.length
    return np.asarray(1.0 + optimal / 50.0 * before**3)


def flash_temperature(
    mesh: StandardMesh, x: FloatArray, friction: float, share: FloatArray, approach: FloatArray
) -> FloatArray:
    """Flash temperature at x [m] from A [K] (Eq. T9).

    2.52 mu X_M/50 X_J (X_Gamma w_Bt)^0.75 |sqrt(rho_1 n_1/60) - sqrt(rho_2 n_2/60)|/rho_rel^0.25, n in 1/min.
    """
    speed = mesh.given.load.pinion_speed / (2 * np.pi)  # n_1/60
    first, second = mesh.radii(x)
    ratio = mesh.path.pair.wheel.teeth / mesh.path.pair.pinion.teeth
    one, other = np.sqrt(first * speed), np.sqrt(second * speed / ratio)
    rolling = np.abs(one - other)
    rolling[rolling < ROUNDING * one] = 0.0  # at C
    load = (share * mesh.line_load) ** 0.75
    heated = 2.52 * friction * mesh.thermo_elastic_factor(x) / 50.0 * approach * load
    return np.asarray(heated * rolling / mesh.reduced_radius(x) ** 0.25)
