"""Tests run in this process or, with `-n`, in several that share compiled kernels and solved requests.

The fixtures are in tests/support/fixtures.py: a process that only hands out tests does not import the service.
"""

import gc
import os
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.support.solved import FOLDER


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("numprocesses", None):
        folder = TemporaryDirectory(prefix="tribodrive-solved-")
        config.add_cleanup(folder.cleanup)
        os.environ[FOLDER] = folder.name
    else:
        config.pluginmanager.import_plugin("tests.support.fixtures")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    # their modules import a browser and a cluster
    return True if collection_path.name == "service" and "not service" in config.getoption("markexpr") else None


def pytest_collection() -> None:
    gc.disable()  # what is collected remains until the end


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()
