"""Tests copy a folder with all compiled kernels, and damage the copy."""

import shutil
from functools import cache
from pathlib import Path

from solvers.kernel_cache import FOLDER
from tests.support.server import running_server


@cache
def complete_cache() -> Path:
    """Start the service, wait until all kernels are compiled, and return the folder of the kernels."""
    with running_server(log_level="error"):
        assert FOLDER is not None
    return FOLDER


def copy_of_cache(base: Path) -> Path:
    """Copy the kernels of the current source code into a cache below `base`, and return the folder of the copy."""
    folder = base / "tribodrive" / complete_cache().name
    shutil.copytree(complete_cache(), folder)
    return folder
