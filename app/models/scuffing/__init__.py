"""Scuffing of gear pairs: flash temperature, film, safety; micropitting and wear."""

from typing import Any

from app.models.card import Calculation, Card, Cost, Pump
from app.models.kernels import SCUFFING, THERMAL, Kernels
from app.models.scuffing import figures, request, words
from solvers import scuffing
from solvers.contact.ehl.continuation import Resolution, price

PUMP_FIELDS = ("cooling.gear_flow_l_per_min", "cooling.flow_rise_k")


def thermal_path(request: Any) -> Cost:
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
    """Estimate the time to solve the contacts of a scuffing check."""
    path = thermal_path(request)
    return Cost((2 if request.model.line == "flank" else 1) * path.seconds, path.field)


CARD = Card(
    "scuffing",
    (
        Calculation(
            path="/v1/scuffing",
            title="Scuffing of gears",
            summary="Load distribution, flash temperature, film thickness and scuffing safety factor of a gear pair",
            source="Xue, Zhang, Wang 2020",
            request=request.ScuffingRequest,
            solve=scuffing.solve_scuffing,
            response=words.SCUFFING,
            kernels=Kernels(SCUFFING, THERMAL),
            figures=figures.FIGURES,
            cost=_checked_lines,
            pump=Pump(*PUMP_FIELDS, scuffing.sized_flow),
            words=words.WORDS,
        ),
    ),
    subject="pair",
)
