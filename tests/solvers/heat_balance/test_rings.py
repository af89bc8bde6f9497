"""The rotor of rings against closed forms: uniform and linear temperatures, and the endless cylinder."""

from math import pi

import numpy as np
import pytest
from hypothesis import strategies as st
from scipy.special import i0, i1

from solvers.arrays import FloatArray
from solvers.heat_balance.face import face_lines
from solvers.heat_balance.rings import (
    Cylinder,
    Exchange,
    Rings,
    RotorGeometry,
    _lines,
    cylinder_growth,
    response,
    rings_of,
)
from tests.support.properties import examples

FEW, MANY = 10, 100
RADIUS = 0.1


@st.composite
def rotors(draw: st.DrawFn) -> RotorGeometry:
    """Draw a stepped rotor, solid or with rim, web and hub, with one face or two, with or without bearings."""
    width, count = draw(st.floats(0.05, 0.4)), draw(st.sampled_from([1, 2]))
    gap = draw(st.floats(0.02, 0.1)) * (count - 1)
    high, root, bore = count * width + gap, draw(st.floats(0.06, 0.5)), 0.0
    side = [Cylinder(-draw(st.floats(0.02, 0.2)), 0.0, 0.0, draw(st.floats(0.3, 1.0)) * root)]
    other = [Cylinder(high, high + draw(st.floats(0.02, 0.2)), 0.0, draw(st.floats(0.3, 1.0)) * root)]
    body, web = [Cylinder(0.0, high, bore, root)], list[float]()
    if draw(st.booleans()):
        rim, hub, half = 0.85 * root, 0.5 * root, draw(st.floats(0.02, 0.45)) * width
        middle = high / 2
        body = [
            Cylinder(0.0, high, bore, hub),
            Cylinder(middle - half, middle + half, hub, rim),
            Cylinder(0.0, high, rim, root),
        ]
        web = [middle - half, middle + half]
    starts = [k * (width + gap) for k in range(count)]
    faces = tuple(
        tuple(
            start + line for line in face_lines(width, 21, [edge - start for edge in web if 0 < edge - start < width])
        )
        for start in starts
    )
    journals = draw(st.booleans()), draw(st.booleans())
    return RotorGeometry((*side, *body, *other), root, faces, journals)


@examples(FEW, MANY, rotors())
def test_uniform_and_linear_temperatures_are_free_of_stress(geometry: RotorGeometry) -> None:
    """A uniform rise grows the body to scale; T = a z bends its sections: u_r = a z r, u_z = a (z^2 - r^2)/2."""
    rings = rings_of(geometry)
    z, r, size = rings.z, rings.r, np.ptp(rings.z) + geometry.root_radius
    radial, axial = rings.growth(np.stack([np.full(z.size, 1.0), z], axis=1))
    close = 1e-9 * size  # rounding times the condition of the thinnest discs: 1.3e-10 was the most of 100 draws
    for k, (wide, long) in enumerate(((r, z), (z * r, (z**2 - r**2) / 2))):
        assert radial[:, k] == pytest.approx(wide, abs=close)
        assert np.ptp(axial[:, k] - long) < close


@examples(FEW, MANY, rotors(), st.integers(0, 10**6))
def test_heat_into_the_body_leaves_it(geometry: RotorGeometry, seed: int) -> None:
    """What the rim gives reaches air and bearings; a body as warm as all around it exchanges nothing."""
    found = response(geometry, Exchange(46.0, 500.0, 300.0 if geometry.faces[1:] else 0.0))
    sources = np.random.default_rng(seed).uniform(-50.0, 50.0, found.taken.shape[1])
    flows = float((found.taken @ sources).sum()), float(found.to_air @ sources + (found.to_journals @ sources).sum())
    assert flows[0] == pytest.approx(flows[1], rel=1e-9, abs=1e-8 * float(np.abs(found.taken @ sources).sum()))
    even = np.ones_like(sources)
    if not geometry.faces[1:]:
        even[-3] = 0.0
    for k, held in enumerate(geometry.journals):
        even[len(even) - 2 + k] *= held
    assert np.abs(found.taken @ even).max() < 1e-8 * np.abs(found.taken).max()
    assert found.radial @ even == pytest.approx(geometry.root_radius, rel=1e-9)


def wavy(slenderness: float, rings: int, radial: int) -> float:
    """Growth in the middle of a long cylinder whose surface has T = cos(k z), over that of free slices."""
    waves = 2 * int(slenderness) + 4  # half waves: the free ends are more than four radii away
    length = waves * pi * RADIUS / slenderness
    lines = tuple(np.linspace(0.0, length, waves * rings + 1))
    geometry = RotorGeometry((Cylinder(0.0, length, 0.0, RADIUS),), RADIUS, (lines,))
    z_lines, r_lines = _lines(geometry)
    r_lines = RADIUS * (1 - np.linspace(1, 0, radial + 1) ** 1.6)
    cylinder = Rings.on(geometry, z_lines, r_lines)
    k = slenderness / RADIUS
    rise = np.cos(k * cylinder.z) * i0(k * cylinder.r) / i0(slenderness)
    radial_growth, _ = cylinder.growth(rise[:, None])
    return float(abs(radial_growth[cylinder.rim[cylinder.rim.size // 2], 0]) / RADIUS)


@pytest.mark.parametrize(("slenderness", "growth"), [(1.758, 0.7304), (6.134, 0.2392)])
def test_endless_cylinder(slenderness: float, growth: float) -> None:
    """The closed form of the specification's numbers, and rings that come closer at their order."""
    exact = cylinder_growth(slenderness)
    assert exact == pytest.approx(growth, abs=5e-5)
    errors = [abs(wavy(slenderness, rings, radial) / exact - 1) for rings, radial in ((4, 4), (8, 8))]
    assert errors[1] < 2e-3
    assert errors[0] / errors[1] > 2**2  # of the square of the rings at least


@pytest.mark.parametrize(("slenderness", "growth"), [(0.5, 0.97), (1.0, 0.89), (2.0, 0.68), (3.0, 0.50), (6.1, 0.24)])
def test_growth_of_a_cylinder_over_its_slenderness(slenderness: float, growth: float) -> None:
    assert cylinder_growth(slenderness) == pytest.approx(growth, abs=0.006)
    assert cylinder_growth(200.0) == pytest.approx(1.3 / 200, rel=0.02)


def test_conduction_of_one_mode() -> None:
    """A cylinder under T = cos(k z) at its surface takes 2 pi R k_s k I_1/I_0 per length."""
    slenderness, waves = 3.0, 2
    length, k = waves * pi * RADIUS / slenderness, slenderness / RADIUS
    lines = np.linspace(0.0, length, 16 * waves + 1)
    geometry = RotorGeometry((Cylinder(0.0, length, 0.0, RADIUS),), RADIUS, (tuple(lines),))
    found, wave = response(geometry, Exchange(46.0)), np.cos(k * _with_middles(lines))
    taken = float(wave @ (found.taken[:, : wave.size] @ wave)) / (length / 2)
    exact = 2 * pi * RADIUS * 46.0 * k * i1(slenderness) / i0(slenderness)
    assert taken == pytest.approx(exact, rel=5e-6)  # twice as many rings over the radius: 7e-8


def _with_middles(lines: FloatArray) -> FloatArray:
    return np.sort(np.concatenate([lines, (lines[1:] + lines[:-1]) / 2]))
