"""The tests check section IV of Xue, Zhang and Wang (GJRE-A 20(1), 2020) on Blok's flash temperature and the film.

The reference numbers come from an independent calculation with linear contact and transverse sections, as in the tests
of the load distribution.
"""

from dataclasses import replace
from functools import cache
from math import cos

import numpy as np
import pytest

from benchmarks.published.xue import PAPER_SPEED, paper_gears, paper_pair
from solvers.contact import hertz
from solvers.contact.ehl import Contact
from solvers.contact.film import dowson_higginson_minimum, thickness_ratio, thickness_regime
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import reduced_radius
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.scuffing.inputs import ScuffingInputs, Temperatures
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety import safety_factor, solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from tests.support.line_contacts import blok_flash
from tests.support.outcomes import codes, refused

HOT = Temperatures(scuffing=433.15, bulk=360.0, bulk_method="given")


@cache
def scuffing(pair: int, temperatures: Temperatures = HOT) -> Scuffing:
    return solve_scuffing(
        ScuffingInputs(
            paper_pair(pair),
            temperatures=temperatures,
            lubrication="closed_form",
            lubricant=Lubricant(),
            friction="given",
        )
    )


def contact_at(result: LoadDistribution, x: float, line_load: float) -> Contact:
    """Return the contact at the position x [m] along the path, under a line load [N/m]."""
    path = result.path_of_contact
    return Contact(line_load, float(reduced_radius(path.plane, x)), *path.surface_speeds(x, PAPER_SPEED))


def test_contact_at_the_start_of_mesh_of_pair_1() -> None:
    """Radius and speeds follow Xue Eqs. 13 and 18; flash temperature and film follow Xue Eqs. 25 and 27."""
    # Flash temperature and film (Figs. 22 and 23) are computed at the printed line load.
    contact, oil = contact_at(scuffing(1).distribution, 0.0, 273e3), Lubricant()
    assert contact.radius * 1e3 == pytest.approx(4.0666, abs=1e-4)
    assert (contact.speed_1, contact.speed_2) == pytest.approx((1.018, 3.708), abs=1e-3)
    assert blok_flash(contact, 0.06) == pytest.approx(85.7, abs=0.05)
    film = dowson_higginson_minimum(
        viscosity=oil.viscosity,
        pressure_viscosity=oil.pressure_viscosity,
        mean_speed=(contact.speed_1 + contact.speed_2) / 2,
        radius=contact.radius,
        line_load=contact.line_load,
        modulus=hertz.reduced_modulus(Solid(), Solid()),
    )
    assert film * 1e6 == pytest.approx(0.507, abs=5e-4)


def test_fig_22_and_23_flash_temperature_and_film_of_pair_1() -> None:
    result = scuffing(1)
    assert result.flash.blok_max == pytest.approx(71.5, abs=0.1)
    assert result.path.blok_flash[-1] == pytest.approx(55.7, abs=0.1)
    assert result.film.min_at_psi == 0.0
    assert result.film.dowson_higginson_min * 1e6 == pytest.approx(0.5235, abs=2e-4)
    assert result.film.dowson_higginson_min > 0.42e-6  # the paper's thermal EHL film


@pytest.mark.parametrize("pair", [1, 2, 3, 4])
def test_fig_22_the_dedendum_is_hottest_and_the_pitch_point_cold_in_every_pair(pair: int) -> None:
    result = scuffing(pair)
    assert result.flash.blok_at_psi == 0.0
    assert result.path.blok_flash.min() < 0.05 * result.flash.blok_max


@pytest.mark.parametrize(("ratio", "regime"), [(0.9, "boundary"), (1.0, "mixed"), (4.0, "mixed"), (4.1, "full_film")])
def test_equation_28_regimes(ratio: float, regime: str) -> None:
    """The ratio of film thickness to roughness (Xue Eq. 28) determines the lubrication regime."""
    assert thickness_regime(ratio) == regime
    assert thickness_ratio(ratio * 0.5e-6, 0.3e-6, 0.4e-6) == pytest.approx(ratio, rel=1e-12)


