"""Checks of the inputs of a line contact; a value outside its range raises InvalidInput."""

from dataclasses import replace
from math import exp, log

from scipy.optimize import brentq

from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.problem import expected_gap, groups
from solvers.errors import InvalidInput
from solvers.lubricants import HIGHEST_VISCOSITY, ROELANDS_POLE_TEMPERATURE, log_viscosity, pressure_part

LOWEST_SPEED = 1e-9  # m/s, three centimetres per year
LOWEST_VISCOSITY = 7e-5  # Pa s; Roelands' law is not defined below 6.31e-5 Pa s
HIGHEST_VISCOSITY_UNDER_PRESSURE = 1e100  # Pa s; a liquid of 1e12 Pa s or more counts as glass
LOWEST_TEMPERATURE = ROELANDS_POLE_TEMPERATURE + 60.0  # K; no oil flows at lower temperatures
HIGHEST_PRESSURE = 4e9  # Pa
THICKEST_FILM = 1e4  # in b^2/R, the scale of the deformation of the surfaces
THINNEST_FILM = 1e-9  # m, the length of an oil molecule
MIN_NODES = 41  # chosen: the coarsest mesh that is accepted
MIN_FILM_NODES = 5  # three of them lie inside the film, the least number that shows a maximum of temperature


def check(inputs: LineContactInputs) -> None:
    """Refuse a contact that has no solution or lies outside the range of the lubricant's laws.

    Parameters
    ----------
    inputs : LineContactInputs
        The contact.

    Raises
    ------
    InvalidInput
        With one of the codes `no_load`, `no_entrainment`, `stationary_surface`, `viscosity_range`,
        `temperature_range`, `pressure_range`, `load_range`, `film_range` and `resolution`.

    Examples
    --------
    >>> from solvers.contact import ehl
    >>> from solvers.lubricants import Lubricant
    >>> check(ehl.LineContactInputs(ehl.Contact(273e3, 6.5e-3, 1.018, 3.708), lubricant=Lubricant()))
    """
    _check_motion(inputs)
    _check_resolution(inputs)
    _check_oil(inputs)
    _check_load(inputs)


def lightest(inputs: LineContactInputs) -> LineContactInputs:
    """Increase the line load of a contact if `check` would refuse this load because it is too small.

    Parameters
    ----------
    inputs : LineContactInputs
        The contact.

    Returns
    -------
    LineContactInputs
        If the expected film is thin enough for `check`, the contact itself. Otherwise the contact with the smallest
        line load for which the expected film is thin enough.

    Examples
    --------
    >>> from solvers.contact import ehl
    >>> from solvers.lubricants import Lubricant
    >>> light = ehl.LineContactInputs(ehl.Contact(1.0, 6.5e-3, 1.018, 3.708), lubricant=Lubricant())
    >>> lightest(light).contact.line_load > 1.0
    True
    """

    def excess(logarithm: float) -> float:
        loaded = replace(inputs, contact=replace(inputs.contact, line_load=exp(logarithm)))
        return log(min(expected_gap(loaded), 1e300) / (0.999 * THICKEST_FILM))

    low = high = log(inputs.contact.line_load)
    while excess(high) > 0.0:
        low, high = high, high + log(10.0)
    load = exp(brentq(excess, low, high)) if high > low else inputs.contact.line_load
    return replace(inputs, contact=replace(inputs.contact, line_load=load))


def _check_motion(inputs: LineContactInputs) -> None:
    contact = inputs.contact
    if contact.line_load <= 0.0 or contact.radius <= 0.0:
        raise InvalidInput("no_load", "line load and reduced radius must be positive", "line_load")
    if contact.entrainment_speed < LOWEST_SPEED:
        raise InvalidInput(
            "no_entrainment",
            f"the mean surface speed draws the oil into the contact; it must be at least {LOWEST_SPEED:g} m/s",
            "speed_1",
        )
    if inputs.model.thermal and min(contact.speed_1, contact.speed_2) <= 0.0:
        name = "speed_1" if contact.speed_1 <= contact.speed_2 else "speed_2"
        raise InvalidInput(
            "stationary_surface",
            "a surface that does not move through the contact heats up without limit; give positive speeds for both "
            "surfaces, or switch thermal off",
            name,
        )


