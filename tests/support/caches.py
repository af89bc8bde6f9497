"""A folder with all compiled kernels. Tests copy the folder and damage the copy."""

import shutil
from functools import cache
from pathlib import Path

from app.workers.stages import content
from solvers.kernel_cache import PACKAGE, folder_name, is_complete, roots
from tests.support.server import running_server


@cache
def complete_cache() -> Path:
    """The folder in which the warm-up has left every kernel."""
    with running_server(log_level="error"):
        assert is_complete(content())
    return next(root for root in roots() if root.is_dir() and any(root.glob("complete-*")))


def copy_of_cache(target: Path) -> Path:
    """The kernels of today's sources in a folder of one's own, marked as complete."""
    target.mkdir()
    for folder in {complete_cache() / folder_name(source) for source in PACKAGE.rglob("*.py")}:
        if folder.is_dir():
            shutil.copytree(folder, target / folder.name)
    for mark in complete_cache().glob("complete-*"):
        shutil.copy(mark, target)
    return target
