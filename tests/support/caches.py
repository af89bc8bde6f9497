"""A folder with all compiled kernels. Tests copy the folder and damage the copy."""

import shutil
from functools import cache
from pathlib import Path

from solvers.kernel_cache import FOLDER
from tests.support.server import running_server


@cache
def complete_cache() -> Path:
    """The folder in which a start has left every kernel."""
    with running_server(log_level="error"):
        assert FOLDER is not None
    return FOLDER


def copy_of_cache(base: Path) -> Path:
    """The kernels of today's sources in a base of one's own."""
    folder = base / "tribodrive" / complete_cache().name
    shutil.copytree(complete_cache(), folder)
    return folder
