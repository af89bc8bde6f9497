r"""The numbered equations of the manual and the functions of `solvers` that implement them.

In a chapter, an equation is a block between `$$` that contains a `\tag`. If the equation is from a paper, the tag is
the paper's name and the number in the paper (`Xue 25`). If the equation is our own, the tag is a letter and a number
(`C4`). The paragraph below an equation names the functions that implement the equation. The docstrings of these
functions cite the number of the equation: `Eq. 25` in a package that implements Xue's paper, `Eq. C4` in any package.
"""

import ast
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from app.manual import chapters

_EQUATION = re.compile(
    r"^\$\$\n((?:(?!\$\$).)*?)\n?\\tag\{([^}]+)\}\n\$\$(?=\n\n(.*?)(?:\n\n|\Z))", re.MULTILINE | re.DOTALL
)
_FUNCTION = re.compile(r"\[`(solvers[\w.]+)`\]\(")


@dataclass(frozen=True, slots=True)
class Equation:
    """A numbered equation, its chapter, and the functions named below the equation."""

    number: str
    chapter: str
    text: str
    functions: tuple[str, ...]

    @property
    def address(self) -> str:
        """The address of the equation in the manual."""
        return f"/manual/{self.chapter}#{anchor(self.number)}"


@dataclass(frozen=True, slots=True)
class Function:
    """A function or class that implements equations.

    `head` is the name and the signature of a function, or the name of a class. `text` is the docstring.
    """

    name: str
    head: str
    text: str
    equations: tuple[Equation, ...]


def anchor(number: str) -> str:
    """Return the anchor of the equation with this number."""
    return f"eq-{number.lower().replace(' ', '-')}"


@cache
def equations() -> dict[str, Equation]:
    """Return all numbered equations. The keys are the numbers of the equations."""
    return {
        number: Equation(number, chapter.name, text, tuple(_FUNCTION.findall(below)))
        for chapter in chapters().values()
        for text, number, below in _EQUATION.findall(chapter.text)
    }


@cache
def functions() -> tuple[Function, ...]:
    """Return all functions that are named below an equation, sorted by name."""
    names = sorted({name for equation in equations().values() for name in equation.functions})
    return tuple(
        Function(name, *_definition(name), tuple(eq for eq in equations().values() if name in eq.functions))
        for name in names
    )


def module_of(name: str) -> str:
    """Return the module that defines the function, method or class with this dotted name."""
    parts = name.split(".")
    while not files(parts[0]).joinpath(*parts[1:-1], f"{parts[-1]}.py").is_file():
        parts.pop()
    return ".".join(parts)


def _definition(name: str) -> tuple[str, str]:
    """Return the head and the docstring of a function, method or class."""
    module = module_of(name)
    package, *rest = module.split(".")
    body: list[ast.stmt] = ast.parse(files(package).joinpath(*rest[:-1], f"{rest[-1]}.py").read_text("utf-8")).body
    for part in name.removeprefix(f"{module}.").split("."):
        node = next(item for item in body if isinstance(item, ast.ClassDef | ast.FunctionDef) and item.name == part)
        body = node.body
    if isinstance(node, ast.ClassDef):
        return f"class {node.name}", ast.get_docstring(node) or ""
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){returns}", ast.get_docstring(node) or ""
