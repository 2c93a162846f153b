"""Arguments that nobody should pass to the compiled core, by the annotations of its signatures in `_core.pyi`.

A value comes with its text, so that a failure can be read. Two kinds are missing on purpose: iterators without an end,
and expressions so large that each call on one takes long (`test_hostile_calls.py` has some).
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any, NoReturn

import numpy as np

from symbody.symbolic import _core
from tests.symbolic.near_misses import P, Q

SIGNATURES = Path(_core.__file__).with_name("_core.pyi")

Value = tuple[str, Any]


@dataclass(frozen=True)
class Parameter:
    """A parameter of a function of the core: its name, the text of its annotation, and how it is passed."""

    name: str
    annotation: str
    is_optional: bool = False
    is_keyword: bool = False
    is_rest: bool = False


@dataclass(frozen=True)
class Function:
    """A function, a method or a property of the core; ``owner`` is the class that it belongs to."""

    name: str
    owner: str
    parameters: tuple[Parameter, ...]
    is_property: bool = False

    def __str__(self) -> str:
        return f"{self.owner}.{self.name}" if self.owner else self.name


def functions() -> Iterator[Function]:
    """Yield what the stub file lists."""
    for node in ast.parse(SIGNATURES.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef):
            yield _function(node, "")
        if isinstance(node, ast.ClassDef):
            yield from (_function(item, node.name) for item in node.body if isinstance(item, ast.FunctionDef))


def _function(node: ast.FunctionDef, owner: str) -> Function:
    arguments = node.args
    positional = [*arguments.posonlyargs, *arguments.args]
    first_optional = len(positional) - len(arguments.defaults)
    parameters = [_parameter(arg, is_optional=k >= first_optional) for k, arg in enumerate(positional)]
    if arguments.vararg:
        parameters.append(_parameter(arguments.vararg, is_rest=True))
    parameters += [_parameter(arg, is_optional=True, is_keyword=True) for arg in arguments.kwonlyargs]
    if arguments.kwarg:
        parameters.append(_parameter(arguments.kwarg, is_rest=True, is_keyword=True))
    is_property = any(isinstance(mark, ast.Name) and mark.id == "property" for mark in node.decorator_list)
    return Function(node.name, owner, tuple(parameters[1:] if owner else parameters), is_property)


def _parameter(arg: ast.arg, **how: bool) -> Parameter:
    return Parameter(arg.arg, ast.unparse(arg.annotation) if arg.annotation else "Any", **how)


class MischiefError(ValueError):
    """What a hostile object raises; it must come out as it is."""


class Mischief:
    """An object that raises whatever is asked of it."""

    def _raise(self, *_arguments: object) -> NoReturn:
        raise MischiefError

    __iter__ = __len__ = __getitem__ = __float__ = __index__ = __repr__ = __eq__ = __hash__ = _raise
    numerator = items = dtype = property(_raise)


INTEGERS = [0, 1, 2, 3, 4, -1, -2, 2**16, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**61 - 1, 2**62, 2**63 - 1]
INTEGERS += [2**63, 2**64 - 1, 2**64, -(2**31), -(2**63) + 1, -(2**63), 10**30, P, Q, P * Q]
DOUBLES = [0.0, -0.0, 0.5, 1.0, -1.5, 1e-320, 5e-324, 1e16, 1e300, 1.7e308, np.pi, np.pi / 6, 1000.0]
NOT_FINITE = [float("nan"), float("inf"), -float("inf")]
FRACTIONS = [Fraction(1, 2), Fraction(-1, 2), Fraction(2, 3), Fraction(1, 2**31), Fraction(P, Q)]
FRACTIONS += [Fraction(2**63 - 1, 2**63 - 2), Fraction(1, 10**40), Fraction(-1, P)]
NAMES = ["", "x", "t", "pi", "0", "x y", "\0", "'", "sin", "λ", "\ud800", "$", "\n", "a" * 1000, "x_1__2"]
CHOICES = ["expand", "expand_trig", "factor_terms", "combine_trig", "simplify", "text", "latex", "maple"]
CHOICES += ["factor", "solve", *_core.function_names()]
WILD: list[Any] = [None, True, "x", b"x", object(), 1j, int, (), [], {}, Ellipsis, Mischief(), Decimal("NaN")]
WILD += [Decimal("1e400"), Decimal("-Infinity"), Decimal("1e999999999"), np.float64(0.1), np.array(2.0)]
WILD += [np.array([1.0, 2.0]), np.array(["x"]), np.datetime64("NaT"), np.float32("nan"), [[1]], range(3)]
WILD += [2**3000, Fraction(3**1000, 2**1000)]
LENGTHS = (0, 1, 1, 2, 2, 3, 3, 4, 4, 6, 9, 9)


def _text(value: object) -> str:
    return type(value).__name__ if isinstance(value, Mischief) else repr(value)[:60]


@dataclass
class Hostile:
    """Draws arguments; expressions and tapes that calls returned are arguments of later ones."""

    random: Random
    expressions: list[Value] = field(default_factory=list)
    tapes: list[Value] = field(default_factory=list)

    def arguments(self, function: Function) -> tuple[list[Value], dict[str, Value]]:
        positional: list[Value] = []
        named: dict[str, Value] = {}
        for parameter in function.parameters:
            if parameter.is_optional and self.random.random() < 0.5:
                if not parameter.is_keyword:
                    break
            elif parameter.is_keyword:
                named["extra" if parameter.is_rest else parameter.name] = self.value(parameter.annotation)
            else:
                count = self.random.randrange(3) if parameter.is_rest else 1
                positional += [self.value(parameter.annotation) for _ in range(count)]
        return positional, named

    def value(self, annotation: str) -> Value:
        """Return what fits the annotation as far as types go, mostly."""
        if self.random.random() < 0.06:
            return self.wild()
        return MAKERS[annotation](self)

    def pick(self, values: list[Any]) -> Value:
        value = self.random.choice(values)
        return _text(value), value

    def wild(self) -> Value:
        return self.pick(WILD)

    def integer(self) -> Value:
        return self.pick(INTEGERS[:5] if self.random.random() < 0.6 else INTEGERS)

    def double(self) -> Value:
        return self.pick([*DOUBLES, *NOT_FINITE])

    def truth(self) -> Value:
        return self.pick([True, False])

    def word(self) -> Value:
        return self.pick(CHOICES if self.random.random() < 0.6 else NAMES)

    def expression(self) -> Value:
        return self.random.choice(self.expressions)

    def tape(self) -> Value:
        return self.random.choice(self.tapes)

    def operand(self) -> Value:
        kind = self.random.random()
        if kind < 0.7:
            return self.expression()
        if kind < 0.98:
            return self.pick(self.random.choice([INTEGERS, DOUBLES, FRACTIONS]))
        return self.pick([*NOT_FINITE, *WILD])

    def list_of(self, make: Callable[[], Value], length: int | None = None) -> Value:
        length = self.random.choice(LENGTHS) if length is None else length
        items = [make() for _ in range(length)]
        values: Any = [value for _, value in items]
        if self.random.random() < 0.1:
            container: Any = self.random.choice([tuple, iter, dict.fromkeys])
            values = container([as_key(value) for value in values])
        return f"[{', '.join(text for text, _ in items)}]", values

    def operands(self) -> Value:
        return self.expression() if self.random.random() < 0.1 else self.list_of(self.operand)

    def triple(self) -> Value:
        text, values = self.list_of(self.operand, 3 if self.random.random() < 0.9 else None)
        return f"({text[1:-1]})", tuple(values)

    def integers(self) -> Value:
        return self.list_of(self.integer)

    def doubles(self) -> Value:
        return self.list_of(self.double)

    def mapping(self) -> Value:
        count = self.random.choice(LENGTHS)
        items = [self.tuple_of(self.operand, self.operand) for _ in range(count)]
        text, pairs = f"[{', '.join(text for text, _ in items)}]", [pair for _, pair in items]
        if self.random.random() < 0.7:
            return f"dict({text})", {as_key(key): value for key, value in pairs}
        return text, pairs

    def numbers_by_variable(self) -> Value:
        count = self.random.choice(LENGTHS)
        items = [self.tuple_of(self.expression, self.double) for _ in range(count)]
        return f"dict({', '.join(text for text, _ in items)})", dict(pair for _, pair in items)

    def tuple_of(self, *makers: Callable[[], Value]) -> Value:
        items = [make() for make in makers]
        return f"({', '.join(text for text, _ in items)})", tuple(value for _, value in items)

    def words(self) -> Value:
        return self.tuple_of(self.word, self.word)

    def lists_of_words(self) -> Value:
        return self.tuple_of(self.words, self.words)

    def array(self) -> Value:
        """Return what has a buffer: of doubles and others, of any shape, also of what can't be written."""
        length = self.random.choice(LENGTHS)
        array: Any = np.full(length, self.random.choice([*DOUBLES, *NOT_FINITE]))
        make: Any = self.random.choice(
            [np.asarray] * 4 + [_frozen, _every_second, np.float32, bytes, np.atleast_2d]
        )
        return f"{make.__name__}({length} doubles)", make(array)

    def arrays(self) -> Value:
        return self.list_of(self.array)

    def anything(self) -> Value:
        return self.random.choice(
            [self.operand, self.operands, self.array, self.word, self.wild, self.integer]
        )()


