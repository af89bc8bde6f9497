"""Pages that do not belong to a case: the start page, and the page of a gear unit that was read from a file."""

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import chain
from math import pi
from typing import Any

from app.calculations import BY_PATH, Calculation, card_of
from app.examples import Example
from app.figures.data import ThemeName
from app.manual import chapters
from app.pages.cases import Asked
from app.pages.form import FormState, title_of
from app.pages.pair_path import PAGE, SCUFFING, TRAIN, chosen_form, entry_form, path_of
from app.pages.query import Pairs, body_of, excluded, from_form, link, normalised, pairs_of, pairs_of_query
from app.pages.studies.spectrum import address_of
from app.pages.study_links import studies_of
from app.pages.templating import by_model, example_link, examples_of, model_of, page_path, rendered
from app.pages.typed import as_typed
from app.schema.fields import branches, is_below, leaf_at
from app.schema.model import Request

GRADE = "lubricant.iso_vg"
COMMON = frozenset(
    {
        *(GRADE, "lubricant.kind", "temperatures.oil_c", "temperatures.scuffing_test.fzg_stage"),
        "cooling.gear_flow_l_per_min",
    }
)
"""The fields that the page of a unit asks once for all stages."""
CASE_COLUMNS = ("load.pinion_torque_n_m", "load.pinion_speed_rpm", "temperatures.oil_c")


@lru_cache(maxsize=4)
def start_page(root: str) -> str:
    """Return the start page: for each model a question, the figure that answers the question, and the calculations."""
    models = {name: _entry(calculations) for name, calculations in by_model().items()}
    return rendered("start.html", root, models=models)


@lru_cache(maxsize=4)
def new_pair_page(root: str) -> str:
    """Return the form of a new gear pair, with which the path of a pair begins."""
    blank = Asked(PAGE, [], root=root)
    return rendered("pair.html", root, sections=entry_form(), action=PAGE, steps=path_of(blank))


def _entry(calculations: list[Calculation]) -> dict[str, Any]:
    """Return the entry of a model on the start page: a question, its picture, and the calculations of the model."""
    first = calculations[0]
    example = _first_example(first)
    return {
        "chapter": chapters()[model_of(first)],
        "question": example.title,
        "address": example_link(first, example),
        "picture": _picture(model_of(first), first) if card_of(first).start_figure else None,
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


def start_figures() -> dict[str, tuple[Calculation, Example, str]]:
    """Return calculation, example and figure of each model's picture on the start page.

    The pictures are stored, so that they are there at once; `python -m tests.manual.test_generated` renews them.
    """
    firsts = {name: calculations[0] for name, calculations in by_model().items()}
    return {
        name: (first, _first_example(first), card_of(first).start_figure)
        for name, first in firsts.items()
        if card_of(first).start_figure
    }


def picture_file(model: str, theme: ThemeName) -> str:
    """Return the name of the stored picture of a model."""
    return f"start-{model}-{theme}.svg"


def _first_example(calculation: Calculation) -> Example:
    """Return the example of a model on the start page: the first whose title is a question."""
    listed = examples_of(calculation)
    return next((example for example in listed if example.title.endswith("?")), listed[0])


def _picture(model: str, calculation: Calculation) -> dict[str, str]:
    """Return the text and the files of the start figure of a calculation."""
    figure = next(figure for figure in calculation.figures if figure.name == card_of(calculation).start_figure)
    return {"title": figure.title, "light": picture_file(model, "light"), "dark": picture_file(model, "dark")}


def unit_page(
    root: str,
    unit: dict[str, Any],
    name: str = "",
    sha256: str = "",
    common: Pairs | None = None,
    results: Sequence[dict[str, Any]] = (),
    is_kept: bool = False,
) -> str:
    """Return the page of a gear unit: its stages, with links to the calculations of each stage.

    `unit` is the answer of /v1/rexs. The links contain the name of the file and its SHA-256, so that reports can state
    both. `common` are the fields that all stages share, and `results` the summaries of the stages, if they are
    calculated. `is_kept` says whether the service still has the file.
    """
    file = {"rexs_file": name, "rexs_sha256": sha256}
    common = common or []
    unit = with_common(unit, common)
    stages = [_stage(stage, file | {"rexs_stage": str(stage["id"])}) for stage in unit["stages"]]
    state = FormState({name: as_typed(text) for name, text in common}, endpoint=SCUFFING)
    return rendered(
        "rexs.html",
        root,
        unit=unit,
        stages=stages,
        name=name,
        sha256=sha256,
        oil=chosen_form(BY_PATH[SCUFFING].request, state, COMMON),
        query=link("", common),
        results=results,
        columns=list(dict.fromkeys(card["label"] for found in results for card in found.get("cards", ()))),
        is_kept=is_kept,
    )


def endpoint_of(stage: dict[str, Any]) -> str:
    """Return the endpoint whose results are those of a stage: the drive train, if the file describes one."""
    return TRAIN if TRAIN in stage["requests"] else SCUFFING


def stage_cases(unit: dict[str, Any]) -> list[tuple[list[int], Asked]]:
    """Return, for every stage of a unit, its ids in the file and the case that is calculated."""
    return [
        (
            stage["helices"] or [stage["id"]],
            Asked(page_path(BY_PATH[endpoint_of(stage)]), pairs_of(stage["requests"][endpoint_of(stage)])),
        )
        for stage in unit["stages"]
    ]


def with_common(unit: dict[str, Any], common: Pairs) -> dict[str, Any]:
    """Return a unit whose requests have the fields that all stages share, in place of those of the file."""
    if not common:
        return unit
    stages = []
    for stage in unit["stages"]:
        requests, given = {}, set[str]()
        for path, body in stage["requests"].items():
            model = BY_PATH[path].request
            own = [(name, text) for name, text in common if leaf_at(model, name)]
            replaced = {other for name, _ in own for other in _replaced(model, name)}
            if any(name == GRADE for name, _ in own):
                replaced.add("lubricant")  # another oil: nothing of the file's oil holds
            kept = [pair for pair in pairs_of(body) if not any(is_below(pair[0], other) for other in replaced)]
            requests[path] = body_of(model, [*kept, *own])
            given |= replaced
        missing = [entry for entry in stage["missing"] if not any(is_below(entry["field"], each) for each in given)]
        stages.append(stage | {"requests": requests, "missing": missing})
    return unit | {"stages": stages}


def _replaced(model: type[Request], name: str) -> set[str]:
    """Return the fields and sections that must be empty if the field `name` is given, and the field itself."""
    leaf, section = leaf_at(model, name), name.rpartition(".")[0]
    found = {name, *(excluded(name, leaf) if leaf else ())}
    while section:
        outer, _, own = section.rpartition(".")
        around = branches(model)[outer].model if outer else model
        fellows = {fellow for group in around.exclusive if own in group for fellow in group} - {own}
        found |= {f"{outer}.{fellow}".lstrip(".") for fellow in fellows}
        section = outer
    return found


def common_of(query: str) -> Pairs:
    """Return the fields for all stages in the query of a unit's page; other fields of the query are left out."""
    model = BY_PATH[SCUFFING].request
    return [pair for pair in normalised(model, from_form(model, pairs_of_query(query))) if pair[0] in COMMON]


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
