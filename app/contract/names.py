"""Which request field a solver means when it names one of its own inputs."""

from collections.abc import Iterator

from app.contract.quantities import Documented
from app.contract.units import split_unit


def field_path(section: Documented, name: str) -> str | None:
    """The dotted request field that the solver's dotted `name` (its end suffices) means, or None.

    Of fields that exclude each other it is the one that was sent.
    """
    wanted = tuple(name.split("."))
    return next((path for path, si_path in _paths(section, "", ()) if si_path[-len(wanted) :] == wanted), None)


def _paths(section: Documented, prefix: str, si_prefix: tuple[str, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Every field as it was sent, beside the path of solver's names."""
    for name, value in section:
        si_name, _ = split_unit(name)
        path, si_path = f"{prefix}{name}", (*si_prefix, si_name)
        yield f"{prefix}{_sent(section, name)}", si_path
        if isinstance(value, Documented):
            yield from _paths(value, f"{path}.", si_path)
        elif isinstance(value, list):
            for index, item in enumerate(value):
                if isinstance(item, Documented):
                    yield from _paths(item, f"{path}.{index}.", (*si_path, str(index)))


def _sent(section: Documented, name: str) -> str:
    """The field itself, or the one given instead of it."""
    if getattr(section, name) is None:
        fellows = (fellow for group in section.exclusive if name in group for fellow in group)
        return next((fellow for fellow in fellows if getattr(section, fellow) is not None), name)
    return name
