"""Load spectra: a machine with its tolerances over its cases, and the probability that it exceeds its limits."""

import copy
from array import array
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from app.calculations import Calculation
from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.schema.reading import read
from app.studies import probability
from app.studies.distributions import anchors, cut, drawn, unit_cube
from app.studies.drive_train import reduced_request
from app.studies.engine import Pool, twice_if_lost
from app.studies.fields import NUMBERS, set_value
from app.studies.point_sets import BaseRequest, check_case, scattering
from app.studies.points import Point, Question, solve_point
from app.studies.probability import Array, Limit, Side
from app.studies.requests import DRIVE_TRAIN, Case, Overrides, SpectrumLimit, SpectrumRequest, Tolerances
from app.studies.stream import Clock, Line, Lines, point_line
from app.studies.study import (
    Study,
    calculation_of,
    case_of_study,
    checked_base,
    output_at,
    output_header,
    outputs_at,
    paths_of,
)
from app.studies.summary import merge_assumption

PATH = "/v1/spectrum"
PROGRESS_S = 0.5  # between two lines that say how far a spectrum has come
BY_FILM = frozenset({"film.min_at_psi", "film.thickness_ratio", "unsolved_points"})
SOLVED = ("ok", "ok_with_warnings")
KILOWATTS = {"W": 1e-3, "kW": 1.0}
RELATIVE_DEVIATION = 0.15
LIMIT_VARIES = 1e-9  # relative
SHARES_OFF = 0.01  # how far the sum of the shares may be from 1
ASSUMED_DEVIATION = (
    "the scuffing temperature is normally distributed with 0.15 of itself as deviation (AGMA 925-A03, from memory)"
)

NO_MEAN = {"mean": None, "standard_error": None, "interval": None}


class Scuffing(NamedTuple):
    """The paths of contact temperature and scuffing temperature in an answer."""

    contact: str
    limit: str


SCUFFING = {
    "/v1/scuffing": Scuffing("contact_temperature.blok_max_c", "safety.scuffing_c"),
    DRIVE_TRAIN: Scuffing("flash.contact_max_c", "derived.temperatures.scuffing_c"),
}


@dataclass(frozen=True, slots=True)
class Scattering:
    """The machines of a study: values of the fields that scatter, a row a machine, replicate after replicate."""

    asked: Tolerances
    leaves: list[Leaf]
    values: Array

    def header(self) -> Line:
        """How the machines are drawn, and what share of each distribution is cut off."""
        inputs = [
            {**each.model_dump(), "unit": leaf.unit, "title": leaf.title, "cut_off": cut(each, leaf).cut_off}
            for each, leaf in zip(self.asked.inputs, self.leaves, strict=True)
        ]
        return {**self.asked.model_dump(), "inputs": inputs}


