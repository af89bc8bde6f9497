"""Point A of gear pair 1 against an independent calculation on meshes of the same kind (grid convergence table).

Reference rows are (N, h_cen um, h_min um, mu, t_max K, mid-film max K, face maxima K, heat W/m). The two meshes are
not the same, so a row may differ by what the reference itself still has to its finest mesh at that N, plus 0.5 % in
film and friction, 0.6 K in film temperature and 0.3 K on the faces.
"""

from dataclasses import replace

import pytest

from solvers.contact.ehl import Model
from solvers.contact.ehl.model import solve
from tests.support.xue_contact import contact, point_a

NEWTONIAN = [
    (81, 0.5118, 0.3008, 0.0483, 584.6, 576.7, 470.8, 417.6, 36666),
    (121, 0.5237, 0.3080, 0.0474, 589.8, 585.6, 469.2, 417.2, 35945),
    (241, 0.5310, 0.3124, 0.0468, 593.7, 590.0, 468.8, 417.1, 35475),
    (481, 0.5327, 0.3138, 0.0466, 595.0, 591.1, 468.4, 417.0, 35262),
]
EYRING = [
    (81, 0.4520, 0.3181, 0.02775, 466.8, 465.3, 420.9, 391.5, 21662),
    (121, 0.4632, 0.3243, 0.02747, 467.7, 466.3, 420.6, 391.3, 21393),
    (241, 0.4700, 0.3281, 0.02730, 468.2, 466.9, 420.4, 391.1, 21207),
    (481, 0.4715, 0.3291, 0.02723, 468.3, 467.0, 420.3, 391.1, 21128),
]
ROWS = [("newtonian", row, NEWTONIAN[-1]) for row in NEWTONIAN] + [("ree_eyring", row, EYRING[-1]) for row in EYRING]
Row = tuple[int, float, float, float, float, float, float, float, float]


@pytest.mark.parametrize(("rheology", "row", "finest"), ROWS)
def test_grid_convergence(rheology: str, row: Row, finest: Row) -> None:
    nodes = row[0]
    result = point_a(nodes, rheology, film_nodes=31 if nodes >= 361 else 21)
    assert result.friction is not None
    assert result.temperature is not None
    assert result.heat is not None
    t = result.temperature
    contact = (result.film.central, result.film.minimum, result.friction.coefficient)
    found = (*contact, t.film_max, t.mid_film_max, t.surface_1_max, t.surface_2_max, result.heat.generated)
    scales = (1e6, 1e6, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)
    margins = (0.005 * row[1], 0.005 * row[2], 0.005 * row[3], 0.6, 0.6, 0.3, 0.3, 0.005 * row[8])
    for value, scale, reference, limit, margin in zip(found, scales, row[1:], finest[1:], margins, strict=True):
        assert value is not None
        assert value * scale == pytest.approx(reference, abs=abs(reference - limit) + margin)


@pytest.mark.parametrize(("rheology", "x_1", "x_2"), [("newtonian", 0.74, 0.71), ("ree_eyring", 0.82, 0.64)])
def test_hottest_place_of_the_faces(rheology: str, x_1: float, x_2: float) -> None:
    result = point_a(241, rheology)
    assert result.temperature is not None
    b = result.hertz.half_width
    assert result.temperature.surface_1_max_at / b == pytest.approx(x_1, abs=0.03)  # two nodes
    assert result.temperature.surface_2_max_at / b == pytest.approx(x_2, abs=0.03)


@pytest.mark.parametrize(
    ("nodes", "central", "minimum"),
    [(81, 0.5626, 0.5099), (241, 0.5800, 0.5226), (481, 0.5816, 0.5239), (961, 0.5820, 0.5242)],
)
def test_isothermal_film(nodes: int, central: float, minimum: float) -> None:
    film = point_a(nodes, "newtonian", thermal=False).film
    assert film.central is not None
    assert film.minimum is not None
    assert film.central * 1e6 == pytest.approx(central, rel=0.005)
    assert film.minimum * 1e6 == pytest.approx(minimum, rel=0.005)


def test_isothermal_spike_sharpens_with_the_mesh_at_one_place() -> None:
    """0.88 b; its height is no result at L = 22: 1.55, 1.62, 1.80 GPa at 81, 241, 481 nodes."""
    peaks = [point_a(nodes, "newtonian", thermal=False) for nodes in (241, 481)]
    heights = [peak.pressure.maximum for peak in peaks if peak.pressure]
    assert heights[1] > 1.05 * heights[0]
    for peak in peaks:
        assert peak.pressure is not None
        assert peak.pressure.maximum_at / peak.hertz.half_width == pytest.approx(0.881, abs=0.005)


