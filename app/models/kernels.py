"""Groups of kernels (functions that numba compiles), in which kernels are compiled, loaded and waited for."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple


@dataclass(frozen=True, slots=True)
class KernelGroup:
    """Kernels that are compiled and loaded together.

    Together, the `examples` call all kernels of the group, except those of the groups in `after`. `kernels` is their
    approximate number. `model` has model options that replace those of the examples.
    """

    name: str
    kernels: int
    examples: tuple[str, ...]
    after: tuple["KernelGroup", ...] = ()
    model: tuple[tuple[str, str], ...] = ()

    @property
    def all(self) -> frozenset["KernelGroup"]:
        """The group itself and all groups that it builds on."""
        return frozenset((self,)).union(*(group.all for group in self.after))


class Further(NamedTuple):
    """A group that a request needs only if a field has none of the values in `spared`; None: the field is left out."""

    group: KernelGroup
    field: str
    spared: tuple[str | None, ...]


@dataclass(frozen=True, slots=True)
class Kernels:
    """The kernels of an endpoint: a group, unless it needs none, and for some requests a `further` one."""

    group: KernelGroup | None = None
    further: Further | None = None

    def of(self, value_of: Callable[[str], Any] | None = None) -> frozenset[KernelGroup]:
        """Return the groups that a request needs. `value_of` returns the value of a field; None: any request."""
        own: frozenset[KernelGroup] = self.group.all if self.group else frozenset()
        further = self.further
        if further is None or (value_of is not None and value_of(further.field) in further.spared):
            return own
        return own | further.group.all


CLOSED_FORM = (("lubrication", "closed_form"),)

# The numbers of kernels were counted at a start from an empty cache.
COUPLING = KernelGroup("coupling", 8, ("pahl-axial-displacement",))
LOADS = KernelGroup("load distribution", 86, ("fzg-type-a",))
SCUFFING = KernelGroup(
    "scuffing", 10, ("xue-pair-1-scuffing", "starter-industrial-micropitting", "starter-turbo-pair-heat"),
    (LOADS,), CLOSED_FORM,
)  # fmt: skip
PUMPING = KernelGroup("pumping", 71, ("milian-case-1",))
SLEEVE = KernelGroup("coupling sleeve", 14, ("pahl-sleeve-orbit", "pahl-z-arrangement"), (COUPLING,))
DRIVE_TRAIN = KernelGroup(
    "drive train", 20, ("starter-turbo-gear-drive-train", "starter-turbo-gear-heat"), (SCUFFING, PUMPING, SLEEVE),
    CLOSED_FORM,
)  # fmt: skip
POCKET_CHAIN = KernelGroup("pocket chain", 32, ("milian-case-1-pocket-chain",), (PUMPING,))
LINE_CONTACT = KernelGroup(
    "line contact", 108, ("xue-line-contact", "xue-line-contact-isothermal", "xue-pair-1-thermal"), (SCUFFING,)
)
THERMAL = Further(LINE_CONTACT, "model.lubrication", ("closed_form",))
CHAIN = Further(POCKET_CHAIN, "model.flow", (None, "gas_dynamics", "incompressible"))

KERNEL_GROUPS = (COUPLING, LOADS, SCUFFING, PUMPING, SLEEVE, DRIVE_TRAIN, POCKET_CHAIN, LINE_CONTACT)
"""The groups in the order in which a single process compiles them."""
