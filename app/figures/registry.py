"""The figures of each endpoint."""

from app.figures.declaration import Declaration
from app.figures.models import (
    coupling,
    drive_train,
    line_contact,
    load_distribution,
    pumping,
    scuffing,
)

FIGURES: dict[str, tuple[Declaration, ...]] = {
    "/v1/coupling": coupling.FIGURES,
    "/v1/coupling/sleeve-orbit": coupling.ORBIT_FIGURES,
    "/v1/coupling/recommendation": coupling.RECOMMENDATION_FIGURES,
    "/v1/pumping": pumping.FIGURES,
    "/v1/pumping/choking-speed": pumping.CHOKING_FIGURES,
    "/v1/scuffing/load-distribution": load_distribution.FIGURES,
    "/v1/scuffing": (*scuffing.FIGURES, *load_distribution.FIGURES),
    "/v1/scuffing/line-contact": line_contact.FIGURES,
    "/v1/drive-train": drive_train.FIGURES,
}


def figures_of(endpoint: str) -> tuple[Declaration, ...]:
    """What can be drawn of a case of an endpoint."""
    return FIGURES.get(endpoint, ())
