"""Former names, which leave with the next minor version: inputs that had the sections of a request.

`Coupling` fills in its proportions itself. `Operation` has the tilt, which `tilt_of_offset` computes from a parallel
offset. `Lubricant` has the viscosity at the teeth; `OilSheet.viscosity` is that of an oil by grade or data sheet.
"""

from dataclasses import dataclass, fields

from solvers.coupling.inputs import Arrangement, Coupling, Lubricant, Operation, tilt_of_offset
from solvers.errors import InvalidInput
from solvers.former_oils import OilBySheet
from solvers.oils import CELSIUS
from solvers.quantity import record


@record
class CouplingDesign(Coupling):
    """Now `Coupling`."""

    def coupling(self) -> Coupling:
        """Return the coupling."""
        return Coupling(**{each.name: getattr(self, each.name) for each in fields(Coupling)})


@dataclass(frozen=True)
class Load:
    """Now part of `Operation`."""

    torque: float
    speed: float
    axial_velocity: float = 0.0
    arrangement: Arrangement = "single"
    shaft_diameter: float | None = None

    def at(self, misalignment: float) -> Operation:
        """Return the operating point with this tilt [rad]."""
        return Operation(**{each.name: getattr(self, each.name) for each in fields(Load)}, misalignment=misalignment)


@dataclass(frozen=True)
class OperatingPoint(Load):
    """Now `Operation`."""

    misalignment: float | None = None
    parallel_offset: float | None = None

    def operation(self, hub_distance: float) -> Operation:
        """Return the operating point; `hub_distance` [m] lies between the tooth planes."""
        if self.misalignment is not None:
            return self.at(self.misalignment)
        if self.parallel_offset is None:
            raise InvalidInput("misalignment_or_offset", "give misalignment or parallel_offset", "misalignment")
        return self.at(tilt_of_offset(self.parallel_offset, hub_distance))


@dataclass(frozen=True, kw_only=True)
class OperatingRange(Load):
    """Now `Operation` beside the ends of the range in `RecommendationInputs`."""

    misalignment_range: tuple[float, float]

    def operation(self) -> Operation:
        """Return the operating point at the smallest misalignment."""
        return self.at(self.misalignment_range[0])


@dataclass(frozen=True)
class CouplingOil(OilBySheet):
    """Now `Lubricant`, with the viscosity of an `OilSheet`."""

    viscosity: float | None = 0.025
    temperature: float = 50.0 + CELSIUS
    reference_film: float = 1e-6

    def lubricant(self) -> Lubricant:
        """Return the oil at the teeth; grade or data sheet count before the viscosity."""
        if sheet := self.sheet():
            viscosity = sheet.viscosity(self.temperature)
            return Lubricant(viscosity, self.reference_film, sheet.viscosity_index, self.temperature)
        if self.viscosity is None:
            message = "give viscosity, or the oil by its grade or data sheet"
            raise InvalidInput("missing_property", message, "lubricant.viscosity")
        return Lubricant(self.viscosity, self.reference_film)
