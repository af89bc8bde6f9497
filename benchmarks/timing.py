"""Measure the run times of a benchmark, and optionally compare two versions of the solvers in the same run.

If a benchmark is run with `--against REVISION`, the other version is a copy of the sources of this revision, with the
present benchmarks. If a benchmark is run with `--processor NAME`, the other version is the present sources, compiled
for the processor with this name in LLVM. Each version runs in its own process, and the two processes measure in turn.
Other work on the machine therefore slows both versions, and the ratio of the times remains valid.
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
    """A row of the table: the name of the row, the function that is timed, and the target of the time [ms]."""

    name: str
    run: Callable[[], object]
    target: float

    def seconds(self) -> float:
        """Return the shortest CPU time of a run [s]."""
        return best(self.run)


@dataclass(frozen=True, slots=True)
class MedianFigure:
    """A row of the table: the name of the row, the functions that are timed, and the target of the median time [ms]."""

    name: str
    runs: Sequence[Callable[[], object]]
    target: float

    def seconds(self) -> float:
        """Run each function once, and return the median of the CPU times [s]."""
        return median(_duration(run) for run in self.runs)


def best(run: Callable[[], object]) -> float:
    """Return the shortest CPU time of several runs of a function [s].

    An additional first run warms up the function. The shortest time counts, because other work only adds time.
    """
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
    """Read the options of the command line, and print the table of a benchmark.

    `benchmark` is the name of the module of the benchmark, and `figures` are the rows of the table.
    """
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
    """Print the times of the present version and of the other version, and the ratio of the times.

    Both versions are measured `ROUNDS` times in turn. The printed times are the shortest of these rounds. The ratio is
    the time of the other version divided by the time of the present version; the median over the rounds is printed.
    """
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
    """Create a temporary folder with the sources of a revision and with the present benchmarks."""
    archive = subprocess.run(["git", "archive", revision], cwd=ROOT, capture_output=True, check=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        with tarfile.open(fileobj=BytesIO(archive)) as sources:
            sources.extractall(folder, filter="data")
        shutil.rmtree(Path(folder, "benchmarks"), ignore_errors=True)
        shutil.copytree(ROOT / "benchmarks", Path(folder, "benchmarks"))
        yield Path(folder)


@contextmanager
def _process(benchmark: str, folder: Path, **variables: str) -> Iterator[subprocess.Popen[str]]:
    """Start a process that measures the times of the sources in a folder.

    `variables` are additional environment variables of the process.
    """
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
    """Let a process measure the time of the figure with this index, and return the time [s]."""
    assert process.stdin is not None
    assert process.stdout is not None
    print(index, file=process.stdin, flush=True)
    return float(process.stdout.readline())


def _answer(figures: Sequence[Figure | MedianFigure]) -> None:
    """Read indices of figures from the standard input, and print the time of each of these figures [s]."""
    for line in sys.stdin:
        print(figures[int(line)].seconds(), flush=True)
