"""Answers just computed, kept in memory: figure, report and download of a case need no second solve."""

from hashlib import sha256

from cachetools import LRUCache


class Answers(LRUCache[str, bytes]):
    """The most recent answers that fit into a number of bytes."""

    def __init__(self, most_bytes: int) -> None:
        super().__init__(most_bytes, getsizeof=len)

    def keep(self, key: str, answer: bytes) -> None:
        """Keep an answer in place of the oldest ones, unless it is too large for that."""
        if len(answer) <= self.maxsize:
            self[key] = answer


def key_of(path: str, pairs: list[tuple[str, str]]) -> str:
    """The key of a case: its endpoint and fields, whatever their order."""
    return sha256(repr((path, sorted(pairs))).encode()).hexdigest()
