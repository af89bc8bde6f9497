"""Gear couplings on the shafts of a gear unit: sections of /v1/drive-train."""

from typing import Annotated, Literal

from pydantic import Field

from app.requests.coupling_lubricant import CouplingLubricant
from app.requests.drive_train_shafts import Pair
from app.schema.base import Section
from app.schema.conversion import to_si
from app.schema.coupling import CouplingFriction, CrownedCoupling
from app.schema.quantities import Input
from solvers.coupling import inputs as coupling
from solvers.drive_train import inputs as si

_ALIGNMENT = si.Alignment()


class ShaftAlignment(Section):
    """How both machines grow as they warm up; with it the hub's offset is the cold one."""

    unit_height_mm: Annotated[
        float | None,
        Input(
            "height of the unit's shaft",
            "h_U",
            text="over its feet",
            ge=0,
            le=20000,
            tolerance=1,
            default_text="no growth",
        ),
    ] = None
    unit_rise_k: Annotated[
        float | None,
        Input(
            "temperature rise of the unit's supports",
            "ΔT_U",
            ge=-100,
            le=300,
            default_text="no growth",
            tolerance=5,
        ),
    ] = None
    machine_height_mm: Annotated[
        float | None,
        Input(
            "height of the machine's shaft",
            "h_M",
            text="over its feet",
            ge=0,
            le=20000,
            tolerance=1,
            default_text="no growth",
        ),
    ] = None
    machine_rise_k: Annotated[
        float | None,
        Input(
            "temperature rise of the machine's supports",
            "ΔT_M",
            ge=-100,
            le=300,
            default_text="no growth",
            tolerance=5,
        ),
    ] = None
    expansion_per_k: Annotated[
        float,
        Input("thermal expansion of the supports", "α_S", text="of cast iron and steel", ge=0, le=1e-4, tolerance=1e-6),
    ] = _ALIGNMENT.expansion

    def alignment(self) -> si.Alignment:
        """The solver's alignment; a height or rise that is not given lets nothing grow."""
        return si.Alignment(**{name: 0.0 if value is None else value for name, value in to_si(self).items()})


class UnitCoupling(Section):
    """A gear coupling between a shaft of the unit and a machine."""

    shaft: Annotated[si.ShaftName, Input("shaft of the coupling", text="which of the unit's shafts it sits on")]
    position_mm: Annotated[
        float, Input("hub position", "z_H", text="tooth plane of the unit's hub", ge=-20000, le=20000, tolerance=0.1)
    ]
    machine_side: Annotated[
        Literal["minus", "plus"], Input("side of the machine", text="to which side along Z the machine lies")
    ]
    coupling: Annotated[CrownedCoupling, Input("coupling")]
    lubricant: Annotated[CouplingLubricant, Input("oil at the coupling's teeth")] = CouplingLubricant()
    friction: Annotated[CouplingFriction, Input("friction between the coupling's teeth")] = CouplingFriction()
    axial_tooth_stiffness_n_per_um: Annotated[
        float | None,
        Input(
            "axial tooth stiffness",
            "c_a",
            text="of one tooth, that lets it yield before it slides",
            ge=0.1,
            le=1e5,
            default_text="the tooth pair stiffness",
            assumed="as stiff as tangentially",
        ),
    ] = None
    offset_um: Annotated[
        Pair,
        Input(
            "offset of the machine's hub",
            "e_M",
            text="[X, Y] against the unit's datum axis; running, or cold where an alignment is given",
            ge=-5000,
            le=5000,
            tolerance=100,
        ),
    ] = Field(default_factory=lambda: [0.0, 0.0])
    slope_mrad: Annotated[
        Pair,
        Input(
            "slope of the machine's axis",
            "φ_M",
            text="[dX/dZ, dY/dZ] against the unit's datum axis",
            ge=-20,
            le=20,
            tolerance=0.2,
        ),
    ] = Field(default_factory=lambda: [0.0, 0.0])
    thrust_fraction: Annotated[
        float,
        Input(
            "share of the friction that acts axially",
            "τ",
            text="share of the friction limit that acts along the shaft, towards +Z if positive",
            ge=-1,
            le=1,
            tolerance=0.1,
            assumed="none: all friction resists the tilting, which bends the shaft most",
        ),
    ] = 0.0
    alignment: Annotated[
        ShaftAlignment | None, Input("alignment", text="heights and temperature rises of both machines")
    ] = None

    def unit_coupling(self) -> si.UnitCoupling:
        """The solver's coupling."""
        return si.UnitCoupling(
            coupling=self.coupling.si(coupling.CouplingDesign).coupling(),
            lubricant=self.lubricant.lubricant(),
            friction=self.friction.si(coupling.Friction),
            alignment=None if self.alignment is None else self.alignment.alignment(),
            **to_si(self),
        )

    def unused_coupling_defaults(self, section: str) -> frozenset[str]:
        """What friction leaves out; a shaft that turns never rests."""
        unused = {f"{section}.friction.static_coefficient"}
        unused |= self.friction.unused_friction_defaults(f"{section}.friction")
        unused |= self.lubricant.unused_defaults(f"{section}.lubricant")
        if self.friction.coefficient is not None:
            unused.add(f"{section}.lubricant")
        return frozenset(unused)
