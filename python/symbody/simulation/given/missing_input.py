"""Missing inputs: what is wrong with equations that hold functions of time of which nothing is known."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from symbody.dynamics import Equations
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

__all__ = ["missing_inputs"]

MULTIPLIER = re.compile(r"lambda\d+")
"""The names of multipliers by default."""


def missing_inputs(
    eqs: Equations, names: Sequence[str], parameters: Mapping[Expr, object], where: str, example: str
) -> str:
    """Return the message on functions of time that have no value: inputs, or multipliers of other equations.

    Args:
        eqs: the equations.
        names: the functions, by name.
        parameters: what the user gave as parameters, where inputs may stand by mistake.
        where: the function that the user called.
        example: a value to propose for an input.
    """
    meant = {leaf.name for leaf in eqs.system.inputs}
    multipliers = [name for name in names if MULTIPLIER.fullmatch(name) and name not in meant]
    if multipliers:
        return (
            f"{where}: the equations contain {', '.join(multipliers)}, which they don't determine: multipliers of "
            "equations that were derived before, in a load or a constraint of this system; a load by reactions, such "
            "as a friction mu*N, takes a state that follows N with a short lag tau, as in "
            "System(..., states={Nf: (N - Nf)/tau})"
        )
    values = {str(name): value for name, value in parameters.items()}
    misplaced = [name for name in names if name in values]
    stands = f"; {', '.join(misplaced)} {_is_or_are(misplaced)} among the parameters" if misplaced else ""
    shown = brief(repr(values[misplaced[0]])) if misplaced else example
    way_out = (
        f"or solve for it: unknowns=[{names[0]}]"
        if where == "inverse_dynamics"
        else "or add those that are unknown to the coordinates of the System"
    )
    return (
        f"{where}: the equations contain the functions of time {', '.join(names)}, which are neither coordinates "
        f"nor speeds{stands}; give them as inputs={{{(misplaced or names)[0]}: {shown}}}, {way_out}"
    )


def _is_or_are(names: Sequence[str]) -> str:
    return "is" if len(names) == 1 else "are"
