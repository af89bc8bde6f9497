"""Pumping of air and oil mist between the teeth, and the speeds at which it chokes."""

from typing import Any

from app.models.card import Calculation, Card, Cost
from app.models.kernels import CHAIN, PUMPING, Kernels
from app.models.pumping import figures, request, words
from solvers import pumping


def _choking_search(request: Any) -> Cost:
    """Estimate the time of the search for choking speeds with the pocket-chain model.

    For the tooth spaces of both gears, the search took 0.7, 2.6, 6.2 and 16 s with 10, 40, 80 and 160 pockets. The
    gas-dynamics model needs no estimate, because this model itself limits the number of its steps.
    """
    pockets = request.model.slices or 0
    if request.model.flow != "pocket_chain":
        return Cost(0.0, "model.slices")
    return Cost(0.05 * pockets + 3e-4 * pockets**2, "model.slices")


CARD = Card(
    "pumping",
    (
        Calculation(
            path="/v1/pumping",
            title="Pumping between gear teeth",
            summary="Air and mist pumped between the teeth: pressure, heating, power, mass flow, lead correction",
            source="Milian, Distretti, Leoni, Velex 2004",
            request=request.PumpingRequest,
            solve=pumping.solve,
            response=words.PUMPING,
            kernels=Kernels(PUMPING, CHAIN),
            figures=figures.FIGURES,
            words=words.WORDS,
        ),
        Calculation(
            path="/v1/pumping/choking-speed",
            title="Choking speed",
            summary="Speeds at which the flow out of the tooth spaces becomes sonic",
            source="Milian, Distretti, Leoni, Velex 2004, Eq. 7",
            request=request.ChokingSpeedRequest,
            solve=pumping.choking_speeds,
            response=words.CHOKING,
            kernels=Kernels(PUMPING, CHAIN),
            figures=figures.CHOKING_FIGURES,
            cost=_choking_search,
            words=words.CHOKING_WORDS,
        ),
    ),
    subject="pair",
    start_figure="mach-map",
)
