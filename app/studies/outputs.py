"""Which numbers of an answer a study tells."""

from dataclasses import dataclass

from app.calculations import Calculation
from app.contract.fields import Leaf, outputs_of
from app.studies.errors import StudyRefused
from app.studies.plan import did_you_mean


@dataclass(frozen=True, slots=True)
class ChosenOutputs:
    """The outputs in the order of the answer's columns."""

    leaves: list[Leaf]

    @property
    def paths(self) -> list[str]:
        """Their dotted paths."""
        return [leaf.path for leaf in self.leaves]

    def header(self) -> list[dict[str, str | None]]:
        """How the first line of a study names them."""
        return [{"path": leaf.path, "unit": leaf.unit, "title": leaf.title} for leaf in self.leaves]


def chosen(calculation: Calculation, wanted: list[str] | None) -> ChosenOutputs:
    """The outputs asked for, by default the headline numbers; StudyRefused for what the answer does not have."""
    known = outputs_of(calculation.response)
    if wanted is None:
        headlines = sorted((leaf for leaf in known.values() if leaf.headline), key=lambda leaf: leaf.headline or 0)
        return ChosenOutputs(headlines)
    found = []
    for place, path in enumerate(wanted):
        pointer = f"/outputs/{place}"
        if path not in known:
            if any(name.startswith(f"{path}.") for name in known):
                raise StudyRefused(pointer, "not_scalar", f"{path} is a group; name one of its numbers")
            raise StudyRefused(pointer, "unknown_output", f"unknown output {path}{did_you_mean(path, known)}")
        if wanted.count(path) > 1:
            raise StudyRefused(pointer, "duplicate_path", f"{path} is asked for twice")
        found.append(known[path])
    return ChosenOutputs(found)
