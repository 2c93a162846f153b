"""Programs of linear models: routines that compute their matrices from the parameters."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.dynamics.solution.program_result import matrix_result
from symbody.errors import notify
from symbody.symbolic import Argument, Matrix, Program, Result, Routine
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.identifier import program_name, title_identifier
from symbody.symbolic.numeric.program import program_of

from .linear import Linear
from .second_order import SecondOrder

__all__ = ["linear_program"]


@program_of.register
def linear_program(linear: Linear, *, name: str | None = None) -> Program:
    """Return the routines of a linear model, of which ``generate`` makes code: A(p), B(p), C(p), D(p) and M(p), ...

    Args:
        linear: the linear model.
        name: the name of the generated code, as an identifier; by default the name of the system, or "linear".

    >>> from symbody import equations_of, functions_of_time, linearize, symbols
    >>> x, k = functions_of_time("x"), symbols("k")
    >>> made = linear_program(linearize(equations_of([[1]], [-k * x], [x])))
    >>> [routine.name for routine in made.routines]
    ['state_space', 'first_order', 'second_order']
    """
    states, inputs = (", ".join(map(str, names)) for names in (linear.states, linear.inputs))
    of_inputs = f" with r = ({inputs})" if inputs else ""
    routines = [
        _routine(
            "state_space",
            "x' = A x + B r, y = C x + D r",
            {"A": linear.A, "B": linear.B, "C": linear.C, "D": linear.D},
            linear,
        ),
        _routine(
            "first_order", "E x' = A0 x + B0 r", {"E": linear.E, "A0": linear.A0, "B0": linear.B0}, linear
        ),
    ]
    if isinstance(linear.second, SecondOrder):
        form = linear.second
        of = ", ".join(map(str, form.coordinates))
        meaning = f"M q'' + C q' + K q = F r with q = ({of})"
        routines.append(
            _routine("second_order", meaning, {"M": form.M, "C": form.C, "K": form.K, "F": form.F}, linear)
        )
    if linear.conditions:
        routines.append(_of_conditions(linear))
    p = linear.parameters
    arguments = [Argument("p", f"parameters: {', '.join(map(str, p))}", p, "parameters")] if p else []
    named = title_identifier(linear.name, "linear") if name is None else program_name(name, "linear_program")
    return Program(
        named,
        f"small deviations x = ({states}) from a steady motion{of_inputs}",
        tuple(arguments),
        tuple(routines),
    )


def _of_conditions(linear: Linear) -> Routine:
    """Return the routine of what the parameters must make zero; a notice reports it."""
    names = "; ".join(each.name for each in linear.conditions)
    values = tuple(each.value for each in linear.conditions)
    notify(
        f"linear_program: the matrices hold for parameters with which the values in about are a steady motion; "
        f"what must vanish is in the routine conditions: {brief(names)}, {brief(values[0])}"
    )
    result = Result("residuals", f"what must vanish: {names}", values, (len(values),))
    meaning = f"what must vanish, so that the values in about are a steady motion: {names}"
    return Routine("conditions", meaning, ("p",) if linear.parameters else (), (result,))


def _routine(name: str, meaning: str, matrices: Mapping[str, Matrix], linear: Linear) -> Routine:
    """Return a routine of the matrices that have entries."""
    results = tuple(matrix_result(key, matrix) for key, matrix in matrices.items() if matrix.entries)
    return Routine(name, meaning, ("p",) if linear.parameters else (), results)
