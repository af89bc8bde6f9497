"""The one way kernels are compiled: by numba, typed by use, kept on disk, IEEE division.

A kernel that only other kernels call needs no wrapper that turns Python objects into numbers and back, and nor
machine code of its own: its intermediate code becomes part of theirs. Making both all the same would take half of the
time that compilation takes. Each kernel is therefore two dispatchers: the one that Python sees, and behind it the bare
one that other kernels are compiled against.
"""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

from numba.core.codegen import JITCodeLibrary, ll  # type: ignore[attr-defined]  # numba's way to llvmlite
from numba.core.compiler import Compiler
from numba.core.registry import CPUDispatcher

from solvers.kernel_cache import KernelCache

P = ParamSpec("P")
R = TypeVar("R")
OPTIONS = {"nopython": True, "boundscheck": None, "error_model": "numpy", "nogil": True, "forceinline": False}
BARE = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function of scalars and arrays; division by zero follows IEEE instead of raising."""
    return cast("Callable[P, R]", Kernel(function))


def inlined_kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a kernel that is copied into the kernels that call it, in place of a call.

    A call counts every array handed over up and down. For a step of a loop that takes groups of arrays, as for one
    column of a film, that can cost twice the work itself.
    """
    return cast("Callable[P, R]", Kernel(function, forceinline=True))


class _LinkedOnly(JITCodeLibrary):
    """The code of a bare kernel: optimised for others to link in; as machine code there are only its variables."""

    def _finalize_final_module(self: Any) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True
        linked = self._get_module_for_linking()
        empty = str(self._codegen._create_empty_module(self.name))
        variables = [str(each) for each in linked.global_variables if each.linkage is ll.Linkage.common]
        self._final_module = ll.parse_assembly("\n".join([empty, *variables]))
        JITCodeLibrary._finalize_final_module(self)


class _BareCompiler(Compiler):
    """Numba's compiler with such a library in place of its own."""

    def compile_extra(self: Any, function: Callable[..., Any]) -> Any:
        """Compile the function."""
        library: Any = _LinkedOnly
        self.state.library = library(self.state.targetctx.codegen(), function.__qualname__)
        self.state.library.enable_object_caching()
        return Compiler.compile_extra(self, function)


class _Cached(CPUDispatcher):
    """A compiled function whose machine code is kept; `variant` tells it from others of the same source."""

    def __init__(self, function: Callable[..., Any], variant: str, **options: Any) -> None:
        super().__init__(function, **options)
        self._cache = KernelCache(function, variant)


class Kernel(_Cached):
    """A compiled function that Python can call."""

    def __init__(self, function: Callable[..., Any], *, forceinline: bool = False) -> None:
        super().__init__(function, "", targetoptions=OPTIONS)
        self._bare = _Cached(
            function,
            "-bare",
            targetoptions=OPTIONS | BARE | {"forceinline": forceinline},
            pipeline_class=_BareCompiler,
        )

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """How another kernel calls this one: numba asks while it infers types."""
        return self._bare.get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """What another kernel calls: numba asks while it generates code."""
        return self._bare.get_overload(sig)
