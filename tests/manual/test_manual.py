"""The manual and the code name each other, the links of the manual have targets, and its examples run."""

import doctest
import re
from functools import cached_property
from pathlib import Path

import httpx
import pytest

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.evaluate import evaluate
from app.examples import examples
from app.manual import NAMES, chapters
from app.manual.equations import anchor, equations, functions, module_of
from app.manual.search import search, sections
from app.pages.manual import chapter_of, method_of, shown_studies
from tests.manual.citations import cited, declared, implementing
from tests.manual.pictures import figures_of, studies_of

FOLDER = Path(__file__).parents[2] / "app" / "manual"


def folder_of(name: str) -> Path:
    own = FOLDER.parent / "models" / name.replace("-", "_")
    return own if own.is_dir() else FOLDER


def test_every_chapter_is_served_and_no_file_is_left_out() -> None:
    models = (path.parent.name.replace("_", "-") for path in FOLDER.parent.glob("models/*/chapter.md"))
    assert sorted(NAMES) == sorted([*(path.stem for path in FOLDER.glob("*.md")), *models])


def test_every_tag_is_an_equation_of_its_own() -> None:
    """The pattern must find the equation of every tag, because an equation that is not found has no anchor."""
    tags = [tag for chapter in chapters().values() for tag in re.findall(r"\\tag\{([^}]+)\}", chapter.text)]
    assert sorted(tags) == sorted(equations())


def test_the_text_of_an_equation_is_that_of_no_other() -> None:
    """The text of a numbered equation must not include an unnumbered block that stands before the equation."""
    assert [number for number, equation in equations().items() if "$" in equation.text] == []


def test_functions_of_an_equation_cite_it() -> None:
    for number, equation in equations().items():
        for name in equation.functions:
            assert callable(implementing(name)) or isinstance(implementing(name), property | cached_property)
            assert number in cited().get(name, set()), name


def test_every_cited_equation_stands_in_the_manual() -> None:
    missing = {name: sorted(found - set(equations())) for name, found in cited().items() if found - set(equations())}
    assert missing == {}
    assert declared() - set(equations()) == set()


def test_every_function_that_cites_an_equation_is_named_below_it() -> None:
    """Only modules and classes may cite an equation without being named below the equation."""
    unnamed = [
        (name, number)
        for name, found in cited().items()
        if name.rpartition(".")[2][0].islower() and name != module_of(name)
        for number in found
        if name not in equations()[number].functions
    ]
    assert unnamed == []


def test_every_equation_of_ours_is_implemented() -> None:
    """Every equation of our own names a function that implements the equation."""
    # An equation from a paper needs no function: the manual prints some of these equations only in order to correct
    # them.
    assert [number for number, equation in equations().items() if " " not in number and not equation.functions] == []


@pytest.mark.parametrize("name", NAMES)
def test_links_to_code_name_the_file(name: str) -> None:
    for function, path in re.findall(r"\[`(solvers[\w.]+)`\]\(([^)]+)\)", chapters()[name].text):
        assert (folder_of(name) / path).resolve().is_file(), path
        assert path.lstrip("./") == f"{module_of(function).replace('.', '/')}.py"


@pytest.mark.parametrize("name", NAMES)
def test_figures_are_there(name: str) -> None:
    known = {each.path: {figure.name for figure in each.figures} for each in CALCULATIONS}
    for example, figure in figures_of(chapters()[name]):
        assert figure in known[examples()[example].endpoint]
        assert (FOLDER / "figures" / f"{example}.{figure}.png").read_bytes().startswith(b"\x89PNG")
    shown = {f"{example}.{figure}.png" for each in chapters().values() for example, figure in figures_of(each)}
    assert shown == {path.name for path in (FOLDER / "figures").iterdir()}


