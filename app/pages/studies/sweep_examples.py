"""Studies to start from, each a link: an example with one field or two varied."""

import json
from importlib.resources import files
from typing import Any, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.examples import examples
from app.pages.query import Pairs, link, pairs_of
from app.pages.templating import page_path
from app.studies.fields import value_at


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
        return link(f"{page_path(self.calculation)}/vary", pairs_of(request), **self.study)


class StudyLink(NamedTuple):
    """A study to start from: its question and its address."""

    title: str
    address: str


STUDIES = tuple(
    StudyExample(**each)
    for each in json.loads(files("app.pages.studies").joinpath("sweep_examples.json").read_text("utf-8"))
)


def studies_of(calculation: Calculation) -> list[StudyExample]:
    """The studies that start from examples of a calculation."""
    return [each for each in STUDIES if each.calculation is calculation]


def studies_of_case(calculation: Calculation, pairs: Pairs, case: Any) -> list[StudyLink]:
    """The same studies asked of a case: fields that have a value in it vary around that."""
    address, found = f"{page_path(calculation)}/vary", []
    for each in studies_of(calculation):
        own = [f"{axis}.{end}" for axis in "xy" if value_at(case, each.study.get(axis, "")) for end in ("from", "to")]
        study = {name: text for name, text in each.study.items() if name not in own}
        found.append(StudyLink(each.title, link(address, pairs, **study)))
    return found
