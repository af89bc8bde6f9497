"""Calibration of the network with measured temperatures.

The wetting share is fitted to a measured gear temperature. `Network.other`, called the other losses, is the sum of all
losses that no part of the model computes. These losses are fitted to a measured drain temperature.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance.network import MIST, Network
from solvers.heat_balance.solution import DIFFERENCE, equilibrium

LEAST_WETTING, MOST_WETTING = 0.02, 1.0
TRIED_SHARES = np.geomspace(MOST_WETTING, LEAST_WETTING, 8)
CLOSE = 1e-7  # tolerance of the wetting share
SHARE_STEP = 1e-5  # step of the logarithm of the wetting share in difference quotients
MOST_FITS, LARGEST_FIT = 20, 1.0  # largest number of Newton steps; largest change of the share's logarithm per step
FITTED = 1e-6  # K; tolerance of the last step
MET = 1e-5  # K; tolerance of the measured temperature
HOT, FAHRENHEIT = 130 + 273.15, ", which may be in degrees Fahrenheit"  # hotter teeth are unusual


def wetted(network: Network, share: float) -> Network:
    """Return the network with the wetting share `share`."""
    return replace(network, spray=replace(network.spray, wetting_share=share))


def drain_rise(network: Network, rises: FloatArray) -> float:
    """Compute the temperature rise of the oil in the drain, where the oil of gears and bearings is mixed [K]."""
    flows = oil_flows(network, rises)
    warmed = network.spray.flow * rises[MIST] + flows @ rises[MIST + 1 : MIST + 1 + flows.size]
    return float(warmed / (network.spray.flow + flows.sum()))


def oil_flows(network: Network, rises: FloatArray) -> FloatArray:
    """Return the flow of oil through each plain bearing [m^3/s]."""
    outlets = [float(rise) for rise in rises[MIST + 1 : MIST + 1 + len(network.journals)]]
    return np.array([network.operation(number, outlet)[1] for number, outlet in enumerate(outlets)])


def with_drain(network: Network, drain: float) -> Network:
    """Network whose other losses give the drained oil its measured temperature (Eq. H20).

    Never negative: where the calculated losses alone warm the drain further, they are 0 and the temperature is not met.
    Raises InvalidInput: `measured_unreachable` if the drain is not warmer than the supply.
    """
    wanted = drain - network.oil.inlet
    if wanted <= 0.0:
        message = (
            "the measured drain temperature must be above the supply temperature of the oil, which is "
            f"{network.oil.inlet - 273.15:.4g} °C"
        )
        raise InvalidInput("measured_unreachable", message, "cooling.measured.drain")

    def excess(other: float) -> float:
        heated = replace(network, other=other)
        return drain_rise(heated, equilibrium(heated).rises) - wanted

    other, before, gap = network.other, network.other, excess(network.other)
    slope = 1.0 / (network.oil.heat_capacity * network.spray.flow)
    for _ in range(20):
        before, previous = other, gap
        other -= gap / slope
        gap = excess(other)
        if abs(gap) < 1e-9 or other == before:
            break
        slope = (gap - previous) / (other - before)
    return replace(network, other=max(other, 0.0))


def with_rotor(network: Network, node: str, temperature: float, drain: float | None = None) -> Network:
    """Network whose wetting share gives a node of a gear its measured temperature (Eq. H19).

    With a measured `drain` [K] the other losses are fitted too. Raises InvalidInput: `measured_unreachable`, with the
    reachable range, if no share from 0.02 to 1 does.
    """
    place, wanted = network.nodes.index(node), temperature - network.oil.inlet
    fitted = _fitted(network, place, wanted, None if drain is None else drain - network.oil.inlet)
    if fitted is not None and fitted.other < 0.0:  # the drain cannot be met; the gear still can
        return with_rotor(replace(network, other=0.0), node, temperature)
    if fitted is not None:
        return fitted

    def with_share(share: float) -> Network:
        varied = wetted(network, share)
        return varied if drain is None else with_drain(varied, drain)

    near: FloatArray | None = None

    def excess(share: float) -> float:
        nonlocal near
        near = equilibrium(with_share(share), near).rises
        return float(near[place]) - wanted

    reached: list[tuple[float, float]] = []
    for share in map(float, TRIED_SHARES):
        try:
            reached.append((share, excess(share)))
        except NoSolution:
            break
        if reached[-1][1] == 0.0:
            return with_share(share)
        if len(reached) > 1 and reached[-1][1] * reached[-2][1] < 0.0:
            return with_share(float(brentq(excess, reached[-1][0], reached[-2][0], xtol=CLOSE)))
    raise _unreachable(node, temperature, [gap + temperature for _, gap in reached])


def _fitted(network: Network, place: int, wanted: float, drain: float | None) -> Network | None:
    """Network whose node `place` has the rise `wanted` [K], and with `drain` the drained oil that rise [K]; or None.

    None if Newton's method does not converge or leaves shares of 0.02 to 1, or if there is no equilibrium with the
    fitted share or with 1, or if it misses `wanted`.
    """
    try:
        start = equilibrium(wetted(network, MOST_WETTING)).rises
    except NoSolution:
        return None
    scale = network.oil.heat_capacity * network.spray.flow
    unknown = np.concatenate([start, [0.0] if drain is None else [0.0, network.other / scale]])
    unknown[place] = wanted
    free = [number for number in range(unknown.size) if number != place]
    steps = np.full(unknown.size, DIFFERENCE)
    steps[network.size] = SHARE_STEP

    def varied(values: FloatArray) -> Network:
        other = network.other if drain is None else float(values[-1]) * scale
        return replace(wetted(network, float(np.exp(values[network.size]))), other=other)

    def residual(values: FloatArray) -> FloatArray:
        tried, rises = varied(values), values[: network.size]
        gained = tried.residual(rises)
        return gained if drain is None else np.append(gained, scale * (drain_rise(tried, rises) - drain))

    try:
        for _ in range(MOST_FITS):
            here = residual(unknown)
            moved = [unknown + steps * (np.arange(unknown.size) == number) for number in free]
            slopes = [(residual(one) - here) / steps[number] for one, number in zip(moved, free, strict=True)]
            step = np.linalg.solve(np.array(slopes).T, -here)
            turn = abs(step[free.index(network.size)])
            unknown[free] += step * min(1.0, LARGEST_FIT / turn if turn > 0.0 else 1.0)
            if float(np.abs(step).max()) < FITTED:
                break
            if unknown[network.size] > LARGEST_FIT:  # a wetting share above e; the greatest possible share is 1
                return None
        else:
            return None
        share = float(np.exp(unknown[network.size]))
        if not LEAST_WETTING <= share <= MOST_WETTING:
            return None
        meets = equilibrium(varied(unknown), unknown[: network.size]).rises
    except (NoSolution, InvalidInput, np.linalg.LinAlgError, FloatingPointError):
        return None
    return varied(unknown) if abs(float(meets[place]) - wanted) < MET else None


def _unreachable(node: str, temperature: float, reached: list[float]) -> InvalidInput:
    low, high = (min(reached) - 273.15, max(reached) - 273.15) if reached else (np.nan, np.nan)
    message = (
        f"no wetting share from 0.02 to 1 brings the {node.replace('_', ' ')} to {temperature - 273.15:.4g} °C; only "
        f"temperatures from {low:.4g} to {high:.4g} °C can be reached. Check the losses, the oil flow and the "
        f"measured temperature{FAHRENHEIT if temperature > HOT else ''}"
    )
    if not reached:
        message = "the heat balance has no solution at any wetting share; check the losses and the oil flow"
    return InvalidInput("measured_unreachable", message, f"cooling.measured.{node}")
