"""Films of plain bearings: the solver against closed forms and printed values, the table against the solver."""

from math import atan2, cos, degrees, hypot, pi, sin, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq

from solvers.drive_train.film.law import eccentricity_at, film_at, film_law
from solvers.drive_train.film.reynolds import FilmSolution, solve_film
from solvers.drive_train.film.table import PLACES, RATIOS, nodes, ratios, short_load, table
from solvers.drive_train.inputs import BearingFilm, JournalBearing
from solvers.drive_train.shafts.bearings import bearing_state
from tests.support.properties import first, seeds

# The solver


@pytest.mark.parametrize(
    ("eccentricity", "ratio"), first(3, [(0.1, 0.5), (0.4, 1.0), (0.6, 0.5), (0.8, 1.0), (0.4, 2.0)])
)
def test_load_converges_with_the_second_order(eccentricity: float, ratio: float) -> None:
    loads = [solve_film(eccentricity, ratio, refinements).load for refinements in range(4)]
    changes = np.abs(np.diff(loads))
    assert np.log2(changes[0] / changes[2]) / 2 == pytest.approx(2.0, abs=0.25)  # the film's end jumps by cells


@pytest.mark.parametrize(("eccentricity", "ratio"), first(3, [(0.2, 0.3), (0.6, 1.0), (0.97, 0.1), (0.9, 2.0)]))
def test_angle_and_flow_converge(eccentricity: float, ratio: float) -> None:
    """Errors of the attitude angle and the side flow fall by ten from the coarsest grid to one three times finer."""
    coarse, fine, finest = (solve_film(eccentricity, ratio, refinements) for refinements in (0, 2, 3))
    for name in ("attitude", "side_flow"):
        errors = [abs(getattr(each, name) / getattr(finest, name) - 1) for each in (coarse, fine)]
        assert errors[1] < max(errors[0] / 5, 3e-4)
        assert errors[1] < 2e-3


def test_a_narrow_bearing_is_short() -> None:
    """At L/D -> 0 load, angle and flow are those of the half film without flow around the bore (Ocvirk)."""
    for eccentricity in (0.1, 0.5, 0.8):
        film, root = solve_film(eccentricity, 0.02), sqrt(1 - eccentricity**2)
        assert film.load == pytest.approx(0.02**2 * short_load(eccentricity), rel=2e-3)
        assert film.attitude == pytest.approx(atan2(pi * root, 4 * eccentricity), rel=1e-3)
        assert film.side_flow == pytest.approx(eccentricity, rel=1e-3)


def _endless(eccentricity: float, ratio: float, *, groove: bool) -> tuple[float, float]:
    """Return the load per width of an endless bearing, and its angle, both from two widths: ends count as 1/L."""
    wide, wider = (solve_film(eccentricity, share * ratio, groove=groove) for share in (1, 2))
    return 2 * wider.load - wide.load, 2 * wider.attitude - wide.attitude


@pytest.mark.parametrize("eccentricity", [0.1, 0.4])
def test_an_endless_bearing_without_a_groove_has_the_load_of_sommerfeld(eccentricity: float) -> None:
    """An endless film without a groove is full: 12 pi e/((2 + e^2) sqrt(1 - e^2)), at right angles to the load."""
    load, attitude = _endless(eccentricity, 20.0, groove=False)
    sommerfeld = 12 * pi * eccentricity / ((2 + eccentricity**2) * sqrt(1 - eccentricity**2))
    assert load == pytest.approx(sommerfeld, rel=1e-3)
    assert degrees(attitude) == pytest.approx(90.0, abs=0.3)


