"""Temperatures of a gear unit: sections of /v1/drive-train."""

from typing import Annotated

from app.requests.scuffing_options import ContactTemperatures
from app.schema.base import Section
from app.schema.quantities import Input
from solvers.drive_train import inputs as si
from solvers.sources import XUE

_HEAT = si.Heat()
BULK = "usual of high-speed gears; measure it"


class ToothHeat(Section):
    """How warm the teeth are, and how much of the pumped gas's heat they take."""

    wall_response: Annotated[
        float | None,
        Input(
            "wall response",
            "κ_1",
            text="rise of the pinion's metal over the rise of the pumped gas",
            ge=0,
            le=1.5,
            default_text=f"{si.ASSUMED_RESPONSE}",
            assumed="nothing but a measurement tells it; known values lie between 0.2 and 1",
            tolerance=0.1,
        ),
    ] = None
    wall_response_wheel: Annotated[
        float | None,
        Input(
            "wall response of the wheel",
            "κ_2",
            ge=0,
            le=1.5,
            tolerance=0.1,
            default_text="the pinion's times z1/z2",
            assumed="a wheel tooth meets the hot gas once a turn of the wheel",
        ),
    ] = None
    pinion_bulk_c: Annotated[
        float,
        Input(
            "tooth temperature of the pinion",
            "θ_M1",
            text="without the heat of pumping",
            ge=-70,
            le=500,
            assumed=BULK,
            tolerance=5,
        ),
    ] = 90.0
    wheel_bulk_c: Annotated[
        float,
        Input(
            "tooth temperature of the wheel",
            "θ_M2",
            text="without the heat of pumping",
            ge=-70,
            le=500,
            assumed=BULK,
            tolerance=5,
        ),
    ] = 80.0
    reference_c: Annotated[
        float,
        Input("temperature of the drawing", "θ_0", text="at which flanks are as drawn", ge=-70, le=200, tolerance=5),
    ] = 20.0
    bulk_includes_pumping: Annotated[
        bool,
        Input(
            "tooth temperatures with pumping",
            text="whether tooth temperatures hold the pumping heat; only its variation along the face is added then",
        ),
    ] = _HEAT.bulk_includes_pumping


class TrainTemperatures(ContactTemperatures):
    """Temperatures of contact and oil."""

    bulk_c: Annotated[
        float | None,
        Input(
            "bulk temperature",
            "θ_M",
            f"{XUE}, Eq. 16",
            text="bulk temperature of the contact, at which the oil enters",
            ge=-70,
            le=500,
            default_text="the mean of the tooth temperatures where one of them is given, else estimated",
            assumed="the mean of the two tooth temperatures",
            tolerance=5,
        ),
    ] = None
    local_bulk: Annotated[
        bool, Input("local bulk temperature", text="whether the contact's bulk is warmer where more heat is pumped")
    ] = False
