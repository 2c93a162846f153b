"""Substitutions and solutions: what equations say of variables, put into expressions."""

from __future__ import annotations

import re

from symbody.symbolic import Expr
from symbody.worksheet.convert.motion_values import component, is_motion
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped, plain_decimal
from symbody.worksheet.convert.sequences import comprehension
from symbody.worksheet.convert.spectrum_calls import all_roots
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = [
    "coefficient_matrix",
    "differences",
    "generated",
    "isolated",
    "simplified",
    "solution",
    "substitution",
    "value_entries",
]


def substitution(text: Writer, arguments: Arguments) -> str:
    """Return substitutions one after the other; those of a list or a set are simultaneous."""
    *changes, expression = arguments
    written = text.text(expression)
    if len(changes) == 1 and is_motion(text, changes[0]):
        return component(text, changes[0], written)
    plain: list[str] = []
    for change in changes:
        made = _change(text, change)
        if made.startswith("{") and not _depends(text, plain, made):
            plain.append(f"**{made}" if " for " in made else made[1:-1])
            continue
        if plain:
            written, plain = f"sb.subs({written}, {_joined(plain)})", []
        written = f"sb.subs({written}, {made})"
    return f"sb.subs({written}, {_joined(plain)})" if plain else written


def value_entries(text: Writer, node: syntax.Expression) -> str:
    """Return a list or a set of equations ``x = value`` as one dictionary; nothing for another value."""
    if not isinstance(node, syntax.ListDisplay | syntax.SetDisplay) or not all(
        isinstance(each, syntax.Infix) and each.operator == "=" for each in node.items
    ):
        return ""
    made = _change(text, node)
    found = text.value(made)
    is_given = isinstance(found, dict) and len(found) == len(node.items)
    return made if is_given and all(isinstance(each, Expr) and each.is_variable for each in found) else ""


def _joined(parts: list[str]) -> str:
    """Return entries of dictionaries as one."""
    if len(parts) == 1 and parts[0].startswith("**"):
        return parts[0].removeprefix("**")
    return f"{{{', '.join(parts)}}}"


def _comprehended(written: str) -> str:
    """Return ``[{x: a} for ...]`` as one dictionary."""
    found = re.fullmatch(r"\[\{([^{}]*)\} for (.*)\]", written)
    if not found:
        return f"{{key: value for each in {written} for key, value in each.items()}}"
    return f"{{{found[1]} for {found[2]}}}"


def _depends(text: Writer, plain: list[str], made: str) -> bool:
    """Whether a substitution has an effect on the values of those before it, so that it must come after them."""
    before, after = text.value(f"{{{', '.join(plain)}}}"), text.value(made)
    if not isinstance(before, dict) or not isinstance(after, dict):
        return True
    values = [each for each in before.values() if isinstance(each, Expr)]
    leaves = {leaf for key in after for leaf in key.free_symbols}
    known = {leaf for key in before for leaf in key.free_symbols}
    return any(leaves & each.free_symbols for each in values) or bool(leaves & known and leaves != known)


def _change(text: Writer, change: syntax.Expression) -> str:
    match change:
        case syntax.Infix(operator="=", left=left, right=right):
            return f"{{{text.text(left)}: {plain_decimal(text.text(right))}}}"
        case syntax.Call(
            function=syntax.Name(name="seq"), arguments=(syntax.Infix(operator="=") as each, span)
        ):
            return _comprehended(comprehension(text, each, span))
        case syntax.ListDisplay(items=(only,)) | syntax.SetDisplay(items=(only,)):
            return _change(text, only)
        case syntax.SetDisplay(items=items) | syntax.ListDisplay(items=items):
            parts = [_change(text, each) for each in items]
            if all(part.startswith("{") for part in parts):
                inner = [f"**{part}" if " for " in part else part[1:-1] for part in parts]
                return _joined(inner)
    made = text.text(change)
    found = text.value(made)
    if isinstance(found, dict):
        return made
    if isinstance(found, tuple) and len(found) == 2 and isinstance(found[0], Expr):
        return f"dict([{made}])"
    if isinstance(found, list | tuple) and all(isinstance(each, tuple) for each in found):
        return f"dict({made})"
    if isinstance(found, list | tuple) and all(isinstance(each, dict) for each in found):
        return f"{{key: value for each in {made} for key, value in each.items()}}"
    raise NoText("subs")


def solution(text: Writer, arguments: Arguments) -> str:
    """Return ``solve``: a value for one unknown, a dictionary for several, and a list of it where they are a list."""
    if len(arguments) != 2:
        raise NoText("solve")
    unknowns = text.text(arguments[1])
    before, text.as_differences = text.as_differences, True
    try:
        equations = text.text(arguments[0])
    finally:
        text.as_differences = before
    if isinstance(text.value(equations), dict):
        equations = differences(text, equations)
    if not isinstance(text.value(equations), list):
        return _value_of(text, equations, unknowns)
    if isinstance(text.value(unknowns), Expr):
        unknowns = f"[{unknowns}]"
    equations = differences(text, equations)
    solved = f"sb.solve({equations}, {unknowns})"
    if text.value(solved) is None:
        return _all_solutions(text, equations, unknowns, arguments[1]) or solved
    return f"[{solved}]" if isinstance(arguments[1], syntax.ListDisplay | syntax.Call) else solved


