"""The tables and anchors of the manual agree with the code. `python -m tests.manual.test_generated` renews them.

The command also renews the pictures.

In a chapter, a generated table stands between `<!-- generated: NAME -->` and `<!-- end -->`. A picture is named after
an example and one of its figures, or after a study. These pictures and the anchors before numbered equations are for
readers of the repository. The service draws its own pictures, and its equations are anchors themselves.
"""

import asyncio
import re
from collections.abc import Iterator
from importlib.resources import as_file
from pathlib import Path
from typing import get_args

import pytest

from app.calculations import CALCULATIONS
from app.evaluate import figure_of
from app.examples import examples
from app.figures.data import ThemeName
from app.main import app
from app.manual import NAMES, chapters, file_of
from app.manual.equations import anchor
from app.models.drive_train.typical import RULES
from app.pages.cases import Asked
from app.pages.manual import shown_studies
from app.pages.overview import picture_file, start_figures
from app.pages.studies import PAGES
from app.pages.studies.page import checked, file
from app.settings import Settings
from app.studies.runner import Clock, Line
from benchmarks.published import STATEMENTS, Row
from benchmarks.published.statement import Basis
from tests.manual.pictures import figures_of, studies_of
from tests.support.pools import InlinePool

FOLDER = Path(__file__).parents[2] / "app" / "manual"
STATIC = FOLDER.parent / "pages" / "static"
BLOCK = re.compile(r"<!-- generated: ([\w -]+) -->\n(.*?)<!-- end -->", re.DOTALL)
NUMBERED = re.compile(
    r"(?:^<a id=\"eq-[\w.-]+\"></a>\n\n)?(^\$\$\n(?:(?!\$\$).)*?\\tag\{([^}]+)\}\n\$\$)", re.MULTILINE | re.DOTALL
)
BASES: dict[Basis, str] = {
    "printed": "Numbers that the source prints",
    "bound": "Words, curves and ranges of the source, as bounds",
    "independent calculation": "Numbers that no source prints, from an independent calculation or a closed form",
}
ROUNDING = 1e-9
STUDY_POINTS, DEADLINE_S = 1000, 30.0
DEFAULTS = {
    "workers": "one per core, divided by the server's processes",
    "max_connections": "by the descriptor limit",
    "scheduler": "none: the workers",
}


def table(header: tuple[str, ...], rows: Iterator[tuple[str, ...]]) -> str:
    lines = [header, ("---",) * len(header), *rows]
    return "".join("| " + " | ".join(cell.replace("|", r"\|") for cell in line) + " |\n" for line in lines)


def comparison(model: str) -> str:
    """Return a table for each basis of comparison: what is printed, what is a bound, what was calculated elsewhere."""
    rows = [statement.row() for statement in STATEMENTS[model]]
    tables = []
    for basis, lead in BASES.items():
        some = [row for row in rows if row.basis == basis]
        remarked = any(row.remark for row in some)
        header = ("statement", "source", basis, "computed", "unit", "deviation", *(["remark"] if remarked else []))
        if some:
            tables.append(f"{lead}:\n\n" + table(header, (_compared(row)[: len(header)] for row in some)))
    return "\n".join(tables)


def _compared(row: Row) -> tuple[str, ...]:
    """Return one row of the comparison."""
    # A computed number below 1e-9 is written as zero. A deviation that is rounded to zero has no sign.
    outcome = "holds" if row.holds else "does not hold"
    deviation = outcome if row.deviation is None else f"{100 * row.deviation:+.1f} %"
    deviation = deviation.replace("-0.0", "0.0").replace("+0.0", "0.0")
    computed = f"{row.computed if abs(row.computed) > ROUNDING else 0.0:.4g}"
    return row.statement, row.source, row.expected, computed, row.unit, deviation, row.remark


def settings_table() -> str:
    """Return the table of all settings."""
    return table(
        ("variable", "what", "default"),
        (
            (f"`TRIBODRIVE_{name.upper()}`", field.description or "", DEFAULTS.get(name, _default(field.default)))
            for name, field in Settings.model_fields.items()
        ),
    )


def _default(value: object) -> str:
    if isinstance(value, tuple):
        return ", ".join(value) or "none"
    return "none" if value in {None, ""} else f"{value:g}" if isinstance(value, float) else str(value)


