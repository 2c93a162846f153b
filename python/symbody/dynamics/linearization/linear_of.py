"""The linear model, from the deviations of all variables and the balance of forces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, islice, pairwise

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ModelError
from symbody.symbolic import (
    Expr,
    Matrix,
    free_symbols,
    identity,
    t,
    time_derivative,
    without_idle_symbols,
    zeros,
)
from symbody.symbolic.given.arguments import brief

from .balance import Balance
from .condition import check_conditions
from .ignorable import ignorable_places
from .linear import Linear
from .nonlinear_slopes import slopes_of, velocity_level
from .reference_motion import ReferenceMotion
from .second_order import FirstOrder, SecondOrder, second_order
from .variation import Columns, Variation, below, beside, picked

__all__ = ["linear_of"]

_WHERE = "linearize"


def linear_of(
    eqs: Equations, balance: Balance, vary: Variation, outputs: Mapping[str, Expr], *, keep_ignorable: bool
) -> Linear:
    """Return the linear model, with the rows of the state one kind below the other.

    Args:
        eqs: the equations of motion.
        balance: the balance of forces.
        vary: the deviations of all variables.
        outputs: the outputs by name.
        keep_ignorable: whether ignorable coordinates stay in the state.
    """
    motion, columns = balance.motion, vary.columns
    n_s, width = len(columns.coordinates), columns.count - len(columns.speeds)
    of_states = _deviations(eqs, balance, vary, [*eqs.state_rates.values()])
    of_outputs = _deviations(eqs, balance, vary, [*outputs.values()])
    rows = below(vary.rates, -balance.forces, of_states)
    left = _left(columns, balance.forces[:, width:], of_states[:, width:])
    ignorable = ignorable_places(rows, of_outputs, n_s)
    kept = [k for k in range(len(columns.variables)) if keep_ignorable or k not in ignorable]
    conditions = check_conditions(motion, _conditions(eqs, balance, columns))
    parts = _matrices(columns, left, rows, of_outputs, kept)
    _check_constant(
        motion,
        parts,
        [columns.variables[k] for k in kept],
        [*outputs],
        [columns.variables[k] for k in ignorable],
    )
    unsteady = [q for k, q in enumerate(columns.coordinates) if any(map(motion.varying, rows.row(k)))]
    found = second_order(_first_order(vary, balance), unsteady)
    if isinstance(found, SecondOrder):
        parts |= {"M": found.M, "C": found.C, "K": found.K, "F": found.F}
    parts["recovery"] = picked(below(vary.q, vary.u), None, kept)
    parts = _at_first(motion, parts)
    if isinstance(found, SecondOrder):
        found = SecondOrder(found.coordinates, *(parts[name] for name in "MCKF"))
    variables = (*eqs.coordinates, *eqs.speeds)
    known = (*variables, *motion.others)
    values = dict(zip(known, motion.first(motion.at(known)), strict=True))
    return Linear(
        states=tuple(columns.variables[k] for k in kept),
        counts=(sum(k < n_s for k in kept), len(columns.speeds), len(columns.states)),
        inputs=columns.inputs,
        outputs=tuple(outputs),
        E=parts["E"],
        A0=parts["A0"],
        B0=parts["B0"],
        C0=parts["C0"],
        C1=parts["C1"],
        D0=parts["D0"],
        second=found,
        variables=variables,
        recovery=parts["recovery"],
        about=values,
        ignorable=tuple(columns.coordinates[k] for k in ignorable),
        conditions=conditions,
        system=eqs.system,
        definitions=motion.axes.definitions,
        symbols_of_motion=tuple(
            sorted(free_symbols([*motion.given.values()]) - {t, *eqs.parameters}, key=str)
        ),
    )


def _matrices(
    columns: Columns, left: Matrix, rows: Matrix, of_outputs: Matrix, kept: Sequence[int]
) -> dict[str, Matrix]:
    """Return the first-order matrices by their names in `Linear`.

    Args:
        columns: the columns of the deviations.
        left: the factor of the rates of the state.
        rows: the deviations of these rates, times the factor.
        of_outputs: the deviations of the outputs.
        kept: the places of the state in all variables.
    """
    n_x, width = len(columns.variables), columns.count - len(columns.speeds)
    return {
        "E": picked(left, kept, kept),
        "A0": picked(rows, kept, kept),
        "B0": picked(rows[:, n_x:width], kept),
        "C0": picked(of_outputs, None, kept),
        "C1": picked(columns.spread({"v": of_outputs[:, width:]}, of_outputs.rows), None, kept),
        "D0": of_outputs[:, n_x:width],
    }


def _deviations(eqs: Equations, balance: Balance, vary: Variation, expressions: Sequence[Expr]) -> Matrix:
    """Return how expressions of all variables deviate, a row each, with the columns ``(s, v, z, r, v')``."""
    columns, N, n = vary.columns, len(eqs.coordinates), len(eqs.speeds)
    names = [
        *eqs.coordinates,
        *eqs.speeds,
        *eqs.accelerations,
        *eqs.multipliers,
        *columns.states,
        *columns.inputs,
    ]
    H = balance.motion.matrix(slopes_of(expressions, names))
    blocks = zip((vary.q, vary.u, vary.a, balance.multipliers), (N, n, n, len(eqs.multipliers)), strict=True)
    found, start = zeros(len(expressions), columns.count), 0
    for block, size in blocks:
        found, start = found + H[:, start : start + size] @ block, start + size
    k = start + len(columns.states)
    return found + columns.spread({"z": H[:, start:k], "r": H[:, k:]}, len(expressions))


def _left(columns: Columns, inertia: Matrix, of_states: Matrix) -> Matrix:
    """Return E: the identity, M of the speeds, and the accelerations in the rates of states."""
    s, v, z = len(columns.coordinates), len(columns.speeds), len(columns.states)
    return below(
        beside(identity(s), zeros(s, v + z)),
        beside(zeros(v, s), inertia, zeros(v, z)),
        beside(zeros(z, s), -of_states, identity(z)),
    )


def _conditions(
    eqs: Equations, balance: Balance, columns: Columns
) -> Iterator[tuple[str, Expr, Sequence[Expr]]]:
    """Yield what must vanish along a steady motion and doesn't by its value, each with its name and its derivatives."""
    motion, system = balance.motion, eqs.system
    whole = system.whole if system.eliminated_constraints else system
    for k, value in zip(whole.holonomic, motion.at(whole.position_constraints), strict=True):
        if not value.is_zero:
            yield f"constraint {k + 1}, {whole.conditions[k]},", value, ()
    for k, value in enumerate(motion.at(velocity_level(eqs))):
        if not value.is_zero:
            yield f"constraint {k + 1}, {system.conditions[k]}, on the level of velocities", value, ()
    rates = {**eqs.kinematics, **system.eliminated}
    for name, value in motion.given.items():
        if name in rates and name not in eqs.speeds:
            yield f"the given {name}", motion.at([rates[name] - value])[0], ()
    for k, u in enumerate(columns.speeds):
        yield f"the equation of motion of {u}", balance.residuals[k], balance.forces.row(k)
    for z, value in zip(eqs.states, eqs.state_rates.values(), strict=True):
        drift = motion.at([value])[0] - time_derivative(motion.others[z])
        yield f"the rate of the state {z}", drift, ()


def _first_order(vary: Variation, balance: Balance) -> FirstOrder:
    columns = vary.columns
    sizes = [
        len(part)
        for part in (columns.coordinates, columns.speeds, columns.states, columns.inputs, columns.speeds)
    ]
    ends = list(accumulate(sizes, initial=0))

    def blocks(matrix: Matrix) -> list[Matrix]:
        return [matrix[:, start:end] for start, end in pairwise(ends)]

    N_s, N_v, _, N_r, _ = blocks(vary.rates)
    X_s, X_v, X_z, X_r, inertia = blocks(balance.forces)
    return FirstOrder(columns.coordinates, columns.speeds, (N_s, N_v, N_r), inertia, (-X_s, -X_v, -X_z, -X_r))


def _check_constant(
    motion: ReferenceMotion,
    parts: Mapping[str, Matrix],
    states: Sequence[Expr],
    outputs: Sequence[str],
    ignorable: Sequence[Expr],
) -> None:
    """Check that no coefficient changes along the motion.

    Args:
        motion: the motion.
        parts: the matrices of the model by name.
        states: the names of the states.
        outputs: the names of the outputs.
        ignorable: the coordinates on which nothing else depends.

    Raises:
        ModelError: one does.
    """
    held = free_symbols([entry for matrix in parts.values() for entry in matrix.entries])
    if held.isdisjoint({*motion.moving, t}):
        return
    for matrix in parts.values():
        names = outputs if matrix.rows != len(states) else [f"{time_derivative(x)}" for x in states]
        for k in range(matrix.rows):
            entry = next((entry for entry in matrix.row(k) if motion.varying(entry)), None)
            if entry is None:
                continue
            moving = motion.varying(entry)[0]
            raise ModelError(
                f"{_WHERE}: the linear equations about this motion don't have constant coefficients: that of "
                f"{names[k]} is {brief(entry)}, and {moving} changes along the motion; {_way_out(k, states, ignorable)}"
            )


def _way_out(row: int, states: Sequence[Expr], ignorable: Sequence[Expr]) -> str:
    if row < len(states) and states[row] in ignorable:
        listed = ", ".join(map(str, ignorable))
        return f"nothing else depends on {brief(listed)}: pass keep_ignorable=False to leave them out"
    return (
        "expected a steady motion, or coordinates in which its equations don't change, such as those of a frame that "
        "moves with it"
    )


def _at_first(motion: ReferenceMotion, parts: Mapping[str, Matrix]) -> dict[str, Matrix]:
    """Return matrices at the first instant, in forms that contain no variables on which no value depends."""
    entries = without_idle_symbols([entry for matrix in parts.values() for entry in matrix.entries])
    left = iter(motion.first(entries))
    return {
        name: Matrix.from_entries(matrix.rows, matrix.columns, [*islice(left, len(matrix.entries))])
        for name, matrix in parts.items()
    }