@pytest.mark.parametrize("eccentricity", [0.1, 0.4, 0.8])
def test_an_endless_bearing_with_a_groove_has_the_load_of_reynolds(eccentricity: float) -> None:
    """The closed form with the film from the widest gap to where pressure and gradient vanish."""
    e = eccentricity
    end = brentq(lambda x: e * (sin(x) * cos(x) - x) + 2 * (sin(x) - x * cos(x)), pi + 1e-9, 1.5 * pi)
    film = 1 - e * cos(end)
    radial = 3 * e * (1 - cos(end)) ** 2 / ((1 - e**2) * film)
    tangential = 6 * (sin(end) - end * cos(end)) / (sqrt(1 - e**2) * film)
    load, attitude = _endless(e, 20.0, groove=True)
    assert load == pytest.approx(hypot(radial, tangential), rel=5e-4)
    assert attitude == pytest.approx(atan2(tangential, radial), rel=1e-3)


RAIMONDI_BOYD = {
    (1.0, 0.2): (0.631, 74.02, 12.8),
    (1.0, 0.6): (0.121, 50.58, 3.22),
    (1.0, 0.8): (0.0446, 36.24, 1.70),
    (1.0, 0.9): (0.0188, 26.45, 1.05),
    (0.5, 0.2): (2.03, 74.94, 40.9),
    (0.5, 0.6): (0.319, 48.14, 8.10),
    (0.5, 0.8): (0.0923, 33.31, 3.26),
    (0.5, 0.9): (0.0313, 23.66, 1.60),
}
"""L/D and eccentricity: S, attitude angle, f R/c (Raimondi and Boyd 1958, quoted from memory of its reprints)."""


@pytest.mark.parametrize("case", RAIMONDI_BOYD, ids=str)
def test_with_a_groove_at_the_widest_gap_the_tables_of_raimondi_and_boyd_follow(case: tuple[float, float]) -> None:
    ratio, eccentricity = case
    sommerfeld, attitude, friction = RAIMONDI_BOYD[case]
    film = solve_film(eccentricity, ratio, groove=True)
    assert 1 / (pi * film.load) == pytest.approx(sommerfeld, rel=0.01)  # three digits of a coarse mesh of 1958
    assert degrees(film.attitude) == pytest.approx(attitude, abs=0.5)
    assert _moment(eccentricity, film.load, film.attitude) / film.load == pytest.approx(friction, rel=0.01)


def test_the_film_of_the_issue() -> None:
    """Independent finite differences: 0.0095 Pa s, 10,000/min, D 160, c 130 um (radial); their last digit is theirs."""
    expected = {(0.11, 20e3): 0.367, (0.11, 60e3): 0.625, (0.08, 20e3): 0.563, (0.16, 20e3): 0.166}
    short = {(0.11, 20e3): 0.318, (0.11, 60e3): 0.548, (0.08, 20e3): 0.520, (0.16, 20e3): 0.127}
    for (width, load), eccentricity in expected.items():
        assert _running("finite", width, load) == pytest.approx(eccentricity, abs=1.1e-3)
        assert _running("short", width, load) == pytest.approx(short[width, load], abs=5e-4)


def _running(film: BearingFilm, width: float, load: float) -> float:
    bearing = JournalBearing(0.0, 0.16, width, 0.0095, 130e-6)
    eccentricity = bearing_state(bearing, np.array([0.0, -load]), 10000 * pi / 30, 1.0, film).eccentricity_ratio
    assert eccentricity is not None
    return eccentricity


def _moment(eccentricity: float, load: float, attitude: float) -> float:
    """Friction moment of the journal in eta omega R^3 L/c, from load and angle."""
    return 2 * pi / sqrt(1 - eccentricity**2) + eccentricity / 2 * load * sin(attitude)


