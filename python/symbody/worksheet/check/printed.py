"""Printed output back to values: what Maple prints, what the run prints, and what is complete of a cut output.

Both texts are read in the same way, without the session: names are symbols, ``f(t)`` is a function of time, primes and
``diff`` are derivatives, matrices are lists of rows, and an object is its type with its fields.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from lark import Token

import symbody.symbolic as sb
from symbody.errors import SymbodyError
from symbody.symbolic import Expr, UndefinedFunction, number, pi, symbol, t
from symbody.worksheet.check.derivative_operator import HIGHEST_ORDER, derived_function
from symbody.worksheet.reading.parse import Failure, next_statement, terminator_after, tokens_of
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.greek_letters import SMALL
from symbody.worksheet.sheet.source import Line
from symbody.worksheet.sheet.within import nodes_in
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.value import (
    Listed,
    MapleSet,
    Range,
    Relation,
    Sequence,
    String,
    Unevaluated,
    Value,
)

__all__ = ["NotComparable", "Printed", "functions_in", "is_cut", "place_of", "printed", "value_of"]


class NotComparable(Exception):
    """The reason why two outputs can't be compared."""


@dataclass(frozen=True, slots=True)
class Printed:
    """A printed output: the name that it was assigned to, its expression, and whether its end was cut off."""

    name: str
    expression: syntax.Expression
    cut: bool
    has_decimals: bool


_MOST_ENTRIES = 100_000
_DOTS = re.compile(r"\s*(\.\.\.|…)\s*$")
_MATRICES = frozenset({"matrix", "Matrix", "Vector", "vector", "array", "Array"})
_OBJECTS = frozenset({"POINT", "VECTOR", "BODY", "FORCE", "TORQUE", "TIRE", "CONSTRAINT", "table"})
_CONTAINERS = _MATRICES | _OBJECTS
_OPENING = {"LPAR": ("RPAR", ")"), "LSQB": ("RSQB", "]"), "LBRACE": ("RBRACE", "}")}
_CLOSING = {"RPAR", "RSQB", "RBRACE"}


def printed(text: str) -> Printed:
    """Return what a printed text says; of one that was cut, the part that is complete.

    Raises:
        NotComparable: nothing can be read.
    """
    text = " ".join(text.split())
    cut = is_cut(text)
    tokens = tokens_of(Line(_DOTS.sub("", text), 1))
    if not tokens:
        raise NotComparable("nothing is printed")
    if cut:
        tokens = _complete_part(tokens)
    found = next_statement([*tokens, terminator_after(tokens[-1])])
    if isinstance(found, Failure):  # in two dimensions, a space is a product
        found = next_statement([*_with_products(tokens), terminator_after(tokens[-1])])
    if isinstance(found, Failure):
        big = "a matrix in it is not printed in full"
        raise NotComparable(big if "%id" in text else "it can't be read as a value")
    decimals = any(token.type == "DECIMAL" for token in tokens)
    match found.statement:
        case syntax.Assignment(targets=targets, value=value):
            return Printed(", ".join(_name(target) for target in targets), value, cut, decimals)
        case syntax.Evaluation(expression=expression):
            return Printed("", expression, cut, decimals)
    raise NotComparable("it can't be read as a value")


def _with_products(tokens: list[Token]) -> list[Token]:
    """Return tokens with a product between operands side by side: ``4 L cos(beta)``, but not between words."""
    made = tokens[:1]
    is_formula = any(token.type != "NAME" for token in tokens)
    symbols = [
        is_formula and _is_symbol(one, two) for one, two in zip(tokens, [*tokens[1:], None], strict=True)
    ]
    for (one, two), (is_left, is_right) in zip(pairwise(tokens), pairwise(symbols), strict=True):
        closes = one.type in {"INTEGER", "DECIMAL", *_CLOSING}
        is_factor = two.type in {"NAME", "BACKQUOTED"} and (closes or (is_left and is_right))
        if is_factor and one.end_column != two.column:
            made.append(Token.new_borrow_pos("TIMES", "*", two))
        made.append(two)
    return made


def _is_symbol(token: Token, after: Token | None) -> bool:
    """Whether a token is a name of a formula, not a word: a letter, ``theta``, ``m1``, or before a bracket."""
    if token.type == "BACKQUOTED":
        return True
    if token.type != "NAME":
        return False
    is_head = after is not None and after.type in {"LPAR", "LSQB"} and token.end_column == after.column
    return is_head or len(token.rstrip("0123456789_'")) == 1 or token.lower() in SMALL


