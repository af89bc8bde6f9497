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
from solvers.heat_balance import Heat
from solvers.heat_balance.inputs import Cooling
from solvers.lubricants import Lubricant
from solvers.notices import Notice
from solvers.oils import OilSheet, lubricant_at
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.mesh_results import friction_loss
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.flank import FlashMap, contact_at_points, map_flash, mean_flash
from solvers.scuffing.thermal.pair_heat import pair_heat, with_flanks
from solvers.scuffing.thermal.practice import (
    FLOODED_UP_TO,
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

    `flash` is Blok's flash temperature over the flank. `heat` is the heat balance of the pair; None if no heat balance
    was solved.
    """

    inputs: ScuffingInputs
    distribution: LoadDistribution
    flash: FlashMap
    heat: Heat | None


def in_force(inputs: ScuffingInputs, distribution: LoadDistribution) -> InForce:
    """Estimate values that are not given, and insert these values into the inputs and the load distribution.

    These values concern the friction, the temperatures and the oil. If `bulk_method` is "heat_balance", the heat
    balance of the pair is solved, except in two cases:
    - No oil is given. The heat balance cannot be solved without an oil.
    - The flank temperatures are given. This is the case if the pair belongs to a gear unit, because the heat balance of
      the unit is solved before the pair is checked.

    Raises the errors of `with_friction`, `pair_heat` and `with_temperatures`.
    """
    inputs, distribution = with_friction(inputs, distribution)
    flash = map_flash(inputs.distribution, distribution)
    heat, temperatures = None, inputs.temperatures
    is_unbalanced = temperatures.bulk_method == "heat_balance" and temperatures.flanks is None
    if is_unbalanced and inputs.known_oil is not None:
        heat = pair_heat(inputs, distribution, estimated_bulk(inputs, distribution, flash))
        inputs = with_flanks(inputs, heat)
    return InForce(with_temperatures(inputs, distribution, flash), distribution, flash, heat)


def with_friction(inputs: ScuffingInputs, distribution: LoadDistribution) -> tuple[ScuffingInputs, LoadDistribution]:
    """Return the inputs with a coefficient of friction, and the load distribution with the friction loss.

    The flash temperature is computed with the coefficient in the returned inputs.

    If the coefficient of friction is given, it is used for the flash temperature and for the losses. If it is not
    given, two coefficients are estimated. The coefficient for the flash temperature is that of ISO/TR 13989-1, which is
    on the safe side for scuffing. The coefficient for the losses is Schlenk's, which is a mean value for the
    efficiency. If the oil, the load or the speed is missing, both estimates are None.
    """
    if inputs.friction == "given":
        return inputs, distribution
    given, path, oil = inputs.distribution, distribution.path_of_contact, inputs.known_oil
    of_flash = of_losses = None
    if oil is not None and distribution.balance.force > 0.0 and given.load.pinion_speed > 0.0:
        face_load_factor = distribution.load.face_load_factor or 1.0
        lubricant = lubricant_at(oil, inputs.temperatures.oil)
        viscosity = lubricant.viscosity_at(0.0, inputs.temperatures.oil)
        of_flash = mean_friction(given, path, lubricant_factor(viscosity, lubricant.kind), face_load_factor)
        of_losses = loss_friction(given, path, viscosity, lubricant.kind)
    loss = friction_loss(path, distribution.balance, given.load, of_losses)
    rubbing = replace(inputs, distribution=replace(given, friction_coefficient=of_flash))
    return rubbing, replace(distribution, friction_loss=loss)


def with_temperatures(inputs: ScuffingInputs, distribution: LoadDistribution, flash: FlashMap) -> ScuffingInputs:
    """Return the inputs with the bulk temperature, the scuffing temperature, and the lubricant at the bulk temperature.

    If no oil is given, the bulk temperature and the lubricant are None. If `bulk_method` is "estimated", the bulk
    temperature is computed from the mean flash temperature. This mean is not defined if the flash temperature is NaN at
    some point; in this case the bulk temperature and the lubricant are also None.

    Raises
    ------
    InvalidInput
        `missing_bulk` if the bulk temperature is neither given nor estimated; `oil_temperature` if the oil is given by
        its data sheet and the bulk temperature is outside the range of such oils; `scuffing_temperature` if the
        scuffing temperature is not above the oil temperature.
    """
    temperatures, oil = inputs.temperatures, inputs.known_oil
    if oil is None:
        return replace(inputs, temperatures=replace(temperatures, bulk=None))
    if temperatures.bulk_method == "estimated":
        temperatures = replace(temperatures, bulk=estimated_bulk(inputs, distribution, flash))
    if temperatures.scuffing_test is not None:
        test = temperatures.scuffing_test
        factor = _oil_factor(oil, TEST_TEMPERATURE) if test.lubricant_factor is None else test.lubricant_factor
        limit = scuffing_temperature(test.fzg_stage, test.structure_factor, factor)
        test = replace(test, lubricant_factor=factor)
        temperatures = replace(temperatures, scuffing=limit, scuffing_test=test)
    if temperatures.scuffing is not None and temperatures.scuffing <= temperatures.oil:
        message = "the scuffing temperature must be above the oil temperature"
        raise InvalidInput("scuffing_temperature", message, "temperatures.scuffing")
    bulk = temperatures.bulk
    if bulk is None and temperatures.bulk_method != "estimated":
        message = f"the method '{temperatures.bulk_method}' needs a bulk temperature; give a bulk temperature"
        raise InvalidInput("missing_bulk", message, "temperatures.bulk")
    if bulk is None:
        return replace(inputs, temperatures=temperatures, oil=oil, lubricant=None)
    if isinstance(oil, OilSheet) and not COLDEST_OIL <= bulk <= HOTTEST_OIL:
        message = (
            f"the oil would enter the contact at {bulk - 273.15:.4g} °C, but the grade and the data sheet are not "
            "valid at this temperature; reduce the load, give another bulk temperature, or give the viscosity of the "
            "oil"
        )
        raise InvalidInput("oil_temperature", message, "temperatures.bulk_method")
    return replace(inputs, temperatures=temperatures, lubricant=lubricant_at(oil, bulk))


def oil_notices(inputs: ScuffingInputs, path: PathOfContact) -> Iterator[Notice]:
    """Warn of a missing oil or bulk temperature, of doubtful estimates, and of unused inputs of the cooling."""
    if inputs.known_oil is None:
        message = (
            "no oil is given (iso_vg, kinematic_viscosity_40 or viscosity_pa_s); film, contact temperature and safety "
            "are therefore not stated"
        )
        yield Notice("no_oil", message, "lubricant", rank="note")
        return
    yield from _material_notices(inputs)
    if inputs.temperatures.bulk is None:
        message = (
            "the bulk temperature cannot be estimated, because the path of contact reaches a base circle, where the "
            "flash temperature is not defined. Film, contact temperature and safety are not stated; give the bulk "
            "temperature"
        )
        yield Notice("no_bulk_estimate", message, "temperatures.bulk_method", rank="invalid")
        return
    speed = pitch_line_velocity(inputs.distribution, path)
    if inputs.temperatures.bulk_method == "estimated" and speed > FLOODED_UP_TO:
        message = (
            f"the bulk temperature is estimated for flooded flanks. At {speed:.4g} m/s (above 60 m/s) this estimate "
            "is only a lower bound; the real contact temperature is higher and the real safety is lower than stated"
        )
        yield Notice("bulk_lower_bound", message, "temperatures.bulk_method")
    if inputs.temperatures.bulk_method != "heat_balance" and inputs.cooling != Cooling():
        message = (
            "the inputs of the cooling are used only if bulk_method is 'heat_balance'; here bulk_method is "
            f"'{inputs.temperatures.bulk_method}'"
        )
        yield Notice("cooling_not_used", message, "temperatures.bulk_method", rank="note")


def _material_notices(inputs: ScuffingInputs) -> Iterator[Notice]:
    """Warn if a gear is not made of steel and a value or a safety of the pair follows from a law for steel gears."""
    estimates = {
        "the coefficient of friction": inputs.friction == "iso_tr_13989",
        "the bulk temperature": inputs.temperatures.bulk_method == "estimated",
        "the scuffing temperature": inputs.temperatures.scuffing_test is not None,
    }
    test = inputs.micropitting
    safe_film = test is not None and (test.permissible_ratio is not None or test.failure_load_stage is not None)
    estimated = [name for name, is_estimated in estimates.items() if is_estimated]
    laws = [f"ISO/TR 13989-1 estimates {' and '.join(estimated)}"] if estimated else []
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
