"""Why a study is not begun."""


class StudyRefused(Exception):
    """A study that cannot be; `pointer` leads into its request."""

    def __init__(self, pointer: str, code: str, message: str) -> None:
        super().__init__(pointer, code, message)
        self.pointer = pointer
        self.code = code
        self.message = message
