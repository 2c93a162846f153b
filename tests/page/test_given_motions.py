"""Motions that are functions of time: long equations are those of a mechanism in which their names are inputs."""

from __future__ import annotations

import pytest

from symbody import Equations, Expr, System, describe, functions_of_time, newton_euler, sin, subs, symbols, t
from symbody.errors import ModelNotice
from tests.page.test_rules import arm

a, w = symbols("a w")
q0, q1, q2 = functions_of_time("q0 q1 q2")


def driven(motion: Expr) -> Equations:
    """Return the equations of an arm of axes Z, Y, Y whose second angle is given."""
    whole = arm("ZYY")
    return newton_euler(System(subs(whole.bodies, {q1: motion}), coordinates=[q0, q2], gravity=whole.gravity))


@pytest.mark.parametrize("motion", [3 * t**2, a * sin(w * t)])
def test_given_angles_have_names(motion: Expr) -> None:
    text = describe(driven(motion))
    with pytest.warns(ModelNotice, match="beta moves bodies and is not a coordinate"):
        named = describe(driven(functions_of_time("beta")))
    title, *rows = named.splitlines()
    assert text.splitlines() == [title, f"    beta := {motion}", *rows]


def test_steady_rotations_keep_their_form() -> None:
    assert "w*t" in describe(driven(w * t))
    assert " := w*t" not in describe(driven(w * t))
