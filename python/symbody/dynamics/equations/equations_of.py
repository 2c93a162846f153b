"""Equations of motion from given parts: a mass matrix, forces and constraints that were derived elsewhere."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any, TypeAlias

from symbody.errors import ModelError, ModelNotice
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.oversight import unlisted_speeds
from symbody.multibody.state import Unknown, check_constraints, check_states, given_rates
from symbody.multibody.variables import Conditions, Coordinates, Variables
from symbody.symbolic import Expr, Matrix, derivation, diff, time_derivative
from symbody.symbolic.given.arguments import brief, counted

from .constraint_force import constraint_jacobian, with_multipliers
from .equations import Assembly, Derived, Equations
from .independence import check_independent

Rows: TypeAlias = Annotated[Matrix | Sequence[Sequence[Scalar]], "a matrix, such as Matrix([[m, 0], [0, m]])"]
Column: TypeAlias = Annotated[Matrix | Sequence[Scalar], "a list of expressions, one per speed"]
Kinematics: TypeAlias = Annotated[
    Mapping[Expr, Scalar] | None, "a dictionary of rates, such as {time_derivative(q): u}"
]
Rates: TypeAlias = Annotated[
    Mapping[Expr, object] | None,
    "a dictionary of functions of time and their rates, such as {z: (x - z)/T}",
]


@checked(ModelError)
def equations_of(
    mass_matrix: Rows,
    forcing: Column,
    coordinates: Coordinates,
    *,
    constraints: Conditions = (),
    speeds: Coordinates = (),
    kinematics: Kinematics = None,
    multipliers: Coordinates = (),
    inputs: Coordinates = (),
    states: Rates = None,
    energy: Scalar | None = None,
    name: str = "",
) -> Equations:
    """Return the equations of motion ``M u' = f + A^T lambda`` with given parts, such as other programs derive.

    They are simulated, compiled, written as code, shown and reported as those of a `System`. The forces of the
    constraints are added to f. Without bodies, nothing is drawn, and the energy is known only if it is given.

    Args:
        mass_matrix: M, n x n for n speeds. It needn't be symmetric.
        forcing: f, one expression per speed, of coordinates, speeds, time, parameters and inputs.
        coordinates: the coordinates q.
        constraints: as those of a `System`: on positions, or on velocities, ``A u + b = 0``.
        speeds: the speeds that are no rates of coordinates; those that are follow them in the order of the equations.
        kinematics: the rates ``q' = Y u + b`` of the coordinates; rates without an entry are speeds.
        multipliers: one function of time per constraint; ``lambda1``, ``lambda2``, ... by default.
        inputs: the functions of time that are given from outside; unlisted ones are inputs too.
        states: functions of time beside the mechanics, which f may hold, each with its rate; see `System`.
        energy: the energy, which is constant but for the work of moving constraints; `Motion.energy_drift` checks it.
        name: what the system is called.

    Raises:
        ModelError: sizes disagree, M or f contain accelerations, or a multiplier is in them.
        ConstraintError: a constraint is no condition on positions or velocities, or contradicts another one.

    >>> from symbody import forward_dynamics, functions_of_time, sin, symbols, time_derivative
    >>> theta, omega, (m, l, g) = *functions_of_time("theta omega"), symbols("m l g")
    >>> pendulum = equations_of(
    ...     [[m * l**2]], [-m * g * l * sin(theta)], [theta], speeds=[omega], kinematics={time_derivative(theta): omega}
    ... )
    >>> forward_dynamics(pendulum).accelerations
    (-g*sin(theta)/l,)
    """
    M = _square(mass_matrix)
    f = _column(forcing)
    rates = _coordinate_rates(kinematics or {}, coordinates)
    beside = given_rates(states, Variables.where)
    given: tuple[Expr, ...] = () if energy is None else (expression(energy),)
    variables = Variables(
        [expression(each) for each in coordinates],
        rates,
        speeds=[expression(each) for each in speeds],
        constraints=constraints,
        multipliers=multipliers,
        inputs=inputs,
        states=beside,
        others=(*M.entries, *f, *given),
        name=name,
    )
    variables.check()
    unknown = Unknown(
        variables.coordinates, variables.quasi_velocities, variables.multipliers, variables.inputs
    )
    check_states(beside, unknown, variables.where)
    check_constraints(beside, variables.conditions, variables.holonomic, unknown, variables.where)
    _check_sizes(M, f, variables)
    _check_kinematics(variables)
    with derivation():
        written = variables.by_speeds((*M.entries, *f, *given))
    n = len(f)
    entries, f, given = written[: n * n], written[n * n : n * (n + 1)], written[n * (n + 1) :]
    for k, entry in enumerate(entries):
        _check_leaves(f"M[{k // n}, {k % n}]", entry, variables)
    for k, entry in enumerate(f):
        _check_leaves(f"f[{k}]", entry, variables)
    check_independent(variables)
    _report_forces_of_constraints(f, variables)
    return _equations(Matrix.from_entries(n, n, entries), f, variables, given[0] if given else None)


def _equations(M: Matrix, f: Sequence[Expr], variables: Variables, energy: Expr | None) -> Equations:
    with derivation():
        residuals = with_multipliers(_balances(M, f, variables), variables)
        bias = tuple(-entry for entry in f)
    return Equations(variables, Derived(residuals, is_asked_for=True), Derived(Assembly(M, bias)), energy)


def _balances(M: Matrix, f: Sequence[Expr], variables: Variables) -> tuple[Expr, ...]:
    """Return ``M u' - f``."""
    accelerations = Matrix([[each] for each in variables.accelerations])
    return tuple(force - given for force, given in zip((M @ accelerations).entries, f, strict=True))


