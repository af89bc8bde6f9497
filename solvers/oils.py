"""Oils as users describe them: by ISO grade, by data sheet, or by the viscosity at one temperature.

A data sheet states two kinematic viscosities; the viscosity index follows from both (ASTM D2270, ISO 2909). The models
use a `Lubricant`, which `OilSheet.lubricant` computes for the temperature at which the oil enters a contact.
"""

from dataclasses import dataclass
from math import log, log10
from typing import Literal, TypeVar, get_args

import numpy as np
from scipy.optimize import brentq

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.quantity import described, quantity, record

Temperature = TypeVar("Temperature", float, FloatArray)

SQUARE_MILLIMETRE = 1e-6  # m^2
ROUNDED_ZERO = 273.0  # K, zero of the Celsius scale in ISO/TR 15144-1; the exact zero is 273.15 K
LEAST_VISCOSITY = 2.0
"""Smallest kinematic viscosity at 100 C [mm^2/s] for which the standard defines the viscosity index."""

REFERENCE_OILS = (
    (2.0, (1.14673, 1.7576, -0.109), (0.84155, 1.5521, -0.077)),
    (3.8, (3.38095, -15.4952, 33.196), (0.78571, 1.7929, -0.183)),
    (4.4, (2.5, -7.2143, 13.812), (0.82143, 1.5679, 0.119)),
    (5.0, (0.101, 16.635, -45.469), (0.04985, 9.1613, -18.557)),
    (6.4, (3.35714, -23.5643, 78.466), (0.22619, 7.7369, -16.656)),
    (7.0, (0.01191, 21.475, -72.870), (0.79762, -0.7321, 14.610)),
    (7.7, (0.41858, 16.1558, -56.040), (0.05794, 10.5156, -28.240)),
    (9.0, (0.88779, 7.5527, -16.600), (0.26665, 6.7015, -10.810)),
    (12.0, (0.76720, 10.7972, -38.180), (0.20073, 8.4658, -22.490)),
    (15.0, (0.97305, 5.3135, -2.200), (0.28889, 5.9741, -4.930)),
    (18.0, (0.97256, 5.2500, -0.980), (0.24504, 7.4160, -16.730)),
    (22.0, (0.91413, 7.4759, -21.820), (0.20323, 9.1267, -34.230)),
    (28.0, (0.87031, 9.7157, -50.770), (0.18411, 10.1015, -46.750)),
    (40.0, (0.84703, 12.6752, -133.310), (0.17029, 11.4866, -80.620)),
    (55.0, (0.85921, 11.1009, -83.190), (0.17130, 11.3680, -76.940)),
    (70.0, (0.83531, 14.6731, -216.246), (0.16841, 11.8493, -96.947)),
)
"""Each row holds a smallest viscosity at 100 C [mm^2/s], the coefficients (a, b, c) of L, and the coefficients of H.

A row is valid from its smallest viscosity up to the smallest viscosity of the next row. L = a Y^2 + b Y + c, where Y is
the viscosity at 100 C; the formula of H is the same. L and H are viscosities at 40 C [mm^2/s]. Among the oils with the
same Y, the oil with the viscosity L at 40 C has the index 0, and the oil with the viscosity H at 40 C has the index 100
(ASTM D2270, Table X2.1; taken from a public implementation).
"""


def viscosity_index(viscosity_40: float, viscosity_100: float) -> float:
    """Viscosity index 100 (L - U)/(L - H); above 100, 100 + (10^N - 1)/0.00715 with N = log(H/U)/log Y [-] (Eq. R2).

    L and H follow from Y (`REFERENCE_OILS`); below 2 mm^2/s, where the standard has none, from the first row.
    """
    u, y = viscosity_40 / SQUARE_MILLIMETRE, viscosity_100 / SQUARE_MILLIMETRE
    _, low, high = max((row for row in REFERENCE_OILS if row[0] <= y), default=REFERENCE_OILS[0])
    l_40, h_40 = (a * y**2 + b * y + c for a, b, c in (low, high))
    if u >= h_40 or y < LEAST_VISCOSITY:
        return 100.0 * (l_40 - u) / (l_40 - h_40)
    return 100.0 + float(10.0 ** (log10(h_40 / u) / log10(y)) - 1.0) / 0.00715


