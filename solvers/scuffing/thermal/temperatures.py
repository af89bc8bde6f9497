"""Values of a scuffing check that are estimated if they are not given.

These values are the coefficient of friction, the bulk temperature, the properties of the oil at the bulk temperature,
and the scuffing temperature. The bulk temperature depends on the friction. But the friction does not depend on the bulk
temperature, because the friction uses the viscosity at the oil temperature. No iteration is therefore needed. Only the
film uses the viscosity at the bulk temperature. If a heat balance is solved, this heat balance adapts the friction loss
to the temperature of the flanks, within its own iteration.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from solvers.errors import InvalidInput
from solvers.gears.pair import PathOfContact
from solvers.heat_balance import Heat, network_of
from solvers.lubricants import Lubricant
from solvers.notices import Notice, Rank
from solvers.oils import OilSheet, lubricant_at
from solvers.scuffing.inputs import ScuffingInputs, Temperatures
from solvers.scuffing.mesh_results import friction_loss
from solvers.scuffing.model import solve
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import BulkInForce
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.bulk import FLOODED_UP_TO, STARVED_FROM, BulkRule, balance_share, method_asked
from solvers.scuffing.thermal.flank import FlashMap, contact_at_points, map_flash, mean_flash
from solvers.scuffing.thermal.pair_heat import balance_inputs, pair_heat
from solvers.scuffing.thermal.practice import (
    TEST_TEMPERATURE,
    bulk_temperature,
    loss_friction,
    lubricant_factor,
    mean_friction,
    pitch_line_velocity,
    scuffing_temperature,
)

COLDEST_OIL, HOTTEST_OIL = 223.15, 573.15  # K, range of the reference temperature of an oil
STEEL_MODULI = (170e9, 240e9)  # Pa; cast iron and bronze have a lower modulus than this range, hard metal a higher one
MEAN_POINTS = 1001  # number of points for the mean flash temperature along the feature line


class InForce(NamedTuple):
    """Inputs and load distribution of a scuffing check, completed by the estimated values.

    `flash` is Blok's flash temperature over the flank, `rule` how the bulk temperature follows from estimate and heat
    balance, and `bulk` what ran. `heat` is the heat balance of the pair; None if none was solved.
    """

    inputs: ScuffingInputs
    distribution: LoadDistribution
    flash: FlashMap
    heat: Heat | None
    rule: BulkRule
    bulk: BulkInForce


def in_force(inputs: ScuffingInputs, distribution: LoadDistribution) -> InForce:
    """Estimate what is not given of friction, temperatures and oil, and insert it into inputs and load distribution.

    The heat balance of the pair is solved where it can affect the bulk temperature. The pair of a gear unit comes with
    the flanks of the unit's heat balance, if there is one.

    Raises the errors of `with_friction`, `pair_heat` and `with_temperatures`.
    """
    inputs, distribution = with_friction(inputs, distribution)
    flash = map_flash(inputs.distribution, distribution)
    rule = bulk_rule(inputs, distribution, flash)
    heat, temperatures, flanks = None, inputs.temperatures, inputs.temperatures.flanks
    if flanks is None and rule.takes_balance and inputs.known_oil is not None:
        heat = pair_heat(inputs, distribution, rule.estimate)
        flanks = heat.pinion.flank, heat.wheel.flank
    if flanks is not None and rule.method in {None, "heat_balance"}:
        surfaces = rule.surfaces(flanks)
        bulk = None if surfaces is None else sum(surfaces) / 2
        temperatures = replace(temperatures, bulk=bulk, flanks=surfaces)
    elif rule.method != "given":
        temperatures = replace(temperatures, bulk=rule.estimate)
    complete = with_temperatures(replace(inputs, temperatures=temperatures))
    return InForce(complete, distribution, flash, heat, rule, rule.in_force(flanks))


def check_limit(temperatures: Temperatures) -> None:
    """Raise InvalidInput `scuffing_temperature` if the scuffing temperature is not above the oil temperature."""
    if temperatures.scuffing is not None and temperatures.scuffing <= temperatures.oil:
        message = "the scuffing temperature must be above the oil temperature"
        raise InvalidInput("scuffing_temperature", message, "temperatures.scuffing")


def bulk_rule(inputs: ScuffingInputs, distribution: LoadDistribution, flash: FlashMap) -> BulkRule:
    """Return how the bulk temperature follows from the estimate and from a heat balance."""
    oil = inputs.known_oil
    method = method_asked(inputs.temperatures, inputs.cooling, has_oil=oil is not None)
    estimate = None if oil is None or method == "given" else estimated_bulk(inputs, distribution, flash)
    speed = pitch_line_velocity(inputs.distribution, distribution.path_of_contact)
    return BulkRule(method, estimate, balance_share(speed) if method is None else None)


def sized_flow(inputs: ScuffingInputs) -> float | None:
    """Oil flow to the gears that is sized where none is given [m^3/s]; None if a flow is given or no balance runs."""
    has_oil = inputs.known_oil is not None
    method = method_asked(inputs.temperatures, inputs.cooling, has_oil=has_oil)
    if inputs.cooling.gear_flow is not None or not has_oil or method not in {None, "heat_balance"}:
        return None
    rubbing, distribution = with_friction(inputs, solve(inputs.distribution))
    return network_of(balance_inputs(rubbing, distribution)).spray.flow


def with_friction(inputs: ScuffingInputs, distribution: LoadDistribution) -> tuple[ScuffingInputs, LoadDistribution]:
    """Return the inputs with a coefficient of friction, and the load distribution with the friction loss.

    The flash temperature is computed with the coefficient in the returned inputs.

    If the coefficient of friction is given, it is used for the flash temperature and for the losses. If it is not
    given, two coefficients are estimated. The coefficient for the flash temperature is that of ISO/TS 6336-20, which is
    on the safe side for scuffing. The coefficient for the losses is Schlenk's, which is a mean value for the
    efficiency. Both are multiplied by `friction_factor`. If the oil, the load or the speed is missing, both estimates
    are None.
    """
    if inputs.friction == "given":
        return inputs, distribution
    given, path, oil = inputs.distribution, distribution.path_of_contact, inputs.known_oil
    of_flash = of_losses = None
    if oil is not None and distribution.balance.force > 0.0 and given.load.pinion_speed > 0.0:
        face_load_factor = distribution.load.face_load_factor or 1.0
        lubricant = lubricant_at(oil, inputs.temperatures.oil)
        viscosity = lubricant.viscosity_at(0.0, inputs.temperatures.oil)
        factor, by_oil = inputs.friction_factor, lubricant_factor(viscosity, lubricant.kind)
        of_flash = factor * mean_friction(given, path, by_oil, face_load_factor)
        of_losses = factor * loss_friction(given, path, viscosity, lubricant.kind)
    loss = friction_loss(path, distribution.balance, given.load, of_losses)
    rubbing = replace(inputs, distribution=replace(given, friction_coefficient=of_flash))
    return rubbing, replace(distribution, friction_loss=loss)


def with_temperatures(inputs: ScuffingInputs) -> ScuffingInputs:
    """Return the inputs with the scuffing temperature, and with the lubricant at the bulk temperature.

    Without oil or bulk temperature, the lubricant is None. Raises InvalidInput: `missing_bulk` if the method needs a
    bulk temperature that is not given; `oil_temperature` if the bulk temperature is outside the range of an oil that is
    given by its data sheet; `scuffing_temperature` if the scuffing temperature is not above the oil temperature.
    """
    temperatures, oil = inputs.temperatures, inputs.known_oil
    if oil is None:
        return replace(inputs, temperatures=_of_dry_pair(temperatures))
    if temperatures.scuffing_test is not None:
        test = temperatures.scuffing_test
        factor = _oil_factor(oil, TEST_TEMPERATURE) if test.lubricant_factor is None else test.lubricant_factor
        limit = scuffing_temperature(test.fzg_stage, test.structure_factor, factor)
        test = replace(test, lubricant_factor=factor)
        temperatures = replace(temperatures, scuffing=limit, scuffing_test=test)
    check_limit(temperatures)
    bulk = temperatures.bulk
    if bulk is None and temperatures.bulk_method in {"given", "heat_balance"}:
        message = f"the method '{temperatures.bulk_method}' needs a bulk temperature; give a bulk temperature"
        raise InvalidInput("missing_bulk", message, "temperatures.bulk")
    if bulk is None:
        return replace(inputs, temperatures=temperatures, oil=oil, lubricant=None)
    if isinstance(oil, OilSheet) and not COLDEST_OIL <= bulk <= HOTTEST_OIL:
        raise _oil_out_of_range(inputs, bulk)
    return replace(inputs, temperatures=temperatures, lubricant=lubricant_at(oil, bulk))


def _of_dry_pair(temperatures: Temperatures) -> Temperatures:
    """Return the temperatures of a dry or greased pair: a test of its lubricant counts with the X_L that is given."""
    test = temperatures.scuffing_test
    if temperatures.bulk is None:
        return temperatures
    if test is not None and test.lubricant_factor is not None:
        limit = scuffing_temperature(test.fzg_stage, test.structure_factor, test.lubricant_factor)
        temperatures = replace(temperatures, scuffing=limit)
    check_limit(temperatures)
    return temperatures


def _oil_out_of_range(inputs: ScuffingInputs, bulk: float) -> InvalidInput:
    """Say what to change if the oil's data do not hold at the bulk temperature [K]."""
    flow = inputs.cooling.gear_flow
    if inputs.temperatures.flanks is not None and flow is not None:
        message = (
            f"the flanks would reach {bulk - 273.15:.4g} °C with {flow * 6e4:.4g} l/min of oil; is the oil flow "
            "really in l/min?"
        )
        return InvalidInput("oil_temperature", message, "cooling.gear_flow")
    message = (
        f"the oil would enter the contact at {bulk - 273.15:.4g} °C, but the grade and the data sheet are not valid at "
        "this temperature; reduce the load, give another bulk temperature, or give the viscosity of the oil"
    )
    return InvalidInput("oil_temperature", message, "temperatures.bulk_method")


