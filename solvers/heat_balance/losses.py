"""Losses of a gear pair: friction of the mesh as a function of temperature, windage, and what the oil is given.

The friction of the mesh is computed with the load distribution, not in this module. `MeshHeat.at` adapts the computed
friction to the viscosity of the oil at another temperature.
"""

import numpy as np

from solvers.arrays import FloatArray
from solvers.heat_balance.oil import CoolingOil
from solvers.quantity import described, record

VISCOSITY_EXPONENT = -0.05  # exponent of the viscosity in Schlenk's mean coefficient of friction (quoted, not verified)


@record
class MeshHeat:
    """Friction of the mesh."""

    power: float = described("Friction power at `temperature` [W].")
    temperature: float = described("Temperature of the flanks at which the power was computed [K].")
    share_to_pinion: float = described("Share of the frictional heat that enters the pinion [-].")
    viscosity_exponent: float = described(
        "Exponent by which the power follows the viscosity of the oil; 0 if the user gives the coefficient of friction "
        "[-].",
        default=VISCOSITY_EXPONENT,
    )
    by_formula: float | None = described(
        "Friction power by the formula for losses, which sizes an oil flow that is not given; None: `power` [W].",
        default=None,
    )

    @property
    def sizing(self) -> float:
        """Friction power that sizes an oil flow [W]."""
        return self.power if self.by_formula is None else self.by_formula

    def at(self, oil: CoolingOil, flanks: float) -> float:
        """Compute the friction power at a given temperature of the flanks [W] (Eq. H6)."""
        if self.viscosity_exponent == 0.0:
            return self.power
        thinning = oil.viscosity(flanks) / oil.viscosity(self.temperature)
        return float(self.power * thinning**self.viscosity_exponent)


def share_to_pinion(
    heat: FloatArray,
    speed_1: FloatArray,
    speed_2: FloatArray,
    position: FloatArray,
    effusivity_ratio: float = 1.0,
) -> float:
    """Compute the pinion's share of the frictional heat that arises along a path of contact.

    Parameters
    ----------
    heat : FloatArray
        Frictional heat per length of path at points of the path [W/m].
    speed_1 : FloatArray
        Speed of the pinion's surface at these points [m/s].
    speed_2 : FloatArray
        Speed of the wheel's surface at these points [m/s].
    position : FloatArray
        Position of the points along the path [m].
    effusivity_ratio : float
        Effusivity sqrt(k rho c) of the wheel divided by the effusivity of the pinion [-].

    Returns
    -------
    float
        Share phi [-]; 0.5 if no heat arises.

    Notes
    -----
    Eq. H7: for equal effusivities, phi = int q sqrt(u_1)/(sqrt(u_1) + sqrt(u_2)) / int q. Here q is the frictional
    heat, and u_1 and u_2 are the surface speeds of pinion and wheel. If the effusivities differ, sqrt(u_2) is
    multiplied by the effusivity ratio. The model treats both surfaces as half spaces under a moving heat source, and
    assumes that both surfaces have the same temperature in the contact.

    Examples
    --------
    >>> import numpy as np
    >>> ones = np.ones(3)
    >>> round(share_to_pinion(ones, 4.0 * ones, ones, np.arange(3.0)), 3)
    0.667
    """
    total = float(np.trapezoid(heat, position))
    if total == 0.0:
        return 0.5
    root_1, root_2 = np.sqrt(speed_1), effusivity_ratio * np.sqrt(speed_2)
    return float(np.trapezoid(heat * root_1 / (root_1 + root_2), position)) / total


def windage(pitch_line_velocity: float, diameter: float, face_width: float, module: float, speed: float) -> float:
    """Windage of one gear by Mauz, the lowest of three published formulas [W] (Eq. H8).

    The torque is 1.37e-9 v^1.9 d^1.6 b^0.52 m_n^0.69 N m, with lengths in mm.
    """
    sizes = (diameter * 1e3) ** 1.6 * (face_width * 1e3) ** 0.52 * (module * 1e3) ** 0.69
    return float(1.37e-9 * pitch_line_velocity**1.9 * sizes * speed)


def acceleration_power(oil: CoolingOil, flow: float, velocity: float, jet: float) -> float:
    """Power that the teeth give to the oil that hits them, rho Q v (v - v_jet) [W] (Eq. H9).

    `flow` [m^3/s] hits the teeth; `jet` [m/s] is positive into the mesh. The power is negative if the jets are faster
    than the teeth and drive them. Together with the power of the jets, each kilogram of this oil is heated by
    v (v - v_jet) + v_jet^2/2: by (v - v_jet)^2/2 at the impact, and by v^2/2 where the casing stops the oil.
    """
    return oil.density * flow * velocity * (velocity - jet)


def jet_power(oil: CoolingOil, flow: float, jet: float) -> float:
    """Power of the jets, rho Q v_jet^2/2 [W] (Eq. H9); the oil pump supplies it, not the gears."""
    return oil.density * flow * jet**2 / 2


def impact_rise(oil: CoolingOil, velocity: float, jet: float) -> float:
    """Temperature rise of the oil by its impact on the teeth, (v - v_jet)^2/(2 c) [K] (Eq. H10)."""
    return (velocity - jet) ** 2 / (2 * oil.specific_heat)


def flow_by_rise(oil: CoolingOil, losses: float, rise: float) -> float:
    """Oil flow to the gears that `losses` [W] warm by `rise` [K], Q = P/(rho c dT) [m^3/s] (Eq. H11)."""
    return losses / (oil.heat_capacity * rise)


def ts_6336_22_bulk_rise(loss: float, centre_distance: float, face_width: float, supply_factor: float) -> float:
    """Bulk over oil temperature by ISO/TS 6336-22, without tip relief [K] (Eq. H13).

    7400 (P mu H_v/(a b))^0.72 X_S/1.2, with the loss in kW and lengths in mm.
    """
    return float(7400 * (loss * 1e-3 / (centre_distance * face_width * 1e6)) ** 0.72 * supply_factor / 1.2)
