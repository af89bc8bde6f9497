"""Every default follows the kind of oil, the material, the lubrication or the speed to which it belongs.

The tests find a default by the reason that the answer states for it, whatever its field and endpoint are. So a default
that is added later is checked as well.
"""

from typing import Any

import pytest

from solvers.lubricants import OilKind
from solvers.oils import GRADES, KINDS, SQUARE_MILLIMETRE, typical_index
from solvers.scuffing.thermal.practice import OIL_KIND_FACTOR, OIL_KIND_LOSS_FACTOR, OIL_SUPPLY_FACTOR
from tests.app.test_defaults import STAGE, TURBO, codes
from tests.support.requests import CONTACT, COUPLING, changed, solved

SCUFFING, TRAIN = "/v1/scuffing", "/v1/drive-train"
USES: dict[str, tuple[str, dict[str, Any], str]] = {
    "coupling": ("/v1/coupling", COUPLING, "lubricant"),
    "scuffing": (SCUFFING, STAGE, "lubricant"),
    "line contact": ("/v1/scuffing/line-contact", CONTACT, "lubricant"),
    "unit": (TRAIN, TURBO, "lubricant"),
    "coupling of a unit": (TRAIN, changed(TURBO, {"couplings.0.friction": {}}), "couplings.0.lubricant"),
}
SHEETS: dict[str, dict[str, Any]] = {"grade": {"iso_vg": 150}, "viscosity": {"kinematic_viscosity_40_mm2_per_s": 150}}
SYNTHETIC: tuple[OilKind, ...] = ("pao", "ester", "polyglycol")


def answer(use: str, oil: dict[str, Any]) -> dict[str, Any]:
    endpoint, body, path = USES[use]
    return solved(endpoint, body, {path: oil})


def assumed(found: dict[str, Any], word: str, path: str = "") -> dict[str, Any]:
    """Return the assumed values whose fields begin with `path` and whose reasons contain `word`."""
    listed = found["assumptions"]
    return {
        each["field"]: each["value"] for each in listed if word in each["reason"] and each["field"].startswith(path)
    }


def of_the_oil(use: str, found: dict[str, Any]) -> dict[str, Any]:
    """Return the derived values that an answer states for its oil."""
    derived = found["derived"]
    for name in USES[use][2].split("."):
        derived = derived[int(name)] if isinstance(derived, list) else derived.get(name, derived)
    known: dict[str, Any] = derived
    return known


@pytest.mark.parametrize("sheet", SHEETS)
@pytest.mark.parametrize("use", USES)
def test_every_default_by_the_kind_of_oil_differs_from_a_mineral_oil_s(use: str, sheet: str) -> None:
    """The default properties of a synthetic oil differ from those of a mineral oil."""
    # The specific heat differs for polyalphaolefins only.
    path = USES[use][2]
    mineral = assumed(answer(use, {**SHEETS[sheet], "kind": "mineral"}), "kind of oil", path)
    assert len(mineral) >= 2
    for kind in SYNTHETIC:
        for field, value in assumed(answer(use, {**SHEETS[sheet], "kind": kind}), "kind of oil", path).items():
            assert value is not None, field
            same = field.endswith("specific_heat_j_per_kg_k") and kind != "pao"
            assert (value == mineral[field]) == same, (kind, field)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("use", USES)
def test_an_oil_has_the_index_and_the_properties_of_its_kind(use: str, kind: OilKind) -> None:
    known = KINDS[kind]
    by_grade, by_viscosity = (answer(use, {**sheet, "kind": kind}) for sheet in SHEETS.values())
    typical = typical_index(kind, 150 * SQUARE_MILLIMETRE)
    low, high = (94.0, 102.5) if kind == "mineral" else (typical - 1e-6, typical + 1e-6)
    assert low <= of_the_oil(use, by_grade)["viscosity_index"] <= high
    assert of_the_oil(use, by_viscosity)["viscosity_index"] == pytest.approx(typical, abs=1e-6)
    for found in (by_grade, by_viscosity):
        derived, path = of_the_oil(use, found), USES[use][2]
        assert assumed(found, "kind of oil", path)[f"{path}.density_15_kg_per_m3"] == known.density_15
        expected = {"specific_heat_j_per_kg_k": known.specific_heat}
        expected |= {"thermal_conductivity_w_per_m_k": known.thermal_conductivity}
        for name, value in expected.items():
            assert derived.get(name, value) == value


