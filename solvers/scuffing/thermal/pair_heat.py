"""The heat balance of a loaded pair: losses of the mesh, heat taken up by the oil, and temperatures of the flanks."""

import numpy as np

from solvers import heat_balance
from solvers.arrays import FloatArray
from solvers.gears.pair import GearPair, PathOfContact
from solvers.heat_balance import GearGeometry, Heat, HeatBalanceInputs, MeshHeat, cooling_oil, share_to_pinion
from solvers.heat_balance.losses import VISCOSITY_EXPONENT
from solvers.materials import Solid
from solvers.oils import lubricant_at
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs
from solvers.scuffing.mesh_results import friction_loss
from solvers.scuffing.results import FrictionLoss, LoadDistribution
from solvers.scuffing.thermal.practice import loss_friction

STEEL_EXPANSION = 12e-6  # 1/K, thermal expansion of gears and casing


def pair_heat(inputs: ScuffingInputs, distribution: LoadDistribution, estimate: float | None) -> Heat:
    """Solve the heat balance of a pair.

    `estimate`: bulk temperature by ISO/TS 6336-20 [K]; the result only repeats this temperature for comparison. Raises
    InvalidInput: `exclusive` if two given values exclude each other, `measured_unreachable` if the model cannot reach a
    measured temperature. Raises NoSolution: `heat_balance` if the iteration does not converge, `thermal_runaway` if the
    equilibrium is unstable.
    """
    heat = heat_balance.solve(balance_inputs(inputs, distribution, estimate))
    return with_backlash_loss(heat, distribution.path_of_contact.pair)


def balance_inputs(
    inputs: ScuffingInputs, distribution: LoadDistribution, estimate: float | None = None
) -> HeatBalanceInputs:
    """Return the inputs of the heat balance of a pair; the parameters are the same as in `pair_heat`."""
    oil, path = inputs.known_oil, distribution.path_of_contact
    assert oil is not None
    return HeatBalanceInputs(
        cooling=inputs.cooling,
        oil=cooling_oil(oil, inputs.temperatures.oil),
        gears=gear_geometries(inputs.distribution, path),
        mesh=mesh_heat(inputs, distribution),
        centre_distance=path.pair.centre_distance,
        iso_tr_13989_bulk=estimate,
    )


def with_backlash_loss(heat: Heat, pair: GearPair) -> Heat:
    """Add the decrease of the backlash by thermal expansion to the results of a heat balance.

    The backlash decreases because the gears are hotter than the casing. Gears and casing expand like steel.
    """
    radii = (pair.pinion_working_radius, pair.wheel_working_radius)
    return heat_balance.backlash_loss(heat, radii, pair.working_pressure_angle, STEEL_EXPANSION)


def gear_geometries(given: LoadDistributionInputs, path: PathOfContact) -> tuple[GearGeometry, GearGeometry]:
    """Return the geometry of both gears for the heat balance, without their shafts."""
    pair, speed = path.pair, abs(given.load.pinion_speed)
    speeds = (speed, speed * pair.pinion.teeth / pair.wheel.teeth)
    pinion, wheel = (
        GearGeometry(
            teeth=gear.teeth,
            face_width=given.gears.toothed_width,
            gap_width=given.gears.gap_width or 0.0,
            module=given.gears.normal_module,
            reference_radius=gear.reference_radius,
            tip_radius=gear.tip_radius,
            speed=own_speed,
            conductivity=material.thermal_conductivity,
        )
        for gear, own_speed, material in zip(
            (pair.pinion, pair.wheel), speeds, (given.pinion_material, given.wheel_material), strict=True
        )
    )
    return pinion, wheel


def mesh_heat(inputs: ScuffingInputs, distribution: LoadDistribution) -> MeshHeat:
    """Return the friction of the mesh in the form that the heat balance uses.

    In the heat balance, the friction follows the viscosity of the oil, and therefore the temperature. A coefficient of
    friction that the user gives is constant, and does not size the oil flow. Of double-helical gears both helices count
    as loaded like this one: no heat passes through the gap, which is the upper bound for the hotter helix.
    """
    helices = inputs.distribution.gears.helices
    power, by_formula = helices * (distribution.friction_loss.power or 0.0), None
    if inputs.friction == "given" and power > 0.0:
        by_formula = helices * (friction_by_formula(inputs, distribution).power or 0.0)
    return MeshHeat(
        power=power,
        temperature=inputs.temperatures.oil,
        share_to_pinion=friction_to_pinion(inputs.distribution, distribution),
        viscosity_exponent=0.0 if inputs.friction == "given" else VISCOSITY_EXPONENT,
        by_formula=by_formula,
    )


def friction_by_formula(inputs: ScuffingInputs, distribution: LoadDistribution) -> FrictionLoss:
    """Friction loss with Schlenk's coefficient at the oil temperature; the oil must be known."""
    given, path, temperature = inputs.distribution, distribution.path_of_contact, inputs.temperatures.oil
    assert inputs.known_oil is not None
    lubricant = lubricant_at(inputs.known_oil, temperature)
    coefficient = loss_friction(given, path, lubricant.viscosity_at(0.0, temperature), lubricant.kind)
    return friction_loss(path, distribution.balance, given.load, coefficient)


def friction_to_pinion(given: LoadDistributionInputs, distribution: LoadDistribution) -> float:
    """Compute the pinion's share of the frictional heat of a mesh [-] (Eq. H7).

    At every place along the path the frictional heat is summed over the face.
    """
    path, flank = distribution.path_of_contact, distribution.flank
    along = flank.profile_fraction * path.plane.path_length
    speed_1, speed_2 = _surface_speeds(given, path, along)
    load = np.trapezoid(flank.line_load, flank.face_fraction, axis=1)
    ratio = _effusivity(given.wheel_material) / _effusivity(given.pinion_material)
    return share_to_pinion(load * np.abs(speed_1 - speed_2), speed_1, speed_2, along, ratio)


def _surface_speeds(
    given: LoadDistributionInputs, path: PathOfContact, along: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the speeds of both surfaces [m/s] at distances from A [m]."""
    pair, roll = path.pair, path.start + along
    speed = abs(given.load.pinion_speed)
    wheel_roll = np.maximum(pair.line_of_action - roll, 0.0)
    return speed * np.maximum(roll, 0.0), speed * pair.pinion.teeth / pair.wheel.teeth * wheel_roll


def _effusivity(solid: Solid) -> float:
    return float(np.sqrt(solid.thermal_conductivity * solid.density * solid.specific_heat))
