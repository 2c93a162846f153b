"""P2: the chain with three Euler angles a joint: mass matrix and bias."""

from __future__ import annotations

from collections.abc import Callable

from ..by_hand import chain as by_hand
from ..by_hand import lagrange
from ..by_kane import chain as by_kane
from ..by_kane.rename import speeds_as_rates
from ..by_symbody import chain as by_symbody
from ..by_symbody.formalism import FORMALISMS, mass_matrix_and_bias
from ..engines import CASADI, SYMBODY, SYMENGINE, SYMPY, Algebra, Expression
from ..problem import Contender, Problem, operations_target, time_target

Method = Callable[[Algebra, by_hand.Chain], list[Expression]]


def _axes(n: int) -> list[str]:
    return ["ZXY"] * n


def _symbody(name: str) -> Contender:
    return Contender(
        SYMBODY, name, lambda n: mass_matrix_and_bias(FORMALISMS[name], by_symbody.system(_axes(n)))
    )


def _by_hand(algebra: Algebra, name: str, method: Method, largest: int | None = None) -> Contender:
    return Contender(algebra, name, lambda n: method(algebra, by_hand.chain(algebra, _axes(n))), largest)


def _lagrange(algebra: Algebra, chain: by_hand.Chain) -> list[Expression]:
    return lagrange.mass_matrix_and_bias(algebra, by_hand.lagrangian(chain))


def _recursion(algebra: Algebra, chain: by_hand.Chain) -> list[Expression]:
    residuals = by_hand.newton_euler(chain)
    mass = algebra.jacobian(residuals, chain.a)
    triangle = [entry for i, row in enumerate(mass) for entry in row[i:]]
    return triangle + by_hand.newton_euler(chain.at_rest())


PROBLEM = Problem(
    name="euler_chain",
    title="Chain of n rigid bodies with three Euler angles each",
    statement=(
        "In space, each joint turns about z, x, y; arbitrary offsets of joints and centres of mass, full inertia "
        "tensors, gravity; all parameters symbolic. Outputs: mass matrix (3n x 3n, upper triangle) and bias."
    ),
    sizes=(1, 2, 3, 4, 6),
    quick_sizes=(1,),
    contenders=(
        *map(_symbody, FORMALISMS),
        Contender(
            SYMPY,
            "Kane",
            lambda n: by_kane.mass_matrix_and_bias(_axes(n)),
            largest=3,
            rename=speeds_as_rates,
        ),
        _by_hand(SYMENGINE, "Lagrange by hand", _lagrange),
        _by_hand(CASADI, "Lagrange by hand", _lagrange),
        _by_hand(CASADI, "recursion by hand", _recursion),
    ),
    targets=tuple(
        target
        for name in FORMALISMS
        for target in (
            time_target(f"symbody, {name}", 6, 0.050),
            operations_target(f"symbody, {name}", 6, 8_000),
        )
    ),
)