def viscosity_of_index(viscosity_40: float, index: float) -> float:
    """Kinematic viscosity at 100 C of an oil of this index [m^2/s], else InvalidInput `viscosity_index` (Eq. R2)."""
    thick = viscosity_40 / SQUARE_MILLIMETRE

    def excess(thin: float) -> float:
        return viscosity_index(viscosity_40, thin * SQUARE_MILLIMETRE) - index

    least, largest = LEAST_VISCOSITY, thick * (1.0 - 1e-9)
    if not (least < largest and excess(least) <= 0.0 <= excess(largest)):
        message = (
            f"an oil with {thick:.4g} mm²/s at 40 °C cannot have a viscosity index of {index:.4g}. The index is "
            "defined only for oils with at least 2 mm²/s at 100 °C; give the viscosity at 100 °C instead of the index"
        )
        raise InvalidInput("viscosity_index", message, "lubricant.viscosity_index")
    return float(brentq(excess, least, largest, xtol=1e-12)) * SQUARE_MILLIMETRE


IsoGrade = Literal[10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500]
GRADES: tuple[int, ...] = get_args(IsoGrade)

CELSIUS = 273.15  # K
WALTHER_SHIFT = 0.7  # mm^2/s
DENSITY_TEMPERATURE = 15.0 + CELSIUS  # K
THERMAL_EXPANSION = 0.00065  # 1/K
LEAST_VISCOSITY_100 = 1e-6  # m^2/s; ASTM D341 has further terms for thinner oils
VISCOSITY_INDICES = (-100.0, 500.0)  # naphthenic and aromatic oils reach -100, silicone oils reach 400
LARGEST_VISCOSITY = 0.1  # m^2/s; an oil this thick hardly flows, and the Walther law contains no pour point

TYPICAL_INDEX: dict[OilKind, tuple[tuple[float, float], ...]] = {
    "mineral": ((100.0, 95.0),),
    "pao": (
        (32.0, 145.0),
        (46.0, 155.0),
        (68.0, 165.0),
        (100.0, 160.0),
        (150.0, 170.0),
        (220.0, 170.0),
        (320.0, 175.0),
        (460.0, 175.0),
        (680.0, 180.0),
        (1000.0, 190.0),
    ),
    "ester": ((100.0, 150.0),),
    "polyglycol": ((100.0, 210.0),),
}
"""Typical viscosity index over the viscosity at 40 C [mm^2/s]; linear in its logarithm, constant beyond the ends.

PAO: mean of the data sheets of each grade in `named_oils`, to the nearest 5. Polyglycol: the sheets read have 203 to
290, at VG 220 203 and 208. No sheet of an ester gear oil was read.
"""

MINERAL_VISCOSITY_100 = {
    32: 5.4e-6,
    46: 6.8e-6,
    68: 8.7e-6,
    100: 11.2e-6,
    150: 14.8e-6,
    220: 19.0e-6,
    320: 24.2e-6,
    460: 30.6e-6,
    680: 38.8e-6,
}
"""Typical kinematic viscosity at 100 C [m^2/s] of a mineral oil of each ISO 3448 grade.

The viscosity index of these oils is 94 to 102.
"""


@dataclass(frozen=True, slots=True)
class KindOfOil:
    """Typical properties of a kind of oil, in SI units; Gold's law alpha = s nu^t has s in 1/GPa at 1 mm^2/s."""

    pressure_viscosity_scale: float
    pressure_viscosity_exponent: float
    density_15: float
    specific_heat: float
    thermal_conductivity: float


# Typical values; Gold's coefficients are quoted from a secondary source.
KINDS: dict[OilKind, KindOfOil] = {
    "mineral": KindOfOil(9.904, 0.1390, 880.0, 2000.0, 0.14),
    "pao": KindOfOil(7.382, 0.1335, 840.0, 2150.0, 0.15),
    "ester": KindOfOil(6.605, 0.1360, 950.0, 2000.0, 0.15),
    "polyglycol": KindOfOil(5.489, 0.1485, 1030.0, 2000.0, 0.17),
}


_THICK, _THIN = "lubricant.kinematic_viscosity_40", "lubricant.kinematic_viscosity_100"


def over_coefficient_at_38(temperature: Temperature) -> Temperature:
    """Pressure-viscosity coefficient at a temperature [K] over that at 38 C (Eq. M3); 0 above 510 C."""
    value = 1.0 + 516.0 * (1.0 / (temperature - CELSIUS + ROUNDED_ZERO) - 1.0 / (38.0 + ROUNDED_ZERO))
    return value * (value > 0.0)


@record
class OilSheet:
    """An oil, described by its data sheet.

    If a value is None, this value is computed from the kind of oil and from both viscosities. The function `iso_vg`
    makes an `OilSheet` for an ISO grade. The function `sheet_of_index` makes an `OilSheet` from the viscosity index if
    the viscosity at 100 C is not known.
    """

    kinematic_viscosity_40: float = quantity(
        "kinematic viscosity at 40 °C", "ν_40", "ASTM D341", unit="mm2_per_s", ge=2, le=5000
    )
    kinematic_viscosity_100: float = quantity(
        "kinematic viscosity at 100 °C", "ν_100", "ASTM D341", unit="mm2_per_s", ge=1, le=1000
    )
    kind: OilKind = quantity(
        "kind of oil",
        default="mineral",
        assumed="mineral oil; the request names no kind",
        if_above=(
            "other oils, such as a phosphate ester, have no laws here; enter viscosity, density and pressure-viscosity "
            "coefficient as a lubricant, with a measured coefficient of friction"
        ),
    )
    density_15: float | None = quantity(
        "oil density at 15 °C",
        "ρ_15",
        unit="kg_per_m3",
        default=None,
        ge=500,
        le=2000,
        default_text="by the kind of oil; few data sheets state it",
        assumed="by the kind of oil; few data sheets state it",
    )
    pressure_viscosity: float | None = described(
        "Pressure-viscosity coefficient of Barus; None: by kind and viscosity, after Gold [1/Pa].", default=None
    )
    pressure_viscosity_38: float | None = quantity(
        "pressure-viscosity coefficient at 38 °C",
        "α_38",
        "ISO/TR 15144-1",
        unit="per_gpa",
        default=None,
        ge=1,
        le=60,
        text="converted to the temperature where the oil enters",
        default_text="by kind and viscosity",
    )
    temperature_viscosity: float | None = described(
        "Temperature-viscosity coefficient of Reynolds; None: the slope of the Walther law [1/K].", default=None
    )
    specific_heat: float | None = described("Specific heat; None: typical of the kind [J/(kg K)].", default=None)
    thermal_conductivity: float | None = described(
        "Thermal conductivity; None: typical of the kind [W/(m K)].", default=None
    )
    pressure_viscosity_law: PressureViscosityLaw = described("Law of the viscosity over pressure.", default="roelands")
    compressible: bool = described("Whether the density depends on pressure and temperature.", default=True)

    def __post_init__(self) -> None:
        """Refuse viscosities that no oil has (`out_of_range`, `viscosity_order`, `viscosity_index`)."""
        thick, thin, field = self.kinematic_viscosity_40, self.kinematic_viscosity_100, _THIN
        if not thin >= LEAST_VISCOSITY_100:
            raise InvalidInput("out_of_range", "the viscosity of the oil at 100 °C must be at least 1 mm²/s", field)
        if not thin < thick:
            raise InvalidInput(
                "viscosity_order", "the viscosity of the oil at 100 °C must be lower than its viscosity at 40 °C", field
            )
        index, (least, largest) = self.viscosity_index, VISCOSITY_INDICES
        if not least <= index <= largest:
            message = (
                f"viscosities of {thick / SQUARE_MILLIMETRE:.4g} mm²/s at 40 °C and {thin / SQUARE_MILLIMETRE:.4g} "
                f"mm²/s at 100 °C correspond to a viscosity index of {index:.3g}, but oils have an index from "
                f"{least:g} to {largest:g}; check both viscosities"
            )
            raise InvalidInput("viscosity_index", message, field)

    def kinematic_viscosity(self, temperature: float) -> float:
        """Kinematic viscosity by the Walther law (ASTM D341) [m^2/s]; `oil_too_thick` above 10^5 mm^2/s (Eq. R1)."""
        logarithm = self._logarithm(temperature)
        if logarithm > log10(LARGEST_VISCOSITY / SQUARE_MILLIMETRE):
            message = (
                f"according to its viscosities at 40 and 100 °C the oil would have 10^{logarithm:.1f} mm²/s at "
                f"{temperature - CELSIUS:.4g} °C. Above 10^5 mm²/s oil hardly flows; raise the temperature or choose "
                "an oil of lower viscosity"
            )
            raise InvalidInput("oil_too_thick", message, _THICK)
        return float(10.0**logarithm - WALTHER_SHIFT) * SQUARE_MILLIMETRE

    @property
    def reference_density(self) -> float:
        """Density at 15 C [kg/m^3]: the density in the data sheet, or else a density typical of the kind of oil."""
        return KINDS[self.kind].density_15 if self.density_15 is None else self.density_15

    @property
    def viscosity_index(self) -> float:
        """Viscosity index that follows from both viscosities (ASTM D2270) [-]."""
        return viscosity_index(self.kinematic_viscosity_40, self.kinematic_viscosity_100)

    def density(self, temperature: float) -> float:
        """Density rho_15 [1 - 0.00065 (t - 15 C)] [kg/m^3] (Eq. R3)."""
        return self.reference_density * (1.0 - THERMAL_EXPANSION * (temperature - DENSITY_TEMPERATURE))

    def viscosity(self, temperature: float) -> float:
        """Dynamic viscosity nu rho [Pa s] (Eq. R3)."""
        return self.kinematic_viscosity(temperature) * self.density(temperature)

    def temperature_coefficient(self, temperature: float) -> float:
        """Temperature-viscosity coefficient of the data sheet, else beta = -d ln eta/dt [1/K] (Eq. R4)."""
        if self.temperature_viscosity is not None:
            return self.temperature_viscosity
        viscosity = self.kinematic_viscosity(temperature) / SQUARE_MILLIMETRE
        _, slope = self.walther()
        thinning = log(10.0) * (1.0 + WALTHER_SHIFT / viscosity) * self._logarithm(temperature) * slope / temperature
        expansion = THERMAL_EXPANSION / (1.0 - THERMAL_EXPANSION * (temperature - DENSITY_TEMPERATURE))
        return float(thinning + expansion)

    def pressure_coefficient(self, temperature: float) -> float:
        """Pressure-viscosity coefficient of the data sheet, else Gold's alpha = s nu^t [1/Pa] (Eq. R4).

        One at 38 C is converted by Eq. M3. `KindOfOil` has s and t, with nu in mm^2/s.
        """
        if self.pressure_viscosity is not None:
            return self.pressure_viscosity
        if self.pressure_viscosity_38 is not None:
            return float(self.pressure_viscosity_38 * over_coefficient_at_38(temperature))
        kind = KINDS[self.kind]
        thickness = self.kinematic_viscosity(temperature) / SQUARE_MILLIMETRE
        return float(kind.pressure_viscosity_scale * thickness**kind.pressure_viscosity_exponent) * 1e-9

    def lubricant(self, temperature: float) -> Lubricant:
        """Return this oil as a `Lubricant`; the reference temperature of the `Lubricant` is `temperature` [K]."""
        kind = KINDS[self.kind]
        return Lubricant(
            viscosity=self.viscosity(temperature),
            reference_temperature=temperature,
            pressure_viscosity=self.pressure_coefficient(temperature),
            temperature_viscosity=self.temperature_coefficient(temperature),
            density=self.density(temperature),
            specific_heat=kind.specific_heat if self.specific_heat is None else self.specific_heat,
            thermal_conductivity=(
                kind.thermal_conductivity if self.thermal_conductivity is None else self.thermal_conductivity
            ),
            pressure_viscosity_law=self.pressure_viscosity_law,
            compressible=self.compressible,
            kind=self.kind,
            viscosity_index=self.viscosity_index,
        )

    def walther(self) -> tuple[float, float]:
        """Constants A and B of log10 log10 (nu + 0.7) = A - B log10 T, with nu in mm^2/s and T in kelvin."""
        cold, hot = 40.0 + CELSIUS, 100.0 + CELSIUS
        thick = _double_logarithm(self.kinematic_viscosity_40)
        thin = _double_logarithm(self.kinematic_viscosity_100)
        slope = (thick - thin) / (log10(hot) - log10(cold))
        return thick + slope * log10(cold), slope

    def _logarithm(self, temperature: float) -> float:
        """Return log10 (nu + 0.7) at a temperature [K], with nu in mm^2/s."""
        intercept, slope = self.walther()
        return float(10.0 ** (intercept - slope * log10(temperature)))


def iso_vg(
    grade: int, kind: OilKind = "mineral", viscosity_index: float | None = None, density_15: float | None = None
) -> OilSheet:
    """Return an oil of an ISO 3448 grade.

    Parameters
    ----------
    grade : int
        Grade; this number is the kinematic viscosity at 40 C in mm^2/s.
    kind : {"mineral", "pao", "ester", "polyglycol"}
        Kind of oil.
    viscosity_index : float, optional
        Viscosity index; if None, a value typical of the grade and the kind is used [-].
    density_15 : float, optional
        Density at 15 C; if None, a value typical of the kind is used [kg/m^3].

    Returns
    -------
    OilSheet
        The oil.

    Raises
    ------
    InvalidInput
        `viscosity_index` if no oil of this grade has this index.

    Examples
    --------
    >>> round(iso_vg(46).viscosity(313.15), 4)
    0.0398
    """
    thick = grade * SQUARE_MILLIMETRE
    thin = MINERAL_VISCOSITY_100.get(grade) if kind == "mineral" and viscosity_index is None else None
    return OilSheet(thick, thin, kind, density_15) if thin else sheet_of_index(thick, viscosity_index, kind, density_15)


def sheet_of_index(
    viscosity_40: float,
    viscosity_index: float | None = None,
    kind: OilKind = "mineral",
    density_15: float | None = None,
) -> OilSheet:
    """Oil of a viscosity at 40 C and a viscosity index; index and density typical of the kind if None.

    Raises InvalidInput: `viscosity_index` if no oil of this viscosity has this index.
    """
    index = typical_index(kind, viscosity_40) if viscosity_index is None else viscosity_index
    return OilSheet(viscosity_40, viscosity_of_index(viscosity_40, index), kind, density_15)


def typical_index(kind: OilKind, viscosity_40: float) -> float:
    """Viscosity index typical of a kind of oil at a kinematic viscosity [m^2/s] at 40 C [-] (`TYPICAL_INDEX`)."""
    viscosities, indices = zip(*TYPICAL_INDEX[kind], strict=True)
    return float(np.interp(log(viscosity_40 / SQUARE_MILLIMETRE), np.log(viscosities), indices))


def lubricant_at(oil: Lubricant | OilSheet, temperature: float) -> Lubricant:
    """The oil as the lubricant of a contact with this inlet temperature [K]; a `Lubricant` stays as it is."""
    return oil.lubricant(temperature) if isinstance(oil, OilSheet) else oil


def _double_logarithm(kinematic_viscosity: float) -> float:
    return log10(log10(kinematic_viscosity / SQUARE_MILLIMETRE + WALTHER_SHIFT))
