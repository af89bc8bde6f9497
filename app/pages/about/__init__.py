"""What each model answers, its equations, misprints and limits of validity."""

from app.calculations import Calculation
from app.pages.about import coupling, pumping, scuffing
from app.pages.about.entry import About

ABOUT: dict[str, About] = {"coupling": coupling.ABOUT, "pumping": pumping.ABOUT, "scuffing": scuffing.ABOUT}


def about_of(calculation: Calculation) -> About | None:
    """The text about the model of a calculation, if there is one."""
    return ABOUT.get(calculation.path.split("/")[2])
