"""Checks of arguments, and the wording of messages about them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from difflib import get_close_matches
from functools import cache, wraps
from inspect import Signature, signature
from typing import ParamSpec, TypeVar

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr

__all__ = [
    "brief",
    "counted",
    "described",
    "expression",
    "given_twice",
    "instead_note",
    "size",
    "unknown_option",
    "with_known_names",
]

P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")


_SHOWN = 80
"""The most characters of a value that a message quotes."""


def brief(thing: object) -> str:
    """Return the printed form of a value for a message, shortened in the middle if it is long.

    >>> from symbody import symbols
    >>> brief(sum(symbols(f"stiffness_{n}") for n in range(20)))
    'stiffness_0 + stiffness_1 + stiffness_2 + stiffness...tiffness_18 + stiffness_19'
    """
    text = " ".join(str(thing).split())
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 29]}...{text[-26:]}"


def given_twice(things: Sequence[T]) -> T | None:
    """Return a thing that a list has twice; None if each is there once.

    >>> given_twice(["a", "b", "a"])
    'a'
    """
    return next((thing for k, thing in enumerate(things) if thing in things[:k]), None)


def described(value: object) -> str:
    """Return a value and its type in words, as in ``3 is an int``; a long value is shortened."""
    shown, kind = brief(repr(value)), type(value).__name__
    article = "an" if kind[0] in "aeiouAEIOU" else "a"
    return shown if value is None else f"{shown} is {article} {kind}"


def instead_note(value: object) -> str:
    """Return what to write instead of what is no expression; the empty text if that can't be told.

    A bool mostly comes from an equation written with ``==``. What has a value that is an expression, as a freedom of a
    joint has, was probably given in its place.

    >>> instead_note(1 == 2)
    '; == compares two expressions, which gives a bool: write a == b as a - b'
    """
    if _is_bool(value):
        return "; == compares two expressions, which gives a bool: write a == b as a - b"
    if isinstance(getattr(value, "value", None), Expr):
        return f"; {type(value).__name__.lower()}.value is an expression"
    return ""


def _is_bool(value: object) -> bool:
    return type(value).__name__ in ("bool", "bool_")  # also NumPy's


def counted(count: int, noun: str) -> str:
    """Return a count with its noun, in the plural where needed.

    >>> counted(1, "body"), counted(0, "body"), counted(2, "load")
    ('1 body', '0 bodies', '2 loads')
    """
    if count == 1:
        return f"1 {noun}"
    return f"{count} {noun[:-1]}ies" if noun.endswith("y") else f"{count} {noun}s"


def size(value: int, place: str, what: str) -> int:
    """Return a count (of rows, of derivatives) as an int; raise an error unless it is 0, 1, 2, ..."""
    if isinstance(value, bool) or not hasattr(value, "__index__") or value.__index__() < 0:
        raise ArgumentError(f"{place} is {value!r}; expected 0, 1, 2, ... {what}")
    return value.__index__()


def expression(value: object, place: str) -> Expr:
    """Return a number or an expression as an expression; ``place`` names the argument in the error."""
    if _is_bool(value):
        wanted = "expected an expression or a number (int, float, Fraction, NumPy scalar)"
        raise ArgumentError(f"{place}: {described(value)}; {wanted}{instead_note(value)}")
    try:
        return _core.number(value, place)
    except ArgumentError as fault:
        note = instead_note(value)
        if not note:
            raise
        raise ArgumentError(f"{fault}{note}") from None


def expression_or_container(value: object, place: str) -> Expr:
    """Return a number or an expression as an expression where containers of these are taken too, as the error tells."""
    try:
        return expression(value, place)
    except ArgumentError as fault:
        wanted = "a number (int, float, Fraction, NumPy scalar)"
        more = f"{wanted}, or what holds them: a list, a matrix, a body, equations"
        raise ArgumentError(str(fault).replace(f"expression or {wanted}", f"expression, {more}")) from None


def with_known_names(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that reports missing arguments and unknown names, with the name that may be meant.

    >>> from symbody.symbolic.given.arguments import with_known_names
    >>> @with_known_names
    ... def pull(F, angle=0):
    ...     return F
    >>> pull(3, angel=1)
    Traceback (most recent call last):
    ...
    symbody.errors.ArgumentError: pull: there is no argument 'angel'; did you mean 'angle'? Expected some of F, angle
    """

    @cache
    def expected() -> Signature:
        return signature(function)

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            expected().bind(*args, **kwargs)
        except TypeError as fault:
            raise ArgumentError(
                f"{function.__qualname__}: {_misnamed(expected(), kwargs) or fault}"
            ) from None
        return function(*args, **kwargs)

    return call


def _misnamed(expected: Signature, given: Iterable[str]) -> str:
    """Return what is wrong with the first unknown name; the empty text if all are known."""
    unknown = next((name for name in given if name not in expected.parameters), None)
    return "" if unknown is None else unknown_option(unknown, expected.parameters)


def unknown_option(name: str, known: Iterable[str]) -> str:
    """Return what is wrong with the name of an argument that a function doesn't have, and which one may be meant.

    >>> from symbody.symbolic.given.arguments import unknown_option
    >>> unknown_option("speed", ["bodies", "speeds"])
    "there is no argument 'speed'; did you mean 'speeds'? Expected some of bodies, speeds"
    """
    names = [each for each in known if each != "self"]
    near = get_close_matches(name, names, 1)
    guess = f"; did you mean {near[0]!r}? Expected" if near else "; expected"
    return f"there is no argument {name!r}{guess} some of {', '.join(names)}"
