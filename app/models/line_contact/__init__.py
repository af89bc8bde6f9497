"""One lubricated line contact by thermal elastohydrodynamics."""

from app.models.card import Calculation, Card
from app.models.kernels import LINE_CONTACT, Kernels
from app.models.line_contact import figures, request, words
from solvers.contact import ehl

CARD = Card(
    "line-contact",
    (
        Calculation(
            path="/v1/scuffing/line-contact",
            title="Line contact",
            summary="Film, pressure, temperature and friction of one thermal elastohydrodynamic line contact",
            source="Xue, Zhang, Wang 2020, sections III and IV",
            request=request.LineContactRequest,
            solve=ehl.solve,
            response=words.LINE_CONTACT,
            kernels=Kernels(LINE_CONTACT),
            figures=figures.FIGURES,
            words=words.WORDS,
        ),
    ),
)
