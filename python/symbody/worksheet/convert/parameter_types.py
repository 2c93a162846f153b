"""The types of the parameters of a procedure, ``x::positive``, as tests at the head of a function."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from symbody.worksheet.convert.names import Names, identifier
from symbody.worksheet.printing.source_text import source_text
from symbody.worksheet.sheet import syntax

__all__ = ["type_test", "type_tests"]

_NUMBERS = {
    **dict.fromkeys(("numeric", "float", "rational", "fraction"), "sb.number({0}).is_number"),
    **dict.fromkeys(("realcons", "constant"), "sb.number({0}).is_constant"),
    "integer": "float({0}).is_integer()",
    "posint": "float({0}).is_integer() and float({0}) > 0",
    "nonnegint": "float({0}).is_integer() and float({0}) >= 0",
    "negint": "float({0}).is_integer() and float({0}) < 0",
    "even": "float({0}) % 2 == 0",
    "odd": "float({0}) % 2 == 1",
    "positive": "float({0}) > 0",
    "negative": "float({0}) < 0",
    "nonnegative": "float({0}) >= 0",
}
_CLASSES = {
    **{each: f"sb.{each.capitalize()}" for each in ("POINT", "VECTOR", "BODY", "FORCE", "TORQUE")},
    **dict.fromkeys(("frame", "mframe"), "sb.Frame"),
    "OBJECT": "sb.Point | sb.Vector | sb.Body | sb.Force | sb.Torque",
    **dict.fromkeys(("list", "set"), "list"),
    **dict.fromkeys(("Matrix", "matrix", "Vector", "vector", "array", "Array", "rtable"), "sb.Matrix"),
    **dict.fromkeys(("algebraic", "scalar"), "sb.Expr | int | float"),
    **dict.fromkeys(("name", "symbol"), "sb.Expr"),
    "string": "str",
    "truefalse": "bool",
    "table": "dict",
}
"""Classes of Python by type; as in the worksheet, any value passes a type that is not known."""


def type_tests(name: str, parameters: Sequence[syntax.Parameter], names: Names) -> Iterator[str]:
    """Return the lines that raise an error for arguments of other types, as Maple does.

    A test is left out if an argument of the call for which the function is written fails it: Python has another class
    for its value. The error is a ``ValueError``, as those of the sheet's own ``error``.

    Args:
        name: the procedure.
        parameters: those of its heading.
        names: the names within the function, with the arguments of the call.
    """
    for each in parameters:
        variable = identifier(each.name)
        if each.type is None:
            continue
        test = type_test(each.type, variable)
        if test and names.value(test):
            yield f"if not ({test}):" if _joins(test) else f"if not {test}:"
            yield (
                f'    raise ValueError(f"{identifier(name)}: {variable} is {{{variable}}}; '
                f'expected {_named(each.type)}")'
            )


def type_test(kind: syntax.Expression, variable: str) -> str:
    """Return the test of a type; nothing if Python has none like it."""
    match kind:
        case syntax.Name(name=name) if name in _NUMBERS:
            return _NUMBERS[name].format(variable)
        case syntax.Name(name=name) if name in _CLASSES:
            return f"isinstance({variable}, {_CLASSES[name]})"
        case syntax.Call(function=syntax.Name(name="list" | "set"), arguments=(inner,)):
            one = type_test(inner, "each")
            return f"isinstance({variable}, list)" + (
                f" and all({one} for each in {variable})" if one else ""
            )
        case syntax.SetDisplay(items=items):
            classes = [_CLASSES.get(str(getattr(each, "name", ""))) for each in items]
            if all(classes):
                return f"isinstance({variable}, {' | '.join(filter(None, classes))})"
            tests = [type_test(each, variable) for each in items]
            return " or ".join(f"({each})" if _joins(each) else each for each in tests) if all(tests) else ""
    return ""


def _joins(test: str) -> bool:
    """Whether a test is composed of several tests."""
    return " and " in test or " or " in test


def _named(kind: syntax.Expression) -> str:
    """Return a type as the sheet writes it, for a formatted text."""
    return source_text(kind).replace("{", "{{").replace("}", "}}")
