"""The identity of the solvers' sources, and what the changelog says about their results."""

import ast
import re
from hashlib import sha256
from importlib.resources import files
from pathlib import Path

import solvers

NO_CALCULATION = "published"
"""Package of published numbers: used for comparison only, it does not affect results."""
DECLARE = frozenset({"quantity", "Quantity"})
LABELS = frozenset({"title", "symbol", "source", "text", "default_text", "assumed", "index"})
"""Arguments of a declaration that are text and do not affect results, beside the positional ones."""


def sources_of(package: Path) -> str:
    """SHA-256 in hex of the syntax trees of the modules in `package`, without docstrings, comments and labels.

    Layout and prose leave it as it is; a constant, a formula or the name of a module changes it. The trees, and with
    them the hash, may differ between versions of Python.
    """
    found = sha256()
    for path in sorted(package.rglob("*.py")):
        place = path.relative_to(package)
        if NO_CALCULATION not in place.parts:
            found.update(f"{place.as_posix()}\n".encode())
            found.update(ast.dump(_without_prose(path)).encode())
    return found.hexdigest()


def _without_prose(path: Path) -> ast.Module:
    """The tree of a module without text that stands alone and without the labels of quantities."""
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


def changes_since(sources: str) -> list[str]:
    """The newest entries of the changelog for results of other sources; empty for results of the present ones.

    `sources` is the hash or its beginning, and empty where it is not known.
    """
    return [] if SOURCES.startswith(sources) else recent_changes()


def recent_changes() -> list[str]:
    """The entries of the newest section of the changelog, newest first, without the hashes of accepted numbers."""
    section = files("app").joinpath("CHANGELOG.md").read_text("utf-8").split("\n## ")[1]
    entries = re.split(r"^\* ", section, flags=re.MULTILINE)[1:]
    return [" ".join(re.sub(r"`[0-9a-f]{64}`", "", entry).replace("`", "").split()) for entry in reversed(entries)]


SOURCES = sources_of(Path(solvers.__file__).parent)
SHORT_SOURCES = SOURCES[:16]
"""The part of the hash that links carry."""
