"""Unused values: parameters that appear neither in a model nor in what is evaluated along its motions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.dynamics import Equations
from symbody.errors import notify
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.given.similar_name import did_you_mean

__all__ = ["warn_of_unused"]


def warn_of_unused(eqs: Equations, given: Iterable[Expr], wanted: Sequence[Expr], where: str) -> None:
    """Warn of parameters that have a value but appear neither in the model nor in what is evaluated.

    One dictionary of parameters may serve all calls for a model. A parameter that this call does not need, such as a
    mass that cancels, still appears in the bodies, loads or frames: there is no warning of it.

    Args:
        eqs: the equations of motion.
        given: the parameters that have values.
        wanted: the other expressions: outputs, events, and the expressions given for inputs.
        where: the function that the user called, for messages.
    """
    known = {*eqs.parameters, *eqs.system.leaves, *free_symbols(list(wanted))}
    strange = {*given} - known
    unused = sorted(map(str, strange))
    if not unused:
        return
    names = sorted(str(leaf) for leaf in known if leaf.kind == "symbol")
    different = namesake_note(strange, known, ("without a use", "of the model"))
    others = [name for name in unused if name not in names]
    meant = did_you_mean(others, names)
    what, does, effect = (
        ("parameter", "does", "its value has")
        if len(unused) == 1
        else ("parameters", "do", "their values have")
    )
    notify(
        f"{where}: the {what} {', '.join(unused)} {does} not occur in this model or in outputs, events and inputs: "
        f"{effect} no effect{meant and f'; {meant}'}{different}"
    )
