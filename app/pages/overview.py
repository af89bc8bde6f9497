"""Pages that do not belong to a case: the start page, and the page of a gear unit that was read from a file."""

from collections.abc import Iterable
from functools import lru_cache
from itertools import chain
from math import pi
from typing import Any

from app.calculations import BY_PATH, Calculation, card_of
from app.examples import Example
from app.manual import chapters
from app.pages.form import title_of
from app.pages.query import link, pairs_of
from app.pages.studies.spectrum import address_of
from app.pages.study_links import studies_of
from app.pages.templating import by_model, example_link, examples_of, model_of, page_path, rendered
from app.schema.fields import leaf_at

SCUFFING = "/v1/scuffing"
CASE_COLUMNS = ("load.pinion_torque_n_m", "load.pinion_speed_rpm", "temperatures.oil_c")


@lru_cache(maxsize=4)
def start_page(root: str) -> str:
    """Return the start page: for each model a question, the figure that answers the question, and the calculations."""
    models = {name: _entry(calculations) for name, calculations in by_model().items()}
    return rendered("start.html", root, models=models)


def _entry(calculations: list[Calculation]) -> dict[str, Any]:
    """Return the entry of a model on the start page: a question, its picture, and the calculations of the model."""
    first = calculations[0]
    of_first = examples_of(first)
    example = next((example for example in of_first if example.title.endswith("?")), of_first[0])
    return {
        "chapter": chapters()[model_of(first)],
        "question": example.title,
        "address": example_link(first, example),
        "picture": _picture(first, example) if card_of(first).start_figure else None,
        "calculations": [
            (
                calculation,
                page_path(calculation),
                [(shown.title, example_link(calculation, shown)) for shown in examples_of(calculation)[:2]],
            )
            for calculation in calculations
        ],
        "studies": [study for calculation in calculations for study in studies_of(calculation)[:1]],
    }


def _picture(calculation: Calculation, example: Example) -> dict[str, str]:
    """Return the text and the addresses of the start figure of a calculation, for an example."""
    figure = next(figure for figure in calculation.figures if figure.name == card_of(calculation).start_figure)
    address, pairs = f"{page_path(calculation)}/figures/{figure.name}.svg", pairs_of(example.request)
    return {"title": figure.title, "light": link(address, pairs), "dark": link(address, pairs, theme="dark")}


def unit_page(root: str, unit: dict[str, Any], name: str = "", sha256: str = "") -> str:
    """Return the page of a gear unit: its stages, with links to the calculations of each stage.

    `unit` is the answer of /v1/rexs. The links contain the name of the file and its SHA-256, so that reports can state
    both.
    """
    file = {"rexs_file": name, "rexs_sha256": sha256}
    stages = [_stage(stage, file | {"rexs_stage": str(stage["id"])}) for stage in unit["stages"]]
    return rendered("rexs.html", root, unit=unit, stages=stages, name=name, sha256=sha256)


def _titled(field: str, asked: Iterable[str]) -> str:
    """Return the title of an endpoint or of a field of a request."""
    if field in BY_PATH:
        return BY_PATH[field].title
    models = [BY_PATH[path].request for path in dict.fromkeys([*asked, *BY_PATH])]
    leaves = (leaf.title for model in models if (leaf := leaf_at(model, field)))
    sections = (title for model in models if (title := title_of(model, field)) != field)
    return next(chain(leaves, sections), field.replace("_", " ").replace(".", ", "))


def _stage(stage: dict[str, Any], file: dict[str, str]) -> dict[str, Any]:
    requests, request = stage["requests"], next(iter(stage["requests"].values()))
    gears, load = request["gears"], request.get("load", {})
    teeth = [gears.get(role, {}).get("teeth") for role in ("pinion", "wheel")]  # None if the file has no number
    ratio = teeth[1] / teeth[0] if all(teeth) else None
    torque, speed = load.get("pinion_torque_n_m"), load.get("pinion_speed_rpm")
    speeds = (speed, speed / ratio if speed and ratio else None)
    cases = []
    for case in stage["cases"]:
        overrides = case["overrides"]
        pairs = dict(pairs_of(requests[SCUFFING])) | dict(pairs_of(overrides))
        address = link(page_path(BY_PATH[SCUFFING]), list(pairs.items()), **file)
        cases.append(case | {"address": address, "row": [overrides.get(name) for name in CASE_COLUMNS]})
    titled = {
        name: [entry | {"field": _titled(entry["field"], requests)} for entry in stage[name]]
        for name in ("missing", "assumed")
    }
    return (
        stage
        | titled
        | {
            "teeth": "/".join(str(number or "–") for number in teeth),
            "ratio": ratio,
            "power_kw": None if torque is None or speed is None else torque * speed * pi / 30e3,
            "speeds": " / ".join(f"{shown:.5g}" for shown in speeds if shown),
            "module_mm": gears.get("module_mm"),
            "face_width_mm": gears.get("face_width_mm"),
            "links": [
                (BY_PATH[path].title, link(page_path(BY_PATH[path]), pairs_of(body), **file))
                for path, body in requests.items()
            ],
            "spectra": [
                (
                    BY_PATH[path].title,
                    address_of(BY_PATH[path], pairs_of(requests[path]), {"cases": lines}, file),
                )
                for path, lines in stage["spectra"].items()
                if BY_PATH[path].words.scuffing
            ],
            "cases": cases,
        }
    )
