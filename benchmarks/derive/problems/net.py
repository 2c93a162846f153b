"""The net of springs: each length is the square root of a sum, and both formalisms must give the same nodes."""

from __future__ import annotations

from ..by_hand import lagrange
from ..by_hand import net as by_hand
from ..by_symbody import net as by_symbody
from ..by_symbody.formalism import FORMALISMS, residuals
from ..engines import CASADI, SYMBODY, SYMENGINE, SYMPY, Algebra, Expression
from ..problem import Contender, Problem, growth_target, joint_time_target, operations_target

BOTH = tuple(f"symbody, {formalism}" for formalism in FORMALISMS)


def _symbody(name: str) -> Contender:
    return Contender(SYMBODY, name, lambda n: residuals(FORMALISMS[name], by_symbody.system(n)))


FROM_ENERGIES = Contender(SYMBODY, "T - V differentiated", by_symbody.from_energies)


def _newton(algebra: Algebra) -> Contender:
    def derive(n: int) -> list[Expression]:
        return by_hand.newton(algebra, by_hand.net(algebra, n))

    return Contender(algebra, "Newton by hand", derive)


def _lagrange(algebra: Algebra) -> Contender:
    def derive(n: int) -> list[Expression]:
        net = by_hand.net(algebra, n)
        return lagrange.residuals(
            algebra, by_hand.lagrangian(algebra, net), net.coordinates(net.acceleration)
        )

    return Contender(algebra, "Lagrange by hand", derive)


PROBLEM = Problem(
    name="net",
    title="Net of n bodies and 3n springs between two points",
    statement=(
        "In space, a square net of point masses, three coordinates each. Three springs tie each body to the one above "
        "it, the one on its left and the one diagonally between these two; along two sides of the net, these are fixed "
        "anchors instead. A spring of length l = sqrt(dx**2 + dy**2 + dz**2) pulls with k (l - l0). Gravity; all "
        "parameters symbolic. Outputs: the 3n residuals. In T - V, springs are potential energies k (l - l0)**2 / 2, "
        "not forces."
    ),
    sizes=(25, 100, 400),
    quick_sizes=(4,),
    contenders=(
        *map(_symbody, FORMALISMS),
        FROM_ENERGIES,
        *map(_newton, (SYMPY, SYMENGINE, CASADI)),
        *map(_lagrange, (SYMENGINE, CASADI)),
    ),
    targets=(
        joint_time_target("both formalisms", BOTH, 100, 0.5),
        growth_target("both formalisms", BOTH, (100, 400), 5.2),
        *(operations_target(label, 100, 6_700) for label in (*BOTH, FROM_ENERGIES.label)),
    ),
)
