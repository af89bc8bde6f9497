"""What a scuffing check takes for granted once a request leaves it to practice: friction, bulk, oil, its limit.

Nothing iterates: friction takes the oil at the oil temperature, only the film's oil follows the bulk.
"""

from dataclasses import replace

import numpy as np

from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.path_of_contact import meshing_path
from solvers.scuffing.distribution.feature_line import feature_line
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.practice import bulk_temperature, lubricant_factor, mean_friction, scuffing_temperature

COLDEST_OIL, HOTTEST_OIL = 223.15, 573.15  # K, the range of reference temperatures
MEAN_POINTS = 1001  # of the mean flash temperature along the path


def with_friction(inputs: ScuffingInputs) -> ScuffingInputs:
    """The inputs with the coefficient of friction in force. Raises what `meshing_path` and `lubricant_factor` raise."""
    given = inputs.distribution
    if inputs.friction == "given" or given.load.pinion_torque == 0.0:
        return inputs
    coefficient = mean_friction(given, meshing_path(given.gears), _oil_factor(inputs))
    return replace(inputs, distribution=replace(given, friction_coefficient=coefficient))


def with_temperatures(inputs: ScuffingInputs, distribution: LoadDistribution) -> ScuffingInputs:
    """The inputs with bulk and scuffing temperature as numbers and the oil as it enters the contact.

    Raises InvalidInput no_bulk_estimate where the flash temperature has no mean, oil_temperature where an oil by its
    sheet would be too hot or too cold, scuffing_temperature where the oil is not cooler than that, and what
    `lubricant_factor` raises.
    """
    temperatures = inputs.temperatures
    if temperatures.bulk_method == "estimated":
        temperatures = replace(temperatures, bulk=_estimated_bulk(inputs, distribution))
    if temperatures.scuffing_test is not None:
        test = temperatures.scuffing_test
        factor = _oil_factor(inputs) if test.lubricant_factor is None else test.lubricant_factor
        limit = scuffing_temperature(test.fzg_stage, test.structure_factor, factor)
        temperatures = replace(temperatures, scuffing=limit)
    if temperatures.scuffing is not None and temperatures.scuffing <= temperatures.oil:
        message = "the scuffing temperature must lie above the oil temperature"
        raise InvalidInput("scuffing_temperature", message, "temperatures.scuffing")
    if inputs.oil is not None and not COLDEST_OIL <= temperatures.bulk <= HOTTEST_OIL:
        message = (
            f"the oil would enter at {temperatures.bulk - 273.15:.4g} °C, where no grade or data sheet tells what it "
            "is; give a lower load, another bulk temperature, or the oil by its viscosity"
        )
        raise InvalidInput("oil_temperature", message, "temperatures.bulk_method")
    lubricant = inputs.lubricant if inputs.oil is None else inputs.oil.lubricant(temperatures.bulk)
    return replace(inputs, temperatures=temperatures, lubricant=lubricant)


def _oil_factor(inputs: ScuffingInputs) -> float:
    """X_L of the oil at the oil temperature; an oil given by its viscosity counts as mineral."""
    temperature = inputs.temperatures.oil
    if inputs.oil is None:
        return lubricant_factor(inputs.lubricant.viscosity_at(0.0, temperature), "mineral")
    return lubricant_factor(inputs.oil.viscosity(temperature), inputs.oil.kind)


def _estimated_bulk(inputs: ScuffingInputs, distribution: LoadDistribution) -> float:
    """Bulk temperature [K] by the mean flash temperature along the path."""
    given = inputs.distribution
    line = feature_line(
        distribution.path_of_contact,
        distribution.balance,
        given.load.pinion_speed,
        distribution.load.tangential_force,
        reduced_modulus(given.pinion_material, given.wheel_material),
        np.linspace(0.0, 1.0, MEAN_POINTS),
    )
    if np.any(line.undefined):
        message = "the path of contact reaches a base circle, where no flash temperature is defined; give the bulk"
        raise InvalidInput("no_bulk_estimate", message, "temperatures.bulk_method")
    flash = blok_flash(given, line)
    return bulk_temperature(inputs.temperatures.oil, inputs.temperatures.oil_supply, line.psi, flash)
