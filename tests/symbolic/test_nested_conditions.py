"""Conditions that are nested deep: each pair of parts is compared once."""

from __future__ import annotations

from symbody import Piecewise, diff, symbols

LEVELS = 18  # where pairs of levels are compared again and again, each level takes five times the time

conditions = symbols(f"q0:{LEVELS}")
x = symbols("x")


def test_many_nested_conditions() -> None:
    nested = x**2
    for condition in conditions:
        nested = Piecewise((nested, condition), otherwise=0)
    slope = diff(nested, x)
    inside = {x: 3.0, **dict.fromkeys(conditions, 1.0)}
    assert (nested.evaluate(inside), slope.evaluate(inside)) == (9.0, 6.0)
    outside = inside | {conditions[7]: -1.0}
    assert (nested.evaluate(outside), slope.evaluate(outside)) == (0.0, 0.0)
