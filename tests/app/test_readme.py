"""The README's examples run as they stand."""

import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt

README = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
SNIPPETS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
ADDRESS = "http://127.0.0.1:8000"


def run(snippet: str, server: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(snippet.replace(ADDRESS, server), names)  # noqa: S102  our own text
    return names


def test_a_single_request(server: str) -> None:
    (snippet,) = (each for each in SNIPPETS if "safety" in each)
    names = run(snippet, server)
    with names["service"]:
        assert names["result"]["status"] in {"ok", "ok_with_warnings"}


def test_a_sweep_into_pandas(server: str) -> None:
    (snippet,) = (each for each in SNIPPETS if ".frame()" in each)
    names = run(snippet, server)
    table = names["table"]
    assert table.columns[0] == "modifications.helix_slope_um"
    assert list(table["modifications.helix_slope_um"]) == [float(slope) for slope in range(-20, 21)]
    request = names["sweep"]["request"]
    request["modifications"]["helix_slope_um"] = table["modifications.helix_slope_um"][7]
    with names["service"] as service:
        answer = service.load_distribution(request)
    for path in table.columns[1:]:
        found = answer
        for part in path.split("."):
            found = found[part]
        assert found == table[path][7]


def test_a_flash_temperature_without_a_server() -> None:
    (snippet,) = (each for each in SNIPPETS if "GearPairInputs" in each)
    mpl.use("agg")  # a window would wait to be closed
    found = run(snippet, ADDRESS)["found"]
    assert found.path.blok_flash.max() == found.flash.feature_line_max
    assert 20.0 < found.flash.blok_max < 60.0
    (drawn,) = plt.gca().lines
    assert drawn.get_ydata().max() == found.flash.feature_line_max
