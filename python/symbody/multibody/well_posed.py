"""Checks of the variables of equations of motion: functions of time, each given once, and constraints on them.

The checks take `where`, the function that the user called, for their messages.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from symbody.errors import ConstraintError, ModelError
from symbody.symbolic import Expr, are_small, number, truncated
from symbody.symbolic.given.arguments import brief, counted

from .constraint import Constraint
from .constraint_fault import Unknowns, fault_of
from .coordinate import check_function_of_time

__all__ = [
    "check_constraints",
    "check_inputs",
    "check_multipliers",
    "check_single",
    "check_small",
    "check_unknowns",
]


def check_unknowns(where: str, coordinates: Sequence[Expr], speeds: Sequence[Expr]) -> None:
    """Raise an error for a coordinate or quasi-velocity that is not a function of time, or is given twice."""
    for coordinate in coordinates:
        check_function_of_time(coordinate, f"{where}: the coordinate")
    for speed in speeds:
        check_function_of_time(speed, f"{where}: the speed")
    check_single(coordinates, f"{where}: the coordinate")
    check_single(speeds, f"{where}: the speed")
    for speed in speeds:
        if speed in coordinates:
            raise ModelError(
                f"{where}: {speed} is both a coordinate and a speed; the rates of coordinates are speeds anyway: leave "
                "it out of one of them"
            )


def check_constraints(
    where: str, conditions: Sequence[Constraint], multipliers: Sequence[Expr], unknowns: Unknowns
) -> None:
    """Raise an error for constraints that don't restrict the unknowns or don't have one multiplier each."""
    for k, (condition, multiplier) in enumerate(zip(conditions, multipliers, strict=False), start=1):
        if condition.multiplier not in (None, multiplier):
            raise ConstraintError(
                f"{where}: constraint {k}, {condition}, has the multiplier {condition.multiplier}, and "
                f"multipliers=[...] gives it {multiplier}; leave one of them out"
            )
    if len(multipliers) != len(conditions):
        raise ConstraintError(
            f"{where}: {counted(len(multipliers), 'multiplier')} for {counted(len(conditions), 'constraint')}; "
            "give one for each"
        )
    for k, constraint in enumerate(conditions, start=1):
        fault = fault_of(constraint.condition, unknowns)
        if fault:
            raise ConstraintError(f"{where}: constraint {k}, {constraint}, {fault}")


def check_multipliers(
    where: str, contents: str, multipliers: Sequence[Expr], states: Collection[Expr], taken: Collection[str]
) -> None:
    """Raise an error for a multiplier that is also a state, a coordinate, or in the contents.

    Args:
        where: the function that the user called.
        contents: what the equations are made of.
        multipliers: the multipliers.
        states: the functions of time beside the mechanics.
        taken: the names of coordinates and of symbols in the contents.
    """
    for multiplier in multipliers:
        check_function_of_time(multiplier, f"{where}: the multiplier")
    check_single(multipliers, f"{where}: the multiplier")
    for multiplier in multipliers:
        if multiplier in states:
            raise ConstraintError(
                f"{where}: the multiplier {multiplier} is a state, too; expected a function of time of its own, such "
                "as functions_of_time('lambda1')"
            )
        if multiplier.name in taken:
            raise ConstraintError(
                f"{where}: the multiplier {multiplier} is a coordinate, or in {contents}; "
                "expected a function of time of its own, such as functions_of_time('lambda1')"
            )


def check_inputs(where: str, inputs: Sequence[Expr], unknowns: Collection[Expr]) -> None:
    """Raise an error for an input that is not a function of time, or is an unknown."""
    for given in inputs:
        check_function_of_time(given, f"{where}: the input")
        if given in unknowns:
            raise ModelError(
                f"{where}: {given} is an input and unknown; leave it out of inputs, or of coordinates, speeds and "
                "multipliers"
            )


def check_small(where: str, rates: Mapping[Expr, Expr]) -> None:
    """Raise an error for a small coordinate or state whose rate is not small."""
    for variable, rate in rates.items():
        rest = truncated([rate], 0)[0] if are_small([variable]) else number(0)
        if not rest.is_zero:
            raise ModelError(
                f"{where}: {variable} is small, but its rate {brief(rate)} is not: it is {brief(rest)} where "
                f"small variables vanish; mark the variables there as small, too, or don't mark {variable}"
            )


def check_single(things: Sequence[object], kind: str) -> None:
    """Raise an error for a thing that is given twice."""
    if len(set(things)) < len(things):
        twice = next(thing for thing in things if things.count(thing) > 1)
        raise ModelError(f"{kind} {brief(twice)} is given twice; give it once")
