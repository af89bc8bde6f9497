"""Oils with names: data sheets that were read, each with its source and the date of reading (`oil_sheets.json`).

Every row prints both viscosities and the viscosity index, so that one can be checked by the other (ASTM D2270).
"""

import json
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from pathlib import Path

from solvers.lubricants import OilKind
from solvers.oils import SQUARE_MILLIMETRE, viscosity_index

FILE = Path(__file__).with_name("oil_sheets.json")
INDEX_DIFFERS = 5.0  # chosen: rounding the viscosities of a turbine oil to 0.1 mm^2/s moves the index by 4
NEAREST = 3  # names that a refusal suggests
LONGEST = 100  # letters of a text that are compared with the names


@dataclass(frozen=True, slots=True)
class NamedOil:
    """A row of the table, in the units of data sheets; None where the sheet prints nothing.

    A load stage is the one at which the oil fails, as inputs have it: 13 if a sheet says above 12.
    """

    name: str
    kind: OilKind
    kinematic_viscosity_40_mm2_per_s: float
    kinematic_viscosity_100_mm2_per_s: float
    viscosity_index: float
    density_15_kg_per_m3: float | None
    fzg_stage: int | None  # of A/8.3/90
    micropitting_stage: int | None  # of FVA 54/7
    source: str
    read: str

    @property
    def computed_index(self) -> float:
        """Viscosity index that follows from the printed viscosities (ASTM D2270) [-]."""
        viscosities = self.kinematic_viscosity_40_mm2_per_s, self.kinematic_viscosity_100_mm2_per_s
        return viscosity_index(*(value * SQUARE_MILLIMETRE for value in viscosities))

    @property
    def index_remark(self) -> str:
        """What to say if printed and computed index differ by more than rounding explains; else nothing."""
        if abs(self.computed_index - self.viscosity_index) <= INDEX_DIFFERS:
            return ""
        return (
            f"; the sheet prints the viscosity index {self.viscosity_index:g}, but its viscosities have "
            f"{self.computed_index:.0f} (ASTM D2270), and the viscosities are used"
        )


@cache
def named_oils() -> dict[str, NamedOil]:
    """Return all oils of the table by their names, in its order."""
    rows = (NamedOil(**row) for row in json.loads(FILE.read_text("utf-8")))
    return {oil.name: oil for oil in rows}


def nearest_names(text: str) -> list[str]:
    """Return the names of the table that are most similar to a text, the most similar first."""
    names = {name.casefold(): name for name in named_oils()}
    near = get_close_matches(text[:LONGEST].casefold(), names, n=NEAREST, cutoff=0.0)
    return [names[name] for name in near]
