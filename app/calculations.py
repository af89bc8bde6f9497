"""The one table of what the service calculates: address, request, solver, response."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.requests.common import Request
from app.requests.coupling import CouplingRequest, RecommendationRequest
from app.responses.common import Response
from app.responses.coupling import CouplingResponse, RecommendationResponse, SleeveOrbitResponse
from solvers import coupling


@dataclass(frozen=True, slots=True)
class Calculation:
    """One endpoint."""

    path: str
    summary: str
    source: str
    request: type[Request]
    solve: Callable[[Any], Any]
    response: type[Response]


CALCULATIONS = (
    Calculation(
        path="/v1/coupling",
        summary="Load, lubrication, friction, axial thrust and losses of a gear coupling",
        source="Pahl 1978",
        request=CouplingRequest,
        solve=coupling.solve,
        response=CouplingResponse,
    ),
    Calculation(
        path="/v1/coupling/sleeve-orbit",
        summary="Path and inertia force of a floating sleeve over one revolution",
        source="Pahl 1978, Fig. 5",
        request=CouplingRequest,
        solve=coupling.solve_orbit,
        response=SleeveOrbitResponse,
    ),
    Calculation(
        path="/v1/coupling/recommendation",
        summary="The crowning with the best film over a range of misalignment",
        source="Pahl 1978, conclusion",
        request=RecommendationRequest,
        solve=coupling.recommend,
        response=RecommendationResponse,
    ),
)