def place_of(index: int) -> Expr:
    """Return the symbol for the parameter at an index in the body of an operator or a procedure."""
    return symbol(f"_place{index}")


def is_cut(text: str) -> bool:
    """Whether the end of a printed text was cut off."""
    return _DOTS.search(text) is not None


def _complete_part(tokens: list[Token]) -> list[Token]:
    """Return the tokens up to the last comma between items of lists, matrices and objects, and the missing brackets."""
    open_brackets: list[tuple[str, bool]] = []
    best: tuple[int, list[str]] | None = None
    for index, token in enumerate(tokens):
        if token.type in _OPENING:
            before = str(tokens[index - 1]) if index else ""
            open_brackets.append((token.type, token.type != "LPAR" or before in _CONTAINERS))
        elif token.type in _CLOSING and open_brackets:
            open_brackets.pop()
        if token.type == "COMMA" and all(is_container for _, is_container in open_brackets):
            best = index, [kind for kind, _ in open_brackets]
    if best is None:
        raise NotComparable("cut before anything complete")
    end, kinds = best
    closing = [Token(*_OPENING[kind], line=1, column=1, end_line=1, end_column=1) for kind in reversed(kinds)]
    return [*tokens[:end], *closing]


def functions_in(node: object) -> frozenset[str]:
    """Return the names that a text uses as functions of time: ``x(t)``, or with primes."""
    return frozenset(name for part in nodes_in(node) for name in _function_in(part))


def _function_in(part: object) -> Iterator[str]:
    match part:
        case syntax.Call(
            function=syntax.Name() | syntax.Selection() as head, arguments=(syntax.Name(name="t"),)
        ):
            with suppress(NotComparable):
                yield _name(head)
        case syntax.Infix(operator="^", left=syntax.Name(name=name), right=syntax.Name(name=marks)) if (
            _primes(marks)
        ):
            yield name
        case syntax.Name(name=name) if _primes(name):
            yield name.rstrip("'")


def _primes(name: str) -> int:
    """Return how many primes end a name."""
    return len(name) - len(name.rstrip("'"))


def _name(node: syntax.Expression) -> str:
    """Return a name, also one with indices: ``psi[dot]``."""
    match node:
        case syntax.Name(name=name):
            return name
        case syntax.Selection(whole=whole, indices=indices):
            return f"{_name(whole)}[{','.join(_name(index) for index in indices)}]"
        case syntax.Integer(value=value):
            return str(value)
        case syntax.Call(function=function, arguments=arguments):
            return f"{_name(function)}({','.join(_name(argument) for argument in arguments)})"
    raise NotComparable("a name in it can't be read")


_SCALARS: Mapping[str, Callable[..., Expr]] = {
    "sin": sb.sin,
    "cos": sb.cos,
    "tan": sb.tan,
    "sec": lambda x: 1 / sb.cos(x),
    "csc": lambda x: 1 / sb.sin(x),
    "cot": lambda x: sb.cos(x) / sb.sin(x),
    "arcsin": sb.asin,
    "arccos": sb.acos,
    "arctan": lambda y, x=None: sb.atan(y) if x is None else sb.atan2(y, x),
    "sinh": sb.sinh,
    "cosh": sb.cosh,
    "tanh": sb.tanh,
    "exp": sb.exp,
    "ln": sb.log,
    "sqrt": sb.sqrt,
    "abs": abs,
    "signum": sb.sign,
    # of programs
    "asin": sb.asin,
    "acos": sb.acos,
    "atan": sb.atan,
    "atan2": sb.atan2,
    "log": sb.log,
    "fabs": abs,
    "pow": lambda base, exponent: base**exponent,
}


def value_of(node: syntax.Expression, functions: frozenset[str]) -> Value:
    """Return the value of a printed expression; names in ``functions`` are functions of time also without ``(t)``.

    Raises:
        NotComparable: something in it has no value here.
    """
    is_complex = any(isinstance(part, syntax.Name) and part.name == "I" for part in nodes_in(node))
    try:
        return _Values(functions, is_complex).value(node)
    except (SymbodyError, ArithmeticError, TypeError, RecursionError) as error:
        raise NotComparable(f"a part of it can't be read: {error}") from None


