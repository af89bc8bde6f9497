"""Scuffing of a gear pair: request of /v1/scuffing."""

from typing import Annotated, Any, Self

from pydantic import model_validator

from app.requests.load_distribution import GearPairRequest
from app.requests.oil import Oil
from app.requests.practice import (
    PRACTICAL_FRICTION,
    assumed_in_practice,
    check_friction,
    friction_said,
    lubricant_factor_asked,
)
from app.requests.scuffing_options import ScuffingModel, ScuffingTemperatures
from app.schema.quantities import Input
from solvers.scuffing import inputs as si


class ScuffingRequest(GearPairRequest):
    """A loaded gear pair, its oil and temperatures."""

    friction_coefficient: Annotated[float | None, PRACTICAL_FRICTION] = None
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[ScuffingTemperatures, Input("temperatures", text="temperatures of teeth and oil")] = (
        ScuffingTemperatures()
    )
    model: Annotated[ScuffingModel, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        ScuffingModel()
    )

    @model_validator(mode="before")
    @classmethod
    def friction_given(cls, given: Any) -> Any:
        """A coefficient of friction says by itself that it is given."""
        return friction_said(given)

    @model_validator(mode="after")
    def known_friction(self) -> Self:
        """A coefficient of friction that is given is a number."""
        check_friction(self.friction_coefficient, self.model)
        return self

    def inputs(self) -> si.ScuffingInputs:
        """The solver's inputs."""
        return si.ScuffingInputs(
            distribution=self.distribution(self.friction_coefficient, self.model),
            lubricant=None,
            oil=self.lubricant.oil(),
            temperatures=self.temperatures.contact_temperatures(),
            lubrication=self.model.lubrication,
            friction=self.model.friction,
            film=self.model.film(),
            path_points=self.model.path_points,
        )

    def options(self) -> dict[str, Any]:
        """The model section."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """Of reliefs that are zero, of the film's model in closed form, of oil and bulk; roughness counts here."""
        factor = lubricant_factor_asked(self.lubricant, self.temperatures, self.model)
        unused = self.modifications.unused_defaults("modifications")
        unused |= self.lubricant.unused_defaults("lubricant", factor=factor)
        unused |= self.temperatures.unused_temperature_defaults("temperatures", oil=self.lubricant.known)
        if self.model.lubrication == "closed_form" or not self.lubricant.known:
            return unused | {"model.rheology", "model.eyring_stress_mpa"}
        return unused | self.model.unused_film_defaults("model")

    def assumed_by_the_model(self) -> dict[str, str]:
        """What friction, oil and bulk temperature take for granted."""
        return assumed_in_practice(self.friction_coefficient, self.lubricant, self.temperatures, self.model)
