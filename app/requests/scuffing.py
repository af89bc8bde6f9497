"""Scuffing of a gear pair: request of /v1/scuffing."""

from typing import Annotated

from app.contract.conversion import to_si
from app.contract.quantities import Input
from app.requests.common import Section
from app.requests.line_contact import FilmModel
from app.requests.load_distribution import LoadDistributionModel, LoadDistributionRequest
from app.requests.materials import XUE, Oil
from solvers.scuffing import inputs as si


class ScuffingTemperatures(Section):
    """Temperatures of teeth and oil."""

    bulk_c: Annotated[
        float,
        Input(
            "bulk temperature",
            "θ_M",
            f"{XUE}, Eq. 16",
            text="bulk temperature of the teeth, at which the oil enters",
            ge=-70,
            le=500,
            tolerance=5,
        ),
    ] = 86.85
    oil_c: Annotated[float, Input("oil temperature", "θ_oil", f"{XUE}, Eq. 26", ge=-70, le=500, tolerance=5)] = 60.0
    scuffing_c: Annotated[
        float | None,
        Input(
            "scuffing temperature",
            "θ_S",
            f"{XUE}, Eq. 26",
            text="scuffing temperature of oil and material",
            ge=-70,
            le=1500,
            default_text="no safety factor",
            tolerance=20,
        ),
    ] = None


class ScuffingModel(LoadDistributionModel, FilmModel):
    """Choices where the paper leaves room, and physics and resolution of the film."""

    lubrication: Annotated[
        si.Lubrication,
        Input(
            "lubrication model",
            None,
            XUE,
            text="film and flash temperature by the thermal EHL solution, or by formulas alone",
            advanced=True,
        ),
    ] = "thermal_ehl"
    path_points: Annotated[
        int,
        Input(
            "points of the scuffing check",
            None,
            XUE,
            text="points of the check along the feature line",
            ge=2,
            le=500,
            advanced=True,
        ),
    ] = 50


class ScuffingRequest(LoadDistributionRequest):
    """A loaded gear pair, its oil and temperatures."""

    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[ScuffingTemperatures, Input("temperatures", text="temperatures of teeth and oil")] = (
        ScuffingTemperatures()
    )
    model: Annotated[ScuffingModel, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        ScuffingModel()
    )

    def inputs(self) -> si.ScuffingInputs:
        """The solver's inputs."""
        return si.ScuffingInputs(
            distribution=self.distribution(),
            lubricant=self.lubricant.lubricant(),
            temperatures=si.Temperatures(**to_si(self.temperatures)),
            lubrication=self.model.lubrication,
            film=self.model.film(),
            path_points=self.model.path_points,
        )

    def unused_defaults(self) -> frozenset[str]:
        """Of reliefs that are zero, and of the film's model in closed form; roughness counts here."""
        unused = self.modifications.unused_defaults("modifications")
        if self.model.lubrication == "closed_form":
            return unused | {"model.rheology", "model.eyring_stress_mpa"}
        return unused | self.model.unused_film_defaults("model")
