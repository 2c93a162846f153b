"""Errors are what Python calls them, too."""

from __future__ import annotations

from symbody import errors


def test_errors_are_what_python_calls_them() -> None:
    for kind in (
        errors.FrameError,
        errors.BodyError,
        errors.JointError,
        errors.LoadError,
        errors.ModelError,
        errors.ExpressionError,
    ):
        assert issubclass(kind, ValueError)
    assert issubclass(errors.DivisionByZeroError, ZeroDivisionError)
    assert issubclass(errors.ConstraintError, errors.ModelError)
