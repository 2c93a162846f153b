"""Arguments of the routines of a program: parameters, time, inputs, and the unknowns of the motion."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.dynamics.equations.equations import Equations
from symbody.symbolic import Argument, Expr, Routine, free_symbols, t

ALWAYS = {
    "mass_matrix": ("p", "t", "r", "q"),
    "forcing": ("p", "t", "r", "q", "u", "z"),
    "residuals": ("p", "t", "r", "q", "u", "z", "a", "lambda_"),
    "state_rates": ("p", "t", "r", "q", "u", "z"),
    "constraints": ("p", "t", "r", "q"),
    "velocity_constraints": ("p", "t", "r", "q", "u"),
    "constraint_jacobian": ("p", "t", "r", "q"),
    "forward_dynamics": ("p", "t", "r", "q", "u", "z"),
    "right_hand_side": ("p", "t", "r", "q", "u", "z"),
    "energies": ("p", "t", "r", "q", "u"),
    "outputs": ("p", "t", "r", "q", "u", "z"),
}
"""Arguments that a routine takes even if it doesn't need them, so that a model's change doesn't change the calls."""

MEANINGS = {
    "p": ("parameters", "parameters"),
    "t": ("time", "time and inputs"),
    "r": ("inputs", "time and inputs"),
    "q": ("coordinates", "positions"),
    "u": ("speeds", "velocities"),
    "z": ("states", "velocities"),
    "a": ("accelerations", "accelerations"),
    "lambda_": ("multipliers", "accelerations"),
}
"""Arguments: what they are, and their stage."""


def arguments_of(eqs: Equations, leaves: frozenset[Expr]) -> list[Argument]:
    """Return the arguments of a program that hold some of the leaves, or belong to the motion."""
    known = {*eqs.coordinates, *eqs.speeds, *eqs.states, *eqs.accelerations, *eqs.multipliers, t}
    others = sorted(leaves - known, key=by_name)
    variables: dict[str, Sequence[Expr]] = {
        "p": [leaf for leaf in others if not leaf.depends_on_time],
        "t": [t] if t in leaves else [],
        "r": [leaf for leaf in others if leaf.depends_on_time],
        "q": eqs.coordinates,
        "u": eqs.speeds,
        "z": eqs.states,
        "a": eqs.accelerations,
        "lambda_": eqs.multipliers,
    }
    return [
        Argument(
            name, f"{MEANINGS[name][0]}: {', '.join(map(str, values))}", tuple(values), MEANINGS[name][1]
        )
        for name, values in variables.items()
        if values
    ]


def by_name(leaf: Expr) -> tuple[str, int]:
    """Return what puts leaves in order: the name, then the order of the rate."""
    return leaf.name, leaf.order if leaf.kind == "time_function" else 0


def with_arguments(routine: Routine, arguments: Sequence[Argument]) -> Routine:
    """Return a routine with the names of the arguments that it takes."""
    leaves, always = leaves_of([routine]), ALWAYS[routine.name]
    names = [a.name for a in arguments if a.name in always or not leaves.isdisjoint(a.variables)]
    return Routine(routine.name, routine.meaning, tuple(names), routine.results)


def leaves_of(routines: Iterable[Routine]) -> frozenset[Expr]:
    """Return the symbols and functions of time in routines."""
    return free_symbols([expression for routine in routines for expression in routine.expressions])
