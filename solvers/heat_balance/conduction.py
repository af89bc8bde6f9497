"""Conduction in the teeth and along the shafts."""

from math import pi


def tooth_conductance(teeth: int, face_width: float, module: float, height: float, conductivity: float) -> float:
    """Conductance z b H k/(pi m_n/4) from the loaded flanks to the middle of the teeth [W/K] (Eq. H15)."""
    return teeth * face_width * height * conductivity / (pi * module / 4)


def rod_conductance(sections: tuple[tuple[float, float, float], ...], conductivity: float) -> float:
    """Compute the conductance of a shaft between the face of its gear and the centre of a bearing.

    Parameters
    ----------
    sections : tuple of (float, float, float)
        Length, outer diameter and inner diameter of each section between these two places [m].
    conductivity : float
        Thermal conductivity of the shaft [W/(m K)].

    Returns
    -------
    float
        Conductance [W/K].

    Notes
    -----
    Eq. H14: 1/sum(L/(k A)), with the length L and the cross-section A of each section, and the conductivity k. The
    formula is exact for a rod.

    Examples
    --------
    >>> round(rod_conductance(((0.1, 0.1, 0.0),), 45.0), 2)
    3.53
    """
    lengths = sum(length / (outer**2 - inner**2) for length, outer, inner in sections)
    return conductivity * pi / 4 / lengths
