"""The names of a system in its formulas, which are told apart in all of them."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import wraps
from typing import Concatenate, ParamSpec, Protocol, TypeVar

from symbody.multibody import Variables
from symbody.symbolic import Expr
from symbody.symbolic.expression.naming import one_naming


class OfSystem(Protocol):
    """What is shown of a system."""

    @property
    def system(self) -> Variables: ...


Shown = TypeVar("Shown", bound=OfSystem)
Options = ParamSpec("Options")


def names_told_apart(system: Variables) -> AbstractContextManager[None]:
    """Return a context in which the names of a system are typeset alike in all formulas."""
    names: set[Expr] = {*system.leaves, *system.speeds, *system.multipliers}
    return one_naming(sorted(names, key=str))


def with_one_naming(
    formula: Callable[Concatenate[Shown, Options], str],
) -> Callable[Concatenate[Shown, Options], str]:
    """Return a method that gives a formula, within such a context."""

    @wraps(formula)
    def told_apart(shown: Shown, /, *args: Options.args, **options: Options.kwargs) -> str:
        with names_told_apart(shown.system):
            return formula(shown, *args, **options)

    return told_apart
