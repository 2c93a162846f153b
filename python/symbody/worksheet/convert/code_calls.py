"""Code of expressions in other languages, which SymPy prints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeAlias

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.printing.code_text import LANGUAGES, MATLAB, Language, code_name
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import rewritten

__all__ = ["CODE", "is_code", "loads_code", "qualified"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


_ASSIGNED = "sympy.{}(sb.to_sympy({{0}}), assign_to={{1}})"


def _code(form: str, language: Language) -> Call:
    """Return the writer of assignments in a language."""

    def write(text: Writer, arguments: Arguments) -> str:
        written = statements(text, arguments)
        return f'{grouped(written)} + "\\n"' if _is_text(arguments[1:]) else written

    def statements(text: Writer, arguments: Arguments) -> str:
        pairs = _named(arguments[0], language)
        if pairs:
            listed = ", ".join(f'"{name}": {text.text(node)}' for name, node in pairs)
            return f'"\\n".join({form.format("each", "name")} for name, each in {{{listed}}}.items())'
        whole, name = text.text(arguments[0]), _result(arguments[1:])
        found = text.value(whole)
        if isinstance(found, Expr | int):
            return form.format(whole, f'"{name}"')
        if not isinstance(found, list | Matrix):
            raise NoText("code")
        if language is MATLAB:
            return form.format(whole if isinstance(found, Matrix) else f"sb.Matrix([{whole}])", f'"{name}"')
        if isinstance(found, Matrix) and 1 not in found.shape:
            raise NoText("code")
        entries = f"{grouped(whole)}.entries" if isinstance(found, Matrix) else whole
        opening, _, closing = language.brackets
        index = "{k + 1}" if language.first else "{k}"
        each = form.format("each", f'f"{name}{opening}{index}{closing}"')
        return f'"\\n".join({each} for k, each in enumerate({entries}))'

    return write


def _named(node: syntax.Expression, language: Language) -> list[tuple[str, syntax.Expression]]:
    """Return the names in a language and the values of ``[u = .., v[2] = ..]``; nothing for another list."""
    items = node.items if isinstance(node, syntax.ListDisplay) else (node,)
    equations = [each for each in items if isinstance(each, syntax.Infix) and each.operator == "="]
    if equations and len(equations) < len(items):
        raise NoText("code")
    return [(_name(each.left, language), each.right) for each in equations]


def _name(node: syntax.Expression, language: Language) -> str:
    match node:
        case syntax.Name(name=name):
            return name
        case syntax.Selection(whole=syntax.Name(name=name), indices=indices) if all(
            isinstance(each, syntax.Integer) for each in indices
        ):
            places = ",".join(str(each.value) for each in indices if isinstance(each, syntax.Integer))
            return code_name(f"{name}[{places}]", language)
    raise NoText("code")


def _is_text(options: Arguments) -> bool:
    """Whether code is a text, ``output = string``, with the end of its last line; other outputs are files."""
    for option in options:
        match option:
            case syntax.Infix(left=syntax.Name(name="output" | "filename"), right=right):
                if getattr(right, "name", "") != "string":
                    raise NoText("output")
                return True
    return False


def _result(options: Arguments) -> str:
    """Return the name of the result: that of the option ``resultname``, or the one that Maple takes."""
    for option in options:
        match option:
            case syntax.Infix(left=syntax.Name(name="resultname"), right=syntax.Text(text=name)):
                return name
    return "cg"


def loads_code(statement: syntax.Statement) -> bool:
    """Whether a statement is ``with(CodeGeneration)``, after which its commands have their own names."""
    match statement:
        case syntax.Evaluation(
            expression=syntax.Call(function=syntax.Name(name="with"), arguments=(syntax.Name(name=name), *_))
        ):
            return name == "CodeGeneration"
    return False


def qualified(statement: Any) -> Any:
    """Return a statement with the package of each command of code: ``Matlab(e)`` is ``CodeGeneration[Matlab](e)``."""

    def change(node: Any) -> Any:
        match node:
            case syntax.Call(function=syntax.Name(name=name) as function) if name in CODE:
                package = syntax.Name("CodeGeneration", place=node.place)
                return replace(node, function=syntax.Selection(package, (function,), place=node.place))
        return node

    return rewritten(statement, change)


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
    "Matlab": _code(_ASSIGNED.format("octave_code"), MATLAB),
    "C": _code(_ASSIGNED.format("ccode"), LANGUAGES["C"]),
    **dict.fromkeys(("Fortran", "fortran"), _code(_ASSIGNED.format("fcode"), LANGUAGES["Fortran"])),
    "Python": _code('{1} + " = " + sympy.pycode(sb.to_sympy({0}))', LANGUAGES["Python"]),
}
"""Writers by the names of commands of CodeGeneration and codegen."""
