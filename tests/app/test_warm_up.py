"""The warm-up compiles every kernel that an example needs, and every endpoint belongs to a stage of the warm-up."""

import subprocess
import sys

import pytest

from app.calculations import BY_PATH, CALCULATIONS, COUPLING, LINE_CONTACT, STAGES
from app.examples import examples

COUNT_COLD = """
import gc
from numba.extending import is_jitted
from app.examples import examples
from app.calculations import STAGES
from app.evaluate import warm
from app.calculations import BY_PATH
from app.evaluate import answer_of

def compiled():
    return {(each.py_func.__module__, each.py_func.__name__): len(each.signatures)
            for each in gc.get_objects() if is_jitted(each)}

for stage in STAGES:
    warm(stage)
before = compiled()
for example in examples().values():
    answer_of(example.endpoint, BY_PATH[example.endpoint].request.model_validate(example.request))
after = compiled()
cold = {name: count for name, count in after.items() if before.get(name) != count}
assert len(before) > 10, before
assert not cold, cold
"""


@pytest.mark.slow
def test_every_kernel_is_warm_after_the_warm_up() -> None:
    subprocess.run([sys.executable, "-c", COUNT_COLD], check=True)


def test_endpoints_open_stage_by_stage() -> None:
    assert BY_PATH["/v1/coupling"].stage is COUPLING
    assert BY_PATH["/v1/scuffing/line-contact"].stage is LINE_CONTACT
    assert LINE_CONTACT not in BY_PATH["/v1/scuffing"].stages(lambda _: "closed_form")
    assert {calculation.stage for calculation in CALCULATIONS} <= set(STAGES)


def test_stages_name_examples_that_exist() -> None:
    assert {name for stage in STAGES for name in stage.examples} <= set(examples())
