"""What scatter of the inputs does: quantiles of the figures over a Latin hypercube, and which input they follow."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import binom, qmc, spearmanr

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.studies.outcome import FIGURES, check_figure, outcome
from solvers.drive_train.studies.variation import varied
from solvers.errors import InvalidInput, NoSolution

QUANTILES = (0.05, 0.5, 0.95)
CONFIDENCE = 0.9
LEAST_RUNS, MOST_RUNS = 16, 1024


@dataclass(frozen=True, slots=True)
class Scatter:
    """An input at a dotted name, uniform between two values."""

    name: str
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Quantile:
    """A quantile of a figure and its interval of 90 % confidence by order statistics; None where the runs are too few.

    A bound needs runs beyond it: of 128 runs the 95 % quantile has both, of 20 no upper one.
    """

    share: float
    value: float
    low: float | None
    high: float | None


@dataclass(frozen=True, slots=True)
class Distribution:
    """A figure over the runs: quantiles, share below a `required` value, rank correlation with every input."""

    quantiles: tuple[Quantile, ...]
    share_below: float | None
    rank_correlation: dict[str, float]


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Distributions of the figures; `samples` (runs, inputs) and figures of the runs that have a solution."""

    figures: dict[str, Distribution]
    samples: FloatArray
    values: dict[str, FloatArray]
    seed: int
    failed: int


def run_tolerances(
    inputs: DriveTrainInputs,
    scatters: Sequence[Scatter],
    *,
    runs: int = 128,
    seed: int = 0,
    required: Mapping[str, float] | None = None,
    figures: Sequence[str] = FIGURES,
    progress: Callable[[int, int], None] | None = None,
) -> Tolerances:
    """Quantiles over a Latin hypercube of the inputs.

    Raises InvalidInput (scatter_range, runs_range, unknown_name, unknown_figure and what `outcome` raises); NoSolution
    tolerances where no run has a solution.
    """
    _check(scatters, runs, figures)
    cube = qmc.LatinHypercube(len(scatters), rng=np.random.default_rng(seed)).random(runs)
    low, high = (np.array([getattr(scatter, end) for scatter in scatters]) for end in ("low", "high"))
    kept, rows = [], []
    for done, sample in enumerate(low + cube * (high - low), start=1):
        unit = varied(inputs, {scatter.name: float(x) for scatter, x in zip(scatters, sample, strict=True)})
        try:
            found = outcome(unit)
        except NoSolution:
            continue
        finally:
            if progress is not None:
                progress(done, runs)
        kept.append(sample)
        rows.append([np.nan if (value := getattr(found, name)) is None else value for name in figures])
    if not kept:
        raise NoSolution("tolerances", "no run of the sample has a solution")
    samples, table = np.array(kept), np.array(rows)
    names = [scatter.name for scatter in scatters]
    limits = required or {}
    return Tolerances(
        figures={name: _distribution(names, samples, table[:, i], limits.get(name)) for i, name in enumerate(figures)},
        samples=frozen(samples),
        values={name: frozen(table[:, i]) for i, name in enumerate(figures)},
        seed=seed,
        failed=runs - len(kept),
    )


def _check(scatters: Sequence[Scatter], runs: int, figures: Sequence[str]) -> None:
    for figure in figures:
        check_figure(figure)
    for scatter in scatters:
        if not scatter.low < scatter.high:
            raise InvalidInput("scatter_range", f"{scatter.name} needs a range from low to high", scatter.name)
    if not scatters:
        raise InvalidInput("scatter_range", "name an input that scatters", "scatters")
    if not LEAST_RUNS <= runs <= MOST_RUNS:
        raise InvalidInput("runs_range", f"between {LEAST_RUNS} and {MOST_RUNS} runs", "runs")


def _distribution(names: list[str], samples: FloatArray, values: FloatArray, required: float | None) -> Distribution:
    ordered = np.sort(values)
    constant = ordered[0] == ordered[-1] or bool(np.isnan(ordered).any())
    return Distribution(
        quantiles=tuple(quantile(ordered, share) for share in QUANTILES),
        share_below=None if required is None else float(np.mean(values < required)),
        rank_correlation={
            name: 0.0 if constant else float(spearmanr(samples[:, i], values).statistic) for i, name in enumerate(names)
        },
    )


def quantile(ordered: FloatArray, share: float) -> Quantile:
    """The quantile and the order statistics that hold it with 90 % confidence: ranks are binomial."""
    runs, tail = ordered.size, (1 - CONFIDENCE) / 2
    low, high = int(binom.ppf(tail, runs, share)) - 1, int(binom.ppf(1 - tail, runs, share))
    return Quantile(
        share=share,
        value=float(np.quantile(ordered, share)),
        low=float(ordered[low]) if low >= 0 else None,
        high=float(ordered[high]) if high < runs else None,
    )
