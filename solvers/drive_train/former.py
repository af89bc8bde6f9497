"""A former name, which leaves with the next minor version: a bearing that had the fields of a request."""

from dataclasses import dataclass
from typing import Literal

from solvers.drive_train.inputs import (
    Bearing,
    JournalBearing,
    LinearBearing,
    RigidBearing,
    Vector2,
    gear_oil_viscosity,
)
from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant
from solvers.oils import OilSheet


@dataclass(frozen=True)
class ShaftBearing:
    """Now `JournalBearing`, `LinearBearing` or `RigidBearing`."""

    position: float
    type: Literal["journal", "linear", "rigid"] = "journal"
    offset: Vector2 = (0.0, 0.0)
    diameter: float | None = None
    width: float | None = None
    radial_clearance: float | None = None
    viscosity: float | None = None
    film_temperature: float | None = None
    oil_flow: float | None = None
    stiffness: tuple[Vector2, Vector2] | None = None

    def bearing(self, oil: OilSheet | Lubricant | None, oil_temperature: float) -> Bearing:
        """Return the bearing in the form that the model uses.

        Parameters
        ----------
        oil : OilSheet, Lubricant or None
            Oil of the gears, in which a bearing without a viscosity of its own runs.
        oil_temperature : float
            Temperature of the gears' oil [K].

        Returns
        -------
        JournalBearing, LinearBearing or RigidBearing
            The bearing.

        Raises
        ------
        InvalidInput
            `no_oil` if a plain bearing has neither a viscosity nor an oil, `bearing_data` if data of its type are
            missing.
        """
        if self.type == "rigid":
            return RigidBearing(self.position, offset=self.offset)
        if self.type == "linear":
            if self.stiffness is None:
                raise InvalidInput("bearing_data", "A linear bearing needs its stiffness", "stiffness")
            return LinearBearing(self.position, self.stiffness, offset=self.offset)
        if self.diameter is None or self.width is None:
            missing = "diameter" if self.diameter is None else "width"
            raise InvalidInput("bearing_data", "A journal bearing needs diameter and width", missing)
        viscosity = self.viscosity
        if viscosity is None:
            if oil is None:
                message = "a plain bearing needs a viscosity if the gears have no oil; give the viscosity or the oil"
                raise InvalidInput("no_oil", message, "viscosity")
            viscosity = gear_oil_viscosity(oil, oil_temperature, self.film_temperature)
        return JournalBearing(
            self.position,
            self.diameter,
            self.width,
            viscosity,
            self.radial_clearance,
            offset=self.offset,
            in_gear_oil=self.viscosity is None and self.film_temperature is None,
            oil_flow=self.oil_flow,
        )
