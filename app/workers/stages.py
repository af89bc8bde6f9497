"""The stages in which kernels are compiled: examples that between them call every kernel."""

import threading
from collections.abc import Sequence

from numba.core import event

from app.calculations import BY_PATH, COUPLING, DRIVE_TRAIN, LINE_CONTACT, LOADS, PUMPING, SLEEVE, Stage
from app.evaluate import answer_of
from app.examples import examples

STAGES = (COUPLING, SLEEVE, LOADS, PUMPING, DRIVE_TRAIN, LINE_CONTACT)
BESIDE = LINE_CONTACT
"""Takes as long as all others together, and needs of them only the load distribution, late."""
SHOW_S = 1.0  # between two lines of progress


def warm(stage: Stage) -> None:
    """Have every kernel of a stage in this process, and on disk if there is a folder for them."""
    for name in stage.examples:
        example = examples()[name]
        answer_of(example.endpoint, BY_PATH[example.endpoint].request.model_validate(example.request))


def compile_stages(stages: Sequence[Stage]) -> None:
    """Compile stages and print how far each of them is, every second; 100 % when its kernels are on disk."""
    for stage in stages:
        done = threading.Event()
        with event.install_recorder("numba:compile") as recorder:

            def show(
                stage: Stage = stage, done: threading.Event = done, events: Sequence[object] = recorder.buffer
            ) -> None:
                while not done.wait(SHOW_S):  # an event when the compilation of a kernel begins, and one when it ends
                    print(f"{stage.name}: {min(99, 50 * len(events) // stage.kernels)} %", flush=True)  # noqa: T201

            threading.Thread(target=show, daemon=True).start()
            warm(stage)
            done.set()
        print(f"{stage.name}: 100 %", flush=True)  # noqa: T201
