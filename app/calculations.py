"""The table of calculations: the cards of the models, and the endpoints on them."""

from app.models import coupling, drive_train, line_contact, load_distribution, pumping, scuffing
from app.models.card import Calculation, Card

__all__ = ["BY_PATH", "CALCULATIONS", "CARDS", "Calculation", "card_of"]

CARDS = (coupling.CARD, pumping.CARD, load_distribution.CARD, scuffing.CARD, line_contact.CARD, drive_train.CARD)
CALCULATIONS = tuple(calculation for card in CARDS for calculation in card.endpoints)
BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}


def card_of(calculation: Calculation) -> Card:
    """Return the card of the model to which a calculation belongs."""
    return next(card for card in CARDS if calculation in card.endpoints)
