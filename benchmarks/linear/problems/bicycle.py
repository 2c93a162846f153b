"""The benchmark bicycle: from its bodies to the eigenvalues at a hundred speeds."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np

from symbody import linearize, newton_euler, state_space, symbols, time_derivative
from symbody.models import bicycle

from ..problem import Contender, Problem, Values

SPEEDS = np.linspace(0.1, 10, 100)


def by_symbody() -> Values:
    """Return the eigenvalues of lean and steering at all speeds."""
    model, v = bicycle(), symbols("v")
    lean, steer = model["lean"], model["steer"]
    about = {time_derivative(model["rear_angle"]): -v / model["rR"]}
    lateral = [lean, steer, time_derivative(lean), time_derivative(steer)]
    linear = linearize(newton_euler(model.system), about).part(lateral)
    values: Values = np.linalg.eigvals(state_space(linear, {**model.parameters, v: SPEEDS}).A).ravel()
    return values


def by_sympy() -> Values:
    """Run SymPy's own test of this bicycle, which derives, linearises, and compares A at six speeds."""
    from sympy.physics.mechanics.tests.test_kane3 import test_bicycle  # noqa: PLC0415 - only if it is measured

    test_bicycle()
    return ()


BICYCLE = Problem(
    "bicycle",
    "The bicycle, at a hundred speeds",
    "The Carvallo-Whipple bicycle of Meijaard et al. (2007), from four bodies and joints to the nonlinear equations "
    "with rolling constraints, to A in symbols, and to the eigenvalues at 100 speeds. SymPy's contender is its own "
    "test `test_kane3.py::test_bicycle`, unchanged: Kane's equations, `KanesMethod.linearize` with Cramer's rule, and "
    "a comparison of A with numbers at six speeds.",
    (
        Contender("symbody", by_symbody),
        Contender("SymPy, its own test", by_sympy, is_slow=True, is_installed=find_spec("sympy") is not None),
    ),
    bound=0.3,
)
