"""Warm-up of a gear pair or gear unit: the temperatures of the nodes as functions of time.

The heat capacities of the nodes determine how fast the temperatures change. The unit runs at full speed and load from
the beginning. The losses change only with the viscosity of the oil.
"""

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from solvers.arrays import FloatArray, frozen
from solvers.errors import NoSolution
from solvers.heat_balance.capacities import Capacities
from solvers.heat_balance.network import BODIES, Network
from solvers.heat_balance.solution import equilibrium, jacobian
from solvers.quantity import quantity, record

LONGEST = 6.0  # time constants; after this time 1/400 of the change remains
WARM = 0.95  # share of the whole change of a temperature
POINTS = 2000  # number of points in time that are searched for the time at which `WARM` is reached
SHOWN = 200


@record
class WarmUpCurves:
    """Temperatures [K] over time [s]; the columns of `temperature` are the nodes."""

    time: FloatArray = quantity("time", "t", unit="s")
    temperature: FloatArray = quantity("temperatures of the nodes", "θ", unit="c", axis=("time", "warm_up.nodes"))
    difference: FloatArray = quantity(
        "pinion's body over the wheel's", "Δθ", unit="k", axis="time", text="decides backlash and alignment"
    )


@record(equation="H24")
class WarmUp:
    """Results of a warm-up: final temperatures, times to 95 % of the temperature change, and curves over time.

    `greatest_difference` is the greatest temperature difference between the bodies of pinion and wheel.
    """

    nodes: tuple[str, ...] = quantity("nodes", index="flanks and bodies, mist, bearings, casing")
    final: FloatArray = quantity("final temperatures", "θ_end", unit="c", index="nodes")
    time_95: tuple[float | None, ...] = quantity(
        "time to 95 %",
        "t_95",
        unit="s",
        index="nodes",
        text="null for a part that changes by less than 5 % or is not there",
    )
    greatest_difference: float = quantity("greatest difference of the bodies", "Δθ_max", unit="k")
    greatest_difference_at: float = quantity("time of the greatest difference", "t_Δ", unit="s")
    curves: WarmUpCurves = quantity("over time", detail="curves")


def warm_up(network: Network, capacities: Capacities, start: float, until: float | None = None) -> WarmUp:
    """Compute the warm-up of a gear pair or gear unit.

    Parameters
    ----------
    network : Network
        The network, calibrated if a temperature was measured.
    capacities : Capacities
        Heat capacities of the nodes.
    start : float
        Temperature of everything at the beginning [K].
    until : float, optional
        End of the calculation [s]; if None, six times the slowest time constant.

    Returns
    -------
    WarmUp
        Temperatures of the nodes over time, the time to 95 % of each change, and the greatest temperature difference
        between the bodies of pinion and wheel.

    Raises
    ------
    NoSolution
        The errors of `equilibrium`; `warm_up` if the integration fails.

    Notes
    -----
    Eq. H24: C dT/dt = residual of the network, integrated with backward differentiation formulas.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> capacities = heat_balance.Capacities((3e4, 3e4), (2e3, 2e3))
    >>> round(heat_balance.warm_up(heat_balance.network_of(inputs), capacities, 293.15).time_95[0])
    157
    """
    final, capacity = equilibrium(network).rises, capacities.of(network)
    rates = jacobian(network, final, network.residual(final)) / capacity[:, None]
    end = LONGEST / -float(np.linalg.eigvals(rates).real.max()) if until is None else until
    begin = np.full(network.size, start - network.oil.inlet)
    path = _integrated(network, capacity, begin, end)
    times = np.concatenate([[0.0], np.geomspace(1e-5 * end, end, POINTS)])
    rises = path(times)
    difference = rises[BODIES[0]] - rises[BODIES[1]]
    greatest = int(np.argmax(np.abs(difference)))
    shown = end * np.linspace(0.0, 1.0, SHOWN + 1) ** 2  # dense at the start, where temperatures change fastest
    curves = path(shown)
    return WarmUp(
        nodes=network.nodes,
        final=frozen(network.oil.inlet + final),
        time_95=tuple(_time_95(times, row, to) for row, to in zip(rises, final, strict=True)),
        greatest_difference=float(difference[greatest]),
        greatest_difference_at=float(times[greatest]),
        curves=WarmUpCurves(
            time=frozen(shown),
            temperature=frozen(network.oil.inlet + curves.T),
            difference=frozen(curves[BODIES[0]] - curves[BODIES[1]]),
        ),
    )


def _integrated(network: Network, capacity: FloatArray, begin: FloatArray, end: float) -> Any:
    """Solve Eq. H24 from time zero to `end`, and return the temperature rises of the nodes as a function of time."""
    solution = solve_ivp(
        lambda _, rises: network.residual(rises) / capacity,
        (0.0, end),
        begin,
        method="BDF",
        dense_output=True,
        rtol=1e-5,
        atol=1e-4,
    )
    if not solution.success:
        raise NoSolution("warm_up", f"the warm-up cannot be integrated: {solution.message}")
    return solution.sol


def _time_95(times: FloatArray, rises: FloatArray, final: float) -> float | None:
    """Time [s] after which a node stays within 5 % of its whole change; None if never, or without change."""
    left = np.abs(rises - final)
    outside = np.flatnonzero(left > (1 - WARM) * left[0])
    if outside.size == 0 or outside[-1] == times.size - 1:
        return None
    last = outside[-1]
    share = (left[last] - (1 - WARM) * left[0]) / (left[last] - left[last + 1])
    return float(times[last] + share * (times[last + 1] - times[last]))