def oil_notices(inputs: ScuffingInputs, path: PathOfContact, bulk: BulkInForce) -> Iterator[Notice]:
    """Warn of a missing oil or bulk temperature, of doubtful estimates, and of unused inputs of the cooling."""
    if inputs.known_oil is None:
        what = (
            "film, contact temperature and safety are therefore not stated"
            if inputs.temperatures.bulk is None
            else "the pair is taken as dry or greased, with the given temperatures and friction and without a film"
        )
        message = f"no oil is given (iso_vg, kinematic_viscosity_40 or viscosity_pa_s); {what}"
        yield Notice("no_oil", message, "lubricant", rank="note")
        return
    yield from _material_notices(inputs, bulk)
    if inputs.temperatures.bulk is None:
        message = (
            "the bulk temperature cannot be estimated, because the path of contact reaches a base circle, where the "
            "flash temperature is not defined. Film, contact temperature and safety are not stated; give the bulk "
            "temperature"
        )
        yield Notice("no_bulk_estimate", message, "temperatures.bulk_method", rank="invalid")
        return
    speed = pitch_line_velocity(inputs.distribution, path)
    if bulk.bulk_method == "estimated" and bulk.balance_share is None and speed > FLOODED_UP_TO:
        message = (
            f"estimated bulk temperature is a lower bound: it holds for flooded flanks, and at {speed:.4g} m/s (above "
            f"{FLOODED_UP_TO:g} m/s) jets or a sump wet them less. The real contact temperature is higher and the real "
            "safety lower than stated"
        )
        rank: Rank = "doubtful" if speed > STARVED_FROM else "note"
        yield Notice("bulk_lower_bound", message, "temperatures.bulk_method", rank=rank)
    if bulk.bulk_balance is None and inputs.cooling.states_anything:
        why = f"the bulk temperature is {bulk.bulk_method}"
        if bulk.balance_share == 0.0:
            why = (
                f"up to {FLOODED_UP_TO:g} m/s the flanks are taken as flooded, and the bulk temperature is estimated; "
                "set bulk_method to heat_balance to use them"
            )
        message = f"the inputs of the cooling are not used: {why}"
        yield Notice("cooling_not_used", message, "temperatures.bulk_method", rank="note")


