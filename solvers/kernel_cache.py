"""Where numba keeps the machine code of compiled kernels: never stale, in whatever folder there is.

Numba's own locators notice a change of the file that a kernel stands in, not of the files whose kernels it calls. Here
the code of a module lies in a folder named by a hash of that module, of every module of this package that it imports,
directly or not, of the versions of Python and numba and of the processor: a change of any of them gives another folder.

A folder that cannot be written is read all the same (an installation compiled once and mounted read-only), and where
there is no folder kernels live in memory. Where nothing can be written and a kernel is called with types that the
folder does not hold, numba raises OSError.

A damaged file would crash the process or, worse, calculate something else. Folders of a complete cache therefore hold a
digest of their files, and one that does not fit is removed and compiled again. Files of other folders are looked
through for whether they end too early.
"""

import hashlib
import logging
import os
import platform
import re
import shutil
import sys
import tempfile
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from pickletools import genops
from typing import Any

import numba
from llvmlite.binding import get_host_cpu_features, get_host_cpu_name

PACKAGE = Path(__file__).resolve().parent
IMPORT = re.compile(rf"^\s*(?:from|import)\s+({PACKAGE.name}[\w.]*)(?:\s+import\s+(\([^)]*\)|[^\n#]*))?", re.MULTILINE)

KEPT_UNUSED_S = 30 * 86400  # a month: folders of earlier versions serve again when one goes back and forth
NEEDED_BYTES = 100_000_000  # all kernels take 25 MB; some room for two versions

DIGEST = "sha256"  # the file with the digest of the others
PICKLES = {".nbi": 2, ".nbc": 1}  # how many pickles numba writes into an index and into a file of code

logger = logging.getLogger(__name__)


class KernelLocator:
    """Where the machine code of one kernel lies, in the form that NUMBA_CACHE_LOCATOR_CLASSES asks for."""

    def __init__(self, function: Callable[..., Any], folder: Path) -> None:
        self._line = function.__code__.co_firstlineno
        self._folder = folder

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> "KernelLocator | None":
        """The locator of a kernel that is defined in `file`."""
        folder = cache_folder(file)
        return None if folder is None else cls(function, folder)

    def ensure_cache_path(self) -> None:
        """Make the folder: numba asks for it before it writes, and the digest will not fit any longer."""
        self._folder.mkdir(parents=True, exist_ok=True)
        (self._folder / DIGEST).unlink(missing_ok=True)

    def get_cache_path(self) -> str:
        """Where numba reads and writes."""
        return str(self._folder)

    def get_source_stamp(self) -> str:
        """What the code was compiled from: the folder's name is a hash of it."""
        return self._folder.name

    def get_disambiguator(self) -> str:
        """What tells two kernels of the same name in one module apart."""
        return str(self._line)


@contextmanager
def located() -> Iterator[None]:
    """Use `KernelLocator` to choose the cache folder of all kernels that are decorated in this context."""
    config: Any = numba.config  # fills its attributes from the environment
    before = config.CACHE_LOCATOR_CLASSES
    config.CACHE_LOCATOR_CLASSES = f"{KernelLocator.__module__}.{KernelLocator.__qualname__}"
    try:
        yield
    finally:
        config.CACHE_LOCATOR_CLASSES = before


@cache
def cache_folder(file: str) -> Path | None:
    """The folder for the machine code of the module in `file`, or None if there is no place for it.

    It lies in the first root that can be written. Where none can, a folder that is there already is read. Numba reads
    and writes in one folder: what an earlier root holds that can only be read is linked into the one that is written.
    """
    name = folder_name(Path(file).resolve())
    existing = next((root / name for root in roots() if _is_sound(root / name)), None)
    root = writable_root()
    if root is None:
        return existing
    folder = root / name
    if existing is not None and existing != folder:
        with suppress(OSError):  # another process may link at the same time
            shutil.copytree(existing, folder, copy_function=os.symlink, dirs_exist_ok=True)
    return folder


def _is_sound(folder: Path) -> bool:
    """Whether the folder is there and holds what was written, after what is damaged was removed."""
    if not folder.is_dir():
        return False
    if (folder / DIGEST).is_file():
        if (folder / DIGEST).read_text() == _digest(folder):
            return True
        logger.warning("discarded a broken kernel cache: %s", folder)
        shutil.rmtree(folder, ignore_errors=True)
        return False
    broken = [
        file
        for suffix, pickles in PICKLES.items()
        for file in folder.glob(f"*{suffix}")
        if not _is_whole(file, pickles)
    ]
    for file in broken:
        logger.warning("discarded a broken kernel cache: %s", file)
        with suppress(OSError):
            file.unlink(missing_ok=True)
    return not any(file.exists() for file in broken)


