"""Gear units whose temperatures follow from a heat balance."""

from dataclasses import replace

from hypothesis import strategies as st

from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft
from solvers.heat_balance import Cooling
from solvers.heat_balance.inputs import Casing
from solvers.pumping.inputs import PumpingModel
from tests.support.random_units import units


def in_gear_oil(shaft: Shaft) -> Shaft:
    """Return the shaft with its plain bearings in the oil of the gears."""
    return replace(
        shaft,
        bearings=tuple(
            replace(bearing, in_gear_oil=True) if isinstance(bearing, JournalBearing) else bearing
            for bearing in shaft.bearings
        ),
    )


def balanced(inputs: DriveTrainInputs, cooling: Cooling = Cooling()) -> DriveTrainInputs:  # noqa: B008  frozen
    temperatures = replace(inputs.mesh.temperatures, bulk=None, bulk_method="heat_balance")
    return replace(
        inputs,
        mesh=replace(inputs.mesh, temperatures=temperatures, cooling=cooling),
        pinion_shaft=in_gear_oil(inputs.pinion_shaft),
        wheel_shaft=in_gear_oil(inputs.wheel_shaft),
        bulk_given=False,
    )


@st.composite
def cooled_units(draw: st.DrawFn) -> DriveTrainInputs:
    """Draw units whose pumping uses their own gears, and whose temperatures follow from a heat balance."""
    inputs = draw(units())
    gears = replace(inputs.mesh.distribution.gears, rack_tip_radius=0.25)
    pumping = replace(inputs.pumping, gears=gears, model=PumpingModel(slices=10))
    casing = Casing(area=draw(st.sampled_from([None, 5.0])))
    cooling = Cooling(
        gear_flow=draw(st.one_of(st.none(), st.floats(40 / 6e4, 400 / 6e4))),
        jets=draw(st.sampled_from(["into_mesh", "out_of_mesh"])),
        wetting_share=draw(st.one_of(st.none(), st.floats(0.1, 1.0))),
        casing=casing,
    )
    return balanced(replace(inputs, pumping=pumping), cooling)