def test_hertz_contact() -> None:
    result = point_a()
    assert result.hertz.half_width == pytest.approx(0.1110e-3, rel=5e-4)
    assert result.hertz.max_pressure == pytest.approx(1.5652e9, rel=1e-4)
    assert result.dimensionless.moes_m == pytest.approx(14.73, abs=0.005)
    assert result.dimensionless.moes_l == pytest.approx(22.39, abs=0.005)


@pytest.mark.parametrize("nodes", [81, 121, 241])
@pytest.mark.parametrize(
    ("rheology", "thermal", "reference"),
    [("ree_eyring", True, 1.546e9), ("newtonian", True, 1.5724e9), ("newtonian", False, 1.5465e9)],
)
def test_pressure_at_the_centre(rheology: str, thermal: bool, reference: float, nodes: int) -> None:
    result = point_a(nodes, rheology, thermal=thermal)
    assert result.pressure is not None
    assert result.pressure.centre == pytest.approx(reference, rel=0.001)


@pytest.mark.parametrize("row", [(81, 1.671e9, 0.71), (121, 1.714e9, 0.69), (241, 1.754e9, 0.70), (481, 1.766e9, 0.69)])
def test_thermal_pressure_maximum_of_the_newtonian_film(row: tuple[int, float, float]) -> None:
    """Its height depends on where the nearest node lies: 1 %; position within two nodes."""
    result = point_a(row[0], "newtonian", film_nodes=31 if row[0] >= 361 else 21)
    assert result.pressure is not None
    assert result.pressure.maximum == pytest.approx(row[1], rel=0.01)
    assert result.pressure.maximum_at / result.hertz.half_width == pytest.approx(row[2], abs=0.03)


@pytest.mark.parametrize("nodes", [81, 121, 241])
def test_pressure_maximum_of_the_eyring_film_is_in_the_centre(nodes: int) -> None:
    result = point_a(nodes)
    assert result.pressure is not None
    assert result.pressure.maximum == pytest.approx(1.546e9, rel=0.001)
    assert abs(result.pressure.maximum_at) < 0.035 * result.hertz.half_width  # one node


def test_isothermal_newtonian_friction_has_no_meaning() -> None:
    """2.6e4: nothing but heat limits the shear stress of a Newtonian film, and the result says so."""
    result = point_a(121, "newtonian", thermal=False)
    assert result.friction is not None
    assert result.friction.coefficient == pytest.approx(2.6e4, rel=0.05)
    assert "high_traction" in [warning.code for warning in result.warnings]


def test_ten_megapascal_eyring_stress() -> None:
    result = point_a(481, film_nodes=31, eyring_stress=10e6)
    assert result.film.central is not None
    assert result.film.minimum is not None
    assert result.friction is not None
    assert result.temperature is not None
    assert result.heat is not None
    assert result.film.central * 1e6 == pytest.approx(0.5092, rel=0.003)
    assert result.film.minimum * 1e6 == pytest.approx(0.3326, rel=0.003)
    assert result.friction.coefficient == pytest.approx(0.03472, rel=0.003)
    assert result.temperature.film_max == pytest.approx(509.5, abs=0.3)
    assert result.temperature.surface_1_max == pytest.approx(438.6, abs=0.2)
    assert result.temperature.surface_2_max == pytest.approx(400.3, abs=0.2)
    assert result.heat.generated == pytest.approx(26556, rel=0.003)


def test_heat_balance_of_the_newtonian_film() -> None:
    """Generated 35.26 kW/m = 16.77 + 18.29 into the faces + 0.15 convected + 0.05 taken up by expansion."""
    heat = point_a(481, "newtonian", film_nodes=31).heat
    assert heat is not None
    assert heat.to_surface_1 == pytest.approx(16770, rel=0.004)
    assert heat.to_surface_2 == pytest.approx(18290, rel=0.004)
    assert heat.convected == pytest.approx(150, abs=15)
    assert heat.compression == pytest.approx(-51, abs=6)  # heating before the centre less cooling behind it
    assert heat.balance_error < 1e-6


@pytest.mark.parametrize(
    ("rheology", "coefficient", "film_max"), [("newtonian", 0.069, None), ("ree_eyring", 0.0323, 442.0)]
)
def test_conductivity_that_doubles_under_pressure(rheology: str, coefficient: float, film_max: float | None) -> None:
    """What a constant conductivity costs: mu from 0.047 to 0.069 (Newtonian), 0.0273 to 0.0323 (Ree-Eyring)."""
    inputs = contact(replace(Model(), rheology=rheology))
    result = solve(replace(inputs, lubricant=replace(inputs.lubricant, thermal_conductivity=0.28)))
    assert result.friction is not None
    assert result.temperature is not None
    assert result.friction.coefficient == pytest.approx(coefficient, rel=0.015)
    if film_max is not None:
        assert result.temperature.film_max == pytest.approx(film_max, abs=1.0)
