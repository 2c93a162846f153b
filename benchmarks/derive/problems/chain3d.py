"""The chain of revolute joints: residuals, whose operations must grow like n."""

from __future__ import annotations

from collections.abc import Callable

from ..by_hand import chain as by_hand
from ..by_hand import lagrange
from ..by_symbody import chain as by_symbody
from ..by_symbody.formalism import FORMALISMS, residuals
from ..engines import CASADI, SYMBODY, SYMENGINE, SYMPY, Algebra, Expression
from ..problem import Contender, Problem, Results, Target, growth_target, joint_time_target

BOTH = tuple(f"symbody, {formalism}" for formalism in FORMALISMS)


def _axes(n: int) -> list[str]:
    return ["XYZ"[i % 3] for i in range(n)]


def _symbody(name: str) -> Contender:
    return Contender(SYMBODY, name, lambda n: residuals(FORMALISMS[name], by_symbody.system(_axes(n))))


def _recursion(algebra: Algebra, largest: int | None = None) -> Contender:
    def derive(n: int) -> list[Expression]:
        return by_hand.newton_euler(by_hand.chain(algebra, _axes(n)))

    return Contender(algebra, "recursion by hand", derive, largest)


def _lagrange(algebra: Algebra, largest: int | None = None) -> Contender:
    def derive(n: int) -> list[Expression]:
        chain = by_hand.chain(algebra, _axes(n))
        return lagrange.residuals(algebra, by_hand.lagrangian(chain), chain.a)

    return Contender(algebra, "Lagrange by hand", derive, largest)


def _additions_and_multiplications(label: str, n: int) -> Callable[[Results], float]:
    def count(results: Results) -> float:
        operations = results[label, n].operations
        return operations.additions + operations.multiplications

    return count


PROBLEM = Problem(
    name="chain3d",
    title="Chain of n rigid bodies on revolute joints",
    statement=(
        "In space, about x, y, z in turn; arbitrary offsets of joints and centres of mass, full inertia tensors, "
        "gravity; all parameters symbolic. Outputs: the n residuals (inverse dynamics)."
    ),
    sizes=(7, 30, 100, 200),
    quick_sizes=(4,),
    contenders=(
        *map(_symbody, FORMALISMS),
        _recursion(SYMPY, largest=7),
        _recursion(SYMENGINE),
        _recursion(CASADI),
        _lagrange(SYMENGINE, largest=7),
        _lagrange(CASADI),
    ),
    targets=(
        joint_time_target("both formalisms", BOTH, 100, 0.5),
        growth_target("both formalisms", BOTH, (100, 200), 2.6),
        *(
            Target(
                f"{label}, n = 100: additions and multiplications",
                7894 + 9590,
                (100,),
                _additions_and_multiplications(label, 100),
            )
            for label in BOTH
        ),
    ),
)