def _material_notices(inputs: ScuffingInputs, bulk: BulkInForce) -> Iterator[Notice]:
    """Warn if a gear is not made of steel and a value or a safety of the pair follows from a law for steel gears."""
    estimates = {
        "the coefficient of friction": inputs.friction == "iso_tr_13989",
        "the bulk temperature": bulk.bulk_method in {"estimated", "between"},
        "the scuffing temperature": inputs.temperatures.scuffing_test is not None,
    }
    test = inputs.micropitting
    safe_film = test is not None and (test.permissible_ratio is not None or test.failure_load_stage is not None)
    estimated = [name for name, is_estimated in estimates.items() if is_estimated]
    laws = [f"ISO/TS 6336-20 estimates {' and '.join(estimated)}"] if estimated else []
    laws += ["ISO/TR 15144-1 states the safety against micropitting"] if safe_film else []
    given, (least, largest) = inputs.distribution, STEEL_MODULI
    for name, solid in (("pinion", given.pinion_material), ("wheel", given.wheel_material)):
        if laws and not least <= solid.youngs_modulus <= largest:
            message = (
                f"the {name} is not made of steel (Young's modulus {solid.youngs_modulus / 1e9:.4g} GPa), but "
                f"{' and '.join(laws)} for steel gears; give measured values"
            )
            yield Notice("made_for_steel", message, f"materials.{name}.youngs_modulus")


def _oil_factor(oil: OilSheet | Lubricant, temperature: float) -> float:
    """Return the lubricant factor X_L of the oil at a temperature [K]."""
    lubricant = lubricant_at(oil, temperature)
    return lubricant_factor(lubricant.viscosity_at(0.0, temperature), lubricant.kind)


def estimated_bulk(inputs: ScuffingInputs, distribution: LoadDistribution, flash: FlashMap) -> float | None:
    """Estimate the bulk temperature [K] from the mean flash temperature; return None if the mean is not defined.

    If the whole flank is checked, the mean over the flank is used. This mean is the same for a pair and its mirror
    image. If only the feature line is checked, the mean along the feature line is used. That mean may differ between a
    pair and its mirror image.
    """
    given = inputs.distribution
    if inputs.line == "flank":
        mean = mean_flash(flash)
    else:
        psi, plane = np.linspace(0.0, 1.0, MEAN_POINTS), distribution.path_of_contact.plane
        along_line = contact_at_points(given, distribution, psi * plane.path_length, psi * plane.face_width)
        mean = None if np.any(along_line.undefined) else float(np.trapezoid(blok_flash(given, along_line), psi))
    return None if mean is None else bulk_temperature(inputs.temperatures.oil, inputs.temperatures.oil_supply, mean)