def test_friction_is_the_integrated_shear() -> None:
    """The shear on the journal is eta U/h plus h/2 of the pressure's gradient, over the full ring."""
    eccentricity, ratio = 0.7, 0.8
    film = solve_film(eccentricity, ratio, 4)
    angle = np.concatenate([[0.0], film.angle])
    mean = np.asarray(np.trapezoid(film.pressure, film.across, axis=1))
    gap = 1 + eccentricity * np.cos(angle)
    middle = (gap[1:] + gap[:-1]) / 2
    gradient = float(middle @ np.diff(np.concatenate([mean[-1:], mean]))) / 2
    whole = np.linspace(0.0, 2 * pi, 2001)
    shear = np.trapezoid(1 / (1 + eccentricity * np.cos(whole)), whole)
    assert shear + gradient == pytest.approx(_moment(eccentricity, film.load, film.attitude), rel=1e-4)


def test_the_pressure_fulfils_reynolds_condition() -> None:
    """The pressure is never negative; behind the film's end the gap widens."""
    film = solve_film(0.6, 0.8, 2)
    assert film.pressure.min() == 0.0
    torn = film.angle[film.pressure[:, 0] == 0.0]
    assert torn.size
    assert np.all((torn > pi) & (torn < 2 * pi))


# The table


def test_the_table_is_what_its_generator_solves() -> None:
    for row in (0, 200, len(nodes()) - 1):
        place, width = row % PLACES.size, row // PLACES.size
        assert table()[width + 1, place] == pytest.approx(ratios(*nodes()[row]), abs=2e-6)  # six decimals in the file
    assert table().shape == (len(RATIOS) + 1, PLACES.size, 3)


@seeds(3, 200)
def test_the_table_has_the_film_of_a_fine_solution(rng: np.random.Generator) -> None:
    eccentricity, ratio = rng.uniform(0.01, 0.97), rng.uniform(0.1, 2.0)
    point, fine = film_at(film_law(ratio), eccentricity), solve_film(eccentricity, ratio, 4)
    load = point.load * ratio**2
    found = (load, point.attitude, point.side_flow, _moment(eccentricity, load, point.attitude))
    exact = (fine.load, fine.attitude, fine.side_flow, _moment(eccentricity, fine.load, fine.attitude))
    assert found == pytest.approx(exact, rel=2e-3)


@seeds(3, 300)
def test_slopes_are_derivatives_and_the_load_determines_the_eccentricity(rng: np.random.Generator) -> None:
    law, eccentricity = film_law(float(rng.choice([0.0, rng.uniform(0.01, 3.0)]))), rng.uniform(0.001, 0.998)
    step = 1e-6 * (1 - eccentricity)
    below, here, above = (film_at(law, eccentricity + change) for change in (-step, 0.0, step))
    assert here.load_slope == pytest.approx((above.load - below.load) / (2 * step), rel=1e-6)
    assert here.attitude_slope == pytest.approx((above.attitude - below.attitude) / (2 * step), rel=1e-5)
    assert eccentricity_at(law, here.load) == pytest.approx(eccentricity, rel=1e-12)


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.69, 2.0])
def test_load_grows_with_eccentricity_ever_faster(ratio: float) -> None:
    """A film that yielded where it is loaded more would have two states, and Newton's method for the gap would jump."""
    law = film_law(ratio)
    slopes = [film_at(law, eccentricity).load_slope for eccentricity in np.linspace(0.0, 0.999, 2000)]
    assert slopes[0] > 0.0
    assert np.all(np.diff(slopes) > 0.0)


def test_the_side_flow_is_what_enters_less_what_leaves_the_film() -> None:
    """With a groove: Couette flow and pressure flow in at the widest gap, Couette flow out at the film's end."""
    film: FilmSolution = solve_film(0.6, 0.8, 4, groove=True)
    inside = film.pressure > 0.0
    end = np.array([film.angle[column].max() if column.any() else pi for column in inside.T])
    gradient = np.where(inside[0], film.pressure[0] / film.angle[0], 0.0)
    entering = (1 + 0.6) / 2 - (1 + 0.6) ** 3 / 12 * gradient
    leaving = (1 + 0.6 * np.cos(end)) / 2
    assert np.trapezoid(entering - leaving, film.across) == pytest.approx(film.side_flow, rel=5e-3)
