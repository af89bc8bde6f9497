"""The README's examples run as they stand."""

import json
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import httpx
import pytest

README = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
SNIPPETS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
ADDRESS = "http://127.0.0.1:8000"


class Table:
    """Stands for pandas.DataFrame, which is no dependency: rows of equal length under as many names."""

    def __init__(self, rows: list[list[Any]], columns: list[str]) -> None:
        assert rows
        assert {len(row) for row in rows} == {len(columns)}
        self.rows = rows
        self.columns = columns


@pytest.fixture(autouse=True)
def _pandas(monkeypatch: pytest.MonkeyPatch) -> None:
    pandas = ModuleType("pandas")
    pandas.DataFrame = Table  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "pandas", pandas)


def run(snippet: str, server: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(snippet.replace(ADDRESS, server), names)  # noqa: S102  our own text
    return names


def test_a_single_request(server: str) -> None:
    (snippet,) = (each for each in SNIPPETS if "safety" in each)
    assert run(snippet, server)["result"]["status"] in {"ok", "ok_with_warnings"}


def test_a_sweep_into_pandas_in_ten_lines(server: str, client: httpx.Client) -> None:
    (snippet,) = (each for each in SNIPPETS if "pandas" in each)
    assert len([line for line in snippet.splitlines() if line.strip()]) <= 11  # ten and the import
    names = run(snippet, server)
    table = names["table"]
    assert table.columns[0] == "modifications.helix_slope_um"
    assert [row[0] for row in table.rows] == [float(slope) for slope in range(-20, 21)]
    request = json.loads(json.dumps(names["example"]["request"]))
    request["modifications"]["helix_slope_um"] = table.rows[7][0]
    answer: Any = client.post(names["example"]["endpoint"], json=request).json()
    for path, value in list(zip(table.columns, table.rows[7], strict=True))[1:]:
        found = answer
        for part in path.split("."):
            found = found[part]
        assert found == value
