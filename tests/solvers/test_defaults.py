"""The solvers assume no oil; the friction and the bulk temperature follow from an oil that is given."""

from dataclasses import replace
from math import radians

import pytest

from solvers import scuffing
from solvers.contact.ehl import Contact, LineContactInputs
from solvers.oils import iso_vg
from tests.support.outcomes import refused

PAIR = scuffing.GearPairInputs(
    scuffing.GearTeeth(25), scuffing.GearTeeth(76), 4e-3, 60e-3, helix_angle=radians(10.0), rack_tip_radius=0.38
)
LOADED = scuffing.LoadDistributionInputs(PAIR, scuffing.Load(900.0, 157.0))


def check(**known: object) -> scuffing.Scuffing:
    return scuffing.solve_scuffing(scuffing.ScuffingInputs(LOADED, lubrication="closed_form", **known))


def test_no_oil_is_assumed() -> None:
    result = check()
    assert (result.safety, result.film, result.contact_temperature) == (None, None, None)
    assert result.flash.blok_max is None, "no oil, no friction"
    assert "no_oil" in {warning.code for warning in result.warnings}
    with pytest.raises(TypeError):
        LineContactInputs(Contact(2.7e5, 4e-3, 1.0, 3.7))  # type: ignore[call-arg]


def test_without_friction_no_flash_temperature_is_stated_where_a_line_is_partly_without_contact() -> None:
    """The largest flash temperature is None, not 0, if the coefficient of friction is unknown."""
    # Points out of contact then have a flash temperature of 0, and points in contact have none.
    crowned = replace(LOADED, modifications=scuffing.Modifications(lead_crowning=500e-6))
    result = scuffing.solve_scuffing(scuffing.ScuffingInputs(crowned))
    assert {"unloaded", "ok"} <= set(result.path.status)
    assert result.flash.blok_max is None
    assert result.flash.feature_line_max is None


def test_friction_and_bulk_temperature_follow_from_the_oil() -> None:
    result = check(oil=iso_vg(220))
    assert result.flash.friction_coefficient != LOADED.friction_coefficient
    assert result.contact_temperature
    assert result.contact_temperature.bulk > scuffing.Temperatures().oil


def test_a_bulk_temperature_is_not_given_and_estimated() -> None:
    oil, both = iso_vg(220), scuffing.Temperatures(bulk=353.15, bulk_method="estimated")
    assert refused(lambda: check(oil=oil, temperatures=both))[0] == "exclusive"
    given = check(oil=oil, temperatures=scuffing.Temperatures(bulk=353.15, bulk_method="given"))
    assert given.contact_temperature
    assert given.contact_temperature.bulk == 353.15
