r"""The numbered equations of the manual and the functions of `solvers` that implement them.

An equation is a block of dollars with a `\tag`. Numbers of a paper are tagged with its name (`Xue 25`), ours begin
with a letter (`C4`). The paragraph after it says by which functions it is implemented; their docstrings cite its
number: `Eq. 25` in a package that implements Xue's paper, `Eq. C4` anywhere.
"""

import ast
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from app.manual import chapters

_EQUATION = re.compile(r"^\$\$\n(.*?)\n?\\tag\{([^}]+)\}\n\$\$(?=\n\n(.*?)(?:\n\n|\Z))", re.MULTILINE | re.DOTALL)
_FUNCTION = re.compile(r"\[`(solvers[\w.]+)`\]\(")


@dataclass(frozen=True, slots=True)
class Equation:
    """A numbered equation, the chapter it stands in and the functions below it."""

    number: str
    chapter: str
    text: str
    functions: tuple[str, ...]

    @property
    def address(self) -> str:
        """Where it is."""
        return f"/manual/{self.chapter}#{anchor(self.number)}"


@dataclass(frozen=True, slots=True)
class Function:
    """A function or class that implements equations: its head and docstring as they stand in the source."""

    name: str
    head: str
    text: str
    equations: tuple[Equation, ...]


def anchor(number: str) -> str:
    """The anchor of an equation."""
    return f"eq-{number.lower().replace(' ', '-')}"


@cache
def equations() -> dict[str, Equation]:
    """Every numbered equation by its number."""
    return {
        number: Equation(number, chapter.name, text, tuple(_FUNCTION.findall(below)))
        for chapter in chapters().values()
        for text, number, below in _EQUATION.findall(chapter.text)
    }


@cache
def functions() -> tuple[Function, ...]:
    """Every function that is named below an equation, by name."""
    names = sorted({name for equation in equations().values() for name in equation.functions})
    return tuple(
        Function(name, *_definition(name), tuple(each for each in equations().values() if name in each.functions))
        for name in names
    )


def module_of(name: str) -> str:
    """The module that holds a function, method or class, by its dotted name."""
    parts = name.split(".")
    while not files(parts[0]).joinpath(*parts[1:-1], f"{parts[-1]}.py").is_file():
        parts.pop()
    return ".".join(parts)


def _definition(name: str) -> tuple[str, str]:
    """Head and docstring of a function, method or class."""
    module = module_of(name)
    package, *rest = module.split(".")
    body: list[ast.stmt] = ast.parse(files(package).joinpath(*rest[:-1], f"{rest[-1]}.py").read_text("utf-8")).body
    for part in name.removeprefix(f"{module}.").split("."):
        node = next(each for each in body if isinstance(each, ast.ClassDef | ast.FunctionDef) and each.name == part)
        body = node.body
    if isinstance(node, ast.ClassDef):
        return f"class {node.name}", ast.get_docstring(node) or ""
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){returns}", ast.get_docstring(node) or ""
