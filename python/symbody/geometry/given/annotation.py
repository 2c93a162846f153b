"""Annotations as tests: whether a value fits what the annotation of an argument expects."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence, Set, Sized
from functools import cache
from types import UnionType
from typing import Annotated, Any, TypeAlias, TypeVar, Union, get_args, get_origin

from symbody.symbolic import Expr, ExprLike, number

Test: TypeAlias = Callable[[object], bool]


def hints_of(function: Callable[..., object]) -> dict[str, Any]:
    """Return the annotations of a function, as `typing.get_type_hints` does.

    That one compiles each text anew. Functions have few different ones, and wait for them when they are first called.
    """
    names = inspect.unwrap(function).__globals__
    return {
        name: _hint(text, names["__name__"]) if isinstance(text, str) else text
        for name, text in function.__annotations__.items()
    }


@cache
def _hint(text: str, module: str) -> Any:
    """Return what a text means as an annotation in a module."""
    return eval(text, vars(sys.modules[module]))


def accepts(hint: Any, value: object) -> bool:
    """Return whether a value fits an annotation."""
    return test_of(hint)(value)


@cache  # annotations are few, and taking one apart takes longer than its test
def test_of(hint: Any) -> Test:
    """Return the test of the values that fit an annotation."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return test_of(parts[0])
    if hint == ExprLike:
        return is_scalar
    if origin in (Union, UnionType):
        return _test_of_alternatives(parts)
    if isinstance(hint, TypeVar):
        return _anything if hint.__bound__ is None else test_of(hint.__bound__)
    if origin is not None and issubclass(origin, Iterable):
        return lambda value: is_collection(value, origin) and strangers(hint, value) == []
    return (lambda value: isinstance(value, hint)) if isinstance(hint, type) else _anything


def _anything(value: object) -> bool:
    del value
    return True


def _test_of_alternatives(parts: Sequence[Any]) -> Test:
    scalars = {*get_args(ExprLike)} if {*get_args(ExprLike)} <= {*parts} else set()
    tests: list[Test] = [test_of(part) for part in parts if part not in scalars]
    tests += (
        [is_scalar] if scalars else []
    )  # last: it prints what is none, which takes long for a large constraint
    return lambda value: any(test(value) for test in tests)


def is_scalar(value: Any) -> bool:
    """Return whether a value is an expression or a number."""
    if isinstance(value, Expr):
        return True
    if isinstance(value, str):  # `number` reads texts, which may be mistakes elsewhere
        return False
    try:
        number(value)
    except (TypeError, ValueError):
        return False
    return True


def is_collection(value: object, origin: type) -> bool:
    """Return whether a value can be iterated over; only once is enough if the annotation says so.

    A dictionary is no list of its keys, and a set has no order.
    """
    if isinstance(value, str | bytes) or issubclass(origin, Mapping) != isinstance(value, Mapping):
        return False
    if issubclass(origin, Sequence) and isinstance(value, Set):
        return False
    return isinstance(value, Iterable) and (origin is Iterable or isinstance(value, Sized))


def strangers(hint: Any, value: object) -> list[object]:
    """Return the entries of a collection that don't fit; iterators, which work only once, are left alone."""
    if not (isinstance(value, Iterable) and isinstance(value, Sized)):
        return []
    fits = test_of(get_args(hint)[0])
    return [item for item in value if not fits(item)]
