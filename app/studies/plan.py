"""Which points a sweep has: the field paths checked against the schema, the overrides of every point."""

from dataclasses import dataclass
from math import prod
from typing import Any, NamedTuple

import numpy as np

from app.contract.fields import Leaf
from app.contract.quantities import Documented
from app.problems import Unprocessable
from app.studies.fields import fault, is_reachable, scalar_at
from app.studies.requests import Axis, Overrides, Sample, Scalar, SweepRequest


@dataclass(frozen=True, slots=True)
class PlannedAxis:
    """One axis: its fields, and its values where they are the same at every point."""

    path: str | list[str]
    leaves: tuple[Leaf, ...]
    values: list[Scalar] | None

    def header(self) -> dict[str, Any]:
        """What the first line says of it; fields that move together in different units have none in common."""
        units = {leaf.unit for leaf in self.leaves}
        return {"path": self.path, "unit": units.pop() if len(units) == 1 else None, "values": self.values}


@dataclass(frozen=True, slots=True)
class Plan:
    """The points of a sweep in order: `at` says where each is, `overrides` what it changes."""

    axes: list[PlannedAxis]
    total: int
    cases: list[Overrides] | None = None
    sample: np.ndarray[Any, Any] | None = None

    def at(self, index: int) -> list[Scalar] | Overrides:
        """Coordinates of a point, or its overrides in a list of cases."""
        if self.cases is not None:
            return self.cases[index]
        if self.sample is not None:
            values: list[Scalar] = self.sample[index].tolist()
            return values
        at: list[Scalar] = []
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
        return {leaf.path: value for axis, value in zip(self.axes, at, strict=True) for leaf in axis.leaves}


class _Request(NamedTuple):
    """The request that a sweep varies."""

    model: type[Documented]
    base: dict[str, Any]

    def leaf(self, path: str, place: str) -> Leaf:
        """The single value that a path names, if it can be set."""
        leaf = scalar_at(self.model, path, place, "unknown_path")
        if not is_reachable(self.base, path):
            raise Unprocessable("unknown_path", f"the request has no {path}: its list is shorter", place)
        return leaf


def planned(sweep: SweepRequest, model: type[Documented], most: int) -> Plan:
    """The points of a sweep over requests of this model; at most `most`.

    Raises Unprocessable with a path into the sweep for whatever the schema already tells to be impossible.
    """
    request = _Request(model, sweep.request)
    if sweep.cases is not None:
        return _listed(sweep.cases, request, most)
    if sweep.sample is not None:
        check_count(sweep.sample.count, most, "sample.count")
        return _sampled(sweep.sample, request)
    assert sweep.vary is not None
    check_count(prod(_length(axis, f"vary.{place}") for place, axis in enumerate(sweep.vary)), most, "vary")
    _check_distinct([path for axis in sweep.vary for path in axis.paths], "vary")
    axes = [_axis(axis, request, f"vary.{place}") for place, axis in enumerate(sweep.vary)]
    return Plan(axes, prod(len(axis.values or ()) for axis in axes))


def check_count(count: int, most: int, place: str) -> None:
    """Refuse a study of too many points."""
    if count > most:
        raise Unprocessable("too_many_points", f"the study has {count} points; at most {most} are allowed", place)


def _check_distinct(paths: list[str], place: str) -> None:
    for path in paths:
        if paths.count(path) > 1:
            raise Unprocessable("duplicate_path", f"{path} is varied twice", place)


def _check_value(leaf: Leaf, value: Scalar, place: str) -> None:
    """Refuse a value that the field's schema does not take."""
    found = fault(leaf, value)
    if found is not None:
        code, message = found
        raise Unprocessable(code, f"{leaf.path}: {message}", place)


def _listed(cases: list[Overrides], request: _Request, most: int) -> Plan:
    """The points of a list of cases."""
    check_count(len(cases), most, "cases")
    leaves: dict[str, Leaf] = {}
    for number, case in enumerate(cases):
        for path, value in case.items():
            if path not in leaves:
                leaves[path] = request.leaf(path, f"cases.{number}")
            _check_value(leaves[path], value, f"cases.{number}")
    return Plan([], len(cases), cases=cases)


def _length(axis: Axis, place: str) -> int:
    """How many values an axis has; either they are listed, or they are spread."""
    spread = (axis.start, axis.stop, axis.count)
    if axis.values is not None and all(part is None for part in spread):
        return len(axis.values)
    if axis.values is None and axis.count is not None and all(part is not None for part in spread):
        return axis.count
    raise Unprocessable("values_or_range", "give either values, or start, stop and count", place)


def _axis(axis: Axis, request: _Request, place: str) -> PlannedAxis:
    leaves = tuple(request.leaf(path, f"{place}.path") for path in axis.paths)
    values = axis.values if axis.values is not None else _spread(axis, place)
    for leaf in leaves:
        for value in values:
            _check_value(leaf, value, place)
    if all(leaf.kind == "integer" for leaf in leaves):
        values = [int(value) if isinstance(value, float) else value for value in values]
    return PlannedAxis(axis.path, leaves, values)


def _spread(axis: Axis, place: str) -> list[Scalar]:
    """Even steps, or even ratios, from start to stop."""
    assert axis.start is not None
    assert axis.stop is not None
    assert axis.count is not None
    if axis.scale == "linear":
        return list(np.linspace(axis.start, axis.stop, axis.count).tolist())
    if min(axis.start, axis.stop) <= 0.0:
        raise Unprocessable("log_needs_positive", "a logarithmic axis needs start and stop above zero", place)
    return list(np.geomspace(axis.start, axis.stop, axis.count).tolist())


def _sampled(sample: Sample, request: _Request) -> Plan:
    """The random points, the same for the same seed."""
    _check_distinct([each.path for each in sample.ranges], "sample.ranges")
    leaves = []
    for number, each in enumerate(sample.ranges):
        place = f"sample.ranges.{number}"
        leaf = request.leaf(each.path, f"{place}.path")
        if leaf.kind == "integer":
            raise Unprocessable("not_integer", f"{each.path} takes whole numbers; vary it or list cases", place)
        for value in (each.min, each.max):
            _check_value(leaf, value, place)
        if each.min > each.max:
            raise Unprocessable("out_of_range", f"{each.path}: min is above max", place)
        leaves.append(leaf)
    axes = [PlannedAxis(leaf.path, (leaf,), None) for leaf in leaves]
    low, high = (np.array([getattr(each, end) for each in sample.ranges]) for end in ("min", "max"))
    return Plan(axes, sample.count, sample=low + (high - low) * _unit_cube(sample, len(leaves)))


def _unit_cube(sample: Sample, dimensions: int) -> np.ndarray[Any, Any]:
    """Points in the unit cube."""
    from scipy.stats import qmc  # noqa: PLC0415  half a second that only random samples need

    if sample.method == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=sample.seed).random(sample.count))
    exponent = sample.count.bit_length() - 1
    if sample.count != 1 << exponent:
        raise Unprocessable("not_power_of_two", "a Sobol sample needs a power of two of points", "sample.count")
    return np.asarray(qmc.Sobol(dimensions, rng=sample.seed).random_base2(exponent))
