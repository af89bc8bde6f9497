"""The warm-up compiles every kernel that an example needs, and every endpoint belongs to a group of kernels."""

import subprocess
import sys

import pytest

from app.calculations import BY_PATH, CALCULATIONS
from app.examples import examples
from app.models.kernels import COUPLING, KERNEL_GROUPS, LINE_CONTACT

COUNT_COLD = """
import gc
from numba.extending import is_jitted
from app.examples import examples
from app.models.kernels import KERNEL_GROUPS
from app.evaluate import warm
from app.calculations import BY_PATH
from app.evaluate import answer_of

def compiled():
    return {(each.py_func.__module__, each.py_func.__name__): len(each.signatures)
            for each in gc.get_objects() if is_jitted(each)}

for group in KERNEL_GROUPS:
    warm(group)
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


def test_endpoints_open_group_by_group() -> None:
    assert BY_PATH["/v1/coupling"].kernels.group is COUPLING
    assert BY_PATH["/v1/scuffing/line-contact"].kernels.group is LINE_CONTACT
    assert LINE_CONTACT not in BY_PATH["/v1/scuffing"].kernels.of(lambda _: "closed_form")
    assert {calculation.kernels.group for calculation in CALCULATIONS} <= set(KERNEL_GROUPS)


def test_groups_name_examples_that_exist() -> None:
    assert {name for group in KERNEL_GROUPS for name in group.examples} <= set(examples())
