"""The exceptions that a solver raises.

Exception
└── SolverError
    ├── InvalidInput    the input describes something that cannot exist or cannot be computed
    └── NoSolution      the input is valid, but an iteration did not converge
"""


class SolverError(Exception):
    """Base class of all exceptions that the solvers raise on purpose."""

    def __init__(self, code: str, message: str, *details: object) -> None:
        super().__init__(code, message, *details)  # all arguments, so that the exception can be pickled
        self.code = code
        self.message = message

    def __str__(self) -> str:
        return self.message


class InvalidInput(SolverError):
    """Physically impossible or unsupported input.

    `code` is stable and meant for programs. `message` says what to change. `field` is the dotted name of the wrong
    input, without a unit ("pinion.teeth"). If the error does not concern one input alone, `field` may be None.
    """

    def __init__(self, code: str, message: str, field: str | None = None) -> None:
        super().__init__(code, message, field)
        self.field = field


class NoSolution(SolverError):
    """An iteration without convergence; `residuals`, by name, are those where it stopped.

    `field` is the dotted name of the input to change, where one input alone is the cause.
    """

    def __init__(
        self, code: str, message: str, residuals: dict[str, float] | None = None, field: str | None = None
    ) -> None:
        super().__init__(code, message, residuals, field)
        self.residuals = residuals or {}
        self.field = field
