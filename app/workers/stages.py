"""The stages in which kernels are compiled. The examples of all stages together call all kernels."""

from app.calculations import BY_PATH, COUPLING, DRIVE_TRAIN, LINE_CONTACT, LOADS, PUMPING, SLEEVE, Stage
from app.evaluate import answer_of
from app.examples import examples

STAGES = (COUPLING, SLEEVE, LOADS, PUMPING, DRIVE_TRAIN, LINE_CONTACT)
BESIDE = LINE_CONTACT
"""The stage that is compiled beside the other stages, because it takes as long as all other stages together.

Of the kernels of the other stages, this stage needs only the kernels of the load distribution, and needs them only near
the end of its own compilation.
"""


def warm(stage: Stage) -> None:
    """Compile or load all kernels of a stage in this process.

    If there is a folder for kernels, store the kernels there.
    """
    for name in stage.examples:
        example = examples()[name]
        answer_of(example.endpoint, BY_PATH[example.endpoint].request.model_validate(example.request))