def _square(given: Matrix | Sequence[Sequence[Scalar]]) -> Matrix:
    M = given if isinstance(given, Matrix) else Matrix(given)
    rows, columns = M.shape
    if rows != columns:
        raise ModelError(
            f"equations_of: the mass matrix is {rows} x {columns}; expected a square one, with a row and a column per "
            "speed"
        )
    return M


def _column(given: Matrix | Sequence[Any]) -> tuple[Expr, ...]:
    if not isinstance(given, Matrix):
        return tuple(expression(each) for each in given)
    if 1 not in given.shape:
        rows, columns = given.shape
        raise ModelError(f"equations_of: the forcing is {rows} x {columns}; expected one column, or a list")
    return tuple(given.entries)


def _coordinate_rates(kinematics: Mapping[Expr, Any], coordinates: Sequence[Expr]) -> dict[Expr, Expr]:
    """Return the rates by coordinate; a rate that is itself is a speed."""
    known = {time_derivative(q): q for q in coordinates if q.kind == "time_function"}
    for rate in kinematics:
        if rate not in known:
            raise ModelError(
                f"equations_of: kinematics of {brief(rate)}, which isn't the rate of a coordinate; expected some of "
                f"{brief(', '.join(map(str, known)))}"
            )
    return {known[rate]: expression(value) for rate, value in kinematics.items() if value != rate}


def _check_sizes(M: Matrix, f: Sequence[Expr], variables: Variables) -> None:
    n, (rows, _) = len(variables.speeds), M.shape
    if not len(f) == rows == n:
        rates = [u for u in variables.speeds if u not in variables.quasi_velocities]
        mixed = bool(rates and variables.quasi_velocities)
        note = (
            f"; rates without kinematics are speeds, too: give those of {brief(', '.join(map(str, rates)))}"
        )
        raise ModelError(
            f"equations_of: a mass matrix of {counted(rows, 'row')} and {counted(len(f), 'force')} for "
            f"{counted(n, 'speed')}, {brief(', '.join(map(str, variables.speeds)))}; expected as many of each"
            f"{note if mixed else ''}"
        )


def _check_kinematics(variables: Variables) -> None:
    """Check that the rates of coordinates are given by speeds."""
    known = {*variables.speeds, *variables.coordinates}
    listed = (*variables.coordinates, *variables.quasi_velocities, *variables.inputs)
    for notice in unlisted_speeds(variables.coordinate_rates.values(), listed):
        warnings.warn(f"equations_of: {notice}", ModelNotice, stacklevel=4)
    for coordinate, rate in variables.coordinate_rates.items():
        (value,) = variables.by_speeds([rate])
        strange = _strange([value], variables, known)
        if strange is not None:
            raise ModelError(
                f"equations_of: the kinematics of {coordinate} hold {strange}; expected speeds, coordinates and inputs"
            )


def _check_leaves(place: str, value: Expr, variables: Variables) -> None:
    strange = _strange([value], variables, {*variables.speeds, *variables.coordinates})
    if strange is None:
        return
    raise ModelError(
        f"equations_of: {place} holds the acceleration {strange}; expected coordinates, speeds and inputs, with the "
        "coefficients of accelerations in the mass matrix"
    )


def _report_forces_of_constraints(f: Sequence[Expr], variables: Variables) -> None:
    """Give a notice of an input that stands in f as a multiplier would: its coefficients are the row of a constraint.

    The multipliers of f would be inputs, beside those that are added.
    """
    if not variables.conditions:
        return
    rows = constraint_jacobian(variables).tolist()
    listed = {each.name for each in variables.inputs}
    functions = {leaf for each in f for leaf in each.free_symbols if leaf.kind == "time_function"}
    known = {*variables.coordinates, *variables.speeds}
    for leaf in sorted((leaf for leaf in functions - known if leaf.name not in listed), key=str):
        slopes = [diff(each, leaf) for each in f]
        if any(Matrix([row, slopes]).rank() == 1 for row in rows) and not all(
            each.is_zero for each in slopes
        ):
            warnings.warn(
                f"equations_of: f holds {leaf} as the multiplier of a constraint would stand there, and {leaf} is an "
                "input, which has to be given; the forces of the constraints are added to f: leave them out of it, or "
                f"list inputs=[{leaf}] if it is one",
                ModelNotice,
                stacklevel=4,
            )


def _strange(values: Iterable[Expr], variables: Variables, known: set[Expr]) -> Expr | None:
    """Return the first function of time by name that is a rate of an unknown, and not known."""
    unknown = {each.name for each in (*variables.coordinates, *variables.speeds)}
    leaves = {leaf for value in values for leaf in value.free_symbols if leaf.kind == "time_function"}
    return min((leaf for leaf in leaves - known if leaf.name in unknown), key=str, default=None)