class NamedLimit(NamedTuple):
    """A limit on the output at a path."""

    output: str
    limit: Limit

    def header(self) -> Line:
        """What the answer says of it; a fixed limit has no deviation."""
        side, mean, deviation = self.limit
        return {"output": self.output, "side": side, "mean": mean, "deviation": deviation or None}


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectrum(Study):
    """A machine, drawn `draws` times, over its cases; the points are every case of the first machine, then the next.

    Where no limits are given, the columns behind the outputs hold the scuffing temperature.
    """

    cases: list[Overrides]
    names: list[str]
    shares: list[float]
    scattering: Scattering | None
    limits: list[NamedLimit] | None
    hours_per_year: float | None
    points: bool

    @property
    def replicates(self) -> int:
        """How many independent samples there are."""
        return self.scattering.asked.replicates if self.scattering else 1

    @property
    def draws(self) -> int:
        """How many machines run the spectrum."""
        return len(self.scattering.values) if self.scattering else 1

    @property
    def total(self) -> int:
        """How many points it has."""
        return self.draws * len(self.cases)

    def machine(self, draw: int) -> Overrides:
        """What a machine has in place of the nominal values."""
        if self.scattering is None:
            return {}
        return dict(zip(paths_of(self.scattering.leaves), self.scattering.values[draw].tolist(), strict=True))

    def overrides(self, index: int) -> Overrides:
        """What a point changes in the base request."""
        draw, case = divmod(index, len(self.cases))
        return {**self.machine(draw), **self.cases[case]}

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, the points if they are asked for, how far it has come, the end."""
        yield [
            self.header(
                "spectrum",
                cases=[
                    {"name": name, "share": share, "set": case}
                    for name, share, case in zip(self.names, self.shares, self.cases, strict=True)
                ],
                tolerances=self.scattering.header() if self.scattering else None,
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=self.total,
            )
        ]
        found, due = Found(len(self.question.outputs)), PROGRESS_S
        async for indices, points in self.solve(pool, clock, self.overrides, self.total):
            for point in points:
                found.add(point)
            lines = [self._line(*each) for each in zip(indices, points, strict=True)] if self.points else []
            if clock.elapsed_s >= due:
                lines.append(clock.line())
                due = clock.elapsed_s + PROGRESS_S
            yield lines
        values = found.values.reshape(self.replicates, -1, len(self.cases), len(self.question.outputs))
        statistics = await twice_if_lost(pool, evaluated, self, values)
        yield [
            {
                "type": "end",
                **statistics,
                "points": self.total,
                "counts": dict(sorted(found.counts.items())),
                "errors": dict(sorted(found.errors.items())),
                "warnings": dict(sorted(found.warnings.items())),
                "assumptions": [*statistics["assumptions"], *found.assumptions.values()],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _line(self, index: int, point: Point) -> Line:
        draw, case = divmod(index, len(self.cases))
        own = point._replace(out=point.out[: len(self.outputs)])
        return {**point_line(index, self.overrides(index), own), "draw": draw, "case": case}


class Found:
    """Gathers points as they pass: every number, NaN where a point has none or no solution; warnings."""

    def __init__(self, outputs: int) -> None:
        self._numbers = array("d")
        self._outputs = outputs
        self.counts: Counter[str] = Counter()
        self.errors: Counter[str] = Counter()
        self.warnings: Counter[str] = Counter()
        self.assumptions: dict[str, dict[str, Any]] = {}

    @property
    def values(self) -> Array:
        """A row a point."""
        return np.array(self._numbers).reshape(-1, self._outputs)

    def add(self, point: Point) -> None:
        """Take in the next point, in order."""
        self.counts[point.status] += 1
        solved = point.status in SOLVED
        self._numbers.extend(nan if value is None or not solved else float(value) for value in point.out)
        if point.error is not None:
            self.errors[point.error["code"]] += 1
        self.warnings.update(point.warnings)
        for each in point.assumptions:
            merge_assumption(self.assumptions, each)


def evaluated(study: Spectrum, values: Array) -> Line:
    """What the answer's end says of the outputs `[replicate, draw, case, output]`; runs in a worker."""
    columns = {path: values[..., place] for place, path in enumerate(study.question.outputs)}
    limits, assumptions, notes = _limits(study, columns)
    shown = {leaf.path: columns[leaf.path] for leaf in study.outputs}
    return {
        "cases": [
            {
                "name": name,
                "share": study.shares[place],
                "unsolved": float(np.isnan(values[:, :, place]).all(axis=-1).mean()),
                "means": {path: _mean(column[..., place]) for path, column in shown.items()},
                "quantiles": {path: probability.quantiles(column[..., place]) for path, column in shown.items()},
                "limits": [
                    probability.of_case(columns[each.output][..., place], each.limit)._asdict() for each in limits
                ],
            }
            for place, name in enumerate(study.names)
        ],
        "limits": [_of_limit(study, each, columns[each.output]) for each in limits],
        "outputs": {leaf.path: _of_output(study, leaf, columns[leaf.path]) for leaf in study.outputs},
        "notes": notes,
        "assumptions": assumptions,
    }


def _limits(study: Spectrum, columns: dict[str, Array]) -> tuple[list[NamedLimit], list[Line], list[str]]:
    """The limits in force, those assumed for want of others, and what is to be said of them."""
    if study.limits is not None:
        return study.limits, [], []
    paths = SCUFFING[study.question.endpoint]
    known = columns[paths.limit][~np.isnan(columns[paths.limit])]
    if not known.size:
        return [], [], ["no limit is given, and the request has no scuffing temperature"]
    mean = float(known[0])
    limit = NamedLimit(paths.contact, Limit("above", mean, RELATIVE_DEVIATION * abs(mean)))
    assumption = {"field": "limits", "value": limit.limit.deviation, "reason": ASSUMED_DEVIATION}
    varies = np.ptp(known) > LIMIT_VARIES * abs(mean)
    note = (
        f"the scuffing temperature differs between the cases; the limit is that of the first, {mean:.4g}; give limits"
    )
    return [limit], [assumption], [note] if varies else []


