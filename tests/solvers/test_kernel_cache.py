"""Compiled kernels always match their source code; a broken or missing cache only costs time."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import solvers
from solvers.compiled import kernel

pytestmark = pytest.mark.ci

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
    """Return the folder of a new package with two kernels in two files. The kernel `outer` calls the kernel `inner`."""
    folder = tmp_path / "solvers"
    folder.mkdir()
    for name in ("__init__.py", "compiled.py", "digest.py", "kernel_cache.py"):
        shutil.copy(SOURCES / name, folder)
    head = "from solvers.compiled import kernel\n"
    (folder / "inner.py").write_text(f"{head}@kernel\ndef inner(x):\n    return 2.0 * x\n")
    (folder / "outer.py").write_text(
        f"{head}from solvers.inner import inner\n@kernel\ndef outer(x):\n    return inner(x) + 1.0\n"
    )
    return folder


def run(package: Path, program: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a program in a new process. The cache folder is beside the package."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["NUMBA_CACHE_DIR"] = str(package.parent / "cache")
    environment["PYTHONDONTWRITEBYTECODE"] = "1"  # Python would miss a second edit of the same length within a second
    command = [sys.executable, "-c", program]
    return subprocess.run(
        command, cwd=package.parent, env=environment | variables, check=True, capture_output=True, text=True
    )


def outcome(package: Path, module: str = "solvers.outer", head: str = "", **variables: str) -> tuple[float, bool, str]:
    """Return the result of the kernel `outer`, whether the kernel came from the cache, and the logged text."""
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


def test_prose_leaves_the_kernels_on_disk(package: Path) -> None:
    assert outcome(package)[:2] == (3.0, False)
    source = package / "inner.py"
    source.write_text(f'"""What it is about."""\n{source.read_text()}')
    assert outcome(package)[0] == 3.0
    assert len(folders(package)) == 1


def folders(package: Path) -> list[Path]:
    """Return the folders with compiled kernels, the newest folder last."""
    found = (package.parent / "cache" / "tribodrive").iterdir()
    return sorted((each for each in found if each.name != "digests"), key=lambda each: each.stat().st_mtime)


@pytest.mark.slow
def test_the_newest_folders_are_kept(package: Path) -> None:
    source = package / "inner.py"
    for number in range(7):
        source.write_text(source.read_text().replace(f"{number}.5" if number else "2.0", f"{number + 1}.5"))
        assert outcome(package)[:2] == (number + 2.5, False)
    kept = folders(package)
    assert len(kept) <= 5
    assert outcome(package)[:2] == (8.5, True)


def test_a_digest_that_was_not_written_whole_is_computed_again(package: Path) -> None:
    outcome(package)
    (kept,) = (package.parent / "cache" / "tribodrive" / "digests").iterdir()
    digest = kept.read_text()
    kept.write_text(digest[:10])
    assert outcome(package)[:2] == (3.0, True)
    assert kept.read_text() == digest


def test_without_any_place_kernels_live_in_memory_with_a_warning(package: Path) -> None:
    (package.parent / "file").touch()
    value, cached, said = outcome(package, NUMBA_CACHE_DIR=str(package.parent / "file" / "folder"))
    assert (value, cached) == (3.0, False)
    assert said.startswith("compiled kernels are not kept: ")
    assert not list(package.rglob("*.nb?"))