def test_every_model_shows_where_it_fails() -> None:
    """The section "Limits of validity" of every model with its own endpoint shows the picture of a study."""
    # The pictures in the chapters, the picture files and the studies that the service shows have the same names.
    without = {
        "first-pair",
        "standard",
        "double-helical",
        "heat-balance",
        "spectrum",
        "service",
        "fields",
    }  # no endpoint of its own
    for name in set(NAMES) - without:
        assert f"studies/{name}.png)" in chapters()[name].section("Limits of validity")
    names = sorted(name for each in chapters().values() for name in studies_of(each))
    assert names == sorted(shown_studies()) == sorted(path.stem for path in (FOLDER / "studies").iterdir())
    for name in names:
        assert (FOLDER / "studies" / f"{name}.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.ci
def test_a_study_of_a_limit_is_drawn_by_the_service(client: httpx.Client, pages: dict[str, str]) -> None:
    (address,) = re.findall(r'<img src="(/coupling/vary/[^"]+)"', pages["/manual/coupling"])
    drawn = client.get(address.replace("&amp;", "&"))
    assert drawn.status_code == 200
    assert "edge contact" in drawn.text
    assert "outside a limit of validity" in drawn.text


@pytest.mark.parametrize("name", NAMES)
def test_examples_run(name: str) -> None:
    parsed = doctest.DocTestParser().get_doctest(chapters()[name].text, {}, name, f"{name}.md", 0)
    assert doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(parsed).failed == 0


@pytest.fixture(scope="module")
def pages(client: httpx.Client) -> dict[str, str]:
    """Return all pages of the manual. The keys are the paths of the pages."""
    paths = ["/manual", "/manual/functions", *(f"/manual/{name}" for name in NAMES)]
    found = {}
    for path in paths:
        page = client.get(path)
        assert page.status_code == 200
        assert "script-src" not in page.headers["content-security-policy"]
        found[path] = page.text
    return found


@pytest.mark.ci
def test_links_of_the_pages_lead_somewhere(client: httpx.Client, pages: dict[str, str]) -> None:
    anchors = {path: set(re.findall(r'\bid="([^"]+)"', text)) for path, text in pages.items()}
    for path, text in pages.items():
        assert len(anchors[path]) == len(re.findall(r'\bid="', text))
        for link in set(re.findall(r'\b(?:href|src|srcset)="([^"]+)"', text)):
            target, _, place = link.replace("&amp;", "&").partition("#")
            if (target or path) in pages:
                assert not place or place in anchors[target or path], link
            elif target.startswith("/") and "figures" not in target and "?" not in target:
                assert client.get(target).status_code == 200, link
            else:
                assert target.startswith(("/", "https://")), link


@pytest.mark.ci
def test_pages_hold_the_equations_as_mathml_without_scripts(pages: dict[str, str]) -> None:
    for equation in equations().values():
        assert f'id="{anchor(equation.number)}"' in pages[f"/manual/{equation.chapter}"]
    for path, text in pages.items():
        assert path == "/manual/fields" or "<script" not in text
        assert " style=" not in text
        assert "$" not in re.sub(r"<pre.*?</pre>", "", text, flags=re.DOTALL), path


@pytest.mark.ci
def test_figures_are_drawn_by_the_service(client: httpx.Client, pages: dict[str, str]) -> None:
    addresses = re.findall(r'<img src="([^"]+)"', pages["/manual/coupling"])
    assert len(addresses) == len(figures_of(chapters()["coupling"])) + len(studies_of(chapters()["coupling"]))
    drawn = client.get(addresses[0].replace("&amp;", "&"), follow_redirects=True)
    assert drawn.headers["content-type"].startswith("image/svg+xml")


def test_the_functions_page_leads_back(client: httpx.Client) -> None:
    page = client.get("/manual/functions").text
    for function in functions():
        assert f'id="{function.name}"' in page
        assert function.text
        for equation in function.equations:
            assert f'href="{equation.address}"' in page


def test_a_chapter_that_is_not_there(client: httpx.Client) -> None:
    assert client.get("/manual/alchemy").status_code == 404


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_calculation_has_its_chapter_and_method(calculation: Calculation) -> None:
    method = method_of(chapter_of(calculation))
    assert len(method["equations"]) > 5
    assert method["misprints"].startswith("<div")
    assert method["limits"].startswith("<ul>")
    assert "<a " not in method["misprints"] + method["limits"] + method["lead"]


def test_the_table_of_effects_is_computed_from_the_starter() -> None:
    calculation, example = BY_PATH["/v1/drive-train"], examples()["starter-turbo-gear-drive-train"]
    text = chapters()["drive-train"].text
    rows = {
        cells[0]: cells[1:] for cells in map(cells_of, text[text.index("| included effects |") :].splitlines()[2:7])
    }
    alone = {"shafts": False, "coupling": False, "thermal": False}
    effects = {
        "flanks only, as in the load distribution": alone,
        "heat": alone | {"thermal": True},
        "shafts and films": alone | {"shafts": True},
        "shafts, films, coupling": alone | {"shafts": True, "coupling": True},
        "all": {},
    }
    assert rows.keys() == effects.keys()
    for name, switched in effects.items():
        request = calculation.request.model_validate({**example.request, "effects": switched})
        answer = evaluate(calculation, request)
        numbers = [float(cell.removesuffix(" µm")) for cell in rows[name]]
        slopes, load = answer.misalignment, answer.load
        computed = slopes.shaft_slope_um, slopes.thermal_slope_um, load.face_load_factor, load.face_load_at
        assert numbers[:4] == pytest.approx(computed, abs=0.0501), name
        assert numbers[2:] == pytest.approx([*computed[2:], answer.safety.blok_flank], abs=0.00501), name


def cells_of(line: str) -> list[str]:
    """Return the cells of a row of a table in Markdown."""
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_a_search_finds_the_sections_with_all_words(client: httpx.Client) -> None:
    page = client.get("/manual", params={"find": "STARVED film"}).text
    (first, *_) = re.findall(r'<h2><a href="([^"]+)"', page)
    assert first.startswith("/manual/coupling#")
    assert f'id="{first.partition("#")[2]}"' in client.get("/manual/coupling").text
    assert "No sections with" in client.get("/manual", params={"find": "phlogiston"}).text
    assert client.get("/manual", params={"find": "a" * 201}).status_code == 422


def test_every_section_of_the_manual_is_found_by_its_title() -> None:
    for section in sections():
        assert section in [found.section for found in search(section.title)]


def test_a_search_is_quoted(client: httpx.Client) -> None:
    assert "<b>" not in client.get("/manual", params={"find": "<b>"}).text


@pytest.mark.ci
def test_every_chapter_lists_all_chapters(pages: dict[str, str]) -> None:
    for name in set(NAMES) - {"fields"}:
        assert {f"/manual/{other}" for other in NAMES} <= set(re.findall(r'href="([^"]+)"', pages[f"/manual/{name}"]))
