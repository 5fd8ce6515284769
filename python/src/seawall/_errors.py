"""What can go wrong."""

from __future__ import annotations

from typing import Any


class SeawallError(Exception):
    """The program or a directory of results says no; the text is the program's own message.

    ``exit_code`` is the program's: 2 bad input, 3 interrupted, 70 internal error. It is ``None`` where the
    program did not run.
    """

    def __init__(self, message: str, exit_code: int | None = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class CaseFailed(SeawallError):
    """A case that was run alone came to no result. ``record`` is what the program says of it."""

    def __init__(self, message: str, record: dict[str, Any]) -> None:
        super().__init__(message, exit_code=1)
        self.record = record
