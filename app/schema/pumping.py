"""Requests and answers of the pumping calculations: /v1/pumping and /v1/pumping/choking-speed."""

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
    """Operating point: the speed of the pinion."""


class Mist(Section, of=si.Ambient):
    """The air and oil mist around the mesh, modelled as a perfect gas."""


class PumpingOptions(Section, of=si.PumpingModel):
    """Choices that the paper leaves open in the pumping model."""

    def unused(self) -> dict[str, bool]:
        """Mark the options that the chosen flow model does not use.

        Only the pocket chain uses `closure`. Only gas dynamics uses `wall_transport`, and only if `gap` is `contact`.
        The incompressible model does not use `slices`.
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
        """Return the model options, with the number of slices that the calculation uses."""
        return super().options() | {"slices": self.model.si(si.PumpingModel).slice_count}

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumption that only the axial speed contributes to the stagnation temperature.

        For the incompressible model, return no assumption.
        """
        return {} if self.model.flow == "incompressible" else {"model.flow": AXIAL_SPEED_ONLY}


class PumpingRequest(_PumpingSetup):
    """A gear pair that pumps the mist around the mesh, at one speed."""

    operation: Annotated[PumpingOperation, Input("operating point")]

    def inputs(self) -> si.PumpingInputs:
        return self.operation.si(si.PumpingInputs, setup=self.si(si.PumpingSetup, self.gears))


class ChokingSpeedRequest(_PumpingSetup, of=si.ChokingInputs):
    """A gear pair for which the choking speeds are sought."""

    def inputs(self) -> si.ChokingInputs:
        return self.si(si.ChokingInputs, setup=self.si(si.PumpingSetup, self.gears))


class PumpingMassFlow(Group, of=results.MassFlow):
    """Mass flow out of the tooth spaces of one gear.

    `front`, `rear`, `radial`, `grooves` and `reset` are net flows that add up to zero. `reset` belongs to no exit. It
    is the gas that slices lose when ambient gas replaces their content between two strokes, and the gas that flows to
    slices outside their stroke. Fields that end in `_out` and `_in` are the outflow and the inflow at each end of the
    face. Fields that end in `_uncertainty` are uncertainties of net flows.
    """

    member_unit: ClassVar = "g_per_s"


class StrokeCurves(Group, of=stroke.StrokeTable):
    """Area of a tooth space, and clearances at its two flanks, over one stroke."""


class PumpingStroke(Group, of=results.Stroke):
    """One stroke of a tooth space.

    Angles are angles of the gear to which the space belongs. They are measured from the line of centres.
    """


class PumpingBalance(Group, of=results.Balance):
    """Relative errors of the balances of mass and energy."""


class PumpingProfile(Group, of=results.FaceProfile):
    """Temperature rises and peak pressures along the face; there are no values inside the grooves."""


class PumpingField(Group, of=results.GasField):
    """Fields of the gas over the angle of the gear and the position along the face, indexed [angle][position]."""

    views: ClassVar = {"axial_mach": View(limit=1.0)}


class PumpingEnd(Group, of=results.EndOfFace):
    """Mach numbers of outflow and inflow at an end of the face."""


class PumpingChoking(Group, of=results.Choking):
    """Whether the flow becomes sonic at the ends of the face and at the radial clearances."""


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
    """Results for all selected tooth spaces together."""

    views: ClassVar = {"pumping_power": View(headline=1)}


class LeadCurves(Group, of=lead_correction.LeadCurves):
    """Thermal growth of the pinion, and lead correction of the pinion, along the face."""


class PumpingLeadCorrection(Group, of=lead_correction.LeadCorrection):
    """The lead correction that compensates for the thermal growth of the pinion.

    The growth is computed as if the metal warmed as much as the gas.
    """


class PumpingPulsation(Group, of=pulsation.Pulsation):
    """Amplitudes of the mass flow at both ends of the face, at multiples of the meshing frequency."""


class PumpingResolution(Group, of=results.Resolution):
    """Relative uncertainties of the results due to the limited resolution.

    The resolution is the number of slices in gas dynamics, of steps in the pocket chain, and of positions in the
    incompressible model. The results are also computed with a half and with a quarter of this number. The
    uncertainties follow from the differences.
    """


class ChokingCurves(Group, of=results.ChokingCurves):
    """Results of a coarse scan of the pinion speed.

    Pressure ratio and Mach numbers are the largest values among the selected tooth spaces at each speed.
    """

    views: ClassVar = {"exit_mach": View(limit=1.0), "inflow_mach": View(limit=1.0)}


class PumpingDerived(Derived, of=results.Derived):
    """The values used for the centre distance, the number of slices and the tip radius of the rack."""


class PumpingResponse(Response, of=results.PumpingResult):
    """Results of pumping at one operating point.

    If there is no solution, the sections with results are missing.
    """


class ChokingSpeedResponse(Response, of=results.ChokingSpeeds):
    """The lowest pinion speeds at which the flow becomes sonic in any of the selected tooth spaces."""

    views: ClassVar = {
        "radial_choking_speed": View(headline=1, limit="search_limit_rpm"),
        "axial_choking_speed": View(headline=2, limit="search_limit_rpm"),
        "inflow_choking_speed": View(headline=3, limit="search_limit_rpm"),
    }