def _of_limit(study: Spectrum, named: NamedLimit, outputs: Array) -> Line:
    """The probability of the spectrum, what decides it, and which tolerance matters."""
    worst, edges_and_density = named.limit.worst(outputs), probability.histogram(named.limit.worst(outputs))
    solved = ~np.isnan(outputs).any(axis=-1).ravel()
    correlation = None
    if study.scattering:
        correlation = {
            leaf.path: probability.rank_correlation(column[solved], worst.ravel()[solved])
            for leaf, column in zip(study.scattering.leaves, study.scattering.values.T, strict=True)
        }
    return {
        **named.header(),
        **probability.of_spectrum(outputs, named.limit)._asdict(),
        "unsolved": 1.0 - float(solved.mean()),
        "decides": probability.deciding(outputs.reshape(-1, outputs.shape[-1]), named.limit),
        "rank_correlation": correlation,
        "quantiles": probability.quantiles(worst),
        "histogram": dict(zip(("edges", "density"), edges_and_density, strict=True)),
    }


def _of_output(study: Spectrum, leaf: Leaf, column: Array) -> Line:
    """Its mean over the spectrum, the energy that it adds up to in a year, and its extremes."""
    mean = probability.weighted_mean(column, study.shares)
    content: Line = mean._asdict() if mean else dict(NO_MEAN)
    scale = KILOWATTS.get(leaf.unit or "")
    if mean is not None and scale is not None and study.hours_per_year is not None:
        content["energy_kwh_per_year"] = mean.mean * scale * study.hours_per_year
    flat = column.ravel()
    if np.isnan(flat).all():
        return {**content, "min": None, "max": None}
    ends = {"min": int(np.nanargmin(flat)), "max": int(np.nanargmax(flat))}
    return {**content, **{end: _extreme(study, float(flat[index]), index) for end, index in ends.items()}}


def _extreme(study: Spectrum, value: float, index: int) -> Line:
    draw, case = divmod(index, len(study.cases))
    return {"value": value, "case": case, "draw": draw, "at": study.overrides(index)}


def _mean(values: Array) -> float | None:
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else None


def spectrum_study(body: bytes, most: int, deadline_s: float) -> Spectrum:
    """The spectrum in a body, of at most `most` points; runs in a worker.

    Raises Unreadable, InvalidBody and Unprocessable, with locations in the body.
    """
    request = read(SpectrumRequest, body)
    calculation = calculation_of(request)
    outputs = _outputs(calculation, request)
    base = BaseRequest(calculation.request, request.request)
    cases = [each.set for each in request.cases]
    known: dict[str, Leaf] = {}
    for place, case in enumerate(cases):
        check_case(case, base, f"cases.{place}.set", known)
    tolerances = request.tolerances
    leaves = scattering(tolerances.inputs, base, "tolerances.inputs") if tolerances else []
    for place, leaf in enumerate(leaves):
        if leaf.path in known:
            message = f"{leaf.path} has a value in a case; a field either scatters or is set"
            raise Unprocessable("duplicate_path", message, f"tolerances.inputs.{place}.path")
    wanted = paths_of(outputs)
    if request.limits is None and calculation.path in SCUFFING:
        wanted = list(dict.fromkeys([*wanted, *SCUFFING[calculation.path]]))
    question = Question(calculation.path, _lightened(calculation, request.request, wanted), wanted, deadline_s)
    typical = {each.path: anchors(each)[0] for each in tolerances.inputs} if tolerances else {}
    for case in cases:
        checked_base(calculation, request.request, {**typical, **case})
    total = len(cases) * (tolerances.count * tolerances.replicates if tolerances else 1)
    if total > most:
        where = "tolerances.count" if tolerances else "cases"
        raise Unprocessable("too_many_points", _too_many(question, {**typical, **cases[0]}, total, most), where)
    return Spectrum(
        question=question,
        outputs=outputs,
        case=case_of_study(PATH, request),
        cases=cases,
        names=[each.name or f"case {place + 1}" for place, each in enumerate(request.cases)],
        shares=_shares(request.cases),
        scattering=Scattering(tolerances, leaves, _machines(tolerances, leaves)) if tolerances else None,
        limits=_given_limits(request.limits, calculation),
        hours_per_year=request.hours_per_year,
        points=request.points,
    )