def _digest(folder: Path) -> str:
    """A hash of the names and contents of the files that numba has written."""
    digest = hashlib.sha256()
    for file in sorted(file for suffix in PICKLES for file in folder.glob(f"*{suffix}")):
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()


def _is_whole(file: Path, pickles: int) -> bool:
    """Whether the file holds so many pickles, each to its end; nothing of them is executed."""
    try:
        with file.open("rb") as stream:
            for _ in range(pickles):
                deque(genops(stream), maxlen=0)
    except (OSError, ValueError):
        return False
    return True


@cache
def roots() -> list[Path]:
    """Where kernels may lie, best first: where NUMBA_CACHE_DIR says, or else beside the sources or with the user."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        return [Path(chosen)]
    home = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))  # noqa: PTH111  raises nothing
    places = [PACKAGE / "__pycache__" / "kernels"]
    if home.is_absolute():
        places.append(home / "tribodrive" / "kernels")
    with suppress(FileNotFoundError):  # no temporary folder can be written
        private = Path(tempfile.gettempdir()) / f"tribodrive-{os.getuid()}"
        if _is_ours(private, 0o700):  # anybody can make a folder of that name
            places.append(private)
    return places


@cache
def writable_root() -> Path | None:
    """The first of the roots that can be written."""
    return next((root for root in roots() if _is_ours(root)), None)


def _is_ours(folder: Path, mode: int = 0o755) -> bool:
    """Whether the folder is there, made if need be, belongs to this user and takes files."""
    try:
        folder.mkdir(mode, parents=True, exist_ok=True)
        return (
            folder.lstat().st_uid == os.getuid()
            and os.access(folder, os.W_OK | os.X_OK)
            and shutil.disk_usage(folder).free > NEEDED_BYTES
        )
    except OSError:
        return False


@cache
def folder_name(path: Path) -> str:
    """The module's name and a hash of everything its machine code depends on."""
    digest = hashlib.sha256(f"{sys.version} {_processor()} {numba.__version__}".encode())
    for source in sorted(sources(path) - {Path(__file__).resolve()}):  # the place of the code does not change it
        digest.update(os.path.relpath(source, PACKAGE).encode())  # machine code names its module
        digest.update(_text(source).encode())
    return f"{path.stem}-{digest.hexdigest()[:24]}"


@cache
def _processor() -> str:
    """What numba compiles for: this machine's processor, unless NUMBA_CPU_NAME and NUMBA_CPU_FEATURES say another."""
    config: Any = numba.config
    features = get_host_cpu_features().flatten() if config.CPU_FEATURES is None else config.CPU_FEATURES
    return f"{platform.machine()} {config.CPU_NAME or get_host_cpu_name()} {features}"


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


def discard(module: str) -> None:
    """Remove the kept kernels of this module and of every module that it imports: some file among them is damaged."""
    path = PACKAGE.parent.joinpath(*module.split("."))
    for source in sources(path / "__init__.py" if path.is_dir() else path.with_suffix(".py")):
        for root in roots():
            shutil.rmtree(root / folder_name(source), ignore_errors=True)


def is_complete(content: str) -> bool:
    """Whether everything that `content` names was compiled for these sources on this kind of processor."""
    return any((root / _mark(content)).is_file() for root in roots())


def mark_complete(content: str, *, complete: bool = True) -> None:
    """Note whether everything that `content` names is compiled and kept, and of what is the digests."""
    root = writable_root()
    if root is None:
        return
    with suppress(OSError):
        if not complete:
            (root / _mark(content)).unlink(missing_ok=True)
            return
        for folder in {root / folder_name(source) for source in PACKAGE.rglob("*.py")}:
            if folder.is_dir() and not (folder / DIGEST).exists():
                (folder / DIGEST).write_text(_digest(folder))
        (root / _mark(content)).touch()
        _prune(root)


def _prune(root: Path) -> None:
    """Remove what no source of today needs and has not been touched for a month."""
    needed = {folder_name(source) for source in PACKAGE.rglob("*.py")}
    for folder in root.iterdir():
        if folder.name not in needed and time.time() - folder.stat().st_mtime > KEPT_UNUSED_S:
            shutil.rmtree(folder) if folder.is_dir() else folder.unlink()


def _mark(content: str) -> str:
    digest = hashlib.sha256(content.encode())
    for source in sorted(PACKAGE.rglob("*.py")):
        digest.update(folder_name(source).encode())
    return f"complete-{digest.hexdigest()[:24]}"
