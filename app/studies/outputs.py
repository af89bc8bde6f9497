"""Which numbers of an answer a study tells."""

from dataclasses import dataclass

from app.calculations import Calculation
from app.contract.fields import Leaf, headlines
from app.studies.errors import StudyRefused
from app.studies.fields import scalar_at


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
    if wanted is None:
        return ChosenOutputs(list(headlines(calculation.response)))
    for place, path in enumerate(wanted):
        if path in wanted[:place]:
            raise StudyRefused(f"/outputs/{place}", "duplicate_path", f"{path} is asked for twice")
    return ChosenOutputs(
        [
            scalar_at(calculation.response, path, f"/outputs/{place}", "unknown_output")
            for place, path in enumerate(wanted)
        ]
    )
