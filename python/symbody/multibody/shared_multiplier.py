"""How redundant constraints share a load: of all multipliers in balance, those with the least of what is borne.

Rows that are left out are combinations of those that are kept, ``A_d = D A_k``, so that multipliers
``lambda = (mu - D^T s, s)`` balance the same loads as the multipliers mu of the kept ones alone, whatever s is. What is
borne, ``R(lambda) = R(mu, 0) + B N s`` with ``N = [-D^T; I]``, are the multipliers and what they make other joints
bear. The least is that of ``(B N)^T (R(mu, 0) + B N s) = 0`` [Garcia de Jalon & Gutierrez-Lopez 2013]: it is what equal
springs in the places of all these joints and constraints would bear, and doesn't depend on which constraints were left
out.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, Matrix, identity, jacobian, linear_solve, number, substitute

__all__ = ["HOW_TO_SHARE", "shared_multipliers"]

HOW_TO_SHARE = (
    "and reactions follow from them; leave out a constraint, or put a bushing in the place of a joint"
)
"""What messages say of multipliers of minimum norm."""


def shared_multipliers(
    A: Matrix, kept: Sequence[int], mu: Sequence[Expr], multipliers: Sequence[Expr], borne: Sequence[Expr]
) -> tuple[Expr, ...]:
    """Return the multipliers of all constraints by those of the kept ones, solved for at run time.

    Args:
        A: the gradients of all constraints on the level of velocities, one row each.
        kept: the rows that are kept, which are independent.
        mu: their multipliers, if they act alone.
        multipliers: the multipliers of all constraints.
        borne: what is borne, by these multipliers, in which it is linear.

    >>> from symbody import Matrix, symbols
    >>> F, one, other = symbols("F one other")
    >>> A = Matrix([[1], [2]])
    >>> [each.evaluate({F: 5}) for each in shared_multipliers(A, [0], [F], [one, other], [one, other])]
    [1.0, 2.0]
    """
    rows = A.tolist()
    left = [k for k in range(len(rows)) if k not in kept]
    alone = dict(zip(kept, mu, strict=True)) | dict.fromkeys(left, number(0))
    N = _combinations(rows, kept, left)
    BN = jacobian(list(borne), list(multipliers)) @ N
    known = dict(zip(multipliers, (alone[k] for k in range(len(rows))), strict=True))
    rest = Matrix([[each] for each in substitute(tuple(borne), known)])
    s = linear_solve(BN.T @ BN, [-each for each in (BN.T @ rest).entries])
    change = (N @ Matrix([[each] for each in s])).entries
    return tuple(alone[k] + change[k] for k in range(len(rows)))


def _combinations(rows: Sequence[Sequence[Expr]], kept: Sequence[int], left: Sequence[int]) -> Matrix:
    """Return N, whose columns are multipliers that have no effect together."""
    found = dict(zip(left, identity(len(left)).tolist(), strict=True))
    if kept:
        A_k = Matrix([rows[k] for k in kept])
        gram = A_k @ A_k.T
        D = [linear_solve(gram, A_k @ Matrix([[each] for each in rows[k]])) for k in left]
        found |= {k: [-row[i] for row in D] for i, k in enumerate(kept)}
    return Matrix([list(found[k]) for k in range(len(rows))])
