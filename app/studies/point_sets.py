"""The points of a study: a grid, a list of cases or a random sample.

The functions check that the paths exist and that the fields accept the values.
"""

from collections.abc import Sequence
from itertools import pairwise, product
from math import inf, log, nextafter, prod
from typing import Any, NamedTuple

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf, field_path
from app.schema.model import Request
from app.schema.quantities import split_unit
from app.studies.fields import check_value, is_plain_number, not_a_number
from app.studies.points import BaseRequest, check_count, check_distinct
from app.studies.requests import (
    LARGEST,
    Axis,
    Listed,
    Lognormal,
    Method,
    Normal,
    Overrides,
    Range,
    Scalar,
    Scatter,
    Triangular,
)
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import uncertain_inputs
from solvers.quantity import allowed

CUT = 4.0  # distance from the mean beyond which a distribution is cut off, in standard deviations
LEAST_SHARE = 1e-9  # least permissible share of a distribution inside the field's range (see `_check_digits`)


def common_unit(leaves: Sequence[Leaf]) -> str | None:
    """Return the unit of several fields, or None if their units differ."""
    units = {leaf.unit for leaf in leaves}
    return units.pop() if len(units) == 1 else None


class CheckedAxis(NamedTuple):
    """An axis whose fields and values have been checked. `values` is None if the values are random."""

    path: str | list[str]
    leaves: tuple[Leaf, ...]
    values: list[Scalar | list[Scalar]] | None

    def header(self) -> dict[str, Any]:
        """Return the description of the axis for the header, which is the first line of a study."""
        return {"path": self.path, "unit": common_unit(self.leaves), "values": self.values}


class PointSet(NamedTuple):
    """The points of a study, in order.

    `rows` holds one row per point. If there are `axes`, a row is a list with the coordinate of the point on each axis.
    If there are no axes, a row is a dictionary: its keys are the paths of the fields that the point sets, and its
    values are the values of these fields. `varied` holds the fields that differ between points.
    """

    axes: list[CheckedAxis]
    varied: tuple[Leaf, ...]
    rows: Sequence[list[Any] | Overrides]

    @property
    def total(self) -> int:
        """The number of points."""
        return len(self.rows)

    def overrides(self, index: int) -> Overrides:
        """Return the values that a point changes in the base request. The keys are the paths of the values."""
        row = self.rows[index]
        if isinstance(row, dict):
            return row
        return {
            leaf.path: own
            for axis, value in zip(self.axes, row, strict=True)
            for leaf, own in zip(axis.leaves, _values_of_fields(value, axis.leaves), strict=True)
        }

    def ends(self, index: int) -> list[str]:
        """Return the paths of the fields of a grid whose range of numbers ends at a point."""
        found = []
        for axis, value in zip(self.axes, self.rows[index], strict=bool(self.axes)):
            numbers: list[Any] = [number for number in axis.values or () if is_plain_number(number)]
            if len(numbers) > 1 and len(numbers) == len(axis.values or ()) and value in {min(numbers), max(numbers)}:
                found += [leaf.path for leaf in axis.leaves]
        return found


def _values_of_fields(value: Scalar | list[Scalar], leaves: tuple[Leaf, ...]) -> list[Scalar]:
    """Return one value per field of an axis. If `value` is not a list, all fields have this value."""
    return value if isinstance(value, list) else [value] * len(leaves)


def listed(cases: list[Overrides], base: BaseRequest, most: int, place: str) -> PointSet:
    """Return one point per case. `place` is the path of the list of cases in the body of the study.

    Raises Unprocessable if a case sets a field or value that is not allowed, or if there are more than `most` cases.
    """
    check_count(len(cases), most, place)
    return PointSet([], tuple(fields_set(cases, base, place + ".{}").values()), cases)


