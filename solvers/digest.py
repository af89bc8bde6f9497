"""The digest of the sources of the solvers.

The digest identifies results. The name of the folder with the compiled kernels also depends on the digest.
"""

import ast
import os
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
NO_CALCULATION = "published"
"""The package of published numbers for comparison; this package does not affect results."""
DECLARE = frozenset({"quantity", "Quantity", "described"})
LABELS = frozenset({"title", "symbol", "source", "text", "default_text", "assumed", "index"})
"""Keyword arguments of a declaration that are text and do not affect results; positional arguments are text too."""


def cache_base() -> Path:
    """Return the folder for cached digests and kernels, inside `NUMBA_CACHE_DIR` or the user's cache folder."""
    variables = ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA")
    chosen = next((os.environ[name] for name in variables if os.environ.get(name)), "~/.cache")
    return Path(os.path.expanduser(chosen), "tribodrive")  # noqa: PTH111  Path.expanduser raises if there is no home


def package_digest() -> str:
    """Return the digest of this package.

    The digest takes a second to compute. The digest is therefore kept on disk, in a file whose name depends on paths,
    times and sizes of the source files.
    """
    status = [(str(path), (state := path.stat()).st_mtime_ns, state.st_size) for path in sorted(PACKAGE.rglob("*.py"))]
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
    """Return the SHA-256 of the syntax trees of the modules in `package`, without docstrings, comments and labels.

    A change of layout, comments or docstrings does not change the digest. A change of a constant, of a formula or of
    the name of a module changes the digest. The trees, and therefore the digest, may differ between versions of Python.
    """
    digest = sha256()
    for path in sorted(package.rglob("*.py")):
        place = path.relative_to(package)
        if NO_CALCULATION not in place.parts:
            digest.update(f"{place.as_posix()}\n".encode())
            digest.update(ast.dump(_without_prose(path)).encode())
    return digest.hexdigest()


def _without_prose(path: Path) -> ast.Module:
    """Return the syntax tree of a module without its docstrings and without the labels of quantities."""
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
