"""The figures of each endpoint."""

from app.figures import coupling, coupling_companions, pumping

FIGURES = {
    "/v1/coupling": coupling.FIGURES,
    "/v1/coupling/sleeve-orbit": coupling_companions.ORBIT_FIGURES,
    "/v1/coupling/recommendation": coupling_companions.RECOMMENDATION_FIGURES,
    "/v1/pumping": pumping.FIGURES,
}
