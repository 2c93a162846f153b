"""P4: the trifilar pendulum of the worksheet, and with the plate's own frame."""

from __future__ import annotations

from functools import partial

from ..by_hand import trifilar as by_hand
from ..by_symbody import trifilar as by_symbody
from ..engines import CASADI, SYMBODY, SYMENGINE, SYMPY, Algebra, Expression
from ..problem import Contender, Problem, operations_target, time_target

EQUATIONS = 21


def _symbody(_: int, *, own_frame: bool) -> list[Expression]:
    return list(by_symbody.equations(own_frame=own_frame))


def _by_hand(algebra: Algebra, *, own_frame: bool) -> Contender:
    return Contender(algebra, "Lagrange by hand", lambda _: by_hand.equations(algebra, own_frame=own_frame))


def _problem(name: str, title: str, statement: str, *, own_frame: bool, operations: int) -> Problem:
    subject = Contender(SYMBODY, "lagrange_equations", partial(_symbody, own_frame=own_frame))
    return Problem(
        name=name,
        title=title,
        statement=statement,
        sizes=(EQUATIONS,),
        quick_sizes=(EQUATIONS,),
        contenders=(
            subject,
            *(_by_hand(algebra, own_frame=own_frame) for algebra in (SYMPY, SYMENGINE, CASADI)),
        ),
        targets=(
            time_target(subject.label, EQUATIONS, 0.020),
            operations_target(subject.label, EQUATIONS, operations),
        ),
    )


WORKSHEET = _problem(
    "trifilar",
    "Trifilar pendulum, as in the worksheet",
    "Natural coordinates; the plate's centre of mass is in a frame parallel to ground, so that its energy is "
    "translational only. Outputs: 12 Lagrange equations with multipliers and 9 constraints in Baumgarte's form.",
    own_frame=False,
    operations=496,  # one fewer than by hand in CasADi
)
OWN_FRAME = _problem(
    "trifilar_own_frame",
    "Trifilar pendulum, the plate in its own frame",
    "The same, with the plate's inertia tensor in its own axes.",
    own_frame=True,
    operations=634,  # the same
)
