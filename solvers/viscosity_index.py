"""The viscosity index of an oil (ASTM D2270, ISO 2909): how little its viscosity changes between 40 C and 100 C."""

from math import log10

SQUARE_MILLIMETRE = 1e-6  # m^2
LEAST_VISCOSITY = 2.0
"""Kinematic viscosity at 100 C [mm^2/s] from which the standard defines the index."""

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
"""From a viscosity Y at 100 C [mm^2/s] on: a, b, c of L = a Y^2 + b Y + c and of H, the viscosities at 40 C [mm^2/s]
of the oils of index 0 and 100 with that Y (ASTM D2270, Table X2.1; read in a public implementation)."""


def viscosity_index(viscosity_40: float, viscosity_100: float) -> float:
    """Viscosity index of an oil of kinematic viscosities U at 40 C and Y at 100 C [m^2/s] (Eq. R2).

    100 (L - U)/(L - H) up to an index of 100, beyond it 100 + (10^N - 1)/0.00715 with N = log(H/U)/log Y. Below
    Y = 2 mm^2/s, where the standard defines none, the first formula is used with the first of the reference oils.
    """
    u, y = viscosity_40 / SQUARE_MILLIMETRE, viscosity_100 / SQUARE_MILLIMETRE
    _, low, high = max((row for row in REFERENCE_OILS if row[0] <= y), default=REFERENCE_OILS[0])
    l_40, h_40 = (a * y**2 + b * y + c for a, b, c in (low, high))
    if u >= h_40 or y < LEAST_VISCOSITY:
        return 100.0 * (l_40 - u) / (l_40 - h_40)
    return 100.0 + float(10.0 ** (log10(h_40 / u) / log10(y)) - 1.0) / 0.00715
