"""The stages in which kernels are compiled and loaded: examples that between them touch every one.

`python -m app.workers.stages` compiles all of them and keeps the machine code on disk.
"""

import os
import sys
from collections.abc import Callable, Iterable
from importlib import import_module

from numba.core import event

from app.calculations import (
    BY_PATH,
    CALCULATIONS,
    COUPLING,
    DRIVE_TRAIN,
    LINE_CONTACT,
    LOADS,
    PUMPING,
    SLEEVE,
    Stage,
)
from app.evaluate import drawn, json_answer
from app.examples import examples
from solvers.kernel_cache import discard, mark_complete

# Slow to load or asked for by studies: random samples need scipy.stats, a drawing half a second and 70 MB.
FIGURES = Stage("figures and studies", 0, ())
MODULES = ("scipy.stats", "app.figures.drawing.image", "app.studies.sweep")
DRAWN = COUPLING.examples[0]

# What two cores compile side by side, each in this order. The line contact takes as long as all others together, and
# needs of them only the load distribution, late.
TRACKS = ((COUPLING, SLEEVE, LOADS, PUMPING, DRIVE_TRAIN, FIGURES), (LINE_CONTACT,))
STAGES = tuple(stage for track in TRACKS for stage in track)


# A new worker answers these two before its first call (1 and 8 ms): writing to a page of memory that it shares with the
# template copies the page, which would double the time of a first call, and these touch most of what others touch.
TOUCHING = (COUPLING, LOADS)


def content() -> str:
    """What a cache holds that is complete."""
    return " ".join(name for stage in STAGES for name in stage.examples)


def needed_for(endpoint: str) -> Stage:
    """The stage after which an endpoint answers."""
    calculation = BY_PATH.get(endpoint)
    return calculation.stage if calculation else STAGES[-1]


def stage_of(name: str) -> Stage:
    """The stage of this name."""
    return next(stage for stage in STAGES if stage.name == name)


def calculate(name: str) -> None:
    """Answer one example."""
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    json_answer(calculation, calculation.request.model_validate(example.request))


_warm: set[Stage] = set()  # in this process


def warm(stage: Stage) -> int:
    """Load what the stage needs; how many kernels were not kept and had to be compiled."""
    with event.install_recorder("numba:compile") as compilations:
        for name in stage.examples:
            calculate(name)
        if stage is FIGURES:
            for module in MODULES:
                import_module(module)
            _draw()
    _warm.add(stage)
    return sum(each.is_end for _, each in compilations.buffer)


def touch_shared_memory() -> None:
    """Make this process's own copy of the memory that calculations write to."""
    for stage in TOUCHING:
        if stage in _warm:
            calculate(stage.examples[0])


def _draw() -> None:
    """Load what draws figures."""
    example = examples()[DRAWN]
    calculation = BY_PATH[example.endpoint]
    request = calculation.request.model_validate(example.request)
    drawn(calculation, calculation.figures[0], request, "svg", "light")


class _Told(event.Listener):
    """Tells of every kernel that is compiled."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def on_start(self, event: object) -> None:
        """A compilation begins: nothing to tell."""

    def on_end(self, _event: object) -> None:
        """A kernel is compiled."""
        self._tell("kernel")


def compile_stages(names: Iterable[str], tell: Callable[[str], None]) -> None:
    """Have the kernels of these stages on disk; `tell` hears "kernel" for each and "stage" when one is done."""
    with event.install_listener("numba:compile", _Told(tell)):
        for name in names:
            for example in stage_of(name).examples:
                calculate(example)
            tell("stage")


def discard_kernels(stage: Stage) -> None:
    """Remove the kept kernels of the modules that the stage's endpoints call."""
    for calculation in CALCULATIONS:
        if calculation.stage is stage:
            discard(calculation.solve.__module__)


def main() -> None:
    """Compile all stages in another process, then load them in this one, which tells whether every kernel was kept."""
    if os.fork() == 0:
        compile_stages([stage.name for stage in STAGES], print)
        os._exit(0)
    _, status = os.wait()
    missing = sum(map(warm, STAGES))
    if status or missing:
        sys.exit(f"tribodrive: {missing} kernels could not be kept")
    mark_complete(content())


if __name__ == "__main__":
    main()
