"""Pumping: requests and answers of /v1/pumping and /v1/pumping/choking-speed."""

from typing import Annotated, Any, ClassVar

from app.schema.gears import PumpingGears
from app.schema.model import Derived, Group, Request, Response, Section
from app.schema.quantities import Input, View
from solvers.pumping import inputs as si
from solvers.pumping import lead_correction, pulsation, results
from solvers.pumping.space import stroke

AXIAL_SPEED_ONLY = (
    "the stagnation temperature includes only the axial speed. Air that is drawn in from rest meets a tooth at the "
    "pitch-line speed U, which adds up to U²/(2 c_p) to the recovery temperature"
)


class GearGroove(Section, of=si.Groove):
    """A circumferential groove of full tooth depth."""


class PumpingOperation(Section, of=si.PumpingInputs):
    """Operating point."""


class Mist(Section, of=si.Ambient):
    """The air and oil mist around the mesh, modelled as a perfect gas."""


class PumpingOptions(Section, of=si.PumpingModel):
    """Options of the model at points that the paper leaves open."""

    def unused(self) -> dict[str, bool]:
        """Mark options as unused if the chosen flow model does not have them.

        Only the pocket chain has the closure. Only gas dynamics with contact gaps has the wall transport. The pocket
        chain and gas dynamics have slices.
        """
        return super().unused() | {
            "closure": self.flow != "pocket_chain",
            "wall_transport": self.flow != "gas_dynamics" or self.gap != "contact",
            "slices": self.flow == "incompressible",
        }


class _PumpingSetup(Request, of=si.PumpingSetup, without=("normal_backlash",)):
    """The parts that the requests of both pumping calculations have in common."""

    gears: PumpingGears

    def options(self) -> dict[str, Any]:
        """Return the options of the model section with the number of slices that is used."""
        return super().options() | {"slices": self.model.si(si.PumpingModel).slice_count}

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumption about the speed in the stagnation temperature, except for incompressible flow."""
        return {} if self.model.flow == "incompressible" else {"model.flow": AXIAL_SPEED_ONLY}


class PumpingRequest(_PumpingSetup):
    """A gear pair that pumps the mist around it, at one speed."""

    operation: Annotated[PumpingOperation, Input("operating point")]

    def inputs(self) -> si.PumpingInputs:
        return self.operation.si(si.PumpingInputs, setup=self.si(si.PumpingSetup, self.gears))


class ChokingSpeedRequest(_PumpingSetup, of=si.ChokingInputs):
    """A gear pair whose choking speeds are sought."""

    def inputs(self) -> si.ChokingInputs:
        return self.si(si.ChokingInputs, setup=self.si(si.PumpingSetup, self.gears))


class PumpingMassFlow(Group, of=results.MassFlow):
    """Mass flow out of the tooth spaces of one gear.

    `front`, `rear`, `radial`, `grooves` and `reset` are the net flows through the different exits; they add up to zero.
    The other flows are the outflow and the inflow at each end of the face.
    """

    member_unit: ClassVar = "g_per_s"


class StrokeCurves(Group, of=stroke.StrokeTable):
    """Area and clearances of the tooth space over one stroke."""


class PumpingStroke(Group, of=results.Stroke):
    """One stroke of a tooth space; angles are those of the space's gear, measured from the line of centres."""


class PumpingBalance(Group, of=results.Balance):
    """Relative errors of the balances of mass and energy."""


class PumpingProfile(Group, of=results.FaceProfile):
    """Curves along the face, without the grooves."""


class PumpingField(Group, of=results.GasField):
    """Fields over angle and position, indexed [angle][position]."""

    views: ClassVar = {"axial_mach": View(limit=1.0)}


class PumpingSpaces(Group, of=results.SpacesResult):
    """Results of the tooth spaces of one gear."""

    views: ClassVar = {
        "peak_axial_mach": View(headline=2, limit=1.0, verdict=".axial_choked"),
        "peak_pressure_ratio": View(headline=3, verdict=".radial_choked"),
        "max_temperature_rise": View(headline=4),
    }


class PumpingGeometry(Group, of=results.MeshGeometry):
    """Geometry of the mesh."""


class PumpingTotal(Group, of=results.Totals):
    """Results of all tooth spaces that the request selects."""

    views: ClassVar = {"pumping_power": View(headline=1)}


class LeadCurves(Group, of=lead_correction.LeadCurves):
    """Thermal growth and lead correction along the face of the pinion."""


class PumpingLeadCorrection(Group, of=lead_correction.LeadCorrection):
    """Lead correction of the pinion for its thermal growth, if the metal warms as much as the gas."""


class PumpingPulsation(Group, of=pulsation.Pulsation):
    """Amplitudes of the mass flow at both ends of the face, at multiples of the meshing frequency."""


class PumpingResolution(Group, of=results.Resolution):
    """Relative uncertainties of the results that the resolution causes.

    The uncertainties follow from the changes of the results with half and with a quarter of the slices, steps or
    positions.
    """


class ChokingCurves(Group, of=results.ChokingCurves):
    """Results of a coarse scan of the speed: the largest values over the selected tooth spaces."""

    views: ClassVar = {"exit_mach": View(limit=1.0)}


class PumpingDerived(Derived, of=results.Derived):
    """Centre distance, number of slices and tip radius of the rack, as used."""


class PumpingResponse(Response, of=results.PumpingResult):
    """Results of pumping at one operating point.

    If there is no solution, the sections with results are missing.
    """


class ChokingSpeedResponse(Response, of=results.ChokingSpeeds):
    """The lowest pinion speeds at which the flow becomes sonic in any of the selected tooth spaces."""

    views: ClassVar = {
        "radial_choking_speed": View(headline=1, limit="search_limit_rpm"),
        "axial_choking_speed": View(headline=2, limit="search_limit_rpm"),
    }
