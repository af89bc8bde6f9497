"""The Python examples of the README and of the chapter on the service run as they are, but for the address."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from app.evaluate import answer

pytestmark = pytest.mark.ci

ROOT = Path(__file__).parents[2]
TEXTS = [(ROOT / name).read_text("utf-8") for name in ("README.md", "app/manual/service.md")]
SNIPPETS = [each for text in TEXTS for each in re.findall(r"```python\n(.*?)```", text, re.DOTALL)]
ADDRESS = "http://127.0.0.1:8000"
PAIR = {
    "gears": {
        "pinion": {"teeth": 25},
        "wheel": {"teeth": 76},
        "module_mm": 4,
        "helix_angle_deg": 10,
        "face_width_mm": 60,
    },
    "load": {"pinion_torque_n_m": 900, "pinion_speed_rpm": 1500},
    "lubricant": {"iso_vg": 220},
    "temperatures": {"oil_c": 70, "scuffing_test": {"fzg_stage": 12}},
    "model": {"lubrication": "closed_form"},
}
"""The request for the gear pair that the README calculates without a server."""


def run(snippet: str, server: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(snippet.replace(ADDRESS, server), names)  # noqa: S102  our own text
    return names


def test_a_single_request(server: str) -> None:
    (snippet,) = (each for each in SNIPPETS if "service.scuffing" in each)
    names = run(snippet, server)
    with names["service"]:
        assert names["result"]["status"] in {"ok", "ok_with_warnings"}


def test_a_sweep_into_pandas(server: str) -> None:
    (snippet,) = (each for each in SNIPPETS if "service.sweep" in each)
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
    result = run(snippet, ADDRESS)["result"]
    answered = answer("/v1/scuffing", PAIR)
    assert result.flash.blok_max == pytest.approx(answered["flash"]["blok_max_k"], rel=1e-9)
    assert result.safety.blok_factor == pytest.approx(answered["safety"]["blok_factor"], rel=1e-9)
    assert result.distribution.friction_loss.power == pytest.approx(answered["friction_loss"]["power_w"], rel=1e-9)


@pytest.mark.parametrize(
    ("part", "count"), [("ProcessPoolExecutor", 2048), ("LocalCluster", 64)], ids=["processes", "dask"]
)
def test_a_study_in_a_script_keeps_its_points(part: str, count: int, tmp_path: Path) -> None:
    (snippet,) = (each for each in SNIPPETS if part in each)
    script = tmp_path / "script.py"
    script.write_text(snippet, "utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run([sys.executable, script], cwd=tmp_path, env=environment, check=True)
    head, *points = map(json.loads, (tmp_path / "points.jsonl").read_text("utf-8").splitlines())
    assert head["type"] == "kept"
    assert len({point["case"] for point in points}) == len(points) == count
