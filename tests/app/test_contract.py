"""The contract of the API: paths, components, fields, types, ranges and what is required, kept in `contract.txt`.

`python -m tests.app.test_contract` writes the file anew after fields were added. A line that goes or changes breaks the
programs of users.
"""

from pathlib import Path
from typing import Any

from app.main import app

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
    return sorted(contract)


def test_the_contract_is_as_it_was() -> None:
    kept, now = KEPT.read_text("utf-8").splitlines(), lines()
    assert not {*kept} - {*now}, "these lines of the contract are gone or changed"
    assert not {*now} - {*kept}, "new in the contract; add it with python -m tests.app.test_contract"


if __name__ == "__main__":
    KEPT.write_text("\n".join(lines()) + "\n", "utf-8")
