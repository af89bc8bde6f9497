"""Requests of the pumping calculations: /v1/pumping and /v1/pumping/choking-speed."""

from typing import Annotated, Any

from app.models.sections.gears import PumpingGears
from app.schema.model import Request, Section
from app.schema.quantities import Input
from solvers.pumping import inputs as si

AXIAL_SPEED_ONLY = (
    "the stagnation temperature includes only the axial speed. Air that is drawn in from rest meets a tooth at the "
    "pitch-line speed U, which adds up to U²/(2 c_p) to the recovery temperature"
)


class GearGroove(Section, of=si.Groove):
    """A circumferential groove of full tooth depth."""


class PumpingOperation(Section, of=si.PumpingInputs):
    """Operating point: the speed of the pinion."""


class Mist(Section, of=si.Ambient):
    """The air and oil mist around the mesh, modelled as a perfect gas."""


class PumpingOptions(Section, of=si.PumpingModel):
    """Choices that the paper leaves open in the pumping model."""

    def unused(self) -> dict[str, bool]:
        return super().unused() | {
            "closure": self.flow != "pocket_chain",
            "wall_transport": self.flow != "gas_dynamics" or self.gap != "contact",
            "slices": self.flow == "incompressible",
        }


class _PumpingSetup(Request, of=si.PumpingSetup, without=("normal_backlash",)):
    """The parts that the requests of both pumping calculations have in common."""

    gears: PumpingGears

    def options(self) -> dict[str, Any]:
        """Return the model options, with the number of slices that the calculation uses."""
        return super().options() | {"slices": self.model.si(si.PumpingModel).slice_count}

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumption that only the axial speed contributes to the stagnation temperature."""
        widths = self.gears.assumed_widths()
        return widths if self.model.flow == "incompressible" else widths | {"model.flow": AXIAL_SPEED_ONLY}


class PumpingRequest(_PumpingSetup):
    """A gear pair that pumps the mist around the mesh, at one speed."""

    operation: Annotated[PumpingOperation, Input("operating point")]

    def inputs(self) -> si.PumpingInputs:
        return self.operation.si(si.PumpingInputs, setup=self.si(si.PumpingSetup, self.gears))


class ChokingSpeedRequest(_PumpingSetup, of=si.ChokingInputs):
    """A gear pair for which the choking speeds are sought."""

    def inputs(self) -> si.ChokingInputs:
        return self.si(si.ChokingInputs, setup=self.si(si.PumpingSetup, self.gears))
