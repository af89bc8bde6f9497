"""The digest (a hash) of the source code of the solvers.

The service states the digest with every result, so that a user can see whether two results come from the same source
code. The name of the folder for compiled kernels also depends on the digest.
"""

import ast
import os
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
DECLARE = frozenset({"quantity", "Quantity", "described", "computed", "record"})
LABELS = frozenset({"title", "symbol", "source", "text", "default_text", "assumed", "index", "equation"})
"""Names of the keyword arguments of a declaration that are only text and do not affect results.

All positional arguments of a declaration are also only text. The digest leaves out all these arguments.
"""


def cache_base() -> Path:
    """Return the folder for cached digests and kernels, inside `NUMBA_CACHE_DIR` or the user's cache folder."""
    variables = ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA")
    chosen = next((os.environ[name] for name in variables if os.environ.get(name)), "~/.cache")
    return Path(os.path.expanduser(chosen), "tribodrive")  # noqa: PTH111  Path.expanduser raises if there is no home


def package_digest() -> str:
    """Digest of the package `solvers`.

    It takes a second, and is kept in a file named by paths, times of modification and sizes of all sources.
    """
    status = [(str(path), (state := path.stat()).st_mtime_ns, state.st_size) for path in _sources(PACKAGE)]
    kept = cache_base() / "digests" / sha256(repr(status).encode()).hexdigest()
    with suppress(OSError):
        if len(digest := kept.read_text("ascii")) == sha256().digest_size * 2:
            return digest
    digest = digest_of(PACKAGE)
    with suppress(OSError):
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(digest, "ascii")
    return digest


def digest_of(package: Path) -> str:
    """SHA-256 of the names, syntax trees and tables of `package`.

    Comments, layout, docstrings and labels of quantities do not count; constants and formulas do. Versions of Python
    may differ in their trees.
    """
    digest = sha256()
    for path in _sources(package):
        digest.update(f"{path.relative_to(package).as_posix()}\n".encode())
        digest.update(path.read_bytes() if path.suffix != ".py" else ast.dump(_without_prose(path)).encode())
    return digest.hexdigest()


def _sources(package: Path) -> list[Path]:
    """Return the modules, and the tables that they read."""
    return sorted(path for kind in ("py", "csv", "json") for path in package.rglob(f"*.{kind}"))


def _without_prose(path: Path) -> ast.Module:
    """Return the syntax tree of a module, without docstrings and without the labels in declarations of quantities."""
    tree = ast.parse(path.read_bytes())
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            node.body = [statement for statement in node.body if not _is_text(statement)]
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in DECLARE:
            node.args = []
            node.keywords = [keyword for keyword in node.keywords if keyword.arg not in LABELS]
    return tree


def _is_text(statement: ast.stmt) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )
