"""Mistakes with reactions: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Constraint,
    Equations,
    SymbodyError,
    System,
    assemble,
    embedded,
    equations_of,
    errors,
    ground,
    newton_euler,
    prismatic,
    reaction,
    revolute,
    sin,
    time_derivative,
)
from tests.errors.given import A, B, C, Mistake, a, body, check, other_pin, pendulum, pin, x, y

cam = Constraint(pin.coordinate - sin(other_pin.coordinate), name="cam")


def slider_crank() -> Equations:
    joints = [
        pin,
        revolute("Q", A, B, at=(1, 0, 0)),
        revolute("R", B, C, at=(3, 0, 0)),
        prismatic("S", ground, C, axis="X"),
    ]
    return newton_euler(assemble(joints).system())


MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: reaction(pendulum(), A, on=ground),
        (
            "reaction: on = ground, but the reaction of bodies that are cut off acts on them, here on A, and what "
            "holds them may act on several others; expected no on, that of a joint (P), or -reaction(...) for its "
            "opposite"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), revolute("Q", ground, B)),
        "reaction: revolute Q isn't a joint of System(1 body, 0 loads, 1 coordinate); its joints are P",
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(System([body], coordinates=[x, y])), pin),
        (
            "reaction: revolute P isn't a joint of System(1 body, 0 loads, 2 coordinates); it has none: make it "
            "by assemble([...]).system()"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), "rod"),
        (
            "reaction: 'rod' isn't a joint or a body of System(1 body, 0 loads, 1 coordinate); its bodies are A, its "
            "joints P"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), []),
        "reaction: no body is cut off; give at least one",
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), pin, on=B),
        "reaction: revolute P connects ground and A, not B; expected on=one of the two",
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), 3),
        (
            "reaction: cut = 3 is an int; expected a joint, a body, a link, the name of one, or a list of bodies "
            "that are cut off together"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(equations_of([[a]], [0], [x]), pin),
        (
            "reaction: Equations(1 equation of motion, 0 constraints, coordinate x) were given without bodies; "
            "expected the equations of a System"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(assemble([pin, other_pin]).system(constraints=[cam])), pin),
        (
            "reaction: the constraint cam, phi_P - sin(phi_Q) = 0 isn't one of a joint, and holds phi_P, phi_Q, so "
            "that it isn't known on which bodies it acts; close the loop by a joint, or take the reaction on a "
            "body: reaction(equations, body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(embedded(slider_crank(), [time_derivative(pin.coordinate)]), pin),
        (
            "reaction: the multipliers of these equations are eliminated; expected the equations from which they "
            "were embedded, by which inverse_dynamics(equations, motion, unknowns=[]) evaluates reactions along a "
            "motion"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
