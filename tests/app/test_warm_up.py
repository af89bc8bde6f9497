"""After the warm-up of a worker no example finds a kernel cold."""

import subprocess
import sys

COUNT_COLD = """
import gc
from numba.core.registry import CPUDispatcher
from app.formats.json import answer
from app.calculations import CALCULATIONS
from app.library import examples
from app.warm_up import warm_up

def compiled():
    return {(each.py_func.__module__, each.py_func.__name__): len(each.signatures)
            for each in gc.get_objects() if isinstance(each, CPUDispatcher)}

warm_up()
before = compiled()
calculations = {each.path: each for each in CALCULATIONS}
for example in examples().values():
    calculation = calculations[example.endpoint]
    answer(calculation, calculation.request.model_validate(example.request))
after = compiled()
cold = {name: count for name, count in after.items() if before.get(name) != count}
assert len(before) > 10, before
assert not cold, cold
"""


def test_every_kernel_is_warm_after_the_warm_up() -> None:
    subprocess.run([sys.executable, "-c", COUNT_COLD], check=True)
