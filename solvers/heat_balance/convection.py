"""Convection between a rotating gear and air, at the rim and at the faces of the gear.

The network of the heat balance multiplies the coefficients for air by a factor, because the gears rotate in oil mist.
"""

RECOVERY = 0.88  # recovery factor of a turbulent boundary layer
AIR_HEAT = 1006.0  # J/(kg K)


def rim_convection(speed: float, radius: float) -> float:
    """Compute the heat transfer coefficient of the rim, which is a rotating cylinder [W/(m^2 K)].

    Eq. H16: 3.75 omega^0.7 r_a^0.4, after Jungnickel. The result agrees with the formula of Becker within 12 %.
    `speed`: speed of the gear, positive [rad/s]. Returns heat transfer coefficient [W/(m^2 K)].
    """
    return float(3.75 * speed**0.7 * radius**0.4)


def face_convection(speed: float, radius: float) -> float:
    """Compute the heat transfer coefficient of a face, which is a rotating disc [W/(m^2 K)].

    Eq. H16: 2.73 omega^0.8 r_a^0.6, after Jungnickel. The result agrees with the formula for a free disc within 5 %.
    `speed`: speed of the gear, positive [rad/s]. Returns heat transfer coefficient [W/(m^2 K)].
    """
    return float(2.73 * speed**0.8 * radius**0.6)


def recovery_rise(speed: float, radius: float, recovery: float = RECOVERY) -> float:
    """Compute the temperature rise that air friction at the tooth tips causes in the mist [K].

    Eq. H16: 0.88 (omega r_a)^2/(2 c_p), where c_p is the specific heat of air. `speed`: speed of the gear, positive
    [rad/s].
    """
    return recovery * (speed * radius) ** 2 / (2 * AIR_HEAT)
