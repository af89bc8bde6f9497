"""Inputs of a lubricated line contact, in SI units."""

from dataclasses import field
from typing import Literal

from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.quantity import quantity, record
from solvers.sources import XUE

Rheology = Literal["ree_eyring", "newtonian"]


@record
class Contact:
    """Two cylinders that roll and slide on an oil film.

    The oil enters with the mean speed of the surfaces.
    """

    line_load: float = quantity("line load", "w", XUE, unit="n_per_mm", gt=0, le=1e5, text="load per length of contact")
    radius: float = quantity(
        "radius of relative curvature",
        "R",
        XUE,
        unit="mm",
        ge=0.01,
        le=1e4,
        text="reduced radius of curvature, 1/R = 1/R_1 + 1/R_2",
    )
    speed_1: float = quantity(
        "speed of surface 1",
        "u_1",
        f"{XUE}, Eq. 18",
        unit="m_per_s",
        ge=-300,
        le=300,
        tolerance=0.01,
        text="through the contact, positive into it",
        relative_tolerance=0.01,
    )
    speed_2: float = quantity(
        "speed of surface 2",
        "u_2",
        f"{XUE}, Eq. 18",
        unit="m_per_s",
        ge=-300,
        le=300,
        tolerance=0.01,
        text="through the contact, positive into it",
        relative_tolerance=0.01,
    )

    @property
    def entrainment_speed(self) -> float:
        """Mean surface speed [m/s]."""
        return 0.5 * (self.speed_1 + self.speed_2)

    @property
    def slide_roll_ratio(self) -> float:
        """Slide-roll ratio (u1 - u2)/um [-]."""
        return (self.speed_1 - self.speed_2) / self.entrainment_speed


@record
class Temperatures:
    """Bulk temperatures of the two surfaces and temperature of the oil at the inlet [K]."""

    surface_1: float = quantity(
        "bulk temperature of surface 1",
        "θ_M1",
        XUE,
        unit="c",
        default=86.85,
        ge=-50,
        le=400,
        tolerance=5,
        assumed="360 K, the paper's bulk temperature",
    )
    surface_2: float = quantity(
        "bulk temperature of surface 2",
        "θ_M2",
        XUE,
        unit="c",
        default=86.85,
        ge=-50,
        le=400,
        tolerance=5,
        assumed="360 K, the paper's bulk temperature",
    )
    inlet: float = quantity(
        "inlet temperature",
        "θ_in",
        XUE,
        unit="c",
        default=86.85,
        ge=-50,
        le=400,
        tolerance=5,
        text="temperature of the oil at the inlet",
        assumed="360 K, the paper's bulk temperature",
    )


@record
class Model:
    """Physics and resolution of the film.

    `refine_mesh` adds nodes until the estimated error due to the mesh is below 2 %. This estimate leaves out errors due
    to pressure spikes, because no mesh resolves the spikes. The film of the paper is Newtonian. Near pure rolling the
    friction of a Newtonian film is not physical, so Ree-Eyring is the default.
    """

    thermal: bool = quantity("thermal film", None, XUE, default=True, text="whether the film heats up", advanced=True)
    rheology: Rheology = quantity(
        "rheology",
        None,
        XUE,
        default="ree_eyring",
        text="how shear stress depends on shear rate",
        assumed="gear oils thin under shear; the paper's Newtonian film has unphysical friction near pure rolling",
        advanced=True,
    )
    eyring_stress: float = quantity(
        "Eyring stress",
        "τ_0",
        unit="mpa",
        default=5.0,
        ge=1,
        le=50,
        assumed="middle of the usual 3 to 12 MPa of gear oils",
        advanced=True,
    )
    nodes: int = quantity("nodes along the contact", "N", default=121, ge=61, le=481, advanced=True)
    refine_mesh: bool = quantity(
        "refine the mesh",
        kw_only=True,
        default=True,
        text="add nodes, up to 481, until the estimated error of the mesh is below 2 %",
        advanced=True,
    )
    film_nodes: int = quantity("nodes across the film", "N_z", default=21, ge=7, le=61, advanced=True)


@record
class LineContactInputs:
    """Inputs of one line contact; the oil has no default."""

    contact: Contact
    surface_1: Solid = field(default_factory=Solid)
    surface_2: Solid = field(default_factory=Solid)
    lubricant: Lubricant = field(kw_only=True)
    temperatures: Temperatures = field(default_factory=Temperatures)
    model: Model = field(default_factory=Model)
