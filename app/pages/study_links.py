"""Links to the pages of studies: those of a case, and studies to start from, an example with a field or two varied."""

import json
from importlib.resources import files
from typing import Any, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.examples import examples
from app.pages.query import Pairs, link, pairs_of
from app.pages.study_kinds import StudyLink, study_pages
from app.pages.templating import page_path
from app.studies.fields import value_at


def study_links(calculation: Calculation) -> tuple[StudyLink, ...]:
    """The studies that cases of a calculation have."""
    links: tuple[StudyLink, ...] = tuple(page.link for page in study_pages())
    return tuple(each for each in links if each.endpoint in {None, calculation.path})


VARY = "vary"
"""The name of the page on which the examples are studied."""


class StudyExample(NamedTuple):
    """A question, the example that it is asked of, and what is varied."""

    title: str
    source: str
    example: str
    study: dict[str, str]

    @property
    def calculation(self) -> Calculation:
        """Whose page it is on."""
        return BY_PATH[examples()[self.example].endpoint]

    @property
    def address(self) -> str:
        """The page that answers it."""
        request = examples()[self.example].request
        return link(f"{page_path(self.calculation)}/{VARY}", pairs_of(request), **self.study)


class Starter(NamedTuple):
    """A link to a study that is ready to run."""

    title: str
    source: str
    address: str


STUDIES = tuple(
    StudyExample(**each) for each in json.loads(files("app.pages").joinpath("sweep_examples.json").read_text("utf-8"))
)


def studies_of(calculation: Calculation) -> list[StudyExample]:
    """The studies that start from examples of a calculation."""
    return [each for each in STUDIES if each.calculation is calculation]


def studies_of_case(calculation: Calculation, pairs: Pairs, case: Any) -> list[Starter]:
    """The same studies asked of a case: fields that have a value in it vary around that."""
    address, found = f"{page_path(calculation)}/{VARY}", []
    for each in studies_of(calculation):
        own = [f"{axis}.{end}" for axis in "xy" if value_at(case, each.study.get(axis, "")) for end in ("from", "to")]
        study = {name: text for name, text in each.study.items() if name not in own}
        found.append(Starter(each.title, "", link(address, pairs, **study)))
    return found
