"""Links to the pages of studies: those of a case, and studies to start from, an example with a field or two varied."""

import json
from collections.abc import Mapping
from importlib.resources import files
from types import MappingProxyType
from typing import Any, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.examples import examples
from app.pages.query import Pairs, link, pairs_of
from app.pages.study_kinds import StudyLink, study_pages
from app.pages.templating import page_path
from app.schema.fields import leaf_at
from app.studies.fields import value_at

AROUND = (0.5, 1.5)  # times a derived value, where it is varied


def study_links(calculation: Calculation) -> tuple[StudyLink, ...]:
    """The studies that cases of a calculation have."""
    links: tuple[StudyLink, ...] = tuple(page.link for page in study_pages())
    return tuple(each for each in links if each.endpoint in {None, calculation.path})


VARY = "vary"
"""Name of the page of the studies of examples."""


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


def studies_of_case(
    calculation: Calculation,
    pairs: Pairs,
    case: Any,
    derived: Mapping[str, Any] = MappingProxyType({}),
    file: Mapping[str, str | None] = MappingProxyType({}),
) -> list[Starter]:
    """The same studies asked of a case, each around the values of the case.

    `derived` are values by path that the case does not state, such as the power of a given torque; `file` names the
    REXS file from which the case was read. A study of a number that the case does not have at all is left out; options
    and lengths of zero keep the range of the example.
    """
    address, starters = f"{page_path(calculation)}/{VARY}", []
    for each in studies_of(calculation):
        study = dict(each.study)
        axes = [axis for axis in "xy" if axis in study]
        for axis in axes:
            path, ends = study[axis], (f"{axis}.from", f"{axis}.to")
            value, known = value_at(case, path), derived.get(path)
            if value:
                study = {name: text for name, text in study.items() if name not in ends}
            elif value is None and isinstance(known, int | float):
                study |= {end: f"{times * known:.4g}" for end, times in zip(ends, AROUND, strict=True)}
            elif value is None and not getattr(leaf_at(calculation.request, path), "options", ()):
                break
        else:
            starters.append(Starter(each.title, "", link(address, pairs, **study, **file)))
    return starters
