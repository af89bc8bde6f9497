"""Gear pairs under the paper's load, spur ones too, and what the tests of edge cases ask of their results."""

from dataclasses import replace

import numpy as np
import pytest

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.published.xue import PAPER_LOAD, paper_gears
from solvers.scuffing.inputs import (
    LoadDistributionInputs,
    Model,
    Modifications,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import Scuffing

LINEAR = Model(contact="linear")


def solve_gears(
    gears: GearPairInputs, modifications: Modifications | None = None, model: Model | None = None
) -> LoadDistribution:
    return solve_load_distribution(
        LoadDistributionInputs(gears, PAPER_LOAD, modifications or Modifications(), model=model or Model())
    )


def codes(result: LoadDistribution | Scuffing) -> set[str]:
    return {notice.code for notice in result.warnings}


def refusal(gears: GearPairInputs) -> InvalidInput:
    with pytest.raises(InvalidInput) as caught:
        solve_gears(gears)
    return caught.value


def spur(width: float = 20e-3) -> GearPairInputs:
    return replace(paper_gears(1), helix_angle=0.0, face_width=width)


def everything_finite(result: LoadDistribution) -> bool:
    line, flank = result.feature_line, result.flank
    arrays = [line.line_load, line.half_width, line.radius, line.sliding, flank.line_load, flank.modification]
    return all(np.all(np.isfinite(array)) for array in (*arrays, result.transmission_error.curves.error))
