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
    input without its unit ("pinion.teeth"), or None if no single input is wrong.
    """

    def __init__(self, code: str, message: str, field: str | None = None) -> None:
        super().__init__(code, message, field)
        self.field = field


class NoSolution(SolverError):
    """Error of an iteration that ended without convergence; `residuals` holds the remaining errors by name."""

    def __init__(self, code: str, message: str, residuals: dict[str, float] | None = None) -> None:
        super().__init__(code, message, residuals)
        self.residuals = residuals or {}
