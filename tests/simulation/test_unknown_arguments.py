"""Every public function and method of simulations tells of arguments that it doesn't have."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from inspect import Parameter, isclass, isfunction, signature

import pytest

import symbody
from symbody import simulation, view
from symbody.errors import ArgumentError


def public_functions() -> Iterator[tuple[str, Callable[..., object]]]:
    """Yield functions, and methods that take named arguments, with their names."""
    things = {name: getattr(simulation, name) for name in simulation.__all__}
    things |= {name: getattr(symbody, name) for name in ("Linear", "linearize", "small", "taylor")}
    things |= {name: getattr(view, name) for name in ("animate", "plot")}
    for name, thing in things.items():
        if isfunction(thing):
            yield name, thing
        elif isclass(thing):
            for own, method in vars(thing).items():
                if isfunction(method) and not own.startswith("_") and _takes_names(method):
                    yield f"{name}.{own}", partial(method, object())


def _takes_names(method: Callable[..., object]) -> bool:
    kinds = [each.kind for each in signature(method).parameters.values()][1:]
    return bool(kinds) and Parameter.VAR_KEYWORD not in kinds


@pytest.mark.parametrize(
    "function", [pytest.param(function, id=name) for name, function in public_functions()]
)
def test_an_unknown_argument_is_named(function: Callable[..., object]) -> None:
    with pytest.raises(ArgumentError, match="no_such_argument"):
        function(no_such_argument=1)
