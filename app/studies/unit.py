"""Studies of a gear unit: the usual corners in a request's own fields, and requests without what no output tells."""

import copy
from collections.abc import Sequence
from typing import Any

from app.calculations import BY_PATH
from app.schema.base import Request
from app.schema.paths import field_path
from app.schema.units import split_unit
from app.studies.fields import set_value
from app.studies.requests import Axis, Scalar
from app.studies.unit_requests import ENDPOINT
from solvers.drive_train.studies.corners import MOST_RUNS, default_ranges

MOST_CORNERS = MOST_RUNS
COLD = "states.cold."
BY_FILM = frozenset({"safety.minimum", "safety.thermal_ehl_feature", "safety.thermal_ehl_profile"})


def usual_corners(request: Request) -> list[Axis]:
    """The corners that a unit has where nobody names others."""
    axes = []
    for each in default_ranges(request.inputs()):
        paths = [path for name in each.names if (path := field_path(request, name))]
        rows = [[_sent(path, value) for path, value in zip(paths, row, strict=True)] for row in each.values]
        alone = len(paths) == 1
        axes.append(Axis(path=paths[0], values=[own for (own,) in rows]) if alone else Axis(path=paths, values=rows))
    return axes


def _sent(path: str, value: float) -> Scalar:
    """A value of the solver as a request has it, without the noise of the conversion."""
    field = next(part for part in reversed(path.split(".")) if not part.isdecimal())
    unit = split_unit(field)[1]
    return float(f"{value if unit is None else (value - unit.offset) / unit.scale:.12g}") + 0.0


def needs_film_or_state(output: str) -> bool:
    """Whether an output asks for the thermal film or another state, which cost more than all else."""
    return output.startswith(COLD) or output in BY_FILM


def lightened(request: dict[str, Any], outputs: Sequence[str]) -> dict[str, Any]:
    """The request without thermal film and other states where no output tells of them; the outputs stay the same."""
    light = copy.deepcopy(request)
    if not BY_FILM & {path.removeprefix(COLD) for path in outputs}:
        set_value(BY_PATH[ENDPOINT].request, light, "model.lubrication", "closed_form")
    if not any(path.startswith(COLD) for path in outputs):
        light.pop("states", None)
    return light
