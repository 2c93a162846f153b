"""Dependent speeds: the rates of the constraints, solved for as many speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ConstraintError, ModelError
from symbody.geometry.given.argument import checked
from symbody.symbolic import MOTION, Expr, Matrix, derivation, linear_solve, substitute
from symbody.symbolic.given.arguments import brief, counted

Speeds: TypeAlias = Annotated[Sequence[Expr], "a list of speeds, such as time_derivative(x)"]


@checked(ModelError)
def dependent_speeds(eqs: Equations, dependent: Speeds) -> dict[Expr, Expr]:
    """Return the dependent speeds by the others, from ``phi' = 0``; the linear system is solved at run time.

    Args:
        eqs: the equations of motion.
        dependent: as many speeds as there are constraints; the others are independent.

    Raises:
        ConstraintError: there are too few or too many, or the constraints don't determine them.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, time_derivative, translate
    >>> (x, y), (m, l) = functions_of_time("x y"), symbols("m l")
    >>> circle = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
    >>> speed = time_derivative(y)
    >>> dependent_speeds(newton_euler(circle), [speed])[speed] == -x * time_derivative(x) / y
    True
    """
    columns = [place_of(speed, eqs, "dependent_speeds") for speed in dependent]
    if len(set(columns)) != len(eqs.constraints) or len(columns) != len(eqs.constraints):
        raise ConstraintError(
            f"dependent_speeds: {counted(len(set(columns)), 'speed')}, "
            f"{counted(len(eqs.constraints), 'constraint')}; expected one speed per constraint"
        )
    J = eqs.constraint_jacobian
    matrix = Matrix([[J[k, column] for column in columns] for k in range(len(columns))])
    if matrix.rank() < len(columns):
        raise ConstraintError(
            f"dependent_speeds: the constraints don't determine {', '.join(map(str, dependent))}, whatever the others "
            "are; choose other dependent speeds"
        )
    with derivation(fresh=True, order=MOTION):
        rates = substitute(eqs.system.velocity_level(eqs.constraints), dict.fromkeys(dependent, 0))
        values = linear_solve(matrix, [-rate for rate in rates])
    return dict(zip(dependent, values, strict=True))


def place_of(speed: Expr, eqs: Equations, where: str) -> int:
    """Return the index of a speed in the equations; `where` is the function that the user called."""
    if speed not in eqs.speeds:
        raise ConstraintError(
            f"{where}: {brief(speed)} is not a speed; expected some of "
            f"{brief(', '.join(map(str, eqs.speeds)))}"
        )
    return eqs.speeds.index(speed)
