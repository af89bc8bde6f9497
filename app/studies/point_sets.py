"""Which points a study has: a grid, a list of cases or a random sample, checked against the schema."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import prod
from typing import Any

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf, field_path
from app.schema.model import Request
from app.schema.quantities import split_unit
from app.studies.base_request import BaseRequest, check_count, check_distinct, check_value
from app.studies.distributions import anchors, drawn, unit_cube
from app.studies.requests import Axis, Overrides, Range, Sample, Scalar, Scatter, SweepRequest
from solvers.drive_train.uncertainty import uncertain_inputs


def common_unit(leaves: Sequence[Leaf]) -> str | None:
    """The unit of fields that take one value; None where they differ."""
    units = {leaf.unit for leaf in leaves}
    return units.pop() if len(units) == 1 else None


@dataclass(frozen=True, slots=True)
class CheckedAxis:
    """One axis: its fields, and its values unless they are random."""

    path: str | list[str]
    leaves: tuple[Leaf, ...]
    values: list[Scalar | list[Scalar]] | None

    def header(self) -> dict[str, Any]:
        """The axis in the first line of a study."""
        return {"path": self.path, "unit": common_unit(self.leaves), "values": self.values}


@dataclass(frozen=True, slots=True)
class PointSet:
    """Points in order: the product of `axes`, first axis slowest, or the rows of `cases` or `sample`.

    `varied` are the fields that differ between points.
    """

    axes: list[CheckedAxis]
    total: int
    varied: tuple[Leaf, ...]
    cases: list[Overrides] | None = None
    sample: np.ndarray[Any, Any] | None = None

    def at(self, index: int) -> list[Scalar | list[Scalar]] | Overrides:
        """Coordinates of a point, or its overrides in a list of cases."""
        if self.cases is not None:
            return self.cases[index]
        if self.sample is not None:
            values: list[Scalar | list[Scalar]] = self.sample[index].tolist()
            return values
        at: list[Scalar | list[Scalar]] = []
        for axis in reversed(self.axes):
            assert axis.values is not None
            index, place = divmod(index, len(axis.values))
            at.insert(0, axis.values[place])
        return at

    def overrides(self, index: int) -> Overrides:
        """What a point changes in the base request."""
        at = self.at(index)
        if isinstance(at, dict):
            return at
        return {
            leaf.path: own
            for axis, value in zip(self.axes, at, strict=True)
            for leaf, own in zip(axis.leaves, _each(value, axis.leaves), strict=True)
        }


def _each(value: Scalar | list[Scalar], leaves: tuple[Leaf, ...]) -> list[Scalar]:
    """A value for each of the fields that move together."""
    return value if isinstance(value, list) else [value] * len(leaves)


def points_of(sweep: SweepRequest, base: BaseRequest, most: int) -> PointSet:
    """The points of a sweep; at most `most`.

    Raises Unprocessable with a path into the sweep for what the schema refuses.
    """
    if sweep.cases is not None:
        return listed(sweep.cases, base, most, "cases")
    if sweep.sample is not None:
        return sampled(sweep.sample, base, most)
    assert sweep.vary is not None
    return grid(sweep.vary, base, most, "vary")


def grid(axes: list[Axis], base: BaseRequest, most: int, place: str) -> PointSet:
    """The product of the axes at `place` of a study; raises Unprocessable."""
    check_count(prod(_length(axis, f"{place}.{number}") for number, axis in enumerate(axes)), most, place)
    check_distinct([path for axis in axes for path in axis.paths], place)
    found = [_axis(axis, base, f"{place}.{number}") for number, axis in enumerate(axes)]
    varied = tuple(leaf for axis in found for leaf in axis.leaves)
    return PointSet(found, prod(len(axis.values or ()) for axis in found), varied)


def listed(cases: list[Overrides], base: BaseRequest, most: int, place: str) -> PointSet:
    """The points of the list of cases at `place` of a study; raises Unprocessable."""
    check_count(len(cases), most, place)
    leaves: dict[str, Leaf] = {}
    for number, case in enumerate(cases):
        check_case(case, base, f"{place}.{number}", leaves)
    return PointSet([], len(cases), tuple(leaves.values()), cases=cases)


def check_case(case: Overrides, base: BaseRequest, place: str, known: dict[str, Leaf]) -> None:
    """Refuse a case that sets what there is not, or what its field does not take; `known` gathers the fields."""
    for path, value in case.items():
        if path not in known:
            known[path] = base.leaf(path, place)
        check_value(known[path], value, place)


def _length(axis: Axis, place: str) -> int:
    """How many values an axis has; either they are listed, or they are spread."""
    spread = (axis.start, axis.stop, axis.count)
    if axis.values is not None and all(part is None for part in spread):
        return len(axis.values)
    if axis.values is None and axis.count is not None and all(part is not None for part in spread):
        return axis.count
    raise Unprocessable("values_or_range", "give either values, or start, stop and count", place)


def _axis(axis: Axis, base: BaseRequest, place: str) -> CheckedAxis:
    leaves = tuple(base.leaf(path, f"{place}.path") for path in axis.paths)
    values = axis.values if axis.values is not None else _spread(axis, leaves, place)
    for number, value in enumerate(values):
        if isinstance(value, list) and (isinstance(axis.path, str) or len(value) != len(leaves)):
            message = "give one value for all fields of the axis, or of a list of fields each its own"
            raise Unprocessable("values_per_field", message, f"{place}.values.{number}")
        for leaf, own in zip(leaves, _each(value, leaves), strict=True):
            check_value(leaf, own, place)
    if all(leaf.kind == "integer" for leaf in leaves):
        values = [int(value) if isinstance(value, float) else value for value in values]
    return CheckedAxis(axis.path, leaves, values)


def _spread(axis: Axis, leaves: tuple[Leaf, ...], place: str) -> list[Scalar | list[Scalar]]:
    """Even steps, or even ratios, from start to stop; an end that is refused is named."""
    assert axis.start is not None
    assert axis.stop is not None
    assert axis.count is not None
    for name, end in {"start": axis.start, "stop": axis.stop}.items():
        if axis.scale == "log" and end <= 0.0:
            raise Unprocessable(
                "log_needs_positive", "a logarithmic axis needs both ends above zero", f"{place}.{name}"
            )
        for leaf in leaves:
            check_value(leaf, end, f"{place}.{name}")
    if axis.scale == "linear":
        return list(np.linspace(axis.start, axis.stop, axis.count).tolist())
    return list(np.geomspace(axis.start, axis.stop, axis.count).tolist())


def sampled(sample: Sample, base: BaseRequest, most: int) -> PointSet:
    """Random points, the same for the same seed; raises Unprocessable."""
    check_count(sample.count, most, "sample.count")
    name, scatters = sample.scatters
    leaves = scattering(scatters, base, f"sample.{name}")
    cube = unit_cube(sample.method, sample.count, len(leaves), sample.seed, "sample.count")
    axes = [CheckedAxis(leaf.path, (leaf,), None) for leaf in leaves]
    return PointSet(axes, sample.count, tuple(leaves), sample=drawn(scatters, leaves, cube))


def scattering(scatters: Sequence[Range | Scatter], base: BaseRequest, place: str) -> list[Leaf]:
    """The fields of the distributions at `place` of a study; raises Unprocessable."""
    check_distinct([each.path for each in scatters], place)
    leaves = []
    for number, each in enumerate(scatters):
        here = f"{place}.{number}"
        leaf = base.leaf(each.path, f"{here}.path")
        if leaf.kind == "integer":
            raise Unprocessable("not_integer", f"{each.path} takes whole numbers; vary it or list cases", here)
        for name, value in anchors(each).items():
            check_value(leaf, value, f"{here}.{name}")
        for (low, least), (high, greatest) in pairwise(anchors(each).items()):
            if least > greatest:
                raise Unprocessable("out_of_range", f"{each.path}: {low} is above {high}", here)
        leaves.append(leaf)
    return leaves


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
