"""Studies of a gear unit: its uncertain inputs by the names of the request, requests without unused results."""

import copy
from collections.abc import Sequence
from typing import Any

from app.calculations import BY_PATH
from app.schema.base import Request
from app.schema.fields import field_path
from app.schema.quantities import split_unit
from app.studies.fields import set_value
from app.studies.requests import DRIVE_TRAIN, Axis, Scalar
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence, uncertain_inputs

__all__ = ["MOST_CORNERS", "needs_film_or_state", "reduced_request", "unsolved_corners", "usual_corners"]

COLD = "states.cold."
BY_FILM = frozenset({"safety.minimum", "safety.thermal_ehl_feature", "safety.thermal_ehl_profile"})


def usual_corners(request: Request) -> dict[str, Axis]:
    """The uncertain inputs of a unit and their values, where the user names none, by what they are."""
    axes = {}
    for each in uncertain_inputs(request.inputs()):
        paths = [path for name in each.names if (path := field_path(request, name))]
        rows = [[_shown(path, value) for path, value in zip(paths, row, strict=True)] for row in each.values]
        alone = len(paths) == 1
        axis = Axis(path=paths[0], values=[own for (own,) in rows]) if alone else Axis(path=paths, values=rows)
        axes[each.quantity] = axis
    return axes


def _shown(path: str, value: float) -> Scalar:
    """A value of the solver in the unit of the request, rounded to 12 digits."""
    field = next(part for part in reversed(path.split(".")) if not part.isdecimal())
    unit = split_unit(field)[1]
    return float(f"{value if unit is None else (value - unit.offset) / unit.scale:.12g}") + 0.0


def unsolved_corners(count: int) -> list[dict[str, str]]:
    """The warning about corners without solution, if there are any."""
    notice = no_convergence(count)
    return [{"rank": notice.rank, "code": notice.code, "message": notice.message}] if count else []


def needs_film_or_state(output: str) -> bool:
    """Whether an output needs the thermal film or another state, which cost more than everything else."""
    return output.startswith(COLD) or output in BY_FILM


def reduced_request(request: dict[str, Any], outputs: Sequence[str]) -> dict[str, Any]:
    """The request without thermal film and other states where no output needs them; the outputs are the same."""
    light = copy.deepcopy(request)
    if not BY_FILM & {path.removeprefix(COLD) for path in outputs}:
        set_value(BY_PATH[DRIVE_TRAIN].request, light, "model.lubrication", "closed_form")
    if not any(path.startswith(COLD) for path in outputs):
        light.pop("states", None)
    return light
