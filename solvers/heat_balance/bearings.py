"""Friction and oil flow of the plain bearings in the heat balance."""

from collections.abc import Callable

from solvers.quantity import described, record


def journal_leakage(surface_speed: float, width: float, clearance: float, eccentricity: float) -> float:
    """Compute the oil flow that leaves a plain bearing at the sides.

    Parameters
    ----------
    surface_speed : float
        Speed of the journal's surface [m/s].
    width : float
        Width of the bearing [m].
    clearance : float
        Radial clearance [m].
    eccentricity : float
        Eccentricity ratio [-].

    Returns
    -------
    float
        Flow [m^3/s].

    Notes
    -----
    Eq. H12: U L c eps. This is the Couette flow into the half of the bearing that carries load, minus the Couette flow
    out of this half.
    """
    return surface_speed * width * clearance * eccentricity


Operation = Callable[[float], tuple[float, float]]
"""Function of the film viscosity [Pa s] that returns friction power [W] and eccentricity ratio of a plain bearing."""


@record
class Journal:
    """A plain bearing under its load."""

    gear: int = described("Gear on whose shaft the bearing sits: 0 pinion, 1 wheel.")
    diameter: float = described("Diameter of the journal [m].")
    width: float = described("Width of the bearing [m].")
    clearance: float = described("Radial clearance [m].")
    speed: float = described("Speed of the shaft, positive [rad/s].")
    shaft_conductance: float = described("Thermal conductance from the body of the gear to the journal [W/K].")
    operate: Operation = described("Function that returns friction power and eccentricity ratio at a film viscosity.")
    oil_flow: float | None = described("Oil flow; None: the leakage of the bearing [m^3/s].", default=None)
    feed: float | None = described("Temperature of the entering oil; None: the supply of the gears [K].", default=None)

    @property
    def surface_speed(self) -> float:
        """Speed of the journal's surface [m/s]."""
        return self.speed * self.diameter / 2

    def loss_and_flow(self, viscosity: float) -> tuple[float, float]:
        """Return the friction power [W] and the oil flow [m^3/s] at a viscosity of the film [Pa s]."""
        power, eccentricity = self.operate(viscosity)
        if self.oil_flow is not None:
            return power, self.oil_flow
        return power, journal_leakage(self.surface_speed, self.width, self.clearance, eccentricity)
