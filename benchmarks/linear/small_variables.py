"""Small variables against truncation afterwards: a chain of rods in space, hanging, each turned in two directions.

All contenders give the linear equations of the chain: residuals, mass matrix and bias. One derives them of small
variables; one derives the exact equations, and truncates them by `taylor`; SymPy differentiates its Lagrangian, and
linearises by Jacobians at zero.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from random import Random
from statistics import median
from time import perf_counter
from typing import Any

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    Vector,
    cost,
    functions_of_time,
    ground,
    kane,
    lagrange_equations,
    newton_euler,
    rotate,
    small,
    symbols,
    taylor,
    time_derivative,
    translate,
)

from ..page import write_page

SIZES, ROUNDS = (3, 10, 30), 5
SYMPY_SIZES = (1,)
PARAMETERS = "l m Ia Ib g"


@dataclass(frozen=True)
class Found:
    """What one contender gives: seconds, operations, and the residuals at a random point."""

    seconds: float
    operations: int
    residuals: tuple[float, ...]


def chain(q: Sequence[Expr]) -> System:
    """Return rods in a chain, two coordinates each."""
    l, m, Ia, Ib, g = symbols(PARAMETERS)
    frame, bodies = ground, list[Body]()
    for lean, swing in zip(q[::2], q[1::2], strict=True):
        frame = frame * rotate("X", lean) * rotate("Y", swing)
        bodies.append(Body(frame * translate(0, 0, -l / 2), m, Ix=Ia, Iy=Ia, Iz=Ib))
        frame = frame * translate(0, 0, -l)
    return System(bodies, coordinates=q, gravity=Vector(ground, 0, 0, -g))


def names(rods: int) -> list[str]:
    """Return the names of the coordinates."""
    return [f"q{k}" for k in range(2 * rods)]


def of_small_variables(formalism: Callable[[System], Equations], rods: int) -> Found:
    """Derive the equations of small variables."""
    gc.collect()
    start = perf_counter()
    q = [small(each) for each in functions_of_time(names(rods))]
    equations = formalism(chain(q))
    entries = (*equations.residuals, *equations.mass_matrix.entries, *equations.bias)
    seconds = perf_counter() - start
    return Found(seconds, cost(entries).total, _values(equations.residuals, q))


def truncated_afterwards(formalism: Callable[[System], Equations], rods: int) -> Found:
    """Derive the exact equations, and truncate them."""
    gc.collect()
    start = perf_counter()
    q = functions_of_time(names(rods))
    equations = formalism(chain(q))
    residuals, bias = taylor((equations.residuals, equations.bias), q)
    mass_matrix = taylor(equations.mass_matrix, q, 0)
    seconds = perf_counter() - start
    return Found(seconds, cost((*residuals, *mass_matrix.entries, *bias)).total, _values(residuals, q))


def by_sympy(rods: int) -> Found:
    """Differentiate the Lagrangian by SymPy, and linearise at zero, with common subexpressions counted once."""
    import sympy as sp  # noqa: PLC0415 - a rival, which need not be installed

    start = perf_counter()
    t, (l, m, Ia, Ib, g) = sp.Symbol("t"), sp.symbols(PARAMETERS)
    q = [sp.Function(name)(t) for name in names(rods)]
    residuals = _lagrangian_residuals(sp, q, t, (l, m, Ia, Ib, g))
    levels = [q, [x.diff(t) for x in q], [x.diff(t, 2) for x in q]]
    at_rest = [(x, 0) for level in reversed(levels) for x in level]
    matrices = [residuals.jacobian(level).subs(at_rest) for level in levels]
    linear = sum(
        (M * sp.Matrix(level) for M, level in zip(matrices, levels, strict=True)), sp.zeros(len(q), 1)
    )
    replaced, reduced = sp.cse([*linear, *matrices[2], *(matrices[0] * sp.Matrix(q))])
    seconds = perf_counter() - start
    operations = int(sp.count_ops([*(value for _, value in replaced), *reduced]))
    values = {
        x: value for level, n in zip(levels, range(3), strict=True) for x, value in _point(level, n).items()
    }
    found = linear.subs([(x, values[x]) for level in reversed(levels) for x in level])
    numbers = dict(zip((l, m, Ia, Ib, g), _PARAMETERS, strict=True))
    return Found(seconds, operations, tuple(float(each.subs(numbers)) for each in found))


def _lagrangian_residuals(sp: Any, q: Sequence[Any], t: Any, parameters: Sequence[Any]) -> Any:
    l, m, Ia, Ib, g = parameters
    R, place, kinetic, height = sp.eye(3), sp.zeros(3, 1), 0, 0
    down = sp.Matrix([0, 0, -l])
    for lean, swing in zip(q[::2], q[1::2], strict=True):
        R = R * sp.rot_axis1(-lean) * sp.rot_axis2(-swing)
        v = (place + R * down / 2).diff(t)
        W = R.T * R.diff(t)
        x, y, z = W[2, 1], W[0, 2], W[1, 0]
        kinetic += m * v.dot(v) / 2 + (Ia * (x**2 + y**2) + Ib * z**2) / 2
        height += m * g * (place + R * down / 2)[2]
        place += R * down
    L = kinetic - height
    return sp.Matrix([L.diff(x.diff(t)).diff(t) - L.diff(x) for x in q])


_PARAMETERS = (0.7, 1.3, 0.11, 0.05, 9.81)


def _point(variables: Sequence[Any], order: int) -> dict[Any, float]:
    """Return values of variables, or of their derivatives: the same for all contenders."""
    return {x: Random(f"{k} {order}").uniform(-1, 1) for k, x in enumerate(variables)}


def _values(residuals: Sequence[Expr], q: Sequence[Expr]) -> tuple[float, ...]:
    values = dict(zip(symbols(PARAMETERS), _PARAMETERS, strict=True))
    for order in range(3):
        values |= _point([time_derivative(x, order) if order else x for x in q], order)
    return tuple(float(each.evaluate(values)) for each in residuals)


Contender = Callable[[int], Found]
FORMALISMS = (newton_euler, lagrange_equations, kane)


def contenders() -> dict[str, tuple[Contender, tuple[int, ...]]]:
    """Return the contenders, each with its sizes."""
    table: dict[str, tuple[Contender, tuple[int, ...]]] = {}
    for formalism in FORMALISMS:
        name = formalism.__name__
        table[f"{name}, small variables"] = partial(of_small_variables, formalism), SIZES
        table[f"{name}, truncated afterwards"] = partial(truncated_afterwards, formalism), SIZES
    return table | {"SymPy, Lagrange, linearised afterwards": (by_sympy, SYMPY_SIZES)}


def measure(contender: Contender, rods: int, rounds: int = ROUNDS) -> Found:
    """Return what a contender finds, with the median of its times."""
    found = [contender(rods)]
    while len(found) < rounds and found[0].seconds < 1:
        found.append(contender(rods))
    return Found(median(each.seconds for each in found), found[0].operations, found[0].residuals)


TEXT = """\
# Small variables and truncation afterwards

Written by `python -m benchmarks.linear.small_variables`. A chain of n rods hangs in space, each turned in two
directions. All contenders give residuals, mass matrix and bias of the linear equations, and agree at random points.
Times are medians, the model included; operations are those of all results together, common subexpressions counted
once.

| contender | n | time | operations |
|---|---|---|---|
"""


def main() -> None:
    """Measure all contenders, and write the report."""
    rows = []
    for name, (contender, sizes) in contenders().items():
        for rods in sizes:
            found = measure(contender, rods)
            rows.append(f"| {name} | {rods} | {found.seconds * 1000:.3g} ms | {found.operations} |")
            print(rows[-1], file=sys.stderr)
    write_page("small_variables.md", TEXT + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
