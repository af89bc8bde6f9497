"""A client generated from the OpenAPI document runs every example."""

import importlib
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import httpx
import pytest

from app.calculations import CALCULATIONS
from app.examples import examples

pytestmark = pytest.mark.service


@pytest.fixture(scope="module")
def package(server: str, tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    folder: Path = tmp_path_factory.mktemp("generated")
    generator = Path(sys.executable).with_name("openapi-python-client")
    config = folder / "config.yml"
    # Lines are text to it, files are bytes.
    kinds = {"x-ndjson": "text/plain", "xml": "application/octet-stream", "zip": "application/octet-stream"}
    overrides = "".join(f"  application/{kind}: {known}\n" for kind, known in kinds.items())
    config.write_text(f"content_type_overrides:\n{overrides}")
    document = folder / "openapi.json"
    document.write_bytes(httpx.get(f"{server}/openapi.json", timeout=60).content)  # the generator waits 5 s only
    options = f"--path {document} --meta none --fail-on-warning --config {config}".split()
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"  # the generator formats with ruff
    command = [generator, "generate", *options, "--output-path", folder / "tribodrive_client"]
    subprocess.run(command, check=True, env={**os.environ, "PATH": path})
    sys.path.insert(0, str(folder))
    return importlib.import_module("tribodrive_client")


@pytest.mark.parametrize("name", sorted(examples()))
def test_generated_client_runs_example(package: ModuleType, server: str, name: str) -> None:
    example = examples()[name]
    calculation = next(each for each in CALCULATIONS if each.path == example.endpoint)
    _, _, tag, *parts = calculation.path.split("/")
    operation = "_".join((tag, *parts)).replace("-", "_")
    endpoint = importlib.import_module(f"tribodrive_client.api.{tag.replace('-', '_')}.{operation}")
    models = importlib.import_module("tribodrive_client.models")
    body = getattr(models, calculation.request.__name__).from_dict(example.request)
    with package.Client(base_url=server, timeout=60) as client:
        result = endpoint.sync(client=client, body=body)
    assert type(result).__name__ == calculation.response.__name__
    assert result.status.value in {"ok", "ok_with_warnings"}
