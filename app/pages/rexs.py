"""The page of a gear unit that was read from a file: its stages, and a link to every calculation of each."""

from math import pi
from typing import Any

from app.calculations import BY_PATH
from app.pages.query import link, pairs_of
from app.pages.studies.spectrum import address_of
from app.pages.templating import page_path, rendered

SHOWN = ("/v1/scuffing", "/v1/drive-train")  # of the load spectra
_CASE_COLUMNS = ("load.pinion_torque_n_m", "load.pinion_speed_rpm", "temperatures.oil_c")


def unit_page(root: str, unit: dict[str, Any]) -> str:
    """The page of the answer of /v1/rexs."""
    return rendered("rexs.html", root, unit=unit, stages=[_stage(stage) for stage in unit["stages"]])


def _stage(stage: dict[str, Any]) -> dict[str, Any]:
    request = next(iter(stage["requests"].values()))
    gears, load = request["gears"], request.get("load", {})
    teeth = gears["pinion"]["teeth"], gears["wheel"]["teeth"]
    ratio = teeth[1] / teeth[0]
    torque, speed = load.get("pinion_torque_n_m"), load.get("pinion_speed_rpm")
    return stage | {
        "teeth": f"{teeth[0]}/{teeth[1]}",
        "ratio": ratio,
        "power_kw": None if torque is None or speed is None else torque * speed * pi / 30e3,
        "speeds": "" if speed is None else f"{speed:.5g} / {speed / ratio:.5g}",
        "module_mm": gears.get("module_mm"),
        "face_width_mm": gears.get("face_width_mm"),
        "links": [(BY_PATH[path].title, _address(path, body)) for path, body in stage["requests"].items()],
        "spectra": [
            (BY_PATH[path].title, address_of(BY_PATH[path], pairs_of(stage["requests"][path]), {"cases": cases}))
            for path, cases in stage["spectra"].items()
            if path in SHOWN
        ],
        "cases": [_case(stage, case) for case in stage["cases"]],
    }


def _case(stage: dict[str, Any], case: dict[str, Any]) -> dict[str, Any]:
    """A load case with the address of its own page."""
    path = "/v1/scuffing"
    pairs = dict(pairs_of(stage["requests"][path])) | {name: str(value) for name, value in case["overrides"].items()}
    address = link(page_path(BY_PATH[path]), list(pairs.items()))
    return case | {"address": address, "row": [case["overrides"].get(name) for name in _CASE_COLUMNS]}


def _address(path: str, body: dict[str, Any]) -> str:
    return link(page_path(BY_PATH[path]), pairs_of(body))