@dataclass(frozen=True, slots=True)
class _Values:
    functions: frozenset[str]
    is_complex: bool = False

    def value(self, node: syntax.Expression) -> Value:
        reader = _READERS.get(type(node))
        if reader is None:
            raise NotComparable("a part of it has no value")
        return reader(self, node)

    def prefix(self, node: syntax.Prefix) -> Value:
        if node.operator not in {"+", "-"}:
            raise NotComparable(f"{node.operator} in it has no value")
        operand = self._scalar(node.operand)
        return -operand if node.operator == "-" else operand

    def values(self, nodes: tuple[syntax.Expression, ...]) -> tuple[Value, ...]:
        return tuple(self.value(node) for node in nodes)

    def _scalar(self, node: syntax.Expression) -> Expr:
        value = self.value(node)
        if not isinstance(value, Expr):
            raise NotComparable("a part of it is no number")
        return value

    def named(self, name: str) -> Expr:
        if name == "Pi":
            return pi
        if name == "t":
            return t
        primes = _primes(name)
        base = name.rstrip("'") if primes else name
        return self._function_of_time(base, primes) if primes or base in self.functions else symbol(name)

    def _function_of_time(self, name: str, order: int) -> Expr:
        value: Expr = UndefinedFunction(name)(t)
        for _ in range(order):
            value = sb.diff(value, t)
        return value

    def infix(self, node: syntax.Infix) -> Value:
        operator, left, right = node.operator, node.left, node.right
        if operator in {"=", "<>", "<", "<=", ">", ">="}:
            return Relation(operator, self.value(left), self.value(right))
        if operator == "..":
            return Range(self.value(left), self.value(right))
        if operator == "^" and isinstance(right, syntax.Name) and right.name == "'" * len(right.name):
            return self._function_of_time(_name(left), len(right.name))
        arithmetic = _ARITHMETIC.get(operator)
        if arithmetic is None:
            raise NotComparable(f"{operator} in it has no value")
        made = arithmetic(self._scalar(left), self._scalar(right))
        return normal(made) if self.is_complex else made

    def arrow(self, node: syntax.Arrow) -> Value:
        """Return an operator as its body at places, so that names of parameters don't count."""
        if isinstance(node.body, syntax.If):
            raise NotComparable("an operator with conditions has no value")
        return self._operator("->", node.parameters, self._scalar(node.body))

    def procedure(self, node: syntax.Procedure) -> Value:
        """Return a procedure of one expression like an operator: Maple prints operators as such procedures."""
        kind = "->" if {"operator", "arrow"} <= set(node.options) else "proc"
        match node.body:
            case (syntax.Evaluation(expression=body) | syntax.Return(value=body),) if body is not None:
                return self._operator(kind, node.parameters, self._scalar(body))
        raise NotComparable("a procedure of several statements, which is written otherwise")

    def _operator(self, kind: str, parameters: tuple[syntax.Parameter, ...], body: Expr) -> Value:
        names = {symbol(each.name): place_of(i) for i, each in enumerate(parameters)}
        return Unevaluated(symbol(kind), (sb.subs(body, names), *names))

    def call(self, node: syntax.Call) -> Value:
        match node:
            case syntax.Call(function=syntax.Name(name="diff" | "Diff"), arguments=(of, *variables)):
                return self._derivative(of, variables)
            case syntax.Call(function=syntax.Call() as derived, arguments=arguments) if derived_function(
                derived
            )[1]:
                return self._derived(*derived_function(derived), arguments)
            case syntax.Call(
                function=syntax.Selection(whole=syntax.Name(name="Vector"), indices=(kind,)),
                arguments=arguments,
            ):
                entries = self._entries(arguments)
                is_row = isinstance(kind, syntax.Name) and kind.name == "row"
                return Listed((entries,)) if is_row else entries
            case syntax.Call(function=function, arguments=arguments):
                return self._named_call(_name(function), arguments)

    def _derived(
        self, function: syntax.Expression, places: tuple[int, ...], arguments: tuple[syntax.Expression, ...]
    ) -> Value:
        """Return derivatives of a function by its arguments at some places, at some values: ``D[1](f)(x, 0)``."""
        values = [self._scalar(argument) for argument in arguments]
        if max(places) > len(values) or min(places) < 1:
            raise NotComparable("an operator in it can't be read")
        variables = [symbol(f"_argument{place}") for place in range(len(values))]
        found = _applied(_name(function), variables)
        for place in places:
            found = sb.diff(found, variables[place - 1])
        return sb.subs(found, dict(zip(variables, values, strict=True)))

    def _named_call(self, name: str, arguments: tuple[syntax.Expression, ...]) -> Value:
        if name in _MATRICES:
            return self._entries(arguments)
        if name in _CONTAINERS:
            return Unevaluated(symbol(name), self.values(arguments))
        if name == "series" and arguments:  # series(x+O(x^3),x,3)
            return self.value(arguments[0])
        values = self.values(arguments)
        scalars = [value for value in values if isinstance(value, Expr)]
        if len(scalars) != len(values) or not values:
            return Unevaluated(symbol(name), values)
        return _applied(name, scalars)

    def _entries(self, arguments: tuple[syntax.Expression, ...]) -> Value:
        entries = [one for one in arguments if isinstance(one, syntax.ListDisplay)]
        if entries:
            return self.value(entries[0])
        sizes = [one.value for one in arguments if isinstance(one, syntax.Integer)]
        places = [one for one in arguments if isinstance(one, syntax.SetDisplay)]
        if not places or len(sizes) not in {1, 2}:
            raise NotComparable("a matrix in it is not printed in full")
        return self._by_places(sizes, places[0])

    def _by_places(self, sizes: list[int], entries: syntax.SetDisplay) -> Value:
        """Return a matrix or a vector of entries with their places: ``Matrix(2, 2, {(1, 1) = a})``; others are 0."""
        known: dict[tuple[int, ...], Value] = {}
        for entry in entries.items:
            match entry:
                case syntax.Infix(operator="=", left=place, right=value):
                    items = place.items if isinstance(place, syntax.SequenceDisplay) else (place,)
                    known[tuple(each.value for each in items if isinstance(each, syntax.Integer))] = (
                        self.value(value)
                    )
                case _:
                    raise NotComparable("an entry of a matrix in it has no place")
        if math.prod(sizes) > _MOST_ENTRIES:
            raise NotComparable(f"a matrix in it has more than {_MOST_ENTRIES} entries")
        rows = range(1, sizes[0] + 1)
        if len(sizes) == 1:
            return Listed(tuple(known.get((row,), number(0)) for row in rows))
        columns = range(1, sizes[1] + 1)
        return Listed(tuple(Listed(tuple(known.get((i, k), number(0)) for k in columns)) for i in rows))

    def _derivative(self, of: syntax.Expression, variables: list[syntax.Expression]) -> Expr:
        value = self._scalar(of)
        for variable in variables:
            match variable:
                case syntax.Infix(operator="$", left=name, right=syntax.Integer(value=times)):
                    pass
                case syntax.Call(
                    function=syntax.Name(name="$"), arguments=(name, syntax.Integer(value=times))
                ):
                    pass
                case _:
                    name, times = variable, 1
            for _ in range(min(times, HIGHEST_ORDER)):
                value = sb.diff(value, self._scalar(name))
        return value


