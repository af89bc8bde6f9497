"""What follows from the description of a unit before any physics, in groups of the same names."""

from dataclasses import dataclass

from solvers.coupling.inputs import Coupling
from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft, ShaftName
from solvers.scuffing.results import LoadDistribution


@dataclass(frozen=True, slots=True)
class DerivedBearing:
    """Radial clearance [m] and viscosity [Pa s] in force; None of other than plain bearings."""

    radial_clearance: float | None
    viscosity: float | None


@dataclass(frozen=True, slots=True)
class DerivedShaft:
    """Where torque enters [m], bearings."""

    torque_position: float
    bearings: tuple[DerivedBearing, ...]


@dataclass(frozen=True, slots=True)
class DerivedCoupling:
    """The coupling with its missing proportions, and the axial stiffness of its teeth [N/m]."""

    coupling: Coupling
    axial_tooth_stiffness: float


@dataclass(frozen=True, slots=True)
class DerivedHeat:
    """Wall responses."""

    wall_response: float
    wall_response_wheel: float


@dataclass(frozen=True, slots=True)
class DerivedTemperatures:
    """Bulk temperature of the contact and scuffing temperature [K]; None where there is none."""

    bulk: float | None
    scuffing: float | None


@dataclass(frozen=True, slots=True)
class Derived:
    """Torque [N m], power [W], lengths [m], product of the load factors, and what each part fills in."""

    pinion_torque: float
    power: float
    centre_distance: float
    tip_relief_length: float
    root_relief_length: float
    end_relief_length: float
    contact_load_factor: float
    pinion_shaft: DerivedShaft
    wheel_shaft: DerivedShaft
    couplings: tuple[DerivedCoupling, ...]
    thermal: DerivedHeat
    temperatures: DerivedTemperatures


def derived(inputs: DriveTrainInputs, mesh: LoadDistribution) -> Derived:
    """What the description left open, as it was used."""
    ratio = inputs.mesh.distribution.gears.pinion.teeth / inputs.mesh.distribution.gears.wheel.teeth
    lengths = mesh.derived
    return Derived(
        pinion_torque=lengths.pinion_torque,
        power=lengths.power,
        centre_distance=lengths.centre_distance,
        tip_relief_length=lengths.tip_relief_length,
        root_relief_length=lengths.root_relief_length,
        end_relief_length=lengths.end_relief_length,
        contact_load_factor=inputs.contact_load_factor,
        pinion_shaft=_shaft(inputs, inputs.pinion_shaft, "pinion"),
        wheel_shaft=_shaft(inputs, inputs.wheel_shaft, "wheel"),
        couplings=tuple(
            DerivedCoupling(one.coupling, one.axial_tooth_stiffness or one.coupling.tooth_stiffness)
            for one in inputs.couplings
        ),
        thermal=DerivedHeat(*inputs.heat.responses(ratio)),
        temperatures=DerivedTemperatures(inputs.mesh.temperatures.bulk, inputs.mesh.temperatures.scuffing),
    )


def _shaft(inputs: DriveTrainInputs, shaft: Shaft, name: ShaftName) -> DerivedShaft:
    position = shaft.torque_position
    if position is None:
        position = next(one.position for one in inputs.couplings if one.shaft == name)
    return DerivedShaft(
        position,
        tuple(
            DerivedBearing(bearing.clearance, bearing.viscosity)
            if isinstance(bearing, JournalBearing)
            else DerivedBearing(None, None)
            for bearing in shaft.bearings
        ),
    )
