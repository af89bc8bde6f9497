"""Warnings about the validity of a heat balance."""

from collections.abc import Iterator
from math import sqrt

from solvers.arrays import FloatArray
from solvers.heat_balance.inputs import Cooling
from solvers.heat_balance.network import MIST, Network
from solvers.heat_balance.oil import CoolingOil
from solvers.heat_balance.results import Heat
from solvers.lubricants import hotter_than_gears
from solvers.notices import Notice, unusual_value

SLOW = 40.0  # m/s; at lower speeds the flanks are also wetted by oil that does not come from the jets
COMPARED = 50.0  # m/s; no measurement above this speed was available
TURBULENT = 41.0  # this number times sqrt(R/c) is the Reynolds number at which Taylor vortices begin in a plain bearing
KNOWN_WITHIN = 15.0  # K, chosen: uncertainty of flank temperatures without a measured gear temperature
MEETS = 0.01  # K; tolerance of a measured drain temperature
CONTRADICTION = 6.0  # K, twice the uncertainty of a measured temperature
LEAST_USUAL_WETTING = 0.1  # chosen
USUAL_RISE = (2.0, 60.0)  # K, chosen: usual temperature rise of the oil by the losses of the gears


def heat_notices(network: Network, rises: FloatArray, cooling: Cooling) -> Iterator[Notice]:
    """Yield warnings if the speed, the oil, a bearing film or a missing measurement makes the heat balance doubtful."""
    if network.spray.velocity < SLOW:
        message = (
            f"the pitch line velocity of {network.spray.velocity:.4g} m/s is below {SLOW:g} m/s. At such low "
            "velocities the teeth also pick up oil that has run down, and this oil cools the teeth. The heat balance "
            "considers only the oil of the jets; with little oil the flanks are therefore cooler than computed"
        )
        yield Notice("low_speed", message, "cooling")
    yield from _oil_notices(network, rises)
    if network.spray.velocity > COMPARED and not cooling.measured.rotors:
        message = (
            f"above {COMPARED:g} m/s the heat balance has not been compared with measurements. At "
            f"{network.spray.velocity:.3g} m/s flank temperatures are uncertain by about ±{KNOWN_WITHIN:g} K. "
            "Differences between gears, oils or oil flows are less uncertain, those between directions of the jets "
            "are not. A measured gear temperature reduces the uncertainty"
        )
        yield Notice("not_validated", message, "cooling.measured", rank="note")


def measured_notices(
    network: Network, cooling: Cooling, drain: float, wheel_deviation: float | None
) -> Iterator[Notice]:
    """Warnings about measured temperatures that the balance contradicts; `drain` is calculated, deviations [K]."""
    measured = cooling.measured
    if measured.drain is not None and drain - measured.drain > MEETS:
        message = (
            f"measured drain contradicted by {drain - measured.drain:.3g} K: the calculated losses alone warm the "
            f"drained oil to {drain - 273.15:.4g} °C, and no loss is negative. The oil flow is larger than stated, or "
            "the losses are smaller"
        )
        yield Notice("losses_overestimated", message, "cooling.measured.drain")
    if wheel_deviation is not None and abs(wheel_deviation) > CONTRADICTION:
        node = list(measured.rotors)[1]
        message = (
            f"measured gears contradict each other by {abs(wheel_deviation):.3g} K: with the pinion as measured, the "
            f"{node.replace('_', ' ')} is calculated {'hotter' if wheel_deviation > 0.0 else 'cooler'} than measured. "
            "Check both measurements and the oil's share for the pinion"
        )
        yield Notice("measured_contradiction", message, f"cooling.measured.{node}")
    if measured.rotors and network.spray.wetting_share < LEAST_USUAL_WETTING:
        node = next(iter(measured.rotors))
        message = (
            f"measured temperature needs a wetting share of only {network.spray.wetting_share:.2g}, outside 0.1 to 1: "
            "so little oil on the flanks is unlikely. Check the measurement, the oil flow and the losses"
        )
        yield Notice("measured_contradiction", message, f"cooling.measured.{node}")


def _oil_notices(network: Network, rises: FloatArray) -> Iterator[Notice]:
    """Yield warnings if the oil flow limits the cooling of a gear, or if the film of a bearing is turbulent."""
    for gear, name in enumerate(("pinion", "wheel")):
        if network.cooling(gear, rises).limited:
            message = (
                f"all oil on the {name} reaches the temperature of the flanks; the cooling is limited by the oil flow"
            )
            yield Notice("oil_limited", message, "cooling.gear_flow", rank="note")
    for number, journal in enumerate(network.journals):
        viscosity = network.oil.viscosity(network.film_temperature(number, float(rises[MIST + 1 + number])))
        reynolds = network.oil.density * journal.surface_speed * journal.clearance / viscosity
        limit = TURBULENT * sqrt(journal.diameter / 2 / journal.clearance)
        if reynolds > limit:
            message = (
                f"the film of bearing {number + 1} is turbulent, because its Reynolds number of {reynolds:.3g} exceeds "
                f"{limit:.3g}; the friction is higher than stated"
            )
            yield Notice("turbulent_film", message, "cooling")


def unusual_flow(gear_flow: float | None, heat: Heat, oil: CoolingOil) -> Iterator[Notice]:
    """Warn if the losses would warm the given oil flow [m^3/s] very little or very much."""
    if gear_flow is None:
        return
    losses = heat.losses.mesh + heat.losses.pumping + heat.losses.windage + heat.losses.other
    rise, (least, most) = losses / (oil.heat_capacity * gear_flow), USUAL_RISE
    if rise < least:
        message = f"the losses warm the oil of the gears by only {rise:.3g} K; is the oil flow really in l/min?"
        yield unusual_value("cooling.gear_flow", message)
    elif rise > most:
        message = f"the losses warm the oil of the gears by {rise:.4g} K; is the oil flow really in l/min?"
        yield unusual_value("cooling.gear_flow", message)


def unusual_measurements(cooling: Cooling) -> Iterator[Notice]:
    """Warn if a measured temperature is unusual; it may be in degrees Fahrenheit."""
    measured = cooling.measured
    given = [*measured.rotors.items(), ("drain", measured.drain)]
    given += [(f"face.{k}.temperature", reading.temperature) for k, reading in enumerate(measured.face)]
    for name, temperature in given:
        if temperature is not None:
            yield from hotter_than_gears(temperature, f"cooling.measured.{name}")
