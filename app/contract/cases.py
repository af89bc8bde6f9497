"""A case is an endpoint, its inputs and the version of the model; everything else is a view of it."""

import json
from hashlib import sha256
from typing import Any


def case_of(endpoint: str, inputs: dict[str, Any], model_version: str) -> str:
    """SHA-256 in hex of the case's JSON: sorted keys, no blanks, shortest floats, UTF-8."""
    content = {"endpoint": endpoint, "inputs": inputs, "model_version": model_version}
    text = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return sha256(text.encode()).hexdigest()
