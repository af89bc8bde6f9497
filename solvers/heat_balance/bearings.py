"""Friction and oil flow of the plain bearings in the heat balance."""

from collections.abc import Callable

from solvers.quantity import described, record

Operation = Callable[[float], tuple[float, float]]
"""Friction power [W] and side leakage [m^3/s] of a plain bearing over the viscosity of its film [Pa s]."""


@record
class Journal:
    """A plain bearing under its load."""

    gear: int = described("Gear on whose shaft the bearing sits: 0 pinion, 1 wheel.")
    diameter: float = described("Diameter of the journal [m].")
    clearance: float = described("Radial clearance [m].")
    speed: float = described("Speed of the shaft, positive [rad/s].")
    shaft_conductance: float = described("Thermal conductance from the body of the gear to the journal [W/K].")
    operate: Operation = described("Function that returns friction power and side leakage at a film viscosity.")
    oil_flow: float | None = described("Oil flow; None: the leakage of the bearing [m^3/s].", default=None)
    feed: float | None = described("Temperature of the entering oil; None: the supply of the gears [K].", default=None)

    @property
    def surface_speed(self) -> float:
        """Speed of the journal's surface [m/s]."""
        return self.speed * self.diameter / 2

    def loss_and_flow(self, viscosity: float) -> tuple[float, float]:
        """Return the friction power [W] and the oil flow [m^3/s] at a viscosity of the film [Pa s]."""
        power, leakage = self.operate(viscosity)
        return power, leakage if self.oil_flow is None else self.oil_flow
