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
        """Return the bearing; without a viscosity of its own it runs in the gears' oil, at a temperature [K].

        Raises InvalidInput no_oil where there is none, bearing_data where data of its type are missing.
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
                raise InvalidInput("no_oil", "without an oil of the gears a plain bearing needs its own", "viscosity")
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
