"""Heat capacities of the nodes: teeth, rotors, bearings, mist, casing."""

from math import pi

import numpy as np

from solvers.arrays import FloatArray
from solvers.heat_balance.network import Network
from solvers.quantity import described, record

BEARING_OIL, BEARING_STEEL = 0.5e-3, 5.0  # m^3, kg; chosen: oil and steel that warm up with a plain bearing
MIST_OIL = 5e-3  # m^3, chosen: oil in the mist, and oil on the way to the drain
STEEL_DENSITY, STEEL_HEAT = 7850.0, 470.0  # kg/m^3, J/(kg K)


@record
class Capacities:
    """Heat capacities of the rotors and of the casing."""

    rotors: tuple[float, float] = described("Heat capacities of the pinion with its shaft and of the wheel's [J/K].")
    loaded_teeth: tuple[float, float] = described("Heat capacities of the loaded halves of the teeth [J/K].")
    casing: float | None = described(
        "Heat capacity of the casing; None if the casing is not modelled [J/K].", default=None
    )

    def of(self, network: Network) -> FloatArray:
        """Compute the heat capacity of each node [J/K] (Eq. H23). Returns heat capacities (n,) [J/K]."""
        oil = network.oil.heat_capacity
        gears = [
            capacity
            for rotor, teeth in zip(self.rotors, self.loaded_teeth, strict=True)
            for capacity in (teeth, max(rotor - teeth, teeth))
        ]
        bearings = [BEARING_OIL * oil + BEARING_STEEL * STEEL_HEAT] * len(network.journals)
        casing = [] if network.casing is None else [self.casing or 0.0]
        return np.array([*gears, MIST_OIL * oil, *bearings, *casing])


def cylinders_capacity(
    sections: tuple[tuple[float, float, float], ...],
    density: float = STEEL_DENSITY,
    specific_heat: float = STEEL_HEAT,
) -> float:
    """Compute the heat capacity of a rotor that consists of hollow cylinders.

    Parameters
    ----------
    sections : tuple of (float, float, float)
        Length, outer and inner diameter of each section [m].
    density : float
        Density [kg/m^3].
    specific_heat : float
        Specific heat [J/(kg K)].

    Returns
    -------
    float
        Heat capacity [J/K].

    Examples
    --------
    >>> round(cylinders_capacity(((0.2, 0.25, 0.0),)))
    36222
    """
    volume = sum(pi / 4 * length * (outer**2 - inner**2) for length, outer, inner in sections)
    return volume * density * specific_heat


def loaded_teeth_capacity(
    teeth: int,
    face_width: float,
    module: float,
    height: float,
    density: float = STEEL_DENSITY,
    specific_heat: float = STEEL_HEAT,
) -> float:
    """Compute the heat capacity of the loaded halves of all teeth of a gear.

    Parameters
    ----------
    teeth : int
        Number of teeth.
    face_width : float
        Face width [m].
    module : float
        Normal module [m].
    height : float
        Tooth height [m].
    density : float
        Density [kg/m^3].
    specific_heat : float
        Specific heat [J/(kg K)].

    Returns
    -------
    float
        Heat capacity z b H pi m_n/4 rho c [J/K].

    Examples
    --------
    >>> round(loaded_teeth_capacity(39, 0.2, 6e-3, 13.5e-3))
    1831
    """
    return teeth * face_width * height * pi * module / 4 * density * specific_heat
