"""Time and memory of reading gear units from files: large ones, and ones made to be expensive.

`python -m benchmarks.rexs` reads each file in a process of its own; memory is what the process grows by.
"""

import io
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

from app.errors import Unprocessable
from app.rexs.document import read
from app.rexs.unit import gear_unit

MEGABYTE = 1_000_000
LIMIT = 20 * MEGABYTE


def model(body: str) -> bytes:
    """A file around its components and relations."""
    return f'<model version="1.4" applicationId="benchmark" applicationVersion="1" date="d">{body}</model>'.encode()


def stages(size: int) -> bytes:
    """A unit of many stages, each with gears, flanks and shafts, of about `size` bytes."""
    components, relations, number = [], [], 0
    while sum(map(len, components)) + sum(map(len, relations)) < size:
        ids = range(number, number + 5)
        number += 5
        stage, *others = ids
        components.append(f'<component id="{stage}" type="cylindrical_stage">{_attribute("center_distance", 53, "mm")}')
        components.append("</component>")
        for gear, shaft, teeth, angle in ((others[0], others[2], 23, 30), (others[1], others[3], 67, -30)):
            values = ("number_of_teeth", teeth, ""), ("normal_module", 1, "mm"), ("face_width", 16, "mm")
            values = *values, ("helix_angle_reference_diameter", angle, "deg")
            attributes = "".join(_attribute(*each) for each in values)
            components.append(f'<component id="{gear}" type="cylindrical_gear">{attributes}</component>')
            components.append(f'<component id="{shaft}" type="shaft"/>')
            relations.append(_relation(gear, "assembly", assembly=shaft, part=gear))
        relations.append(_relation(stage, "stage", stage=stage, gear_1=others[0], gear_2=others[1]))
    return model(f"<relations>{''.join(relations)}</relations><components>{''.join(components)}</components>")


def _attribute(name: str, value: float, unit: str) -> str:
    return f'<attribute id="{name}" unit="{unit}">{value}</attribute>'


def _relation(number: int, type_: str, **roles: int) -> str:
    refs = "".join(f'<ref id="{part}" role="{role}"/>' for role, part in roles.items())
    return f'<relation id="{number}" type="{type_}">{refs}</relation>'


def entities() -> bytes:
    """A thousand million characters from nine entities."""
    lines = [f'<!ENTITY e{level} "{f"&e{level - 1};" * 10}">' for level in range(1, 10)]
    return f'<!DOCTYPE m [<!ENTITY e0 "x">{"".join(lines)}]><model version="1.4">&e9;</model>'.encode()


def packed() -> bytes:
    """A gigabyte of zeros in a zip archive of a megabyte."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.rexs", b"0" * 1000 * MEGABYTE)
    return buffer.getvalue()


CASES: dict[str, Callable[[], bytes]] = {
    "stages, 5 MB": lambda: stages(5 * MEGABYTE),
    "stages, 19 MB": lambda: stages(19 * MEGABYTE),
    "100,000 shafts with speeds": lambda: model(
        "<components>"
        + "".join(
            f'<component id="{i}" type="shaft">{_attribute("rotational_speed", 1400, "1 / min")}</component>'
            for i in range(100_000)
        )
        + "</components>"
    ),
    "a chain of 60,000 assemblies": lambda: model(
        "<relations>"
        + "".join(_relation(i, "assembly", assembly=i, part=i + 1) for i in range(60_000))
        + "</relations><components>"
        + "".join(f'<component id="{i}" type="shaft"/>' for i in range(60_001))
        + "</components>"
    ),
    "empty tags": lambda: model("<c/>" * (LIMIT // 4 - 100)),
    "empty tags below the limit": lambda: model("<components>" + "<c/>" * 1_490_000 + "</components>"),
    "one text of 20 MB": lambda: model("x" * (LIMIT - 200)),
    "entities": entities,
    "zip of a gigabyte": packed,
    "JSON of empty lists": lambda: b'{"model":{"version":"1.4","components":[' + b"[]," * 6_000_000 + b"[]]}}",
    "JSON of numbers": lambda: b'{"model":{"version":"1.4","x":[' + b"1.5," * 4_900_000 + b"1]}}",
    "JSON of words": lambda: b'{"model":{"version":"1.4","x":[' + b'"ab",' * 3_900_000 + b'"ab"]}}',
    "JSON, 1,000,000 brackets deep": lambda: b'{"model":' + b"[" * 1_000_000,
}


def measure(path: str) -> None:
    """Read a file and print what it cost."""
    before = _most_memory()
    content = Path(path).read_bytes()
    started = time.process_time()
    try:
        found = gear_unit(read(content, LIMIT).model)
        outcome = f"{len(found['stages'])} stages, {len(found['findings'])} findings"
    except Unprocessable as error:
        outcome = f"refused: {error.message[:60]}"
    seconds = time.process_time() - started
    grown = _most_memory() - before
    print(f"{len(content) / MEGABYTE:.1f} MB | {seconds:.2f} s | {grown:.0f} MB | {outcome} |")


def _most_memory() -> float:
    """Largest memory of this process so far [MiB]."""
    status = Path("/proc/self/status").read_text("ascii")
    return float(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1]) / 1024


def main() -> None:
    """One line a case."""
    print("| file | size | CPU | memory | outcome |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, make in CASES.items():
            path = Path(folder) / "model"
            path.write_bytes(make())
            print(f"| {name} | ", end="", flush=True)
            subprocess.run([sys.executable, "-m", "benchmarks.rexs", str(path)], check=True)


if __name__ == "__main__":
    measure(sys.argv[1]) if len(sys.argv) > 1 else main()
