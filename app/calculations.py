"""The table of calculations. Each row describes one endpoint and names the solver of this endpoint."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from app.figures.declaration import Declaration
from app.figures.models import coupling as coupling_figures
from app.figures.models import drive_train as drive_train_figures
from app.figures.models import line_contact as line_contact_figures
from app.figures.models import load_distribution as load_figures
from app.figures.models import pumping as pumping_figures
from app.figures.models import scuffing as scuffing_figures
from app.figures.models import warm_up as warm_up_figures
from app.schema import coupling as coupling_schema
from app.schema import drive_train as drive_train_schema
from app.schema import line_contact as line_contact_schema
from app.schema import pumping as pumping_schema
from app.schema import scuffing as scuffing_schema
from app.schema.model import Request, Response
from solvers import coupling, drive_train, pumping, scuffing
from solvers.contact import ehl
from solvers.contact.ehl.continuation import Resolution, price


class Cost(NamedTuple):
    """Estimated time of a calculation on one core [s], and the request field on which this time depends.

    If the time is too long, the user should reduce the value of this field.
    """

    seconds: float
    field: str


@dataclass(frozen=True, slots=True)
class Stage:
    """A group of kernels (functions compiled by numba) that are compiled and loaded together.

    Requests that need these kernels are answered after the stage is ready. Together, the `examples` call all kernels
    that these requests need, except those of the stages in `after`. `kernels` is the approximate number of kernels in
    the stage. `model` has model options that replace those of the examples.
    """

    name: str
    kernels: int
    examples: tuple[str, ...]
    after: tuple["Stage", ...] = ()
    model: tuple[tuple[str, str], ...] = ()

    @property
    def all(self) -> frozenset["Stage"]:
        """The stage itself and all stages that it builds on."""
        return frozenset((self,)).union(*(stage.all for stage in self.after))


class Further(NamedTuple):
    """A stage that a request needs only if a field has none of the values in `spared`; None: the field is left out."""

    stage: Stage
    field: str
    spared: tuple[str | None, ...]


@dataclass(frozen=True, slots=True)
class Calculation:
    """One endpoint.

    Requests need the kernels of its `stage`, and some need a `further` stage. `figures` are the figures that show the
    answers. `cost` estimates the time of a request. `cost` is None if no permissible request takes too long.
    `sized_flow` returns the oil flow that the calculation sizes for its inputs [m^3/s], None if it sizes none.
    """

    path: str
    title: str
    summary: str
    source: str
    request: type[Request]
    solve: Callable[[Any], Any]
    response: type[Response]
    stage: Stage
    figures: tuple[Declaration, ...] = ()
    cost: Callable[[Any], Cost] | None = None
    sized_flow: Callable[[Any], float | None] | None = None
    further: Further | None = None

    def stages(self, value_of: Callable[[str], Any] | None = None) -> frozenset[Stage]:
        """Return the stages that a request needs. `value_of` returns the value of a field; None: any request."""
        further = self.further
        if further is None or (value_of is not None and value_of(further.field) in further.spared):
            return self.stage.all
        return self.stage.all | further.stage.all


def _thermal_path(request: Any) -> Cost:
    """Estimate the time to solve the contacts along the path of contact.

    A contact with 121 x 21 nodes takes 4 to 8 ms. A contact with a Newtonian film takes up to 20 ms. The estimate uses
    the shortest of these times, so that the service does not reject a request that could finish in time.
    """
    model = request.model
    if model.lubrication == "closed_form":
        return Cost(0.0, "model.path_points")
    film = Resolution(gap=0.0, entry_temperature=0.0, nodes=model.nodes, film_nodes=model.film_nodes, thermal=True)
    return Cost(4e-3 * model.path_points * price(film, model.nodes), "model.path_points")


def _checked_lines(request: Any) -> Cost:
    """Estimate the time to solve the contacts of a scuffing check.

    The contacts are solved along the feature line (the diagonal from A1 to E2). If the whole flank is checked, the
    contacts are also solved along the profile line through the hottest place of the flank, and at a few places.
    """
    path = _thermal_path(request)
    return Cost((2 if request.model.line == "flank" else 1) * path.seconds, path.field)


def _unit_states(request: Any) -> Cost:
    """Estimate the time to solve the contacts of a gear unit in all requested states.

    In each state (hot or cold) the contacts are solved along the feature line and at a few places of the flank.
    """
    path = _thermal_path(request)
    return Cost(len({*request.states}) * path.seconds, path.field)


def _choking_search(request: Any) -> Cost:
    """Estimate the time of the search for choking speeds with the pocket-chain model.

    For the tooth spaces of both gears, the search took 0.7, 2.6, 6.2 and 16 s with 10, 40, 80 and 160 pockets. The
    gas-dynamics model needs no estimate, because this model itself limits the number of its steps.
    """
    pockets = request.model.slices or 0
    if request.model.flow != "pocket_chain":
        return Cost(0.0, "model.slices")
    return Cost(0.05 * pockets + 3e-4 * pockets**2, "model.slices")


CLOSED_FORM = (("lubrication", "closed_form"),)

# The numbers of kernels were counted at a start from an empty cache.
COUPLING = Stage("coupling", 8, ("pahl-axial-displacement",))
LOADS = Stage("load distribution", 86, ("fzg-type-a",))
SCUFFING = Stage(
    "scuffing", 10, ("xue-pair-1-scuffing", "starter-industrial-micropitting", "starter-turbo-pair-heat"),
    (LOADS,), CLOSED_FORM,
)  # fmt: skip
PUMPING = Stage("pumping", 71, ("milian-case-1",))
SLEEVE = Stage("coupling sleeve", 14, ("pahl-sleeve-orbit", "pahl-z-arrangement"), (COUPLING,))
DRIVE_TRAIN = Stage(
    "drive train", 20, ("starter-turbo-gear-drive-train", "starter-turbo-gear-heat"), (SCUFFING, PUMPING, SLEEVE),
    CLOSED_FORM,
)  # fmt: skip
POCKET_CHAIN = Stage("pocket chain", 32, ("milian-case-1-pocket-chain",), (PUMPING,))
LINE_CONTACT = Stage(
    "line contact", 108, ("xue-line-contact", "xue-line-contact-isothermal", "xue-pair-1-thermal"), (SCUFFING,)
)
THERMAL = Further(LINE_CONTACT, "model.lubrication", ("closed_form",))
CHAIN = Further(POCKET_CHAIN, "model.flow", (None, "gas_dynamics", "incompressible"))

STAGES = (COUPLING, LOADS, SCUFFING, PUMPING, SLEEVE, DRIVE_TRAIN, POCKET_CHAIN, LINE_CONTACT)
"""The stages in the order in which a single process compiles them."""

CALCULATIONS = (
    Calculation(
        path="/v1/coupling",
        title="Gear coupling",
        summary="Load, lubrication, friction, axial thrust and losses of a gear coupling",
        source="Pahl 1978",
        request=coupling_schema.CouplingRequest,
        solve=coupling.solve,
        response=coupling_schema.CouplingResponse,
        stage=COUPLING,
        figures=coupling_figures.FIGURES,
    ),
    Calculation(
        path="/v1/coupling/sleeve-orbit",
        title="Sleeve orbit",
        summary="Path and inertia force of a floating sleeve over one revolution",
        source="Pahl 1978, Fig. 5",
        request=coupling_schema.SleeveOrbitRequest,
        solve=coupling.solve_orbit,
        response=coupling_schema.SleeveOrbitResponse,
        stage=SLEEVE,
        figures=coupling_figures.ORBIT_FIGURES,
    ),
    Calculation(
        path="/v1/coupling/recommendation",
        title="Crowning recommendation",
        summary="The crowning with the best film over a range of misalignment",
        source="Pahl 1978, conclusion",
        request=coupling_schema.RecommendationRequest,
        solve=coupling.recommend,
        response=coupling_schema.RecommendationResponse,
        stage=SLEEVE,
        figures=coupling_figures.RECOMMENDATION_FIGURES,
    ),
    Calculation(
        path="/v1/pumping",
        title="Pumping between gear teeth",
        summary="Air and mist pumped between the teeth: pressure, heating, power, mass flow, lead correction",
        source="Milian, Distretti, Leoni, Velex 2004",
        request=pumping_schema.PumpingRequest,
        solve=pumping.solve,
        response=pumping_schema.PumpingResponse,
        stage=PUMPING,
        further=CHAIN,
        figures=pumping_figures.FIGURES,
    ),
    Calculation(
        path="/v1/pumping/choking-speed",
        title="Choking speed",
        summary="Speeds at which the flow out of the tooth spaces becomes sonic",
        source="Milian, Distretti, Leoni, Velex 2004, Eq. 7",
        request=pumping_schema.ChokingSpeedRequest,
        solve=pumping.choking_speeds,
        response=pumping_schema.ChokingSpeedResponse,
        stage=PUMPING,
        further=CHAIN,
        figures=pumping_figures.CHOKING_FIGURES,
        cost=_choking_search,
    ),
    Calculation(
        path="/v1/scuffing/load-distribution",
        title="Load distribution",
        summary="Load, pressure, transmission error and loss of a modified gear pair",
        source="Xue, Zhang, Wang 2020, section II",
        request=scuffing_schema.LoadDistributionRequest,
        solve=scuffing.solve_load_distribution,
        response=scuffing_schema.LoadDistributionResponse,
        stage=LOADS,
        figures=load_figures.FIGURES,
    ),
    Calculation(
        path="/v1/scuffing",
        title="Scuffing of gears",
        summary="Load distribution, flash temperature, film thickness and scuffing safety factor of a gear pair",
        source="Xue, Zhang, Wang 2020",
        request=scuffing_schema.ScuffingRequest,
        solve=scuffing.solve_scuffing,
        response=scuffing_schema.ScuffingResponse,
        stage=SCUFFING,
        further=THERMAL,
        figures=scuffing_figures.FIGURES,
        cost=_checked_lines,
        sized_flow=scuffing.sized_flow,
    ),
    Calculation(
        path="/v1/scuffing/line-contact",
        title="Line contact",
        summary="Film, pressure, temperature and friction of one thermal elastohydrodynamic line contact",
        source="Xue, Zhang, Wang 2020, sections III and IV",
        request=line_contact_schema.LineContactRequest,
        solve=ehl.solve,
        response=line_contact_schema.LineContactResponse,
        stage=LINE_CONTACT,
        figures=line_contact_figures.FIGURES,
    ),
    Calculation(
        path="/v1/drive-train",
        title="Drive train",
        summary="A complete gear unit: couplings, shafts in bearings, pumped heat, load along the face and scuffing",
        source="own derivation on Pahl 1978, Milian 2004 and Xue 2020",
        request=drive_train_schema.DriveTrainRequest,
        solve=drive_train.solve,
        response=drive_train_schema.DriveTrainResponse,
        stage=DRIVE_TRAIN,
        further=THERMAL,
        figures=drive_train_figures.FIGURES,
        cost=_unit_states,
        sized_flow=drive_train.sized_flow,
    ),
    Calculation(
        path="/v1/drive-train/warm-up",
        title="Warm-up",
        summary="How a gear unit warms up: temperatures over time, backlash, load on the flanks and scuffing meanwhile",
        source="own derivation, heat balance",
        request=drive_train_schema.WarmUpRequest,
        solve=drive_train.solve_warm_up,
        response=drive_train_schema.WarmUpResponse,
        stage=DRIVE_TRAIN,
        further=THERMAL,
        figures=warm_up_figures.FIGURES,
    ),
)

BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}
