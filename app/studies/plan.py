"""Which points a sweep has: the field paths checked against the schema, the overrides of every point."""

from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
from scipy.stats import qmc

from app.contract.fields import Leaf
from app.contract.quantities import Documented
from app.studies.errors import StudyRefused
from app.studies.fields import fault, scalar_at
from app.studies.requests import Axis, Overrides, Sample, Scalar, SweepRequest


@dataclass(frozen=True, slots=True)
class PlannedAxis:
    """One axis: its fields, and its values where they are the same at every point."""

    path: str | list[str]
    unit: str | None
    values: list[Scalar] | None

    @property
    def paths(self) -> list[str]:
        """The fields that take the values."""
        return self.path if isinstance(self.path, list) else [self.path]


@dataclass(frozen=True, slots=True)
class Plan:
    """The points of a sweep in order: `at` says where each is, `overrides` what it changes."""

    axes: list[PlannedAxis]
    total: int
    cases: list[Overrides] | None
    sample: np.ndarray[Any, Any] | None

    def at(self, index: int) -> list[Scalar] | Overrides:
        """Coordinates of a point, or its overrides in a list of cases."""
        if self.cases is not None:
            return self.cases[index]
        if self.sample is not None:
            return [float(value) for value in self.sample[index]]
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
        return {path: value for axis, value in zip(self.axes, at, strict=True) for path in axis.paths}

def plan(sweep: SweepRequest, model: type[Documented], most: int) -> Plan:
    """The points of a sweep over requests of this model; at most `most`.

    Raises StudyRefused with a pointer into the sweep for whatever the schema already tells to be impossible.
    """
    if sweep.cases is not None:
        _check_count(len(sweep.cases), most, "/cases")
        for place, case in enumerate(sweep.cases):
            for path, value in case.items():
                _check_value(_leaf(path, model, f"/cases/{place}"), value, f"/cases/{place}")
        return Plan([], len(sweep.cases), sweep.cases, None)
    if sweep.sample is not None:
        _check_count(sweep.sample.count, most, "/sample/count")
        return _sampled(sweep.sample, model)
    assert sweep.vary is not None
    _check_count(prod(_length(axis, place) for place, axis in enumerate(sweep.vary)), most, "/vary")
    _check_distinct([path for axis in sweep.vary for path in axis.paths], "/vary")
    axes = [_planned(axis, model, f"/vary/{place}") for place, axis in enumerate(sweep.vary)]
    return Plan(axes, prod(len(axis.values or ()) for axis in axes), None, None)


def _check_count(count: int, most: int, pointer: str) -> None:
    if count > most:
        raise StudyRefused(pointer, "too_many_points", f"the sweep has {count} points; at most {most} are allowed")


def _check_distinct(paths: list[str], pointer: str) -> None:
    for path in paths:
        if paths.count(path) > 1:
            raise StudyRefused(pointer, "duplicate_path", f"{path} is varied twice")


def _length(axis: Axis, place: int) -> int:
    """How many values an axis has; either they are listed, or they are spread."""
    spread = (axis.start, axis.stop, axis.count)
    if axis.values is not None and all(part is None for part in spread):
        return len(axis.values)
    if axis.values is None and axis.count is not None and all(part is not None for part in spread):
        return axis.count
    raise StudyRefused(f"/vary/{place}", "values_or_range", "give either values, or start, stop and count")


def _planned(axis: Axis, model: type[Documented], pointer: str) -> PlannedAxis:
    fields = [_leaf(path, model, f"{pointer}/path") for path in axis.paths]
    values = axis.values if axis.values is not None else _spread(axis, pointer)
    for field in fields:
        for value in values:
            _check_value(field, value, pointer)
    whole = all(field.kind == "integer" for field in fields)
    if whole:
        values = [int(value) if isinstance(value, float) else value for value in values]
    return PlannedAxis(axis.path, fields[0].unit, values)


def _spread(axis: Axis, pointer: str) -> list[Scalar]:
    assert axis.start is not None
    assert axis.stop is not None
    assert axis.count is not None
    if axis.scale == "log":
        if min(axis.start, axis.stop) <= 0.0:
            raise StudyRefused(pointer, "log_needs_positive", "a logarithmic axis needs start and stop above zero")
        return [float(value) for value in np.geomspace(axis.start, axis.stop, axis.count)]
    return [float(value) for value in np.linspace(axis.start, axis.stop, axis.count)]


def _sampled(sample: Sample, model: type[Documented]) -> Plan:
    """The random points, the same for the same seed."""
    _check_distinct([each.path for each in sample.ranges], "/sample/ranges")
    fields = []
    for place, each in enumerate(sample.ranges):
        pointer = f"/sample/ranges/{place}"
        field = _leaf(each.path, model, f"{pointer}/path")
        if field.kind == "integer":
            raise StudyRefused(pointer, "not_integer", f"{each.path} takes whole numbers; vary it or list cases")
        for value in (each.min, each.max):
            _check_value(field, value, pointer)
        if each.min > each.max:
            raise StudyRefused(pointer, "out_of_range", f"{each.path}: min lies above max")
        fields.append(field)
    axes = [PlannedAxis(field.path, field.unit, None) for field in fields]
    lower = np.array([each.min for each in sample.ranges])
    width = np.array([each.max for each in sample.ranges]) - lower
    return Plan(axes, sample.count, None, lower + width * _unit_cube(sample, len(fields)))


def _unit_cube(sample: Sample, dimensions: int) -> np.ndarray[Any, Any]:
    """Points in the unit cube."""
    if sample.method == "sobol":
        exponent = sample.count.bit_length() - 1
        if sample.count != 1 << exponent:
            raise StudyRefused("/sample/count", "not_power_of_two", "a Sobol sample needs a power of two of points")
        return np.asarray(qmc.Sobol(dimensions, rng=sample.seed).random_base2(exponent))
    return np.asarray(qmc.LatinHypercube(dimensions, rng=sample.seed).random(sample.count))


def _leaf(path: str, model: type[Documented], pointer: str) -> Leaf:
    """The single value of a request that a path names."""
    return scalar_at(model, path, pointer, "unknown_path")


def _check_value(field: Leaf, value: Scalar, pointer: str) -> None:
    """Refuse a value that the field's schema does not take."""
    found = fault(field, value)
    if found is not None:
        code, message = found
        raise StudyRefused(pointer, code, f"{field.path}: {message}")
