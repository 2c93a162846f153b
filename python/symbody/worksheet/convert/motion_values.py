"""Motions as ``dsolve`` returns them: procedures of the time, whose values a program integrates up to a time."""

from __future__ import annotations

import re

from symbody.simulation import Motion
from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = [
    "component",
    "function_at",
    "is_motion",
    "motion_call",
    "motion_lines",
    "output_entry",
]

_SIMULATION = re.compile(r"sb\.simulate\((sb\.equations_from_differential\(\[.*\], \[.*\]\)), (initial=.*)\)")


def motion_lines(text: Writer, name: str, written: str) -> list[str]:
    """Return the lines that make a motion whose values the sheet asks for: its equations have a name of their own."""
    found = _SIMULATION.fullmatch(written)
    if found is None or name not in text.names.called:
        return []
    equations = text.names.own(f"{identifier(name)}_equations")
    text.names.root().motions[identifier(name)] = equations
    return [f"{equations} = {found[1]}", f"{identifier(name)} = sb.simulate({equations}, {found[2]})"]


def is_motion(text: Writer, node: syntax.Expression) -> bool:
    """Whether a name is that of a motion whose equations have a name."""
    return isinstance(node, syntax.Name) and bool(_equations(text, node.name))


def _equations(text: Writer, name: str) -> str:
    """Return the variable of the equations of a motion; nothing for another name."""
    is_known = isinstance(text.names.values.get(identifier(name)), Motion)
    return text.names.root().motions.get(identifier(name), "") if is_known else ""


def motion_call(text: Writer, name: str, arguments: Arguments) -> str:
    """Return ``s(1.5)``, the state at a time; nothing for another name."""
    equations = _equations(text, name)
    if not equations or len(arguments) != 1:
        return ""
    time = text.text(arguments[0])
    plain = re.fullmatch(r'sb\.number\("([\d.]+(?:e-?\d+)?)"\)', time)
    return f"state_at({equations}, {identifier(name)}, {plain[1] if plain else time})"


def component(text: Writer, motion: syntax.Expression, function: str) -> str:
    """Return one function of a motion as a function of the time, as ``output = listprocedure`` gives it."""
    assert isinstance(motion, syntax.Name)
    return (
        f"lambda time: state_at({_equations(text, motion.name)}, {identifier(motion.name)}, time)[{function}]"
    )


def function_at(text: Writer, motion: syntax.Expression, place: int) -> str:
    """Return the function at a place of the list that ``output = listprocedure`` gives, from one."""
    return _states(text, motion)[place - 1]


def output_entry(text: Writer, node: syntax.Selection) -> str:
    """Return ``s[1,1]``, the names, and ``s[2,1]``, a row for each time, of ``output = array([..])``."""
    match node.indices:
        case (syntax.Integer(value=row), syntax.Integer(value=1)) if row in {1, 2}:
            states = _states(text, node.whole)
            if row == 1:
                return f"[{', '.join(states)}]"
            motion = text.text(node.whole)
            return f"[[*row] for row in zip({motion}.t, *{motion}.evaluate([{', '.join(states[1:])}]))]"
    raise NoText("selection")


def _states(text: Writer, motion: syntax.Expression) -> list[str]:
    """Return the time and the functions of a motion in the order of ``dsolve``."""
    found = text.value(text.text(motion))
    if not isinstance(found, Motion):
        raise NoText("motion")
    state = sorted(found.state_at(0), key=lambda each: (each.name, each.order))
    return ["sb.t", *(_function(text, each) for each in state)]


def _function(text: Writer, state: Expr) -> str:
    name = text.names.text(state.name)
    orders = f", {state.order}" if state.order > 1 else ""
    return f"sb.diff({name}, sb.t{orders})" if state.order else name
