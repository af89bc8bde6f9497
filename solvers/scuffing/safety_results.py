"""Results of the scuffing check, without the load distribution; SI units, read-only arrays."""

from typing import Literal

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.film import Regime
from solvers.heat_balance.results import CoolingInForce, Heat
from solvers.lubricants import OilInUse
from solvers.notices import Notice
from solvers.quantity import computed, described, quantity, record
from solvers.scuffing.inputs import ISO_TR_15144, TS_6336_20
from solvers.scuffing.load_factors.results import FilmGrade, StandardGrade
from solvers.scuffing.micropitting.results import Micropitting, Wear
from solvers.scuffing.results import Derived, Flank, LoadDistribution
from solvers.scuffing.standard.results import ScuffingStandard
from solvers.scuffing.thermal.practice import ScuffingRisk
from solvers.sources import OWN, XUE

BulkRan = Literal["given", "estimated", "between", "heat_balance"]
PointStatus = Literal["ok", "ok_with_warnings", "no_solution", "refused", "unloaded"]


@record(equation="Xue 25")
class Flash:
    """Largest flash temperatures [K] and their places.

    The places are None without load. The values by thermal EHL are None if only the closed-form formulas are evaluated.
    Fields that end in `_at_psi` state the place of the largest value on the feature line. Fields that end in
    `_at_profile` and `_at_face` [m] state the place of the largest value on the flank. If a loaded point without a
    flash temperature may be the hottest point, the largest value and its places are None.
    """

    blok_max: float | None = quantity(
        "largest flash temperature by Blok",
        "Δθ_fl,B",
        f"{XUE}, Eq. 25",
        unit="k",
        text=(
            "largest on the flank by Blok; null without a coefficient of friction, or if a loaded "
            "point has no flash temperature"
        ),
    )
    blok_at_psi: float | None = quantity(
        "place of the largest flash by Blok on the feature line", "Ψ_B", text="null without load there", equation="S1"
    )
    feature_line_max: float | None = quantity(
        "largest flash temperature by Blok on the feature line",
        "Δθ_fl,Ψ",
        f"{XUE}, Eq. 25",
        unit="k",
        text="along the paper's line A1 to E2; null if a loaded point has no flash temperature",
        default=None,
    )
    blok_at_profile: float | None = quantity(
        "profile position of the largest flash by Blok",
        "ξ_B",
        text="fraction of the path from A to E; null without load",
        default=None,
    )
    blok_at_face: float | None = quantity(
        "face position of the largest flash by Blok",
        "y_B",
        unit="mm",
        text="from the end that meshes first; null without load",
        default=None,
    )
    thermal_ehl_max: float | None = quantity(
        "largest flash temperature by thermal EHL",
        "Δθ_fl",
        f"{XUE}, Fig. 22",
        unit="k",
        text="at the decisive places of the flank; null in closed form",
        default=None,
        equation="Xue 16",
    )
    thermal_ehl_at_psi: float | None = quantity(
        "place of the largest flash by thermal EHL on the feature line", "Ψ_fl", default=None, equation="S1"
    )
    thermal_ehl_at_profile: float | None = quantity(
        "profile position of the largest flash by thermal EHL",
        "ξ_fl",
        text="fraction of the path from A to E",
        default=None,
        equation="Xue 16",
    )
    thermal_ehl_at_face: float | None = quantity(
        "face position of the largest flash by thermal EHL",
        "y_fl",
        unit="mm",
        text="from the end that meshes first",
        default=None,
        equation="Xue 16",
    )
    friction_coefficient: float | None = quantity(
        "mean coefficient of friction of the flash temperature",
        "μ_mB",
        TS_6336_20,
        text="for Blok's formula: given, or by the oil (ISO/TS 6336-20); null without both",
        default=None,
        equation="R5",
    )


@record(equation="H25")
class BulkInForce:
    """How the bulk temperature came about: the method that ran, the temperatures it had, and the balance's share."""

    bulk_method: BulkRan = quantity(
        "method of the bulk temperature that ran",
        text="given, estimated, by heat balance, or between the estimate and the balance",
    )
    bulk_estimate: float | None = quantity(
        "estimated bulk temperature",
        "θ_M,est",
        TS_6336_20,
        unit="c",
        text="null if the bulk temperature is given, without an oil, or without a mean flash temperature",
        equation="R8",
    )
    bulk_balance: float | None = quantity(
        "bulk temperature by the heat balance",
        "θ_M,bal",
        OWN,
        unit="c",
        text="mean of both flanks; null without a heat balance",
        equation="H18",
    )
    balance_share: float | None = quantity(
        "share of the heat balance",
        "s",
        OWN,
        text="0 up to 20 m/s, rising to 1 at 60 m/s; null if a method is chosen",
    )

    def bulk_at(self, balance: FloatArray) -> FloatArray:
        """Bulk temperature of the contact at another bulk temperature of the balance; in the unit of the fields."""
        if self.bulk_estimate is None or self.balance_share is None:
            return balance
        return self.bulk_estimate + self.balance_share * np.maximum(balance - self.bulk_estimate, 0.0)


