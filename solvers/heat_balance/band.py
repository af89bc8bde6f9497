"""Band of flank temperatures that are possible because the cooling is uncertain.

The band states no probability, and it covers the cooling only: not load, alignment, oil or flow.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.heat_balance.calibration import LEAST_WETTING, MOST_WETTING, wetted, with_drain, with_rotor
from solvers.heat_balance.inputs import Cooling
from solvers.heat_balance.network import FLANKS, Network
from solvers.heat_balance.solution import equilibrium

MEASURED_WITHIN = 3.0  # K, chosen: uncertainty of a measured temperature
WETTING_SHARES, FLING_OFF_FACTORS, REWETTING_SHARES = (0.2, 1.0), (0.7, 1.5), (0.0, 0.5)  # chosen
WINDAGE_FACTORS = (0.7, 3.0)  # chosen: published formulas give 1 to 3.4 times the windage by Mauz


@dataclass(frozen=True, slots=True)
class Corner:
    """A network at a corner of what is unknown, and the errors of the measured temperatures there [K].

    The shares, the factor and the windage are already in the network; the measured temperatures are not yet met.
    """

    network: Network
    rotor_error: float
    drain_error: float


def corners(network: Network, cooling: Cooling) -> list[Corner]:
    """Corners of all that is neither stated nor measured; empty if everything is (Eq. H21).

    Wetting, rewetting, fling-off and windage vary over a range around their nominal values, a measured temperature by 3
    K. Jets out of the mesh are also tried into it: experience above 100 m/s contradicts the model on which cools
    better.
    """
    measured, spray = cooling.measured, network.spray
    unknown = {
        "wetting_share": _around(spray.wetting_share, WETTING_SHARES, cooling.wetting_share, measured.rotors),
        "fling_off_factor": _around(spray.fling_off_factor, FLING_OFF_FACTORS, cooling.fling_off_factor),
        "rewetting_share": _around(spray.rewetting_share, REWETTING_SHARES, cooling.rewetting_share),
        "jet": (spray.jet,) if cooling.jets == "into_mesh" else (spray.jet, -spray.jet),
    }
    windages = _around(network.windage, [factor * network.windage for factor in WINDAGE_FACTORS], cooling.windage)
    rotor_errors = (-MEASURED_WITHIN, MEASURED_WITHIN) if measured.rotors else (0.0,)
    drain_errors = (0.0,) if measured.drain is None else (-MEASURED_WITHIN, MEASURED_WITHIN)
    tried = [
        Corner(
            replace(network, windage=windage, spray=replace(spray, **dict(zip(unknown, values, strict=True)))), *errors
        )
        for windage, *values in product(windages, *unknown.values())
        for errors in product(rotor_errors, drain_errors)
    ]
    return tried if len(tried) > 1 else []


def _around(nominal: float, ends: Sequence[float], stated: float | None, measured: object = None) -> tuple[float, ...]:
    """Return both ends of a range that contains the nominal value; the nominal value alone if it is not varied."""
    if stated is not None or measured:
        return (nominal,)
    return min(nominal, *ends), max(nominal, *ends)


def flank_cases(network: Network, cooling: Cooling, nominal: FloatArray) -> tuple[tuple[float, float], ...]:
    """Flank temperatures of pinion and wheel [K], nominal (`nominal`: rises of the nodes [K]) and at every corner."""
    rises = [nominal]
    rises += [equilibrium(_measured_again(corner, cooling), nominal).rises for corner in corners(network, cooling)]
    inlet = network.oil.inlet
    return tuple((inlet + float(one[FLANKS[0]]), inlet + float(one[FLANKS[1]])) for one in rises)


def end_networks(network: Network, cooling: Cooling, cases: tuple[tuple[float, float], ...]) -> tuple[Network, Network]:
    """Networks of the corners with the coolest and with the hottest flanks of `flank_cases`."""
    means, tried = [sum(case) for case in cases], corners(network, cooling)
    ends = (means.index(min(means)), means.index(max(means)))
    coolest, hottest = (network if end == 0 else _measured_again(tried[end - 1], cooling) for end in ends)
    return coolest, hottest


def _measured_again(corner: Corner, cooling: Cooling) -> Network:
    """Return the network of a corner, fitted to the measured temperatures with their errors."""
    network, measured = corner.network, cooling.measured
    drain = None if measured.drain is None else measured.drain + corner.drain_error
    if drain is not None and drain <= network.oil.inlet:
        drain = None
    if not measured.rotors:
        return network if drain is None else with_drain(network, drain)
    node, temperature = next(iter(measured.rotors.items()))
    return _fitted_again(network, node, temperature + corner.rotor_error, drain)


def _fitted_again(network: Network, node: str, temperature: float, drain: float | None) -> Network:
    """Network whose `node` has the given `temperature` [K], or comes closest to it by the wetting share."""
    try:
        return with_rotor(network, node, temperature, drain)
    except InvalidInput:
        place, wanted = network.nodes.index(node), temperature - network.oil.inlet
        ends = [wetted(network, share) for share in (MOST_WETTING, LEAST_WETTING)]
        ends = ends if drain is None else [with_drain(end, drain) for end in ends]
        return min(ends, key=lambda end: abs(float(equilibrium(end).rises[place]) - wanted))


def flank_band(
    cases: tuple[tuple[float, float], ...], cooling: Cooling
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Lowest and highest temperature [K] of each flank; at least 3 K to both sides of a measured gear."""
    bands = []
    for gear, name in enumerate(("pinion", "wheel")):
        values = [case[gear] for case in cases]
        if any(node.startswith(name) for node in cooling.measured.rotors):
            values += [values[0] - MEASURED_WITHIN, values[0] + MEASURED_WITHIN]
        bands.append((min(values), max(values)))
    return bands[0], bands[1]
