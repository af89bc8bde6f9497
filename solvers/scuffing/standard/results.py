"""Results of the checks by the standard; SI units."""

from solvers.quantity import quantity, record
from solvers.scuffing.inputs import TS_6336_20, TS_6336_21, StandardEdition
from solvers.scuffing.load_factors.results import LoadFactors
from solvers.scuffing.micropitting.results import PointName


@record(equation="T9")
class FlashPoint:
    """Contact at a point of the path, by the flash temperature method."""

    point: PointName = quantity(
        "point of the path (flash temperature method)", equation="standard#flash-temperature-method"
    )
    gamma: float = quantity("profile parameter of the point", "Γ", TS_6336_20, equation="L11")
    force_ratio: float = quantity(
        "load sharing factor of the flash temperature method",
        "X_Γ",
        TS_6336_20,
        text="at B and D that of one pair in contact",
        equation="standard#flash-temperature-method",
    )
    approach_factor: float = quantity("approach factor at the point", "X_J", TS_6336_20, equation="T8")
    flash: float = quantity("flash temperature of the standard at the point", "θ_fl", TS_6336_20, unit="k")


@record(equation="standard#flash-temperature-method")
class FlashMethod:
    """Flash temperature method; the scuffing temperature has X_L of the oil temperature, as programs print it."""

    friction_coefficient: float = quantity(
        "coefficient of friction of the flash temperature method", "μ_m", TS_6336_20, equation="T6"
    )
    lubricant_factor: float = quantity(
        "lubricant factor of the flash temperature method",
        "X_L",
        TS_6336_20,
        text="at the oil temperature",
        equation="R6",
    )
    roughness_factor: float = quantity("roughness factor of the flash temperature method", "X_R", TS_6336_20)
    thermo_elastic_factor: float = quantity(
        "thermo-elastic factor of the flash temperature method",
        "X_M",
        TS_6336_20,
        text="in K N^-0.75 s^0.5 m^-0.5 mm, at the pitch point",
        equation="T5",
    )
    optimal_relief: float = quantity(
        "optimal tip relief of the flash temperature method", "C_eff", TS_6336_20, unit="um", equation="T7"
    )
    mean_flash: float = quantity("mean flash temperature of the standard", "θ_flm", TS_6336_20, unit="k", equation="T9")
    max_flash: float = quantity(
        "largest flash temperature of the standard", "θ_fl,max", TS_6336_20, unit="k", equation="T9"
    )
    bulk: float = quantity(
        "bulk temperature of the flash temperature method", "θ_M", TS_6336_20, unit="c", equation="R8"
    )
    contact: float = quantity("contact temperature of the flash temperature method", "θ_B,max", TS_6336_20, unit="c")
    scuffing: float | None = quantity(
        "scuffing temperature of the flash temperature method",
        "θ_S",
        TS_6336_20,
        unit="c",
        text="given, or by the scuffing test with X_L at the oil temperature",
        equation="R9",
    )
    safety: float | None = quantity(
        "safety factor of the flash temperature method",
        "S_B",
        TS_6336_20,
        text="null if the teeth stay as cool as the oil",
    )
    points: tuple[FlashPoint, ...] = quantity("points of the path of contact (flash temperature method)")


@record(equation="standard#integral-temperature-method")
class IntegralMethod:
    """Integral temperature method; `load_safety` says how much the load may grow."""

    friction_coefficient: float = quantity(
        "coefficient of friction of the integral temperature method", "μ_mC", TS_6336_21, equation="T10"
    )
    lubricant_factor: float = quantity("lubricant factor of the integral temperature method", "X_L", TS_6336_21)
    roughness_factor: float = quantity(
        "roughness factor of the integral temperature method", "X_R", TS_6336_21, equation="T10"
    )
    helical_factor: float = quantity(
        "helical load factor of the integral temperature method", "K_Bγ", TS_6336_21, equation="M8"
    )
    running_in_factor: float = quantity("running-in factor", "X_E", TS_6336_21)
    thermo_elastic_factor: float = quantity(
        "thermo-elastic factor of the integral temperature method",
        "X_M",
        TS_6336_21,
        text="in K N^-0.75 s^0.5 m^-0.5 mm, at the pinion's tip",
        equation="T5",
    )
    approach_factor: float = quantity("approach factor", "X_Q", TS_6336_21, equation="T13")
    geometry_factor: float = quantity("geometry factor at the pinion's tip", "X_BE", TS_6336_21, equation="T12")
    angle_factor: float = quantity("pressure angle factor", "X_αβ", TS_6336_21, equation="T11")
    contact_ratio_factor: float = quantity("contact ratio factor", "X_ε", TS_6336_21, equation="T16")
    tip_relief_factor: float = quantity("tip relief factor", "X_Ca", TS_6336_21, equation="T15")
    optimal_relief: float = quantity(
        "optimal tip relief of the integral temperature method", "C_eff", TS_6336_21, unit="um", equation="T14"
    )
    tip_flash: float = quantity(
        "flash temperature at the pinion's tip, under the whole load", "θ_flaE", TS_6336_21, unit="k"
    )
    mean_flash: float = quantity("mean flash temperature over the path", "θ_flaint", TS_6336_21, unit="k")
    bulk: float = quantity("bulk temperature of the integral temperature method", "θ_M", TS_6336_21, unit="c")
    integral: float = quantity("integral temperature", "θ_int", TS_6336_21, unit="c")
    test_bulk: float | None = quantity(
        "bulk temperature of the scuffing test",
        "θ_MT",
        TS_6336_21,
        unit="c",
        text="null without a test",
        equation="T17",
    )
    test_flash: float | None = quantity(
        "mean flash temperature of the scuffing test",
        "θ_flaintT",
        TS_6336_21,
        unit="k",
        text="null without a test",
        equation="T17",
    )
    scuffing: float | None = quantity(
        "scuffing integral temperature", "θ_intS", TS_6336_21, unit="c", text="null without a test", equation="T17"
    )
    safety: float | None = quantity(
        "safety factor of the integral temperature method",
        "S_intS",
        TS_6336_21,
        text="quotient of both temperatures in °C; null without a test",
    )
    load_safety: float | None = quantity(
        "load safety factor of the integral temperature method",
        "S_Sl",
        TS_6336_21,
        text="of the excesses over the oil; null without a test",
    )


@record(equation="standard#which-of-the-four-safety-factors")
class ScuffingStandard:
    """Scuffing by the standard: both methods with every intermediate value."""

    edition: StandardEdition = quantity("edition of the standard")
    factors: LoadFactors = quantity("load factors of the standard")
    flash: FlashMethod | None = quantity(
        "flash temperature method",
        text="null with tip or root relief, without a load sharing factor, and where the path reaches a base circle",
    )
    integral: IntegralMethod | None = quantity(
        "integral temperature method",
        text="null if C is not on the path, the contact ratio is 3 or more, or the path reaches a base circle",
    )
