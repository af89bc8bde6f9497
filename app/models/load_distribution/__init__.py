"""The load over the flank of a modified gear pair."""

from app.models.card import Calculation, Card
from app.models.kernels import LOADS, Kernels
from app.models.load_distribution import figures, request, words
from solvers import scuffing

CARD = Card(
    "load-distribution",
    (
        Calculation(
            path="/v1/scuffing/load-distribution",
            title="Load distribution",
            summary="Load, pressure, transmission error and loss of a modified gear pair",
            source="Xue, Zhang, Wang 2020, section II",
            request=request.LoadDistributionRequest,
            solve=scuffing.solve_load_distribution,
            response=words.LOAD_DISTRIBUTION,
            kernels=Kernels(LOADS),
            figures=figures.FIGURES,
            words=words.WORDS,
        ),
    ),
    subject="pair",
    start_figure="flank-load",
)
