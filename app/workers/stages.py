"""The stages in which kernels are compiled and loaded: examples that between them touch every one.

`python -m app.workers.stages` compiles all of them and keeps the machine code on disk.
"""

import logging
import os
import sys
from collections.abc import Callable

from numba.core import event

from app.calculations import BY_PATH, COUPLING, DRIVE_TRAIN, LINE_CONTACT, LOADS, PUMPING, SLEEVE, Calculation, Stage
from app.evaluate import drawn, json_answer
from app.examples import examples
from app.schema.model import Request
from solvers.kernel_cache import mark_complete

FIGURES = Stage("figures and studies", 0, ())  # no kernels, but slow to load

# What two cores compile side by side, each in this order. The line contact takes as long as all others together, and
# needs of them only the load distribution, late.
TRACKS = ((COUPLING, SLEEVE, LOADS, PUMPING, DRIVE_TRAIN, FIGURES), (LINE_CONTACT,))
STAGES = tuple(stage for track in TRACKS for stage in track)

# A new worker answers these two before its first call (1 and 8 ms): writing to a page of memory that it shares with the
# template copies the page, which would double the time of a first call, and these touch most of what others touch.
TOUCHING = (COUPLING, LOADS)

logger = logging.getLogger("tribodrive")


def content() -> str:
    """Names of the examples whose kernels a complete cache holds."""
    return " ".join(name for stage in STAGES for name in stage.examples)


def calculate(name: str) -> None:
    """Answer one example."""
    json_answer(*_case(name))


def _case(name: str) -> tuple[Calculation, Request]:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    return calculation, calculation.request.model_validate(example.request)


class _Compilations(event.Listener):
    """Counts the kernels that are compiled."""

    def __init__(self, notify: Callable[[], object]) -> None:
        self.count = 0
        self._notify = notify

    def on_start(self, event: object) -> None:
        """A compilation begins."""

    def on_end(self, _event: object) -> None:
        """A kernel is compiled."""
        self.count += 1
        self._notify()


_warm: set[Stage] = set()  # in this process


def warm(stage: Stage, notify: Callable[[], object] = lambda: None) -> int:
    """Load what the stage needs; how many kernels were not on disk and had to be compiled, `notify` called for each."""
    compilations = _Compilations(notify)
    with event.install_listener("numba:compile", compilations):
        for name in stage.examples:
            _calculate_with(compilations, name)
    if stage == FIGURES:  # half a second and 70 MB
        import scipy.stats  # noqa: F401, PLC0415  for random samples

        calculation, request = _case(COUPLING.examples[0])
        drawn(calculation, calculation.figures[0], request, "svg", "light")
    _warm.add(stage)
    return compilations.count


def _calculate_with(compilations: _Compilations, name: str) -> None:
    """Answer one example; again where numba raises as a kernel cannot be written to disk, it keeps that in memory."""
    while True:
        before = compilations.count
        try:
            return calculate(name)
        except OSError as error:
            if compilations.count == before:
                raise
            logger.warning("a compiled kernel could not be kept on disk: %s", error)


def touch_shared_memory() -> None:
    """Make this process's own copy of the memory that calculations write to."""
    for stage in _warm.intersection(TOUCHING):
        calculate(stage.examples[0])


def main() -> None:
    """Compile all stages in another process, then load them in this one, which tells whether every kernel was kept."""
    if os.fork() == 0:
        for stage in STAGES:
            warm(stage)
        os._exit(0)
    _, status = os.wait()
    missing = sum(map(warm, STAGES))
    if status or missing:
        sys.exit(f"tribodrive: {missing} kernels could not be kept")
    mark_complete(content())


if __name__ == "__main__":
    main()
