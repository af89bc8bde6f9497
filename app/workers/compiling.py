"""Kernels in a worker: what is loaded at its start, and how the pool learns that a call is compiling."""

from contextlib import suppress
from pathlib import Path

from numba.core import event

from app.evaluate import warm
from app.models.kernels import KERNEL_GROUPS
from solvers.compiled import announcement
from solvers.kernel_cache import FOLDER


class Clock(event.Listener):
    """Keeps a file while numba compiles, so that the pool does not count this time against the deadline of the call."""

    def __init__(self) -> None:
        self.file: Path | None = None  # of the present call
        self._depth = 0

    def on_start(self, event: event.Event) -> None:  # noqa: ARG002
        """Create the file when the outermost compilation begins."""
        self._depth += 1
        if self.file is not None and self._depth == 1:
            with suppress(OSError):
                self.file.touch()

    def on_end(self, event: event.Event) -> None:  # noqa: ARG002
        """Delete the file when the outermost compilation ends."""
        self._depth -= 1
        if self.file is not None and self._depth == 0:
            self.file.unlink(missing_ok=True)


clock = Clock()
event.register("numba:compile", clock)
announcement.mute()


def prepare_kernels() -> None:
    """Compile all kernels now if they cannot be kept on disk; otherwise they are loaded as they are needed."""
    if FOLDER is None:
        for group in KERNEL_GROUPS:
            warm(group)