@record(equation="Xue 16")
class ContactTemperature:
    """Bulk temperature t_M and largest contact temperature t_B = t_M + t_f [K] (Eq. 16).

    t_f is the flash temperature; t_B is None if t_f is None. By thermal EHL, pinion and wheel have different flash
    temperatures, and may have different bulk temperatures. t_B is then the temperature of the hotter gear.
    """

    bulk: float = quantity(
        "bulk temperature used",
        "θ_M",
        f"{XUE}, Eq. 16",
        unit="c",
        text="mean of both flanks; `derived.bulk_method` says how it came about",
        equation="R8",
    )
    blok_max: float | None = quantity(
        "contact temperature by Blok",
        "θ_B,max",
        f"{XUE}, Eq. 16",
        unit="c",
        text="by Blok; null if a loaded point has no flash temperature",
    )
    thermal_ehl_max: float | None = quantity(
        "contact temperature by thermal EHL",
        "θ_B,max,EHL",
        unit="c",
        text="by the thermal EHL solution; null in closed form",
        default=None,
    )


@record(equation="Xue 27")
class Film:
    """Thinnest film [m], its place and its ratio to the roughness.

    All values are None if no point is loaded or the loaded path reaches a base circle. `thermal_ehl_min` is that of the
    decisive places; if an unsolved place may have the thinnest film, all but `dowson_higginson_min` are None.

    Place, ratio and regime belong to `thermal_ehl_min` where it is stated, even if the other is thinner, else to
    `dowson_higginson_min`. `min_at_psi` is the place of the thinnest film on the feature line.
    """

    dowson_higginson_min: float | None = quantity(
        "thinnest film by Dowson and Higginson",
        "h_min,DH",
        f"{XUE}, Eq. 27",
        unit="um",
        text="over the flank",
        default=None,
    )
    min_at_psi: float | None = quantity(
        "place of the thinnest film on the feature line", "Ψ_h", default=None, equation="S1"
    )
    min_at_profile: float | None = quantity(
        "profile position of the thinnest film", "ξ_h", text="fraction of the path from A to E", default=None
    )
    min_at_face: float | None = quantity(
        "face position of the thinnest film", "y_h", unit="mm", text="from the end that meshes first", default=None
    )
    thickness_ratio: float | None = quantity(
        "specific film thickness",
        "λ",
        f"{XUE}, Eq. 28",
        text="minimum film over the roughness of both flanks",
        default=None,
        equation="Xue 28",
    )
    thickness_regime: Regime | None = quantity(
        "lubrication regime",
        None,
        XUE,
        text="below 1: boundary lubrication, scuffing probable; 1 to 4: mixed; above 4: full film",
        default=None,
        equation="Xue 28",
    )
    thermal_ehl_min: float | None = quantity(
        "thinnest film by thermal EHL",
        "h_min",
        unit="um",
        text="by the thermal EHL solution; null in closed form",
        default=None,
        equation="scuffing#film",
    )


@record(equation="Xue 26")
class Safety:
    """Safety factors against scuffing (Eq. 26); a factor is None if the teeth are not hotter than the oil.

    `scuffing` is the scuffing temperature [K]. `verdict` is the risk class by ISO/TS 6336-20 for Blok's factor. If the
    heat balance states a band of this factor, `verdict` is the risk class for the smallest factor in the band.
    """

    scuffing: float = quantity(
        "scuffing temperature used", "θ_S", unit="c", text="given, or by the scuffing test", equation="R9"
    )
    blok_factor: float | None = quantity(
        "safety factor (flash temperature method)",
        "S_B",
        f"{XUE}, Eq. 26",
        text="safety factor against scuffing by Blok; null if the teeth stay as cool as the oil",
    )
    feature_line_factor: float | None = quantity(
        "safety factor on the feature line (flash temperature method)",
        "S_B,Ψ",
        f"{XUE}, Eq. 26",
        text="by Blok along the paper's line A1 to E2; null if the line stays as cool as the oil",
        default=None,
    )
    thermal_ehl_factor: float | None = quantity(
        "safety factor (thermal EHL)",
        "S_B,EHL",
        text="by the thermal EHL solution of smooth flanks; null in closed form",
        default=None,
    )
    verdict: ScuffingRisk | None = quantity(
        "risk of scuffing",
        None,
        "ISO/TS 6336-20, quoted, not verified against the standard",
        text=(
            "safety below 1: high; 1 to 2: moderate; above 2: low; at the lower end of the band if there "
            "is one; null without a safety factor"
        ),
        default=None,
    )
    standard: ScuffingStandard | None = quantity(
        "scuffing by the standard",
        text="flash and integral temperature method with their own load and temperatures, beside the local check",
        default=None,
    )


