"""Every example once, so that no request pays for compiling or loading a kernel."""

from app.answers import answer
from app.calculations import CALCULATIONS
from app.library import examples


def warm_up() -> None:
    """Answer every example; runs in each worker process as it starts."""
    for calculation in CALCULATIONS:
        for example in examples().values():
            if example.endpoint == calculation.path:
                answer(calculation, calculation.request.model_validate(example.request))


if __name__ == "__main__":
    warm_up()
