"""Compiled kernels are never stale, whoever edits what; a broken or missing cache costs time and nothing else."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import solvers
from solvers.compiled import kernel

SOURCES = Path(solvers.__file__).parent
PROGRAM = "from {module} import outer; print(outer(1.0), len(outer.stats.cache_hits))"


@kernel
def inner(x: float) -> float:
    return 2.0 * x


@kernel
def outer(x: float) -> float:
    return inner(x) + 1.0


def test_a_kernel_that_others_call_can_be_called_from_python_too() -> None:
    assert outer(1.0) == 3.0
    assert inner(1.0) == 2.0


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package of two kernels, one calling the other from another file."""
    folder = tmp_path / "solvers"
    folder.mkdir()
    for name in ("__init__.py", "compiled.py", "kernel_cache.py"):
        shutil.copy(SOURCES / name, folder)
    head = "from solvers.compiled import kernel\n"
    (folder / "inner.py").write_text(f"{head}@kernel\ndef inner(x):\n    return 2.0 * x\n")
    (folder / "outer.py").write_text(
        f"{head}from solvers.inner import inner\n@kernel\ndef outer(x):\n    return inner(x) + 1.0\n"
    )
    return folder


def run(package: Path, program: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """A program in a process of its own, with the cache where it is by default."""
    environment = {name: value for name, value in os.environ.items() if name not in {"NUMBA_CACHE_DIR", "PYTHONPATH"}}
    command = [sys.executable, "-c", program]
    return subprocess.run(
        command, cwd=package.parent, env=environment | variables, check=True, capture_output=True, text=True
    )


def outcome(package: Path, module: str = "solvers.outer", head: str = "", **variables: str) -> tuple[float, bool, str]:
    """What the outer kernel answers, whether it came from the cache, and what was logged."""
    result = run(package, head + PROGRAM.format(module=module), **variables)
    value, hits = result.stdout.split()
    return float(value), hits == "1", result.stderr


def test_an_edit_of_a_called_kernel_is_seen(package: Path) -> None:
    assert outcome(package)[:2] == (3.0, False)
    assert outcome(package)[:2] == (3.0, True)
    source = package / "inner.py"
    source.write_text(source.read_text().replace("2.0", "5.0"))
    assert outcome(package)[:2] == (6.0, False)


ON_ANOTHER_PROCESSOR = """
import llvmlite.binding as llvm
llvm.get_host_cpu_name = lambda: "znver1"
llvm.get_host_cpu_features = lambda: llvm.FeatureMap(sse2=True)
"""


def test_code_for_any_processor_is_used_on_another(package: Path) -> None:
    assert outcome(package, NUMBA_CPU_NAME="generic")[:2] == (3.0, False)
    assert outcome(package, head=ON_ANOTHER_PROCESSOR, NUMBA_CPU_NAME="generic")[:2] == (3.0, True)
    assert outcome(package, head=ON_ANOTHER_PROCESSOR)[:2] == (3.0, False)


@pytest.mark.slow
def test_a_moved_module_is_compiled_again_without_complaint(package: Path) -> None:
    assert outcome(package) == (3.0, False, "")
    (package / "part").mkdir()
    (package / "part" / "__init__.py").touch()
    (package / "outer.py").rename(package / "part" / "outer.py")
    assert outcome(package, module="solvers.part.outer") == (3.0, False, "")
    assert outcome(package, module="solvers.part.outer") == (3.0, True, "")


@pytest.mark.slow
@pytest.mark.parametrize("size", [0, 20])
@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_broken_files_are_compiled_again_with_a_word(package: Path, kind: str, size: int) -> None:
    outcome(package)
    files = list((package / "__pycache__" / "kernels").glob(f"outer-*/*.{kind}"))
    assert files
    for file in files:
        file.write_bytes(file.read_bytes()[:size])
    value, cached, log = outcome(package)
    assert (value, cached) == (3.0, False)
    assert log.count("broken kernel cache") == 1
    assert "outer-" in log
    assert outcome(package) == (3.0, True, "")


def marked_complete(package: Path) -> None:
    outcome(package)
    run(package, "from solvers.kernel_cache import mark_complete; mark_complete('all')")


@pytest.mark.slow
def test_a_flipped_bit_in_a_complete_cache_is_noticed(package: Path) -> None:
    marked_complete(package)
    assert outcome(package) == (3.0, True, "")
    (file,) = (package / "__pycache__" / "kernels").glob("outer-*/*.nbc")
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 8
    file.write_bytes(content)
    value, cached, log = outcome(package)
    assert (value, cached) == (3.0, False)
    assert log.count("\n") == log.count("broken kernel cache") == 1
    assert outcome(package) == (3.0, True, "")


@pytest.mark.slow
def test_a_kernel_compiled_after_the_cache_was_complete_is_no_damage(package: Path) -> None:
    marked_complete(package)
    run(package, PROGRAM.replace("outer(1.0)", "outer(1)").format(module="solvers.outer"))
    assert outcome(package) == (3.0, True, "")


@pytest.mark.slow
def test_code_from_the_cache_is_linked_and_raises(package: Path) -> None:
    inner = "def inner(x):\n    if x < 0.0:\n        raise ValueError('below zero')\n    return 2.0 * x\n"
    (package / "inner.py").write_text(f"from solvers.compiled import kernel\n@kernel\n{inner}")
    outcome(package)
    (index,) = (package / "__pycache__" / "kernels").glob("inner-*/inner.inner-*.nbi")
    before = index.stat().st_mtime_ns
    outer = package / "outer.py"
    outer.write_text(outer.read_text().replace("+ 1.0", "+ 2.0"))
    assert outcome(package)[:2] == (4.0, False)
    assert index.stat().st_mtime_ns == before  # linked from the cache, not compiled again
    outer.write_text(outer.read_text().replace("inner(x)", "inner(-x)"))
    with pytest.raises(subprocess.CalledProcessError) as failed:
        outcome(package)
    assert "ValueError: below zero" in failed.value.stderr


WITH_INTEGERS = """
import os
import solvers.kernel_cache as cache
first, second = cache.PACKAGE / "__pycache__" / "kernels", cache.PACKAGE.parent / "user"
cache.roots = lambda: [first, second]
cache._is_ours = lambda folder, mode=0o755: folder == second  # the first root is read-only, also for a superuser
from solvers.outer import outer
print(outer(1.0), len(outer.stats.cache_hits), outer(1), len(outer.stats.cache_hits))
"""


@pytest.mark.slow
def test_a_read_only_folder_is_read_and_what_it_lacks_is_kept_elsewhere(package: Path) -> None:
    outcome(package)
    kept = package / "__pycache__" / "kernels"
    before = {file: file.read_bytes() for file in kept.rglob("*.nb?")}
    answers = [run(package, WITH_INTEGERS).stdout.split() for _ in range(2)]
    assert answers == [["3.0", "1", "3.0", "1"], ["3.0", "1", "3.0", "2"]]
    assert {file: file.read_bytes() for file in kept.rglob("*.nb?")} == before


@pytest.mark.slow
def test_kernels_of_others_are_left_to_numba(package: Path) -> None:
    (package.parent / "other.py").write_text(
        "import solvers.outer\nimport numba\n@numba.njit(cache=True)\ndef outer(x):\n    return x + 2.0\n"
    )
    assert outcome(package, module="other")[:2] == (3.0, False)
    assert list((package.parent / "__pycache__").glob("other.outer-*.nbi"))


@pytest.mark.slow
def test_without_any_place_kernels_live_in_memory(package: Path) -> None:
    assert outcome(package, NUMBA_CACHE_DIR="/proc/no-such-place") == (3.0, False, "")
