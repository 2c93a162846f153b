"""Given inputs: what stands in the place of functions of time, so that expressions hold the state alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from symbody.dynamics import Equations
from symbody.errors import ModelError
from symbody.multibody import System
from symbody.symbolic import Expr, free_symbols, substitute

__all__ = ["Given", "check_explicit", "check_no_circle", "with_given"]

Given: TypeAlias = tuple[tuple[Expr, Expr], ...]
"""Functions of time, and what stands in their place."""


def with_given(system: System, given: Given, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions with what is given for inputs, and the rates of coordinates by the speeds.

    Either may bring in the other: the kinematics of a moving frame hold the velocities that are given for it, and what
    is given may hold rates of coordinates. One that depends on itself is left where it is.
    """
    values = system.by_speeds(expressions)
    for _ in given:
        before, values = values, system.by_speeds(substitute(values, dict(given)))
        if values == before:
            break
    return values


def check_no_circle(system: System, given: Mapping[Expr, Expr], where: str) -> None:
    """See that no input depends on itself, by rates of coordinates whose kinematics hold it.

    Raises:
        ModelError: one does.
    """
    for function, formula in given.items():
        (value,) = with_given(system, tuple(given.items()), [formula])
        left = sorted(str(leaf) for leaf in free_symbols([value]) & {*given})
        if left:
            raise ModelError(
                f"{where}, inputs: {function} is given by {formula}, in which the kinematics bring back {left[0]}; "
                "expected an expression of time, coordinates and speeds that doesn't depend on the inputs"
            )


def check_explicit(eqs: Equations, given: Given, where: str) -> None:
    """See that inputs bring no accelerations into the equations of motion, of which the mass matrix knows nothing.

    Raises:
        ModelError: the equations hold a rate of an input that is given by coordinates or speeds.
    """
    for leaf in eqs.inputs:
        (value,) = with_given(eqs.system, given, [leaf])
        found = sorted(map(str, free_symbols([value]) & {*eqs.accelerations}))
        if found:
            formula = next(formula for function, formula in given if function.name == leaf.name)
            raise ModelError(
                f"{where}, inputs: the equations hold {leaf}, in which {leaf.name}: {formula} brings the acceleration "
                f"{found[0]}; write {formula} in the place of {leaf.name} where the model is made"
            )
