"""The identity of the solvers' sources: prose leaves it, a constant changes it."""

from pathlib import Path

import pytest

from app.sources import SOURCES, recent_changes, sources_of

MODULE = '''"""What is computed."""

LIMIT = 0.5
"""A limit."""


class Pair:
    """Two gears."""


def double(x: float) -> float:
    """Twice x."""
    return 2.0 * x  # twice
'''


def named(folder: Path, text: str, name: str = "module.py") -> str:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text, "utf-8")
    return sources_of(folder)


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
    ],
)
def test_prose_and_layout_do_not_change_the_sources(tmp_path: Path, old: str, new: str) -> None:
    assert old in MODULE
    assert named(tmp_path, MODULE) == named(tmp_path, MODULE.replace(old, new))


@pytest.mark.parametrize(("old", "new"), [("0.5", "0.50001"), ("2.0 * x", "x * 2.0"), ("double", "twice")])
def test_a_constant_or_a_formula_changes_the_sources(tmp_path: Path, old: str, new: str) -> None:
    assert named(tmp_path, MODULE) != named(tmp_path, MODULE.replace(old, new))


def test_another_module_changes_the_sources_unless_it_holds_what_was_published(tmp_path: Path) -> None:
    before = named(tmp_path, MODULE)
    assert named(tmp_path, MODULE, "published/paper.py") == before
    assert named(tmp_path, MODULE, "other.py") != before


def test_sources_are_a_hash_and_changes_are_plain_text() -> None:
    assert len(SOURCES) == 64
    assert int(SOURCES, 16) > 0
    assert recent_changes()
    for change in recent_changes():
        assert "`" not in change
        assert "\n" not in change
