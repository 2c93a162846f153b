"""How redundant constraints share a force: of all multipliers in balance, those of minimum norm.

Rows that are left out are combinations of those that are kept, ``A = [I; D] A_k``. Forces in balance are those of
``lambda_k + D^T lambda_d = mu`` with the multipliers mu of the kept ones alone; the least of them, in the range of A,
are ``lambda_d = (I + D D^T)^-1 D mu`` [Garcia de Jalon & Gutierrez-Lopez 2013]. They are what equal springs in the
places of the constraints would bear, and don't depend on which constraints were left out.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, Matrix, identity, linear_solve

__all__ = ["HOW_TO_SHARE", "shared_multipliers"]

HOW_TO_SHARE = (
    "and reactions follow from them; leave out a constraint, or put a bushing in the place of a joint"
)
"""What messages say of multipliers of minimum norm."""


def shared_multipliers(A: Matrix, kept: Sequence[int], mu: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the multipliers of all constraints by those of the kept ones, solved for at run time.

    Args:
        A: the gradients of all constraints on the level of velocities, one row each.
        kept: the rows that are kept, which are independent.
        mu: their multipliers, if they act alone.

    >>> from symbody import Matrix, symbols
    >>> F = symbols("F")
    >>> [each.evaluate({F: 5}) for each in shared_multipliers(Matrix([[1], [2]]), [0], [F])]
    [1.0, 2.0]
    """
    rows = A.tolist()
    left = [k for k in range(len(rows)) if k not in kept]
    if not kept:
        return tuple(0 * rows[0][0] for _ in left)
    A_k = Matrix([rows[k] for k in kept])
    gram = A_k @ A_k.T
    D = Matrix([linear_solve(gram, A_k @ Matrix([[each] for each in rows[k]])) for k in left])
    column = Matrix([[each] for each in mu])
    of_left = Matrix([[each] for each in linear_solve(identity(len(left)) + D @ D.T, D @ column)])
    of_kept = column - D.T @ of_left
    found = dict(zip((*kept, *left), (*of_kept.entries, *of_left.entries), strict=True))
    return tuple(found[k] for k in range(len(rows)))
