"""Equations that SymPy's methods of mechanics derived: `from_sympy` of a KanesMethod, a LagrangesMethod, or joints.

Kane's method eliminates the forces of constraints: for n speeds, m of them dependent, SymPy has n - m equations
``K u' = f`` [Kane & Levinson 1985, sec. 4.11]. Here they are the first rows of n equations with the multipliers of the
constraints, whose other rows are zero: with ``(f, 0) + A^T lambda = (K u', 0)`` and m independent columns of A in the
dependent speeds, the multipliers are zero, and the first rows are Kane's.
"""

# ruff: noqa: SLF001  SymPy has no public names for the constraints of its methods.
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symbody.errors import ModelError
from symbody.symbolic import Expr, Matrix, derivation, jacobian, number
from symbody.symbolic.sympy_bridge.methods import Convert, converts

from .equations import Equations
from .equations_of import equations_of

_MECHANICS = "sympy.physics.mechanics"


@converts(f"{_MECHANICS}.lagrange.LagrangesMethod")
def of_lagrange(method: Any, convert: Convert) -> Equations:
    """Return the equations of a LagrangesMethod; its multipliers keep their names.

    Constraints on positions stay such, and are not replaced by their rates.
    """
    if method.eom is None:
        raise _not_formed(method, "form_lagranges_equations()")
    n, holonomic = len(method.q), len(method._hol_coneqs)
    M = method.mass_matrix[:, :n]
    return equations_of(
        convert(M),
        convert(method.forcing),
        convert(list(method.q)),
        constraints=convert([*method._hol_coneqs, *method.coneqs[holonomic:]]),
        multipliers=convert(list(method.lam_vec)),
    )


@converts(f"{_MECHANICS}.kane.KanesMethod")
def of_kane(method: Any, convert: Convert) -> Equations:
    """Return the equations of a KanesMethod, with its kinematics and constraints; auxiliary speeds are zero."""
    if method._fr is None or method._frstar is None:
        raise _not_formed(method, "kanes_equations(bodies, loads)")
    zero = {part: 0 for u in method._uaux for part in (u.diff(), u)}

    def known(part: Any) -> Any:
        return convert(part.subs(zero) if zero else part)

    speeds, dependent = convert(list(method.u)), len(method._udep)
    rates = {convert(rate): known(value) for rate, value in method.kindiffdict().items()}
    K, f = known(method._k_d), known(-method._f_d)
    nothing = [number(0)] * len(speeds)
    rows = [*K.tolist(), *([nothing] * dependent)]
    velocity = [*known(method._k_nh * method.u + method._f_nh)] if dependent else []
    coordinates = convert(list(method.q))
    position = [known(each) for each in method._f_h]
    return equations_of(
        Matrix(rows),
        [*f.entries, *nothing[:dependent]],
        coordinates,
        constraints=_independent(position, velocity, coordinates, speeds, rates),
        speeds=speeds,
        kinematics=rates,
    )


@converts(f"{_MECHANICS}.jointsmethod.JointsMethod")
def of_joints(method: Any, convert: Convert) -> Any:
    """Return the equations of the method to which a JointsMethod delegates."""
    if method.method is None:
        raise _not_formed(method, "form_eoms()")
    return convert(method.method)


@converts(f"{_MECHANICS}.system.System")
def of_system(system: Any, convert: Convert) -> Any:
    """Return the equations of the method to which a System of SymPy delegates."""
    if system.eom_method is None:
        raise _not_formed(system, "form_eoms()")
    return convert(system.eom_method)


def _not_formed(method: object, call: str) -> ModelError:
    return ModelError(
        f"from_sympy: the {type(method).__name__} has no equations yet; call its {call} first, which derives them"
    )


def _independent(
    position: Sequence[Expr],
    velocity: Sequence[Expr],
    coordinates: Sequence[Expr],
    speeds: Sequence[Expr],
    rates: dict[Expr, Expr],
) -> list[Expr]:
    """Return the constraints on positions, unless kinematics keep them, and those on velocities that they don't imply.

    SymPy takes the rates of constraints on positions among those on velocities.

    Args:
        position: the constraints on positions.
        velocity: those on velocities.
        coordinates: the coordinates.
        speeds: the speeds.
        rates: the rates of the coordinates, in their order, by the speeds.

    Raises:
        ModelError: SymPy's constraints on velocities don't keep one on positions.
    """
    kept: list[Expr] = []
    with derivation():
        rows: list[list[Expr]] = []
        for condition in position:
            slopes = jacobian([condition], coordinates).tolist()[0]
            moved = sum(
                (slope * rate for slope, rate in zip(slopes, rates.values(), strict=True)), start=number(0)
            )
            row = jacobian([moved], speeds).tolist()[0]
            if not moved.is_zero:
                kept.append(condition)
                rows.append(row)
        for condition in velocity:
            row = jacobian([condition], speeds).tolist()[0]
            if Matrix([*rows, row]).rank() == len(rows) + 1:
                kept.append(condition)
                rows.append(row)
    if len(rows) != len(velocity):
        raise ModelError(
            "from_sympy: the KanesMethod has a configuration constraint whose rate is not among the combinations of "
            "its velocity constraints, so that its equations don't keep it; add the rate to velocity_constraints"
        )
    return kept