def test_equation_26_safety_in_either_unit() -> None:
    """The safety factor (Xue Eq. 26) is the same whether the temperatures are in kelvins or in degrees Celsius."""
    assert safety_factor(433.15, 333.15, 383.15) == pytest.approx(2.0, rel=1e-12)
    assert safety_factor(160.0, 60.0, 110.0) == pytest.approx(2.0, rel=1e-12)
    result = scuffing(1)
    assert result.contact_temperature.blok_max == pytest.approx(360 + result.flash.blok_max, rel=1e-12)
    assert result.safety.blok_factor == pytest.approx(100 / (result.contact_temperature.blok_max - 333.15), rel=1e-9)


def test_safety_needs_a_scuffing_temperature_above_the_oils() -> None:
    assert scuffing(1, Temperatures(bulk=360.0, bulk_method="given")).safety is None
    assert (
        refused(scuffing, 1, Temperatures(scuffing=320.0, bulk=360.0, bulk_method="given"))[0] == "scuffing_temperature"
    )


def test_safety_is_none_with_a_notice_where_the_teeth_stay_cool() -> None:
    result = scuffing(1, Temperatures(bulk=250.0, scuffing=433.15, bulk_method="given"))
    assert result.safety.blok_factor is None
    assert "no_safety" in codes(result)


def test_the_oil_enters_at_bulk_temperature() -> None:
    cool = scuffing(1, Temperatures(bulk=340.0, bulk_method="given")).path.dowson_higginson
    thicker = (Lubricant().viscosity_at(0.0, 340.0) / 0.08) ** 0.7
    assert cool == pytest.approx(thicker * scuffing(1).path.dowson_higginson, rel=1e-12)


# ISO/TR 13989-1, flash temperature of one point with the load and the thermo-elastic and geometry factors


def iso_flash(gears: GearPairInputs, scale: float) -> tuple[float, float]:
    """Return the flash temperature [K] at one point of the path, by Blok's formula and by ISO/TR 13989-1."""
    # The formula of ISO/TR 13989-1 is mu X_M X_G (w cos a_wt)^(3/4) v^(1/2) / a^(1/4).
    result = solve_load_distribution(replace(paper_pair(1), gears=gears))
    path, pair = result.path_of_contact, result.path_of_contact.pair
    x = scale * path.length
    gamma, u = float(path.profile_parameter(x)), gears.wheel.teeth / gears.pinion.teeth
    load = 200e3
    own = blok_flash(contact_at(result, x, load), 0.06)
    effusivity = np.sqrt(46 * 7850 * 470) * 1e-3  # N/(mm^0.5 m^0.5 s^0.5 K)
    x_m = 50 * 13.8 / effusivity
    angle, helix = pair.working_pressure_angle, pair.base_helix_angle
    x_ab = 1.22 * np.sin(angle) ** 0.25 * cos(helix) ** 0.25 * np.cos(angle) ** -0.75
    slip = np.sqrt(1 + u) * abs(np.sqrt(1 + gamma) - np.sqrt(1 - gamma / u))
    x_g = 0.51 * x_ab * slip / ((1 + gamma) * (u - gamma)) ** 0.25
    velocity = PAPER_SPEED * pair.pinion_working_radius
    working = load * 1e-3 * np.cos(angle)
    return own, 0.06 * x_m * x_g * working**0.75 * velocity**0.5 / (pair.centre_distance * 1e3) ** 0.25


SHIFTED = GearPairInputs(
    GearTeeth(17, 0.4), GearTeeth(41, 0.2), 4e-3, 30e-3, helix_angle=np.radians(15.0), rack_tip_radius=0.38
)


@pytest.mark.parametrize("gears", [*(paper_gears(pair) for pair in (1, 2, 3, 4)), SHIFTED])
@pytest.mark.parametrize("place", [0.0, 0.2, 0.9, 1.0])
def test_flash_temperature_agrees_with_the_form_of_iso_tr_13989_1(gears: GearPairInputs, place: float) -> None:
    # Both are Blok's formula; they differ by the rounded constants 50, 13.8, 0.51, 1.22 and by E and nu inside X_M.
    own, standard = iso_flash(gears, place)
    assert own == pytest.approx(standard, rel=1.5e-3)
