"""Uncertain inputs of a gear unit, and the values between which these inputs are expected to lie.

A combination of one value per uncertain input is called a corner of the unit.
"""

from collections.abc import Callable
from dataclasses import dataclass

from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft
from solvers.notices import Notice

MOST_CORNERS = 256  # number of combinations of eight uncertain inputs with two values per input
FRICTION = (0.05, 0.25)  # coefficients of friction: best mixed lubrication; the value that gives the thrust 0.25 T/D
THRUST = (0.0, 1.0)  # thrust as a share of the friction limit of the coupling
EITHER_THRUST = (-1.0, *THRUST)  # of double-helical gears: each sense loads another helix
RESPONSE = (0.3, 1.0)  # wall responses: 0.3, chosen, if oil cools the wall; 1.0 if the wall is as warm as the gas
CLEARANCE = 0.1  # relative change of the clearance, up and down
QUARTERS: tuple[Callable[[float, float], tuple[float, float]], ...] = (
    lambda x, y: (x, y),
    lambda x, y: (-y, x),
    lambda x, y: (-x, -y),
    lambda x, y: (y, -x),
)


@dataclass(frozen=True, slots=True)
class Range:
    """Values of one uncertain quantity.

    `quantity` is the name of the quantity in words. `names` are the dotted names of the inputs that change with this
    quantity, such as "heat.wall_response". Each row of `values` holds one value per input.
    """

    quantity: str
    names: tuple[str, ...]
    values: tuple[tuple[float, ...], ...]


def uncertain_inputs(inputs: DriveTrainInputs) -> tuple[Range, ...]:
    """Return the ranges of the uncertain inputs of a unit.

    The uncertain inputs are the wall response, the bearing clearances of each shaft, and three inputs of each coupling:
    the friction, the direction of the offset, and the thrust. The clearances of a shaft's two bearings change by 10 %
    in opposite senses, because the same change in both bearings would not tilt the shaft. All couplings change
    together, because a unit with two independent couplings would need 2,048 runs.
    """
    helices = inputs.mesh.distribution.gears.helices
    ranges = (
        [Range("wall response", ("heat.wall_response",), tuple((value,) for value in RESPONSE))]
        if inputs.effects.thermal
        else []
    )
    if inputs.effects.shafts:
        ranges += [_clearances("pinion", inputs.pinion_shaft), _clearances("wheel", inputs.wheel_shaft)]
    if inputs.acting_couplings:
        ranges += [
            _together(inputs, "friction", "friction.coefficient", FRICTION),
            _offsets(inputs),
            _together(inputs, "thrust fraction", "thrust_fraction", THRUST if helices == 1 else EITHER_THRUST),
        ]
    return tuple(uncertain for uncertain in ranges if uncertain.names)


def _clearances(gear: str, shaft: Shaft) -> Range:
    """Return the range of the bearing clearances of a shaft. The range has two rows of values.

    In the first row, the clearance of the first bearing is increased, and the clearance of the second bearing is
    reduced. In the second row, the first clearance is reduced, and the second clearance is increased. Bearings that are
    not plain bearings are left out.
    """
    plain = [(k, bearing.clearance) for k, bearing in enumerate(shaft.bearings) if isinstance(bearing, JournalBearing)]
    return Range(
        f"{gear} clearance",
        tuple(f"{gear}_shaft.bearings.{k}.radial_clearance" for k, _ in plain),
        tuple(tuple(own * (1 + sign * (1 - 2 * k) * CLEARANCE) for k, own in plain) for sign in (1, -1)),
    )


def _together(inputs: DriveTrainInputs, quantity: str, name: str, values: tuple[float, ...]) -> Range:
    """Return the range of one input of the couplings. All couplings take the same value."""
    names = tuple(f"couplings.{k}.{name}" for k in range(len(inputs.acting_couplings)))
    return Range(quantity, names, tuple((value,) * len(names) for value in values))


def _offsets(inputs: DriveTrainInputs) -> Range:
    """Return the range of the coupling offsets: every offset that is not zero, turned by 0, 90, 180 and 270 degrees."""
    given = [(k, coupling.offset) for k, coupling in enumerate(inputs.acting_couplings) if any(coupling.offset)]
    names = tuple(f"couplings.{k}.offset.{axis}" for k, _ in given for axis in range(2))
    turned = ([pair for _, (x, y) in given for pair in turn(x, y)] for turn in QUARTERS)
    return Range("offset", names, tuple(map(tuple, turned)))


def no_convergence(failed: int) -> Notice:
    """Return the warning about corners without a solution."""
    return Notice(
        "no_convergence_of_corner",
        f"{failed} combinations of the uncertain inputs (corners) have no solution; the extreme values are those of "
        "the other combinations",
        "ranges",
    )
