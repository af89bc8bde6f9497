"""Values that the calculation used for inputs that were left open, such as torques, lengths and temperatures."""

from solvers.coupling.inputs import Coupling
from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft, ShaftName
from solvers.gears.tolerances import FlankTolerances
from solvers.heat_balance import Heat, cooling_in_force
from solvers.heat_balance.results import CoolingInForce
from solvers.lubricants import OilInUse, oil_in_use
from solvers.quantity import quantity, record
from solvers.scuffing.inputs import TS_6336_20
from solvers.scuffing.load_factors.method_b import film_grade, standard_grade
from solvers.scuffing.load_factors.results import FilmGrade, StandardGrade
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import BulkInForce


@record(equation="D4")
class DerivedBearing:
    """Clearance and oil viscosity used for a plain bearing; both are None for other bearings."""

    radial_clearance: float | None = quantity("radial clearance used", "c", unit="um")
    viscosity: float | None = quantity("oil viscosity used in the bearing", "η_B", unit="pa_s")


@record(equation="D16")
class DerivedSection:
    """The outer diameter used for a section."""

    outer_diameter: float = quantity("section outer diameter used", "d_o", unit="mm")


@record(equation="drive-train#shafts")
class DerivedShaft:
    """The values used for a shaft."""

    torque_position: float = quantity("place of the torque used", "z_T", unit="mm")
    sections: tuple[DerivedSection, ...] = quantity("sections used")
    bearings: tuple[DerivedBearing, ...] = quantity("bearings used")


@record(equation="R3")
class DerivedCoupling:
    """The values that the calculation used for a coupling: proportions, oil viscosity and axial tooth stiffness."""

    coupling: Coupling = quantity("proportions used")
    viscosity: float = quantity("oil viscosity used", "η", unit="pa_s", text="at the teeth")
    viscosity_index: float | None = quantity(
        "viscosity index used", "VI", "ASTM D2270", text="null without grade or data sheet", equation="R2"
    )
    axial_tooth_stiffness: float = quantity("axial tooth stiffness used", "c_a", unit="n_per_um", equation="D8")


@record(equation="D10")
class DerivedHeat:
    """Wall response and tooth temperature used for each gear; `inputs.Heat` explains the wall response."""

    wall_response: float = quantity("wall response used", "κ_1")
    wall_response_wheel: float = quantity("wall response of the wheel used", "κ_2")
    pinion_bulk: float = quantity("tooth temperature of the pinion used", "θ_M1", unit="c")
    wheel_bulk: float = quantity("tooth temperature of the wheel used", "θ_M2", unit="c")


@record(equation="D15")
class DerivedTemperatures:
    """The temperatures and the lubricant factor used for the contact."""

    origin: BulkInForce
    bulk: float | None = quantity(
        "bulk temperature used",
        "θ_M",
        unit="c",
        text="`bulk_method` says how it came about; null without an oil, unless given",
    )
    scuffing: float | None = quantity(
        "scuffing temperature used", "θ_S", unit="c", text="given or by a test; null with neither", equation="R9"
    )
    lubricant_factor: float | None = quantity(
        "lubricant factor of the scuffing test used",
        "X_L",
        TS_6336_20,
        text="null without a scuffing test",
        equation="R9",
    )


@record(equation="Xue 1")
class Derived:
    """The values that the calculation used for inputs that were left open."""

    pinion_torque: float = quantity("pinion torque used", "T_1", unit="n_m")
    power: float = quantity("power used", "P", unit="kw")
    centre_distance: float = quantity("centre distance used", "a", unit="mm")
    tip_relief_length: float = quantity("tip relief length used", "L_Ca", unit="mm")
    root_relief_length: float = quantity("root relief length used", "L_Cf", unit="mm")
    end_relief_length: float = quantity("end relief length used", "L_Ce", unit="mm")
    contact_load_factor: float = quantity(
        "load factor of the contacts", "K", text="K_A K_v K_γ, on the load of the contacts only"
    )
    pinion_shaft: DerivedShaft = quantity("pinion shaft used")
    wheel_shaft: DerivedShaft = quantity("wheel shaft used")
    couplings: tuple[DerivedCoupling, ...] = quantity("couplings used")
    thermal: DerivedHeat = quantity("heat used")
    lubricant: OilInUse | None = quantity("oil used", text="of the gears, as it enters the contact; null with none")
    temperatures: DerivedTemperatures = quantity("temperatures used")
    standard: StandardGrade = quantity("checks by the standard, as used")
    cooling: CoolingInForce | None = quantity("cooling used", default=None, text="null without a heat balance")
    total_face_width: float | None = quantity(
        "total face width used",
        "2b + e",
        unit="mm",
        text="both helices and the gap; left out without two helices",
        default=None,
        left_out=True,
    )
    tolerances: FlankTolerances | None = quantity(
        "tolerances of the quality class", text="left out without a quality class", default=None, left_out=True
    )
    micropitting: FilmGrade | None = quantity(
        "check against micropitting, as used", text="left out without one", default=None, left_out=True
    )


def derived(inputs: DriveTrainInputs, mesh: LoadDistribution, bulk: BulkInForce, heat: Heat | None = None) -> Derived:
    """Collect the values that the calculation used for inputs that were left open.

    `heat`: heat balance of the unit, if the inputs request a heat balance.
    """
    ratio = inputs.mesh.distribution.gears.pinion.teeth / inputs.mesh.distribution.gears.wheel.teeth
    lengths, lubricant = mesh.derived, inputs.mesh.lubricant
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
            DerivedCoupling(
                coupling.coupling,
                coupling.lubricant.viscosity,
                coupling.lubricant.viscosity_index,
                coupling.axial_tooth_stiffness or coupling.coupling.tooth_stiffness,
            )
            for coupling in inputs.couplings
        ),
        thermal=DerivedHeat(*inputs.heat.responses(ratio), *inputs.heat.teeth),
        lubricant=None if lubricant is None else OilInUse(**oil_in_use(lubricant)),
        temperatures=DerivedTemperatures(
            bulk,
            inputs.mesh.temperatures.bulk,
            inputs.mesh.temperatures.scuffing,
            inputs.mesh.temperatures.lubricant_factor,
        ),
        standard=standard_grade(inputs.mesh),
        cooling=None if heat is None else cooling_in_force(inputs.mesh.cooling, heat),
        total_face_width=lengths.total_face_width,
        tolerances=lengths.tolerances,
        micropitting=film_grade(inputs.mesh),
    )


def _shaft(inputs: DriveTrainInputs, shaft: Shaft, name: ShaftName) -> DerivedShaft:
    position = shaft.torque_position
    if position is None:
        position = next(coupling.position for coupling in inputs.couplings if coupling.shaft == name)
    return DerivedShaft(
        position,
        tuple(DerivedSection(section.outer_diameter) for section in shaft.sections),
        tuple(
            DerivedBearing(bearing.clearance, bearing.viscosity)
            if isinstance(bearing, JournalBearing)
            else DerivedBearing(None, None)
            for bearing in shaft.bearings
        ),
    )