def fields_set(cases: Sequence[Overrides], base: BaseRequest, place: str) -> dict[str, Leaf]:
    """Return the fields that the cases set. The keys are the paths of the fields.

    Raises Unprocessable if a path does not exist or if a field does not accept a value. The error is located at
    `place`, in which `{}` stands for the index of the case.
    """
    fields: dict[str, Leaf] = {}
    for number, case in enumerate(cases):
        for path, value in case.items():
            if path not in fields:
                fields[path] = base.leaf(path, place.format(number))
            check_value(fields[path], value, place.format(number))
    return fields


def grid(axes: list[Axis], base: BaseRequest, most: int, place: str) -> PointSet:
    """Return one point per combination of the axes' values. The value on the first axis changes most slowly.

    `place` is the path of the list of axes in the body of the study. Raises Unprocessable if an axis is not valid, or
    if there are more than `most` points.
    """
    total = prod(_length(axis, f"{place}.{number}") for number, axis in enumerate(axes))
    check_count(total, most, place)
    checked = checked_axes(axes, base, most, place)
    rows = [list(row) for row in product(*(axis.values or () for axis in checked))]
    return PointSet(checked, tuple(leaf for axis in checked for leaf in axis.leaves), rows)


def checked_axes(axes: Sequence[Axis], base: BaseRequest, most: int, place: str) -> list[CheckedAxis]:
    """Return the axes; raise Unprocessable as `grid` does, but `most` is the number of values of each axis alone."""
    for number, axis in enumerate(axes):
        check_count(_length(axis, f"{place}.{number}"), most, f"{place}.{number}")
    check_distinct([path for axis in axes for path in axis.paths], place)
    return [_check_axis(axis, base, f"{place}.{number}") for number, axis in enumerate(axes)]


def _length(axis: Axis, place: str) -> int:
    """Return the number of values of an axis. The values are either listed or spread between the ends of the axis."""
    spread = (axis.start, axis.stop, axis.count)
    if axis.values is not None and spread == (None, None, None):
        return len(axis.values)
    if axis.values is None and axis.count is not None and None not in spread:
        return axis.count
    raise Unprocessable(
        "values_or_range", "give either the field 'values', or the fields 'start', 'stop' and 'count'", place
    )


def _check_axis(axis: Axis, base: BaseRequest, place: str) -> CheckedAxis:
    leaves = tuple(base.leaf(path, f"{place}.path") for path in axis.paths)
    values = _spread(axis, leaves, place) if axis.values is None else axis.values
    for number, value in enumerate(values):
        if isinstance(value, list) and (isinstance(axis.path, str) or len(value) != len(leaves)):
            message = "give either one value for all fields of the axis, or a list with one value for each field"
            raise Unprocessable("values_per_field", message, f"{place}.values.{number}")
        for leaf, own in zip(leaves, _values_of_fields(value, leaves), strict=True):
            check_value(leaf, own, place)
    if all(leaf.kind == "integer" for leaf in leaves):
        values = [int(value) if isinstance(value, float) else value for value in values]
    return CheckedAxis(axis.path, leaves, values)


def _spread(axis: Axis, leaves: tuple[Leaf, ...], place: str) -> list[Any]:
    """Return the values of an axis from start to stop.

    The values have equal steps on a linear axis, and equal ratios on a logarithmic axis. Raises Unprocessable if a
    field does not accept start or stop, or if start or stop of a logarithmic axis is not positive.
    """
    ends: dict[str, Any] = {"start": axis.start, "stop": axis.stop}
    for name, end in ends.items():
        if axis.scale == "log" and end <= 0.0:
            message = "both ends of a logarithmic axis must be above zero"
            raise Unprocessable("log_needs_positive", message, f"{place}.{name}")
        for leaf in leaves:
            check_value(leaf, end, f"{place}.{name}")
    spread: Any = np.linspace if axis.scale == "linear" else np.geomspace
    return list(spread(*ends.values(), axis.count).tolist())


