"""The parameters and initial values by which a motion is differentiated."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from symbody.errors import ArgumentError, ParameterError
from symbody.multibody import Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, described
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.given.similar_name import did_you_mean
from symbody.symbolic.given.wording import joined_by_and

__all__ = ["differentiated_by"]


def differentiated_by(
    given: object, system: Variables, parameters: Sequence[Expr], place: str = "simulate, sensitivities"
) -> tuple[Expr, ...]:
    """Return the parameters, and the variables of the state that stand for their initial values.

    Args:
        given: what the user passed.
        system: the system.
        parameters: the parameters of the model.
        place: the function and its argument, for messages.

    Raises:
        ArgumentError: it is no list, or a name is in it twice.
        ParameterError: a name is neither a parameter nor a variable of the state.
    """
    if given is None:
        return ()
    if isinstance(given, str | Mapping | Expr) or not isinstance(given, Iterable):
        found = f"{brief(given)} is one expression" if isinstance(given, Expr) else described(given)
        raise ArgumentError(
            f"{place}: {found}; expected a list of parameters, and of coordinates, speeds and states for their initial "
            "values"
        )
    names = tuple(given)
    known = (*parameters, *system.state_names)
    for name in names:
        if not isinstance(name, Expr) or name not in known:
            found = brief(name) if isinstance(name, Expr) else described(name).replace(" is ", ", ", 1) + ","
            raise ParameterError(
                f"{place}: {found} is neither a parameter of the "
                "model nor a coordinate, a speed or a state, which stand for their initial values"
                f"{namesake_note(known, [name], ('of the model', 'given')) or _suggestion(name, known)}"
            )
    twice = [str(name) for place_, name in enumerate(names) if name in names[:place_]]
    if twice:
        raise ArgumentError(f"{place}: {joined_by_and(twice)} twice; expected each once")
    return names


def _suggestion(name: object, known: Sequence[Expr]) -> str:
    names = [str(each) for each in known]
    if not isinstance(name, Expr) and str(name) in names:
        return f"; expected the variable itself: [{name}]"
    return "; " + (did_you_mean([name], names) or f"expected some of {joined_by_and(names, most=12)}")
