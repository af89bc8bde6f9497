"""The project states its version once and locks all its dependencies, and its documents link to existing files."""

import re
import tomllib
from importlib.metadata import version
from pathlib import Path

from app.schema.answers import MODEL_VERSION

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PROJECT = PYPROJECT["project"]
PINNED = re.compile(r"^([A-Za-z0-9._-]+==\S+)", re.MULTILINE)


def text(name: str) -> str:
    return (ROOT / name).read_text("utf-8")


def test_the_version_stands_in_one_place() -> None:
    """If this test fails after a change of the version, reinstall the project by `pip install -e .`."""
    assert PROJECT["version"] == version("tribodrive") == MODEL_VERSION
    stated = [name for name in ("README.md", "CITATION.cff", "CONTRIBUTING.md") if PROJECT["version"] in text(name)]
    assert stated == []


def test_constraints_are_the_names_and_versions_of_the_lock() -> None:
    locked = PINNED.findall(text("requirements.lock"))
    assert locked == PINNED.findall(text("constraints.txt"))
    assert text("requirements.lock").count("--hash=sha256:") > len(locked)
    assert "http" not in re.sub(r"^http\w+==", "", text("requirements.lock"), flags=re.MULTILINE)


def test_every_dependency_is_locked() -> None:
    names = {_plain(pinned.partition("==")[0]) for pinned in PINNED.findall(text("constraints.txt"))}
    extras = [one for group in PROJECT["optional-dependencies"].values() for one in group]
    wanted = {_plain(re.split(r"[\[<>=]", one)[0]) for one in [*PROJECT["dependencies"], *extras]} - {"tribodrive"}
    assert wanted <= names


def _plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def test_links_between_the_projects_documents_lead_somewhere() -> None:
    for name in ("README.md", "CONTRIBUTING.md"):
        prose = re.sub(r"```.*?```|`[^`\n]*`", "", text(name), flags=re.DOTALL)
        for target in re.findall(r"\]\(([^)#:]+)(?:#[\w-]+)?\)", prose):
            assert (ROOT / target).exists(), (name, target)


def test_the_package_has_no_picture_that_no_page_shows() -> None:
    """The manual's pictures are for readers of the repository; pages draw their own."""
    patterns = PYPROJECT["tool"]["setuptools"]["package-data"]["app"]
    packed = {picture for pattern in patterns for picture in (ROOT / "app").glob(pattern) if picture.suffix == ".png"}
    assert {picture.parent for picture in packed} <= {ROOT / "app" / "pages" / "static"}
