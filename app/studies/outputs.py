"""Which values of an answer a study tells."""

from dataclasses import dataclass

from app.calculations import Calculation
from app.problems import Unprocessable
from app.schema.fields import Leaf, headlines
from app.studies.fields import scalar_at


@dataclass(frozen=True, slots=True)
class Outputs:
    """The outputs in the order of the answer's columns."""

    leaves: tuple[Leaf, ...]

    @property
    def paths(self) -> list[str]:
        """Their dotted paths."""
        return [leaf.path for leaf in self.leaves]

    def header(self) -> list[dict[str, str | None]]:
        """What they are: path, unit, title."""
        return [{"path": leaf.path, "unit": leaf.unit, "title": leaf.title} for leaf in self.leaves]


def chosen(calculation: Calculation, wanted: list[str] | None) -> Outputs:
    """The outputs asked for, by default the headline numbers; Unprocessable for what the answer does not have."""
    if wanted is None:
        return Outputs(headlines(calculation.response))
    for place, path in enumerate(wanted):
        if path in wanted[:place]:
            raise Unprocessable("duplicate_path", f"{path} is asked for twice", f"outputs.{place}")
    return Outputs(tuple(output(calculation, path, f"outputs.{place}") for place, path in enumerate(wanted)))


def output(calculation: Calculation, path: str, where: str) -> Leaf:
    """A value that a study can tell; Unprocessable at `where` of the study for what the answer does not have."""
    leaf = scalar_at(calculation.response, path, where, "unknown_output")
    if leaf.detail != "summary":
        raise Unprocessable("not_scalar", f"{path} belongs to a curve or field, which a study does not tell", where)
    return leaf
