"""The load factors in the checks by the standard against scuffing and micropitting."""

from solvers.quantity import quantity, record
from solvers.scuffing.inputs import ISO_TR_15144, TS_6336_20
from solvers.sources import ISO_1328, ISO_6336

METHOD_B = f"{ISO_6336}:2006, method B, as read in a public implementation"


@record(equation="T3")
class LoadFactors:
    """Load factors of the checks by the standard, and the line load that they make."""

    dynamic_factor: float = quantity(
        "dynamic factor of the standard", "K_v", METHOD_B, text="given, or by method B at the resonance ratio"
    )
    resonance_ratio: float = quantity(
        "resonance ratio",
        "N",
        METHOD_B,
        text="pinion speed over that of the main resonance, of solid discs",
        equation="T2",
    )
    transverse_load_factor: float = quantity(
        "transverse load factor of the standard", "K_Hα", METHOD_B, text="given, or by method B", equation="T4"
    )
    face_load_factor: float = quantity(
        "face load factor of the standard", "K_Hβ", text="given, or that of the load distribution", equation="L17"
    )
    line_load: float = quantity(
        "transverse unit load of the standard",
        "w_Bt",
        TS_6336_20,
        unit="n_per_mm",
        text="K_A K_γ K_v K_Hβ K_Hα F_t/b",
        equation="standard#load-factors",
    )

    @property
    def product(self) -> float:
        """K_v K_Hbeta K_Halpha [-]."""
        return self.dynamic_factor * self.face_load_factor * self.transverse_load_factor


@record(equation="T1")
class StandardGrade:
    """The quality grade of the checks by the standard against scuffing, and of their load factors."""

    quality_grade: int = quantity(
        "quality grade used for the standard", "A", ISO_1328, text="given, or the quality class of the gears, else 7"
    )


@record(equation="M12")
class FilmGrade:
    """The quality grade of the load sharing of method B."""

    quality_grade: int = quantity(
        "quality grade used", "Q", ISO_TR_15144, text="given, or the quality class of the gears, else 7"
    )
