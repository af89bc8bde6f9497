"""Load distribution, thermal contact and scuffing: Xue, Zhang and Wang 2020, and gear pairs from two standards."""

from functools import partial

from benchmarks.published import xue
from benchmarks.published.standard_gears import example_stiffness, example_stress, fzg_pressure
from benchmarks.published.statement import Says, Statement
from solvers.scuffing.inputs import Model

XUE = "Xue 2020"
ISO_30 = "ISO/TR 6336-30, example 1"
FZG = "ISO 14635-1"


def _transverse_contact_ratio(number: int) -> float:
    return xue.pair(number).geometry.transverse_contact_ratio


def _overlap_ratio(number: int) -> float:
    return xue.pair(number).geometry.overlap_ratio


STATEMENTS: tuple[Statement, ...] = (
    *(
        Says(f"{XUE}, Table 1", f"transverse contact ratio, gear pair {number}").equals(
            printed, "-", partial(_transverse_contact_ratio, number), 3e-3
        )
        for number, printed in ((1, 1.59), (3, 1.49))
    ),
    *(
        Says(f"{XUE}, Table 1", f"overlap ratio, gear pair {number}").equals(
            printed, "-", partial(_overlap_ratio, number), 5e-3
        )
        for number, printed in ((1, 0.36), (2, 0.72), (3, 0.73), (4, 1.47))
    ),
    Says(f"{XUE}, Fig. 5", "shortest over longest contact length where the total ratio is below 2").equals(
        0.5, "-", lambda: xue.pair(1).contact_lines.length_ratio, 1e-12
    ),
    Says(f"{XUE}, Fig. 8", "one pair is stiffest near the pitch point: |Γ| there").below(
        0.05, "-", lambda: abs(xue.pair(1).stiffness.max_at_gamma)
    ),
    Says(f"{XUE}, Fig. 11", "largest line load, pair 1").equals(
        380.0, "N/mm", lambda: xue.pair(1).load.max_line_load * 1e-3, 0.04
    ),
    Says(f"{XUE}, Fig. 11", "line load where the mesh of pair 1 begins").not_reproduced(
        273.0,
        "N/mm",
        lambda: xue.root_load(1, xue.PAPER_MODEL),
        215.0,
        "the printed stiffness gives less; a flatter one, calibrated, gives the next line",
    ),
    Says(f"{XUE}, Fig. 11", "the same with the stiffness calibrated to the paper").equals(
        273.0,
        "N/mm",
        lambda: xue.root_load(1, xue.CALIBRATED_MODEL),
        0.01,
        "one parameter fitted to three printed loads",
    ),
    Says(f"{XUE}, Fig. 11", "line load where the mesh of pair 2 begins, calibrated stiffness").equals(
        102.0,
        "N/mm",
        lambda: xue.root_load(2, xue.CALIBRATED_MODEL),
        0.01,
        "one parameter fitted to three printed loads",
    ),
    Says(f"{XUE}, Fig. 12", "the transmission error of pair 1 varies most: over that of pair 3").above(
        1.0, "-", lambda: xue.pair(1).transmission_error.peak_to_peak / xue.pair(3).transmission_error.peak_to_peak
    ),
    Says(f"{XUE}, Fig. 17", "helix slope raises the pressure: 40 µm over none, pair 4").above(
        1.0, "-", lambda: xue.helix_slope_pressure(40e-6) / xue.helix_slope_pressure(0.0)
    ),
    Says(f"{XUE}, Fig. 20", "largest pressure of the film at A, in its centre").equals(
        1.51, "GPa", xue.centre_pressure, 0.04
    ),
    Says(f"{XUE}, Fig. 20", "thinnest film at A").not_reproduced(
        0.42,
        "µm",
        xue.film,
        0.328,
        "between the thermal and the isothermal film of the printed equations, 0.33 and 0.52",
    ),
    Says(f"{XUE}, Fig. 20", "isothermal film at A").above(0.42, "µm", lambda: xue.film("newtonian", thermal=False)),
    Says(f"{XUE}, Fig. 21", "middle of the film at A").calculated(466.9, "K", xue.mid_film_temperature, 5e-3),
    Says(f"{XUE}, Fig. 23", "film thinner than the formula's along the whole path: largest ratio").below(
        1.0, "-", xue.film_over_formula
    ),
    Says(f"{XUE}, Fig. 23", "film thinnest at the pinion's root: Ψ there").equals(0.0, "-", xue.thinnest_psi, 0.0),
    *(
        Says(FZG, f"pressure at the pitch point, FZG A stage {stage}").equals(
            pressure, "MPa", partial(fzg_pressure, torque), 3e-3
        )
        for stage, torque, pressure in ((6, 135.3, 927.1), (12, 534.5, 1842.7))
    ),
    Says(ISO_30, "theoretical single stiffness").equals(17.85584, "N/(mm µm)", example_stiffness, 1e-6),
    Says(ISO_30, "nominal contact stress over the helix factor").equals(1206.58 / 1.01944, "MPa", example_stress, 2e-4),
    Says("ISO 6336-1, method B", "single stiffness against ISO 6336-1, pair 1, half-space contact").between(
        0.9,
        1.1,
        "-",
        lambda: (xue.pair(1, Model()).stiffness.pitch or 0.0) / xue.pair(1, Model()).stiffness.standard_single,
    ),
)