def scattering(scatters: Sequence[Range | Scatter], base: BaseRequest, place: str) -> tuple[Leaf, ...]:
    """Return the fields that the distributions vary. `place` is the path of the list of distributions in the study.

    Raises Unprocessable if a field cannot vary continuously, or if a parameter of a distribution (such as its mean) is
    not a permissible value of the field.
    """
    check_distinct([scatter.path for scatter in scatters], place)
    leaves = []
    for number, scatter in enumerate(scatters):
        here = f"{place}.{number}"
        leaf = base.leaf(scatter.path, f"{here}.path")
        message = not_a_number(leaf)
        is_countable = leaf.kind == "integer" or (bool(leaf.options) and all(map(is_plain_number, leaf.options)))
        if is_countable and not isinstance(scatter, Listed):
            holds = f"has the values {', '.join(map(str, leaf.options))}" if leaf.options else "is a whole number"
            message = f"{scatter.path} {holds}; list its values, with the distribution 'listed'"
            raise Unprocessable("not_integer", message, here)
        if message is not None and not is_countable:
            raise Unprocessable(
                "not_continuous", f"{message}, so it cannot be drawn at random; vary it in a sweep", f"{here}.path"
            )
        for name, value in anchors(scatter).items():
            check_value(leaf, value, f"{here}.{name}")
        for (low, least), (high, greatest) in pairwise(anchors(scatter).items()):
            if least > greatest and not isinstance(scatter, Listed):
                raise Unprocessable(
                    "out_of_range", f"{scatter.path}: the value of '{low}' is above the value of '{high}'", here
                )
        _check_digits(scatter, leaf, here)
        leaves.append(leaf)
    return tuple(leaves)


def _check_digits(scatter: Range | Scatter, leaf: Leaf, place: str) -> None:
    """Raise Unprocessable if almost no values of a normal distribution lie in the permissible range of the field.

    If the probability of this range is below `LEAST_SHARE`, rounding errors leave fewer than six correct digits in the
    random values.
    """
    if isinstance(scatter, Normal) and 1.0 - cut(scatter, leaf).cut_off < LEAST_SHARE:
        message = (
            f"{scatter.path}: with a deviation of {scatter.deviation:.6g} almost no values lie inside the permissible "
            f"range of the field ({allowed(leaf.declared)}); give a smaller deviation, or choose a uniform "
            "distribution"
        )
        raise Unprocessable("out_of_range", message, f"{place}.deviation")


def anchors(scatter: Range | Scatter) -> dict[str, float]:
    """Return the parameters of a distribution that must be permissible values of its field, such as the mean.

    The keys are the names of the parameters. In a valid distribution, the returned parameters are in ascending order,
    unless its values are listed.
    """
    if isinstance(scatter, Listed):
        return {f"values.{place}": value for place, value in enumerate(scatter.values)}
    return {name: getattr(scatter, name) for name in ("min", "mode", "mean", "median", "max") if hasattr(scatter, name)}


class Cut(NamedTuple):
    """A distribution of SciPy that is cut off below `low` and above `high`."""

    law: Any
    low: float
    high: float

    @property
    def shares(self) -> tuple[float, float]:
        """The cumulative probabilities at `low` and at `high` of the distribution before the cut."""
        return float(self.law.cdf(self.low)), float(self.law.cdf(self.high))

    def drawn(self, share: FloatArray) -> FloatArray:
        """Return the values of the cut distribution at given cumulative probabilities."""
        low, high = self.shares
        return np.asarray(np.clip(self.law.ppf(low + (high - low) * share), self.low, self.high))

    @property
    def cut_off(self) -> float:
        """The probability that a value of the distribution before the cut lies below `low` or above `high`.

        If `low` and `high` are equal, the field has a fixed value, and the result is 0.
        """
        low, high = self.shares
        return low + 1.0 - high if self.low < self.high else 0.0


def cut_off(scatter: Range | Scatter, leaf: Leaf) -> float:
    """Return the share of a distribution that is cut off; listed values are not cut."""
    return 0.0 if isinstance(scatter, Listed) else cut(scatter, leaf).cut_off


