"""Calibration: a measured temperature of a gear fixes the wetting share, that of the drain the other losses."""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance.network import MIST, Network
from solvers.heat_balance.solution import equilibrium

LEAST_WETTING, MOST_WETTING = 0.02, 1.0
TRIED_SHARES = np.geomspace(MOST_WETTING, LEAST_WETTING, 8)
CLOSE = 1e-7  # of the wetting share


def wetted(network: Network, share: float) -> Network:
    """Return the network with another wetting share."""
    return replace(network, spray=replace(network.spray, wetting_share=share))


def drain_rise(network: Network, rises: FloatArray) -> float:
    """Compute how much all oil that leaves a unit has warmed.

    Parameters
    ----------
    network : Network
        The network.
    rises : FloatArray
        Rises of its nodes [K].

    Returns
    -------
    float
        Rise of the mixture of the gears' and the bearings' oil [K].

    """
    flows = oil_flows(network, rises)
    warmed = network.spray.flow * rises[MIST] + flows @ rises[MIST + 1 : MIST + 1 + flows.size]
    return float(warmed / (network.spray.flow + flows.sum()))


def oil_flows(network: Network, rises: FloatArray) -> FloatArray:
    """Return the flow of oil through each plain bearing [m^3/s]."""
    films = [network.film_temperature(float(rise)) for rise in rises[MIST + 1 :]]
    pairs = zip(network.journals, films, strict=False)
    return np.array([journal.loss_and_flow(network.oil.viscosity(film))[1] for journal, film in pairs])


def with_drain(network: Network, drain: float) -> Network:
    """Return the network with the other losses at which the drain has its measured temperature.

    Parameters
    ----------
    network : Network
        The network.
    drain : float
        Measured temperature of all oil that leaves [K].

    Returns
    -------
    Network
        With other losses, negative if the losses are overestimated.

    Raises
    ------
    InvalidInput
        `measured_unreachable` if the drain is not warmer than the supplied oil.

    Notes
    -----
    Eq. H20.

    """
    wanted = drain - network.oil.inlet
    if wanted <= 0.0:
        message = f"the oil is supplied at {network.oil.inlet - 273.15:.4g} °C; the drain must be warmer"
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
    return replace(network, other=other)


def with_rotor(network: Network, node: str, temperature: float, drain: float | None = None) -> Network:
    """Return the network with the wetting share at which a node of a gear has its measured temperature.

    Parameters
    ----------
    network : Network
        The network.
    node : str
        Node that was measured, "pinion_flank" to "wheel_body".
    temperature : float
        Its temperature [K].
    drain : float, optional
        Measured temperature of all oil that leaves [K], which the other losses are fitted to.

    Returns
    -------
    Network
        With the largest wetting share that gives this temperature.

    Raises
    ------
    InvalidInput
        `measured_unreachable` with the range that shares of 0.02 to 1 reach.

    Notes
    -----
    Eq. H19.

    """
    place, wanted = network.nodes.index(node), temperature - network.oil.inlet

    def with_share(share: float) -> Network:
        varied = wetted(network, share)
        return varied if drain is None else with_drain(varied, drain)

    def excess(share: float) -> float:
        return float(equilibrium(with_share(share)).rises[place]) - wanted

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


def _unreachable(node: str, temperature: float, reached: list[float]) -> InvalidInput:
    low, high = (min(reached) - 273.15, max(reached) - 273.15) if reached else (np.nan, np.nan)
    message = (
        f"no wetting share from 0.02 to 1 gives {node.replace('_', ' ')} {temperature - 273.15:.4g} °C; "
        f"{low:.4g} to {high:.4g} °C can be reached: check losses, oil flow and the measured temperature"
    )
    if not reached:
        message = "the heat balance has no solution at any wetting share; check losses and oil flow"
    return InvalidInput("measured_unreachable", message, f"cooling.measured.{node}")
