"""The folder in which numba keeps the machine code of compiled kernels.

If a kernel calls a kernel in another file and this other file is edited, numba does not notice the edit and runs
outdated machine code. The name of the folder is therefore a hash of all sources of the solvers and of numba's
version: after every edit, numba uses a new folder. This module must be imported before the first kernel is decorated.
"""

import logging
import os
import shutil
import stat
import tempfile
from hashlib import sha256
from pathlib import Path
from typing import Any

import numba

from solvers.digest import cache_base, package_digest

NEEDED_BYTES = 30_000_000  # all kernels take 6 MB
KEPT_FOLDERS = 5  # chosen: a developer switches between at most this number of versions

logger = logging.getLogger(__name__)


def _writable(folder: Path) -> Path | None:
    """Create the folder and delete all but the `KEPT_FOLDERS` used last; None, and a warning, if it is not writable."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        tempfile.TemporaryFile(dir=folder).close()
        free = shutil.disk_usage(folder).free
        folders = sorted(folder.parent.iterdir(), key=lambda path: path.stat().st_mtime)
    except OSError as error:
        logger.warning("compiled kernels are not kept: %s", error)
        return None
    if free < NEEDED_BYTES:
        logger.warning("compiled kernels are not kept: too little space in %s", folder)
        return None
    for old in folders[:-KEPT_FOLDERS]:
        shutil.rmtree(old, ignore_errors=True)
    return folder


def _own_folder(name: str, existing: Path) -> Path | None:
    """Folder of this user for temporary files, with the kernels of a read-only folder.

    Kernels are pickled objects, so a folder of another user is never used.
    """
    try:
        base = Path(tempfile.gettempdir()) / f"tribodrive-{os.getuid()}"
    except FileNotFoundError:  # no folder for temporary files can be written either
        return None
    try:
        base.mkdir(mode=0o700, exist_ok=True)
        status = base.lstat()
        if not stat.S_ISDIR(status.st_mode) or status.st_mode & 0o077 or status.st_uid != os.getuid():
            return None
        if existing.is_dir() and not (base / name).exists():
            private = Path(tempfile.mkdtemp(dir=base))
            shutil.copytree(existing, private, dirs_exist_ok=True)
            private.rename(base / name)
    except OSError as error:
        logger.warning("compiled kernels are not copied: %s", error)
    return _writable(base / name)


def _folder() -> Path | None:
    """Return the folder for compiled kernels, or None if they can be kept in memory only."""
    name = sha256(f"{package_digest()} {numba.__version__}".encode()).hexdigest()[:24]
    existing = cache_base() / name
    return _writable(existing) or (_own_folder(name, existing) if os.name == "posix" else None)


FOLDER = _folder()
"""The folder in use; None if compiled kernels are kept in memory only."""

if FOLDER is not None:
    config: Any = numba.config  # numba fills the attributes from the environment
    config.CACHE_DIR = str(FOLDER)
