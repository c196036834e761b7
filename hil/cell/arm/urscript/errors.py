"""The one error that URScript raises: a program that is wrong, when compiled or when run."""

from hil.cell.errors import CellError


class ScriptError(CellError):
    """A program the controller refuses or ends; line and column count from 1, 0 means not known."""

    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        super().__init__(f"line {line}, column {column}: {message}" if line else message)
        self.message = message
        self.line = line
        self.column = column

    def at(self, line: int, column: int) -> "ScriptError":
        """The same error with its place; a place already known stays."""
        return self if self.line else ScriptError(self.message, line, column)
