"""Code of expressions in other languages, which SymPy prints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CODE", "is_code"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


_ASSIGNED = "sympy.{}(sb.to_sympy({{0}}), assign_to={{1}})"


def _code(form: str) -> Call:
    """Return the writer of assignments in a language."""

    def write(text: Writer, arguments: Arguments) -> str:
        printed = form
        pairs = _named(arguments[0])
        if pairs:
            listed = ", ".join(f'"{name}": {text.text(node)}' for name, node in pairs)
            each = printed.format("each", "name")
            return f'"\\n".join({each} for name, each in {{{listed}}}.items())'
        whole, name = text.text(arguments[0]), _result(arguments[1:])
        found = text.value(whole)
        if isinstance(found, Expr | int):
            return printed.format(whole, f'"{name}"')
        if not isinstance(found, list | Matrix):
            raise NoText("code")
        entries = f"{grouped(whole)}.entries" if isinstance(found, Matrix) else whole
        each = printed.format("each", f'f"{name}_{{k}}"')
        return f'"\\n".join({each} for k, each in enumerate({entries}))'

    return write


def _named(node: syntax.Expression) -> list[tuple[str, syntax.Expression]]:
    """Return the names and the values of ``[u = .., v = ..]``."""
    items = node.items if isinstance(node, syntax.ListDisplay) else ()
    return [
        (item.left.name, item.right)
        for item in items
        if isinstance(item, syntax.Infix) and item.operator == "=" and isinstance(item.left, syntax.Name)
    ]


def _result(options: Arguments) -> str:
    """Return the name of the result: that of the option ``resultname``, or the one that Maple takes."""
    for option in options:
        match option:
            case syntax.Infix(left=syntax.Name(name="resultname"), right=syntax.Text(text=name)):
                return name
    return "cg"


def is_code(node: object) -> bool:
    """Whether an expression is code in another language, of which there are many texts."""
    match node:
        case syntax.Call(
            function=syntax.Selection(
                whole=syntax.Name(name="CodeGeneration" | "codegen"), indices=(syntax.Name(name=name),)
            )
        ):
            return name in CODE
    return False


CODE: Mapping[str, Call] = {
    "Matlab": _code(_ASSIGNED.format("octave_code")),
    "C": _code(_ASSIGNED.format("ccode")),
    **dict.fromkeys(("Fortran", "fortran"), _code(_ASSIGNED.format("fcode"))),
    "Python": _code('{1} + " = " + sympy.pycode(sb.to_sympy({0}))'),
}
"""Writers by the names of commands of CodeGeneration and codegen."""
