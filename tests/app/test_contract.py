"""The contract with programs of users, kept in `contract.txt`.

Of the API it has paths, components, fields, types, ranges and what is required; of Python the public names with the
parameters of functions and the fields of classes. `python -m tests.app.test_contract` writes the file anew after
something was added. A line that goes or changes breaks the programs of users.
"""

import inspect
import re
import types
import warnings
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from app.main import app
from tests.support.server import ROOT

KEPT = Path(__file__).with_name("contract.txt")
SAID = ("title", "description", "examples", "default", "discriminator")


def brief(schema: Any) -> str:
    """Return a JSON schema as one short text, without prose and defaults."""
    if not isinstance(schema, dict):
        return str(schema)
    facts = {name: value for name, value in schema.items() if name not in SAID and not name.startswith("x-")}
    if "$ref" in facts:
        return str(facts["$ref"]).rpartition("/")[2]
    for several in ("anyOf", "oneOf", "allOf"):
        if several in facts:
            return " | ".join(brief(part) for part in facts[several])
    kind, items = str(facts.pop("type", "any")), facts.pop("items", None)
    facts.pop("properties", None)
    facts.pop("required", None)
    if isinstance(inner := facts.get("additionalProperties"), dict):
        facts["additionalProperties"] = brief(inner)
    said = ", ".join(f"{name} {value}" for name, value in sorted(facts.items()))
    return f"{kind}{f' of ({brief(items)})' if items is not None else ''}{f' [{said}]' if said else ''}"


PACKAGES = sorted(".".join(path.parent.relative_to(ROOT).parts) for path in (ROOT / "solvers").rglob("__init__.py"))
NAMES = {"app.evaluate": ("answer",), "app.workers.cluster": ("Kernels",)}


def names() -> Iterator[str]:
    """Yield the public Python names, each followed by its parameters, or by its members and methods."""
    for module in (*PACKAGES, "app.studies", "app.client", *NAMES):
        found = import_module(module)
        for name in NAMES.get(module, getattr(found, "__all__", ())):
            value, path = getattr(found, name), f"{module}.{name}"
            yield path
            yield from (f"{path}({parameter})" for parameter in parameters(value))
            for method, own in inspect.getmembers(value, inspect.isfunction) if inspect.isclass(value) else ():
                if not method.startswith("_"):
                    yield f"{path}.{method}({', '.join(parameters(own))})"


def parameters(value: Any) -> list[str]:
    """Return the names of the parameters of a function or class; a star marks what is given by name only.

    A class whose docstring has no parameters is not made by users.
    """
    if inspect.isclass(value) and "Parameters" not in (value.__doc__ or ""):
        return []
    try:
        found = inspect.signature(value).parameters.values()
    except (TypeError, ValueError):
        return []
    return [f"{'*' * (each.kind is each.KEYWORD_ONLY)}{each.name}" for each in found]


def lines() -> list[str]:
    document = app.openapi()
    contract = []
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            codes = " ".join(sorted(operation["responses"]))
            contract.append(f"{method.upper()} {path} {operation.get('operationId', '')} {codes}")
    for name, schema in document["components"]["schemas"].items():
        required = schema.get("required", ())
        if "properties" not in schema:
            contract.append(f"{name}: {brief(schema)}")
        for field, declared in schema.get("properties", {}).items():
            contract.append(f"{name}.{field}{'' if field in required else '?'}: {brief(declared)}")
    return [*sorted(contract), *sorted({*names()})]


def test_the_contract_is_as_it_was() -> None:
    kept, now = KEPT.read_text("utf-8").splitlines(), lines()
    assert not {*kept} - {*now}, "these lines of the contract are gone or changed"
    assert not {*now} - {*kept}, "new in the contract; add it with python -m tests.app.test_contract"


def test_a_renamed_name_stays_and_warns() -> None:
    """The recipe of CONTRIBUTING does what it promises."""
    (recipe,) = re.findall(
        r"```python\n(import warnings\n.*?)```", (ROOT / "CONTRIBUTING.md").read_text("utf-8"), re.DOTALL
    )
    module: Any = types.ModuleType("package")
    exec(recipe, vars(module))  # noqa: S102  our own text
    module.new_name = object()
    with pytest.warns(DeprecationWarning, match="package.old_name is now new_name") as caught:
        assert module.old_name is module.new_name
    assert caught[0].filename == __file__
    with pytest.raises(AttributeError, match="no attribute 'other'"):
        _ = module.other
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert module.new_name


if __name__ == "__main__":
    KEPT.write_text("\n".join(lines()) + "\n", "utf-8")
