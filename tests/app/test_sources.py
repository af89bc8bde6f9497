"""The hash of the solvers' sources depends on constants and formulas, but not on prose and layout."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from markupsafe import escape

from app.examples import examples
from app.pages import views
from app.pages.cases import Asked
from app.pages.query import pairs_of, pairs_of_query, split_views
from app.sources import SOURCES, changes_since, recent_changes
from solvers.digest import digest_of

MODULE = '''"""What is computed."""

LIMIT = 0.5
"""A limit."""


class Pair:
    """Two gears."""

    face_width: float = quantity("face width", "b", ISO_21771, unit="mm", default=20.0, text="of both")


def double(x: float) -> float:
    """Twice x."""
    return 2.0 * x  # twice
'''


def named(folder: Path, text: str, name: str = "module.py") -> str:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text, "utf-8")
    return digest_of(folder)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("What is computed.", "Another explanation."),
        ("A limit.", "The limit of something."),
        ("Two gears.", "A pinion and a wheel."),
        ('    """Twice x."""\n', ""),
        ("# twice", "# because of the second flank"),
        ("LIMIT = 0.5", "LIMIT = 0.5\n\n"),
        ("2.0 * x", "(2.0 * x)"),
        ('"face width", "b", ISO_21771', '"width of the face"'),
        ('text="of both"', 'assumed="usual"'),
    ],
)
def test_prose_and_layout_do_not_change_the_sources(tmp_path: Path, old: str, new: str) -> None:
    assert old in MODULE
    assert named(tmp_path, MODULE) == named(tmp_path, MODULE.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new"),
    [("0.5", "0.50001"), ("20.0", "20.1"), ('"mm"', '"um"'), ("2.0 * x", "x * 2.0"), ("double", "twice")],
)
def test_a_constant_or_a_formula_changes_the_sources(tmp_path: Path, old: str, new: str) -> None:
    assert named(tmp_path, MODULE) != named(tmp_path, MODULE.replace(old, new))


def test_another_module_changes_the_sources(tmp_path: Path) -> None:
    before = named(tmp_path, MODULE)
    assert named(tmp_path, MODULE, "other.py") != before


def test_sources_are_a_hash_and_changes_are_plain_text() -> None:
    assert len(SOURCES) == 64
    assert int(SOURCES, 16) > 0
    assert recent_changes()
    for change in recent_changes():
        assert "`" not in change
        assert "\n" not in change


@pytest.mark.parametrize("sources", ["", SOURCES, SOURCES[:16]])
def test_a_link_of_these_sources_has_no_changes(sources: str) -> None:
    assert changes_since(sources) == []


def test_a_link_of_other_sources_is_told_the_changelog() -> None:
    assert changes_since("0" * 16) == recent_changes()


def asked(**looks: str) -> Asked:
    example = examples()["pahl-z-arrangement"]
    return Asked("/coupling", pairs_of(example.request), looks)


def test_links_name_the_sources_which_are_no_part_of_the_case() -> None:
    case = asked()
    for address in (case.page, case.beside(""), case.beside(case.query), case.report):
        pairs, looks = split_views(pairs_of_query(address.partition("?")[2]))
        assert looks["sources"] == SOURCES[:16]
        assert pairs == case.pairs


@pytest.mark.usefixtures("without_images")
@pytest.mark.parametrize("view", [views.page, partial(views.report, host="http://host")])
def test_a_page_of_other_sources_says_that_numbers_may_differ(view: Callable[[Asked], views.Shown]) -> None:
    page, outdated = (view(asked(**looks)).content.decode() for looks in ({}, {"sources": "0" * 16}))
    assert SOURCES[:16] in page
    assert "numbers may differ" not in page
    assert "numbers may differ" in outdated
    assert escape(recent_changes()[0]) in outdated
