"""The studies of a case, and ready studies, which vary one or two fields of an example or seek one.

The ready studies are those of the models' examples.
"""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.examples import examples, studies
from app.pages.query import Pairs, link, pairs_of
from app.pages.study_kinds import FIND, LINKS, VARY, StudyLink
from app.pages.templating import page_path
from app.schema.fields import leaf_at, value_at

AROUND = (0.5, 1.5)  # ends of the range in which a derived value is varied, as multiples of the value


def study_links(calculation: Calculation) -> tuple[StudyLink, ...]:
    """Return one link for each kind of study that can be run with the cases of a calculation."""
    return tuple(study for study in LINKS if study.endpoint in {None, calculation.path})


class StudyExample(NamedTuple):
    """A question about an example, and the parameters of the study that answers the question."""

    title: str
    source: str
    example: str
    study: dict[str, str]
    page: str = VARY.name

    @property
    def calculation(self) -> Calculation:
        """The calculation of the example."""
        return BY_PATH[examples()[self.example].endpoint]

    @property
    def address(self) -> str:
        """The address of the page that answers the question."""
        request = examples()[self.example].request
        return link(f"{page_path(self.calculation)}/{self.page}", pairs_of(request), **self.study)


class Starter(NamedTuple):
    """A link to a study whose settings are filled in, so that the study is ready to run."""

    title: str
    source: str
    address: str


STUDIES = tuple(StudyExample(**entry) for model in studies() for entry in model.pages)


def studies_of(calculation: Calculation, *pages: str) -> list[StudyExample]:
    """Return the ready studies whose examples belong to a calculation: all of them, or those on the named pages."""
    return [study for study in STUDIES if study.calculation is calculation and study.page in (pages or {study.page})]


def studies_of_case(
    calculation: Calculation,
    pairs: Pairs,
    case: Any,
    derived: Mapping[str, Any] = MappingProxyType({}),
    carried: Mapping[str, str | None] = MappingProxyType({}),
    pages: Sequence[str] = (),
) -> list[Starter]:
    """Return links that apply the ready studies of a calculation to a case; with `pages`, only those on these pages.

    `derived` holds values that the case does not state but implies, for example the power that follows from a given
    torque. The keys are the paths of these values. `carried` holds the query fields that go with the case to all its
    pages.

    The range of a varied field depends on the value of the field in the case:

    - If the case states a value other than zero, or implies a value, the range lies around this value.
    - If the case states zero, or if the field has options and is empty, the range of the example is used.
    - If the field is sought, no range is needed.
    - Otherwise the list contains no link to the study.
    """
    starters = []
    for example in studies_of(calculation, *pages):
        study = dict(example.study)
        axes = [axis for axis in "xy" if axis in study]
        for axis in axes:
            path, ends = study[axis], (f"{axis}.from", f"{axis}.to")
            value, derived_value = value_at(case, path), derived.get(path)
            if value:
                study = {name: text for name, text in study.items() if name not in ends}
            elif value is None and isinstance(derived_value, int | float):
                study |= {end: f"{times * derived_value:.4g}" for end, times in zip(ends, AROUND, strict=True)}
            elif value is None and example.page != FIND.name and not _options(calculation, path):
                break
        else:
            address = f"{page_path(calculation)}/{example.page}"
            starters.append(Starter(example.title, "", link(address, pairs, **study, **carried)))
    return starters


def _options(calculation: Calculation, path: str) -> tuple[Any, ...]:
    leaf = leaf_at(calculation.request, path)
    return leaf.options if leaf else ()