_READERS: Mapping[type, Callable[[_Values, Any], Value]] = {
    syntax.Integer: lambda values, node: number(node.value),
    syntax.Decimal: lambda values, node: _decimal(node.text),
    syntax.Name: lambda values, node: values.named(node.name),
    syntax.Text: lambda values, node: String(node.text),
    syntax.Delayed: lambda values, node: values.value(node.body),
    syntax.SequenceDisplay: lambda values, node: Sequence(values.values(node.items)),
    syntax.ListDisplay: lambda values, node: Listed(values.values(node.items)),
    syntax.Columns: lambda values, node: Listed(values.values(node.items)),
    syntax.Rows: lambda values, node: Listed(values.values(node.items)),
    syntax.SetDisplay: lambda values, node: MapleSet(values.values(node.items)),
    syntax.Selection: lambda values, node: values.named(_name(node)),
    syntax.Prefix: _Values.prefix,
    syntax.Infix: _Values.infix,
    syntax.Call: _Values.call,
    syntax.Arrow: _Values.arrow,
    syntax.Procedure: _Values.procedure,
}


def _power(base: Expr, exponent: Expr) -> Expr:
    return base**exponent


_ARITHMETIC: Mapping[str, Callable[[Any, Any], Expr]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "^": _power,
}


def _applied(name: str, arguments: Iterable[Expr]) -> Expr:
    """Return the value of a function of Maple, or of an unknown one."""
    return _SCALARS[name](*arguments) if name in _SCALARS else UndefinedFunction(name)(*arguments)


def _decimal(text: str) -> Expr:
    mantissa, _, exponent = text.lower().partition("e")
    whole, _, fraction = mantissa.partition(".")
    return number(f"{whole or '0'}.{fraction or '0'}" + (f"e{exponent}" if exponent else ""))
