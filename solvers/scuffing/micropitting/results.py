"""Results of the checks against micropitting and wear; SI units, read-only arrays."""

from typing import Literal

from solvers.arrays import FloatArray
from solvers.quantity import quantity, record
from solvers.scuffing.inputs import ISO_TR_15144
from solvers.scuffing.load_factors.results import LoadFactors

PointName = Literal["A", "AB", "B", "C", "D", "DE", "E"]
Verdict = Literal["micropitting is likely", "limited margin", "micropitting is unlikely"]


@record(equation="M14")
class FilmOfTest:
    """The film between the test gears C-GF with the oil of the pair, at the load stage at which this oil fails."""

    ratio: float = quantity(
        "specific film thickness of the micropitting test",
        "λ_GFT",
        ISO_TR_15144,
        text="smallest of the test gears at the failure load stage",
    )
    bulk: float = quantity("bulk temperature of the micropitting test", "θ_M,T", ISO_TR_15144, unit="c", equation="M11")
    friction_coefficient: float = quantity(
        "coefficient of friction of the micropitting test", "μ_T", ISO_TR_15144, equation="M9"
    )
    torque: float = quantity("pinion torque of the micropitting test", "T_1,T", ISO_TR_15144, unit="n_m")
    at_point: PointName = quantity("place of the thinnest film of the micropitting test", text="point of the path")


@record(equation="M7")
class LocalPoint:
    """The film at a point of the feature line.

    If the flanks do not touch at this point, film ratio and safety factor are None.
    """

    point: PointName = quantity("point of the feature line", equation="micropitting#method-a-the-own-load")
    psi: float = quantity(
        "position of the point",
        "Ψ",
        text="fraction of the path, and of the feature line",
        equation="micropitting#method-a-the-own-load",
    )
    ratio: float | None = quantity(
        "specific film thickness at the point", "λ_GF", ISO_TR_15144, text="null out of contact"
    )
    safety: float | None = quantity(
        "safety factor against micropitting at the point", "S_λ", ISO_TR_15144, text="null without a permissible ratio"
    )


@record(equation="M7")
class LocalFilm:
    """Film over the flank by method A, under the computed load distribution. Unknown values are None."""

    safety: float | None = quantity(
        "safety factor against micropitting",
        "S_λ",
        f"{ISO_TR_15144}, formula 1",
        text="least over the flank, by its own load (method A); null without a permissible ratio, load or film",
    )
    least_ratio: float | None = quantity(
        "least specific film thickness against micropitting",
        "λ_GF,min",
        f"{ISO_TR_15144}, formula 2",
        text="film over the mean roughness of both flanks, least over the flank; null without load, or where the "
        "loaded path reaches a base circle",
    )
    at_psi: float | None = quantity(
        "profile position of the thinnest film against micropitting",
        "ξ_λ",
        text="fraction of the path from A to E",
        equation="micropitting#method-a-the-own-load",
    )
    at_face: float | None = quantity(
        "face position of the thinnest film against micropitting",
        "y_λ",
        unit="mm",
        text="from the end that meshes first",
        equation="micropitting#method-a-the-own-load",
    )
    verdict: Verdict | None = quantity(
        "risk of micropitting",
        None,
        "common practice",
        text="safety below 1: likely; 1 to 2: limited margin; above 2: unlikely; null without a safety factor",
    )
    friction_coefficient: float | None = quantity(
        "coefficient of friction against micropitting",
        "μ_λ",
        f"{ISO_TR_15144}, formula 86",
        text="given, or by ISO/TR 15144-1 with the computed K_Hβ; null without load",
        equation="M9",
    )
    thermal_ehl_ratio: float | None = quantity(
        "least specific film thickness by thermal EHL",
        "λ_EHL,min",
        text="film by thermal EHL over the mean roughness, at the decisive places; null in closed form",
        equation="micropitting#method-a-the-own-load",
    )
    points: tuple[LocalPoint, ...] = quantity("film against micropitting at the points of the feature line")


@record(equation="M7")
class StandardPoint:
    """Contact and film at a point of the path, by method B."""

    point: PointName = quantity("point of the path", equation="micropitting#method-b-the-standard")
    force_ratio: float = quantity(
        "load sharing factor of the standard", "X", f"{ISO_TR_15144}, formulas 46 to 48", equation="M16"
    )
    pressure: float = quantity(
        "Hertzian pressure of the standard", "p_dyn", f"{ISO_TR_15144}, formulas 24 and 25", unit="mpa", equation="M13"
    )
    flash: float = quantity(
        "flash temperature of the standard", "θ_fl", f"{ISO_TR_15144}, formula 80", unit="k", equation="M4"
    )
    film: float = quantity("film of the standard", "h", f"{ISO_TR_15144}, formula 4", unit="um", equation="M6")
    ratio: float = quantity("specific film thickness of the standard", "λ_GF", f"{ISO_TR_15144}, formula 2")
    safety: float | None = quantity(
        "safety factor against micropitting of the standard at the point",
        "S_λ",
        f"{ISO_TR_15144}, formula 1",
        text="null without a permissible ratio",
    )


