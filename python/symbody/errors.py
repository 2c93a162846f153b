"""The one hierarchy of errors.

Every message says where, what was found, what was expected and the way out, in the user's own names;
``tests/test_errors.py`` holds each of them verbatim.
"""

import inspect
import warnings


class SymbodyError(Exception):
    """The root: whoever catches it catches every mistake that symbody reports."""


class ExpressionError(SymbodyError, ValueError):
    """An expression was asked for something that it can't do."""


class ArgumentError(ExpressionError, TypeError):
    """Something that is no expression, number or list of them, where one is needed."""


class DivisionByZeroError(SymbodyError, ZeroDivisionError):
    """A division by an expression that is identically zero."""


class ParseError(SymbodyError, ValueError):
    """A text that is not an expression."""


class FrameError(SymbodyError, ValueError):
    """A frame, a point or a vector that makes no geometrical sense."""


class BodyError(SymbodyError, ValueError):
    """A body that can't be made."""


class LoadError(SymbodyError, ValueError):
    """A force or a torque that can't act."""


class ModelError(SymbodyError, ValueError):
    """A system whose parts don't fit together."""


class ConstraintError(ModelError):
    """Constraints that no motion can satisfy, or that say the same thing twice."""


class ParameterError(SymbodyError, ValueError):
    """A parameter without a value, or a value without a parameter."""


class ProgramError(SymbodyError, ValueError):
    """A program that can't be generated: names that clash, variables without a value."""


class CodegenError(SymbodyError, OSError):
    """Generated code that can't be written, compiled or run on this machine."""


class SimulationError(SymbodyError, RuntimeError):
    """A motion that can't be computed, or not to its end.

    Attributes:
        motion: what was computed, where there is something.
    """

    def __init__(self, message: str, motion: object = None) -> None:
        super().__init__(message)
        self.motion = motion


class ResultsError(SymbodyError, OSError):
    """A file of results that can't be read or written, or that holds those of another problem."""


class ViewError(SymbodyError, ValueError):
    """A motion or a shape that can't be drawn."""


class PictureError(SymbodyError, OSError):
    """A page or a figure that can't be written."""


class ModelNotice(UserWarning):
    """Something was left out of a result, on purpose, and the user should know."""


_OURS = ("symbody", "functools", "contextlib")
"""Modules whose lines are no user's: the package, and what calls its properties and context managers."""


def notify(message: str) -> None:
    """Warn with a `ModelNotice` at the line outside of symbody that led here."""
    frame, level = inspect.currentframe(), 1
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] in _OURS:
        frame, level = frame.f_back, level + 1
    warnings.warn(message, ModelNotice, stacklevel=level)
