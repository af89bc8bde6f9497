"""The uncertain inputs of a gear unit by the names of the request, and the warning about corners without solution."""

from app.schema.fields import field_path
from app.schema.model import Request
from app.schema.quantities import split_unit
from app.studies.requests import Axis, Scalar
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence, uncertain_inputs

__all__ = ["MOST_CORNERS", "unsolved_corners", "usual_corners"]


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
