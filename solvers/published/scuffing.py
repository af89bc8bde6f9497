"""Load distribution, thermal contact and scuffing: Xue, Zhang and Wang 2020, and gear examples of standards."""

from solvers.published import xue
from solvers.published.standard_gears import example_stiffness, example_stress, fzg_pressure
from solvers.published.statement import Statement, above, below, between, equals, not_reproduced
from solvers.scuffing.inputs import Model

XUE = "Xue 2020"
ISO_30 = "ISO/TR 6336-30, example 1"
FZG = "ISO 14635-1"

STATEMENTS: tuple[Statement, ...] = (
    *(
        equals(
            f"transverse contact ratio, gear pair {number}",
            f"{XUE}, Table 1",
            printed,
            "-",
            lambda number=number: xue.pair(number).geometry.transverse_contact_ratio,  # type: ignore[misc]
            3e-3,
        )
        for number, printed in ((1, 1.59), (3, 1.49))
    ),
    *(
        equals(
            f"overlap ratio, gear pair {number}",
            f"{XUE}, Table 1",
            printed,
            "-",
            lambda number=number: xue.pair(number).geometry.overlap_ratio,  # type: ignore[misc]
            5e-3,
        )
        for number, printed in ((1, 0.36), (2, 0.72), (3, 0.73), (4, 1.47))
    ),
    equals(
        "shortest over longest contact length where the total ratio is below 2",
        f"{XUE}, Fig. 5",
        0.5,
        "-",
        lambda: xue.pair(1).contact_lines.length_ratio,
        1e-12,
    ),
    below(
        "one pair is stiffest near the pitch point: |Γ| there",
        f"{XUE}, Fig. 8",
        0.05,
        "-",
        lambda: abs(xue.pair(1).stiffness.max_at_gamma),
    ),
    equals(
        "largest line load, pair 1",
        f"{XUE}, Fig. 11",
        380.0,
        "N/mm",
        lambda: xue.pair(1).load.max_line_load * 1e-3,
        0.04,
    ),
    not_reproduced(
        "line load where the mesh of pair 1 begins",
        f"{XUE}, Fig. 11",
        273.0,
        "N/mm",
        lambda: xue.root_load(1, xue.PAPER_MODEL),
        215.0,
        "the printed stiffness gives less; a flatter one, calibrated, gives the next line",
    ),
    equals(
        "the same with the stiffness calibrated to the paper",
        f"{XUE}, Fig. 11",
        273.0,
        "N/mm",
        lambda: xue.root_load(1, xue.CALIBRATED_MODEL),
        0.01,
        "one parameter fitted to three printed loads",
    ),
    equals(
        "line load where the mesh of pair 2 begins, calibrated stiffness",
        f"{XUE}, Fig. 11",
        102.0,
        "N/mm",
        lambda: xue.root_load(2, xue.CALIBRATED_MODEL),
        0.01,
        "one parameter fitted to three printed loads",
    ),
    above(
        "the transmission error of pair 1 varies most: over that of pair 3",
        f"{XUE}, Fig. 12",
        1.0,
        "-",
        lambda: xue.pair(1).transmission_error.peak_to_peak / xue.pair(3).transmission_error.peak_to_peak,
    ),
    above(
        "helix slope raises the pressure: 40 µm over none, pair 4",
        f"{XUE}, Fig. 17",
        1.0,
        "-",
        lambda: xue.helix_slope_pressure(40e-6) / xue.helix_slope_pressure(0.0),
    ),
    equals(
        "largest pressure of the film at A, in its centre",
        f"{XUE}, Fig. 20",
        1.51,
        "GPa",
        xue.centre_pressure,
        0.04,
    ),
    not_reproduced(
        "thinnest film at A",
        f"{XUE}, Fig. 20",
        0.42,
        "µm",
        xue.film,
        0.328,
        "between the thermal and the isothermal film of the printed equations, 0.33 and 0.52",
    ),
    above("isothermal film at A", f"{XUE}, Fig. 20", 0.42, "µm", lambda: xue.film("newtonian", thermal=False)),
    equals(
        "middle of the film at A",
        f"{XUE}, Fig. 21",
        466.9,
        "K",
        xue.mid_film_temperature,
        5e-3,
        "the paper shows a map; the number is an independent calculation's",
    ),
    below(
        "film thinner than the formula's along the whole path: largest ratio",
        f"{XUE}, Fig. 23",
        1.0,
        "-",
        xue.film_over_formula,
    ),
    equals("film thinnest at the pinion's root: Ψ there", f"{XUE}, Fig. 23", 0.0, "-", xue.thinnest_psi, 0.0),
    *(
        equals(
            f"pressure at the pitch point, FZG A stage {stage}",
            FZG,
            pressure,
            "MPa",
            lambda torque=torque: fzg_pressure(torque),  # type: ignore[misc]
            3e-3,
        )
        for stage, torque, pressure in ((6, 135.3, 927.1), (12, 534.5, 1842.7))
    ),
    equals(
        "theoretical single stiffness",
        ISO_30,
        17.85584,
        "N/(mm µm)",
        example_stiffness,
        1e-6,
    ),
    equals("nominal contact stress over the helix factor", ISO_30, 1206.58 / 1.01944, "MPa", example_stress, 2e-4),
    between(
        "single stiffness against ISO 6336-1, pair 1, half-space contact",
        "ISO 6336-1, method B",
        0.9,
        1.1,
        "-",
        lambda: (xue.pair(1, Model()).stiffness.pitch or 0.0) / xue.pair(1, Model()).stiffness.standard_single,
    ),
)
