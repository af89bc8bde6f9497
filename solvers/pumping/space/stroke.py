"""Area and clearances of a tooth space tabulated over one stroke; all slices share the table."""

from math import degrees

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel
from solvers.errors import InvalidInput
from solvers.pumping.space.section import section
from solvers.pumping.space.tooth_space import StrokeLimits, ToothSpace, stroke_limits
from solvers.quantity import quantity, record
from solvers.sources import MILIAN

POSITIONS = 361  # number of positions, one at every 1/360 of the stroke, chosen
# A change of the logarithm of the area in one step counts as a jump if it exceeds SMOOTH times the change in the
# neighbouring steps by more than JUMP. JUMP, chosen, is far above the rounding errors of the search for the section.
SMOOTH = 3.0
JUMP = 0.01


@record
class StrokeTable:
    """One stroke of a tooth space at equal steps of the owner's angle [rad], arrays (positions,).

    `carried` [m^2] is the gas that the flanks have carried out since the stroke began; its rate may jump between
    positions and would not fit the interpolated `area`.
    """

    limits: StrokeLimits
    angle: FloatArray = quantity(
        "angle of the tooth space", "φ", unit="deg", text="angle of the space's gear from the line of centres"
    )
    area: FloatArray = quantity(
        "area of the tooth space",
        "S_A",
        f"{MILIAN}, Fig. 3",
        unit="mm2",
        text="area left by the mating tooth",
        axis="angle",
    )
    clearance_left: FloatArray = quantity(
        "left clearance", "L_1", f"{MILIAN}, Fig. 3", unit="mm", text="clearance of the flank behind", axis="angle"
    )
    clearance_right: FloatArray = quantity(
        "right clearance", "L_2", f"{MILIAN}, Fig. 3", unit="mm", text="clearance of the flank ahead", axis="angle"
    )
    carried: FloatArray

    @property
    def jump(self) -> tuple[float, float]:
        """Largest jump of the logarithm of the area between two positions (0 if none), and the angle of the jump [rad].

        The area can jump only if the model has tip gaps. The reason for a jump is that the point of the space nearest
        to a tip corner of the mating tooth changes from the flank to the root.
        """
        change = np.abs(np.diff(np.log(self.area)))
        beside = np.maximum(np.append(change[1:], change[-2]), np.append(change[1], change[:-1]))
        at = int(np.argmax(change - SMOOTH * beside))
        jumps = change[at] > SMOOTH * beside[at] + JUMP
        return (float(change[at]) if jumps else 0.0), float(self.angle[at])

    def coarser(self, times: int) -> "StrokeTable":
        """Return this stroke with every `times`-th position only."""
        columns = (self.angle, self.area, self.clearance_left, self.clearance_right, self.carried)
        return StrokeTable(self.limits, *(frozen(column[::times].copy()) for column in columns))


def stroke_table(space: ToothSpace, *, minimum_gap: float = 0.0, positions: int = POSITIONS) -> StrokeTable:
    """Area and clearances (at least `minimum_gap` [m]) of the space over its stroke.

    Raises InvalidInput: tooth_space_closed; tooth_space_minima if the area has several minima.
    """
    limits = stroke_limits(space)
    angle = np.linspace(limits.start, limits.end, positions)
    area, left, right, carried = np.empty((4, positions))
    _tabulate(space, angle, area, left, right, carried)
    _check_area(angle, area)
    return StrokeTable(
        limits=limits,
        angle=frozen(angle),
        area=frozen(area),
        clearance_left=frozen(np.maximum(left, minimum_gap)),
        clearance_right=frozen(np.maximum(right, minimum_gap)),
        carried=frozen(carried - carried[0]),
    )


@kernel
def _tabulate(
    space: ToothSpace, angle: FloatArray, area: FloatArray, left: FloatArray, right: FloatArray, carried: FloatArray
) -> None:
    for i in range(angle.size):
        here = section(space, angle[i])
        area[i], left[i], right[i], carried[i] = here.area, here.left, here.right, here.carried


def _check_area(angle: FloatArray, area: FloatArray) -> None:
    smallest = int(np.argmin(area))
    if area[smallest] <= 0.0:
        message = (
            f"at {degrees(angle[smallest]):.3f} deg the tooth of the mating gear fills the tooth space completely; "
            "check the teeth and the centre distance"
        )
        raise InvalidInput("tooth_space_closed", message, "gears")
    noise = 1e-12 * area.max()
    wrong = np.concatenate([np.diff(area[: smallest + 1]) > noise, np.diff(area[smallest:]) < -noise])
    if wrong.any():
        where = degrees(angle[int(np.argmax(wrong))])
        message = (
            f"near {where:.3f} deg the area of the tooth space has a second minimum. With the option of tip gaps, the "
            "point nearest to a tip corner can jump along the root. Use the option of contact gaps, which avoids this "
            "jump"
        )
        raise InvalidInput("tooth_space_minima", message, "gears")
