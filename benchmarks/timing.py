"""Times of a benchmark's figures, beside those of a previous version, or of another target, in the same run.

`--against REVISION` of a benchmark puts the revision's sources, with the benchmarks of today, into a folder of their
own; `--processor NAME` compiles today's for a processor that LLVM knows by this name. One process of each answers in
turn: what else the machine does meets both, and their ratio holds.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from statistics import median
from time import process_time

ROOT = Path(__file__).resolve().parent.parent
ROUND_S = 0.15
LEAST_RUNS = 3  # of a round
ROUNDS = 9  # in turn
ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
ANSWERS_FOR = "--answers-for-another-process"


@dataclass(frozen=True, slots=True)
class Figure:
    """Name of a figure, the function that is timed, and its target time [ms]."""

    name: str
    run: Callable[[], object]
    target: float

    def seconds(self) -> float:
        """Measure the time of a run [s]."""
        return best(self.run)


@dataclass(frozen=True, slots=True)
class MedianFigure:
    """Name of a figure, the functions whose median time is taken, and its target time [ms]."""

    name: str
    runs: Sequence[Callable[[], object]]
    target: float

    def seconds(self) -> float:
        """Measure the median time of the runs [s], each timed once."""
        return median(_duration(run) for run in self.runs)


def best(run: Callable[[], object]) -> float:
    """Return the shortest CPU time of a run [s], after one that warms up: other work only adds time."""
    run()
    times: list[float] = []
    while len(times) < LEAST_RUNS or sum(times) < ROUND_S:
        times.append(_duration(run))
    return min(times)


def _duration(run: Callable[[], object]) -> float:
    """Measure the CPU time of one run [s]."""
    began = process_time()
    run()
    return process_time() - began


def print_times(benchmark: str, figures: Sequence[Figure | MedianFigure]) -> None:
    """Print the table of a benchmark (the name of its module), with the options of the command line."""
    parser = argparse.ArgumentParser()
    other = parser.add_mutually_exclusive_group()
    other.add_argument("--against", metavar="REVISION", help="print the times of a previous version too")
    other.add_argument("--processor", metavar="NAME", help="print the times of kernels for this processor too")
    parser.add_argument("--only", metavar="TEXT", default="", help="print the figures whose names hold a text")
    parser.add_argument(ANSWERS_FOR, action="store_true", dest="answers", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.answers:
        _answer(figures)
        return
    wanted = [index for index, figure in enumerate(figures) if arguments.only in figure.name]
    if arguments.against or arguments.processor:
        _print_ratios(benchmark, figures, wanted, arguments.against, arguments.processor)
        return
    print("| figure | measured | aim |\n|---|---|---|")
    for figure in (figures[index] for index in wanted):
        print(f"| {figure.name} | {1e3 * figure.seconds():.2f} ms | {figure.target:g} ms |", flush=True)


def _print_ratios(
    benchmark: str,
    figures: Sequence[Figure | MedianFigure],
    wanted: Sequence[int],
    revision: str | None,
    processor: str | None,
) -> None:
    """Print the best times of both versions, and the median of the ratios of times measured side by side."""
    print(f"| figure | measured | {revision or processor} | ratio | aim |\n|---|---|---|---|---|")
    target = {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": ""} if processor else {}
    with (
        _sources_of(revision) if revision else nullcontext(ROOT) as folder,
        _process(benchmark, ROOT) as now,
        _process(benchmark, folder, **target) as before,
    ):
        for index in wanted:
            figure = figures[index]
            pairs = [(_ask_time(now, index), _ask_time(before, index)) for _ in range(ROUNDS)]
            ours, theirs = (1e3 * min(times) for times in zip(*pairs, strict=True))
            ratio = median(old / new for new, old in pairs)
            print(
                f"| {figure.name} | {ours:.2f} ms | {theirs:.2f} ms | {ratio:.2f} | {figure.target:g} ms |", flush=True
            )


@contextmanager
def _sources_of(revision: str) -> Iterator[Path]:
    """Create a folder with a revision's sources and today's benchmarks."""
    archive = subprocess.run(["git", "archive", revision], cwd=ROOT, capture_output=True, check=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        with tarfile.open(fileobj=BytesIO(archive)) as sources:
            sources.extractall(folder, filter="data")
        shutil.rmtree(Path(folder, "benchmarks"), ignore_errors=True)
        shutil.copytree(ROOT / "benchmarks", Path(folder, "benchmarks"))
        yield Path(folder)


@contextmanager
def _process(benchmark: str, folder: Path, **variables: str) -> Iterator[subprocess.Popen[str]]:
    """Start a process that times the sources in a folder; both versions share the cache of kernels."""
    command = [sys.executable, "-m", benchmark, ANSWERS_FOR]
    environment = {**os.environ, **ONE_THREAD, **variables}
    with subprocess.Popen(
        command, cwd=folder, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            yield process
        finally:
            process.terminate()


def _ask_time(process: subprocess.Popen[str], index: int) -> float:
    """Return the best time of a figure [s], measured by the process."""
    assert process.stdin is not None
    assert process.stdout is not None
    print(index, file=process.stdin, flush=True)
    return float(process.stdout.readline())


def _answer(figures: Sequence[Figure | MedianFigure]) -> None:
    """Time the figures whose numbers arrive on standard input."""
    for line in sys.stdin:
        print(figures[int(line)].seconds(), flush=True)
