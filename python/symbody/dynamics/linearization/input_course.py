"""The course of an input in time along a motion, from its value and the values of its rates."""

from __future__ import annotations

from collections.abc import Mapping
from math import factorial

from symbody.errors import ModelError
from symbody.symbolic import Expr, functions_of_time, number, t, time_derivative
from symbody.symbolic.given.arguments import brief

__all__ = ["input_course"]


def input_course(name: str, given: Mapping[Expr, Expr], lowest: int, where: str) -> Expr:
    """Return the course in time of an input, or of its lowest rate that matters.

    Numbers are the values at t = 0, as those of coordinates are: ``{s: s0, s': V}`` is ``s0 + V t``.

    Args:
        name: the name of the input.
        given: the values of inputs and of their rates.
        lowest: the order of the lowest rate that matters.
        where: the function and its argument, for messages.

    Raises:
        ModelError: the values of the input and of its rates contradict each other.

    >>> from symbody import functions_of_time, symbols, time_derivative
    >>> s, V = functions_of_time("s"), symbols("V")
    >>> input_course("s", {s: 2, time_derivative(s): V}, 0, "linearize, about")
    V*t + 2
    """
    orders = {r.order: number(value) for r, value in given.items() if _is_of(r, name)}
    if any(t in value.free_symbols for value in orders.values()):
        return _given_course(name, orders, lowest, where)
    highest = max(orders, default=lowest)
    terms = [
        orders.get(order, number(0)) * t ** (order - lowest) / factorial(order - lowest)
        for order in range(lowest, highest + 1)
    ]
    return sum(terms, start=number(0)) if terms else number(0)


def _is_of(r: Expr, name: str) -> bool:
    return r.kind == "time_function" and r.name == name


def _given_course(name: str, orders: Mapping[int, Expr], lowest: int, where: str) -> Expr:
    """Return a course that is given by an expression of t, to which all other values must fit."""
    first = min(orders)
    course, function = orders[first], functions_of_time(name)
    if first > lowest:
        raise ModelError(
            f"{where}: {time_derivative(function, first)} has the course {brief(course)}, and {function} has none; "
            f"expected that of {function}, whose rates follow"
        )
    for order, value in orders.items():
        rate = time_derivative(course, order - first) if order > first else course
        if rate != value:
            raise ModelError(
                f"{where}: the values of {_named(function, first)} and {_named(function, order)} contradict each "
                f"other: the rate of {brief(course)} is {brief(rate)}, not {brief(value)}; leave the rate out"
            )
    return time_derivative(course, lowest - first) if lowest > first else course


def _named(function: Expr, order: int) -> Expr:
    return time_derivative(function, order) if order else function
