"""A gear coupling's own data: teeth, planes and stiffness."""

from typing import Annotated

from pydantic import Field

from app.contract.quantities import Input
from app.requests.common import Section

PAHL = "Pahl 1978"
FIG_8 = "Pahl 1978, Fig. 8"
FIG_13 = "Pahl 1978, Fig. 13"


class CouplingDesign(Section):
    """The coupling without its crowning."""

    teeth: Annotated[int, Input("number of teeth", "z", PAHL, ge=6, le=400)]
    module_mm: Annotated[float, Input("module", "m", PAHL, ge=0.1, le=100)]
    pressure_angle_deg: Annotated[
        float, Input("pressure angle", "α", ge=1, lt=45, assumed="the usual rack; the paper gives none")
    ] = 20.0
    face_width_mm: Annotated[
        float | None,
        Input(
            "hub tooth face width",
            "b",
            ge=0.1,
            le=2000,
            default_text="8 modules",
            assumed="8 modules; the paper gives none",
            tolerance=0.1,
        ),
    ] = None
    tooth_height_mm: Annotated[
        float | None,
        Input(
            "load-carrying tooth height",
            "h_trag",
            FIG_8,
            text="load-carrying tooth height, the length of the contact line",
            ge=0.05,
            le=200,
            default_text="2 modules",
            assumed="2 modules; the paper gives none",
            tolerance=0.05,
        ),
    ] = None
    hub_distance_mm: Annotated[
        float,
        Input(
            "distance of the tooth planes",
            "l_H",
            FIG_13,
            text="distance of the two tooth planes",
            ge=1,
            le=20000,
            assumed="order of magnitude",
            tolerance=0.5,
        ),
    ] = 200.0
    tooth_stiffness_n_per_um: Annotated[
        float,
        Input(
            "tooth pair stiffness",
            "c_t",
            text="tangential stiffness of one tooth pair",
            ge=0.1,
            le=1e5,
            assumed="order of magnitude of ISO 6336-1: 14 N/(mm µm) over 20 mm of effective width",
        ),
    ] = 280.0
    sleeve_mass_kg: Annotated[
        float,
        Input(
            "sleeve mass per mesh",
            "m_s",
            text="mass carried by one mesh, half the sleeve",
            ge=1e-3,
            le=1e4,
            assumed="order of magnitude",
        ),
    ] = 4.0
    pitch_errors_um: Annotated[
        list[float] | None,
        Field(min_length=1, max_length=1000),
        Input(
            "pitch errors",
            "p_i",
            "Pahl 1978, Fig. 4",
            text="pitch errors, one per tooth, positive = early, carries more",
            ge=-1e4,
            le=1e4,
            tolerance=1,
            default_text="none",
        ),
    ] = None
    youngs_modulus_gpa: Annotated[float, Input("Young's modulus of the teeth", "E", ge=1, le=2000, assumed="steel")] = (
        206.0
    )
    poisson_ratio: Annotated[
        float, Input("Poisson's ratio of the teeth", "ν", ge=0, lt=0.5, tolerance=0.01, assumed="steel")
    ] = 0.3


class CrownedCoupling(CouplingDesign):
    """The coupling."""

    crowning_ratio: Annotated[
        float,
        Input("crowning ratio", "ε", PAHL, text="crowning radius over pitch radius, 1: heavy", ge=0.2, le=1e3),
    ] = 1.0
