"""Corners: a sweep over all combinations of the values of a gear unit's uncertain inputs; each is a corner."""

from collections.abc import Sequence
from typing import Annotated, ClassVar

from app.errors import Unprocessable
from app.schema.quantities import Input
from app.studies.kinds.sweep import Summary, Sweep
from app.studies.point_sets import PointSet, grid, usual_corners
from app.studies.points import SOLVED, BaseRequest
from app.studies.requests import RANGES, Axis, DriveTrainStudy, FromIndex, Outputs, Ranges
from app.studies.runner import Line
from app.studies.tolerances import class_assumptions, class_corners, class_tolerances
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence

USUAL_RANGES = (
    "wall response, clearances of a shaft's plain bearings against each other, friction, direction of the offset and "
    "thrust of the couplings; with a quality class of the gears, also the slopes of helix and profile"
)
MOST = 4 * MOST_CORNERS  # the usual corners, at both ends of two slopes by the quality class


class CornersRequest(DriveTrainStudy):
    """A gear unit, and the ranges of its uncertain inputs."""

    sample: ClassVar[None] = None
    best: ClassVar[None] = None
    oil_tests: ClassVar[str] = "by_stage"

    ranges: Annotated[Ranges, Input("ranges", text=RANGES, default_text=USUAL_RANGES)] = None
    outputs: Outputs = None
    from_index: FromIndex = 0


class Corners(Sweep):
    """Study of a gear unit at every corner, for at most 1024 corners.

    A corner is a combination of the values of the uncertain inputs. The answer has one line of text per corner, and one
    line of the type `extremes` per output with the least and the largest value of this output.

    The thermal film is calculated only if an output needs this film. Without the film, the study is twenty times as
    fast and has fewer warnings. If a corner has no solution, its line states the reason, and the last line of the
    answer has the warning `no_convergence_of_corner`.
    """

    path = "/v1/drive-train/corners"
    summary = "A gear unit at every combination of its uncertain inputs"
    answer = "a line for the ranges, each corner, the extremes of each output, and one for the end"
    model = CornersRequest
    formats = ("ndjson",)
    is_reduced = True
    by_class: Sequence[Line] = ()

    def _points(self, base: BaseRequest, most: int) -> PointSet:
        ranges: list[Axis] | None = self.body.ranges
        if ranges is None:
            request = base.checked({})
            ranges = list((usual_corners(request) | class_corners(request)).values())
            self.by_class = class_assumptions(request, class_tolerances(request))
        if not ranges:
            raise Unprocessable(
                "no_corners",
                "no input of this gear unit is uncertain; list the uncertain inputs in the field 'ranges'",
                "ranges",
            )
        return grid(ranges, base, min(most, MOST), "ranges")

    def _closing(self, summary: Summary, end: Line) -> list[Line]:
        """Return the last lines of the answer: one line `extremes` per output, and the line `end`.

        The line `end` has a warning if some corners have no solution.
        """
        extremes: list[Line] = []
        for path, extreme in summary.extremes.items():
            ends = {name: {"value": value, "at": self.points.overrides(at)} for name, (value, at) in extreme.items()}
            extremes.append({"type": "extremes", "output": path, **ends})
        unsolved = self.total - sum(summary.counts[status] for status in SOLVED)
        notice = no_convergence(unsolved)
        warning = {"rank": notice.rank, "code": notice.code, "message": notice.message}
        assumptions = [*end["assumptions"], *self.by_class]
        return [*extremes, {**end, "assumptions": assumptions, "warnings": [warning] if unsolved else []}]
