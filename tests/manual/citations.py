"""Functions that find the equations cited in the docstrings of `solvers`."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from app.manual.equations import module_of

SOLVERS = Path(__file__).parents[2] / "solvers"
PAPERS = {"MILIAN": "Milian", "XUE": "Xue"}
_CITED = re.compile(r"\bEqs?\. ((?:[A-Z]?\d+(?:\.\d)?)(?:(?:, | and |-)[A-Z]?\d+(?:\.\d)?)*)")


def numbers(text: str, paper: str) -> set[str]:
    """Return the equations that a text cites. If a number has no letter, put the name of the paper before it."""
    return {number if number[0].isalpha() else f"{paper} {number}" for number in _plain(text)}


def _plain(text: str) -> Iterator[str]:
    for cited in _CITED.findall(text):
        for part in re.split(r", | and ", cited):
            first, _, last = part.partition("-")
            yield from [first] if not last else (str(each) for each in range(int(first), int(last) + 1))


def implementing(name: str) -> Any:
    """Return the function, method or class with this dotted name."""
    module = module_of(name)
    value: Any = import_module(module)
    for part in name.removeprefix(f"{module}.").split("."):
        value = getattr(value, part)
    return value


def paper_of(path: Path) -> str:
    """Return the paper to which a module refers if it cites an equation number without a letter."""
    return "Milian" if "pumping" in path.relative_to(SOLVERS).parts[0] else "Xue"


def docstrings() -> Iterator[tuple[Path, str, str]]:
    """Yield the path, dotted name and docstring of every module, class and function of the solvers."""
    for path in sorted(SOLVERS.rglob("*.py")):
        module = ".".join(path.relative_to(SOLVERS.parent).with_suffix("").parts).removesuffix(".__init__")
        yield from ((path, name, text) for name, text in _inside(ast.parse(path.read_text("utf-8")), module))


def _inside(node: ast.Module | ast.ClassDef | ast.FunctionDef, name: str) -> Iterator[tuple[str, str]]:
    if text := ast.get_docstring(node):
        yield name, text
    for each in node.body:
        if isinstance(each, ast.ClassDef | ast.FunctionDef):
            yield from _inside(each, f"{name}.{each.name}")


@cache
def cited() -> dict[str, set[str]]:
    """Return the equations that each module, class and function cites. The keys are the dotted names."""
    return {name: found for path, name, text in docstrings() if (found := numbers(text, paper_of(path)))}


def declared() -> set[str]:
    """Return the equations that the declarations of quantities name as their sources."""
    texts = "\n".join(path.read_text("utf-8") for path in SOLVERS.rglob("*.py"))
    sources = re.findall(r'f"\{(MILIAN|XUE)\}, ([^"]*)"', texts)
    return {number for paper, text in sources for number in numbers(text, PAPERS[paper])}
