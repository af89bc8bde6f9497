"""Docstrings of public objects have numpydoc's form: its validator finds nothing of the checks in pyproject."""

import tomllib
from dataclasses import is_dataclass
from importlib import import_module
from pathlib import Path

import pytest
from numpydoc.validate import validate

from app.manual.equations import module_of
from tests.manual.citations import SOLVERS, cited, docstrings, implementing

ROOT = Path(__file__).parents[1]
CHECKS = set(tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["numpydoc_validation"]["checks"])


def exported() -> set[str]:
    """Return the names of the classes and functions that packages of the solvers export, as they are defined."""
    packages = [import_module(".".join(path.parent.relative_to(ROOT).parts)) for path in SOLVERS.rglob("__init__.py")]
    values = [getattr(package, name) for package in packages for name in getattr(package, "__all__", ())]
    return {
        f"{value.__module__}.{value.__qualname__}"
        for value in values
        if getattr(value, "__module__", "").startswith("solvers.") and hasattr(value, "__qualname__")
    }


def with_equation() -> set[str]:
    """Return the names of functions whose docstring cites an equation, and of every `solve`."""
    functions = {name for name in cited() if name.rpartition(".")[2][0].islower() and name != module_of(name)}
    return functions | {name for _, name, _ in docstrings() if name.endswith(".solve")}


PUBLIC = sorted(exported() | with_equation())


@pytest.mark.parametrize("name", PUBLIC)
def test_docstring_has_the_form(name: str) -> None:
    checks = CHECKS - {"PR01"} if is_dataclass(implementing(name)) else CHECKS  # a field is documented where it stands
    assert [(code, text) for code, text in validate(name)["errors"] if code in checks] == []
