"""What the problems ask of symbody's equations."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symbody import Equations, Expr, System, lagrange_equations, newton_euler

Formalism = Callable[[System], Equations]

FORMALISMS: Mapping[str, Formalism] = {"newton_euler": newton_euler, "lagrange_equations": lagrange_equations}


def residuals(formalism: Formalism, system: System) -> list[Expr]:
    """Return the left sides of the equations of motion."""
    return list(formalism(system).residuals)


def mass_matrix_and_bias(formalism: Formalism, system: System) -> list[Expr]:
    """Return the upper triangle of M, row by row, and the bias h, with ``M q'' + h = 0``."""
    equations = formalism(system)
    n = len(system.coordinates)
    triangle = [entry for i in range(n) for entry in equations.mass_matrix.row(i)[i:]]
    return triangle + list(equations.bias)
