"""Which request field a solver means when it names one of its own inputs."""

from collections.abc import Iterator

from app.schema.model import Documented


def field_path(section: Documented, name: str) -> str | None:
    """The dotted request field that the solver's dotted `name` (its end suffices) means, or None.

    Of several it is the outermost, of fields that exclude each other the one that was sent; where an item of a list
    lacks what the solver names in it, it is the item.
    """
    for theirs, ours in section.solver_names.items():
        name = f".{name}.".replace(f".{theirs}.", f".{ours}.").strip(".")
    known = sorted(_paths(section, "", ()), key=lambda each: len(each[1]))
    wanted = tuple(name.split("."))
    while wanted:
        found = next((path for path, si_path in known if _means(wanted, si_path)), None)
        if found is not None:
            return found
        in_item = any(part.isdecimal() for part in wanted[:-1])
        wanted = wanted[:-1] if in_item else ()
    return None


def _means(wanted: tuple[str, ...], si_path: tuple[str, ...]) -> bool:
    """Whether a path ends as wanted; between an item of a list and the end there may be sections not named."""
    after = max((place for place, part in enumerate(wanted) if part.isdecimal()), default=-1) + 1
    item, end = wanted[:after], wanted[after:]
    around = si_path[: len(si_path) - len(end)]
    inside = any(around[start : start + after] == item for start in range(len(around) - after + 1))
    return inside and si_path[len(around) :] == end


def _paths(section: Documented, prefix: str, si_prefix: tuple[str, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Every field as it was sent, beside the path of solver's names."""
    for name, value in section:
        si_name = section.solver_name(name)
        path, si_path = f"{prefix}{name}", (*si_prefix, si_name)
        yield f"{prefix}{_sent(section, name)}", si_path
        if isinstance(value, Documented):
            yield from _paths(value, f"{path}.", si_path)
        elif isinstance(value, list):
            for index, item in enumerate(value):
                yield f"{path}.{index}", (*si_path, str(index))
                if isinstance(item, Documented):
                    yield from _paths(item, f"{path}.{index}.", (*si_path, str(index)))


def _sent(section: Documented, name: str) -> str:
    """The field itself, or the one given instead of it."""
    if getattr(section, name) is None:
        fellows = (fellow for group in section.exclusive if name in group for fellow in group)
        return next((fellow for fellow in fellows if getattr(section, fellow) is not None), name)
    return name
