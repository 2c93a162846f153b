"""Parts of complex numbers; all names but I are real."""

from __future__ import annotations

from collections.abc import Callable

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, atan2, sqrt
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.complex_number import I, normal, parts
from symbody.worksheet.values.numeric import with_decimals
from symbody.worksheet.values.value import Value

__all__ = ["COMMANDS"]


def _of_parts(name: str, made: Callable[[Expr, Expr], Expr]) -> Command:
    def command(session: Session, value: Value) -> Value:
        found = parts(scalar(session, value), roots=True)
        if found is None:
            raise WorksheetError(
                f"{name}: {session.text(value)[:60]} has no real and imaginary part that is known"
            )
        return made(*found)

    command.__doc__ = f"{name}(z)."
    return command


def evalc(session: Session, value: Value) -> Value:
    """evalc(e): x + I*y with real x and y."""
    return entrywise(session, value, normal)


def _angle(x: Expr, y: Expr) -> Expr:
    return with_decimals(atan2(y, x), x, y)


def _length(x: Expr, y: Expr) -> Expr:
    return abs(x) if y.is_zero else with_decimals(sqrt(x**2 + y**2), x, y)


COMMANDS: dict[str, Command] = {
    "Re": _of_parts("Re", lambda x, y: x),
    "Im": _of_parts("Im", lambda x, y: y),
    "conjugate": _of_parts("conjugate", lambda x, y: x - I * y if not y.is_zero else x),
    "argument": _of_parts("argument", _angle),
    "abs": _of_parts("abs", _length),
    "evalc": evalc,
}
