"""The hierarchy of errors.

Every message says where the mistake is, what was found, what was expected, and a way out, in the names of the user;
``tests/errors`` contains each of them verbatim.
"""

import inspect
import warnings
from functools import cache
from types import FrameType

__all__ = [
    "ArgumentError",
    "BodyError",
    "CodegenError",
    "ConstraintError",
    "DivisionByZeroError",
    "ExpressionError",
    "FrameError",
    "JointError",
    "LoadError",
    "ModelError",
    "ModelNotice",
    "ParameterError",
    "ParseError",
    "PictureError",
    "ProgramError",
    "ReportError",
    "ResultsError",
    "SimulationError",
    "SymbodyError",
    "ViewError",
    "WorksheetError",
    "notify",
    "user_frame",
]


class SymbodyError(Exception):
    """The base class of all errors that symbody raises.

    >>> import symbody as sb
    >>> try:
    ...     sb.number("one half")
    ... except sb.SymbodyError as error:
    ...     print(type(error).__name__)
    ExpressionError
    """


class ExpressionError(SymbodyError, ValueError):
    """An operation that an expression does not allow."""


class ArgumentError(ExpressionError, TypeError):
    """An argument of the wrong type, where an expression, a number or a list of them is needed."""


class DivisionByZeroError(SymbodyError, ZeroDivisionError):
    """A division by an expression that is identically zero."""


class ParseError(SymbodyError, ValueError):
    """A text that is not an expression."""


class FrameError(SymbodyError, ValueError):
    """A frame, a point or a vector without geometrical meaning."""


class BodyError(SymbodyError, ValueError):
    """A body that can't be made."""


class LoadError(SymbodyError, ValueError):
    """A force or a torque that can't act."""


class JointError(SymbodyError, ValueError):
    """A joint that can't be made, or joints that make no mechanism."""


class ModelError(SymbodyError, ValueError):
    """A system whose parts don't fit together."""


class ConstraintError(ModelError):
    """Constraints that no motion can satisfy, or that are redundant."""


class ParameterError(SymbodyError, ValueError):
    """A parameter without a value, or a value without a parameter."""


class ProgramError(SymbodyError, ValueError):
    """A program that can't be generated: names that clash, variables without a value."""


class CodegenError(SymbodyError, OSError):
    """Generated code that can't be written, compiled or run on this machine."""


class SimulationError(SymbodyError, RuntimeError):
    """A motion that can't be computed, or not completely.

    Attributes:
        motion: what was computed, if anything.
    """

    def __init__(self, message: str, motion: object = None) -> None:
        super().__init__(message)
        self.motion = motion


class ResultsError(SymbodyError, OSError):
    """A results file that can't be read or written, or that contains results of another problem."""


class ViewError(SymbodyError, ValueError):
    """A motion or a shape that can't be drawn."""


class PictureError(SymbodyError, OSError):
    """A page or a figure that can't be written."""


class ReportError(SymbodyError, ValueError):
    """A report of something that is not a model, or in an unknown format."""


class WorksheetError(SymbodyError, ValueError):
    """A worksheet that can't be read, or a statement of it that can't be executed.

    Attributes:
        place: where it stands in the file (`symbody.worksheet.sheet.syntax.Place`), if that is known.
    """

    def __init__(self, message: str, place: object = None) -> None:
        super().__init__(message)
        self.place = place


class ModelNotice(UserWarning):
    """A warning of something that the user should know, such as a part that was left out of a result on purpose.

    >>> import warnings
    >>> import symbody as sb
    >>> warnings.filterwarnings("error", category=sb.ModelNotice)  # notices become errors
    >>> warnings.filterwarnings("default", category=sb.ModelNotice)
    """


_OURS = ("symbody.", "functools.", "contextlib.")
"""Modules, with all below them, whose lines are not the user's: the package, and those that call its properties and
contexts."""


def notify(message: str) -> None:
    """Warn with a `ModelNotice` at the user's line, the innermost one outside of symbody."""
    frame, level = inspect.currentframe(), 1
    while frame is not None and _is_ours(frame):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, ModelNotice, stacklevel=level)


def user_frame() -> FrameType | None:
    """Return the frame that makes variables: the innermost one outside of symbody, or of a function of `models`."""
    frame = inspect.currentframe()
    while frame is not None and not _makes_variables(str(frame.f_globals.get("__name__"))):
        frame = frame.f_back
    return frame


def _is_ours(frame: FrameType) -> bool:
    """Whether a frame is one of symbody, or of what calls its functions for it."""
    return _name_is_ours(str(frame.f_globals.get("__name__")))


@cache
def _makes_variables(module: str) -> bool:
    """Whether a module is the user's, or one of `symbody.models`, whose names are its own: F of one is no F of another.

    Each variable that is made asks for it, so answers are kept.
    """
    return not _name_is_ours(module) or module.startswith("symbody.models.")


@cache
def _name_is_ours(module: str) -> bool:
    """Whether a module is one of symbody, or of those that call its functions."""
    return f"{module}.".startswith(_OURS)
