"""Conversion of SymPy's expressions, node by node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from typing import Any

from symbody.errors import ExpressionError, notify, user_frame
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.derived_functions import DERIVED, WITHOUT_COUNTERPART, heaviside
from symbody.symbolic.expression.leaves import check_name
from symbody.symbolic.expression.traverse import post_order
from symbody.symbolic.given.new_namesake import notice_namesakes

__all__ = ["FromSympy", "no_counterpart"]

#: Functions that have the same name in SymPy and here.
_COMMON = frozenset(_core.function_names()) - {"Power", "Piecewise"}

_REASONS = {
    ("ImaginaryUnit", "conjugate", "re", "im", "arg"): "expressions are real; make SymPy's symbols with real=True",
    ("NaN", "Infinity", "NegativeInfinity", "ComplexInfinity"): "expressions hold finite numbers only",
    ("DiracDelta",): "an impulse has no value; start a motion with the velocities after it",
    ("Integral", "Sum", "Product", "Limit"): "let SymPy evaluate it first, by doit(); an integral over time may be a "
    "coordinate, with its integrand as the rate",
    tuple(WITHOUT_COUNTERPART): "; ".join(WITHOUT_COUNTERPART.values()),
    ("floor", "ceiling", "frac", "Mod"): "it is not continuous; write what is meant with Piecewise",
    ("MatrixSymbol", "MatrixElement"): "a matrix needs its entries; as_explicit() makes them symbols of their own",
    (
        "GreaterThan", "LessThan", "StrictGreaterThan", "StrictLessThan", "Unequality", "And", "Or", "Not",
        "BooleanTrue", "BooleanFalse",
    ): "a condition is not a number; use it in a Piecewise",
}  # fmt: skip
"""The reason why an object of SymPy has no counterpart, and an alternative."""


class FromSympy:
    """A conversion from SymPy; an object that several expressions share is converted once."""

    def __init__(self, sympy: Any, names: Mapping[str, Expr]) -> None:
        self._sympy, self._names = sympy, names
        self._made: dict[int, Expr] = {}
        self._roots: list[Any] = []
        self._before = _core.node_count()

    def convert(self, root: Any) -> Expr:
        """Return one expression of SymPy as an expression here."""
        # The keys are ids of objects: parts live as long as their root, and roots as long as this conversion.
        self._roots.append(root)
        for node in post_order([root], self._parts, id):
            self._made[id(node)] = self._node(node)
        result = self._of(root)
        # What existed before has been noticed, or comes from here by way of SymPy.
        made = [leaf for leaf in result.free_symbols if leaf.id >= self._before]
        notice_namesakes(sorted(made, key=str), "from_sympy", user_frame())
        return result

    def _of(self, s: Any) -> Expr:
        return self._made[id(s)]

    def _all(self, nodes: Iterable[Any]) -> list[Expr]:
        return [self._of(node) for node in nodes]

    def _parts(self, s: Any) -> Sequence[Any]:
        sympy = self._sympy
        if isinstance(s, sympy.Derivative):
            return [s.expr, *(variable for variable, _ in s.variable_count)]
        if isinstance(s, sympy.Subs):
            return [s.expr, *s.variables, *s.point]
        if isinstance(s, sympy.Piecewise):
            sides = [side for _, condition in s.args for side in _sides(sympy, condition)]
            return [*(value for value, _ in s.args), *sides]
        function = sympy.core.function.Application
        known = isinstance(s, sympy.Add | sympy.Mul | sympy.Pow | sympy.UnevaluatedExpr | function)
        return list(s.args) if known and not isinstance(s, sympy.logic.boolalg.Boolean) else []

    def _node(self, s: Any) -> Expr:
        sympy = self._sympy
        match s:
            case sympy.Add():
                return _core.sum_of(self._all(s.args))
            case sympy.Mul():
                return _core.product_of(self._all(s.args))
            case sympy.Pow():
                base, exponent = self._all(s.args)
                return base**exponent
            case sympy.Derivative():
                return self._derivative(s)
            case sympy.Subs():
                return self._of(s.expr).subs(
                    dict(zip(self._all(s.variables), self._all(s.point), strict=True))
                )
            case sympy.Piecewise():
                return self._piecewise(s)
            case sympy.core.function.Application():
                return self._function(s)
            case _:
                return self._leaf(s)

    def _leaf(self, s: Any) -> Expr:
        sympy = self._sympy
        match s:
            case sympy.UnevaluatedExpr():
                return self._of(s.args[0])
            case sympy.Rational():
                return _core.number(int(s.p)) / int(s.q)
            case sympy.Float():
                return self._float(s)
            case sympy.Symbol():
                return self._symbol(s)
            case sympy.pi:
                return _core.pi()
            case sympy.E:
                return _core.apply("exp", (1,))
            case _:
                raise no_counterpart(s)

    def _float(self, s: Any) -> Expr:
        """Return the decimal as which the number prints: a double, or one with more digits."""
        is_double = self._sympy.Rational(float(s)) == self._sympy.Rational(s)
        return _core.number(float(s) if is_double else Decimal(str(s)))

    def _symbol(self, s: Any) -> Expr:
        if isinstance(s, self._sympy.Dummy):
            return _core.symbol(_checked(f"{s.name}_{s.dummy_index % 2**64}"))
        if s.name in self._names:
            return self._names[s.name]
        if s.name == "t":
            return _core.time()
        _checked(s.name)
        _check_assumptions(s)
        return _core.symbol(s.name, positive=bool(s.is_positive), real=bool(s.is_real) or not s.is_complex)

    def _function(self, s: Any) -> Expr:
        args, name = self._all(s.args), type(s).__name__
        if name in self._names and args == [_core.time()]:
            return self._names[name]
        if isinstance(s, self._sympy.core.function.AppliedUndef):
            return _core.application(_checked(name), args)
        if name in _COMMON:
            return _core.apply(name, args)
        if name in DERIVED:
            return DERIVED[name](args[0])
        if name == "Heaviside":
            return heaviside(args[0], args[1])
        raise no_counterpart(s)

    def _derivative(self, s: Any) -> Expr:
        result = self._of(s.expr)
        for variable, count in s.variable_count:
            result = result.diff(self._of(variable), int(count))
        return result

    def _piecewise(self, s: Any) -> Expr:
        *branches, (otherwise, condition) = s.args
        if condition is not self._sympy.true:
            raise ExpressionError(f"the Piecewise has no last branch (value, True): {s}")
        result = self._of(otherwise)
        for value, condition in reversed(branches):
            result = self._choice(condition, self._of(value), result)
        return result

    def _choice(self, condition: Any, yes: Expr, no: Expr) -> Expr:
        """Return ``yes`` where the condition holds and ``no`` elsewhere."""
        sympy = self._sympy
        match condition:
            case sympy.And():
                for part in condition.args:
                    yes = self._choice(part, yes, no)
                return yes
            case sympy.Or():
                for part in condition.args:
                    no = self._choice(part, yes, no)
                return no
            case sympy.Not():
                return self._choice(condition.args[0], no, yes)
            case sympy.core.relational.Relational():
                return _comparison(
                    condition.rel_op, self._of(condition.lhs) - self._of(condition.rhs), yes, no
                )
            case _:
                raise no_counterpart(condition)


def _check_assumptions(s: Any) -> None:
    """Refuse a symbol that is not real; give a notice for a negative one, whose sign is lost."""
    if s.is_real is False:
        raise ExpressionError(
            f"from_sympy: {s.name} is {'imaginary' if s.is_imaginary else 'not real'}; expressions are real: make it "
            f"with real=True, or give its meaning, as in names={{{s.name!r}: symbols({s.name!r})}}"
        )
    if s.is_negative:
        notify(
            f"from_sympy: {s.name} is negative, and becomes a real symbol of unknown sign; if roots depend on "
            f"it, give names={{{s.name!r}: -symbols({s.name!r}, positive=True)}}"
        )


def _comparison(operator: str, excess: Expr, yes: Expr, no: Expr) -> Expr:
    """Return ``yes`` where the comparison of left - right with zero holds, written with strict inequalities."""
    if operator in {">=", "<=", "=="}:
        return _comparison({">=": "<", "<=": ">", "==": "!="}[operator], excess, no, yes)
    if operator == "!=":
        no = _first(yes, -excess, no)
    return _first(yes, -excess if operator == "<" else excess, no)


def _sides(sympy: Any, condition: Any) -> list[Any]:
    """Return both sides of every comparison in a condition."""
    relational = sympy.core.relational.Relational
    parts = sympy.preorder_traversal(condition)
    return [side for part in parts if isinstance(part, relational) for side in part.args]


def _first(value: Expr, condition: Expr, otherwise: Expr) -> Expr:
    """Return a Piecewise with this branch first; branches of ``otherwise`` follow in the same list."""
    nested = otherwise.kind == "function" and otherwise.name == "Piecewise"
    rest = otherwise.args if nested else (otherwise,)
    return _core.apply("Piecewise", (value, condition, *rest))


def no_counterpart(s: Any) -> ExpressionError:
    """Return the error for an object of SymPy that has no counterpart, with the reason where it is known."""
    kind = type(s).__name__
    reason = next((reason for kinds, reason in _REASONS.items() if kind in kinds), "")
    return ExpressionError(f"SymPy's {kind} has no counterpart here: {s}" + (f"; {reason}" if reason else ""))


def _checked(name: str) -> str:
    """Return a name of SymPy that is a valid name here too."""
    try:
        check_name(name)
    except ExpressionError as error:
        raise ExpressionError(
            f"from_sympy: {error}; give its meaning, as in names={{{name!r}: symbols('a')}}"
        ) from None
    return name
