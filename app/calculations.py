"""The one table of what the service calculates: address, request, solver, response."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.schema.base import Request, Response
from app.schema.coupling import (
    CouplingRequest,
    CouplingResponse,
    RecommendationRequest,
    RecommendationResponse,
    SleeveOrbitRequest,
    SleeveOrbitResponse,
)
from app.schema.drive_train import DriveTrainRequest, DriveTrainResponse
from app.schema.line_contact import LineContactRequest, LineContactResponse
from app.schema.load_distribution import LoadDistributionRequest, LoadDistributionResponse
from app.schema.pumping import ChokingSpeedRequest, ChokingSpeedResponse, PumpingRequest, PumpingResponse
from app.schema.scuffing import ScuffingRequest, ScuffingResponse
from solvers import coupling, drive_train, pumping, scuffing
from solvers.contact import ehl


@dataclass(frozen=True, slots=True)
class Calculation:
    """One endpoint."""

    path: str
    title: str
    summary: str
    source: str
    request: type[Request]
    solve: Callable[[Any], Any]
    response: type[Response]


CALCULATIONS = (
    Calculation(
        path="/v1/coupling",
        title="Gear coupling",
        summary="Load, lubrication, friction, axial thrust and losses of a gear coupling",
        source="Pahl 1978",
        request=CouplingRequest,
        solve=coupling.solve,
        response=CouplingResponse,
    ),
    Calculation(
        path="/v1/coupling/sleeve-orbit",
        title="Sleeve orbit",
        summary="Path and inertia force of a floating sleeve over one revolution",
        source="Pahl 1978, Fig. 5",
        request=SleeveOrbitRequest,
        solve=coupling.solve_orbit,
        response=SleeveOrbitResponse,
    ),
    Calculation(
        path="/v1/coupling/recommendation",
        title="Crowning recommendation",
        summary="The crowning with the best film over a range of misalignment",
        source="Pahl 1978, conclusion",
        request=RecommendationRequest,
        solve=coupling.recommend,
        response=RecommendationResponse,
    ),
    Calculation(
        path="/v1/pumping",
        title="Pumping between gear teeth",
        summary="Air and mist pumped between the teeth: pressure, heating, power, mass flow, lead correction",
        source="Milian, Distretti, Leoni, Velex 2004",
        request=PumpingRequest,
        solve=pumping.solve,
        response=PumpingResponse,
    ),
    Calculation(
        path="/v1/pumping/choking-speed",
        title="Choking speed",
        summary="Speeds at which the flow out of the tooth spaces becomes sonic",
        source="Milian, Distretti, Leoni, Velex 2004, Eq. 7",
        request=ChokingSpeedRequest,
        solve=pumping.choking_speeds,
        response=ChokingSpeedResponse,
    ),
    Calculation(
        path="/v1/scuffing/load-distribution",
        title="Load distribution",
        summary="Load, pressure, transmission error and loss of a modified gear pair",
        source="Xue, Zhang, Wang 2020, section II",
        request=LoadDistributionRequest,
        solve=scuffing.solve_load_distribution,
        response=LoadDistributionResponse,
    ),
    Calculation(
        path="/v1/scuffing",
        title="Scuffing of gears",
        summary="Load distribution, flash temperature, film thickness and safety against scuffing of a gear pair",
        source="Xue, Zhang, Wang 2020",
        request=ScuffingRequest,
        solve=scuffing.solve_scuffing,
        response=ScuffingResponse,
    ),
    Calculation(
        path="/v1/scuffing/line-contact",
        title="Line contact",
        summary="Film, pressure, temperature and friction of one thermal elastohydrodynamic line contact",
        source="Xue, Zhang, Wang 2020, sections III and IV",
        request=LineContactRequest,
        solve=ehl.solve,
        response=LineContactResponse,
    ),
    Calculation(
        path="/v1/drive-train",
        title="Drive train",
        summary="A gear unit whole: couplings, shafts in bearings, pumped heat, load along the face and scuffing",
        source="own derivation on Pahl 1978, Milian 2004 and Xue 2020",
        request=DriveTrainRequest,
        solve=drive_train.solve,
        response=DriveTrainResponse,
    ),
)

BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}
