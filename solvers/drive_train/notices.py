"""Warnings of a drive train: results out of range, assumptions that matter, inputs that look wrong."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import pi

from solvers.contact.notices import high_pressure
from solvers.coupling.notices import tall_tooth
from solvers.drive_train.checks import NAMES
from solvers.drive_train.film.law import WIDEST
from solvers.drive_train.inputs import BearingFilm, DriveTrainInputs, JournalBearing
from solvers.drive_train.results import (
    AxialBalance,
    CouplingResult,
    DriveTrainResult,
    FaceLoad,
    ShaftResult,
    TrainLosses,
)
from solvers.gears.inputs import GearPairInputs
from solvers.gears.notices import tooth_load, tooth_temperature, unusual_gears
from solvers.gears.pair import PathOfContact
from solvers.heat_balance import Heat
from solvers.heat_balance.results import FaceHeat
from solvers.heat_balance.rings import cylinder_growth
from solvers.lubricants import hot_oil, oil_temperature, thick_oil
from solvers.notices import Notice
from solvers.pumping.notices import thin_air
from solvers.scuffing.helices import UNEQUAL, counted_twice
from solvers.scuffing.notices import unusual_modifications, unusual_temperatures
from solvers.scuffing.safety_results import BulkInForce

SHORT_BEARING = 0.7  # ratio of width to diameter above which the theory of short bearings is inaccurate
ROUNDING = 1e-9  # relative rounding error of lengths that were converted from other units
THIN_FILM = 15e-6  # m; thinner films give a warning
LARGE_ECCENTRICITY = 0.9  # customary design limit, at which the thinnest film is a tenth of the clearance
AMPLIFIED = 1.5  # chosen; amplification above which heat is named
SLENDER = 2.0  # pi r_f/b of a wheel whose rim yields by itself
LIFTED = 0.9  # contact fraction below which flanks count as lifted off


def shaft_notices(inputs: DriveTrainInputs, shafts: tuple[ShaftResult, ShaftResult]) -> Iterator[Notice]:
    """Warn of thin films, omitted bearing losses, long overhangs, and a thrust that may reverse or is too high."""
    for shaft, result, name in zip(inputs.shafts, shafts, NAMES, strict=True):
        for k, (bearing, state) in enumerate(zip(shaft.bearings, result.bearings, strict=True)):
            field = f"{name}.bearings.{k}"
            if isinstance(bearing, JournalBearing):
                yield from _film_notices(bearing, inputs.bearing_film, state.eccentricity_ratio, state.min_film, field)
        if not all(isinstance(bearing, JournalBearing) for bearing in shaft.bearings):
            message = (
                "the loss is known only for plain bearings; the total loss and the efficiency do not include the "
                "losses of the other bearings"
            )
            yield Notice("bearing_loss_left_out", message, f"{name}.bearings", rank="note")
        thrust = result.thrust
        if thrust.reverses and inputs.mesh.distribution.gears.helices == 1:  # two helices leave no thrust to reverse
            message = (
                f"the friction of the coupling can reverse the thrust, which ranges from {thrust.lower:.0f} to "
                f"{thrust.upper:.0f} N"
            )
            yield Notice("thrust_reversal", message, f"{name}.ultimate_thrust")
        if thrust.use is not None and thrust.use > 1.0:
            message = (
                f"the thrust bearing carries {thrust.use:.2f} times its permissible load, which is half of the "
                "ultimate rating"
            )
            yield Notice("thrust_overload", message, f"{name}.ultimate_thrust")
    for k, coupling in enumerate(inputs.couplings):
        shaft = inputs.shafts[0 if coupling.shaft == "pinion" else 1]
        places = [bearing.position for bearing in shaft.bearings]
        if min(abs(coupling.position - place) for place in places) > max(places) - min(places):
            message = "the hub overhangs the nearest bearing by more than the distance between the bearings"
            yield Notice("long_overhang", message, f"couplings.{k}.position", rank="note")


def _film_notices(
    bearing: JournalBearing, model: BearingFilm, eccentricity: float | None, film: float | None, field: str
) -> Iterator[Notice]:
    ratio = bearing.width / bearing.diameter * (1 - ROUNDING)
    if model == "short" and ratio > SHORT_BEARING:
        message = (
            f"the ratio of width to diameter is {ratio:.2f}; above 0.7 the theory of the short bearing overestimates "
            "the stiffness of the film"
        )
        yield Notice("short_bearing_range", message, f"{field}.width")
    if model == "finite" and ratio > WIDEST:
        message = (
            f"the bearing is {ratio:.2f} times as wide as its diameter; above {WIDEST:.0f} its film carries per width "
            f"what the film of a bearing with a ratio of {WIDEST:.0f} carries, less than its own"
        )
        yield Notice("wide_bearing", message, f"{field}.width")
    if film is not None and eccentricity is not None and (film < THIN_FILM or eccentricity > LARGE_ECCENTRICITY):
        message = (
            f"the film of the bearing is only {film * 1e6:.1f} µm thick at an eccentricity ratio of {eccentricity:.2f}"
        )
        yield Notice("thin_film", message, f"{field}.radial_clearance")


def load_notices(inputs: DriveTrainInputs, loads: Sequence[FaceLoad]) -> Iterator[Notice]:
    """Warn if the load of a face is largest at its end, or if flanks lift off.

    Also warn if heat deforms the gears and the inputs do not give the wall response.
    """
    for number, load in enumerate(loads, start=1):
        where = f"helix {number}: " if len(loads) > 1 else ""
        own = number > 1 and inputs.mesh.distribution.modifications.second_helix is not None
        slope = "second_helix.helix_slope" if own else "helix_slope"
        if load.face_load_at in {0.0, 1.0}:
            message = f"{where}the load is largest at the end y/b = {load.face_load_at:.0f} of the face"
            yield Notice("edge_load", message, f"mesh.distribution.modifications.{slope}")
        if load.contact_fraction < LIFTED:
            message = (
                f"{where}only a share of {load.contact_fraction:.2f} of the contact length carries load; at the other "
                "places the flanks lift off"
            )
            yield Notice("lift_off", message, "mesh.distribution.modifications")
    if inputs.effects.thermal and inputs.heat.wall_response is None:
        message = (
            "the wall response is not given and is assumed to be 0.5. Real values lie between 0.2 and 1 and are known "
            "only from measurements"
        )
        yield Notice("wall_response_assumed", message, "heat.wall_response", rank="note")


def helix_notices(
    inputs: DriveTrainInputs, axial: AxialBalance, ran: BulkInForce, heat: Heat | None
) -> Iterator[Notice]:
    """Warn of unequal helices and of what can unload one, of double-helical gears."""
    gears, load = inputs.mesh.distribution.gears, inputs.mesh.distribution.load
    if {0.0, 1.0} & {share for shares in axial.share_bounds for share in shares}:
        message = (
            "the couplings' friction at its limit can lift one helix off, which takes "
            f"{axial.unloading_force / 1e3:.4g} kN along the floating shaft; lower the friction or let the other shaft "
            "float"
        )
        yield Notice("helix_may_unload", message, "floating_shaft")
    if axial.share_factor > UNEQUAL:
        message = (
            f"one helix carries {50 * axial.share_factor:.0f} % of the load, because {axial.force / 1e3:.4g} kN act "
            "along the floating shaft"
        )
        yield Notice("unequal_shares", message, "floating_shaft")
        if ran.bulk_method == "given" and inputs.mesh.temperatures.bulk is not None:
            message = (
                "the helices carry unequal loads and do not have the one bulk temperature that is given: the hotter "
                "one is less safe than computed"
            )
            yield Notice("helices_warm_unequally", message, "mesh.temperatures.bulk")
    yield from counted_twice(load, axial.share_factor)
    if heat is not None and heat.face is None and axial.share_factor > UNEQUAL:
        message = (
            "each helix has the flank temperatures of a balance in which both carry its load; in truth heat flows "
            "through the gap, and the temperatures lie closer together"
        )
        yield Notice("helices_warm_apart", message, "cooling", rank="note")
    slow = "pinion" if gears.pinion.teeth > gears.wheel.teeth else "wheel"
    on_it = any(coupling.shaft == axial.floating_shaft for coupling in inputs.acting_couplings)
    if axial.floating_shaft == slow and gears.pinion.teeth != gears.wheel.teeth and on_it:
        message = (
            f"the slow shaft floats; a coupling on it shifts {gears_ratio(gears):.3g} times the load from helix to "
            "helix that one on the fast shaft would at the same hub diameter"
        )
        yield Notice("slow_shaft_floats", message, "floating_shaft", rank="note")


def face_heat_notices(inputs: DriveTrainInputs, path: PathOfContact, faces: Sequence[FaceHeat]) -> Iterator[Notice]:
    """Warn where heat multiplies misalignment, and where rotors or free slices are taken as stiffer or softer."""
    loop = max((face.largest_eigenvalue for face in faces), default=0.0)
    if loop >= 1.0:
        message = (
            f"thermally unstable: loop gain {loop:.3g}, stable below 1. One end of the face takes the load and heats "
            "itself further; give more oil on the flanks, a stiffer wheel or less friction"
        )
        yield Notice("thermally_unstable", message, "cooling", rank="invalid")
    largest = max((face.amplification or 0.0 for face in faces), default=0.0)
    if largest > AMPLIFIED:
        message = (
            f"heat amplifies misalignment {largest:.2g} times; a tolerance of 10 µm acts like {10 * largest:.2g} µm"
        )
        yield Notice("thermally_amplified", message, "cooling", rank="note")
    wheel, responses = path.pair.wheel, inputs.heat.responses(path.pair.pinion.teeth / path.pair.wheel.teeth)
    slenderness = pi * wheel.root_radius / path.plane.face_width
    if faces and slenderness > SLENDER and inputs.wheel_shaft.gear_body is None:
        message = (
            "the wheel is taken as solid; a rim on a web grows up to three times as much. Give its rim if it has one"
        )
        yield Notice("solid_wheel", message, "wheel_shaft.gear_body", rank="note")
    if not faces and inputs.effects.thermal and any(responses) and slenderness > 1.0:
        message = (
            "the lead of the pumped gas assumes free slices; this wheel yields about "
            f"{100 * cylinder_growth(slenderness):.2g} % of it"
        )
        yield Notice("gas_grows_freely", message, "face_heat", rank="note")


def gears_ratio(gears: GearPairInputs) -> float:
    """Ratio of the numbers of teeth, at least 1 [-]."""
    teeth = gears.pinion.teeth, gears.wheel.teeth
    return max(teeth) / min(teeth)


def loss_notices(inputs: DriveTrainInputs, losses: TrainLosses) -> Iterator[Notice]:
    """Warn if the losses exceed the power."""
    power = inputs.mesh.distribution.load.transmitted_power
    if losses.total is not None and 0.0 < power <= losses.total:
        message = (
            f"the losses of {losses.total / 1e3:.4g} kW exceed the power of {power / 1e3:.4g} kW; no efficiency is "
            "stated, because the driven machine has to supply power as well"
        )
        yield Notice("losses_exceed_power", message, "pinion_torque")


def coupling_notices(
    inputs: DriveTrainInputs, couplings: tuple[CouplingResult, ...], of_model: list[tuple[Notice, ...]]
) -> Iterator[Notice]:
    """Report hubs that stick, and pass on the warnings of the coupling model.

    For each coupling, `of_model` holds the warnings of the coupling model. If a coupling has several warnings with the
    same code, only one of these warnings is passed on.
    """
    for k, (coupling, notices) in enumerate(zip(couplings, of_model, strict=True)):
        field = f"couplings.{k}"
        for name, stuck, share in zip(("unit", "machine"), coupling.stuck, coupling.friction_share, strict=True):
            if stuck and inputs.coupling_friction == "elastic_plastic":
                message = (
                    f"the hub on the side of the {name} sticks; the friction moment of this hub is {share:.2f} times "
                    "the moment at full sliding"
                )
                yield Notice("hub_sticks", message, f"{field}.friction", rank="note")
        for notice in {notice.code: notice for notice in notices}.values():
            code = "misalignment_limit" if notice.code == "sliding_velocity" else notice.code
            where = field if notice.field is None else f"{field}.{notice.field}"
            yield replace(notice, code=code, field=where)


def unusual_values(inputs: DriveTrainInputs, result: DriveTrainResult) -> Iterator[Notice]:
    """Report unusual values of oils, temperatures, ambient pressure, couplings, gears, modifications and load."""
    derived, mesh, load = result.derived, inputs.mesh.distribution, result.load
    yield from thick_oil(derived.lubricant.viscosity if derived.lubricant else None)
    for name, shaft in zip(NAMES, (derived.pinion_shaft, derived.wheel_shaft), strict=True):
        for k, bearing in enumerate(shaft.bearings):
            yield from thick_oil(bearing.viscosity, f"{name}.bearings.{k}.viscosity")
    if inputs.mesh.known_oil is not None:
        yield from unusual_temperatures(inputs.mesh.temperatures)
        yield from hot_oil(inputs.mesh.temperatures.oil, derived.temperatures.bulk)
    yield from tooth_temperature(inputs.heat.pinion_bulk, "heat.pinion_bulk")
    yield from tooth_temperature(inputs.heat.wheel_bulk, "heat.wheel_bulk")
    yield from thin_air(inputs.pumping.ambient.pressure)
    for k, each in enumerate(inputs.couplings):
        yield from tall_tooth(each.coupling.tooth_height, each.coupling.module, f"couplings.{k}.coupling")
        if each.lubricant.temperature is not None:
            yield from oil_temperature(each.lubricant.temperature, f"couplings.{k}.lubricant.temperature")
    yield from unusual_gears(mesh.gears, mesh.load.pinion_speed)
    yield from unusual_modifications(mesh.modifications)
    pressures = [load.max_pressure] if result.helices is None else [own.load.max_pressure for own in result.helices]
    yield from high_pressure(max((pressure for pressure in pressures if pressure is not None), default=None))
    share = max((helix.share for helix in result.helices), default=1.0) if result.helices else 1.0
    yield from tooth_load(mesh.gears, share * mesh.load.torque, load.max_line_load)
