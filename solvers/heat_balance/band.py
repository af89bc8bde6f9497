"""Band of flank temperatures that are possible because the amount of oil on the flanks is uncertain.

The band states no probability.
"""

from dataclasses import dataclass, replace

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.heat_balance.calibration import LEAST_WETTING, MOST_WETTING, wetted, with_rotor
from solvers.heat_balance.inputs import Cooling
from solvers.heat_balance.network import FLANKS, Network
from solvers.heat_balance.solution import equilibrium

MEASURED_WITHIN = 3.0  # K, chosen: uncertainty of a measured temperature


@dataclass(frozen=True, slots=True)
class Extreme:
    """Cooling by the oil at one end of the band.

    If `rewetting_share` is None, the nominal rewetting share is kept. If the temperature of a gear was measured, the
    temperature of this gear at the end of the band is the measured temperature plus the difference `measured` [K].
    """

    wetting_share: float
    fling_off_factor: float
    measured: float
    rewetting_share: float | None = None


WELL_COOLED = Extreme(wetting_share=1.0, fling_off_factor=1.5, measured=-MEASURED_WITHIN)
POORLY_COOLED = Extreme(wetting_share=0.2, fling_off_factor=0.7, measured=MEASURED_WITHIN, rewetting_share=0.5)


def extreme_network(network: Network, cooling: Cooling, extreme: Extreme) -> Network:
    """Return the network at one end of the band of possible temperatures.

    If the user gives a wetting share, a rewetting share or a fling-off factor, the given value is kept.

    Parameters
    ----------
    network : Network
        The network of the nominal case.
    cooling : Cooling
        What the user states about the cooling.
    extreme : Extreme
        The end of the band.

    Returns
    -------
    Network
        The network with the wetting share, rewetting share and fling-off factor of this end. The flow and the laws of
        the losses are unchanged.

    Notes
    -----
    Eq. H21. If the temperature of a gear was measured, the difference `extreme.measured` is added to this temperature,
    and the wetting share is fitted to the sum. If no wetting share gives the required temperature, the largest or the
    smallest share is used.
    """
    spray = network.spray
    if cooling.fling_off_factor is None:
        spray = replace(spray, fling_off_factor=extreme.fling_off_factor)
    if cooling.rewetting_share is None and extreme.rewetting_share is not None:
        spray = replace(spray, rewetting_share=extreme.rewetting_share)
    varied = replace(network, spray=spray)
    if cooling.measured.rotors:
        node, temperature = next(iter(cooling.measured.rotors.items()))
        return _fitted_again(varied, node, temperature + extreme.measured)
    return wetted(varied, extreme.wetting_share) if cooling.wetting_share is None else varied


def _fitted_again(network: Network, node: str, temperature: float) -> Network:
    """Return the network with the wetting share at which `node` has the given `temperature` [K].

    If `node` is too warm even at the largest wetting share, the network gets the largest share. If `node` is too cold
    even at the smallest wetting share, the network gets the smallest share.
    """
    place, wanted = network.nodes.index(node), temperature - network.oil.inlet
    all_oil = wetted(network, MOST_WETTING)
    if float(equilibrium(all_oil).rises[place]) >= wanted:  # no share cools the node to this temperature
        return all_oil
    try:
        return with_rotor(network, node, temperature)
    except InvalidInput:
        return wetted(network, LEAST_WETTING)


def flank_cases(network: Network, cooling: Cooling, nominal: FloatArray) -> tuple[tuple[float, float], ...]:
    """Compute the flank temperatures at both ends of the band and in the nominal case.

    Parameters
    ----------
    network : Network
        The network of the nominal case.
    cooling : Cooling
        What the user states about the cooling.
    nominal : FloatArray
        Temperature rises of the nodes in the nominal case [K].

    Returns
    -------
    tuple of (float, float)
        Flank temperatures of pinion and wheel [K] in the well cooled, the nominal and the poorly cooled case.
    """
    ends = [extreme_network(network, cooling, extreme) for extreme in (WELL_COOLED, POORLY_COOLED)]
    rises = [equilibrium(ends[0], nominal).rises, nominal, equilibrium(ends[1], nominal).rises]
    inlet = network.oil.inlet
    return tuple((inlet + float(one[FLANKS[0]]), inlet + float(one[FLANKS[1]])) for one in rises)


def flank_band(
    cases: tuple[tuple[float, float], ...], cooling: Cooling
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lowest and the highest temperature [K] of each gear's flank.

    If a flank temperature was measured and used for the calibration, the band of this flank extends from 3 K
    below to 3 K above the measured temperature.
    """
    bands = []
    for gear, node in enumerate(("pinion_flank", "wheel_flank")):
        values = [case[gear] for case in cases]
        measured = cooling.measured.rotors.get(node)
        if measured is not None and next(iter(cooling.measured.rotors)) == node:
            values = [measured - MEASURED_WITHIN, measured + MEASURED_WITHIN]
        bands.append((min(values), max(values)))
    return bands[0], bands[1]