def as_key(value: Any) -> Any:
    """Return the value where it can be a key, and its type where it can't."""
    try:
        hash(value)
    except (TypeError, ValueError):
        return type(value)
    return value


def _frozen(array: Any) -> Any:
    array.flags.writeable = False
    return array


def _every_second(array: Any) -> Any:
    return array[::2]


MAKERS: dict[str, Callable[[Hostile], Value]] = {
    "Any": Hostile.anything,
    "object": Hostile.anything,
    "None": Hostile.anything,
    "bool": Hostile.truth,
    "float": Hostile.double,
    "float | None": Hostile.double,
    "int": Hostile.integer,
    "int | None": Hostile.integer,
    "str": Hostile.word,
    "tuple[str, str]": Hostile.words,
    "tuple[Sequence[str], Sequence[str], Sequence[str]] | None": Hostile.lists_of_words,
    "_Operand": Hostile.operand,
    "_Operands": Hostile.operands,
    "_Triple": Hostile.triple,
    "Iterable[_Operand] | Expr": Hostile.operands,
    "Mapping[Expr, Any] | Sequence[tuple[Expr, Any]]": Hostile.mapping,
    "Mapping[Expr, float] | None": Hostile.numbers_by_variable,
    "Sequence[Any]": Hostile.arrays,
    "Sequence[Expr] | None": Hostile.operands,
    "Sequence[Expr]": Hostile.operands,
    "Sequence[_Operand]": Hostile.operands,
    "Sequence[float]": Hostile.doubles,
    "Sequence[int] | None": Hostile.integers,
}
"""How the values of each annotation are drawn: a new annotation in the stub file needs a row here."""
