"""Flank modification and misalignment of a gear pair."""

from dataclasses import replace
from typing import Annotated

from app.schema.base import Section
from app.schema.quantities import Input
from solvers.scuffing import inputs as si
from solvers.sources import XUE

DEVIATIONS = "ISO/TR 10064-3"
NO_LENGTHS = "the paper gives no relief lengths"

_DEFAULTS = si.Modifications()
_PROFILE_RELIEF_LENGTH = Input(
    "relief length",
    text="length along the line of action",
    ge=1e-3,
    le=1000,
    default_text="to the single contact, a tenth to half of the path",
    assumed=NO_LENGTHS,
)


class FlankModifications(Section):
    """Gaps along the transverse line of action, positive where material is missing."""

    profile_crowning_um: Annotated[float, Input("profile crowning", "C_α", XUE, ge=-1000, le=1000, tolerance=2)] = (
        _DEFAULTS.profile_crowning
    )
    lead_crowning_um: Annotated[float, Input("helix crowning", "C_β", XUE, ge=-1000, le=1000, tolerance=3)] = (
        _DEFAULTS.lead_crowning
    )
    profile_slope_um: Annotated[
        float,
        Input(
            "profile slope",
            "f_Hα",
            XUE,
            text="pressure-angle slope; positive opens the gap towards the pinion tip",
            ge=-1000,
            le=1000,
            tolerance=5,
        ),
    ] = _DEFAULTS.profile_slope
    helix_slope_um: Annotated[
        float,
        Input(
            "helix slope",
            "f_Hβ",
            XUE,
            text="helix slope and misalignment; positive opens the gap towards the end that leaves the mesh last",
            ge=-1000,
            le=1000,
            tolerance=8,
        ),
    ] = _DEFAULTS.helix_slope
    in_plane_deviation_um: Annotated[
        float,
        Input(
            "in-plane shaft deviation",
            "f_Σδ",
            DEVIATIONS,
            text="shaft deviation in their plane over the face; adds to the helix slope",
            ge=-1000,
            le=1000,
            tolerance=10,
        ),
    ] = _DEFAULTS.in_plane_deviation
    out_of_plane_deviation_um: Annotated[
        float,
        Input(
            "out-of-plane shaft deviation",
            "f_Σβ",
            DEVIATIONS,
            text="shaft deviation out of their plane over the face; adds to the helix slope",
            ge=-1000,
            le=1000,
            tolerance=10,
        ),
    ] = _DEFAULTS.out_of_plane_deviation
    tip_relief_um: Annotated[
        float,
        Input("tip relief", "C_a", XUE, text="relief at E: pinion tip plus wheel root", ge=0, le=1000, tolerance=3),
    ] = _DEFAULTS.tip_relief
    tip_relief_length_mm: Annotated[
        float | None,
        replace(_PROFILE_RELIEF_LENGTH, title="tip relief length", symbol="L_Ca"),
    ] = _DEFAULTS.tip_relief_length
    root_relief_um: Annotated[
        float,
        Input("root relief", "C_f", XUE, text="relief at A: pinion root plus wheel tip", ge=0, le=1000, tolerance=3),
    ] = _DEFAULTS.root_relief
    root_relief_length_mm: Annotated[
        float | None,
        replace(_PROFILE_RELIEF_LENGTH, title="root relief length", symbol="L_Cf"),
    ] = _DEFAULTS.root_relief_length
    end_relief_um: Annotated[
        float, Input("end relief", "C_e", XUE, text="relief at both ends of the face", ge=0, le=1000, tolerance=3)
    ] = _DEFAULTS.end_relief
    end_relief_length_mm: Annotated[
        float | None,
        Input(
            "end relief length",
            "L_Ce",
            text="length along the face",
            ge=1e-3,
            le=5000,
            default_text="a tenth of the face",
            assumed=NO_LENGTHS,
        ),
    ] = _DEFAULTS.end_relief_length
    relief_exponent: Annotated[
        float,
        Input(
            "relief exponent",
            "p",
            text="1: linear reliefs, 2: parabolic",
            ge=0.5,
            le=10,
            assumed="linear; the paper does not say",
        ),
    ] = _DEFAULTS.relief_exponent

    def unused_defaults(self, section: str) -> frozenset[str]:
        """Lengths and exponent of reliefs that are zero."""
        amplitudes = {relief: getattr(self, f"{relief}_um") for relief in ("tip_relief", "root_relief", "end_relief")}
        unused = {f"{section}.{relief}_length_mm" for relief, value in amplitudes.items() if value == 0.0}
        return frozenset(unused if any(amplitudes.values()) else {*unused, f"{section}.relief_exponent"})
