"""Friction between the teeth of a gear coupling."""

from typing import Annotated

from pydantic import Field

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Section
from app.requests.coupling_design import PAHL
from solvers.coupling import inputs as si

FIG_9 = "Pahl 1978, Fig. 9"
FIG_10 = "Pahl 1978, Fig. 10"

_CURVE = si.MixedFrictionCurve()


class MixedFrictionTable(Section):
    """Measured mixed friction against sliding velocity, held constant outside; a single point is a constant."""

    sliding_velocity_m_per_s: Annotated[
        list[float],
        Field(min_length=1, max_length=1000),
        Input(
            "table of sliding velocities",
            "v_G",
            text="sliding velocities, rising",
            ge=0,
            le=1000,
            tolerance=0.01,
            relative_tolerance=0.01,
        ),
    ]
    coefficient: Annotated[
        list[float],
        Field(min_length=1, max_length=1000),
        Input("table of friction coefficients", "μ", text="friction coefficients", ge=1e-4, le=2),
    ]


class MixedFrictionCurve(Section):
    """Our law of mixed friction: it falls to its lowest value at one sliding velocity and rises again beyond."""

    highest: Annotated[
        float,
        Input(
            "highest mixed friction",
            "μ_max",
            FIG_9,
            text="coefficient at rest, and the most at high velocity",
            ge=1e-4,
            le=2,
        ),
    ] = _CURVE.highest
    lowest: Annotated[
        float, Input("lowest mixed friction", "μ_min", FIG_9, text="least coefficient", ge=1e-4, le=2)
    ] = _CURVE.lowest
    velocity_m_per_s: Annotated[
        float,
        Input(
            "velocity of least friction",
            "v_G,min",
            FIG_10,
            text="largest sliding velocity at which the coefficient is least",
            ge=1e-4,
            le=1000,
            assumed="a calibration: it puts the friction minimum of the paper's heavily crowned coupling at 0.4° and "
            "200 1/s; the points of Fig. 10 and the speed of Fig. 11 are not in the text",
        ),
    ] = _CURVE.velocity


class CouplingFriction(Section):
    """Friction between the teeth."""

    coefficient: Annotated[
        float | None,
        Input(
            "coefficient of friction",
            "μ",
            FIG_9,
            ge=0,
            le=2,
            tolerance=0.02,
            default_text="the law of the friction regime",
            assumed="no coefficient given: the law of the friction regime, ours inside the paper's bands",
        ),
    ] = None
    static_coefficient: Annotated[
        float | None,
        Input(
            "coefficient of friction at rest",
            "μ_s",
            PAHL,
            ge=0,
            le=2,
            tolerance=0.02,
            default_text="the coefficient given, else that of the law at rest without film",
            assumed="0.16, the law of the friction regime at rest without film",
        ),
    ] = None
    mixed_law: Annotated[
        MixedFrictionTable | None,
        Input(
            "table of mixed friction",
            None,
            FIG_10,
            text="table that replaces the mixed-lubrication branch of the law, `mixed_curve`",
        ),
    ] = None
    mixed_curve: Annotated[
        MixedFrictionCurve, Input("curve of mixed friction", None, FIG_10, text="mixed-lubrication branch of the law")
    ] = MixedFrictionCurve()

    def friction(self) -> si.Friction:
        """The solver's friction."""
        law: si.MixedFrictionCurve | si.MixedFrictionTable = (
            si.MixedFrictionCurve(**to_si(self.mixed_curve))
            if self.mixed_law is None
            else si.MixedFrictionTable(**to_si(self.mixed_law))
        )
        return si.Friction(**to_si(self), mixed_law=law)

    def unused_friction_defaults(self, section: str) -> frozenset[str]:
        """A coefficient or a table leaves the curve out, a coefficient also what holds at rest."""
        unused = set()
        if self.coefficient is not None or self.mixed_law is not None:
            unused.add(f"{section}.mixed_curve")
        if self.coefficient is not None:
            unused.add(f"{section}.static_coefficient")
        return frozenset(unused)
