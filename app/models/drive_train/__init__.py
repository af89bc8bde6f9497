"""Complete gear units: couplings, shafts in bearings, heat and the mesh, and their warm-up."""

from typing import Any

from app.models.card import Calculation, Card, Cost, Pump
from app.models.drive_train import figures, request, warm_up_figures, words
from app.models.kernels import DRIVE_TRAIN, THERMAL, Kernels
from app.models.scuffing import PUMP_FIELDS, thermal_path
from solvers import drive_train


def _unit_states(request: Any) -> Cost:
    """Estimate the time to solve the contacts of a gear unit in all requested states."""
    path = thermal_path(request)
    return Cost(len({*request.states}) * path.seconds, path.field)


CARD = Card(
    "drive-train",
    (
        Calculation(
            path="/v1/drive-train",
            title="Drive train",
            summary="A complete gear unit: couplings, shafts in bearings, pumped heat, load along the face and "
            "scuffing",
            source="own derivation on Pahl 1978, Milian 2004 and Xue 2020",
            request=request.DriveTrainRequest,
            solve=drive_train.solve,
            response=words.DRIVE_TRAIN,
            kernels=Kernels(DRIVE_TRAIN, THERMAL),
            figures=figures.FIGURES,
            cost=_unit_states,
            pump=Pump(*PUMP_FIELDS, drive_train.sized_flow),
            words=words.WORDS,
        ),
        Calculation(
            path="/v1/drive-train/warm-up",
            title="Warm-up",
            summary="How a gear unit warms up: temperatures over time, backlash, load on the flanks and scuffing "
            "meanwhile",
            source="own derivation, heat balance",
            request=request.WarmUpRequest,
            solve=drive_train.solve_warm_up,
            response=words.WARM_UP,
            kernels=Kernels(DRIVE_TRAIN, THERMAL),
            figures=warm_up_figures.FIGURES,
            words=words.WARM_UP_WORDS,
        ),
    ),
    subject="pair",
    start_figure="face-load",
)
