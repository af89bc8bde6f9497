"""The former class for bearings of any type. This class has the fields that a bearing has in a request.

The next minor version removes this class.
"""

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
from solvers.quantity import described, record


@record
class ShaftBearing:
    """Former class for bearings of any type, replaced by `JournalBearing`, `LinearBearing` and `RigidBearing`."""

    position: float = described("Position along the Z of the unit [m].")
    type: Literal["journal", "linear", "rigid"] = described("Type of the bearing.", default="journal")
    offset: Vector2 = described("Offset (X, Y) of the bore from the datum axis [m].", default=(0.0, 0.0))
    diameter: float | None = described("Diameter of the journal, required of a plain bearing [m].", default=None)
    width: float | None = described("Width, required of a plain bearing [m].", default=None)
    radial_clearance: float | None = described(
        "Radial clearance; None: 1.5e-3 of the radius of the journal [m].", default=None
    )
    viscosity: float | None = described(
        "Viscosity of the oil in the film; None: the viscosity of the gears' oil at the film temperature [Pa s].",
        default=None,
    )
    film_temperature: float | None = described(
        "Temperature of the film; None: 15 K above the temperature of the gears' oil [K].", default=None
    )
    oil_flow: float | None = described(
        "Oil flow in a heat balance; None: the leakage at the sides [m^3/s].", default=None
    )
    stiffness: tuple[Vector2, Vector2] | None = described(
        "Stiffness ((xx, xy), (yx, yy)), required of a linear bearing [N/m].", default=None
    )

    def bearing(self, oil: OilSheet | Lubricant | None, oil_temperature: float) -> Bearing:
        """Return the bearing in the form that the model uses.

        Parameters
        ----------
        oil : OilSheet, Lubricant or None
            Oil of the gears. A plain bearing whose viscosity is not given runs in this oil.
        oil_temperature : float
            Temperature of the gears' oil [K].

        Returns
        -------
        JournalBearing, LinearBearing or RigidBearing
            The bearing.

        Raises
        ------
        InvalidInput
            `no_oil` if a plain bearing has neither a viscosity nor an oil; `bearing_data` if the type of the bearing
            requires data that are missing.
        """
        if self.type == "rigid":
            return RigidBearing(self.position, offset=self.offset)
        if self.type == "linear":
            if self.stiffness is None:
                raise InvalidInput("bearing_data", "A linear bearing needs a stiffness", "stiffness")
            return LinearBearing(self.position, self.stiffness, offset=self.offset)
        if self.diameter is None or self.width is None:
            missing = "diameter" if self.diameter is None else "width"
            raise InvalidInput("bearing_data", "A journal bearing needs a diameter and a width", missing)
        viscosity = self.viscosity
        if viscosity is None:
            if oil is None:
                message = (
                    "a plain bearing needs a viscosity if the gears have no oil; give a viscosity at the bearing, or "
                    "give an oil for the gears"
                )
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
