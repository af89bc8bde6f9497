"""The docstrings of public objects pass the checks of numpydoc's validator that pyproject.toml selects."""

import doctest
import inspect
import tomllib
from dataclasses import is_dataclass
from enum import EnumType
from importlib import import_module
from pathlib import Path

import pytest
from numpydoc.docscrape import NumpyDocString
from numpydoc.validate import validate

from solvers import scuffing
from solvers.quantity import UNITS, quantities
from tests.manual.citations import SOLVERS, implementing

ROOT = Path(__file__).parents[1]
CHECKS = set(tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["numpydoc_validation"]["checks"])


def exported() -> set[str]:
    """Return the dotted names of the classes and functions that packages of the solvers export.

    Each name begins with the module that defines the class or function.
    """
    packages = [import_module(".".join(path.parent.relative_to(ROOT).parts)) for path in SOLVERS.rglob("__init__.py")]
    values = [getattr(package, name) for package in packages for name in getattr(package, "__all__", ())]
    return {
        f"{value.__module__}.{value.__qualname__}"
        for value in values
        if getattr(value, "__module__", "").startswith("solvers.") and hasattr(value, "__qualname__")
    }


PUBLIC = sorted(exported())


@pytest.mark.ci
def test_docstrings_have_the_form() -> None:
    for name in PUBLIC:
        is_enumeration = isinstance(implementing(name), EnumType)  # has the parameters of `str`
        checks = CHECKS - {"PR01"} if is_enumeration else CHECKS
        assert [(code, text) for code, text in validate(name)["errors"] if code in checks] == [], name


EXAMPLES = [name for name in PUBLIC if ">>>" in (implementing(name).__doc__ or "")]


@pytest.mark.parametrize("name", [*EXAMPLES, "app.studies.script.study"])
def test_examples_run(name: str) -> None:
    names = dict(vars(import_module(implementing(name).__module__)))
    (example,) = doctest.DocTestFinder(recurse=False).find(implementing(name), name, globs=names)
    assert doctest.DocTestRunner().run(example).failed == 0


def fields_in_help(kind: type) -> dict[str, str]:
    """Return the text that `help` shows for each field and computed value of a dataclass."""
    document = NumpyDocString(inspect.getdoc(kind))
    return {entry.name: " ".join(entry.desc) for entry in document["Parameters"] + document["Attributes"]}


def test_help_names_the_unit_of_every_quantity() -> None:
    for kind in filter(is_dataclass, map(implementing, PUBLIC)):
        units = {field: UNITS[declared.unit] for field, declared in quantities(kind).items() if declared.unit}
        shown = fields_in_help(kind)
        assert {field for field, unit in units.items() if f" [{unit.si or unit.symbol}]." not in shown[field]} == set()


def test_help_of_a_load_states_si_units_and_the_range_in_the_shown_unit() -> None:
    shown = fields_in_help(scuffing.Load)
    assert shown["pinion_torque"].startswith("Pinion torque [N m].")
    assert shown["pinion_speed"] == "Pinion speed [rad/s]. Symbol n_1; source Xue 2020; range 0.1 to 200000 1/min."
    assert shown["power"].startswith("Transmitted power [W].")
    assert shown["dynamic_factor"].endswith("default 1.")


def test_a_unit_that_is_converted_names_its_si_unit() -> None:
    for unit in UNITS.values():
        assert (unit.si is None) == ((unit.scale, unit.offset) == (1.0, 0.0)), unit
