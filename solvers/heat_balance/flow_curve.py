"""Temperatures of the flanks and of the drained oil at several oil flows, to show the effect of a higher oil flow."""

from dataclasses import replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.errors import NoSolution
from solvers.heat_balance.calibration import drain_rise
from solvers.heat_balance.model import HeatBalanceInputs, calibrated, network_of
from solvers.heat_balance.network import FLANKS, Network
from solvers.heat_balance.solution import equilibrium
from solvers.quantity import described, record


@record
class FlowCurve:
    """Temperatures at several oil flows to the gears; NaN at flows without an equilibrium."""

    flow: FloatArray = described("Oil flows to the gears [m^3/s].")
    pinion_flank: FloatArray = described("Temperatures of the loaded flanks of the pinion [K].")
    wheel_flank: FloatArray = described("Temperatures of the loaded flanks of the wheel [K].")
    drain: FloatArray = described("Temperatures of the drained oil [K].")


def over_the_flow(inputs: HeatBalanceInputs, flows: FloatArray) -> FlowCurve:
    """Solve the heat balance at several oil flows.

    Parameters
    ----------
    inputs : HeatBalanceInputs
        The pair or unit. With measured temperatures, the model is first calibrated at the oil flow of the inputs.
    flows : FloatArray
        Oil flows to the gears, in ascending order [m^3/s].

    Returns
    -------
    FlowCurve
        Temperatures at these flows.

    Examples
    --------
    >>> import numpy as np
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> little, much = heat_balance.over_the_flow(inputs, np.array([1e-3, 2e-3])).drain
    >>> bool(little > much)
    True
    """
    network = calibrated(network_of(inputs), inputs.cooling)
    start: FloatArray | None = None
    rows = []
    for flow in flows[::-1]:  # the largest flow, which cools best, comes first
        varied = replace(network, spray=replace(network.spray, flow=float(flow)))
        start, row = _solved(varied, start)
        rows.append(row)
    pinion, wheel, drain = network.oil.inlet + np.array(rows[::-1]).T
    return FlowCurve(frozen(flows), frozen(pinion), frozen(wheel), frozen(drain))


def _solved(network: Network, start: FloatArray | None) -> tuple[FloatArray | None, tuple[float, float, float]]:
    """Rises [K] of all nodes, and of pinion flank, wheel flank and drain; None and NaN without equilibrium."""
    try:
        rises = equilibrium(network, start).rises
    except NoSolution:
        return None, (np.nan, np.nan, np.nan)
    return rises, (float(rises[FLANKS[0]]), float(rises[FLANKS[1]]), drain_rise(network, rises))
