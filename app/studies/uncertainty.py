"""How well models and load are known, as distributions: cooling (the heat band's inputs), friction, bulk, load.

Each is distributed about the value of the case, and the ends of its range are two standard deviations away: the range
of the heat band, or the tolerance that is declared at the field. What a request states or has measured stays as it is,
but for the error of the measurement. All ranges are chosen; no measurement above 50 m/s was readable.
"""

from collections.abc import Collection, Iterable, Iterator
from math import cos
from typing import Any

from app.schema.fields import leaf_at, value_at
from app.schema.model import Request
from app.studies.requests import Lognormal, Normal, Scatter, Triangular
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.errors import InvalidInput
from solvers.heat_balance.band import FLING_OFF_FACTORS, REWETTING_SHARES, WETTING_SHARES, WINDAGE_FACTORS
from solvers.heat_balance.inputs import FLING_OFF_FACTOR, WETTING_SHARE
from solvers.heat_balance.losses import windage
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs

ENDS = 2.0  # standard deviations between the value of the case and an end of its range, chosen
OF_THE_MODEL = "uncertainty of the model"  # the reasons of assumptions begin with these words
COOLING, FRICTION, BULK, READING, LOAD = (
    f"{OF_THE_MODEL}: {what}, two standard deviations are the ends of its range"
    for what in (
        "cooling of the teeth, over the range of the heat band",
        "friction, by the tolerance of its field",
        "bulk temperature, by the tolerance of its field",
        "measured temperature, by the tolerance of its field",
        "load, by the tolerance of its field",
    )
)
BULKS = ("temperatures.bulk_c", "thermal.pinion_bulk_c", "thermal.wheel_bulk_c")
FRICTIONS = ("friction_coefficient", "friction_factor", "friction.coefficient")
LOADS = ("operation.application_factor", "operation.power_kw", "operation.pinion_torque_n_m")
READINGS = ("pinion_flank_c", "pinion_body_c", "wheel_flank_c", "wheel_body_c", "drain_c")


def model_distributions(request: Request) -> dict[str, tuple[Scatter, str]]:
    """Return the distributions of what is not well known in a case, with their reasons, by the paths of the fields."""
    found = [*_frictions(request), *(_cooling(request) if _is_balanced(request) else _bulks(request))]
    return {scatter.path: (scatter, reason) for scatter, reason in found}


def load_distributions(request: Request) -> dict[str, tuple[Scatter, str]]:
    """Return the distributions of the load of a gear unit, with their reasons, by the paths of the fields."""
    return {path: _about(request, path, LOAD) for path in LOADS if value_at(request, path)}


def assumptions_of(
    request: Request, distributions: dict[str, tuple[Scatter, str]], paths: Collection[str]
) -> list[dict[str, Any]]:
    """Say which of the distributions a study drew."""
    return [
        {"field": path, "value": value_at(request, path), "reason": reason}
        for path, (_, reason) in distributions.items()
        if path in paths
    ]


def quantities_of(reasons: Iterable[str]) -> list[str]:
    """Name what these reasons are about, each once, such as friction."""
    return list(dict.fromkeys(reason.removeprefix(f"{OF_THE_MODEL}: ").partition(",")[0] for reason in reasons))


def _is_balanced(request: Request) -> bool:
    return bool(getattr(request, "is_balanced", False))


def _frictions(request: Request) -> Iterator[tuple[Scatter, str]]:
    """Yield the coefficient that is given, or the factor on that of the law."""
    by_law = value_at(request, "model.friction") == "iso_tr_13989"
    for path in FRICTIONS:
        own, leaf = value_at(request, path), leaf_at(type(request), path)
        without_effect = path == ("friction_coefficient" if by_law else "friction_factor")
        if leaf is not None and own and not without_effect:
            share = leaf.declared.relative_tolerance or 0.0
            yield (
                Lognormal(path=path, distribution="lognormal", median=own, factor=(1.0 + share) ** (1 / ENDS)),
                FRICTION,
            )


def _bulks(request: Request) -> Iterator[tuple[Scatter, str]]:
    for path in BULKS:
        if value_at(request, path) is not None:
            yield _about(request, path, BULK)


def _about(request: Request, path: str, reason: str) -> tuple[Scatter, str]:
    leaf = leaf_at(type(request), path)
    assert leaf is not None
    own = float(value_at(request, path))
    deviation = (leaf.declared.tolerance_of(own) or 0.0) / ENDS
    return Normal(path=path, distribution="normal", mean=own, deviation=deviation), reason


def _cooling(request: Request) -> Iterator[tuple[Scatter, str]]:
    """Yield what the heat balance does not know of the cooling: what `heat_balance.band` varies."""
    cooling: Any = value_at(request, "cooling")
    readings = [f"cooling.measured.{name}" for name in READINGS]
    measured = [path for path in readings if value_at(request, path) is not None]
    faces = [f"cooling.measured.face.{place}.temperature_c" for place in range(len(cooling.measured.face))]
    for path in (*measured, *faces):
        yield _about(request, path, READING)
    rotors = [path for path in measured if not path.endswith("drain_c")]
    if cooling.wetting_share is None and not rotors and not faces:
        yield _between("cooling.wetting_share", WETTING_SHARE, WETTING_SHARES), COOLING
    if cooling.fling_off_factor is None:
        yield _between("cooling.fling_off_factor", FLING_OFF_FACTOR, FLING_OFF_FACTORS), COOLING
    if cooling.rewetting_share is None:
        least, most = REWETTING_SHARES
        path = "cooling.rewetting_share"
        yield Triangular(path=path, distribution="triangular", min=least, mode=least, max=most), COOLING
    drag = _windage(request) if cooling.windage_w is None else None
    if drag:
        yield _between("cooling.windage_w", drag, WINDAGE_FACTORS), COOLING


def _between(path: str, nominal: float, ends: tuple[float, float]) -> Lognormal:
    """Return the distribution about a nominal value whose middle 95 % are as wide as a range."""
    factor = (ends[1] / ends[0]) ** (1 / (2 * ENDS))
    return Lognormal(path=path, distribution="lognormal", median=nominal, factor=factor)


def _windage(request: Request) -> float | None:
    """Windage of both gears by Mauz [W]; None if the request is not valid, which each point says itself."""
    try:
        inputs: Any = request.inputs()
    except InvalidInput:
        return None
    mesh: ScuffingInputs = inputs.mesh if isinstance(inputs, DriveTrainInputs) else inputs
    gears, speed = mesh.distribution.gears, abs(mesh.distribution.load.pinion_speed)
    ratio = gears.pinion.teeth / gears.wheel.teeth
    diameters = [each.teeth * gears.normal_module / cos(gears.helix_angle) for each in (gears.pinion, gears.wheel)]
    velocity = speed * diameters[0] / 2
    sizes = zip(diameters, (speed, speed * ratio), strict=True)
    drag = sum(windage(velocity, d, gears.toothed_width, gears.normal_module, own) for d, own in sizes)
    return float(UNITS["w"].from_si(drag))
