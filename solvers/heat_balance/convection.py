"""Convection between a rotating gear and air, at the rim and at the faces of the gear.

The network of the heat balance multiplies the coefficients for air by a factor, because the gears rotate in oil mist.
"""

RECOVERY = 0.88  # recovery factor of a turbulent boundary layer
AIR_HEAT = 1006.0  # J/(kg K)


def rim_convection(speed: float, radius: float) -> float:
    """Heat transfer coefficient 3.75 omega^0.7 r_a^0.4 of the rim, a rotating cylinder; speed > 0 (Eq. H16).

    In W/(m^2 K), after Jungnickel; agrees with Becker within 12 %.
    """
    return float(3.75 * speed**0.7 * radius**0.4)


def face_convection(speed: float, radius: float) -> float:
    """Heat transfer coefficient 2.73 omega^0.8 r_a^0.6 of a face, a rotating disc; speed > 0 (Eq. H16).

    In W/(m^2 K), after Jungnickel; agrees with the free disc within 5 %.
    """
    return float(2.73 * speed**0.8 * radius**0.6)


def recovery_rise(speed: float, radius: float, recovery: float = RECOVERY) -> float:
    """Rise 0.88 (omega r_a)^2/(2 c_p) of the mist by air friction at the tooth tips [K] (Eq. H16)."""
    return recovery * (speed * radius) ** 2 / (2 * AIR_HEAT)
