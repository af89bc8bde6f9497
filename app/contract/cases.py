"""A case is an endpoint, its inputs and the version of the model; everything else is a view of it."""

import json
from hashlib import sha256
from typing import Any

_CANONICAL = json.JSONEncoder(sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def case_of(endpoint: str, inputs: dict[str, Any], model_version: str) -> str:
    """SHA-256 in hex of the case's JSON: sorted keys, no blanks, shortest floats, UTF-8."""
    content = {"endpoint": endpoint, "inputs": inputs, "model_version": model_version}
    return sha256(_CANONICAL.encode(content).encode()).hexdigest()
