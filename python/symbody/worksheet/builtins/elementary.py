"""Elementary functions and numbers."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction

from symbody.errors import WorksheetError
from symbody.symbolic import (
    Abs,
    Expr,
    Max,
    Min,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    exp,
    log,
    number,
    pi,
    sign,
    sin,
    sinh,
    tan,
    tanh,
)
from symbody.worksheet.builtins.substitution import substituted
from symbody.worksheet.evaluation.arithmetic import called_with, raised, scalar
from symbody.worksheet.evaluation.at_numbers import calls_functions, value_at
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.closed_roots import root_number
from symbody.worksheet.mathematics.exact_angle import with_exact_angles
from symbody.worksheet.mathematics.inverse_functions import of_inverse
from symbody.worksheet.mathematics.quadrature import integral_number
from symbody.worksheet.values.complex_number import as_complex, beyond_the_reals, of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer, decimal, with_decimals
from symbody.worksheet.values.structure import Tree, is_negative, tree_of, walk
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Range,
    Relation,
    Sequence,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "evalf", "in_decimals"]


def _of_one(function: Callable[[Expr], Expr]) -> Command:
    def command(session: Session, x: Value) -> Value:
        if isinstance(x, Listed | MapleSet | Array | Table | Range | Sequence):
            name = getattr(function, "__name__", "function")
            raise WorksheetError(
                f"{name}: {session.text(x)[:60]} is no expression; map applies a function to each item"
            )
        argument, name = scalar(session, x), getattr(function, "__name__", "")
        found = beyond_the_reals(name, argument)
        if found is not None:
            session.options.imaginary = True
            return found
        found = of_inverse(name, argument) or function(argument)
        found = with_exact_angles(found) if found.is_constant else found
        return with_decimals(found, argument, digits=session.options.digits)

    return command


def _reciprocal(name: str, function: Callable[[Expr], Expr]) -> Command:
    plain = _of_one(lambda x: 1 / function(x))

    def command(session: Session, x: Value) -> Value:
        session.options.reciprocals.add(name)
        return plain(session, x)

    return command


def arctan(session: Session, y: Value, x: Value | None = None) -> Value:
    """arctan(y), arctan(y, x): the angle whose tangent is y, or that of the point x, y."""
    a = scalar(session, y)
    given = (a,) if x is None else (a, scalar(session, x))
    found = atan(a) if x is None else atan2(*given)
    found = with_exact_angles(found) if found.is_constant else found
    return with_decimals(found, *given, digits=session.options.digits)


def surd(session: Session, x: Value, n: Value) -> Value:
    """surd(x, n): the real n-th root, which is negative for a negative number and an odd n."""
    value, degree = scalar(session, x), as_integer(scalar(session, n))
    known = as_float(value)
    if known is not None and known < 0 and degree is not None and degree % 2:
        return -scalar(session, root(session, -value, n))
    return root(session, x, n)


def root(session: Session, x: Value, n: Value) -> Value:
    """root(x, n): the n-th root."""
    return raised(session, scalar(session, x), 1 / scalar(session, n))


def root_of_symbol(session: Session, x: Value) -> Value:
    """sqrt(x)."""
    return raised(session, scalar(session, x), number(1) / 2)


def _extremum(function: Callable[..., Expr], choose: Callable[..., float]) -> Command:
    def command(session: Session, *values: Value) -> Value:
        items: list[Value] = []
        for value in map(session.resolve, values):
            if isinstance(value, Array):
                items.extend(map(session.current, value.entries))
            else:
                items.extend(value.items if isinstance(value, Listed | MapleSet | Sequence) else (value,))
        arguments = [scalar(session, each) for each in items]
        known = {each: found for each in arguments if (found := as_float(each)) is not None}
        if len(known) == len(arguments) and arguments:
            best = choose(known.values())
            return next(each for each in arguments if known[each] == best)
        return function(*arguments)

    return command


def _rounded(name: str, function: Callable[[float | Fraction], int]) -> Command:
    def command(session: Session, x: Value) -> Value:
        argument = scalar(session, x)
        if argument.is_number:
            return number(function(Fraction(*argument.ratio)))
        found = as_float(argument)
        if found is None:
            return Unevaluated(symbol(name), (x,))
        return number(function(found))

    return command


def _half_away(value: float | Fraction) -> int:
    exact = Fraction(value)
    return math.floor(abs(exact) + Fraction(1, 2)) * (1 if exact >= 0 else -1)


_LARGEST_FACTORIAL = 5000


def factorial(session: Session, n: Value) -> Value:
    """N!."""
    count = as_integer(n)
    if count is None:
        return Unevaluated(symbol("factorial"), (n,))
    if not 0 <= count <= _LARGEST_FACTORIAL:
        raise WorksheetError(f"the factorial of {count}; expected an integer from 0 to {_LARGEST_FACTORIAL}")
    return number(math.factorial(count))


def _integers(function: Callable[[int, int], int]) -> Command:
    def command(session: Session, a: Value, b: Value) -> Value:
        x, y = as_integer(a), as_integer(b)
        if x is None or y is None or y == 0:
            return Unevaluated(symbol(function.__name__.strip("_")), (a, b))
        return number(function(x, y))

    return command


def _modp(a: int, b: int) -> int:
    return a % b


def _iquo(a: int, b: int) -> int:
    return int(Fraction(a, b))


def _irem(a: int, b: int) -> int:
    return a - b * int(Fraction(a, b))


def _integer_division(
    function: Callable[[int, int], int], other: Callable[[int, int], int], name: str
) -> Command:
    """Return iquo or irem: the quotient or the rest; a third argument, a name, gets the other one."""
    plain = _integers(function)

    def command(session: Session, a: Value, b: Value, given: Value | None = None) -> Value:
        made = plain(session, a, b)
        if given is not None and isinstance(made, Expr) and made.is_number:
            if not isinstance(given, Expr) or given.kind != "symbol":
                raise WorksheetError(f"{name}: {session.text(given)[:60]}; expected a name in quotes")
            session.give(given.name, _integers(other)(session, a, b))
        return made

    return command


def fractional_part(session: Session, x: Value) -> Value:
    """frac(x): what is left of a number without its whole part; it has the sign of the number."""
    argument = scalar(session, x)
    if argument.is_number:
        return argument - number(math.trunc(Fraction(*argument.ratio)))
    found = as_float(argument)
    return Unevaluated(symbol("frac"), (x,)) if found is None else argument - number(math.trunc(found))


def binomial(session: Session, n: Value, k: Value) -> Value:
    """binomial(n, k), of whole numbers."""
    a, b = as_integer(n), as_integer(k)
    if a is None or b is None or not 0 <= a <= _LARGEST_FACTORIAL:
        return Unevaluated(symbol("binomial"), (n, k))
    return number(math.comb(a, b) if b >= 0 else 0)


def step(session: Session, x: Value) -> Value:
    """Heaviside(x): 0 below zero, and 1 above."""
    argument = scalar(session, x)
    if argument.is_zero:
        return Unevaluated(symbol("Heaviside"), (x,))
    return (1 + sign(argument)) / 2


def leading_sign(session: Session, p: Value) -> Value:
    """sign(p): the sign of the number before the first term of a polynomial."""
    polynomial = scalar(session, p)
    if not polynomial.is_number:
        session.notice(
            "sign(p) is the sign of the number before the first term; that of a value is signum(p)"
        )
    tree = tree_of(polynomial)
    first = tree.parts[0] if tree.kind == "sum" else tree
    return number(-1 if is_negative(first) else 1)


# --- decimals ---------------------------------------------------------------------------------------------------------


def evalf(session: Session, *values: Value) -> Value:
    """evalf(e [, n]): numbers as decimals; of a sequence, those of each."""
    places = as_integer(values[1]) if len(values) == 2 else None
    if places is not None:
        made = in_decimals(session, values[0], places)
        if isinstance(made, Expr) and made.is_number and places > session.options.digits:
            session.options.precise[made] = min(places, _DOUBLE)
        return made
    return sequence([in_decimals(session, each, session.options.digits) for each in values])


def without_small(
    session: Session, value: Value, places: Value | None = None, least: Value | None = None
) -> Value:
    """fnormal(e [, n, eps]): e in decimals of n digits, with 0 for numbers less than eps, by default 10^(2 - n)."""
    digits = (as_integer(places) if places is not None else None) or session.options.digits
    given = as_float(scalar(session, least)) if least is not None else None
    bound = 10.0 ** (2 - digits) if given is None else given

    def cleaned(each: Expr) -> Value:
        numbers = (node.value for node in walk(tree_of(each)) if node.kind == "number")
        small: dict[Value, Value] = {one: number(0) for one in numbers if abs(as_float(one) or 0.0) < bound}
        return substituted(session, each, small) if small else each

    return entrywise(session, in_decimals(session, value, digits), cleaned)


_DOUBLE = 16
"""The digits of a double."""


def in_decimals(session: Session, value: Value, digits: int) -> Value:
    """Return a value with decimals for numbers; exponents that are integers stay."""
    if isinstance(value, Expr):
        value = _held_in_decimals(session, value, digits)
    if isinstance(value, Expr):
        return _scalar_in_decimals(session, value, digits)
    if isinstance(value, Listed | MapleSet | Sequence):
        return type(value)(tuple(in_decimals(session, each, digits) for each in value.items))
    if isinstance(value, Relation):
        left, right = (in_decimals(session, side, digits) for side in (value.left, value.right))
        return Relation(value.operator, left, right)
    if isinstance(value, Range):
        return Range(in_decimals(session, value.start, digits), in_decimals(session, value.stop, digits))
    if isinstance(value, Unevaluated):
        return root_number(_integral(session, value, min(digits, _DOUBLE)), min(digits, _DOUBLE))
    found = session.resolve(value)
    if isinstance(found, Array):
        entries = [in_decimals(session, session.current(each), digits) for each in found.entries]
        return replace(found, entries=entries)
    return value


def _integral(session: Session, value: Unevaluated, digits: int) -> Value:
    """Return an integral as a number, also one of functions that the sheet has defined."""
    integrand = value.arguments[0] if value.arguments else None
    called = isinstance(integrand, Expr) and calls_functions(session, integrand)
    if len(value.arguments) == 2 and isinstance(value.arguments[1], Range):
        try:
            return integral_number(value, digits, functools.partial(_function_at, session))
        except _NoNumberError:
            return value
    return integral_number(value, digits, functools.partial(value_at, session) if called else None)


def _function_at(session: Session, function: Value, values: Mapping[Expr, float]) -> float:
    """Return the value of a function at a number."""
    (x,) = values.values()
    found = session.call(function, (decimal(x, _DOUBLE),))
    result = as_float(found) if isinstance(found, Expr) else None
    if result is None:
        raise _NoNumberError("no number")
    return result


class _NoNumberError(WorksheetError):
    """A function that nobody knows has no value at a number."""


def _held_in_decimals(session: Session, value: Expr, digits: int) -> Value:
    """Return a scalar in which integrals and roots that were written as such are numbers."""
    held = {each: session.opaque[each.name] for each in value.free_symbols if each.name in session.opaque}
    made = {each: in_decimals(session, inner, digits) for each, inner in held.items()}
    found = {each: inner for each, inner in made.items() if isinstance(inner, Expr)}
    return session.rebuild(value, {**found}) if found else value


def _scalar_in_decimals(session: Session, value: Expr, digits: int) -> Expr:
    found = as_float(value)
    if found is None and value.is_number:
        session.notice("evalf: a number beyond the range of decimals stays exact")
        return value
    if found is not None and digits > _DOUBLE:
        session.notice(f"evalf: {_DOUBLE} digits, as doubles have; {digits} were asked for")
    if found is not None:
        return decimal(found, min(digits, _DOUBLE))
    if session.options.imaginary and (constant := as_complex(value)) is not None:
        return of_number(constant, min(digits, _DOUBLE))
    made: dict[int, Expr] = {}
    for node in walk(tree_of(value)):
        made[id(node)] = _node_in_decimals(session, node, [made[id(part)] for part in node.parts], digits)
    return made[id(tree_of(value))]


def _node_in_decimals(session: Session, node: Tree, parts: list[Expr], digits: int) -> Expr:
    found = as_float(node.value)
    if node.kind == "power":
        exponent = node.parts[1].value
        whole = exponent.is_number and exponent.ratio[1] in (1, 2)
        return _decimal_or(found, parts[0] ** (exponent if whole else parts[1]), digits)
    if found is not None:
        return decimal(found, min(digits, _DOUBLE))
    if node.kind == "sum":
        return sum(parts[1:], start=parts[0])
    if node.kind == "product":
        total = parts[0]
        for part in parts[1:]:
            total = total * part
        return total
    if node.kind == "function" and not (len(node.parts) == 1 and node.parts[0].kind == "name"):
        called = (
            session.call(symbol(node.name), called_with(node, [*parts]))
            if not node.name.startswith("D[")
            else node.value
        )
        return called if isinstance(called, Expr) else node.value
    return node.value


def _decimal_or(found: float | None, value: Expr, digits: int) -> Expr:
    return value if found is None else decimal(found, min(digits, _DOUBLE))


COMMANDS: dict[str, Command] = {
    "sin": _of_one(sin),
    "cos": _of_one(cos),
    "tan": _of_one(tan),
    "sec": _reciprocal("sec", cos),
    "csc": _reciprocal("csc", sin),
    "cot": _reciprocal("cot", tan),
    "arcsin": _of_one(asin),
    "arccos": _of_one(acos),
    "arctan": arctan,
    "arccot": _of_one(lambda x: pi / 2 - atan(x)),
    "sinh": _of_one(sinh),
    "cosh": _of_one(cosh),
    "tanh": _of_one(tanh),
    "exp": _of_one(exp),
    "ln": _of_one(log),
    "log": _of_one(log),
    "log10": _of_one(lambda x: log(x) / log(number(10))),
    "sqrt": root_of_symbol,
    "root": root,
    "surd": surd,
    "abs": _of_one(Abs),
    "signum": _of_one(sign),
    "csgn": _of_one(sign),
    "min": _extremum(Min, min),
    "max": _extremum(Max, max),
    "floor": _rounded("floor", math.floor),
    "ceil": _rounded("ceil", math.ceil),
    "trunc": _rounded("trunc", math.trunc),
    "round": _rounded("round", _half_away),
    "factorial": factorial,
    "frac": fractional_part,
    "binomial": binomial,
    "Heaviside": step,
    "sign": leading_sign,
    "modp": _integers(_modp),
    "iquo": _integer_division(_iquo, _irem, "iquo"),
    "irem": _integer_division(_irem, _iquo, "irem"),
    "igcd": _integers(math.gcd),
    "ilcm": _integers(math.lcm),
    "evalf": evalf,
    "fnormal": without_small,
    "evalhf": evalf,
}
