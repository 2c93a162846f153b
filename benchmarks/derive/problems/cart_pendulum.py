"""P1: the pendulum of n links on a cart: mass matrix and bias, with running sums to be found."""

from __future__ import annotations

from ..by_hand import cart_pendulum as by_hand
from ..by_hand import lagrange
from ..by_kane import cart_pendulum as by_kane
from ..by_symbody import cart_pendulum as by_symbody
from ..by_symbody.formalism import FORMALISMS, mass_matrix_and_bias
from ..engines import CASADI, SYMBODY, SYMENGINE, SYMPY, Algebra, Expression
from ..problem import Contender, Problem, operations_target, time_target


def _symbody(name: str) -> Contender:
    return Contender(SYMBODY, name, lambda n: mass_matrix_and_bias(FORMALISMS[name], by_symbody.system(n)))


def _by_hand(algebra: Algebra, largest: int | None = None) -> Contender:
    def derive(n: int) -> list[Expression]:
        return lagrange.mass_matrix_and_bias(algebra, by_hand.lagrangian(algebra, n))

    return Contender(algebra, "Lagrange by hand", derive, largest)


PROBLEM = Problem(
    name="cart_pendulum",
    title="Pendulum of n links on a cart",
    statement=(
        "In the plane, absolute angles, point masses at the joints; all parameters symbolic. "
        "symbody's model is `models.cart_pole(n, point_masses=True)`. "
        "Outputs: mass matrix (upper triangle) and bias."
    ),
    sizes=(3, 5, 10, 20, 30, 60),
    quick_sizes=(3,),
    contenders=(
        *map(_symbody, FORMALISMS),
        Contender(SYMPY, "Kane", by_kane.mass_matrix_and_bias, largest=20, rename=by_kane.named),
        _by_hand(SYMPY, largest=10),
        _by_hand(SYMENGINE, largest=30),
        _by_hand(CASADI),
    ),
    targets=tuple(
        target
        for label in (f"symbody, {name}" for name in FORMALISMS)
        for target in (
            time_target(label, 10, 0.015),
            operations_target(label, 10, 700),
            operations_target(label, 30, 5_000),
            time_target(label, 60, 0.3),
        )
    ),
)
