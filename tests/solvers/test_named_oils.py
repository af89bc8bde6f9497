"""Every row of the table of oils has its source, is an oil, and says where its printed index cannot be."""

from datetime import date
from statistics import mean

import pytest

from solvers.named_oils import INDEX_DIFFERS, NEAREST, named_oils, nearest_names
from solvers.oils import SQUARE_MILLIMETRE, TYPICAL_INDEX, OilSheet, sheet_of_index, typical_index
from solvers.quantity import quantities
from solvers.scuffing.inputs import MicropittingCheck, ScuffingTest

OILS = named_oils().values()


def test_every_row_is_an_oil_with_its_source() -> None:
    stages = quantities(ScuffingTest)["fzg_stage"].bounds, quantities(MicropittingCheck)["failure_load_stage"].bounds
    for oil in OILS:
        assert len(oil.source) > 20, oil.name
        assert date.fromisoformat(oil.read) <= date.fromisoformat("2026-11-29"), oil.name
        sheet = OilSheet(
            oil.kinematic_viscosity_40_mm2_per_s * SQUARE_MILLIMETRE,
            oil.kinematic_viscosity_100_mm2_per_s * SQUARE_MILLIMETRE,
            oil.kind,
            oil.density_15_kg_per_m3,
        )
        assert sheet.viscosity_index == oil.computed_index
        assert 800.0 <= sheet.reference_density <= 1100.0, oil.name
        for stage, bounds in zip((oil.fzg_stage, oil.micropitting_stage), stages, strict=True):
            assert stage is None or bounds["ge"] <= stage <= bounds["le"], oil.name
    assert len({name.casefold() for name in named_oils()}) == len(OILS)


def test_the_reference_oil_of_the_gear_research() -> None:
    oil = named_oils()["FVA 3A"]
    viscosities = oil.kinematic_viscosity_40_mm2_per_s, oil.kinematic_viscosity_100_mm2_per_s
    assert (*viscosities, oil.density_15_kg_per_m3) == (90.02, 10.41, 884.1)
    assert oil.computed_index == pytest.approx(oil.viscosity_index, abs=0.5)


def test_an_index_that_the_viscosities_do_not_have_is_remarked() -> None:
    remarked = {oil.name: round(oil.computed_index - oil.viscosity_index) for oil in OILS if oil.index_remark}
    assert remarked["Mobil DTE 846"] == -16  # prints 106 beside 42.4 and 6.2 mm2/s, which have 90
    assert remarked["Mollube MOL-GEAR 46"] == 37
    assert all(abs(difference) >= INDEX_DIFFERS for difference in remarked.values())
    assert not named_oils()["Mobil SHC 632"].index_remark


def test_the_index_typical_of_a_grade_of_pao_is_the_mean_of_its_sheets() -> None:
    for grade, typical in TYPICAL_INDEX["pao"]:
        sheets = [
            oil for oil in OILS if oil.kind == "pao" and abs(oil.kinematic_viscosity_40_mm2_per_s / grade - 1) <= 0.1
        ]
        assert typical == pytest.approx(mean(oil.computed_index for oil in sheets), abs=2.5), grade  # to the nearest 5


def test_between_grades_the_index_follows_the_logarithm_of_the_viscosity() -> None:
    low, high = dict(TYPICAL_INDEX["pao"])[46.0], dict(TYPICAL_INDEX["pao"])[68.0]
    between = (46.0 * 68.0) ** 0.5 * SQUARE_MILLIMETRE
    assert typical_index("pao", between) == pytest.approx((low + high) / 2)
    assert sheet_of_index(between, kind="pao").viscosity_index == pytest.approx((low + high) / 2, abs=1e-6)
    assert typical_index("pao", 5e-6) == 145.0
    assert typical_index("ester", 5e-6) == 150.0


@pytest.mark.parametrize("text", ["", "\x00", "\ud800" * 1000, "x" * 100_000, "SHC 632", "mobil dte 83"])
def test_any_text_has_nearest_names(text: str) -> None:
    near = nearest_names(text)
    assert len(near) == NEAREST
    assert set(near) <= set(named_oils())


def test_a_slip_of_the_pen_finds_its_oil() -> None:
    assert nearest_names("mobil dte 83")[0] == "Mobil DTE 832"
    assert nearest_names("mobilgear 600xp 220")[0] == "Mobilgear 600 XP 220"
    assert nearest_names("FVA-3A")[0] == "FVA 3A"