def _all_solutions(text: Writer, equations: str, unknowns: str, given: syntax.Expression) -> str:
    """Return the solutions of equations that are not linear; nothing if there are none in closed form."""
    found = f"sb.solutions({equations}, {unknowns})"
    values = text.value(found)
    if not isinstance(values, list) or not values:
        return ""
    if not isinstance(given, syntax.SetDisplay):
        return found
    return f"{found}[0]" if len(values) == 1 else f"tuple({found})"  # a sequence, which lists open


def _value_of(text: Writer, equation: str, unknown: str) -> str:
    """Return the solution of one equation, or a list of all that it has."""
    linear = f"sb.solve({equation}, {unknown})[{unknown}]"
    if text.value(linear) is not None:
        return linear
    found = text.value(f"sb.solutions([{equation}], [{unknown}])")
    if not isinstance(found, list) or not found:
        return _by_sympy(text, equation, unknown) or linear
    if len(found) == 1:
        return f"sb.solutions([{equation}], [{unknown}])[0][{unknown}]"
    return f"[each[{unknown}] for each in sb.solutions([{equation}], [{unknown}])]"


def _by_sympy(text: Writer, equation: str, unknown: str) -> str:
    """Return all roots that SymPy finds, if they are real expressions, or else those of a polynomial with numbers."""
    found = f"sympy.solve(sb.to_sympy({equation}), sb.to_sympy({unknown}))"
    roots = f"[sb.from_sympy(each) for each in {found}]"
    values = text.value(roots)
    if isinstance(values, list) and values:
        return roots if len(values) > 1 else f"sb.from_sympy({found}[0])"
    try:
        return all_roots(text, equation, unknown, real=False)
    except NoText:
        return ""


def isolated(text: Writer, arguments: Arguments) -> str:
    """Return ``isolate(equation, x)``: an equation for x."""
    equation, unknown = arguments
    solved = solution(text, (equation, unknown))
    first = f"{solved}[0]" if solved.startswith("[") else solved
    return f"{{{text.text(unknown)}: {first}}}"


def simplified(text: Writer, arguments: Arguments) -> str:
    """Return ``simplify(e)``, with a method or without; with equations, what they say of unknowns is put in."""
    whole = text.text(arguments[0])
    if len(arguments) == 3:
        place = arguments[0].place
        solved = solution(text, (arguments[1], _as_set(arguments[2], place)))
        found = text.value(solved)
        if isinstance(found, list) and len(found) == 1:
            solved = solved[1:-1] if solved.startswith("[sb.solve(") else f"{solved}[0]"
        return f"sb.simplify(sb.subs({whole}, {solved}))"
    if len(arguments) == 2 and not isinstance(arguments[1], syntax.Name | syntax.Delayed):
        raise NoText("simplify")
    return f"sb.simplify({whole})"


def _as_set(node: syntax.Expression, place: syntax.Place) -> syntax.Expression:
    return syntax.SetDisplay(node.items, place=place) if isinstance(node, syntax.ListDisplay) else node


def differences(text: Writer, equations: str) -> str:
    """Return a list of equations, or a dictionary by their left sides, as a list of differences."""
    found = text.value(equations)
    if isinstance(found, dict):
        return f"[left - right for left, right in {grouped(equations)}.items()]"
    if isinstance(found, list) and found and all(isinstance(each, dict) for each in found):
        return f"[left - right for each in {equations} for left, right in each.items()]"
    if isinstance(found, list) and found and all(isinstance(each, tuple) for each in found):
        return f"[left - right for left, right in {equations}]"
    return equations


def coefficient_matrix(text: Writer, arguments: Arguments) -> str:
    """Return ``genmatrix``: the matrix of linear equations."""
    if len(arguments) != 2:
        raise NoText("genmatrix")
    before, text.as_differences = text.as_differences, True
    try:
        equations = differences(text, text.text(arguments[0]))
    finally:
        text.as_differences = before
    return f"sb.jacobian({equations}, {text.text(arguments[1])})"


def generated(text: Writer, arguments: Arguments) -> str:
    """Return the matrix of linear equations, and their right sides."""
    before, text.as_differences = text.as_differences, True
    try:
        equations = differences(text, text.text(arguments[0]))
    finally:
        text.as_differences = before
    unknowns = text.text(arguments[1])
    right = f"sb.Matrix.column([-each for each in sb.subs({equations}, dict.fromkeys({unknowns}, 0))])"
    return f"(sb.jacobian({equations}, {unknowns}), {right})"