@record(equation="M7")
class StandardFilm:
    """Results of method B at seven points of a pair without relief, with the load factors of the standard."""

    friction_coefficient: float = quantity(
        "coefficient of friction of the standard", "μ_m", f"{ISO_TR_15144}, formula 86", equation="M9"
    )
    bulk: float = quantity(
        "bulk temperature of the standard", "θ_M", f"{ISO_TR_15144}, formula 84", unit="c", equation="M11"
    )
    loss_factor: float = quantity("loss factor of the standard", "H_v", f"{ISO_TR_15144}, formula 91", equation="M10")
    least_ratio: float = quantity("least specific film thickness of the standard", "λ_GF,min", ISO_TR_15144)
    safety: float | None = quantity(
        "safety factor against micropitting of the standard",
        "S_λ,B",
        f"{ISO_TR_15144}, formula 1",
        text="method B; null without a permissible ratio",
    )
    points: tuple[StandardPoint, ...] = quantity("points of the path of contact")
    factors: LoadFactors = quantity("load factors of the standard")


@record(equation="M14")
class Micropitting:
    """The film over the flanks, compared with the film that the micropitting test of the oil requires."""

    permissible_ratio: float | None = quantity(
        "permissible specific film thickness",
        "λ_GFP",
        f"{ISO_TR_15144}, formula 3",
        text="given, or by the test; null with neither",
    )
    test: FilmOfTest | None = quantity("micropitting test", text="null without a failure load stage")
    local: LocalFilm = quantity("film by the own load (method A)")
    standard: StandardFilm | None = quantity(
        "film by the standard (method B)",
        text="null with tip or root relief, and for transverse contact ratios below 1 and above 2",
    )


@record(equation="M15")
class Wear:
    """Depth of wear of each gear per revolution of the gear [m].

    For each gear there are three results: the largest depth over the flank with its place, the largest depth over the
    face at every position of the path, and a map [profile, face] of the depth.
    """

    pinion_max: float | None = quantity(
        "largest wear of the pinion", "δ_W1", unit="um_per_million", text="null where the path reaches a base circle"
    )
    pinion_at_psi: float | None = quantity(
        "profile position of the pinion's largest wear", "ξ_W1", text="fraction of the path from A to E"
    )
    pinion_at_face: float | None = quantity(
        "face position of the pinion's largest wear", "y_W1", unit="mm", text="from the end that meshes first"
    )
    wheel_max: float | None = quantity(
        "largest wear of the wheel", "δ_W2", unit="um_per_million", text="null where the path reaches a base circle"
    )
    wheel_at_psi: float | None = quantity(
        "profile position of the wheel's largest wear", "ξ_W2", text="fraction of the path from A to E"
    )
    wheel_at_face: float | None = quantity(
        "face position of the wheel's largest wear", "y_W2", unit="mm", text="from the end that meshes first"
    )
    psi: FloatArray = quantity(
        "profile position of the wear", "ξ", text="fraction of the path from A to E", detail="curves"
    )
    pinion: FloatArray = quantity(
        "wear of the pinion",
        "δ_W1",
        "Archard",
        unit="um_per_million",
        text="largest over the face; null next to a base circle",
        detail="curves",
        axis="psi",
        gaps=True,
    )
    wheel: FloatArray = quantity(
        "wear of the wheel",
        "δ_W2",
        "Archard",
        unit="um_per_million",
        text="largest over the face; null next to a base circle",
        detail="curves",
        axis="psi",
        gaps=True,
    )
    pinion_map: FloatArray = quantity(
        "wear of the pinion over the flank",
        "δ_W1",
        "Archard",
        unit="um_per_million",
        text="null next to a base circle",
        detail="fields",
        axis=("flank.profile_fraction", "flank.face_fraction"),
        gaps=True,
    )
    wheel_map: FloatArray = quantity(
        "wear of the wheel over the flank",
        "δ_W2",
        "Archard",
        unit="um_per_million",
        text="null next to a base circle",
        detail="fields",
        axis=("flank.profile_fraction", "flank.face_fraction"),
        gaps=True,
    )
