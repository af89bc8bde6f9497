"""Imports go one way: `app` imports `solvers`, `solvers` never imports `app`, and no imports are circular."""

import ast
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from itertools import takewhile
from pathlib import Path

import pytest

pytestmark = pytest.mark.ci

ROOT = Path(__file__).parents[2]
ALLOWED = {"solvers", "numpy", "scipy", "numba"}
# what knows of files, or of the standard error
KEEPS_FILES = {
    f"solvers/{name}.py" for name in ("kernel_cache", "digest", "compiled", "named_oils", "drive_train/film/table")
}
MODULES = [path for package in ("app", "solvers") for path in (ROOT / package).rglob("*.py")]
STANDARD = {"collections", "contextlib", "dataclasses", "enum", "functools", "itertools", "math", "operator", "typing"}
DOCUMENTS_FIELDS = ("solvers/quantity.py", {"inspect", "re"})  # the module whose docstrings are composed


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text("utf-8"))


@cache
def imports(path: Path) -> list[ast.Import | ast.ImportFrom]:
    """Return all import statements of a module, also those inside functions."""
    return [node for node in ast.walk(tree(path)) if isinstance(node, ast.Import | ast.ImportFrom)]


def imported(path: Path) -> set[str]:
    names = {alias.name for node in imports(path) if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module or "" for node in imports(path) if isinstance(node, ast.ImportFrom)}
    return {name.split(".")[0] for name in names}


def test_solvers_import_only_numerics() -> None:
    documenting, more = DOCUMENTS_FIELDS
    for path in (ROOT / "solvers").rglob("*.py"):
        name = str(path.relative_to(ROOT))
        if name not in KEEPS_FILES:
            assert imported(path) <= ALLOWED | STANDARD | (more if name == documenting else set()), name


def test_every_solver_package_is_found() -> None:
    packages = {path.parent.name for path in (ROOT / "solvers").glob("*/__init__.py")}
    assert {"coupling", "gears", "contact"} <= packages


def test_one_module_knows_dask() -> None:
    knowing = [path for path in (ROOT / "app").rglob("*.py") if {"dask", "distributed"} & imported(path)]
    assert knowing == [ROOT / "app" / "workers" / "cluster.py"]


def name_of(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


NAMES = {name_of(path) for path in MODULES}
PACKAGES = {name_of(path) for path in MODULES if path.name == "__init__.py"}
SOLVERS = {name for name in PACKAGES if name.startswith("solvers")}


def modules_imported(path: Path) -> Iterator[str]:
    """Yield the project's modules that a module imports, also inside functions."""
    for node in imports(path):
        if isinstance(node, ast.ImportFrom) and node.module in NAMES:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in NAMES else node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in NAMES)


def siblings(name: str, other: str) -> tuple[str, str]:
    """Return both dotted names up to and including the first part in which they differ.

    For `solvers.gears.pair` and `solvers.scuffing.notices`, the result is `solvers.gears` and `solvers.scuffing`.
    """
    one, two = name.split("."), other.split(".")
    shared = len(list(takewhile(lambda pair: pair[0] == pair[1], zip(one, two, strict=False))))
    return ".".join(one[: shared + 1]), ".".join(two[: shared + 1])


def test_imports_have_no_circle_between_modules_or_packages_of_solvers() -> None:
    needed = {name_of(path): set(modules_imported(path)) for path in MODULES}
    assert set(TopologicalSorter(needed).static_order()) >= NAMES
    between: dict[str, set[str]] = {}
    for name, others in needed.items():
        for one, two in (siblings(name, other) for other in others):
            if one != two and {one, two} <= PACKAGES and {one, two} & SOLVERS:
                between.setdefault(one, set()).add(two)
    order = list(TopologicalSorter(between).static_order())
    assert order.index("solvers.gears") < order.index("solvers.scuffing")
    assert order.index("solvers") < order.index("app")


ROOMS = (
    "settings",
    "log",
    "errors",
    "sources",
    "spreadsheet",
    "schema",
    "figures",
    "models",
    "examples",
    "calculations",
    "evaluate",
    "workers",
    "studies",
    "manual",
    "pages",
    "rexs",
    "http",
    "client",
    "main",
    "command",
    "__main__",
)
"""The entries of `app`. An entry imports only itself and entries above it: studies know nothing of pages."""


def room(name: str) -> str | None:
    """Return the entry of `app` to which a module belongs, or None if the module is not in `app`."""
    return name.split(".")[1] if name.startswith("app.") else None


def test_app_has_these_rooms() -> None:
    found = {path.stem for path in (ROOT / "app").iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert found - {"__init__"} == set(ROOMS)


def test_no_room_imports_a_higher_one() -> None:
    arrows = {(room(name_of(path)), room(other)) for path in MODULES for other in modules_imported(path)}
    upward = [(one, two) for one, two in arrows if one and two and ROOMS.index(one) < ROOMS.index(two)]
    assert upward == []


def test_what_is_known_about_a_model_is_on_its_card() -> None:
    """Outside `app/models`, no dictionary has the path of an endpoint or of one of its fields as a key."""
    from app.calculations import CALCULATIONS  # noqa: PLC0415  the rest of this module reads sources only
    from app.schema.fields import leaves  # noqa: PLC0415

    models = (model for calculation in CALCULATIONS for model in (calculation.request, calculation.response))
    paths = {leaf.path for model in models for leaf in leaves(model) if "." in leaf.path}
    paths |= {calculation.path for calculation in CALCULATIONS}
    found = []
    for path in (ROOT / "app").rglob("*.py"):
        if "models" not in path.relative_to(ROOT).parts:
            names = constants(path)
            keys = (key for node in ast.walk(tree(path)) if isinstance(node, ast.Dict) for key in node.keys)
            values = ((key, names.get(key.id) if isinstance(key, ast.Name) else value_of(key)) for key in keys if key)
            found += [f"{name_of(path)}:{key.lineno} {value}" for key, value in values if value in paths]
    assert found == []


def value_of(node: ast.expr) -> object:
    return node.value if isinstance(node, ast.Constant) else None


@cache
def constants(path: Path) -> dict[str, object]:
    """Return the texts that a module assigns, or imports from the module that assigns them, by their names."""
    texts: dict[str, object] = {}
    for node in tree(path).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            texts[node.targets[0].id] = value_of(node.value)
        elif isinstance(node, ast.ImportFrom) and node.module in NAMES - PACKAGES:
            there = constants(ROOT / f"{node.module.replace('.', '/')}.py")
            texts |= {alias.asname or alias.name: there.get(alias.name) for alias in node.names}
    return texts