@record(equation="R1")
class ScuffingDerived:
    """Values of mesh, oil and cooling that follow from the inputs; `oil` is the oil at the bulk temperature.

    `kinematic_viscosity_100` [m^2/s] and `density_15` [kg/m^3] are stated only if the oil is given by a grade or a data
    sheet; otherwise they are None.
    """

    mesh: Derived
    oil: OilInUse | None
    kinematic_viscosity_100: float | None = quantity(
        "kinematic viscosity used at 100 °C", "ν_100", unit="mm2_per_s", text="null without grade or data sheet"
    )
    density_15: float | None = quantity(
        "oil density used at 15 °C", "ρ_15", unit="kg_per_m3", text="null without grade or data sheet", equation="R3"
    )
    lubricant_factor: float | None = quantity(
        "lubricant factor of the scuffing test used",
        "X_L",
        TS_6336_20,
        text="null without a scuffing test",
        equation="R9",
    )
    bulk: BulkInForce
    standard: StandardGrade = quantity("checks by the standard, as used")
    cooling: CoolingInForce | None = quantity("cooling used", default=None, text="null without a heat balance")
    micropitting: FilmGrade | None = quantity(
        "check against micropitting, as used", text="left out without one", default=None, left_out=True
    )


@record
class ThermalPath:
    """The thermal EHL solution at the points of a line; temperatures [K], films [m], pressure [Pa], friction [-].

    All arrays except `flash_bound` and `film_bound` are NaN at points that are not solved under their own load. If the
    load at a point is too light for the solver, the point is solved under the lightest load that the solver accepts.
    This solution gives an upper bound of the flash temperature, `flash_bound` [K], and a lower bound of the film,
    `film_bound` [m].
    """

    status: tuple[PointStatus, ...]
    flash_bound: FloatArray
    film_bound: FloatArray
    pinion_flash: FloatArray = quantity(
        "flash temperature of the pinion", "Δθ_fl1", f"{XUE}, Fig. 22", unit="k", axis="psi", gaps=True
    )
    wheel_flash: FloatArray = quantity(
        "flash temperature of the wheel", "Δθ_fl2", f"{XUE}, Fig. 22", unit="k", axis="psi", gaps=True
    )
    minimum_film: FloatArray = quantity("minimum film", "h_min", f"{XUE}, Fig. 23", unit="um", axis="psi", gaps=True)
    central_film: FloatArray = quantity("central film", "h_c", unit="um", axis="psi", gaps=True)
    max_pressure: FloatArray = quantity("largest film pressure", "p_max", unit="mpa", axis="psi", gaps=True)
    friction_coefficient: FloatArray = quantity("local coefficient of friction", "μ", axis="psi", gaps=True)
    film_max_temperature: FloatArray = quantity("largest film temperature", "θ_max", unit="c", axis="psi", gaps=True)


