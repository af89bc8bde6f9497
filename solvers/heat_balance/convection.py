"""Convection between a rotating gear and air, at the rim and at the faces of the gear.

The network of the heat balance multiplies the coefficients for air by a factor, because the gears rotate in oil mist.
"""

RECOVERY = 0.88  # recovery factor of a turbulent boundary layer
AIR_HEAT = 1006.0  # J/(kg K)


def rim_convection(speed: float, radius: float) -> float:
    """Compute the heat transfer coefficient of the rim, which is a rotating cylinder.

    Parameters
    ----------
    speed : float
        Speed of the gear, positive [rad/s].
    radius : float
        Tip radius [m].

    Returns
    -------
    float
        Heat transfer coefficient [W/(m^2 K)].

    Notes
    -----
    Eq. H16: 3.75 omega^0.7 r_a^0.4, after Jungnickel. The result agrees with the formula of Becker within 12 %.
    """
    return float(3.75 * speed**0.7 * radius**0.4)


def face_convection(speed: float, radius: float) -> float:
    """Compute the heat transfer coefficient of a face, which is a rotating disc.

    Parameters
    ----------
    speed : float
        Speed of the gear, positive [rad/s].
    radius : float
        Tip radius [m].

    Returns
    -------
    float
        Heat transfer coefficient [W/(m^2 K)].

    Notes
    -----
    Eq. H16: 2.73 omega^0.8 r_a^0.6, after Jungnickel. The result agrees with the formula for a free disc within 5 %.
    """
    return float(2.73 * speed**0.8 * radius**0.6)


def recovery_rise(speed: float, radius: float, recovery: float = RECOVERY) -> float:
    """Compute the temperature rise that air friction at the tooth tips causes in the mist.

    Parameters
    ----------
    speed : float
        Speed of the gear, positive [rad/s].
    radius : float
        Tip radius [m].
    recovery : float
        Recovery factor [-].

    Returns
    -------
    float
        Rise of the temperature [K].

    Notes
    -----
    Eq. H16: 0.88 (omega r_a)^2/(2 c_p), where c_p is the specific heat of air.
    """
    return recovery * (speed * radius) ** 2 / (2 * AIR_HEAT)
