"""Answers just computed, kept in memory: figure, report and download of a case need no second solve."""

from collections import OrderedDict
from hashlib import sha256


class Answers:
    """The most recent answers that fit into a number of bytes."""

    def __init__(self, most_bytes: int) -> None:
        self._most_bytes = most_bytes
        self._bytes = 0
        self._kept: OrderedDict[str, bytes] = OrderedDict()

    def get(self, key: str) -> bytes | None:
        """The answer of a case, if it is still there."""
        answer = self._kept.get(key)
        if answer is not None:
            self._kept.move_to_end(key)
        return answer

    def keep(self, key: str, answer: bytes) -> None:
        """Keep an answer in place of the oldest ones."""
        if len(answer) > self._most_bytes:
            return
        self._bytes += len(answer) - len(self._kept.pop(key, b""))
        self._kept[key] = answer
        while self._bytes > self._most_bytes:
            _, oldest = self._kept.popitem(last=False)
            self._bytes -= len(oldest)


def key_of(path: str, pairs: list[tuple[str, str]]) -> str:
    """What tells cases apart: the endpoint and its fields, in whatever order."""
    return sha256(repr((path, sorted(pairs))).encode()).hexdigest()