def endpoint_table() -> str:
    """Return the table of all operations in the OpenAPI document, except the operations that draw figures."""
    paths = app.openapi()["paths"]
    return table(
        ("address", "what"),
        (
            (f"`{method.upper()} {path}`", _said(operation))
            for path, operations in paths.items()
            for method, operation in operations.items()
            if "/figures/{name}" not in path
        ),
    )


def _said(operation: dict[str, str]) -> str:
    """Return the summary of an operation.

    If the summary is only the function's name, return the first paragraph of the description.
    """
    summary = operation["summary"]
    if operation["operationId"].startswith(summary.lower().replace(" ", "_")):
        return " ".join(operation["description"].split("\n\n")[0].split())
    return summary


def generated(name: str) -> str:
    """Return the table that belongs in the block with this name."""
    kind, _, model = name.partition(" ")
    tables = {"comparison": lambda: comparison(model), "settings": settings_table, "endpoints": endpoint_table}
    return (tables | {"rules": rules_table})[kind]()


def rules_table() -> str:
    """Return the table of the rules of typical shafts and bearings."""
    return table(("what", "rule", "source"), (tuple(rule) for rule in RULES.values()))


def blocks() -> list[tuple[str, str, str]]:
    return [(chapter.name, *found) for chapter in chapters().values() for found in BLOCK.findall(chapter.text)]


@pytest.mark.parametrize(("name", "content"), [each[1:] for each in blocks()], ids=[each[1] for each in blocks()])
def test_a_table_is_as_the_code_makes_it(name: str, content: str) -> None:
    assert content == generated(name), "renew it by python -m tests.manual.test_generated"


def test_every_comparison_stands_in_the_manual() -> None:
    assert {f"comparison {model}" for model in STATEMENTS} | {"settings", "endpoints", "rules"} == {
        each[1] for each in blocks()
    }


def anchored(text: str) -> str:
    """Return the text of a chapter with an anchor before each numbered equation."""
    return NUMBERED.sub(lambda found: f'<a id="{anchor(found[2])}"></a>\n\n{found[1]}', text)


@pytest.mark.parametrize("name", NAMES)
def test_equations_have_anchors_in_the_repository_too(name: str) -> None:
    text = chapters()[name].text
    assert text == anchored(text), "renew it by python -m tests.manual.test_generated"
    assert text.count('<a id="eq-') == text.count("\\tag{")


def renew_chapters() -> None:
    for chapter in chapters().values():
        with as_file(file_of(chapter.name)) as path:
            path.write_text(anchored(BLOCK.sub(_renewed, chapter.text)), "utf-8")


def _renewed(block: re.Match[str]) -> str:
    return f"<!-- generated: {block[1]} -->\n{generated(block[1])}<!-- end -->"


def study_figure(name: str) -> bytes:
    """Return the picture of a study as a PNG file."""
    shown = shown_studies()[name]
    asked = Asked(shown.path, shown.pairs, {**shown.controls, "theme": "light"})
    page = next(page for page in PAGES if page.link.name == shown.page)
    study = checked(page, asked, STUDY_POINTS, DEADLINE_S)

    async def lines() -> list[Line]:
        clock = Clock(study.study.total)
        found = [line async for some in study.study.lines(InlinePool(), clock) for line in some]
        return [line for line in found if line["type"] != "progress"]

    image = file(study, asyncio.run(lines()), shown.figure, "png")
    assert isinstance(image, bytes), image
    return image


def renew_studies() -> None:
    folder = emptied("studies")
    for chapter in chapters().values():
        for name in studies_of(chapter):
            (folder / f"{name}.png").write_bytes(study_figure(name))


def emptied(name: str) -> Path:
    folder = FOLDER / name
    folder.mkdir(exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    return folder


def renew_figures() -> None:
    folder = emptied("figures")
    for name, shown in sorted({each for chapter in chapters().values() for each in figures_of(chapter)}):
        example = examples()[name]
        calculation = next(each for each in CALCULATIONS if each.path == example.endpoint)
        request = calculation.request.model_validate(example.request)
        (folder / f"{name}.{shown}.png").write_bytes(figure_of(shown, "png", "light", calculation.path, request))


def renew_start_page() -> None:
    for model, (calculation, example, name) in start_figures().items():
        request = calculation.request.model_validate(example.request)
        for theme in get_args(ThemeName):
            content = figure_of(name, "svg", theme, calculation.path, request)
            (STATIC / picture_file(model, theme)).write_bytes(content)


if __name__ == "__main__":
    renew_start_page()
    renew_chapters()
    renew_figures()
    renew_studies()