@record
class ScuffingPath:
    """Results along a line from A to E: Blok's flash temperature [K], film [m] and its ratio to the roughness.

    The feature line is the diagonal y = psi b; the profile line lies at the face position of the hottest place. Points
    are equidistant, with the extremes of flash temperature and film by formula added.

    A point without load or motion is "unloaded" (film NaN, flash temperature 0); where the reduced radius vanishes or
    thermal EHL does not accept a point, it is "refused"; what thermal EHL cannot solve is "no_solution". `thermal` is
    None without thermal EHL; the ratio then belongs to the film by Dowson and Higginson.
    """

    psi: FloatArray = quantity(
        "position of the check", "Ψ", text="fraction of the path from A to E, and of the feature line"
    )
    status: tuple[PointStatus, ...] = quantity(
        "outcome at the point",
        text="outcome at the point; refused: outside the range of the thermal EHL solver",
        axis="psi",
    )
    blok_flash: FloatArray = quantity(
        "flash temperature by Blok",
        "Δθ_fl,B",
        f"{XUE}, Fig. 22",
        unit="k",
        text="by Blok; null at a base circle",
        axis="psi",
        gaps=True,
    )
    dowson_higginson: FloatArray = quantity(
        "film by Dowson and Higginson",
        "h_min,DH",
        f"{XUE}, Fig. 23",
        unit="um",
        text="film by Dowson and Higginson; null without load",
        axis="psi",
        gaps=True,
    )
    thickness_ratio: FloatArray = quantity(
        "local specific film thickness",
        "λ",
        f"{XUE}, Eq. 28",
        text="film over roughness; null without load",
        axis="psi",
        gaps=True,
    )
    thermal: ThermalPath | None = None
    micropitting_ratio: FloatArray | None = quantity(
        "specific film thickness against micropitting",
        "λ_GF",
        f"{ISO_TR_15144}, formula 2",
        text=(
            "film at the contact temperature over the mean roughness of both flanks; null without a "
            "micropitting check and out of contact"
        ),
        axis="psi",
        gaps=True,
        default=None,
    )


@record
class HeatedFlank(Flank):
    """Maps [profile, face] of the load distribution, of Blok's flash temperature [K] and of the film ratio.

    The flash temperature is NaN at points where the reduced radius vanishes. The film ratio is NaN at points without
    contact.
    """

    flash_temperature: FloatArray = quantity(
        "flash temperature over the flank",
        "Δθ_fl,B",
        f"{XUE}, Eq. 25",
        unit="k",
        text="by Blok; null at a base circle and without a coefficient of friction",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
    )
    micropitting_ratio: FloatArray | None = quantity(
        "specific film thickness against micropitting over the flank",
        "λ_GF",
        f"{ISO_TR_15144}, formula 2",
        text="null without a micropitting check and out of contact",
        axis=("profile_fraction", "face_fraction"),
        gaps=True,
        default=None,
    )


@record(kw_only=True, equation="scuffing#numerics")
class Scuffing:
    """Results of a scuffing check, with the load distribution on which the check is based.

    `safety` is None without a scuffing temperature, contact temperature and safety without a bulk temperature, the film
    without an oil.
    `warnings` are the warnings of the load distribution and of the check.
    """

    distribution: LoadDistribution
    flash: Flash = quantity("flash temperature")
    contact_temperature: ContactTemperature | None = quantity(
        "contact temperature", text="null without a bulk temperature, which without an oil must be given"
    )
    film: Film | None = quantity("film", text="film thickness; null without an oil or a bulk temperature")
    safety: Safety | None = quantity(
        "safety", text="safety factors; null without a scuffing temperature or a contact temperature"
    )
    path: ScuffingPath = quantity("scuffing check along the feature line", detail="curves")
    hottest_path: ScuffingPath | None = quantity(
        "scuffing check along the hottest profile",
        text="at `flash.thermal_ehl_at_face_mm`, in closed form at `flash.blok_at_face_mm`; null without load",
        detail="curves",
    )
    micropitting: Micropitting | None = quantity(
        "micropitting", text="null unless asked for, with an oil and a bulk temperature"
    )
    wear: Wear | None = quantity("wear", text="mild wear; null without a wear coefficient")
    heat: Heat | None = quantity(
        "heat balance",
        default=None,
        text="null if the bulk temperature needs no balance: given, estimated, up to 20 m/s, or without an oil",
    )
    flank_flash: FloatArray = described(
        "Flash temperature by Blok over the flank [profile, face]; NaN if it is unbounded, or if the coefficient of "
        "friction is not known [K]."
    )
    flank_film_ratio: FloatArray | None = described(
        "Film ratio against micropitting over the flank [profile, face]; None if it is not asked for [-]."
    )
    derived: ScuffingDerived = quantity("load, lengths and oil used")
    warnings: tuple[Notice, ...]
    unsolved_points: int = quantity("unsolved points", text="contacts that were refused or have no solution")

    @property
    @computed("over the flank", detail="fields")
    def flank(self) -> HeatedFlank:
        """Maps over the flank."""
        flank = self.distribution.flank
        return HeatedFlank(
            flank.profile_fraction,
            flank.face_fraction,
            flank.modification,
            flank.line_load,
            flank.pressure,
            self.flank_flash,
            self.flank_film_ratio,
        )
