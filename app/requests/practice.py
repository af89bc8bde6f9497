"""What scuffing takes from practice where a request leaves it out, for the gear pair alone and in its unit."""

from dataclasses import replace
from typing import Any

from pydantic_core import PydanticCustomError

from app.requests.load_distribution import FRICTION_COEFFICIENT
from app.requests.oil import Oil
from app.requests.scuffing_options import ContactTemperatures, ScuffingModel

PRACTICAL_FRICTION = replace(FRICTION_COEFFICIENT, assumed=None, default_text="by `model.friction`, from the oil")
LAW = "the mean coefficient of ISO/TR 13989-1, with the computed K_Hβ; K_Hα is taken as 1"
NOT_USED = "not used: `model.friction` asks for the coefficient of ISO/TR 13989-1"
MINERAL_FACTOR = "the lubricant factor is that of a mineral oil; none is known for an ester"
GIVEN_BULK = (
    "a given bulk temperature does not follow the oil: with a hotter oil alone the stated safety rises, because it "
    "counts the temperatures above the oil's"
)
SMOOTH_FILM = (
    "flanks that touch nowhere: the friction of a full film falls as a hotter oil thins it, so the safety by thermal "
    "EHL may rise by percents with the oil temperature, while the film thins and the safety by Blok falls"
)


def with_default(given: Any, section: str, name: str, value: Any) -> Any:
    """What was sent, with a field of a section set where it is left out."""
    held = given.get(section, {})
    return given | {section: {name: value} | held} if isinstance(held, dict) else given


def friction_said(given: Any) -> Any:
    """A coefficient of friction says by itself that it is given."""
    if isinstance(given, dict) and given.get("friction_coefficient") is not None:
        return with_default(given, "model", "friction", "given")
    return given


def check_friction(coefficient: float | None, model: ScuffingModel) -> None:
    """A coefficient of friction that is given is a number."""
    if model.friction == "given" and coefficient is None:
        raise PydanticCustomError("missing_friction", "give friction_coefficient, or friction iso_tr_13989")


def lubricant_factor_asked(lubricant: Oil, temperatures: ContactTemperatures, model: ScuffingModel) -> bool:
    """Whether friction or scuffing temperature rest on the oil's lubricant factor."""
    test = temperatures.scuffing_test
    return lubricant.known and (
        model.friction == "iso_tr_13989" or (test is not None and test.lubricant_factor is None)
    )


def assumed_in_practice(
    coefficient: float | None, lubricant: Oil, temperatures: ContactTemperatures, model: ScuffingModel
) -> dict[str, str]:
    """What friction, oil and bulk temperature take for granted, by dotted names of the request."""
    found = {}
    if lubricant.known and model.friction == "iso_tr_13989":
        found["model.friction"] = LAW
        if coefficient is not None:
            found["friction_coefficient"] = NOT_USED
    if lubricant.kind == "ester" and lubricant_factor_asked(lubricant, temperatures, model):
        found["lubricant.kind"] = MINERAL_FACTOR
    if lubricant.known and temperatures.bulk_method == "given":
        found["temperatures.bulk_method"] = GIVEN_BULK
    if lubricant.known and model.lubrication == "thermal_ehl":
        found["model.lubrication"] = SMOOTH_FILM
    return found
