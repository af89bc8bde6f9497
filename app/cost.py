"""What a request will cost, where the schema allows more than can be finished; from measured times of one core."""

from collections.abc import Callable
from typing import Any, NamedTuple

from app.problems import Unprocessable
from app.schema.base import Request
from app.schema.drive_train import DriveTrainRequest
from app.schema.pumping import ChokingSpeedRequest
from app.schema.scuffing import ScuffingRequest
from solvers.contact.ehl.continuation import Resolution, price


class Cost(NamedTuple):
    """Seconds on one core, and the field that is to be made smaller."""

    seconds: float
    field: str


def refuse_endless(request: Request, deadline_s: float) -> None:
    """Raise Unprocessable for a request that cannot be finished before the deadline."""
    for kind, estimate in ESTIMATES.items():
        if isinstance(request, kind):
            cost = estimate(request)
            if cost.seconds > deadline_s:
                raise Unprocessable(
                    "cannot_finish",
                    f"would take some {cost.seconds:.0f} s, but calculations end after {deadline_s:g} s; make it less",
                    cost.field,
                )


def _thermal_path(request: Any) -> Cost:
    """Contacts of the path: 4 to 8 ms each at 121 x 21 nodes, a Newtonian film up to 20; the least counts."""
    model = request.model
    if model.lubrication == "closed_form":
        return Cost(0.0, "model.path_points")
    film = Resolution(gap=0.0, entry_temperature=0.0, nodes=model.nodes, film_nodes=model.film_nodes, thermal=True)
    return Cost(4e-3 * model.path_points * price(film, model.nodes), "model.path_points")


def _two_thermal_paths(request: Any) -> Cost:
    """A drive train's films along two lines, in each of its states."""
    one = _thermal_path(request)
    return Cost(2 * len({*request.states}) * one.seconds, one.field)


def _choking_search(request: Any) -> Cost:
    """Chains of the search over both gears' spaces: 0.7, 2.6, 6.2, 16 s with 10, 40, 80, 160 pockets.

    Gas dynamics bounds its steps itself.
    """
    pockets = request.model.slices or 0
    if request.model.flow != "pocket_chain":
        return Cost(0.0, "model.slices")
    return Cost(0.05 * pockets + 3e-4 * pockets**2, "model.slices")


ESTIMATES: dict[type[Request], Callable[[Any], Cost]] = {
    ScuffingRequest: _thermal_path,
    DriveTrainRequest: _two_thermal_paths,
    ChokingSpeedRequest: _choking_search,
}