def _check_resolution(inputs: LineContactInputs) -> None:
    if inputs.model.nodes < MIN_NODES or inputs.model.film_nodes < MIN_FILM_NODES:
        raise InvalidInput(
            "resolution",
            f"the numerical grid needs at least {MIN_NODES} nodes along the film and {MIN_FILM_NODES} nodes across "
            "the film",
            "nodes",
        )


def _check_oil(inputs: LineContactInputs) -> None:
    """Check viscosity and temperatures; of an isothermal film only that of the inlet."""
    oil, temperatures = inputs.lubricant, inputs.temperatures
    if oil.viscosity < LOWEST_VISCOSITY:
        raise InvalidInput(
            "viscosity_range",
            f"the viscosity must be at least {LOWEST_VISCOSITY:g} Pa s, which is the limit of Roelands' law",
            "viscosity",
        )
    used = [temperatures.inlet]
    if inputs.model.thermal:
        used += [temperatures.surface_1, temperatures.surface_2]
    if min(*used, oil.reference_temperature) < LOWEST_TEMPERATURE:
        raise InvalidInput("temperature_range", f"temperatures must be above {LOWEST_TEMPERATURE:g} K", "temperatures")
    for temperature in used:
        logarithm = _log_viscosity(inputs, 0.0, temperature)
        if not log(0.9 * LOWEST_VISCOSITY) < logarithm < log(HIGHEST_VISCOSITY):
            raise InvalidInput(
                "viscosity_range",
                f"at {temperature:g} K the laws of the oil give a viscosity of 10^{logarithm / log(10.0):.2g} Pa s, "
                f"but the viscosity must be between {LOWEST_VISCOSITY:g} and {HIGHEST_VISCOSITY:g} Pa s; bring the "
                "temperatures nearer to the reference temperature, or lower the temperature-viscosity coefficient",
                "temperature_viscosity",
            )


def _check_load(inputs: LineContactInputs) -> None:
    """Check the pressure and the film, which must not be so thick that the surfaces are practically rigid."""
    scales = groups(inputs)
    if scales.maximum_pressure > HIGHEST_PRESSURE:
        raise InvalidInput(
            "pressure_range", "the Hertzian pressure must not exceed 4 GPa; lower the line load", "line_load"
        )
    hottest = inputs.temperatures.inlet
    if _log_viscosity(inputs, scales.maximum_pressure, hottest) > log(HIGHEST_VISCOSITY_UNDER_PRESSURE):
        raise InvalidInput(
            "viscosity_range",
            f"at the Hertzian pressure of {scales.maximum_pressure * 1e-9:.2g} GPa the laws of the oil give a "
            f"viscosity above {HIGHEST_VISCOSITY_UNDER_PRESSURE:g} Pa s; lower the load or the pressure-viscosity "
            "coefficient, or (with Roelands' law) raise the viscosity at ambient pressure",
            "pressure_viscosity",
        )
    gap = expected_gap(inputs)
    if gap > THICKEST_FILM:
        raise InvalidInput(
            "load_range",
            f"the film would be more than {THICKEST_FILM:g} times as thick as the deformation of the surfaces (Moes' "
            f"load parameter M = {scales.moes_m:.2g}). Such surfaces are practically rigid, and the model cannot be "
            "used; raise the line load, or lower speed or viscosity",
            "line_load",
        )
    if gap * scales.gap_scale < THINNEST_FILM:
        raise InvalidInput(
            "film_range",
            f"the film would be only {gap * scales.gap_scale * 1e9:.2g} nm thick, which is less than a molecule of "
            "oil; raise speed or viscosity",
            "speed_1",
        )


def _log_viscosity(inputs: LineContactInputs, pressure: float, temperature: float) -> float:
    """Return ln(eta/Pa s). This logarithm stays finite even if the viscosity eta itself overflows."""
    laws = inputs.lubricant.laws
    return float(log_viscosity(laws, pressure_part(laws, pressure)[0], temperature)[0])
