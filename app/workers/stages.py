"""The stages in which kernels are compiled: examples that between them call every kernel."""

from app.calculations import BY_PATH, COUPLING, DRIVE_TRAIN, LINE_CONTACT, LOADS, PUMPING, SLEEVE, Stage
from app.evaluate import answer_of
from app.examples import examples

STAGES = (COUPLING, SLEEVE, LOADS, PUMPING, DRIVE_TRAIN, LINE_CONTACT)
BESIDE = LINE_CONTACT
"""Takes as long as all others together, and needs of them only the load distribution, late."""


def warm(stage: Stage) -> None:
    """Have every kernel of a stage in this process, and on disk if there is a folder for them."""
    for name in stage.examples:
        example = examples()[name]
        answer_of(example.endpoint, BY_PATH[example.endpoint].request.model_validate(example.request))
