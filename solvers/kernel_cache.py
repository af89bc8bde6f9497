"""Machine code of compiled kernels on disk: never stale, never in the way.

Numba's own cache notices a change of the file that a kernel stands in, not of the files whose kernels it calls. Here
the code of a module lies in a folder named by a hash of that module, of every module of this package that it imports,
directly or not, and of the versions of Python and numba: an edit or an upgrade anywhere below gives another folder.

A folder that cannot be written is read all the same (an installation compiled once and mounted read-only), a broken
file is compiled again, and where nothing can be written kernels live in memory.
"""

import fcntl
import hashlib
import logging
import os
import platform
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numba
from llvmlite.binding import get_host_cpu_name
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile

PACKAGE = Path(__file__).resolve().parent
IMPORT = re.compile(rf"^\s*(?:from|import)\s+({PACKAGE.name}[\w.]*)(?:\s+import\s+(\([^)]*\)|[^\n#]*))?", re.MULTILINE)

KEPT_UNUSED_S = 30 * 86400

logger = logging.getLogger(__name__)


class KernelCache(FunctionCache):
    """The cached machine code of one kernel, in the form that numba's dispatcher uses."""

    def __init__(self, function: Callable[..., Any], variant: str) -> None:
        folder = folder_name(Path(function.__code__.co_filename).resolve())
        base = f"{function.__qualname__}-{function.__code__.co_firstlineno}{variant}"
        self._files = [IndexDataCacheFile(str(root / folder), base, folder) for root in roots()]
        self._name = function.__qualname__
        self._py_func = function
        self._impl = _Implementation(function)
        self._enabled = True

    @property
    def cache_path(self) -> str:
        """Where new code is written, or would be."""
        writable = writable_root()
        return str(writable or "")

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled kernel, or None where no folder has a sound one."""
        target_context.refresh()
        key = FunctionCache._index_key(self, sig, target_context.codegen())
        for file in self._files:
            try:
                data = file.load(key)
                if data is not None:
                    return self._impl.rebuild(target_context, data)
            except Exception as error:  # noqa: BLE001  whatever a broken file makes of the reader
                logger.warning("discarded a broken kernel cache: %s (%s)", file._index_path, error)
                _discard(Path(file._index_path))
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the compiled kernel where possible; one process at a time writes to a folder."""
        root = writable_root()
        if root is None or not self._impl.check_cachable(data):
            return
        file = self._files[roots().index(root)]
        try:
            with _locked(Path(file._cache_path)):
                file.save(FunctionCache._index_key(self, sig, data.codegen), self._impl.reduce(data))
        except OSError as error:
            logger.warning("kernels are kept in memory only: %s", error)
            writable_root.cache_clear()
            _unwritable.add(root)


class _Implementation(CompileResultCacheImpl):
    """Numba's way to store a compiled function, without its search for a place."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._lineno = function.__code__.co_firstlineno
        self._locator = _Source(function.__code__.co_filename)


@dataclass
class _Source:
    """What numba's warnings want to know of a locator."""

    _py_file: str


_unwritable: set[Path] = set()


@cache
def roots() -> list[Path]:
    """Where kernels may lie, best first: where NUMBA_CACHE_DIR says, or else beside the sources or with the user."""
    if told := os.environ.get("NUMBA_CACHE_DIR"):
        return [Path(told)]
    home = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))  # noqa: PTH111  raises nothing
    private = Path(tempfile.gettempdir()) / f"tribodrive-{os.getuid()}"
    places = [PACKAGE / "__pycache__" / "kernels"]
    if home.is_absolute():
        places.append(home / "tribodrive" / "kernels")
    return [*places, private] if _is_ours(private, 0o700) else places  # anybody can make a folder of that name


@cache
def writable_root() -> Path | None:
    """The first of the roots that can be written."""
    return next((root for root in roots() if root not in _unwritable and _is_ours(root)), None)


def _is_ours(folder: Path, mode: int = 0o755) -> bool:
    """Whether the folder is there, made if need be, belongs to this user and takes files."""
    try:
        folder.mkdir(mode, parents=True, exist_ok=True)
        return folder.lstat().st_uid == os.getuid() and os.access(folder, os.W_OK | os.X_OK)
    except OSError:
        return False


@cache
def folder_name(path: Path) -> str:
    """The module's name and a hash of everything its machine code depends on."""
    digest = hashlib.sha256(f"{sys.version} {platform.machine()} {numba.__version__}".encode())
    for source in sorted(sources(path) - {Path(__file__).resolve()}):  # the place of the code does not change it
        digest.update(os.path.relpath(source, PACKAGE).encode())  # kept code names its module
        digest.update(_text(source).encode())
    return f"{path.stem}-{digest.hexdigest()[:24]}"


@cache
def sources(path: Path) -> frozenset[Path]:
    """The module's file and those of the package's modules that it imports, directly or not."""
    found: set[Path] = set()
    waiting = [path]
    while waiting:
        source = waiting.pop()
        if source not in found:
            found.add(source)
            waiting.extend(_imported(source))
    return frozenset(found)


@cache
def _imported(path: Path) -> tuple[Path, ...]:
    return tuple(_modules(_text(path)))


def _modules(text: str) -> Iterator[Path]:
    for module, names in IMPORT.findall(text):
        base = PACKAGE.parent.joinpath(*module.split("."))
        for candidate in (base, *(base / name for name in re.findall(r"\w+", names))):
            for file in (candidate.with_suffix(".py"), candidate / "__init__.py"):
                if file.is_file():
                    yield file


@cache
def _text(path: Path) -> str:
    return path.read_text("utf-8")


def is_complete(content: str) -> bool:
    """Whether everything that `content` names was compiled for these sources on this kind of processor."""
    return any((root / _mark(content)).is_file() for root in roots())


def mark_complete(content: str) -> None:
    """Note that everything that `content` names is compiled and kept."""
    root = writable_root()
    if root is not None and not _unwritable:
        with suppress(OSError):
            (root / _mark(content)).touch()
            _prune(root)


def _prune(root: Path) -> None:
    """Remove what no source of today needs and nobody has touched for a month."""
    needed = {folder_name(source) for source in PACKAGE.rglob("*.py")}
    for folder in root.iterdir():
        if folder.name not in needed and time.time() - folder.stat().st_mtime > KEPT_UNUSED_S:
            shutil.rmtree(folder) if folder.is_dir() else folder.unlink()


def _mark(content: str) -> str:
    digest = hashlib.sha256(f"{content} {get_host_cpu_name()}".encode())
    for source in sorted(PACKAGE.rglob("*.py")):
        digest.update(folder_name(source).encode())
    return f"complete-{digest.hexdigest()[:24]}"


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _discard(index: Path) -> None:
    """Remove the index, so that the kernel is compiled again; where that is not allowed, it is ignored each time."""
    try:
        index.unlink(missing_ok=True)
    except OSError:
        return
