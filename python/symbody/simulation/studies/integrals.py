"""Integrals along a motion, as states that are integrated with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import count

from symbody.dynamics import Equations
from symbody.dynamics.equations.equations import Derived
from symbody.symbolic import Expr, functions_of_time, time_derivative

__all__ = ["with_integrals"]


@lru_cache(maxsize=8)
def _extended(equations: Equations, integrands: tuple[Expr, ...]) -> tuple[Equations, tuple[Expr, ...]]:
    names = {leaf.name for leaf in equations.system.leaves if leaf.kind != "application"}
    free = (name for name in (f"integral{k}" for k in count(1)) if name not in names)
    states = tuple(functions_of_time(name) for name, _ in zip(free, integrands, strict=False))
    rates = dict(zip(states, integrands, strict=True))
    system = equations.system.with_states(rates)
    made = replace(equations, system=system, derive=Derived(equations.derived_residuals))
    # all of the integrand, also what small variables of the equations make negligible there
    vars(made)["state_rates"] = {**equations.state_rates, **_by_speeds(equations, rates)}
    return made, states


def _by_speeds(equations: Equations, rates: Mapping[Expr, Expr]) -> dict[Expr, Expr]:
    values = equations.system.by_speeds(list(rates.values()))
    return {time_derivative(state): value for state, value in zip(rates, values, strict=True)}


def with_integrals(equations: Equations, integrands: Sequence[Expr]) -> tuple[Equations, tuple[Expr, ...]]:
    """Return the equations with a state for the integral of each integrand, and these states.

    Nothing depends on these states, so that the equations of motion are the same; the model, which is compiled once, is
    remembered.
    """
    return _extended(equations, tuple(integrands)) if integrands else (equations, ())
