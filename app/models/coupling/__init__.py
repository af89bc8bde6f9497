"""Gear couplings: tooth load, lubrication, axial thrust, the orbit of a floating sleeve, the best crowning."""

from app.models.card import Calculation, Card
from app.models.coupling import figures, request, words
from app.models.kernels import COUPLING, SLEEVE, Kernels
from solvers import coupling

CARD = Card(
    "coupling",
    (
        Calculation(
            path="/v1/coupling",
            title="Gear coupling",
            summary="Load, lubrication, friction, axial thrust and losses of a gear coupling",
            source="Pahl 1978",
            request=request.CouplingRequest,
            solve=coupling.solve,
            response=words.COUPLING,
            kernels=Kernels(COUPLING),
            figures=figures.FIGURES,
            words=words.WORDS,
        ),
        Calculation(
            path="/v1/coupling/sleeve-orbit",
            title="Sleeve orbit",
            summary="Path and inertia force of a floating sleeve over one revolution",
            source="Pahl 1978, Fig. 5",
            request=request.SleeveOrbitRequest,
            solve=coupling.solve_orbit,
            response=words.ORBIT,
            kernels=Kernels(SLEEVE),
            figures=figures.ORBIT_FIGURES,
            words=words.ORBIT_WORDS,
        ),
        Calculation(
            path="/v1/coupling/recommendation",
            title="Crowning recommendation",
            summary="The crowning with the best film over a range of misalignment",
            source="Pahl 1978, conclusion",
            request=request.RecommendationRequest,
            solve=coupling.recommend,
            response=words.RECOMMENDATION,
            kernels=Kernels(SLEEVE),
            figures=figures.RECOMMENDATION_FIGURES,
            words=words.RECOMMENDATION_WORDS,
        ),
    ),
    subject="coupling",
    start_figure="tooth-loads",
)
