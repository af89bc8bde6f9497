"""Former input classes, with the fields of a request to the service. The next minor version removes these classes.

Use `Coupling`, `Operation` and `Lubricant` instead. `Coupling` has defaults for its proportions. `Operation` contains
the tilt; `tilt_of_offset` computes the tilt from a parallel offset. `Lubricant` contains the viscosity at the teeth;
`OilSheet.viscosity` computes this viscosity for an oil that is given by its grade or data sheet.
"""

from dataclasses import fields

from solvers.coupling.inputs import Arrangement, Coupling, Lubricant, Operation, tilt_of_offset
from solvers.errors import InvalidInput
from solvers.former_oils import OilBySheet
from solvers.oils import CELSIUS
from solvers.quantity import described, record


@record
class CouplingDesign(Coupling):
    """Former name of `Coupling`."""

    def coupling(self) -> Coupling:
        """Return a `Coupling` with the values of this design."""
        return Coupling(**{item.name: getattr(self, item.name) for item in fields(Coupling)})


@record
class Load:
    """Former class with all fields of `Operation` except the misalignment."""

    torque: float = described("Transmitted torque [N m].")
    speed: float = described("Speed; the sign is the sense of rotation [rad/s].")
    axial_velocity: float = described(
        "Axial speed of the hub against the sleeve; positive: the shafts move apart [m/s].", default=0.0
    )
    arrangement: Arrangement = described(
        "One mesh, two with a parallel offset, or two with an angle.", default="single"
    )
    shaft_diameter: float | None = described(
        "Shaft diameter of the customary thrust; None: no customary thrust [m].", default=None
    )

    def at(self, misalignment: float) -> Operation:
        """Return this load as an `Operation` with the given misalignment [rad]."""
        return Operation(**{item.name: getattr(self, item.name) for item in fields(Load)}, misalignment=misalignment)


@record
class OperatingPoint(Load):
    """Former version of `Operation`; the offset of the shafts may be given instead of the tilt."""

    misalignment: float | None = described(
        "Tilt of the hub against the sleeve; None: by the parallel offset [rad].", default=None
    )
    parallel_offset: float | None = described("Parallel offset of the shafts, used without a tilt [m].", default=None)

    def operation(self, hub_distance: float) -> Operation:
        """Return this operating point as an `Operation`; `hub_distance` [m] is the distance between the tooth planes.

        Raises InvalidInput (`misalignment_or_offset`) if both the misalignment and the parallel offset are None.
        """
        if self.misalignment is not None:
            return self.at(self.misalignment)
        if self.parallel_offset is None:
            raise InvalidInput("misalignment_or_offset", "give misalignment or parallel_offset", "misalignment")
        return self.at(tilt_of_offset(self.parallel_offset, hub_distance))


@record
class OperatingRange(Load):
    """Former class of an operating point with a range of misalignment.

    Use `Operation` and `RecommendationInputs` instead.
    """

    misalignment_range: tuple[float, float] = described("Smallest and largest tilt of the hub [rad].", kw_only=True)

    def operation(self) -> Operation:
        """Return this operating range as an `Operation` at the smallest misalignment."""
        return self.at(self.misalignment_range[0])


@record
class CouplingOil(OilBySheet):
    """Former class of an oil that is given by its viscosity, grade or data sheet.

    Use `Lubricant` instead; `OilSheet.viscosity` computes the viscosity of an oil that is given by grade or data sheet.
    """

    viscosity: float | None = described(
        "Viscosity at the teeth; not used with a grade or data sheet [Pa s].", default=0.025
    )
    temperature: float = described(
        "Temperature at which a grade or data sheet gives the viscosity [K].", default=50.0 + CELSIUS
    )
    reference_film: float = described("Film thickness at which the load capacity is stated [m].", default=1e-6)

    def lubricant(self) -> Lubricant:
        """Return the oil at the teeth; a grade or data sheet takes precedence over the viscosity.

        Raises InvalidInput (`missing_property`) if neither viscosity, grade nor data sheet is given.
        """
        if sheet := self.sheet():
            viscosity = sheet.viscosity(self.temperature)
            return Lubricant(viscosity, self.reference_film, sheet.viscosity_index, self.temperature)
        if self.viscosity is None:
            message = "give the viscosity, or describe the oil by its grade or data sheet"
            raise InvalidInput("missing_property", message, "lubricant.viscosity")
        return Lubricant(self.viscosity, self.reference_film)