@pytest.mark.parametrize("grade", GRADES)
def test_synthetic_oils_of_a_grade_are_thicker_when_hot_and_thinner_when_cold(grade: int) -> None:
    """From mineral oil over polyalphaolefin to polyglycol, the viscosity rises at 90 C and falls at 10 C."""
    for temperature, sign in ((90.0, 1), (10.0, -1)):
        derived = [
            of_the_oil("coupling", answer("coupling", {"iso_vg": grade, "kind": kind, "temperature_c": temperature}))
            for kind in ("mineral", "pao", "polyglycol")
        ]
        densities = [KINDS[kind].density_15 for kind in ("mineral", "pao", "polyglycol")]
        kinematic = [sign * each["viscosity_pa_s"] / rho for each, rho in zip(derived, densities, strict=True)]
        assert kinematic == sorted(kinematic)


@pytest.mark.parametrize("kind", KINDS)
def test_friction_and_scuffing_temperature_have_the_factors_of_the_kind(kind: OilKind) -> None:
    """Both oils have the same viscosity, so that only the kind of oil differs."""
    mineral, other = (
        solved(SCUFFING, STAGE, {"lubricant": {"viscosity_pa_s": 0.02, "kind": each}}) for each in ("mineral", kind)
    )
    factor, of_losses = OIL_KIND_FACTOR[kind], OIL_KIND_LOSS_FACTOR[kind]
    ratios = {
        "flash.friction_coefficient": factor,
        "friction_loss.coefficient": of_losses,
        "derived.lubricant_factor": factor,
    }
    for path, ratio in ratios.items():
        section, name = path.split(".")
        assert other[section][name] == pytest.approx(ratio * mineral[section][name], rel=1e-12), path
    limits = [found["safety"]["scuffing_c"] - 80.0 for found in (mineral, other)]
    assert limits[1] == pytest.approx(factor * limits[0], rel=1e-12)


@pytest.mark.parametrize("modulus", [70.0, 110.0, 412.0])
def test_every_default_by_the_material_follows_it(modulus: float) -> None:
    unit = {"couplings.0.coupling.youngs_modulus_gpa": modulus}
    requests = [("/v1/coupling", COUPLING, {"coupling.youngs_modulus_gpa": modulus}), (TRAIN, TURBO, unit)]
    for endpoint, body, changes in requests:
        steel, other = (assumed(solved(endpoint, body, each), "E/206") for each in ({}, changes))
        assert steel.keys() == other.keys() != set()
        for field, value in other.items():
            assert value == pytest.approx(steel[field] * modulus / 206.0, rel=1e-12), field


def test_the_bulk_has_the_share_of_its_lubrication() -> None:
    """The bulk is hotter than the oil by a share of the mean flash temperature."""
    # The lubrication multiplies this share by 1.2 (spray, the default), 1 (dip) or 0.2 (submerged gears).
    bulk = {
        supply: solved(SCUFFING, STAGE, {"temperatures.oil_supply": supply})["contact_temperature"]["bulk_c"]
        for supply in OIL_SUPPLY_FACTOR
    }
    default = solved(SCUFFING, STAGE, {})
    assert default["contact_temperature"]["bulk_c"] == bulk["spray"]
    assert default["inputs"]["temperatures"]["oil_supply"] == "spray"
    for supply, factor in OIL_SUPPLY_FACTOR.items():
        assert (bulk[supply] - 60.0) / (bulk["dip"] - 60.0) == pytest.approx(factor, rel=1e-9)


@pytest.mark.parametrize(("velocity", "warned"), [(19.0, False), (21.0, True), (120.0, True)])
def test_an_estimate_beyond_its_speed_says_so(velocity: float, warned: bool) -> None:
    """The answer warns if the pitch-line velocity exceeds 20 m/s. The pinion's pitch radius is 50.78 mm."""
    speed = velocity / 50.776e-3 * 9.5493
    load = {"pinion_torque_n_m": 477.5, "pinion_speed_rpm": speed}
    found = solved(SCUFFING, STAGE, {"load": load, "temperatures.bulk_method": "estimated"})
    assert ("bulk_lower_bound" in codes(found)) == warned
