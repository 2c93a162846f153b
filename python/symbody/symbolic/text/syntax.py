"""The syntax of expressions: the meaning of each rule of the grammar, and the messages for texts that break them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from decimal import Decimal
from functools import cache
from math import isinf

from lark import Lark, Token, UnexpectedCharacters, UnexpectedToken, v_args
from lark.exceptions import VisitError
from lark.visitors import Transformer_NonRecursive

from symbody.errors import ParseError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.derivative import time_derivative
from symbody.symbolic.expression.functions import sqrt
from symbody.symbolic.expression.leaves import Meaning, UndefinedFunction, t
from symbody.symbolic.expression.linear_solution import linear_solution

__all__ = ["Source"]


class Source:
    """The lines of a text from ``row`` and ``column`` to the line before ``end``."""

    def __init__(self, lines: list[str], row: int, column: int, end: int) -> None:
        self.lines, self.row, self.column, self.end = lines, row, column, end

    def parse(self, names: Mapping[str, Meaning]) -> Expr:
        # Spaces in place of what comes before, so that lines and columns are those of the text.
        blank = "\n" * self.row + " " * self.column
        text = "\n".join([self.lines[self.row][self.column :], *self.lines[self.row + 1 : self.end]])
        try:
            return _Builder(names).transform(_parser().parse(blank + text))
        except UnexpectedToken as error:
            raise self._unexpected(error) from None
        except UnexpectedCharacters as error:
            hint = "; an equation is written left - right" if error.char == "=" else ""
            raise self.error(error.line, error.column, f"{error.char!r} means nothing here{hint}") from None
        except VisitError as error:
            if isinstance(error.orig_exc, _Mistake):
                token = error.orig_exc.token
                raise self.error(token.line, token.column, str(error.orig_exc)) from None
            raise error.orig_exc from None

    def _unexpected(self, error: UnexpectedToken) -> ParseError:
        expected = _describe(error.accepts or error.expected)
        if error.token.type != "$END":
            begins = error.token.type in {"NAME", "NUMBER", "LPAR"}
            hint = "; a product is written with *" if begins and "an operator" in expected else ""
            return self.error(
                error.line, error.column, f"found {str(error.token)!r}, expected {expected}{hint}"
            )
        line, column = self.end, len(self.lines[self.end - 1].rstrip()) + 1
        return self.error(line, column, f"the text ends here, expected {expected}")

    def error(self, line: int | None, column: int | None, message: str) -> ParseError:
        """Return the error with the wrong line and a caret under the place."""
        line, column = line or 1, column or 1
        return ParseError(
            f"line {line}, column {column}: {message}\n  {self.lines[line - 1]}\n  {'^':>{column}}"
        )


class _Mistake(Exception):
    """A text with the form of an expression, but without a meaning."""

    def __init__(self, token: Token, message: str) -> None:
        super().__init__(message)
        self.token = token


#: Terminals as messages call them, in the order in which messages list them.
_WORDS = {
    "NUMBER": "a number",
    "NAME": "a name",
    "LPAR": "'('",
    "RPAR": "')'",
    "LSQB": "'['",
    "RSQB": "']'",
    "COMMA": "','",
    "PLUS": "an operator",
    "MORETHAN": "'>'",
    "LESSTHAN": "'<'",
    "TRUE": "'True'",
    "$END": "the end",
}


def _describe(terminals: Iterable[str]) -> str:
    """Return what was expected in words: "a number, a name or '('"."""
    found = set(terminals)
    begins = "NUMBER" in found and "NAME" in found
    words = [
        word for terminal, word in _WORDS.items() if terminal in found and not (begins and terminal == "PLUS")
    ]
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


SHORT = 4000
"""Python reads integers of up to 4300 digits at once."""


def _integer(digits: str) -> int:
    """Return an integer of any length, from the halves of its digits."""
    if len(digits) <= SHORT:
        return int(digits)
    middle = len(digits) // 2
    low = digits[middle:]
    power: int = 10 ** len(low)
    return _integer(digits[:middle]) * power + _integer(low)


@cache
def _parser() -> Lark:
    return Lark.open("expression.lark", rel_to=__file__, parser="lalr", maybe_placeholders=False)


@v_args(inline=True)
class _Builder(Transformer_NonRecursive[Token, Expr]):
    """The meaning of each rule of the grammar."""

    def __init__(self, names: Mapping[str, Meaning]) -> None:
        super().__init__(visit_tokens=False)
        self._names = names

    def number(self, token: Token) -> Expr:
        if token.isdecimal():
            return _core.number(_integer(token))
        value = float(token)
        is_beyond = isinf(value) or (value == 0.0 and Decimal(token) != 0)
        return _core.number(Decimal(token) if is_beyond else value)

    def name(self, token: Token) -> Expr:
        meaning = self._names.get(token)
        if meaning is None:
            return _core.symbol(str(token))
        if isinstance(meaning, UndefinedFunction):
            raise _Mistake(token, f"{token} is a function; it needs arguments, as in {token}(x)")
        return _core.number(meaning, f"parse, the meaning of {token}")

    def assumed(self, token: Token, word: Token) -> Expr:
        """Return the symbol that prints as ``x[positive]`` beside the real x."""
        if word not in _ASSUMPTIONS:
            raise _Mistake(
                word, f"expected an assumption about {token}: {token}[positive] or {token}[complex]"
            )
        return _core.symbol(str(token), **_ASSUMPTIONS[word])

    def derivative(self, token: Token, primes: Token) -> Expr:
        function = self.name(token)
        if not function.depends_on_time:
            raise _Mistake(
                token, f"{token} doesn't depend on time; {token}{primes} is the derivative of nothing"
            )
        return time_derivative(function, len(primes))

    def sum(self, *terms: Expr) -> Expr:
        return _core.sum_of(terms)

    def product(self, *factors: Expr) -> Expr:
        return _core.product_of(factors)

    def reciprocal(self, divisor: Expr) -> Expr:
        return 1 / divisor

    def negative(self, operand: Expr) -> Expr:
        return -operand

    def power(self, base: Expr, exponent: Expr) -> Expr:
        return base**exponent

    def arguments(self, *args: Expr) -> tuple[Expr, ...]:
        return args

    def call(self, token: Token, args: tuple[Expr, ...]) -> Expr:
        name = str(token)
        meaning = self._names.get(name)
        if isinstance(meaning, UndefinedFunction):
            return meaning(*args)
        if isinstance(meaning, Expr):
            return self._at_time(token, meaning, args)
        if name == "diff":
            return _differentiated(token, *args)
        if name == "sqrt" and len(args) == 1:
            return sqrt(args[0])
        if name == "linear_solution":
            return linear_solution(*args)
        name = _SPELLINGS.get(name, name)
        return _core.apply(name, args) if name in _FUNCTIONS else _core.application(name, args)

    def _at_time(self, token: Token, function: Expr, args: tuple[Expr, ...]) -> Expr:
        """Return x for ``x(t)``."""
        if args != (t,) or not function.depends_on_time:
            raise _Mistake(token, f"{token} is not a function; a product is written {token}*(...)")
        return function

    def derivative_call(self, token: Token, primes: Token, args: tuple[Expr, ...]) -> Expr:
        meaning = self._names.get(token)
        if isinstance(meaning, Expr):
            return time_derivative(self._at_time(token, meaning, args), len(primes))
        if len(args) != 1:
            raise _Mistake(primes, f"a prime needs a function of one argument; write D[1]({token})(...)")
        return self._function(token).derivative([len(primes)], *args)

    def indices(self, *tokens: Token) -> list[Token]:
        return list(tokens)

    def partial(self, indices: list[Token], token: Token, args: tuple[Expr, ...]) -> Expr:
        orders = [0] * len(args)
        for index in indices:
            if not (index.isdecimal() and 1 <= int(index) <= len(args)):
                raise _Mistake(index, f"{token} has no argument {index}; it has {len(args)} here")
            orders[int(index) - 1] += 1
        return self._function(token).derivative(orders, *args)

    def _function(self, token: Token) -> UndefinedFunction:
        meaning = self._names.get(token, UndefinedFunction(str(token)))
        if not isinstance(meaning, UndefinedFunction):
            raise _Mistake(token, f"{token} is not an undefined function")
        return meaning

    def branch(self, value: Expr, condition: Expr | None) -> tuple[Expr, Expr | None]:
        return value, condition

    def greater(self, left: Expr, right: Expr) -> Expr:
        return left - right

    def less(self, left: Expr, right: Expr) -> Expr:
        return right - left

    def always(self) -> None:
        return None

    def piecewise(self, *branches: tuple[Expr, Expr | None]) -> Expr:
        flat: list[Expr] = []
        for value, condition in branches:
            if condition is None:
                return _core.apply("Piecewise", (*flat, value))
            flat += [value, condition]
        return _core.apply("Piecewise", (*flat, 0))


_ASSUMPTIONS = {"positive": {"positive": True}, "complex": {"real": False}}

_FUNCTIONS = frozenset(_core.function_names()) - {"Power", "Piecewise"}

#: Other spellings of functions: Python's own, and the textbook's.
_SPELLINGS = {"abs": "Abs", "min": "Min", "max": "Max", "ln": "log"}


def _differentiated(token: Token, expression: Expr, *variables: Expr) -> Expr:
    """Return ``diff(e, x, 2, y)``: the second derivative by x, differentiated by y."""
    if not variables or variables[0].is_number:
        raise _Mistake(token, "diff needs an expression and a variable, as in diff(x**2, x)")
    variable = variables[0]
    for argument in variables:
        if argument.is_number:
            expression = expression.diff(variable, int(argument) - 1)
        else:
            variable = argument
            expression = expression.diff(variable)
    return expression
