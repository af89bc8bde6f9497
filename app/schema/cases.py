"""The identity of a case: endpoint, inputs and the solvers' sources."""

import json
from hashlib import sha256
from typing import Any

_CANONICAL = json.JSONEncoder(sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def case_of(endpoint: str, inputs: dict[str, Any], sources: str) -> str:
    """SHA-256 in hex of the case's JSON: sorted keys, no blanks, shortest floats, UTF-8."""
    content = {"endpoint": endpoint, "inputs": inputs, "sources": sources}
    return sha256(_CANONICAL.encode(content).encode()).hexdigest()
