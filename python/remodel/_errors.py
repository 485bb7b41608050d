"""The exceptions of remodel. Bad input raises one of these; a limit that was reached is in a result instead."""


class Error(Exception):
    """Bad input. The message is one line: `place`, what was found, what was expected."""

    @property
    def place(self) -> str:
        """The file, the line, the argument or the part of a shape that is meant."""
        return str(self).partition(": ")[0]

    @property
    def problem(self) -> str:
        """What was found there, and what was expected."""
        return str(self).partition(": ")[2]

    @property
    def expected(self) -> str:
        """What was expected, where the message says so; otherwise empty."""
        return self.problem.partition("expected ")[2]


class ArgumentError(Error, ValueError):
    """An argument is out of its range, or does not fit the others."""


class ArgumentTypeError(ArgumentError, TypeError):
    """An argument is of a type that the call does not take."""


class FileError(Error, OSError):
    """A file cannot be opened, read or written."""


class FormatError(Error, ValueError):
    """A file's content is not what its format asks for."""


class GeometryError(Error, ValueError):
    """A shape that no mesh can have: it crosses or touches itself, or is degenerate."""


class TopologyChanged(Error, RuntimeError):
    """Connectivity had to change where the caller needs it to stay."""


class EvaluationFailed(Error, RuntimeError):
    """To be raised by an objective for a design that cannot be evaluated: the run goes on."""
