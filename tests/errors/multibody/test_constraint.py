"""Mistakes with constraints: their whole messages, and the notice of one that depends on others."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Constraint,
    ModelNotice,
    SymbodyError,
    System,
    errors,
    functions_of_time,
    lagrange_equations,
    newton_euler,
    rotate,
    time_derivative,
    translate,
)
from tests.errors.given import Mistake, a, b, body, check, constrained, m, phi, vehicle, x, y, z

MISTAKES: list[Mistake] = [
    (
        errors.ConstraintError,
        lambda: System([Body(vehicle, m)], coordinates=[x], speeds=[y], constraints=[x - y**2]),
        (
            "System: constraint 1, x - y**2 = 0, isn't linear in the speed y; expected A(q, t) u + b(q, t), as "
            "d'Alembert's principle gives no force for other conditions on velocities: factor it into linear "
            "conditions, or replace it by a load that keeps it"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([Body(vehicle, m)], coordinates=[x], speeds=[y], constraints=[time_derivative(y) - x]),
        (
            "System: constraint 1, y' - x = 0, holds the acceleration y'; expected a condition on coordinates, or one "
            "on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x, y, z)),
        (
            "System: 3 independent constraints on 3 coordinates leave no motion; expected fewer constraints than "
            "coordinates, or one that drives the system and holds the time t"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(a - b),
        "System: constraint 1, a - b = 0, holds none of the coordinates; leave it out, or correct it",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(
            Constraint(time_derivative(x) ** 2 + time_derivative(y) ** 2 - a**2, name="constant speed")
        ),
        (
            "System: constraint 1, constant speed, x'**2 + y'**2 - a**2 = 0, isn't linear in the speed x'; expected "
            "A(q, t) u + b(q, t), as d'Alembert's principle gives no force for other conditions on velocities: factor "
            "it into linear conditions, or replace it by a load that keeps it"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(x - time_derivative(y, 2)),
        (
            "System: constraint 1, x - y'' = 0, holds the acceleration y''; expected a condition on coordinates, or "
            "one on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x, time_derivative(y), y - z)),
        (
            "System: 3 independent constraints on 3 coordinates leave no motion; expected fewer constraints than "
            "coordinates, or one that drives the system and holds the time t"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(time_derivative(x), 2 * time_derivative(x) - 3)),
        (
            "System: constraint 2, 2*x' - 3 = 0, contradicts constraint 1: together they say that -3 = 0; correct one "
            "of them"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(a - a + 5),
        "System: constraint 1, 5 = 0, is never true; correct it, or leave it out",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(functions_of_time("forgotten") - a),
        (
            "System: constraint 1, forgotten - a = 0, holds none of the coordinates, and forgotten, a function of "
            "time; add forgotten to coordinates=[...], or correct the constraint"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=functions_of_time("N T")),
        "System: 2 multipliers for 1 constraint; give one for each",
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x - y, 2 * x - 2 * y - 1)),
        (
            "System: constraint 2, 2*x - 2*y - 1 = 0, contradicts constraint 1: together they say that -1 = 0; correct "
            "one of them"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


def test_notice_of_dependent_constraints() -> None:
    frame = translate(x, y, z) * rotate("X", phi)
    beads = System([Body(frame, m)], coordinates=[x, y, z, phi], constraints=[x**2 - y, y - z, x**2 - z])
    rest = (
        "its gradient is a combination of theirs, so that their multipliers aren't determined: forward dynamics takes "
        "those of minimum norm, and a simulation leaves out what is redundant"
    )
    for mistake, message in (
        (
            lambda: newton_euler(constrained(x + y, 2 * x + 2 * y)),
            "2 (2*x + 2*y = 0) follows from 1",
        ),
        (lambda: lagrange_equations(beads), "3 (x**2 - z = 0) follows from 1 and 2"),
    ):
        with pytest.warns(ModelNotice) as notices:
            mistake()
        assert [str(notice.message) for notice in notices] == [f"System: constraint {message}: {rest}"]
        assert notices[0].filename == __file__
