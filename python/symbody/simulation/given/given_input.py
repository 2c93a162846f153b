"""Given inputs: expressions are substituted for functions of time, so that only the state is left."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from symbody.dynamics import Equations
from symbody.errors import ModelError
from symbody.multibody import Variables
from symbody.symbolic import Expr, free_symbols, substitute

__all__ = ["Given", "check_explicit", "check_no_circle", "substitute_inputs"]

Given: TypeAlias = tuple[tuple[Expr, Expr], ...]
"""Functions of time, each with the expression that is substituted for it."""


def substitute_inputs(system: Variables, given: Given, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Substitute the given inputs in expressions, and the rates of coordinates as functions of the speeds.

    Each may bring in the other: the kinematics of a moving frame contain the velocities that are given for it, and an
    input may contain rates of coordinates. An input that depends on itself is left unchanged.
    """
    values = system.by_speeds(expressions)
    for _ in given:
        before, values = values, system.by_speeds(substitute(values, dict(given)))
        if values == before:
            break
    return values


def check_no_circle(system: Variables, given: Mapping[Expr, Expr], where: str) -> None:
    """Check that no input depends on itself through the rates of coordinates.

    Raises:
        ModelError: an input depends on itself.
    """
    for function, formula in given.items():
        (value,) = substitute_inputs(system, tuple(given.items()), [formula])
        left = sorted(str(leaf) for leaf in free_symbols([value]) & {*given})
        if left:
            raise ModelError(
                f"{where}, inputs: {function} is given by {formula}, in which the kinematics bring back {left[0]}; "
                "expected an expression of time, coordinates and speeds that doesn't depend on the inputs"
            )


def check_explicit(eqs: Equations, given: Given, where: str) -> None:
    """Check that inputs bring no accelerations into the equations of motion: the mass matrix would not contain them.

    Raises:
        ModelError: the equations contain a rate of an input that is given in terms of coordinates or speeds.
    """
    for leaf in eqs.inputs:
        (value,) = substitute_inputs(eqs.system, given, [leaf])
        found = sorted(map(str, free_symbols([value]) & {*eqs.accelerations}))
        if found:
            formula = next(formula for function, formula in given if function.name == leaf.name)
            raise ModelError(
                f"{where}, inputs: the equations hold {leaf}, in which {leaf.name}: {formula} brings the acceleration "
                f"{found[0]}; substitute {formula} for {leaf.name} where the model is made"
            )
