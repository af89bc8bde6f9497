"""What scatters by the quality class of the gears: the slopes of the flanks of both gears, in the gap of the pair.

A slope is normally distributed about the value of the case; three standard deviations are the tolerance. Slopes of
pinion and wheel are independent, and so are those of two helices. Pitch deviations and the total helix deviation are no
inputs of a calculation; answers state their tolerances.
"""

from collections.abc import Iterable
from typing import Any

from app.errors import Unprocessable
from app.models.sections.gears import QUALITY_CLASS, SECOND_BY_CLASS, SLOPES_BY_CLASS
from app.schema.fields import value_at
from app.schema.model import Request
from app.studies.requests import Axis, Normal
from solvers.errors import InvalidInput
from solvers.gears.inputs import RACK_A, GearPairInputs
from solvers.gears.tolerances import DEVIATIONS, flank_tolerances
from solvers.quantity import UNITS

BY_CLASS = "by quality class"  # the reasons of assumptions begin with these words


def class_tolerances(request: Request, quality_class: int | None = None) -> dict[str, float]:
    """Return three standard deviations [um] of each field that scatters by the class, by its path; none without one.

    `quality_class` stands for the class of the gears. Raises Unprocessable if the gears are beyond the limits of the
    standard.
    """
    own = value_at(request, QUALITY_CLASS) if quality_class is None else quality_class
    if own is None:
        return {}
    try:
        # The fillet has no tolerance of the class; a request may leave its default to the calculation.
        pair = flank_tolerances(request.gears.si(GearPairInputs, rack_tip_radius=RACK_A, quality_class=own))
    except InvalidInput as error:
        raise Unprocessable(error.code, error.message, f"request.gears.{error.field}") from error
    assert pair is not None
    helix, profile = (UNITS["um"].from_si(value) for value in (pair.helix_slope, pair.profile_slope))
    paths = [*SLOPES_BY_CLASS, *([SECOND_BY_CLASS] if _has_second(request) else [])]
    return dict(zip(paths, (helix, profile, helix), strict=False))


def class_distributions(request: Request) -> list[Normal]:
    """Return the distributions of the fields that scatter by the quality class; none without one."""
    return [
        Normal(path=path, distribution="normal", mean=_nominal(request, path), deviation=tolerance / DEVIATIONS)
        for path, tolerance in class_tolerances(request).items()
    ]


def class_corners(request: Request) -> dict[str, Axis]:
    """Return one axis per slope with both ends of its tolerance, by the name of the slope; none without a class.

    Two helices move together: each of them meets both ends, and the worse one decides.
    """
    tolerances = class_tolerances(request)
    helix, profile = SLOPES_BY_CLASS
    slopes = {"helix slope": [helix, SECOND_BY_CLASS], "profile slope": [profile]}
    axes = {}
    for slope, paths in slopes.items() if tolerances else ():
        varied = [path for path in paths if path in tolerances]
        rows = [[_nominal(request, path) + sign * tolerances[path] for path in varied] for sign in (-1, 1)]
        single = len(varied) == 1
        axes[slope] = Axis(path=varied[0] if single else varied, values=[row[0] for row in rows] if single else rows)
    return axes


def class_assumptions(request: Request, tolerances: dict[str, float]) -> list[dict[str, Any]]:
    """Say which tolerances a study took from the quality class."""
    reason = (
        f"{BY_CLASS} {value_at(request, 'gears.quality_class')} (ISO 1328-1:2013, secondary source): normally "
        "distributed, three standard deviations are the tolerances of pinion and wheel together"
    )
    return [{"field": path, "value": tolerance, "reason": reason} for path, tolerance in tolerances.items()]


def class_remarks(assumptions: Iterable[dict[str, Any]]) -> list[str]:
    """Return the sentence that a page shows if some of the assumptions are by the quality class."""
    reasons = {each["reason"]: None for each in assumptions if each["reason"].startswith(BY_CLASS)}
    return [f"The slopes of the flanks scatter {reason}" for reason in reasons]


def _has_second(request: Request) -> bool:
    return (
        value_at(request, "gears.gap_width_mm") is not None
        and "second_helix" in type(request.modifications).model_fields
    )


def _nominal(request: Request, path: str) -> float:
    """Return the value of the case; a second helix without a slope of its own has that of the first."""
    value = value_at(request, path)
    return float(value_at(request, SLOPES_BY_CLASS[0]) if value is None else value)
