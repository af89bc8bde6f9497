"""Data flows one way: app calls solvers, solvers know nothing of HTTP."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ALLOWED = {"solvers", "numpy", "scipy", "numba"}
KEEPS_FILES = {"solvers/kernel_cache.py"}  # the one module that knows of files and processes
STANDARD = {"collections", "contextlib", "dataclasses", "enum", "functools", "itertools", "math", "operator", "typing"}


def imported(path: Path) -> set[str]:
    tree = ast.parse(path.read_text("utf-8"))
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    return {name.split(".")[0] for name in names}


@pytest.mark.parametrize("path", sorted((ROOT / "solvers").rglob("*.py")), ids=lambda path: str(path.relative_to(ROOT)))
def test_solvers_import_only_numerics(path: Path) -> None:
    if str(path.relative_to(ROOT)) not in KEEPS_FILES:
        assert imported(path) <= ALLOWED | STANDARD


def test_every_solver_package_is_found() -> None:
    packages = {path.parent.name for path in (ROOT / "solvers").glob("*/__init__.py")}
    assert {"coupling", "gears", "contact"} <= packages


def test_one_module_knows_dask() -> None:
    knowing = [path for path in (ROOT / "app").rglob("*.py") if {"dask", "distributed"} & imported(path)]
    assert knowing == [ROOT / "app" / "studies" / "cluster.py"]
