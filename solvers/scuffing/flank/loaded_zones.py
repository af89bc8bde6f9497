"""Where a contact line is loaded: the parts of it at which the gap lies below the approach of the flanks."""

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.gears.path_of_contact import ContactPlane
from solvers.scuffing.flank.modification import Gap, gap_at

LOW, HIGH = range(2)  # columns of zones
MOST_ZONES = 12  # of one line; what more there were joins the last
LEAST_SAMPLES = 8  # of a smooth part
BISECTIONS = 45
GOLDEN_STEPS = 30
GOLDEN = 0.6180339887498949


@kernel
def gap_on_line(form: Gap, plane: ContactPlane, line: float, y: float) -> float:
    """Delta [m] on the contact line x = line - y tan beta_b."""
    return gap_at(form, line - y * plane.tan_base_helix, y)


@kernel
def valley(form: Gap, plane: ContactPlane, line: float, low: float, high: float) -> float:
    """The y [m] of the least gap between two points of a line that hold one valley, by golden section."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = gap_on_line(form, plane, line, inner), gap_on_line(form, plane, line, outer)
    for _ in range(GOLDEN_STEPS):
        if at_inner <= at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = gap_on_line(form, plane, line, inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = gap_on_line(form, plane, line, outer)
    return 0.5 * (low + high)


@kernel
def _edge(form: Gap, plane: ContactPlane, line: float, inside: float, outside: float, reach: float) -> float:
    """The y [m] between a loaded and an unloaded point of a line at which the gap reaches the approach."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (inside + outside)
        if gap_on_line(form, plane, line, middle) < reach:
            inside = middle
        else:
            outside = middle
    return inside


@kernel
def _note(zones: FloatArray, count: int, low: float, high: float) -> int:
    if high <= low:
        return count
    if count == MOST_ZONES:
        zones[count - 1, HIGH] = high
        return count
    zones[count, LOW], zones[count, HIGH] = low, high
    return count + 1


@kernel
def loaded_zones(
    form: Gap,
    plane: ContactPlane,
    line: float,
    part: tuple[float, float],
    samples: int,
    reach: float,
    zones: FloatArray,
) -> int:
    """Write the loaded stretches of a smooth part of a line, rows of first and last y [m], and return their number."""
    low, high = part
    step, count = (high - low) / samples, 0
    before, least_gap, least_at = low, gap_on_line(form, plane, line, low), low
    loaded, start = least_gap < reach, low
    for i in range(1, samples + 1):
        y = high if i == samples else low + i * step
        gap = gap_on_line(form, plane, line, y)
        if gap < least_gap:
            least_gap, least_at = gap, y
        if gap < reach and not loaded:
            start = _edge(form, plane, line, y, before, reach)
        elif loaded and gap >= reach:
            count = _note(zones, count, start, _edge(form, plane, line, before, y, reach))
        loaded, before = gap < reach, y
    if loaded:
        return _note(zones, count, start, high)
    if count == 0:
        left, right = max(least_at - step, low), min(least_at + step, high)
        bottom = valley(form, plane, line, left, right)
        if gap_on_line(form, plane, line, bottom) < reach:
            start = _edge(form, plane, line, bottom, left, reach)
            count = _note(zones, count, start, _edge(form, plane, line, bottom, right, reach))
    return count
