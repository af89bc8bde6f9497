"""Warnings about the validity of a heat balance."""

from collections.abc import Iterator
from math import sqrt

from solvers.arrays import FloatArray
from solvers.heat_balance.inputs import Cooling
from solvers.heat_balance.network import MIST, Network
from solvers.heat_balance.oil import CoolingOil
from solvers.heat_balance.results import Heat
from solvers.notices import Notice, unusual_value

SLOW = 40.0  # m/s; below this speed the oil of the jets is not the only oil that wets the flanks
TURBULENT = 41.0  # this number times sqrt(R/c) is the Reynolds number at which Taylor vortices begin in a plain bearing
KNOWN_WITHIN = 15.0  # K, chosen: uncertainty of flank temperatures without a measured gear temperature
USUAL_RISE = (2.0, 60.0)  # K, chosen: usual temperature rise of the oil by the losses of the gears


def heat_notices(network: Network, rises: FloatArray, cooling: Cooling) -> Iterator[Notice]:
    """Yield warnings about speed, oil, bearing films and missing measurements that make the heat balance doubtful."""
    if network.spray.velocity < SLOW:
        message = (
            f"the heat balance considers the oil of the jets only; at {network.spray.velocity:.4g} m/s, below "
            f"{SLOW:g}, oil that runs down and is picked up again cools the teeth as well: with little oil the "
            "flanks are cooler than computed"
        )
        yield Notice("low_speed", message, "cooling")
    yield from _oil_notices(network, rises)
    if network.other < 0.0:
        message = (
            f"with the measured drain temperature the other losses are {network.other:.4g} W; the losses are "
            "overestimated, or the oil flow is underestimated"
        )
        yield Notice("losses_overestimated", message, "cooling.measured.drain")
    if not cooling.measured.rotors:
        message = (
            "the heat balance has not been compared with measurements above 50 m/s; flank temperatures are uncertain "
            f"by about ±{KNOWN_WITHIN:g} K, differences between gears, oils and oil flows by less: a measured "
            "temperature of a gear reduces the uncertainty"
        )
        yield Notice("not_validated", message, "cooling.measured", rank="note")


def _oil_notices(network: Network, rises: FloatArray) -> Iterator[Notice]:
    """Yield warnings if the oil flow limits the cooling of a gear, or if the film of a bearing is turbulent."""
    for gear, name in enumerate(("pinion", "wheel")):
        if network.cooling(gear, rises).limited:
            message = (
                f"all oil on the {name} reaches the temperature of its flanks; the cooling is limited by the oil flow"
            )
            yield Notice("oil_limited", message, "cooling.gear_flow", rank="note")
    for number, journal in enumerate(network.journals):
        viscosity = network.oil.viscosity(network.film_temperature(float(rises[MIST + 1 + number])))
        reynolds = network.oil.density * journal.surface_speed * journal.clearance / viscosity
        limit = TURBULENT * sqrt(journal.diameter / 2 / journal.clearance)
        if reynolds > limit:
            message = (
                f"the film of bearing {number + 1} is turbulent (Reynolds number {reynolds:.3g}, beyond {limit:.3g}); "
                "its friction is higher than stated"
            )
            yield Notice("turbulent_film", message, "cooling")


def unusual_flow(gear_flow: float | None, heat: Heat, oil: CoolingOil) -> Iterator[Notice]:
    """Warn if the losses would warm the given oil flow [m^3/s] very little or very much."""
    if gear_flow is None:
        return
    losses = heat.losses.mesh + heat.losses.pumping + heat.losses.windage + heat.losses.other
    rise, (least, most) = losses / (oil.heat_capacity * gear_flow), USUAL_RISE
    if rise < least:
        message = f"the losses warm the oil of the gears by {rise:.3g} K only; is the oil flow in l/min?"
        yield unusual_value("cooling.gear_flow", message)
    elif rise > most:
        message = f"the losses warm the oil of the gears by {rise:.4g} K; is the oil flow in l/min?"
        yield unusual_value("cooling.gear_flow", message)
