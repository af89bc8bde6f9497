"""The house reads from its listing: small modules, packages that tell the order of data, arrows that never point up."""

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from itertools import takewhile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULES = sorted(path for package in ("app", "solvers") for path in (ROOT / package).rglob("*.py"))
LONGEST = 250
MOST_MODULES = 15
SOLVERS = sorted(path.parent for path in (ROOT / "solvers").rglob("__init__.py"))


def name_of(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


NAMES = {name_of(path) for path in MODULES}


def imported(path: Path) -> Iterator[str]:
    """The modules of the house that a module imports, wherever in it."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module in NAMES:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in NAMES else node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in NAMES)


ARROWS = {name_of(path): set(imported(path)) for path in MODULES}
FOLDERS = {name_of(path) for path in MODULES if path.name == "__init__.py"}


def between(name: str, other: str) -> tuple[str, str]:
    """The two folders, side by side, across which an arrow goes; equal ones where it goes across none."""
    one, two = name.split("."), other.split(".")
    shared = len(list(takewhile(lambda pair: pair[0] == pair[1], zip(one, two, strict=False))))
    return ".".join(one[: shared + 1]), ".".join(two[: shared + 1])


def order(arrows: dict[str, set[str]]) -> list[str]:
    try:
        return list(TopologicalSorter(arrows).static_order())
    except CycleError as circle:
        pytest.fail(f"a circle: {' <- '.join(circle.args[1])}")


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_module_is_about_one_thing(path: Path) -> None:
    text = path.read_text("utf-8")
    assert text.count("\n") <= LONGEST
    assert ast.get_docstring(ast.parse(text))


@pytest.mark.parametrize("folder", SOLVERS, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_package_of_solvers_fits_a_glance(folder: Path) -> None:
    assert len(list(folder.glob("*.py"))) - 1 <= MOST_MODULES


def test_no_module_needs_itself() -> None:
    assert set(order(ARROWS)) >= NAMES


def test_data_flow_one_way_between_packages() -> None:
    arrows: dict[str, set[str]] = {}
    for name, others in ARROWS.items():
        for one, two in (between(name, other) for other in others):
            if one != two and {one, two} <= FOLDERS:
                arrows.setdefault(one, set()).add(two)
    found = order(arrows)
    assert found.index("solvers.scuffing.flank") < found.index("solvers.scuffing.thermal")
    assert found.index("solvers") < found.index("app")
