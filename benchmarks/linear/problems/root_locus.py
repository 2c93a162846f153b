"""The root locus of Sharp's motorcycle: five hundred speeds, from its linear model in symbols to branches."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

from symbody import Expr, Linear, linearize, newton_euler, root_locus, symbols, time_derivative
from symbody.models import motorcycle

from ..problem import Contender, Problem, Values

SPEEDS = np.linspace(5, 60, 500)


@cache
def linear_model() -> tuple[Linear, dict[Expr, float], Expr]:
    """Return the linear model, its parameters, and the speed; it is derived once for each contender."""
    model, v = motorcycle(), symbols("v")
    forward = time_derivative(model["x"])
    linear = linearize(newton_euler(model.system), about={forward: v}, keep_ignorable=False)
    return linear, dict(model.parameters), v


def by_symbody() -> Values:
    """Follow the branches, and locate the critical speeds; return the eigenvalues at the last speed."""
    linear, parameters, v = linear_model()
    locus = root_locus(linear, parameters, over={v: SPEEDS})
    assert len(locus.critical) == 3
    return [*locus.eigenvalues[-1].tolist()]


def lambdified() -> Callable[..., list[Any]]:
    """Return A0 and E as a function of the parameters and the speed, by SymPy."""
    from sympy import Matrix, lambdify  # noqa: PLC0415 - only if it is measured

    linear, parameters, v = linear_model()
    matrices = [
        Matrix(each.rows, each.columns, [x.to_sympy() for x in each.entries])
        for each in (linear.A0, linear.E)
    ]
    function: Callable[..., list[Any]] = lambdify(
        [name.to_sympy() for name in (*parameters, v)], matrices, "numpy", cse=True
    )
    return function


def by_sympy_and_scipy() -> Values:
    """Lambdify E and A0 by SymPy, and solve the pencil by SciPy, speed by speed, without branches."""
    from scipy.linalg import eigvals  # noqa: PLC0415 - only if it is measured

    _, parameters, _ = linear_model()
    function = lambdified()
    values: Values = []
    for speed in SPEEDS:
        values = [*eigvals(*function(*parameters.values(), speed)).tolist()]
    return values


def by_python_control() -> Values:
    """Make a state space of python-control at each speed, of matrices lambdified by SymPy, and ask it for its poles."""
    from control import poles, ss  # noqa: PLC0415 - only if it is measured

    linear, parameters, _ = linear_model()
    function = lambdified()
    values: Values = []
    n = len(linear.states)
    for speed in SPEEDS:
        A0, E = function(*parameters.values(), speed)
        space = ss(np.linalg.solve(E, A0), np.zeros((n, 1)), np.eye(n), np.zeros((n, 1)))
        values = [*map(complex, poles(space))]
    return values


_HAS_SYMPY = find_spec("sympy") is not None

ROOT_LOCUS = Problem(
    "root_locus",
    "The root locus of a motorcycle, at five hundred speeds",
    "Sharp's motorcycle with ten states: the nonlinear equations, the linear ones in symbols, which all contenders "
    "take from symbody, and the eigenvalues at 500 speeds. symbody compiles and evaluates the matrices at once, "
    "follows the branches by their eigenvectors, and locates the three critical speeds. The rivals lambdify the same "
    "matrices by SymPy with common subexpressions, and find the eigenvalues speed by speed; they have no branches.",
    (
        Contender("symbody", by_symbody),
        Contender("SymPy's lambdify, SciPy's eigvals", by_sympy_and_scipy, is_installed=_HAS_SYMPY),
        Contender(
            "SymPy's lambdify, python-control",
            by_python_control,
            is_installed=_HAS_SYMPY and find_spec("control") is not None,
        ),
    ),
    bound=0.5,
)
