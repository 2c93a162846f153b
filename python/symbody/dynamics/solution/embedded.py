"""Embedding of constraints: the equations of motion in independent speeds, without multipliers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Annotated, NamedTuple, TypeAlias

from symbody.dynamics.equations.equations import Assembly, Derived, Equations
from symbody.dynamics.equations.independence import demands_motion
from symbody.errors import ConstraintError, ExpressionError, ModelError
from symbody.geometry.given.argument import checked
from symbody.symbolic import (
    MOTION,
    Dependence,
    Expr,
    Matrix,
    cost,
    derivation,
    linear_solve,
    number,
    substitute,
    without_idle_symbols,
)
from symbody.symbolic.given.arguments import brief, counted

from .dependent_speeds import place_of

Speeds: TypeAlias = Annotated[Sequence[Expr], "a list of speeds, such as time_derivative(x)"]


@checked(ModelError)
def embedded(eqs: Equations, independent: Speeds | None = None) -> Equations:
    """Return the equations in independent speeds v: ``Z^T M Z v' = Z^T (f - M z)`` [Wehage & Haug 1982; Maggi 1896].

    The constraints ``A u + b = 0`` give all speeds, ``u = Z v + y`` with ``A Z = 0``, and their rates,
    ``u' = Z v' + z``. The columns of Z are Kane's partial velocities of a nonholonomic system: applied to `kane`, these
    are his equations with the dependent speeds eliminated. Applied to `lagrange_equations`, they are Maggi's.

    The equations have no constraints and no multipliers. All coordinates stay, with their rates by the independent
    speeds. A motion begins at positions that satisfy the eliminated constraints: those that are not given are solved
    for. It keeps them up to the errors of integration, which `Motion.constraint_drift` shows. Equilibria and inverse
    dynamics know them too. The equations divide by the determinant of the dependent columns of A; where it vanishes,
    other speeds must be independent. A notice tells if a motion passes such a position, as a slide at a dead centre.

    Args:
        eqs: the equations of motion, by any formalism.
        independent: as many speeds as there are degrees of freedom, in the order of the equations. By default, the
            dependent speeds are those with coefficients that contain no coordinates, where there are such, so that they
            never vanish; then those with the shortest ones, and the last.

    Raises:
        ConstraintError: there are too few or too many speeds, or the constraints don't determine the others.
        ModelError: the speeds are momenta, or the rate of a state holds a multiplier.

    >>> from symbody import Body, System, functions_of_time, kane, symbols, time_derivative, translate
    >>> (x, y), (m, a) = functions_of_time("x y"), symbols("m a")
    >>> xt, yt = time_derivative(x), time_derivative(y)
    >>> skate = embedded(kane(System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[yt - a * x * xt])))
    >>> skate.speeds, skate.kinematics[yt]
    ((x',), a*x*x')
    >>> skate.mass_matrix[0, 0] == m * (1 + a**2 * x**2), skate.bias[0] == m * a**2 * x * xt**2
    (True, True)
    """
    if eqs.system.momenta:
        raise ModelError(
            f"embedded: the speeds of the equations are momenta, {brief(', '.join(map(str, eqs.speeds)))}; expected "
            "equations in speeds, such as newton_euler(system), or constraints that the kinematics of the system embed"
        )
    if not eqs.constraints and independent is None:
        return eqs
    _check_states(eqs)
    relation = _chosen(eqs, independent)  # its quotients by pivots must not take part in the derivation
    with derivation(fresh=True, order=MOTION):
        dependent, rows = relation.dependent, relation.rows
        level = eqs.system.velocity_level(eqs.constraints)
        speeds = relation.solved(substitute([level[k] for k in rows], dict.fromkeys(dependent, 0)))
        values = dict(zip(dependent, without_idle_symbols(speeds), strict=True))
        system = eqs.system.eliminating(values)
        assembly = _reduced(eqs, relation, values).of_first_order(system)
        products = assembly.mass_matrix @ Matrix([[a] for a in system.accelerations])
        residuals = tuple(
            product + rest for product, rest in zip(products.entries, assembly.bias, strict=True)
        )
        energy = None if eqs.energy is None else system.by_speeds([eqs.energy])[0]
    balanced = Derived(without_idle_symbols(residuals))
    return Equations(system, balanced, Derived(assembly.without_idle_symbols()), energy, eqs)


def _check_states(eqs: Equations) -> None:
    """Check that no rate of a state holds a multiplier, which the embedded equations don't have.

    Raises:
        ModelError: one does.
    """
    for name, rate in eqs.state_rates.items():
        held = next((each for each in eqs.multipliers if each in rate.free_symbols), None)
        if held is not None:
            raise ModelError(
                f"embedded: {name} = {brief(rate)} holds the multiplier {held}, which embedded equations don't have; "
                "expected rates of states without multipliers: simulate the equations with multipliers"
            )


class _Relation(NamedTuple):
    """The constraints as equations of the dependent speeds.

    Attributes:
        A: the constraint Jacobian, m x n.
        rows: the places of independent constraints.
        columns: the places of the dependent speeds, as many.
        speeds: all speeds.
    """

    A: Matrix
    rows: Sequence[int]
    columns: Sequence[int]
    speeds: Sequence[Expr]

    @property
    def dependent(self) -> list[Expr]:
        return [self.speeds[k] for k in self.columns]

    @property
    def independent(self) -> list[int]:
        """The places of the independent speeds."""
        return [k for k in range(len(self.speeds)) if k not in self.columns]

    def solved(self, rest: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the dependent unknowns x with ``A x + rest = 0``, in the dependent columns of A."""
        right = [-entry for entry in rest]
        if not right:
            return ()
        square = Matrix([[self.A[row, column] for column in self.columns] for row in self.rows])
        with suppress(ExpressionError):
            return tuple(Dependence(square).completed({}, right))
        return tuple(linear_solve(square, right))

    def completed(self, free: Mapping[int, Expr], rest: Sequence[Expr]) -> list[Expr]:
        """Return all n unknowns: those that are given, and the dependent ones."""
        values = dict(free) | dict(zip(self.columns, self.solved(rest), strict=True))
        return [values.get(k, number(0)) for k in range(len(self.speeds))]


def _reduced(eqs: Equations, relation: _Relation, dependent: Mapping[Expr, Expr]) -> Assembly:
    """Return ``Z^T M Z`` and ``Z^T (bias + M z)``."""
    A, rows, one = relation.A, relation.rows, number(1)
    Z = [relation.completed({k: one}, [A[row, k] for row in rows]) for k in relation.independent]
    at_rest = dict.fromkeys(eqs.accelerations, number(0))
    changes = substitute(eqs.system.rate(eqs.system.velocity_level(eqs.constraints)), at_rest)
    z = relation.completed({}, substitute([changes[row] for row in rows], dependent))
    M, bias = eqs.mass_matrix, substitute(eqs.bias, dependent)
    forces = [push + rest for push, rest in zip((M @ Matrix([[a] for a in z])).entries, bias, strict=True)]
    lines = Matrix(Z)
    reduced = lines @ Matrix([[force] for force in forces])
    return Assembly(lines @ M @ lines.T, reduced.entries)


def _chosen(eqs: Equations, independent: Speeds | None) -> _Relation:
    A, speeds = eqs.constraint_jacobian, eqs.speeds
    given = None if independent is None else [place_of(speed, eqs, "embedded") for speed in independent]
    rows, columns = _pivots(A, range(len(speeds)) if given is None else _others(given, len(speeds)), eqs)
    rank = len(rows) if given is None else A.rank()
    if rank == len(speeds):
        raise ConstraintError(f"embedded: {without_freedom(eqs)}")
    if given is not None and len(set(given)) != len(speeds) - rank:
        raise ConstraintError(
            f"embedded: {counted(len(set(given)), 'independent speed')}, {counted(len(speeds), 'speed')} and "
            f"{counted(rank, 'independent constraint')}; expected {len(speeds) - rank} of them"
        )
    if len(rows) < rank:
        left = ", ".join(str(speeds[k]) for k in range(len(speeds)) if k not in (given or []))
        raise ConstraintError(
            f"embedded: the constraints don't determine {brief(left)} by the independent speeds; choose others, or "
            "leave independent out"
        )
    return _Relation(A, rows, columns, speeds)


def without_freedom(eqs: Equations) -> str:
    """Return what is wrong with equations whose constraints determine all speeds, and the way out."""
    speeds = brief(", ".join(map(str, eqs.speeds)))
    if demands_motion(eqs.system):
        return (
            f"the constraints determine all speeds, {speeds}; expected fewer constraints: the motion follows from them "
            "alone"
        )
    return (
        f"the constraints determine all speeds, {speeds}, unless dimensions are special; expected fewer constraints: "
        "if special dimensions let the mechanism move, leave out the redundant ones, which system.mobility(parameters, "
        "q) names"
    )


def _others(places: Sequence[int], count: int) -> list[int]:
    return [k for k in range(count) if k not in places]


def _pivots(A: Matrix, columns: Sequence[int], eqs: Equations) -> tuple[list[int], list[int]]:
    """Return the places of independent constraints and of the speeds that they determine, by Gaussian elimination."""
    rows, chosen, reduced = list[int](), list[int](), list[list[Expr]]()
    for place in range(A.rows):
        row = list(A.row(place))
        for column, other in zip(chosen, reduced, strict=True):
            factor = row[column] / other[column]
            row = [entry - factor * its for entry, its in zip(row, other, strict=True)]
        found = [column for column in columns if column not in chosen and not row[column].is_zero]
        if found:
            chosen.append(min(found, key=lambda column: _doubt(row[column], column, eqs)))
            rows.append(place)
            reduced.append(row)
    return rows, chosen


def _doubt(pivot: Expr, column: int, eqs: Equations) -> tuple[bool, int, int]:
    """Return what puts pivots in order: those that contain no coordinates, then short ones, then the last."""
    holds = not pivot.free_symbols.isdisjoint(eqs.coordinates)
    return holds, cost([pivot]).total, -column