def _lightened(calculation: Calculation, request: dict[str, Any], outputs: list[str]) -> dict[str, Any]:
    """The request without the thermal film where no output needs it; the outputs are the same."""
    if calculation.path == DRIVE_TRAIN:
        return reduced_request(request, outputs)
    if calculation.path != "/v1/scuffing" or any("thermal_ehl" in path or path in BY_FILM for path in outputs):
        return request
    light = copy.deepcopy(request)
    set_value(calculation.request, light, "model.lubrication", "closed_form")
    return light


def _outputs(calculation: Calculation, request: SpectrumRequest) -> tuple[Leaf, ...]:
    """The outputs asked for, by default the headline numbers, and those that are limited; raises Unprocessable."""
    found = outputs_at(calculation, request.outputs)
    if request.outputs is None:
        found = tuple(leaf for leaf in found if leaf.kind in NUMBERS)
    limited = [
        output_at(calculation, each.output, f"limits.{place}.output") for place, each in enumerate(request.limits or ())
    ]
    for place, leaf in enumerate((*found, *limited)):
        if leaf.kind not in NUMBERS:
            where = f"outputs.{place}" if place < len(found) else f"limits.{place - len(found)}.output"
            raise Unprocessable("unknown_output", f"{leaf.path} is no number", where)
    if request.limits is None and calculation.path in SCUFFING:
        limited = [output_at(calculation, SCUFFING[calculation.path].contact, "limits")]
    return tuple({leaf.path: leaf for leaf in (*found, *limited)}.values())


def _given_limits(limits: Sequence[SpectrumLimit] | None, calculation: Calculation) -> list[NamedLimit] | None:
    """The limits of a request; None where those of the calculation count."""
    if limits is None:
        return None if calculation.path in SCUFFING else []
    found = []
    for each in limits:
        side: Side = "above" if each.above else "below"
        threshold = each.above or each.below
        assert threshold is not None
        mean = threshold.mean if threshold.value is None else threshold.value
        assert mean is not None
        found.append(NamedLimit(each.output, Limit(side, mean, threshold.deviation or 0.0)))
    return found


def _shares(cases: Sequence[Case]) -> list[float]:
    """The shares of the operating time, whose sum is 1; raises Unprocessable."""
    given = [each.share for each in cases if each.share is not None]
    if not given:
        return [1.0 / len(cases)] * len(cases)
    if len(given) < len(cases):
        raise Unprocessable("shares", "give every case its share, or none", "cases")
    whole = sum(given)
    if abs(whole - 1.0) > SHARES_OFF + 1e-12:
        raise Unprocessable(
            "shares", f"the shares add up to {whole:.6g}; give fractions of the time that add up to 1", "cases"
        )
    return [each / whole for each in given]


def _machines(tolerances: Tolerances, leaves: Sequence[Leaf]) -> Array:
    """The values that scatter, a row a machine; each replicate is a random sample of its own."""
    seeds = np.random.SeedSequence(tolerances.seed).spawn(tolerances.replicates)
    cubes = [
        unit_cube(tolerances.method, tolerances.count, len(leaves), np.random.default_rng(seed), "tolerances.count")
        for seed in seeds
    ]
    return drawn(tolerances.inputs, leaves, np.concatenate(cubes))


def _too_many(question: Question, overrides: Overrides, total: int, most: int) -> str:
    """What a study of too many points would take, by one of them."""
    solve_point(question, overrides)  # the first one may load kernels
    started = perf_counter()
    solve_point(question, overrides)
    seconds = perf_counter() - started
    return (
        f"cases x machines are {total} solutions; at most {most} are allowed. One takes some {seconds:.2g} s, "
        f"all of them {total * seconds:,.0f} s on one core"
    )