def cut(scatter: Range | Normal | Lognormal, leaf: Leaf) -> Cut:
    """Return the distribution of a field, cut off at the limits of the field's permissible range.

    Normal and lognormal distributions are also cut off at four standard deviations.
    """
    from scipy import stats  # noqa: PLC0415  half a second that only random samples need

    law: Any
    match scatter:
        case Normal():
            law = stats.norm(scatter.mean, scatter.deviation)
            low, high = scatter.mean - CUT * scatter.deviation, scatter.mean + CUT * scatter.deviation
        case Lognormal():
            law = stats.lognorm(log(scatter.factor), scale=scatter.median)
            low, high = scatter.median / scatter.factor**CUT, scatter.median * scatter.factor**CUT
        case _:
            low, high = scatter.min, scatter.max
            width = high - low or 1.0  # if the ends are equal, `Cut` sets all values to the ends
            law = stats.uniform(low, width)
            if isinstance(scatter, Triangular) and high > low:
                law = stats.triang((scatter.mode - low) / width, low, width)
    bounds = leaf.declared.bounds
    low = max(low, bounds.get("ge", -LARGEST), nextafter(bounds.get("gt", -LARGEST), inf))
    high = min(high, bounds.get("le", LARGEST), nextafter(bounds.get("lt", LARGEST), -inf))
    return Cut(law, low, high)


def drawn(scatters: Sequence[Range | Scatter], leaves: Sequence[Leaf], cube: FloatArray) -> FloatArray:
    """Convert points of the unit cube into values of the fields, with one row per point and one column per field.

    A coordinate of a point in the cube is the cumulative probability of the value of a field.
    """
    columns = []
    for scatter, leaf, share in zip(scatters, leaves, cube.T, strict=True):
        if isinstance(scatter, Listed):
            columns.append(np.array(scatter.values)[np.searchsorted(scatter.ends[:-1], share, side="right")])
        else:
            columns.append(cut(scatter, leaf).drawn(share))
    return np.column_stack(columns)


def unit_cube(method: Method, count: int, dimensions: int, seed: Any, place: str) -> FloatArray:
    """Draw random points in the unit cube, one row per point.

    `seed` is a number or a random generator of NumPy. Raises Unprocessable if the method is Sobol and `count`, the
    number of points, is not a power of two. The error is located at `place`, the path of the number of points in the
    body of the study.
    """
    from scipy.stats import qmc  # noqa: PLC0415  half a second that only random samples need

    if method == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=seed).random(count))
    exponent = count.bit_length() - 1
    if count != 1 << exponent:
        raise Unprocessable("not_power_of_two", "the number of points of a Sobol sample must be a power of two", place)
    return np.asarray(qmc.Sobol(dimensions, rng=seed).random_base2(exponent))


def usual_corners(request: Request) -> dict[str, Axis]:
    """Return one axis per uncertain quantity of a gear unit. An axis holds the usual values of its quantity.

    The keys are the names of the quantities, such as "friction".
    """
    axes = {}
    for uncertain in uncertain_inputs(request.inputs()):
        paths = [path for name in uncertain.names if (path := field_path(request, name))]
        rows = [[_in_own_unit(path, value) for path, value in zip(paths, row, strict=True)] for row in uncertain.values]
        is_single = len(paths) == 1
        values = [row[0] for row in rows] if is_single else rows
        axes[uncertain.quantity] = Axis(path=paths[0] if is_single else paths, values=values)
    return axes


def _in_own_unit(path: str, value: float) -> Scalar:
    """Convert a value from SI units to the unit of the field at `path`, and round the result to 12 digits."""
    field = next(part for part in reversed(path.split(".")) if not part.isdecimal())
    unit = split_unit(field)[1]
    return float(f"{value if unit is None else unit.from_si(value):.12g}") + 0.0
