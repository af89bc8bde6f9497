"""Flank tolerances of a quality class (ISO 1328-1:2013), and how far they let the gap of a pair scatter.

The formulas are second hand: four public implementations that cite the standard by its equation numbers agree.
"""

from math import cos, floor, hypot, sqrt

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.quantity import quantity, record
from solvers.sources import ISO_1328

DEVIATIONS = 3.0  # standard deviations that a tolerance stands for: 99.73 % of the flanks are within it; chosen
SCOPE = {  # mm; beyond these limits the standard forbids its formulas
    "module": (0.5, 70.0),
    "face_width": (4.0, 1200.0),
    "reference diameter": (5.0, 15000.0),
}


@record(kw_only=True, equation="Q1")
class FlankTolerances:
    """Tolerances of both gears, and three standard deviations of the gap of the pair [m]."""

    pinion_single_pitch: float = quantity("single pitch tolerance of the pinion", "f_pT1", ISO_1328, unit="um")
    pinion_profile_slope: float = quantity("profile slope tolerance of the pinion", "f_HαT1", ISO_1328, unit="um")
    pinion_helix_slope: float = quantity("helix slope tolerance of the pinion", "f_HβT1", ISO_1328, unit="um")
    pinion_helix: float = quantity("total helix tolerance of the pinion", "F_βT1", ISO_1328, unit="um")
    wheel_single_pitch: float = quantity("single pitch tolerance of the wheel", "f_pT2", ISO_1328, unit="um")
    wheel_profile_slope: float = quantity("profile slope tolerance of the wheel", "f_HαT2", ISO_1328, unit="um")
    wheel_helix_slope: float = quantity("helix slope tolerance of the wheel", "f_HβT2", ISO_1328, unit="um")
    wheel_helix: float = quantity("total helix tolerance of the wheel", "F_βT2", ISO_1328, unit="um")
    profile_slope: float = quantity(
        "profile slope of the pair", "3σ(f_Hα)", unit="um", text="three standard deviations of both gears together"
    )
    helix_slope: float = quantity(
        "helix slope of the pair", "3σ(f_Hβ)", unit="um", text="three standard deviations of both gears together"
    )


def rounded(tolerance: float) -> float:
    """Round a tolerance [um] as the standard does: above 10 to 1, from 5 to 10 to 0.5, below 5 to 0.1 (5.2.3)."""
    step = 1.0 if tolerance > 10.0 else 0.5 if tolerance >= 5.0 else 0.1
    return round(floor(tolerance / step + 0.5) * step, 1)


def single_pitch(diameter: float, module: float) -> float:
    """Single pitch tolerance f_pT of class 5 [um] at reference diameter and module [mm], not rounded."""
    return 0.001 * diameter + 0.4 * module + 5.0


def flank_tolerances(gears: GearPairInputs) -> FlankTolerances | None:
    """Tolerances of the quality class of the pair (Eq. Q1); None without a class.

    Raises InvalidInput `quality_class` if module, face width or a diameter is beyond the limits of the standard.
    """
    if gears.quality_class is None:
        return None
    pinion, wheel = (_of_gear(gears, teeth, gears.quality_class) for teeth in (gears.pinion, gears.wheel))
    return FlankTolerances(
        **{f"pinion_{name}": value for name, value in pinion.items()},
        **{f"wheel_{name}": value for name, value in wheel.items()},
        # Slopes of pinion and wheel add in the gap, and are independent: their variances add.
        profile_slope=hypot(pinion["profile_slope"], wheel["profile_slope"]),
        helix_slope=hypot(pinion["helix_slope"], wheel["helix_slope"]),
    )


def _of_gear(gears: GearPairInputs, teeth: GearTeeth, quality_class: int) -> dict[str, float]:
    """Return the tolerances of one gear [m] (Formulae 5, 7, 10, 11 and 12 of the standard, in mm and um)."""
    m_n, b = gears.normal_module * 1e3, gears.face_width * 1e3
    d = teeth.teeth * m_n / cos(gears.helix_angle)
    for (name, (least, largest)), value in zip(SCOPE.items(), (m_n, b, d), strict=True):
        if not least <= value <= largest:
            message = (
                f"the {name.replace('_', ' ')} of {value:.4g} mm is beyond the classes of ISO 1328-1 ({least:g} to "
                f"{largest:g} mm); leave out the quality class, and enter tolerances in the study"
            )
            raise InvalidInput("quality_class", message, "quality_class")
    step = sqrt(2.0) ** (quality_class - 5)
    slope, form = 0.05 * sqrt(d) + 0.35 * sqrt(b) + 4.0, 0.07 * sqrt(d) + 0.45 * sqrt(b) + 4.0
    class_5 = {
        "single_pitch": single_pitch(d, m_n),
        "profile_slope": 0.4 * m_n + 0.001 * d + 4.0,
        "helix_slope": slope,
        "helix": hypot(slope, form),  # of values that are not rounded
    }
    return {name: rounded(value * step) * 1e-6 for name, value in class_5.items()}
