"""Names: constants, global names of MBSymba, names joined by ``||``."""

from __future__ import annotations

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.selections import word_of
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["concatenation", "joined_name", "name_text"]

_CONSTANTS = {"Pi": "sb.pi", "t": "sb.t", "true": "True", "false": "False", "I": "1j"}


def name_text(to: Writer, node: syntax.Name) -> str:
    """Return a name: that of a constant, of the master frame, or of a variable of the program."""
    name = node.name
    if name in {"ground", "master_frame", "moving_frame"}:
        return to.names.master or "sb.ground"
    if name == "nargs" and to.names.arguments:
        return f"len({to.names.arguments})"
    if name in {"NULL", "infinity", "nargs"}:
        raise NoText(name)
    return _CONSTANTS.get(name) or to.names.bare_text(name)


def concatenation(to: Writer, node: syntax.Concatenation, *, is_function: bool = False) -> str:
    """Return the symbol ``gamma||i`` inside a loop, or the name itself where it is known."""
    left = word_of(node.left)
    right = to.text(node.right)
    found = to.value(right)
    if not isinstance(found, int):
        raise NoText("||")
    name = f"{left}{found}"
    if is_function:
        to.names.functions.add(name)
    if right == str(found):
        return to.names.text(name)
    known = to.names.values.get(identifier(name))
    if known is not None and not (isinstance(known, Expr) and known.is_variable):
        raise NoText("||")
    maker = "sb.functions_of_time" if name in to.names.functions else "sb.symbols"
    return f'{maker}(f"{left}{{{right}}}")'


def joined_name(to: Writer, node: syntax.Concatenation) -> str:
    """Return the name that is concatenated from words and numbers: ``crank||2``."""
    right = to.text(node.right)
    if not right.isdigit():
        raise NoText("target")
    return f"{joined_name(to, node.left) if isinstance(node.left, syntax.Concatenation) else word_of(node.left)}{right}"
